//! `sawflutter cut`.

use crate::report::CutReport;
use crate::scene::CutRun;
use crate::transient::Cutting;
use anyhow::bail;
use clap::Args;

use super::common::{Common, progress_bar, show};
use super::paste::cut_block;
use super::pictures::{drawn, figure_names};

pub const EXAMPLES: &str = "\
Examples:
  sawflutter cut                                 the built-in saw, two speeds
  sawflutter cut my-saw.json --rpm 2400          your own saw at another speed
  sawflutter cut --json | jq '.runs[].verdict'   for scripts

The forces are the scene's `cut`; `sawflutter schema` says what it may contain.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
    /// Speed to cut at, in place of the scene's; may be given more than once
    #[arg(long, value_name = "RPM", allow_negative_numbers = true)]
    rpm: Vec<f64>,
}

/// Computes a cut, writes the files and prints the summary.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = arguments.common.scene()?;
    let Some(cut) = &scene.cut() else {
        // By itself, for the words of an error are one line.
        eprintln!("{}\n", cut_block(scene.file()));
        bail!(
            "cut is missing, but must say which forces act on the teeth; paste the block above behind the first brace of the scene and put in the numbers of your wood"
        );
    };
    let asked = arguments.rpm.iter().map(|rpm| cut.at_rpm(*rpm));
    let asked = asked.collect::<Result<Vec<CutRun>, _>>()?;
    let runs = if asked.is_empty() { &cut.runs } else { &asked };
    if runs.is_empty() {
        bail!(
            "cut.speeds is missing, but must name a speed to cut at; add it or operating_rpm to the scene, or give --rpm"
        );
    }
    let folder = arguments.common.folder()?;
    let bar = progress_bar("points of the map");
    let cutting = Cutting::new(&scene, cut, runs, &|done, of| show(&bar, done, of))?;
    bar.finish_and_clear();
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
