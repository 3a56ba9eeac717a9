//! `sawflutter runup`.

use crate::analyses::commands::Argument;
use crate::analyses::runup::runup;
use crate::model::scene::{AssumedBlock, Scene};
use clap::Args;

use super::assumption::with_options;
use super::block_text::pasted;
use super::common::{Common, words};
use super::page::Page;
use super::progress::watched;
use super::shorthand::Given;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter runup                         # the built-in saw, 0 to 4000 rpm
  sawflutter runup my-saw.json --out runup # your own saw
  sawflutter runup my-saw.json --to 4000 --seconds 60 --force 5N
  sawflutter runup --stretching            # past five thicknesses
  sawflutter runup --json | jq '.bands[]'  # for scripts

Speeds and duration are the scene's `runup`, the force its `side_force` or 1 N,\nthe probe its `probe`.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
    #[arg(long, help = const { words("runup", "stretching") })]
    stretching: bool,
    #[command(flatten)]
    course: Course,
    #[command(flatten)]
    page: Page,
}

/// Numbers of the scene's `runup` and `side_force`, with or without a unit. If the scene has no run-up, the others are assumed and
/// printed.
#[derive(Args)]
#[command(next_help_heading = "Numbers of the run-up, with or without a unit")]
struct Course {
    #[arg(long, value_name = "RPM",
        help = const { words("runup", "to_rpm") })]
    to: Option<String>,
    #[arg(long, value_name = "S",
        help = const { words("runup", "duration_s") })]
    seconds: Option<String>,
    #[arg(long, value_name = "N", allow_hyphen_values = true,
        help = const { words("runup", "force_n") })]
    force: Option<String>,
}

impl Course {
    fn applied(&self, scene: Scene) -> anyhow::Result<Scene> {
        let given = [
            Given::new(&const { Argument::of("runup", "to_rpm") }, &self.to),
            Given::new(
                &const { Argument::of("runup", "duration_s") },
                &self.seconds,
            ),
            Given::new(&const { Argument::of("runup", "force_n") }, &self.force),
        ];
        with_options(AssumedBlock::RunUp, scene, &given)
    }
}

/// Computes a run-up, writes the files and prints the summary.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let mut scene = arguments.course.applied(arguments.common.scene()?)?;
    if arguments.stretching {
        scene = scene.edited(|file| {
            file.runup
                .iter_mut()
                .for_each(|runup| runup.stretching = true)
        })?;
    }
    pasted(&scene, scene.needed_runup())?;
    arguments.page.tried()?;
    let folder = arguments.common.folder()?;
    let report = watched(|progress| {
        let steps = |done, of| progress.show("steps", done, of);
        runup(&scene, &steps)
    })??;
    let output = &arguments.common.output;
    output.report(&folder, &arguments.page, &report, Vec::new())
}
