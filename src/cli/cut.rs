//! `sawflutter cut`.

use crate::report::CutReport;
use crate::transient::Cutting;
use clap::Args;

use super::common::{Common, number};
use super::paste::pasted;
use super::pictures::{drawn, figure_names};
use super::progress::watched;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter cut                               # the built-in saw, two speeds
  sawflutter cut my-saw.json --rpm 2400        # your own saw at another speed
  sawflutter cut --stretching                  # past five thicknesses
  sawflutter cut --json | jq '.runs[].verdict' # for scripts

The forces are the scene's `cut`; `sawflutter schema` says what it may contain.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
    /// Speed to cut at, in place of the scene's; may be given more than once
    #[arg(long, value_name = "RPM", allow_negative_numbers = true, value_parser = number)]
    rpm: Vec<f64>,
    /// Let the blade stretch where it bends by more than a part of its thickness, as `cut.stretching` does
    #[arg(long)]
    stretching: bool,
}

/// Computes a cut, writes the files and prints the summary.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let mut scene = arguments.common.scene()?;
    if arguments.stretching {
        scene = scene.edited(|file| file.cut.iter_mut().for_each(|cut| cut.stretching = true))?;
    }
    let runs = pasted(&scene, scene.needed_cut())?.runs_at(&arguments.rpm)?;
    let folder = arguments.common.folder()?;
    let cutting = watched(|progress| {
        let map = |done, of| progress.show("points of the map", done, of);
        Cutting::new(&scene, &runs, &map)
    })??;
    let report = CutReport::new(&cutting);
    let json = serde_json::to_string_pretty(&report)?;
    let mut files = drawn(&report)?;
    files.push(("cut.json", json.clone().into_bytes()));
    arguments
        .common
        .print(&folder, &files, &figure_names::<CutReport>(), &json, || {
            report.summary()
        })
}
