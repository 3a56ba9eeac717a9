//! `sawflutter report`.

use crate::analyses::commands::CommandReport;
use crate::analyses::report::{Options, report};
use clap::Args;

use super::common::{Common, words};
use super::page::Page;
use super::progress::watched;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter report my-saw.json --out my-saw   # then open my-saw/report.html
  sawflutter report my-saw.json --customer Miller --date 2027-01-15
  sawflutter report my-saw.json --accuracy draft # faster
  sawflutter report my-saw.json --json | jq .speeds

report.html is one page to read, send and print as PDF: the answer idling and in
the cut, the deviation of the board over speed, margins and what usual
tolerances of production take of them, the changes that help most, figures,
inputs and checks. Tolerances are 2 mm of a radius, 1° of an angle, 10 % of a
stiffness and 1 % of other numbers.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
    #[arg(long, value_name = "NAME", help = const { words("report", "customer") })]
    customer: Option<String>,
    #[arg(long, value_name = "DATE", help = const { words("report", "date") })]
    date: Option<String>,
}

/// Computes the report, writes its page and files, and prints the summary.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = arguments.common.scene()?;
    let options = Options {
        customer: arguments.customer.clone(),
        date: arguments.date.clone(),
    };
    let folder = arguments.common.folder()?;
    let report = watched(|_| report(&scene, &options))??;
    let page = report.page()?.into_bytes();
    let output = &arguments.common.output;
    output.report(
        &folder,
        &Page::default(),
        &report,
        vec![("report.html", Some(page))],
    )
}
