//! The summary of a cut.

use std::fmt::Write;

use super::{decimals_or, each, heading, sentence};
use crate::analyses::cut::{CutAtSpeed, CutCriterion, CutReport, CutVerdict};
use crate::report::Verdict;
use crate::stability::CRITICAL_MARGIN;
use crate::stretched::LARGEST_SLOPE;
use crate::text::{fixed, shown_to};
use crate::transient::LINEAR_THICKNESSES;

pub fn of_report(text: &mut String, report: &CutReport) -> std::fmt::Result {
    heading(
        text,
        &report.scene.name,
        &report.condition,
        &report.unusual_numbers,
    )?;
    for run in &report.runs {
        sentence(text, &in_one_line(run, report.linear_limit_m))?;
    }
    for run in &report.runs {
        of_run(text, run, report.teeth)?;
    }
    if !report.warnings.is_empty() {
        writeln!(text)?;
    }
    each(text, "Note", &report.warnings)
}

/// The verdict at a speed; `linear_limit_m` is the largest deflection of the linear model.
fn in_one_line(run: &CutAtSpeed, linear_limit_m: f64) -> String {
    let (rpm, critical) = (run.rpm, run.at_critical_rpm);
    match run.verdict {
        CutVerdict::Stable => format!("{rpm} rpm: stable"),
        CutVerdict::AtCritical => format!(
            "{rpm} rpm: STABLE, but within {:.0} % of the critical speed{}",
            100.0 * CRITICAL_MARGIN,
            critical.map_or(String::new(), |critical| format!(" {critical:.1} rpm"))
        ),
        CutVerdict::LeavesModel if run.stretching.is_some() => format!(
            "{rpm} rpm: NO GROWTH, BUT THE DEFLECTION LEAVES THE MODEL: slopes of the blade exceed {LARGEST_SLOPE}, where the model with stretching ends"
        ),
        CutVerdict::LeavesModel => format!(
            "{rpm} rpm: NO GROWTH, BUT THE DEFLECTION LEAVES THE MODEL: it exceeds {LINEAR_THICKNESSES} thicknesses of the blade ({:.1} mm), more than any kerf",
            1e3 * linear_limit_m
        ),
        CutVerdict::Unstable => unstable(run),
    }
}

/// The verdict on an unstable cut: growth rate, frequency, and the criterion that decides.
fn unstable(run: &CutAtSpeed) -> String {
    let decisive = run.criteria.iter().find(|c| c.criterion == run.decided_by);
    let Some(entry) = decisive else {
        return format!("{} rpm: UNSTABLE", run.rpm);
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

fn of_run(text: &mut String, run: &CutAtSpeed, teeth: f64) -> std::fmt::Result {
    let forces = format!(
        "{} rpm, on each tooth {} N against the rotation, {} N inwards, {} N across ({} N in all)",
        run.rpm,
        run.tangential_n_per_tooth.round(),
        run.radial_n_per_tooth.round(),
        run.lateral_n_per_tooth,
        shown_to(3, teeth * run.lateral_n_per_tooth)
    );
    writeln!(text)?;
    sentence(text, &forces)?;
    writeln!(text, "                              growth  frequency")?;
    writeln!(text, "                               [1/s]       [Hz]")?;
    for entry in &run.criteria {
        writeln!(
            text,
            "  {:<25} {:>9} {:>10}  {}{}",
            entry.criterion.to_string(),
            fixed(3, entry.growth_per_s),
            decimals_or("-", 2, entry.frequency_hz),
            in_capitals(entry.verdict),
            remark(run, entry.criterion)
        )?;
    }
    writeln!(text, "  {}", deflections(run))?;
    if let Some(found) = &run.stretching {
        writeln!(
            text,
            "  slopes of the blade of {:.3} at most",
            found.largest_slope
        )?;
    }
    let statement = format!("  certificate: {}", run.certificate.statement);
    sentence(text, &statement)
}

fn in_capitals(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Stable => "stable",
        Verdict::Unstable => "UNSTABLE",
    }
}

/// Remark after the verdict of a criterion.
fn remark(run: &CutAtSpeed, criterion: CutCriterion) -> String {
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

/// Largest deflections at the probe in the cut and after it, in millimetres.
fn deflections(run: &CutAtSpeed) -> String {
    let millimetres = |metres: f64| format!("{:.2} mm", 1e3 * metres);
    let (in_cut, after) = (
        run.largest_deflection_in_cut_m.map(millimetres),
        run.largest_deflection_after_m.map(millimetres),
    );
    let (probe, model) = match run.stretching {
        Some(_) => (
            "with stretching, largest deflection at the probe:",
            "the model",
        ),
        None => ("largest deflection at the probe:", "the linear model"),
    };
    match (in_cut, after) {
        (Some(in_cut), Some(after)) => format!("{probe} {in_cut} in the cut, {after} after it"),
        (Some(in_cut), None) => {
            format!("{probe} {in_cut} in the cut; after it {model} ends")
        }
        (None, _) => format!("the deflection in the cut leaves {model}"),
    }
}
