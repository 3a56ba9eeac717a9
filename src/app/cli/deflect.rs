//! `sawflutter deflect`.

use crate::analyses::commands::Argument;
use crate::analyses::deflect::{DeflectError, Options, deflect};
use clap::Args;

use super::common::{Common, number, of_option, words};
use super::page::Page;
use super::progress::watched;
use super::shorthand::{Given, with_shorthands};

pub const EXAMPLES: &str = "\
Examples:
  sawflutter deflect                                # the built-in saw
  sawflutter deflect my-saw.json --force-n 10       # your own saw, pressed more
  sawflutter deflect --force-n 0                    # which way does it buckle?
  sawflutter deflect --to-rpm 2000 --accuracy draft # faster
  sawflutter deflect --json | jq '.up.jumps[]'      # for scripts

The blade stretches where it bends by more than a part of its thickness, and
leans to one side where the flat blade is unstable. The deflection is read at
the scene's `probe`.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
    #[arg(long, value_name = "N", allow_hyphen_values = true,
        help = const { words("deflect", "force_n") })]
    force_n: Option<String>,
    #[arg(long, value_name = "RPM", allow_negative_numbers = true, value_parser = number,
        help = const { words("deflect", "to_rpm") })]
    to_rpm: Option<f64>,
    #[command(flatten)]
    page: Page,
}

/// Follows the equilibria, writes the files and prints the summary.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let given = [Given::new(
        &const { Argument::of("deflect", "force_n") },
        &arguments.force_n,
    )];
    let scene = with_shorthands(arguments.common.scene()?, &given)?;
    let options = Options {
        to_rpm: arguments.to_rpm,
    };
    options.checked().map_err(of_option)?;
    arguments.page.tried()?;
    let folder = arguments.common.folder()?;
    let report = watched(|_| deflect(&scene, &options))?.map_err(|error| match error {
        DeflectError::Refused(refused) if refused.key.contains('.') => refused.into(),
        DeflectError::Refused(refused) => of_option(refused),
        other => other.into(),
    })?;
    let output = &arguments.common.output;
    output.report(&folder, &arguments.page, &report, Vec::new())
}
