//! `sawflutter gap`.

use crate::analyses::commands::Argument;
use crate::analyses::gap::{GapError, Options, gap};
use anyhow::Context;
use clap::Args;

use super::common::{Common, millimetres, of_option, rpm, words};
use super::page::Page;
use super::progress::watched;
use super::shorthand::{Given, with_shorthands};

pub const EXAMPLES: &str = "\
Examples:
  sawflutter gap my-saw.json                       # guides with a gap
  sawflutter gap my-saw.json --gap 0.05mm          # guides without one
  sawflutter gap my-saw.json --force 10 --rpm 2400 # another force and speed
  sawflutter gap my-saw.json --max-deviation 0.1mm # with a tolerance
  sawflutter gap my-saw.json --oscillating-force 2 # with an oscillation
  sawflutter gap my-saw.json --friction 0.2        # with the heat of the pads
  sawflutter gap my-saw.json --json | jq .half_way_amplitude_m

At least one guide needs `contact` one_sided and a `gap_m`, or give --gap. The
deflection is that of the rim at the cut under the scene's `side_force`, by
default the lateral force of its cut, or 1 N there.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
    #[arg(long, value_name = "N", allow_hyphen_values = true,
        help = const { words("gap", "force_n") })]
    force: Option<String>,
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, value_parser = millimetres,
        help = const { words("gap", "gap_m") })]
    gap: Option<f64>,
    #[arg(long, value_name = "RPM", allow_hyphen_values = true, value_parser = rpm,
        help = const { words("gap", "rpm") })]
    rpm: Option<f64>,
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, value_parser = millimetres,
        help = const { words("gap", "max_deviation_m") })]
    max_deviation: Option<f64>,
    #[arg(long, value_name = "N", allow_hyphen_values = true,
        help = const { words("gap", "oscillating_force_n") })]
    oscillating_force: Option<String>,
    #[arg(long, value_name = "K", allow_hyphen_values = true,
        help = const { words("gap", "oscillating_order") })]
    oscillating_order: Option<String>,
    #[arg(long, value_name = "MU", allow_hyphen_values = true,
        help = const { words("gap", "friction") })]
    friction: Option<String>,
    #[command(flatten)]
    page: Page,
}

/// Evaluates the gaps, writes the files and prints the summary.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let given = [
        Given::new(&const { Argument::of("gap", "force_n") }, &arguments.force),
        Given::new(
            &const { Argument::of("gap", "oscillating_force_n") },
            &arguments.oscillating_force,
        ),
        Given::new(
            &const { Argument::of("gap", "oscillating_order") },
            &arguments.oscillating_order,
        ),
        Given::new(
            &const { Argument::of("gap", "friction") },
            &arguments.friction,
        ),
    ];
    let mut scene = with_shorthands(arguments.common.scene()?, &given)?;
    if let Some(gap_mm) = arguments.gap {
        let found = scene.with_gap(gap_mm / 1e3).context("--gap was refused")?;
        if !found.assumed.is_empty() {
            eprintln!("Assumed beside --gap: {}.", found.in_words());
        }
        scene = found.scene;
    }
    let options = Options {
        rpm: arguments.rpm,
        max_deviation_mm: arguments.max_deviation,
    };
    let refused = |refused: crate::model::scene::RefusedValue| {
        if refused.key.contains('.') {
            refused.into()
        } else {
            of_option(refused)
        }
    };
    options.checked(&scene).map_err(refused)?;
    arguments.page.tried()?;
    let folder = arguments.common.folder()?;
    let found = watched(|_| gap(&scene, &options))?;
    let report = found.map_err(|error| match error {
        GapError::Refused(error) => refused(error),
        other => other.into(),
    })?;
    let output = &arguments.common.output;
    output.report(&folder, &arguments.page, &report, Vec::new())
}
