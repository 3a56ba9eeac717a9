//! The orbit of the centre of the blade on its arbor, one panel for each speed.

use super::axis::{Axis, draw_named, draw_vertical, tick_label};
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::clip::draw_inside;
use super::columns::{Columns, name_of_row};
use super::heading::of_saw;
use super::style::{
    CURVE, FINE_DASH, FORWARD, HAIRLINE, INK, LABEL_SIZE, QUIET, STANDING, SUBTITLE_SIZE, tint,
};
use crate::analyses::cut::{CutAtSpeed, CutReport, SplineOrbit};

/// Positions of the panels, which are square because both axes have the same scale.
const PANELS: Columns = Columns {
    lefts: [120.0, 700.0],
    top: 140.0,
    width: 420.0,
    alone: 420.0,
    height: 420.0,
    row: 560.0,
};

/// Draws a panel for each speed; `None` for a saw without spline.
pub fn sheet(report: &CutReport) -> Option<Sheet> {
    let runs: Vec<(&CutAtSpeed, &SplineOrbit)> = report
        .runs
        .iter()
        .filter_map(|run| run.spline.as_ref().map(|spline| (run, spline)))
        .collect();
    if runs.is_empty() {
        return None;
    }
    let title = "Orbit of the blade's centre on the splined arbor in the cut";
    let panels = runs.len();
    let mut sheet = PANELS.sheet(
        panels,
        title,
        &of_saw(&report.scene.name, &report.condition),
    );
    let scale = Scale::of(runs.iter().map(|(_, spline)| *spline));
    for (index, (run, spline)) in runs.into_iter().enumerate() {
        let name = format!("a quarter turn further\u{2003}[{}]", scale.unit);
        let panel = (&PANELS.panel(index, panels), name_of_row(index, &name));
        draw_orbit(&mut sheet, panel, (run, spline), &scale);
    }
    Some(sheet)
}

/// The axes of all panels, which include the centre of the arbor and every orbit.
struct Scale {
    unit: &'static str,
    /// Factor from metres to the unit.
    per_metre: f64,
    /// End of the axes on either side of zero, in the unit.
    reach: f64,
}

impl Scale {
    fn of<'a>(splines: impl Iterator<Item = &'a SplineOrbit>) -> Self {
        let all = splines.flat_map(|spline| spline.x_m.iter().chain(&spline.y_m));
        let largest_m = all.fold(1e-9_f64, |max, value| max.max(value.abs()));
        let (unit, per_metre) = match largest_m < 1e-4 {
            true => ("µm", 1e6),
            false => ("mm", 1e3),
        };
        Scale {
            unit,
            per_metre,
            reach: 1.2 * per_metre * largest_m,
        }
    }
}

fn draw_orbit(
    sheet: &mut Sheet,
    (panel, name): (&Frame, &str),
    (run, spline): (&CutAtSpeed, &SplineOrbit),
    scale: &Scale,
) {
    let reach = [-scale.reach, scale.reach];
    let x = Axis::linear(reach, panel.across());
    let y = Axis::linear(reach, panel.upwards());
    draw_vertical(sheet, &y, panel, name);
    let name = format!("centre towards the cut\u{2003}[{}]", scale.unit);
    draw_named(sheet, &x, panel.bottom, &name);
    let grey = Stroke::solid(tint(STANDING, 0.6), HAIRLINE);
    sheet.vertical(x.at(0.0), panel, grey);
    sheet.horizontal(y.at(0.0), panel, grey);
    draw_clearance(sheet, (&x, &y), panel, spline.clearance_m, scale);
    let points = spline.x_m.iter().zip(&spline.y_m);
    let places: Vec<[f64; 2]> = points
        .map(|(px, py)| [x.at(scale.per_metre * px), y.at(scale.per_metre * py)])
        .collect();
    let settled = spline.settled_from.min(places.len());
    let pale = Stroke::solid(tint(FORWARD, 0.35), HAIRLINE);
    sheet.line(places[..settled].iter().copied(), pale);
    sheet.line(
        places[settled..].iter().copied(),
        Stroke::solid(FORWARD, CURVE),
    );
    if let Some(last) = places.last() {
        sheet.disc(*last, 3.5, FORWARD);
    }
    let title = Lettering::title(SUBTITLE_SIZE, INK);
    let text = format!(
        "{:.0} rpm: {:.1} spline teeth in contact, {:.0} N at most on one",
        run.rpm, spline.teeth_in_contact, spline.peak_tooth_n
    );
    sheet.text([panel.left, panel.top - 32.0], title, &text);
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start);
    let text = format!(
        "growth in the cut {:.2} 1/s assumed, {:.2} 1/s with this reaction",
        run.growth_per_s, spline.growth_per_s
    );
    sheet.text([panel.left, panel.top - 12.0], letters, &text);
}

/// Draws the circle in which the centre of a blade without torque can move, and writes the clearance.
fn draw_clearance(
    sheet: &mut Sheet,
    (x, y): (&Axis, &Axis),
    panel: &Frame,
    clearance_m: f64,
    scale: &Scale,
) {
    let radius = scale.per_metre * clearance_m;
    if radius <= 0.0 {
        return;
    }
    let circle = (0..=120).map(|k| {
        let (sin, cos) = (f64::from(k) / 120.0 * std::f64::consts::TAU).sin_cos();
        [x.at(radius * cos), y.at(radius * sin)]
    });
    let circle: Vec<[f64; 2]> = circle.collect();
    let dashed = Stroke::dashed(QUIET, HAIRLINE, FINE_DASH);
    draw_inside(sheet, panel, &circle, dashed);
    let clearance = format!("clearance {} mm", tick_label(1e3 * clearance_m));
    let text = match radius <= scale.reach {
        true => format!("dashed: {clearance}"),
        false => format!("{clearance}, outside the picture"),
    };
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::End);
    let at = [panel.right - 6.0, panel.bottom - 10.0];
    sheet.text_on_paper(at, letters, &text);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spline(x_m: Vec<f64>) -> SplineOrbit {
        SplineOrbit {
            verdict: crate::report::Verdict::Stable,
            growth_per_s: 0.0,
            frequency_hz: None,
            stiffness_change: 0.1,
            torque_n_m: 1500.0,
            clearance_m: 2.5e-4,
            teeth_in_contact: 20.0,
            peak_tooth_n: 1200.0,
            deepest_m: 3e-5,
            imbalance: 1e-10,
            unsteadiness: 1e-10,
            settled_from: 1,
            time_s: Vec::new(),
            force_n: [0.0; 2],
            y_m: x_m.clone(),
            x_m,
        }
    }

    /// One orbit of a few micrometres in a clearance of a quarter of a millimetre, and one that fills the
    /// clearance.
    #[test]
    fn an_orbit_far_smaller_than_the_clearance_fills_its_panel() {
        for (metres, unit, fits) in [(9e-6, "µm", false), (2.4e-4, "mm", true)] {
            let spline = spline(vec![0.5 * metres, -metres, metres]);
            let scale = Scale::of(std::iter::once(&spline));
            assert_eq!(scale.unit, unit);
            let share = scale.per_metre * metres / scale.reach;
            assert!((0.8..1.0).contains(&share), "{share}");
            assert_eq!(scale.per_metre * spline.clearance_m <= scale.reach, fits);
        }
    }
}
