//! `sawflutter cut`.

use crate::analyses::commands::Argument;
use crate::analyses::cut::cut;
use crate::model::scene::{AssumedBlock, Scene};
use clap::Args;

use super::assumption::with_options;
use super::block_text::pasted;
use super::common::{Common, Speeds, speeds, words};
use super::page::Page;
use super::progress::watched;
use super::shorthand::Given;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter cut                               # the built-in saw, two speeds
  sawflutter cut my-saw.json --rpm 2400        # your own saw at another speed
  sawflutter cut my-saw.json --power 20kW --depth 100mm # a scene without a cut
  sawflutter cut --stretching                  # past five thicknesses
  sawflutter cut --json | jq '.runs[].verdict' # for scripts

The forces are the scene's `cut`; `sawflutter schema` says what it may contain.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
    #[arg(long, value_name = "RPM", allow_hyphen_values = true, value_parser = speeds,
        help = const { words("cut", "rpm") })]
    rpm: Vec<Speeds>,
    #[arg(long, help = const { words("cut", "stretching") })]
    stretching: bool,
    #[command(flatten)]
    forces: Forces,
    #[command(flatten)]
    page: Page,
}

/// Numbers of the scene's `cut`, with or without a unit. If the scene has no cut, the others are assumed and printed.
#[derive(Args)]
#[command(next_help_heading = "Numbers of the cut, with or without a unit")]
struct Forces {
    #[arg(long, value_name = "W",
        help = const { words("cut", "power_w") })]
    power: Option<String>,
    #[arg(long, value_name = "M",
        help = const { words("cut", "depth_m") })]
    depth: Option<String>,
}

impl Forces {
    fn applied(&self, scene: Scene) -> anyhow::Result<Scene> {
        let given = [
            Given::new(&const { Argument::of("cut", "power_w") }, &self.power),
            Given::new(&const { Argument::of("cut", "depth_m") }, &self.depth),
        ];
        with_options(AssumedBlock::Cut, scene, &given)
    }
}

/// Computes a cut, writes the files and prints the summary.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let mut scene = arguments.forces.applied(arguments.common.scene()?)?;
    if arguments.stretching {
        scene = scene.edited(|file| file.cut.iter_mut().for_each(|cut| cut.stretching = true))?;
    }
    let rpm: Vec<f64> = arguments
        .rpm
        .iter()
        .flat_map(|given| given.0.iter().copied())
        .collect();
    let runs = pasted(&scene, scene.needed_cut())?.runs_at(&rpm)?;
    arguments.page.tried()?;
    let folder = arguments.common.folder()?;
    let report = watched(|progress| {
        let map = |done, of| progress.show("points of the map", done, of);
        cut(&scene, &runs, &map)
    })??;
    let output = &arguments.common.output;
    output.report(&folder, &arguments.page, &report, Vec::new())
}
