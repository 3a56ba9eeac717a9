//! `sawflutter runup`.

use crate::report::RunUpReport;
use crate::transient::RunningUp;
use clap::Args;

use super::common::Common;
use super::paste::pasted;
use super::pictures::{drawn, figure_names};
use super::progress::watched;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter runup                         # the built-in saw, 0 to 4000 rpm
  sawflutter runup my-saw.json --out runup # your own saw
  sawflutter runup --stretching            # past five thicknesses
  sawflutter runup --json | jq '.bands[]'  # for scripts

Speeds, duration and force are the scene's `runup`, the probe its `probe`.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
    /// Let the blade stretch where it bends by more than a part of its thickness, as `runup.stretching` does
    #[arg(long)]
    stretching: bool,
}

/// Computes a run-up, writes the files and prints the summary.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let mut scene = arguments.common.scene()?;
    if arguments.stretching {
        scene = scene.edited(|file| {
            file.runup
                .iter_mut()
                .for_each(|runup| runup.stretching = true)
        })?;
    }
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
    arguments.common.print(
        &folder,
        &files,
        &figure_names::<RunUpReport>(),
        &json,
        || report.summary(),
    )
}
