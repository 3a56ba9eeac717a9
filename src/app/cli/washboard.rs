//! `sawflutter washboard`.

use crate::analyses::commands::Argument;
use crate::analyses::washboard::washboard;
use crate::model::scene::{AssumedBlock, Scene};
use clap::Args;

use super::assumption::with_options;
use super::block_text::pasted;
use super::common::{Common, rpm, words};
use super::page::Page;
use super::progress::watched;
use super::shorthand::Given;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter washboard my-saw.json                      # is the board smooth?
  sawflutter washboard my-saw.json --rpm 2400           # at another speed
  sawflutter washboard my-saw.json --stiffness 20kN/m   # a scene without
  sawflutter washboard my-saw.json --json | jq .verdict # for scripts

The cutting stiffness is the scene's `cut.washboarding`; `sawflutter schema`
says what that may contain.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
    #[arg(long, value_name = "RPM", allow_hyphen_values = true, value_parser = rpm,
        help = const { words("washboard", "rpm") })]
    rpm: Option<f64>,
    #[command(flatten)]
    forces: Forces,
    #[command(flatten)]
    page: Page,
}

/// Numbers of the scene's `cut`, with or without a unit. If the scene has no `cut.washboarding`, the others are assumed and printed.
#[derive(Args)]
#[command(next_help_heading = "Numbers of the cut, with or without a unit")]
struct Forces {
    #[arg(long, value_name = "N/M",
        help = const { words("washboard", "stiffness_n_per_m") })]
    stiffness: Option<String>,
    #[arg(long, value_name = "SHARE",
        help = const { words("washboard", "overlap") })]
    overlap: Option<String>,
    #[arg(long, value_name = "W",
        help = const { words("washboard", "power_w") })]
    power: Option<String>,
    #[arg(long, value_name = "M",
        help = const { words("washboard", "depth_m") })]
    depth: Option<String>,
}

impl Forces {
    fn applied(&self, scene: Scene) -> anyhow::Result<Scene> {
        let given = [
            (
                &self.stiffness,
                const { Argument::of("washboard", "stiffness_n_per_m") },
            ),
            (
                &self.overlap,
                const { Argument::of("washboard", "overlap") },
            ),
            (&self.power, const { Argument::of("washboard", "power_w") }),
            (&self.depth, const { Argument::of("washboard", "depth_m") }),
        ];
        let given = given.map(|(text, argument)| Given::new(&argument, text));
        with_options(AssumedBlock::Washboarding, scene, &given)
    }
}

/// Looks at washboarding, writes the files and prints the summary.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = arguments.forces.applied(arguments.common.scene()?)?;
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
