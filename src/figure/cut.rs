//! The deflection before, during and after the cut, one panel for each speed, as in the paper's Figures 16
//! and 17.

use super::axis::{Axis, draw_named, draw_vertical, two_digits};
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::clip::draw_inside;
use super::columns::{Columns, draw_end_of_model, label_end_of_model, name_of_row};
use super::heading::of_saw;
use super::style::{
    ALARM, CURVE, FINE_DASH, FLUTTER, FLUTTER_SHADE, FORWARD, HAIRLINE, LABEL_SIZE, QUIET,
    SUBTITLE_SIZE, broken, tint,
};
use crate::analyses::cut::{CutAtSpeed, CutCriterion, CutFinding, CutReport, CutVerdict};
use crate::report::Verdict;

/// Distance of successive lines of facts.
const LINE: f64 = 16.0;
const PANELS: Columns = Columns {
    lefts: [92.0, 680.0],
    top: 136.0,
    width: 488.0,
    alone: 1076.0,
    height: 330.0,
    row: 470.0,
};

pub fn sheet(report: &CutReport) -> Sheet {
    let title = "Deflection at the probe before, during and after the cut";
    let panels = report.runs.len();
    let mut sheet = PANELS.sheet(
        panels,
        title,
        &of_saw(&report.scene.name, &report.condition),
    );
    let scale = Scale::of(&report.runs);
    for (index, run) in report.runs.iter().enumerate() {
        let name = name_of_row(index, &scale.name);
        draw_run(
            &mut sheet,
            (&PANELS.panel(index, panels), name),
            run,
            &scale,
        );
    }
    sheet
}

/// The axis of deflections, common to all panels for comparison.
struct Scale {
    /// Name with unit.
    name: String,
    /// Factor from metres to the unit of the axis.
    per_metre: f64,
    /// End of the axis on either side of zero, in its unit.
    reach: f64,
}

impl Scale {
    fn of(runs: &[CutAtSpeed]) -> Self {
        let largest_m = runs.iter().map(largest_m).fold(0.0, f64::max);
        let (unit, per_metre) = unit_of(largest_m);
        let reach = match largest_m > 0.0 {
            // Deflections below a nanometre have no meaning, and their ticks would have too many digits.
            true => 1.12 * per_metre * largest_m.max(1e-9),
            false => 1.0,
        };
        Scale {
            name: format!("deflection\u{2003}[{unit}]"),
            per_metre,
            reach,
        }
    }
}

fn largest_m(run: &CutAtSpeed) -> f64 {
    let sizes = run.deflection_m.iter().map(|w| w.abs());
    sizes.fold(0.0, f64::max)
}

/// Name of a unit in which a length has few digits, and factor from metres to this unit.
fn unit_of(largest_m: f64) -> (&'static str, f64) {
    match largest_m {
        w if w >= 1e-5 || w == 0.0 => ("mm", 1e3),
        w if w >= 1e-8 => ("µm", 1e6),
        _ => ("nm", 1e9),
    }
}

fn draw_run(sheet: &mut Sheet, (panel, name): (&Frame, &str), run: &CutAtSpeed, scale: &Scale) {
    let end_s = run.forces_to_s + run.forces_from_s;
    let time = Axis::linear([0.0, end_s], panel.across());
    let deflection = Axis::linear([-scale.reach, scale.reach], panel.upwards());
    draw_ground(sheet, panel, run, &time);
    draw_vertical(sheet, &deflection, panel, name);
    sheet.vertical(panel.left, panel, Stroke::solid(QUIET, HAIRLINE));
    draw_named(sheet, &time, panel.bottom, "time\u{2003}[s]");
    let place = |t: f64, w: f64| [time.at(t), deflection.at(scale.per_metre * w)];
    // Stretching limits the growth, so that an exponential envelope would be wrong.
    if run.stretching.is_none() {
        draw_envelope(sheet, panel, run, place);
    }
    let record = run.time_s.iter().zip(&run.deflection_m);
    let places: Vec<[f64; 2]> = record.map(|(t, w)| place(*t, *w)).collect();
    draw_inside(sheet, panel, &places, Stroke::solid(FORWARD, CURVE));
    if let Some(until_s) = run.ends_s() {
        let x = time.at(until_s);
        draw_end_of_model(sheet, panel, x);
        let label = match run.stretching {
            Some(_) => "the model ends",
            None => "the linear model ends",
        };
        label_end_of_model(sheet, panel, x, label);
    }
    draw_verdict(sheet, panel, run);
}

/// A length in a unit in which it has few digits.
fn length(metres: f64) -> String {
    let (unit, per_metre) = unit_of(metres);
    format!("{} {unit}", two_digits(per_metre * metres))
}

/// Shades the time of the cut in the colour of the verdict.
fn draw_ground(sheet: &mut Sheet, panel: &Frame, run: &CutAtSpeed, time: &Axis) {
    let in_cut = panel.between([run.forces_from_s, run.forces_to_s].map(|s| time.at(s)));
    let shade = match run.verdict {
        CutVerdict::Unstable | CutVerdict::LeavesModel | CutVerdict::AtCritical => FLUTTER_SHADE,
        CutVerdict::Stable => tint(FORWARD, 0.12),
    };
    sheet.fill(in_cut, shade);
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Middle);
    // If the model ends during the cut, a vertical line is drawn there, and the text is on the side of the
    // line with more room.
    let end = run.ends_s().map_or(in_cut.right, |s| time.at(s));
    let end = end.clamp(in_cut.left, in_cut.right);
    let free = match end - in_cut.left < in_cut.right - end {
        true => [end, in_cut.right],
        false => [in_cut.left, end],
    };
    let label = [(free[0] + free[1]) / 2.0, panel.top + 16.0];
    sheet.text(label, letters, "in the cut");
}

/// Draws the exponential growth by the eigenvalues through the largest deflection in the cut, with both signs if the
/// motion oscillates. A stable cut has no envelope.
fn draw_envelope(
    sheet: &mut Sheet,
    panel: &Frame,
    run: &CutAtSpeed,
    place: impl Fn(f64, f64) -> [f64; 2],
) {
    let grows = |c: &&CutFinding| {
        c.criterion == CutCriterion::Eigenvalues && c.verdict == Verdict::Unstable
    };
    let Some(eigenvalue) = run.criteria.iter().find(grows) else {
        return;
    };
    let in_cut = |t: &f64| (run.forces_from_s..=run.forces_to_s).contains(t);
    let record = run.time_s.iter().zip(&run.deflection_m);
    let peak = record
        .filter(|(t, _)| in_cut(t))
        .max_by(|x, y| x.1.abs().total_cmp(&y.1.abs()));
    let Some((peak_s, peak_m)) = peak else {
        return;
    };
    let signs: &[f64] = match eigenvalue.frequency_hz {
        Some(hz) if hz > 0.0 => &[1.0, -1.0],
        _ => &[1.0],
    };
    let end_s = run.linear_until_s.unwrap_or(run.forces_to_s);
    for sign in signs {
        let places: Vec<[f64; 2]> = (0..=60)
            .map(|k| {
                let share = f64::from(k) / 60.0;
                let t =
                    run.forces_from_s + share * (end_s.min(run.forces_to_s) - run.forces_from_s);
                let growth = (eigenvalue.growth_per_s * (t - peak_s)).exp();
                place(t, sign * peak_m * growth)
            })
            .collect();
        let dashed = Stroke::dashed(FLUTTER, CURVE, FINE_DASH);
        draw_inside(sheet, panel, &places, dashed);
    }
}

/// Writes verdict and facts above the panel.
fn draw_verdict(sheet: &mut Sheet, panel: &Frame, run: &CutAtSpeed) {
    let verdict = format!("{} rpm: {}", run.rpm, run.verdict);
    let (text, colour) = match run.verdict {
        CutVerdict::Stable => (verdict, FORWARD),
        CutVerdict::LeavesModel | CutVerdict::AtCritical => (verdict, ALARM),
        CutVerdict::Unstable => (format!("{verdict} ({})", run.decided_by), ALARM),
    };
    let title = Lettering::title(SUBTITLE_SIZE + 2.0, colour);
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start);
    let lines = broken(&facts(run), panel.right - panel.left + 20.0);
    let mut baseline = panel.top - 12.0;
    for line in lines.iter().rev() {
        sheet.text([panel.left, baseline], letters, line);
        baseline -= LINE;
    }
    sheet.text([panel.left, baseline + LINE - 20.0], title, &text);
}

/// The largest deflection, and the growth rate of each criterion.
fn facts(run: &CutAtSpeed) -> String {
    // A growth rate that is rounded to zero is written without a sign.
    let growth = |value: f64| if value.abs() < 5e-3 { 0.0 } else { value };
    let criteria = run.criteria.iter().map(|entry| {
        let name = entry.criterion;
        // Lines are broken at ordinary spaces only; no-break spaces keep each criterion on one line.
        format!("{name} {:.2}", growth(entry.growth_per_s)).replace(' ', "\u{a0}")
    });
    let with = match run.stretching {
        Some(_) => "with stretching, largest",
        None => "largest",
    };
    format!(
        "{with} {}; {}\u{a0}1/s",
        length(largest_m(run)),
        criteria.collect::<Vec<_>>().join(", ")
    )
}
