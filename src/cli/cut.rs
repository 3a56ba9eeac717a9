//! `sawflutter cut`.

use std::fmt::Write;

use crate::figure;
use crate::report::{CutReport, CutRunEntry, Verdict};
use crate::scene::CutRun;
use crate::transient::Cutting;
use anyhow::bail;
use clap::Args;
use rayon::prelude::*;

use super::common::{Common, NamedFile, progress_bar, show};
use super::summary::wrapped;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter cut                                 the built-in saw, two speeds
  sawflutter cut my-saw.json --rpm 2400          your own saw at another speed
  sawflutter cut --json | jq '.runs[].verdict'   for scripts

The forces are the scene's `cut`; `sawflutter schema` says what it may contain.";

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    common: Common,
    /// Speed to cut at, in place of the scene's; may be given more than once
    #[arg(long, value_name = "RPM", allow_negative_numbers = true)]
    rpm: Vec<f64>,
}

/// Computes a cut, writes the files and prints the summary.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = arguments.common.scene()?;
    let Some(cut) = &scene.cut() else {
        bail!(
            "cut is missing, but must say which forces act on the teeth; add it to the scene: `sawflutter schema` prints its keys"
        );
    };
    let asked = arguments.rpm.iter().map(|rpm| cut.at_rpm(*rpm));
    let asked = asked.collect::<Result<Vec<CutRun>, _>>()?;
    let runs = if asked.is_empty() { &cut.runs } else { &asked };
    if runs.is_empty() {
        bail!(
            "cut.speeds is missing, but must name a speed to cut at; add it or operating_rpm to the scene, or give --rpm"
        );
    }
    let folder = arguments.common.folder()?;
    let bar = progress_bar("points of the map");
    let cutting = Cutting::new(&scene, cut, runs, &|done, of| show(&bar, done, of))?;
    bar.finish_and_clear();
    let report = CutReport::new(&scene, &cutting);
    let json = serde_json::to_string_pretty(&report)?;
    let mut files = figures(&report)?;
    if let Some(png) = figure::spline_orbit_png(&report)? {
        files.push((OPTIONAL[0], png));
    }
    if let Some(svg) = figure::spline_orbit_svg(&report)? {
        files.push((OPTIONAL[1], svg.into_bytes()));
    }
    files.push(("cut.json", json.clone().into_bytes()));
    arguments
        .common
        .print(&folder, &files, &OPTIONAL, &json, || summary(&report))
}

/// Figures that not every scene has.
const OPTIONAL: [&str; 2] = ["spline-orbit.png", "spline-orbit.svg"];

fn figures(report: &CutReport) -> Result<Vec<NamedFile>, figure::FigureError> {
    type Draw = fn(&CutReport) -> Result<Vec<u8>, figure::FigureError>;
    let all: [(&'static str, Draw); 4] = [
        ("cut.png", figure::cut_png),
        ("cut.svg", |r| Ok(figure::cut_svg(r)?.into_bytes())),
        ("cut-map.png", figure::cut_map_png),
        ("cut-map.svg", |r| Ok(figure::cut_map_svg(r)?.into_bytes())),
    ];
    all.into_par_iter()
        .map(|(name, draw)| Ok((name, draw(report)?)))
        .collect()
}

fn summary(report: &CutReport) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{}", report.scene.name);
    for run in &report.runs {
        let _ = of_run(&mut text, run);
    }
    for warning in &report.warnings {
        let _ = writeln!(text, "{}", wrapped(&format!("Note: {warning}")));
    }
    text
}

fn of_run(text: &mut String, run: &CutRunEntry) -> std::fmt::Result {
    let word = |verdict: Verdict| match verdict {
        Verdict::Stable => "stable",
        Verdict::Unstable => "UNSTABLE",
    };
    writeln!(
        text,
        "\n{:.0} rpm, {} N against, {} N inwards, {} N across on each tooth: {}",
        run.rpm,
        run.tangential_n_per_tooth.round(),
        run.radial_n_per_tooth.round(),
        run.lateral_n_per_tooth,
        word(run.verdict)
    )?;
    let hertz = |value: Option<f64>| value.map_or("-".into(), |hz| format!("{hz:.2} Hz"));
    writeln!(
        text,
        "  eigenvalues   {:>9.3} 1/s {:>10}",
        run.growth_per_s,
        hertz(run.frequency_hz.filter(|_| run.growth_per_s > 0.0))
    )?;
    if let (Some(verdict), Some(growth)) = (run.transient_verdict, run.transient_growth_per_s) {
        writeln!(
            text,
            "  time history  {growth:>9.3} 1/s {:>10}  {}, {}",
            hertz(run.transient_frequency_hz),
            word(verdict),
            if run.agree == Some(true) {
                "agrees"
            } else {
                "DISAGREES"
            }
        )?;
    }
    let passing = &run.tooth_passing;
    writeln!(
        text,
        "  passing teeth {:>9.3} 1/s {:>10.0} Hz tooth passing frequency",
        passing.passing_growth_per_s, passing.tooth_frequency_hz
    )?;
    writeln!(
        text,
        "  without them  {:>9.3} 1/s             {}",
        run.idle_growth_per_s,
        word(run.idle_verdict)
    )?;
    if let Some(spline) = &run.spline {
        writeln!(
            text,
            "  spline's own reaction {:.3} 1/s: {}; it changes K_e by {:.0} %",
            spline.growth_per_s,
            word(spline.verdict),
            1e2 * spline.stiffness_change
        )?;
    }
    writeln!(
        text,
        "  largest deflection at the probe: {:.2} mm in the cut, {:.2} mm after it",
        1e3 * run.largest_deflection_in_cut_m,
        1e3 * run.largest_deflection_after_m
    )
}
