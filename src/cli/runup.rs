//! `sawflutter runup`.

use std::fmt::Write;

use crate::figure;
use crate::report::{InstabilityKind, RunUpReport};
use crate::transient::RunningUp;
use anyhow::bail;
use clap::Args;
use rayon::prelude::*;

use super::common::{Common, NamedFile, progress_bar, show};
use super::summary::wrapped;

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
        bail!(
            "runup is missing, but must say from and to which speed, in which time and under which force; add it to the scene: `sawflutter schema` prints its keys"
        );
    };
    let folder = arguments.common.folder()?;
    let bar = progress_bar("steps");
    let found = RunningUp::new(&scene, runup, &|done, of| show(&bar, done, of))?;
    bar.finish_and_clear();
    let report = RunUpReport::new(&scene, runup, &found)?;
    let json = serde_json::to_string_pretty(&report)?;
    let mut files = figures(&report)?;
    files.push(("runup.json", json.clone().into_bytes()));
    arguments
        .common
        .print(&folder, &files, &[], &json, || summary(&report))
}

fn figures(report: &RunUpReport) -> Result<Vec<NamedFile>, figure::FigureError> {
    type Draw = fn(&RunUpReport) -> Result<Vec<u8>, figure::FigureError>;
    let all: [(&'static str, Draw); 4] = [
        ("runup.png", figure::runup_png),
        ("runup.svg", |r| Ok(figure::runup_svg(r)?.into_bytes())),
        ("response-map.png", figure::response_map_png),
        ("response-map.svg", |r| {
            Ok(figure::response_map_svg(r)?.into_bytes())
        }),
    ];
    all.into_par_iter()
        .map(|(name, draw)| Ok((name, draw(report)?)))
        .collect()
}

fn summary(report: &RunUpReport) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = of_report(&mut text, report);
    text
}

fn of_report(text: &mut String, report: &RunUpReport) -> std::fmt::Result {
    writeln!(text, "{}", report.scene.name)?;
    let largest = report.deflection_m.iter().map(|w| w.abs());
    let largest = largest.zip(&report.rpm).max_by(|x, y| x.0.total_cmp(&y.0));
    if let (Some(first), Some(last), Some((w, at))) =
        (report.rpm.first(), report.rpm.last(), largest)
    {
        writeln!(
            text,
            "Run-up from {first:.0} to {last:.0} rpm at {:.1} rpm/s; the probe sees {:.2} mm at most, at {at:.0} rpm",
            report.rate_rpm_per_s,
            1e3 * w
        )?;
    }
    if report.bands.is_empty() {
        return writeln!(text, "No instability: stable at every speed of the run-up");
    }
    writeln!(
        text,
        "\nInstabilities        from         to     time   growth   at most      seen"
    )?;
    writeln!(
        text,
        "                    [rpm]      [rpm]      [s]  ∫Re λ dt    growth  amplified"
    )?;
    for entry in &report.bands {
        let kind = match entry.band.kind {
            InstabilityKind::Divergence => "divergence",
            InstabilityKind::Flutter => "flutter",
        };
        writeln!(
            text,
            "  {kind:<12} {:>10.1} {:>10.1} {:>8.2} {:>9.3} {:>9} {:>10}",
            entry.band.from_rpm,
            entry.band.to_rpm,
            entry.time_s,
            entry.growth_exponent,
            times(entry.growth_exponent.exp()),
            entry.seen_amplification.map_or("-".into(), times)
        )?;
    }
    for warning in &report.warnings {
        writeln!(text, "{}", wrapped(&format!("Warning: {warning}")))?;
    }
    Ok(())
}

fn times(factor: f64) -> String {
    if factor < 1e4 {
        format!("{factor:.2} x")
    } else {
        format!("{factor:.0e} x")
    }
}
