//! `sawflutter cut`.

use crate::analyses::cut::cut;
use crate::model::scene::{Scene, typical_block};
use clap::Args;

use super::assumption::{Block, Given};
use super::block_text::pasted;
use super::common::{Common, number};
use super::page::Page;
use super::progress::watched;

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
    /// Speed to cut at, in place of the scene's; may be given more than once
    #[arg(long, value_name = "RPM", allow_negative_numbers = true, value_parser = number)]
    rpm: Vec<f64>,
    /// Let the blade stretch where it bends by more than a part of its thickness, as `cut.stretching` does
    #[arg(long)]
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
    /// Power of the cut, in W, or like 20kW
    #[arg(long, value_name = "POWER")]
    power: Option<String>,
    /// Depth of cut, in m, or like 100mm
    #[arg(long, value_name = "LENGTH")]
    depth: Option<String>,
    /// Teeth in the cut at a time; wins over the depth
    #[arg(long, value_name = "COUNT")]
    teeth_in_cut: Option<String>,
    /// Force against the rotation on each tooth, in N; wins over the power
    #[arg(long, value_name = "FORCE", allow_hyphen_values = true)]
    tangential: Option<String>,
    /// Force towards the axis on each tooth, in N
    #[arg(long, value_name = "FORCE", allow_hyphen_values = true)]
    radial: Option<String>,
    /// Force across the blade on each tooth, in N
    #[arg(long, value_name = "FORCE", allow_hyphen_values = true)]
    lateral: Option<String>,
    /// Speed at which the wood is fed, in m/s, or like 60m/min
    #[arg(long, value_name = "SPEED")]
    feed: Option<String>,
    /// Length of the board, in m
    #[arg(long, value_name = "LENGTH")]
    board_length: Option<String>,
}

impl Forces {
    fn applied(&self, scene: Scene) -> anyhow::Result<Scene> {
        let given = [
            Given::new("power", "cut.power_w", &self.power),
            Given::new("depth", "cut.depth_m", &self.depth),
            Given::new("teeth-in-cut", "cut.teeth_in_cut", &self.teeth_in_cut),
            Given::new("tangential", "cut.tangential_n_per_tooth", &self.tangential),
            Given::new("radial", "cut.radial_n_per_tooth", &self.radial),
            Given::new("lateral", "cut.lateral_n_per_tooth", &self.lateral),
            Given::new("feed", "cut.feed_m_per_s", &self.feed),
            Given::new("board-length", "cut.board_length_m", &self.board_length),
        ];
        let block = Block {
            name: "cut",
            is_missing: scene.file().cut.is_none(),
            usual: typical_block::cut,
            given: &given,
            wins: &[
                ("tangential_n_per_tooth", "power_w"),
                ("teeth_in_cut", "depth_m"),
            ],
        };
        block.applied(scene)
    }
}

/// Computes a cut, writes the files and prints the summary.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let mut scene = arguments.forces.applied(arguments.common.scene()?)?;
    if arguments.stretching {
        scene = scene.edited(|file| file.cut.iter_mut().for_each(|cut| cut.stretching = true))?;
    }
    let runs = pasted(&scene, scene.needed_cut())?.runs_at(&arguments.rpm)?;
    arguments.page.tried()?;
    let folder = arguments.common.folder()?;
    let report = watched(|progress| {
        let map = |done, of| progress.show("points of the map", done, of);
        cut(&scene, &runs, &map)
    })??;
    let output = &arguments.common.output;
    output.report(&folder, &arguments.page, &report, Vec::new())
}
