//! `sawflutter fit`.

use std::path::PathBuf;

use crate::fit::{Compared, Fit, Measurement, Options};
use crate::report::FitReport;
use crate::scene::{Freed, Scene};
use crate::text::{Kind, OtherEncodings};
use anyhow::{Context, bail};
use clap::Args;

use super::common::{Common, progress_bar, read_text, refused, show};
use super::free::{freed, number};
use super::pictures::drawn;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter fit --to-rpm 1250            the built-in saw to its own table
  sawflutter fit my-saw.json measured.csv radius and stiffness of every guide
  sawflutter fit my-saw.json measured.csv \\
    --free guides[0].radius_m=0.15..0.3 --free blade.material.density_kg_per_m3

measured.csv: a speed in rpm, then frequencies in Hz, ascending; blank where a
mode was not seen. They are held against the lowest computed ones. A first line
like rpm,f1,f2 names the columns, in any order; semicolons with decimal commas
and tabs are read too.
The calibrated scene is fitted-scene.json.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
    /// Table of measured frequencies; the scene's own without it
    measured: Option<PathBuf>,
    /// A number to fit, by its path in the scene, and its bounds; more than once for more.
    /// Without any: radius and stiffness of every guide, and angles between several
    #[arg(long, value_name = "PATH[=FROM..TO]")]
    free: Vec<String>,
    /// Leave out measurements above this speed
    #[arg(long, value_name = "RPM", allow_negative_numbers = true)]
    to_rpm: Option<f64>,
    /// Probability with which the intervals cover the truth
    #[arg(
        long,
        value_name = "SHARE",
        default_value_t = 0.95,
        allow_negative_numbers = true
    )]
    confidence: f64,
    /// Starts: the scene's numbers, and others spread between the bounds
    #[arg(long, value_name = "COUNT", default_value_t = 12)]
    starts: usize,
    /// Spreads the starts in another way
    #[arg(long, value_name = "NUMBER", default_value_t = 0)]
    seed: u64,
}

/// More starts than these never found anything new.
const MAX_STARTS: usize = 1000;
/// As for scenes; a table of frequencies is a page.
const TABLE: Kind = Kind {
    limit: 1 << 20,
    other_encodings: OtherEncodings::AsLatin1,
};

/// Fits a saw to measured frequencies, writes the files and prints the table.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = arguments.common.scene()?;
    let to_rpm = match arguments.to_rpm {
        Some(rpm) => number("--to-rpm", rpm, (0.0, 1e9))?,
        None => f64::INFINITY,
    };
    let options = Options {
        to_rpm,
        ..options(arguments)?
    };
    let measurement = measurement(arguments, &scene)?;
    if measurement.up_to(to_rpm).count() == 0 {
        bail!(
            "no frequency of {} is left to fit; give a table with some, or another --to-rpm",
            measurement.source
        );
    }
    let usual = Freed::usual_to_fit(scene.file());
    let freed = freed(&scene, &arguments.free, &usual)?;
    let folder = arguments.common.folder()?;
    let bar = progress_bar("starts");
    let fit = Fit::new(&scene, &measurement, &freed, &options, &|done, of| {
        show(&bar, done, of);
    })?;
    bar.finish_and_clear();
    let report = FitReport::new(&fit, &Compared::new(&fit)?);
    let json = serde_json::to_string_pretty(&report)?;
    let mut files = drawn(&report)?;
    let fitted = serde_json::to_string_pretty(&report.scene)?;
    files.push(("fitted-scene.json", fitted.into_bytes()));
    files.push(("fit.json", json.clone().into_bytes()));
    arguments
        .common
        .print(&folder, &files, &[], &json, || report.summary())
}

fn options(arguments: &Arguments) -> anyhow::Result<Options> {
    if !(arguments.confidence > 0.0 && arguments.confidence < 1.0) {
        bail!(
            "--confidence is {}, but must be between 0 and 1; 0.95 is usual",
            arguments.confidence
        );
    }
    if !(1..=MAX_STARTS).contains(&arguments.starts) {
        bail!(
            "--starts is {}, but must be from 1 to {MAX_STARTS}; a dozen is usual",
            arguments.starts
        );
    }
    Ok(Options {
        confidence: arguments.confidence,
        starts: arguments.starts,
        seed: arguments.seed,
        ..Options::default()
    })
}

fn measurement(arguments: &Arguments, scene: &Scene) -> anyhow::Result<Measurement> {
    let Some(path) = &arguments.measured else {
        let own = scene.file().measured.as_ref().context(
            "measured is missing, but must say what was measured; give a table after the scene, or write it into the scene",
        )?;
        return Ok(Measurement::of_scene(own));
    };
    let text = read_text(path, TABLE)?;
    let name = path.file_name().unwrap_or(path.as_os_str());
    Measurement::from_csv(&name.to_string_lossy(), &text)
        .map_err(|error| refused(path, error.into()))
}
