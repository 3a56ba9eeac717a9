//! `sawflutter fit`.

use std::path::PathBuf;

use crate::analyses::fit::{Measurement, Options, fit};
use crate::model::scene::{Freed, Scene};
use crate::page::text::{Kind, OtherEncodings};
use clap::Args;

use super::bounds::named_bounds;
use super::common::{Common, count, of_option, read_text, refused, rpm, share, words};
use super::page::Page;
use super::progress::watched;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter fit --to 1250                # the built-in saw to its own table
  sawflutter fit my-saw.json measured.csv # radius and stiffness of every guide
  sawflutter fit my-saw.json measured.csv \\
    --free \"guides[0].radius_m=0.15..0.3\" \\
    --free blade.material.density_kg_per_m3

measured.csv: a speed in rpm, then frequencies in Hz, ascending; blank where a
mode was not seen. They are compared with the lowest computed ones. A first line
like rpm,f1,f2 names the columns, in any order; semicolons with decimal commas
and tabs are read too. A tap test is a row at speed 0: a pair of equal
frequencies counts once, or twice; rpm,n0,n1 names columns by nodal diameters.
The calibrated scene is fitted-scene.json.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
    #[arg(help = const { words("fit", "measured") })]
    measured: Option<PathBuf>,
    #[arg(long, value_name = "PATH[=FROM..TO]",
        help = const { words("fit", "free") })]
    free: Vec<String>,
    #[arg(long, value_name = "RPM", allow_hyphen_values = true, value_parser = rpm,
        help = const { words("fit", "to_rpm") })]
    to: Option<f64>,
    #[arg(long,
        value_name = "SHARE",
        default_value_t = 0.95,
        allow_hyphen_values = true, value_parser = share,
        help = const { words("fit", "confidence") })]
    confidence: f64,
    #[arg(long, value_name = "COUNT", default_value_t = 12, value_parser = count::<usize>,
        help = const { words("fit", "starts") })]
    starts: usize,
    #[command(flatten)]
    page: Page,
}

/// Largest size and encodings of a table of frequencies, which usually has the length of a page.
const TABLE: Kind = Kind {
    limit: 1 << 20,
    other_encodings: OtherEncodings::AsLatin1,
};

/// Fits a saw to measured frequencies, writes the files and prints the table.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = arguments.common.scene()?;
    let measurement = measurement(arguments, &scene)?;
    let options = Options {
        confidence: arguments.confidence,
        starts: arguments.starts,
        to_rpm: arguments.to.unwrap_or(f64::INFINITY),
        ..Options::default()
    }
    .checked(&measurement)
    .map_err(of_option)?;
    let freed = Freed::to_fit(&scene, &named_bounds(&arguments.free)?)?;
    arguments.page.tried()?;
    let folder = arguments.common.folder()?;
    let report = watched(|progress| {
        let starts = |done, of| progress.show("starts", done, of);
        fit(&scene, &measurement, &freed, &options, &starts)
    })??;
    let fitted = serde_json::to_string_pretty(&report.scene)?;
    let others = vec![("fitted-scene.json", Some(fitted.into_bytes()))];
    let output = &arguments.common.output;
    output.report(&folder, &arguments.page, &report, others)
}

/// The frequencies of the table, or those of the scene.
fn measurement(arguments: &Arguments, scene: &Scene) -> anyhow::Result<Measurement> {
    let Some(path) = &arguments.measured else {
        return Ok(Measurement::of_scene(scene.needed_measured()?));
    };
    let text = read_text(path, TABLE)?;
    let name = path.file_name().unwrap_or(path.as_os_str());
    Measurement::from_csv(&name.to_string_lossy(), &text)
        .map_err(|error| refused(path, error.into()))
}
