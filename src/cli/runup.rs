//! `sawflutter runup`.

use crate::report::RunUpReport;
use crate::transient::RunningUp;
use clap::Args;

use super::common::Common;
use super::paste::pasted;
use super::pictures::drawn;
use super::progress::watched;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter runup                         # the built-in saw, 0 to 4000 rpm
  sawflutter runup my-saw.json --out runup # your own saw
  sawflutter runup --json | jq '.bands[]'  # for scripts

Speeds, duration and force are the scene's `runup`, the probe its `probe`.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
}

/// Computes a run-up, writes the files and prints the summary.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = arguments.common.scene()?;
    pasted(&scene, scene.needed_runup())?;
    let folder = arguments.common.folder()?;
    let found = watched(|progress| {
        let steps = |done, of| progress.show("steps", done, of);
        RunningUp::new(&scene, &steps)
    })??;
    let report = RunUpReport::new(&found);
    let json = serde_json::to_string_pretty(&report)?;
    let mut files = drawn(&report)?;
    files.push(("runup.json", json.clone().into_bytes()));
    arguments
        .common
        .print(&folder, &files, &[], &json, || report.summary())
}
