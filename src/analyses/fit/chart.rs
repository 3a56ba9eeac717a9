//! Measured points over the fitted curves, and residuals.

use super::{FitReport, Residual};
use crate::analyses::scene_number::in_words;
use crate::page::figure::axis::round_up;
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::items::{Item, Line, Points, Shape};
use crate::page::figure::palette::Hue;
use crate::page::figure::style::{HAIRLINE, MEASURED_SIZE};

/// Shapes and colours of the residuals of modes by their nodal diameters n. Shapes distinguish the marks in grey prints.
const MODES: [(Shape, Hue, &str); 4] = [
    (Shape::Disc, Hue::Forward, "n = 0"),
    (Shape::Ring, Hue::Backward, "n = 1"),
    (Shape::Square, Hue::Divergence, "n = 2"),
    (Shape::Cross, Hue::Ink, "n ≥ 3"),
];
/// Number of residuals of a speed that are side by side; further ones begin again from the left.
const SIDE_BY_SIDE: usize = 4;
const RESIDUAL_SIZE: f64 = 6.4;
const LEFT_OUT_SIZE: f64 = 4.0;
/// Distance of the residuals of a speed, which are side by side so that none hides another, relative to the axis.
const ASIDE: f64 = 0.0065;
/// Room on the axis of speeds for measured points at rest.
const ROOM: f64 = 0.025;

/// Frequencies over speed, and residuals, as numbers.
pub fn chart(report: &FitReport) -> ChartData {
    let last = report.curves.rpm.last().copied().unwrap_or(1.0);
    let in_sweep = report.residuals.iter().filter(|r| r.rpm <= last);
    let fitted = in_sweep.clone().filter(|r| r.fitted);
    let highest = fitted
        .clone()
        .fold(1.0_f64, |top, r| top.max(r.measured_hz).max(r.fitted_hz));
    let largest = fitted.fold(1e-3_f64, |top, r| top.max(off(r).abs()));
    // The axis ends at round numbers, so that both signs have a tick.
    let reach = round_up(1.05 * largest);
    let shown: Vec<&Residual> = in_sweep
        .filter(|r| r.measured_hz <= 1.12 * highest)
        .collect();
    let speed = AxisData::speed().within([-ROOM * last, last]);
    let upper = PanelData {
        share: 1.2,
        harmonics: true,
        ..PanelData::new(
            speed.clone(),
            AxisData::new("frequency in space", "Hz").within([0.0, 1.12 * highest]),
            frequencies(report, &shown),
        )
    };
    let lower = PanelData {
        share: 0.4,
        ..PanelData::new(
            speed,
            AxisData::new("model − measured", "Hz").within([-reach, reach]),
            residuals(&shown, last),
        )
    };
    ChartData {
        key: key(report, &shown),
        ..ChartData::new(&report.scene.name, facts(report), vec![upper, lower])
    }
}

fn off(r: &Residual) -> f64 {
    r.fitted_hz - r.measured_hz
}

fn facts(report: &FitReport) -> Vec<String> {
    let found = report.parameters.iter().map(|p| in_words(&p.path, p.value));
    let rms = format!(
        "{:.3} Hz rms over {} frequencies",
        report.rms_hz, report.measured_frequencies
    );
    [report.condition.clone(), rms]
        .into_iter()
        .chain(found)
        .collect()
}

/// Curves before and after the fit, and measured points, each with a line to its fitted frequency.
fn frequencies(report: &FitReport, shown: &[&Residual]) -> Vec<Item> {
    let curves = &report.curves;
    let mut items = Vec::new();
    for (rows, look) in [(&curves.before_hz, before()), (&curves.fitted_hz, after())] {
        // A curve goes through the lowest frequencies of all speeds, the second through the second ones, and so on.
        let depth = rows.iter().map(Vec::len).max().unwrap_or(0);
        items.extend((0..depth).map(|place| {
            let points = curves
                .rpm
                .iter()
                .zip(rows)
                .map(|(rpm, row)| [*rpm, row.get(place).copied().unwrap_or(f64::NAN)]);
            let (x, y) = points.map(|[x, y]| (x, y)).unzip();
            Item::Line(Line {
                x,
                y,
                name: format!("{}, frequency {}", look.name, place + 1),
                ..look.clone()
            })
        }));
    }
    let fitted = || shown.iter().filter(|r| r.fitted);
    let ways = fitted().flat_map(|r| {
        let ends = [r.measured_hz, r.fitted_hz].map(|hz| [r.rpm, hz]);
        ends.into_iter().chain([[f64::NAN; 2]])
    });
    items.push(Item::Line(Line {
        width: HAIRLINE,
        ..Line::new(ways, Hue::Alarm, "measured to fitted")
    }));
    let point = |r: &&Residual| [r.rpm, r.measured_hz];
    items.push(Item::Points(Points {
        shape: Shape::Ring,
        said: fitted().map(|r| describe(r)).collect(),
        ..Points::new(fitted().map(point), Hue::Ink, MEASURED_SIZE, &report.source)
    }));
    let others = shown.iter().filter(|r| !r.fitted);
    items.push(Item::Points(Points::new(
        others.map(point),
        Hue::Quiet,
        LEFT_OUT_SIZE,
        "not fitted",
    )));
    items
}

fn before() -> Line {
    Line {
        dashed: true,
        width: HAIRLINE,
        ..Line::new([], Hue::Standing, "before")
    }
}

fn after() -> Line {
    Line::new([], Hue::Forward, "fitted")
}

fn describe(r: &Residual) -> String {
    format!(
        "{:.0} rpm{}\n{} Hz measured\n{:+.2} Hz computed",
        r.rpm,
        r.diameters.map_or(String::new(), |n| format!(", n = {n}")),
        r.measured_hz,
        off(r)
    )
}

/// The entry of [`MODES`] for a residual.
fn mode_of(r: &Residual) -> usize {
    r.diameters.unwrap_or(usize::MAX).min(MODES.len() - 1)
}

/// The residuals of the modes, with lines from zero.
fn residuals(shown: &[&Residual], last: f64) -> Vec<Item> {
    let zero = [[-ROOM * last, 0.0], [last, 0.0]];
    let mut items = vec![Item::Line(Line {
        width: HAIRLINE,
        ..Line::new(zero, Hue::Quiet, "")
    })];
    for (mode, (shape, hue, name)) in MODES.into_iter().enumerate() {
        let own = || shown.iter().filter(|r| r.fitted && mode_of(r) == mode);
        let point = |r: &&Residual| {
            let middle = 0.5 * (SIDE_BY_SIDE - 1) as f64;
            let aside = ASIDE * (((r.place - 1) % SIDE_BY_SIDE) as f64 - middle);
            [(r.rpm + aside * last).clamp(-ROOM * last, last), off(r)]
        };
        let sticks = own().flat_map(|r| {
            let [x, y] = point(r);
            [[x, 0.0], [x, y], [f64::NAN; 2]]
        });
        items.push(Item::Line(Line::new(sticks, hue, name)));
        items.push(Item::Points(Points {
            shape,
            said: own().map(|r| describe(r)).collect(),
            ..Points::new(own().map(point), hue, RESIDUAL_SIZE, name)
        }));
    }
    items
}

fn key(report: &FitReport, shown: &[&Residual]) -> Vec<Item> {
    let measured = Item::points_sample(MEASURED_SIZE, Shape::Ring, Hue::Ink, &report.source);
    let others = shown
        .iter()
        .any(|r| !r.fitted)
        .then(|| Item::points_sample(LEFT_OUT_SIZE, Shape::Disc, Hue::Quiet, "not fitted"));
    let modes = MODES
        .into_iter()
        .enumerate()
        .filter(|(mode, _)| shown.iter().any(|r| r.fitted && mode_of(r) == *mode))
        .map(|(_, (shape, hue, name))| Item::points_sample(RESIDUAL_SIZE, shape, hue, name));
    [measured]
        .into_iter()
        .chain(others)
        .chain([after(), before()].map(Item::Line))
        .chain(modes)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn residuals_are_distinguished_without_colours() {
        for (k, (shape, ..)) in MODES.iter().enumerate() {
            assert!(MODES[..k].iter().all(|(other, ..)| other != shape));
        }
    }

    #[test]
    fn every_fitted_residual_has_the_mark_of_its_nodal_diameters() {
        let json = include_str!("../../../tests/golden/reports/fit-paper.json");
        let report: FitReport = serde_json::from_str(json).unwrap();
        let [_, lower] = &chart(&report).panels[..] else {
            panic!("the figure has two panels");
        };
        let marks = |name: &str| {
            let count = |item: &Item| match item {
                Item::Points(points) if points.name == name => points.x.len(),
                _ => 0,
            };
            lower.items.iter().map(count).sum::<usize>()
        };
        let fitted = report.residuals.iter().filter(|r| r.fitted);
        let found: Vec<usize> = fitted.map(|r| r.diameters.unwrap()).collect();
        let of = |n: usize| found.iter().filter(|other| **other == n).count();
        assert_eq!(
            ["n = 0", "n = 1", "n = 2"].map(marks),
            [of(0), of(1), of(2)]
        );
        let drawn: usize = MODES.iter().map(|(.., name)| marks(name)).sum();
        assert_eq!(drawn, found.len());
    }
}
