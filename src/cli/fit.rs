//! `sawflutter fit`.

use std::fmt::Write;
use std::path::PathBuf;

use crate::fit::{Compared, Fit, Measurement, Options};
use crate::report::{FitReport, ParameterEntry};
use crate::scene::{Freed, Scene};
use crate::text::{Kind, OtherEncodings};
use anyhow::{Context, bail};
use clap::Args;

use super::common::{Common, progress_bar, read_text, refused, show};
use super::free::{freed, number};
use super::pictures::drawn;
use super::summary::wrapped;

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
        .print(&folder, &files, &[], &json, || summary(&report))
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

fn summary(report: &FitReport) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = table(&mut text, report);
    text
}

fn table(text: &mut String, report: &FitReport) -> std::fmt::Result {
    writeln!(text, "{}", wrapped(&report.scene.name))?;
    writeln!(
        text,
        "{}",
        wrapped(&format!(
            "Fitted to {} frequencies ({}): {:.3} Hz rms, before {:.3} Hz",
            report.measured_frequencies, report.source, report.rms_hz, report.rms_before_hz
        ))
    )?;
    writeln!(
        text,
        "\n  {:<34} {:>10} {:>10}  {:.0} % interval",
        "",
        "before",
        "fitted",
        100.0 * report.confidence
    )?;
    for found in &report.parameters {
        let ParameterEntry {
            path, start, value, ..
        } = found;
        let interval = match (found.interval_from, found.interval_to) {
            (Some(from), Some(to)) => format!("{} … {}", short(from), short(to)),
            _ if found.at_bound => "at its bound".into(),
            _ => "not determined".into(),
        };
        writeln!(
            text,
            "  {path:<34} {:>10} {:>10}  {interval}",
            short(*start),
            short(*value)
        )?;
    }
    residuals(text, report)?;
    writeln!(text)?;
    let reached = |s: &&crate::report::StartEntry| s.rms_hz.is_some();
    let best = report
        .starts
        .iter()
        .filter_map(|s| s.rms_hz)
        .fold(f64::INFINITY, f64::min);
    let same = report
        .starts
        .iter()
        .filter(|s| s.rms_hz.is_some_and(|rms| rms <= 1.001 * best));
    writeln!(
        text,
        "{} of {} starts led to this minimum (n up to {}, {} polynomials over the radius)",
        same.count(),
        report.starts.iter().filter(reached).count(),
        report.max_diameters,
        report.radial_functions
    )?;
    for warning in &report.warnings {
        writeln!(text, "{}", wrapped(&format!("Warning: {warning}")))?;
    }
    Ok(())
}

/// Lines and columns of the table before the rest is only counted.
const ROWS: usize = 20;
const COLUMNS: usize = 7;

fn residuals(text: &mut String, report: &FitReport) -> std::fmt::Result {
    writeln!(
        text,
        "\nComputed minus measured frequency [Hz]\n     rpm    ascending"
    )?;
    let mut speeds: Vec<f64> = report.residuals.iter().map(|r| r.rpm).collect();
    speeds.dedup();
    for rpm in speeds.iter().take(ROWS) {
        let own = report.residuals.iter().filter(|r| r.rpm == *rpm);
        let mut line = format!("{rpm:>8.0}");
        let mut fitted = true;
        for r in own {
            if r.place <= COLUMNS {
                let _ = write!(line, " {:>8.2}", r.fitted_hz - r.measured_hz);
            }
            fitted &= r.fitted;
        }
        writeln!(text, "{line}{}", if fitted { "" } else { "  (not fitted)" })?;
    }
    match speeds.len().checked_sub(ROWS) {
        Some(rest) if rest > 0 => writeln!(text, "  … and {rest} more in fit.json"),
        _ => Ok(()),
    }
}

/// A number in ten columns.
fn short(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e6).contains(&size) {
        return format!("{value:.3e}");
    }
    let decimals = (4.0 - size.max(1e-3).log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{value:.decimals$}")
}
