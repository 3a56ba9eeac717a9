//! `sawflutter washboard`.

use crate::analyses::washboard::washboard;
use clap::Args;

use super::block_text::pasted;
use super::common::{Common, number, words};
use super::page::Page;
use super::progress::watched;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter washboard my-saw.json                      # is the board smooth?
  sawflutter washboard my-saw.json --rpm 2400           # at another speed
  sawflutter washboard my-saw.json --json | jq .verdict # for scripts

The cutting stiffness is the scene's `cut.washboarding`; `sawflutter schema`
says what that may contain.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
    #[arg(long, value_name = "RPM", allow_negative_numbers = true, value_parser = number,
        help = const { words("washboard", "rpm") })]
    rpm: Option<f64>,
    #[command(flatten)]
    page: Page,
}

/// Looks at washboarding, writes the files and prints the summary.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = arguments.common.scene()?;
    let cut = pasted(&scene, scene.needed_washboarding())?;
    let run = cut.at_rpm(scene.needed_operating_rpm(arguments.rpm)?)?;
    arguments.page.tried()?;
    let folder = arguments.common.folder()?;
    let report = watched(|progress| {
        let speeds = |done, of| progress.show("speeds", done, of);
        washboard(&scene, &run, &speeds)
    })??;
    let output = &arguments.common.output;
    output.report(&folder, &arguments.page, &report, Vec::new())
}
