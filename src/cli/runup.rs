//! `sawflutter runup`.

use std::fmt::Write;

use crate::report::{InstabilityKind, RunUpReport};
use crate::transient::{LINEAR_THICKNESSES, RunningUp};
use anyhow::bail;
use clap::Args;

use super::common::{Common, progress_bar, show};
use super::paste::runup_block;
use super::pictures::drawn;
use super::summary::{WIDTH, shortened, wrapped};

pub const EXAMPLES: &str = "\
Examples:
  sawflutter runup                           the built-in saw, 0 to 4000 rpm
  sawflutter runup my-saw.json --out runup   your own saw
  sawflutter runup --json | jq '.bands[]'    for scripts

Speeds, duration and force are the scene's `runup`, the probe its `probe`.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
}

/// Computes a run-up, writes the files and prints the summary.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = arguments.common.scene()?;
    let Some(runup) = &scene.runup() else {
        // By itself, for the words of an error are one line.
        eprintln!("{}\n", runup_block(scene.file()));
        bail!(
            "runup is missing, but must say from and to which speed, in which time and under which force; paste the block above behind the first brace of the scene and put in your own numbers"
        );
    };
    let folder = arguments.common.folder()?;
    let bar = progress_bar("steps");
    let found = RunningUp::new(&scene, runup, &|done, of| show(&bar, done, of))?;
    bar.finish_and_clear();
    let report = RunUpReport::new(&found);
    let json = serde_json::to_string_pretty(&report)?;
    let mut files = drawn(&report)?;
    files.push(("runup.json", json.clone().into_bytes()));
    arguments
        .common
        .print(&folder, &files, &[], &json, || summary(&report))
}

fn summary(report: &RunUpReport) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = of_report(&mut text, report);
    text
}

fn of_report(text: &mut String, report: &RunUpReport) -> std::fmt::Result {
    writeln!(text, "{}", shortened(&report.scene.name, WIDTH))?;
    writeln!(text, "{}", wrapped(&verdict(report)))?;
    if report.bands.is_empty() {
        writeln!(text, "No instability: stable at every speed of the run-up")?;
    } else {
        bands(text, report)?;
    }
    for warning in &report.warnings {
        writeln!(text, "{}", wrapped(&format!("Warning: {warning}")))?;
    }
    Ok(())
}

/// How far the run-up stays within the model, and the largest deflection up to there.
fn verdict(report: &RunUpReport) -> String {
    let end = match report.linear_until_rpm {
        None => "within the linear model".to_owned(),
        Some(rpm) => format!(
            "valid up to about {:.0} rpm, where the deflection at the probe exceeds {LINEAR_THICKNESSES} thicknesses of the blade ({:.1} mm) and the linear model ends",
            10.0 * (0.1 * rpm).round(),
            1e3 * report.linear_limit_m
        ),
    };
    let largest = report.deflection_m.iter().map(|w| w.abs());
    let largest = largest.zip(&report.rpm).max_by(|x, y| x.0.total_cmp(&y.0));
    let (w, at) = largest.unwrap_or((0.0, &report.from_rpm));
    format!(
        "Run-up from {:.0} to {:.0} rpm at {:.1} rpm/s: {end}; largest deflection {:.2} mm, at {at:.0} rpm",
        report.from_rpm,
        report.to_rpm,
        report.rate_rpm_per_s,
        1e3 * w
    )
}

fn bands(text: &mut String, report: &RunUpReport) -> std::fmt::Result {
    writeln!(
        text,
        "\nInstabilities        from         to     time  exponent  amplification"
    )?;
    writeln!(
        text,
        "                    [rpm]      [rpm]      [s]  ∫Re λ dt  predicted  simulated"
    )?;
    for entry in &report.bands {
        let kind = match entry.band.kind {
            InstabilityKind::Divergence => "divergence",
            InstabilityKind::Flutter => "flutter",
        };
        writeln!(
            text,
            "  {kind:<12} {:>10.1} {:>10.1} {:>8.2} {:>9.3} {:>10} {:>10}",
            entry.band.from_rpm,
            entry.band.to_rpm,
            entry.time_s,
            entry.growth_exponent,
            times(entry.growth_exponent.exp()),
            entry.seen_amplification.map_or("-".into(), times)
        )?;
    }
    Ok(())
}

/// What multiplies a motion by more leaves the linear model however small it was.
const MOST_TIMES: f64 = 1e3;

fn times(factor: f64) -> String {
    match factor <= MOST_TIMES {
        true => format!("{factor:.2} x"),
        false => format!("> {MOST_TIMES:.0} x"),
    }
}
