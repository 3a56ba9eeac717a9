//! `sawflutter gap`.

use crate::analyses::gap::{GapError, Options, OscillatingForce, gap};
use clap::Args;

use super::common::{Common, number, of_option, with_settings};
use super::page::Page;
use super::progress::watched;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter gap my-saw.json                         # guides with a gap
  sawflutter gap my-saw.json --force-n 10 --rpm 2400 # another force and speed
  sawflutter gap my-saw.json --max-deviation-mm 0.1  # with a tolerance
  sawflutter gap my-saw.json --oscillating-force-n 2 # with an oscillation
  sawflutter gap my-saw.json --friction 0.2          # with the heat of the pads
  sawflutter gap my-saw.json --json | jq .half_way_amplitude_m

At least one guide needs `contact` one_sided and a `gap_m`. The deflection is
that of the rim at the cut under a side force there.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
    /// Side force at the rim at the cut; by default that of the scene's run-up, or 1 N
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = number)]
    force_n: Option<f64>,
    /// Speed of the map; by default the operating speed, or half of the first critical speed
    #[arg(long, value_name = "RPM", allow_negative_numbers = true, value_parser = number)]
    rpm: Option<f64>,
    /// Largest deflection at the cut that is allowed
    #[arg(long, value_name = "MM", allow_negative_numbers = true, value_parser = number)]
    max_deviation_mm: Option<f64>,
    /// Amplitude of a side force at the rim at the cut that oscillates: the oscillation of the blade beside its deflection.
    /// Run-out, flatness and imbalance of the scene's `response` make it oscillate, too
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = number)]
    oscillating_force_n: Option<f64>,
    /// Ratio of the frequency of this force to that of rotation
    #[arg(
        long,
        value_name = "K",
        default_value_t = 1,
        requires = "oscillating_force_n"
    )]
    oscillating_order: u32,
    /// Coefficient of friction of the pads, for their heat and the deflection with it, as `--set friction.coefficient=MU`
    #[arg(long, value_name = "MU", allow_negative_numbers = true)]
    friction: Option<String>,
    #[command(flatten)]
    page: Page,
}

/// Evaluates the gaps, writes the files and prints the summary.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = arguments.common.scene()?;
    let friction = arguments.friction.iter();
    let friction: Vec<String> = friction
        .map(|mu| format!("friction.coefficient={mu}"))
        .collect();
    let scene = with_settings(&scene, friction.iter().map(String::as_str), "--friction")?;
    let options = Options {
        force_n: arguments.force_n,
        rpm: arguments.rpm,
        max_deviation_mm: arguments.max_deviation_mm,
        oscillating: arguments
            .oscillating_force_n
            .map(|amplitude_n| OscillatingForce {
                amplitude_n,
                order: arguments.oscillating_order,
            }),
    };
    let refused = |refused: crate::scene::RefusedValue| match refused.key.contains('.') {
        true => refused.into(),
        false => of_option(refused),
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
