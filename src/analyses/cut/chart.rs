//! The deflection before, during and after the cut, one panel for each speed, as in the paper's Figures 16
//! and 17.

use super::{CutAtSpeed, CutCriterion, CutFinding, CutReport, CutStability};
use crate::analyses::campbell::Verdict;
use crate::analyses::scene_number::FigureUnit;
use crate::page::figure::axis::two_digits;
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::heading;
use crate::page::figure::items::{Area, Item, Line, Role, Upright};
use crate::page::figure::palette::Hue;

/// Share of the colour of the time of a stable cut.
const STABLE_TINT: f64 = 0.12;
/// Height of a panel, relative to one of usual height.
const SHARE: f64 = 0.87;

/// The deflection over time at each speed, as numbers.
pub fn chart(report: &CutReport) -> ChartData {
    let scale = Scale::of(&report.runs);
    let panels = report.runs.iter().map(|run| panel(run, &scale)).collect();
    let facts = vec![heading::of_saw(&report.scene.name, &report.condition)];
    let title = "Deflection at the probe before, during and after the cut";
    ChartData {
        columns: 2,
        key: key(&report.runs),
        ..ChartData::new(title, facts, panels)
    }
}

/// The axis of deflections, common to all panels for comparison.
struct Scale {
    unit: &'static str,
    /// Factor from metres to the unit of the axis.
    per_metre: f64,
    /// End of the axis on either side of zero, in its unit.
    reach: f64,
}

impl Scale {
    fn of(runs: &[CutAtSpeed]) -> Self {
        let largest_m = runs.iter().map(largest_m).fold(0.0, f64::max);
        let FigureUnit {
            symbol: unit,
            factor: per_metre,
        } = unit_of(largest_m);
        let reach = if largest_m > 0.0 {
            // Deflections below a nanometre have no meaning, and their ticks would have too many digits.
            1.12 * per_metre * largest_m.max(1e-9)
        } else {
            1.0
        };
        Scale {
            unit,
            per_metre,
            reach,
        }
    }
}

fn largest_m(run: &CutAtSpeed) -> f64 {
    let sizes = run.deflection_m.iter().map(|w| w.abs());
    sizes.fold(0.0, f64::max)
}

/// A unit in which a length has few digits.
fn unit_of(largest_m: f64) -> FigureUnit {
    match largest_m {
        w if w >= 1e-5 || w == 0.0 => FigureUnit::new("mm", 1e3),
        w if w >= 1e-8 => FigureUnit::new("µm", 1e6),
        _ => FigureUnit::new("nm", 1e9),
    }
}

/// A length in a unit in which it has few digits.
fn length(metres: f64) -> String {
    let FigureUnit { symbol, factor } = unit_of(metres);
    format!("{} {symbol}", two_digits(factor * metres))
}

fn panel(run: &CutAtSpeed, scale: &Scale) -> PanelData {
    let end_s = run.forces_to_s + run.forces_from_s;
    let record = run.time_s.iter().zip(&run.deflection_m);
    let points = record.map(|(t, w)| [*t, scale.per_metre * w]);
    let mut items = vec![Item::Area(in_cut(run, scale.reach))];
    // Stretching limits the growth, so that an exponential envelope would be wrong.
    if run.stretching.is_none() {
        items.extend(envelope(run, scale));
    }
    items.push(Item::Line(Line::new(points, Hue::Forward, "deflection")));
    items.extend(end_of_model(run));
    let deflection = AxisData::new("deflection", scale.unit);
    PanelData {
        title: title(run),
        colour: match run.stability {
            CutStability::Stable => Hue::Forward,
            _ => Hue::Alarm,
        },
        facts: facts(run),
        share: SHARE,
        ..PanelData::new(
            AxisData::new("time", "s").within([0.0, end_s]),
            deflection.within([-scale.reach, scale.reach]),
            items,
        )
    }
}

/// The time of the cut, in the colour of its stability.
fn in_cut(run: &CutAtSpeed, reach: f64) -> Area {
    let (hue, tint, name) = match run.stability {
        CutStability::Stable => (Hue::Forward, STABLE_TINT, "in the cut, stable"),
        CutStability::Unstable | CutStability::LeavesModel | CutStability::AtCritical => {
            (Hue::FlutterShade, 1.0, "in the cut, not stable")
        }
    };
    let columns = [run.forces_from_s, run.forces_to_s].map(|s| [s, -reach, reach]);
    Area {
        tint,
        ..Area::new(columns, hue, name)
    }
}

fn end_of_model(run: &CutAtSpeed) -> Option<Item> {
    let name = match run.stretching {
        Some(_) => "the model ends",
        None => "the linear model ends",
    };
    Some(Item::Upright(Upright {
        x: run.ends_s()?,
        role: Role::Guide,
        colour: Hue::Alarm,
        dashed: false,
        label: String::new(),
        name: name.to_owned(),
    }))
}

/// The exponential growth by the eigenvalues through the largest deflection in the cut, with both signs if the motion
/// oscillates. A stable cut has no envelope.
fn envelope(run: &CutAtSpeed, scale: &Scale) -> Vec<Item> {
    let grows = |c: &&CutFinding| {
        c.criterion == CutCriterion::Eigenvalues && c.verdict == Verdict::Unstable
    };
    let in_cut = run.forces_from_s..=run.forces_to_s;
    let record = run.time_s.iter().zip(&run.deflection_m);
    let peak = record
        .filter(|(t, _)| in_cut.contains(t))
        .max_by(|x, y| x.1.abs().total_cmp(&y.1.abs()));
    let (Some(eigenvalue), Some((peak_s, peak_m))) = (run.criteria.iter().find(grows), peak) else {
        return Vec::new();
    };
    let signs: &[f64] = match eigenvalue.frequency_hz {
        Some(hz) if hz > 0.0 => &[1.0, -1.0],
        _ => &[1.0],
    };
    let end_s = run.linear_until_s.unwrap_or(run.forces_to_s);
    let length_s = end_s.min(run.forces_to_s) - run.forces_from_s;
    let lines = signs.iter().map(|sign| {
        let points = (0..=60).map(|k| {
            let t = run.forces_from_s + f64::from(k) / 60.0 * length_s;
            let growth = (eigenvalue.growth_per_s * (t - peak_s)).exp();
            [t, scale.per_metre * sign * peak_m * growth]
        });
        Item::Line(Line {
            dashed: true,
            ..Line::new(points, Hue::Flutter, "growth by the eigenvalues")
        })
    });
    lines.collect()
}

fn title(run: &CutAtSpeed) -> String {
    match run.stability {
        CutStability::Unstable => {
            format!("{} rpm: {} ({})", run.rpm, run.stability, run.decided_by)
        }
        stability => format!("{} rpm: {stability}", run.rpm),
    }
}

/// The largest deflection, and the growth rate of each criterion.
fn facts(run: &CutAtSpeed) -> Vec<String> {
    // A growth rate that is rounded to zero is written without a sign.
    let growth = |value: f64| if value.abs() < 5e-3 { 0.0 } else { value };
    let criteria = run.criteria.iter().map(|entry| {
        let name = entry.criterion;
        // Lines are broken at ordinary spaces only; no-break spaces keep each criterion on one line.
        format!("{name} {:.2}", growth(entry.growth_per_s)).replace(' ', "\u{a0}")
    });
    let with = match run.stretching {
        Some(_) => "with stretching, largest at the probe",
        None => "largest at the probe",
    };
    vec![
        format!("{with} {}", length(largest_m(run))),
        format!("{}\u{a0}1/s", criteria.collect::<Vec<_>>().join(", ")),
    ]
}

/// Samples of what the panels contain, each once.
fn key(runs: &[CutAtSpeed]) -> Vec<Item> {
    let mut samples: Vec<Item> = Vec::new();
    let areas = runs.iter().map(|run| Item::Area(in_cut(run, 1.0)));
    let ends = runs.iter().filter_map(end_of_model).map(|end| match end {
        Item::Upright(line) => Item::Upright(Upright { x: 0.0, ..line }),
        other => other,
    });
    let is_linear = |run: &&CutAtSpeed| run.stretching.is_none();
    let scale = Scale::of(runs);
    let envelopes = runs
        .iter()
        .filter(is_linear)
        .flat_map(|run| envelope(run, &scale));
    for item in areas.chain(envelopes).chain(ends) {
        let sample = item.sample();
        if !samples.contains(&sample) {
            samples.push(sample);
        }
    }
    samples
}
