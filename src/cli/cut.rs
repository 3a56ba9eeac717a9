//! `sawflutter cut`.

use std::fmt::Write;

use crate::report::{CutCriterion, CutReport, CutRunEntry, Verdict};
use crate::scene::CutRun;
use crate::transient::Cutting;
use anyhow::bail;
use clap::Args;

use super::common::{Common, progress_bar, show};
use super::paste::cut_block;
use super::pictures::{drawn, figure_names};
use super::summary::{WIDTH, shortened, wrapped};

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
        // By itself, for the words of an error are one line.
        eprintln!("{}\n", cut_block(scene.file()));
        bail!(
            "cut is missing, but must say which forces act on the teeth; paste the block above behind the first brace of the scene and put in the numbers of your wood"
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
    let report = CutReport::new(&cutting);
    let json = serde_json::to_string_pretty(&report)?;
    let mut files = drawn(&report)?;
    files.push(("cut.json", json.clone().into_bytes()));
    arguments
        .common
        .print(&folder, &files, &figure_names::<CutReport>(), &json, || {
            summary(&report)
        })
}

fn summary(report: &CutReport) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = of_report(&mut text, report);
    text
}

fn of_report(text: &mut String, report: &CutReport) -> std::fmt::Result {
    writeln!(text, "{}", shortened(&report.scene.name, WIDTH))?;
    for run in &report.runs {
        writeln!(text, "{}", wrapped(&in_one_line(run)))?;
    }
    for run in &report.runs {
        of_run(text, run)?;
    }
    if !report.warnings.is_empty() {
        writeln!(text)?;
    }
    for warning in &report.warnings {
        writeln!(text, "{}", wrapped(&format!("Note: {warning}")))?;
    }
    Ok(())
}

/// The verdict of a speed.
fn in_one_line(run: &CutRunEntry) -> String {
    let decisive = run.criteria.iter().find(|c| c.criterion == run.decided_by);
    let Some(entry) = decisive.filter(|entry| entry.verdict == Verdict::Unstable) else {
        return format!("{} rpm: stable", run.rpm);
    };
    let frequency = match entry.frequency_hz {
        Some(hz) if hz > 0.0 => format!(" at {hz:.2} Hz"),
        Some(_) => " without oscillation".into(),
        None => String::new(),
    };
    format!(
        "{} rpm: UNSTABLE, growth of {:.3} 1/s{frequency} ({})",
        run.rpm, entry.growth_per_s, entry.criterion
    )
}

fn of_run(text: &mut String, run: &CutRunEntry) -> std::fmt::Result {
    let forces = format!(
        "{} rpm, on each tooth {} N against the rotation, {} N inwards, {} N across",
        run.rpm,
        run.tangential_n_per_tooth.round(),
        run.radial_n_per_tooth.round(),
        run.lateral_n_per_tooth
    );
    writeln!(text, "\n{}", wrapped(&forces))?;
    writeln!(text, "                              growth  frequency")?;
    writeln!(text, "                               [1/s]       [Hz]")?;
    for entry in &run.criteria {
        let hertz = entry.frequency_hz;
        writeln!(
            text,
            "  {:<25} {:>9.3} {:>10}  {}{}",
            entry.criterion.to_string(),
            entry.growth_per_s,
            hertz.map_or("-".into(), |hz| format!("{hz:.2}")),
            in_capitals(entry.verdict),
            remark(run, entry.criterion)
        )?;
    }
    writeln!(text, "  {}", deflections(run))
}

fn in_capitals(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Stable => "stable",
        Verdict::Unstable => "UNSTABLE",
    }
}

/// What is to be said beside a criterion.
fn remark(run: &CutRunEntry, criterion: CutCriterion) -> String {
    match criterion {
        CutCriterion::TimeHistory => match run.agree {
            Some(true) => ", agrees".into(),
            _ => ", DISAGREES".into(),
        },
        CutCriterion::MovingToothLoads => {
            let per_second = run.tooth_passing.tooth_frequency_hz;
            format!(", {per_second:.0} teeth/s")
        }
        CutCriterion::SplineReaction => run.spline.as_ref().map_or(String::new(), |spline| {
            format!(", K_e changes by {:.0} %", 1e2 * spline.stiffness_change)
        }),
        CutCriterion::Eigenvalues | CutCriterion::OutOfCut => String::new(),
    }
}

fn deflections(run: &CutRunEntry) -> String {
    let millimetres = |metres: f64| format!("{:.2} mm", 1e3 * metres);
    let (in_cut, after) = (
        run.largest_deflection_in_cut_m.map(millimetres),
        run.largest_deflection_after_m.map(millimetres),
    );
    let probe = "largest deflection at the probe:";
    match (in_cut, after) {
        (Some(in_cut), Some(after)) => format!("{probe} {in_cut} in the cut, {after} after it"),
        (Some(in_cut), None) => {
            format!("{probe} {in_cut} in the cut; after it the linear model ends")
        }
        (None, _) => "the deflection in the cut leaves the linear model".into(),
    }
}
