//! `sawflutter response`.

use crate::analyses::response::{Options, ResponseError, response};
use clap::Args;

use super::common::{Common, hertz, of_option, rpm, words};
use super::page::Page;
use super::progress::watched;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter response my-saw.json              # what the scene has of causes
  sawflutter response my-saw.json --set side_force.force_n=5N \\
    --set response.flatness_m=0.05mm           # a side force, a warped blade
  sawflutter response my-saw.json --rpm 1200 --to-frequency 300
                             # from the force to the probe, over the frequency
  sawflutter response my-saw.json --json | jq '.lines[].resonances'

Causes are `side_force`, constant or oscillating, and runout_m, flatness_m and
imbalance_kg_m2 of the block `response`. Without any, the force is the lateral
one of the cut, or 1 N.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
    #[arg(long, value_name = "RPM", allow_hyphen_values = true, value_parser = rpm,
        help = const { words("response", "rpm") })]
    rpm: Option<f64>,
    #[arg(long, value_name = "HZ", allow_hyphen_values = true, value_parser = hertz,
        help = const { words("response", "to_hz") })]
    to_frequency: Option<f64>,
    #[command(flatten)]
    page: Page,
}

/// Computes the response, writes the files and prints the summary.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = arguments.common.scene()?;
    let options = Options {
        rpm: arguments.rpm,
        to_hz: arguments.to_frequency,
    };
    options.checked().map_err(of_option)?;
    arguments.page.tried()?;
    let folder = arguments.common.folder()?;
    let report = watched(|_| response(&scene, &options))?.map_err(|error| match error {
        // The key of a value of the scene contains a dot behind the name of its block; the name of an option
        // contains no dot.
        ResponseError::Refused(refused) if !refused.key.contains('.') => of_option(refused),
        other => other.into(),
    })?;
    let (output, page) = (&arguments.common.output, &arguments.page);
    output.report(&folder, page, &report, Vec::new())
}
