//! `sawflutter deflect`.

use crate::analyses::commands::Argument;
use crate::analyses::deflect::{DeflectError, Options, deflect};
use clap::Args;

use super::common::{Common, of_option, rpm, words};
use super::page::Page;
use super::progress::watched;
use super::shorthand::{Given, with_shorthands};

pub const EXAMPLES: &str = "\
Examples:
  sawflutter deflect                            # the built-in saw
  sawflutter deflect my-saw.json --force 10     # your own saw, pressed more
  sawflutter deflect --force 0                  # which way does it buckle?
  sawflutter deflect --to 2000 --accuracy draft # faster
  sawflutter deflect --json | jq '.up.jumps[]'  # for scripts

The blade stretches where it bends by more than a part of its thickness, and
leans to one side where the flat blade is unstable. The deflection is read at
the scene's `probe`.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
    #[arg(long, value_name = "N", allow_hyphen_values = true,
        help = const { words("deflect", "force_n") })]
    force: Option<String>,
    #[arg(long, value_name = "RPM", allow_hyphen_values = true, value_parser = rpm,
        help = const { words("deflect", "to_rpm") })]
    to: Option<f64>,
    #[command(flatten)]
    page: Page,
}

/// Follows the equilibria, writes the files and prints the summary.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let given = [Given::new(
        &const { Argument::of("deflect", "force_n") },
        &arguments.force,
    )];
    let scene = with_shorthands(arguments.common.scene()?, &given)?;
    let options = Options {
        to_rpm: arguments.to,
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
