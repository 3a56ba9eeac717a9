//! `sawflutter gap`.

use crate::analyses::gap::{GapError, Options, gap};
use clap::Args;

use super::common::{Common, number, of_option};
use super::page::Page;
use super::progress::watched;
use super::shorthand::{Given, with_shorthands};

pub const EXAMPLES: &str = "\
Examples:
  sawflutter gap my-saw.json                         # guides with a gap
  sawflutter gap my-saw.json --force-n 10 --rpm 2400 # another force and speed
  sawflutter gap my-saw.json --max-deviation-mm 0.1  # with a tolerance
  sawflutter gap my-saw.json --oscillating-force-n 2 # with an oscillation
  sawflutter gap my-saw.json --friction 0.2          # with the heat of the pads
  sawflutter gap my-saw.json --json | jq .half_way_amplitude_m

At least one guide needs `contact` one_sided and a `gap_m`. The deflection is
that of the rim at the cut under the scene's `side_force`, by default 1 N there.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
    /// Constant side force, as `--set side_force.force_n=N`; 1 N in a scene without one
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    force_n: Option<String>,
    /// Speed of the map; by default the operating speed, or half of the first critical speed
    #[arg(long, value_name = "RPM", allow_negative_numbers = true, value_parser = number)]
    rpm: Option<f64>,
    /// Largest deflection at the cut that is allowed
    #[arg(long, value_name = "MM", allow_negative_numbers = true, value_parser = number)]
    max_deviation_mm: Option<f64>,
    /// Amplitude of a side force that oscillates, as `--set side_force.oscillating_n=N`: the oscillation of the blade beside its
    /// deflection. Run-out, flatness and imbalance of the scene's `response` make it oscillate, too
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    oscillating_force_n: Option<String>,
    /// Ratio of the frequency of this force to that of rotation, as `--set side_force.order=K`; 1 by default
    #[arg(long, value_name = "K", allow_hyphen_values = true)]
    oscillating_order: Option<String>,
    /// Coefficient of friction of the pads, for their heat and the deflection with it, as `--set friction.coefficient=MU`
    #[arg(long, value_name = "MU", allow_negative_numbers = true)]
    friction: Option<String>,
    #[command(flatten)]
    page: Page,
}

/// Evaluates the gaps, writes the files and prints the summary.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let given = [
        Given::new("force-n", "side_force.force_n", &arguments.force_n),
        Given::new(
            "oscillating-force-n",
            "side_force.oscillating_n",
            &arguments.oscillating_force_n,
        ),
        Given::new(
            "oscillating-order",
            "side_force.order",
            &arguments.oscillating_order,
        ),
        Given::new("friction", "friction.coefficient", &arguments.friction),
    ];
    let scene = with_shorthands(arguments.common.scene()?, &given)?;
    let options = Options {
        rpm: arguments.rpm,
        max_deviation_mm: arguments.max_deviation_mm,
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
