//! `sawflutter washboard`.

use crate::report::WashboardReport;
use crate::washboarding::Washboard;
use anyhow::{Context, bail};
use clap::Args;

use super::common::{Common, progress_bar, show};
use super::paste::{cut_block, washboarding_block};
use super::pictures::{drawn, figure_names};

pub const EXAMPLES: &str = "\
Examples:
  sawflutter washboard my-saw.json                        is the board smooth?
  sawflutter washboard my-saw.json --rpm 2400             at another speed
  sawflutter washboard my-saw.json --json | jq .verdict   for scripts

The cutting stiffness is the scene's `cut.washboarding`; `sawflutter schema`
says what that may contain.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
    /// Speed to cut at; the scene's operating speed by default
    #[arg(long, value_name = "RPM", allow_negative_numbers = true)]
    rpm: Option<f64>,
}

/// Looks at washboarding, writes the files and prints the summary.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = arguments.common.scene()?;
    let Some(cut) = scene.cut() else {
        eprintln!("{}\n", cut_block(scene.file()));
        bail!(
            "cut is missing, but must say which forces act on the teeth; paste the block above behind the first brace of the scene and put in the numbers of your wood"
        );
    };
    let Some(washboarding) = &cut.washboarding else {
        eprintln!("{}\n", washboarding_block());
        bail!(
            "cut.washboarding is missing, but must say how stiff the cut is across the blade; paste the block above behind the first brace of cut and put in the number of your wood"
        );
    };
    let rpm = arguments.rpm.or(scene.file().operating_rpm).context(
        "operating_rpm is missing, but must say how fast the saw cuts; add it to the scene, or give --rpm",
    )?;
    let run = cut.at_rpm(rpm)?;
    let folder = arguments.common.folder()?;
    let bar = progress_bar("speeds");
    let progress = |done, of| show(&bar, done, of);
    let found = Washboard::new(&scene, (cut, washboarding), &run, &progress)?;
    bar.finish_and_clear();
    let report = WashboardReport::new(&found);
    let json = serde_json::to_string_pretty(&report)?;
    let mut files = drawn(&report)?;
    files.push(("washboard.json", json.clone().into_bytes()));
    let names = figure_names::<WashboardReport>();
    let common = &arguments.common;
    common.print(&folder, &files, &names, &json, || report.summary())
}
