//! The deflection before, during and after the cut, one panel a speed, as in the paper's
//! Figures 16 and 17.

use super::axis::{Axis, Spread, draw_horizontal, draw_vertical};
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::clip::clip;
use super::style::{
    ALARM, AXIS_SIZE, CURVE, Colour, FINE_DASH, FLUTTER, FLUTTER_SHADE, FORWARD, HAIRLINE, INK,
    LABEL_SIZE, QUIET, SUBTITLE_SIZE, Weight, tint,
};
use super::{FigureError, heading, render};
use crate::report::{CutReport, CutRunEntry, Verdict};

const WIDTH: u32 = 1200;
const ROW: f64 = 470.0;
const FIRST_TOP: f64 = 136.0;
const PLOT_HEIGHT: f64 = 330.0;
const COLUMNS: [[f64; 2]; 2] = [[92.0, 580.0], [680.0, 1168.0]];

/// The cut as PNG, 1200 pixels wide.
pub fn cut_png(report: &CutReport) -> Result<Vec<u8>, FigureError> {
    render::png(&sheet(report))
}

/// The cut as SVG.
pub fn cut_svg(report: &CutReport) -> Result<String, FigureError> {
    render::svg(&sheet(report))
}

pub(super) fn sheet(report: &CutReport) -> Sheet {
    let rows = report.runs.len().div_ceil(2).max(1);
    let mut sheet = Sheet::new(WIDTH, (60.0 + ROW * rows as f64) as u32);
    heading::draw(
        &mut sheet,
        "Deflection at the probe before, during and after the cut",
        &report.scene.name,
    );
    for (index, run) in report.runs.iter().enumerate() {
        let top = FIRST_TOP + ROW * (index / 2) as f64;
        let [left, right] = COLUMNS[index % 2];
        let panel = Frame {
            left,
            top,
            right,
            bottom: top + PLOT_HEIGHT,
        };
        draw_run(&mut sheet, &panel, run, index % 2 == 0);
    }
    sheet
}

fn draw_run(sheet: &mut Sheet, panel: &Frame, run: &CutRunEntry, first: bool) {
    let largest_mm = run
        .deflection_m
        .iter()
        .fold(0.0_f64, |max, w| max.max(w.abs()))
        * 1e3;
    let reach = if largest_mm > 0.0 {
        1.12 * largest_mm
    } else {
        1.0
    };
    let end_s = run.time_s.last().copied().unwrap_or(1.0);
    let time = Axis::new([0.0, end_s], [panel.left, panel.right], Spread::Linear);
    let deflection = Axis::new([-reach, reach], [panel.bottom, panel.top], Spread::Linear);
    let in_cut = Frame {
        left: time.at(run.forces_from_s),
        right: time.at(run.forces_to_s),
        ..*panel
    };
    let unstable = run.verdict == Verdict::Unstable;
    let shade = if unstable {
        FLUTTER_SHADE
    } else {
        tint(FORWARD, 0.12)
    };
    sheet.fill(in_cut, shade);
    let name = if first { "deflection\u{2003}[mm]" } else { "" };
    draw_vertical(sheet, &deflection, panel, name);
    let side = [[panel.left, panel.top], [panel.left, panel.bottom]];
    sheet.line(side, Stroke::solid(QUIET, HAIRLINE));
    draw_horizontal(sheet, &time, panel.bottom, true);
    let middle = Lettering::regular(AXIS_SIZE, INK, Anchor::Middle);
    let centre = (panel.left + panel.right) / 2.0;
    sheet.text([centre, panel.bottom + 42.0], middle, "time\u{2003}[s]");
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Middle);
    let label = [(in_cut.left + in_cut.right) / 2.0, panel.top + 16.0];
    sheet.text(label, letters, "in the cut");
    if unstable {
        draw_envelope(sheet, panel, run, (&time, &deflection));
    }
    let places: Vec<[f64; 2]> = run
        .time_s
        .iter()
        .zip(&run.deflection_m)
        .map(|(t, w)| [time.at(*t), deflection.at(1e3 * w)])
        .collect();
    for part in clip(&places, panel) {
        sheet.line(part, Stroke::solid(FORWARD, CURVE));
    }
    draw_verdict(sheet, panel, run);
}

/// ± the eigenvalue's exponential, through the largest deflection in the cut.
fn draw_envelope(sheet: &mut Sheet, panel: &Frame, run: &CutRunEntry, axes: (&Axis, &Axis)) {
    let (time, deflection) = axes;
    let in_cut = |t: &f64| (run.forces_from_s..=run.forces_to_s).contains(t);
    let record = run.time_s.iter().zip(&run.deflection_m);
    let peak = record
        .filter(|(t, _)| in_cut(t))
        .max_by(|x, y| x.1.abs().total_cmp(&y.1.abs()));
    let Some((peak_s, peak_m)) = peak else {
        return;
    };
    for sign in [-1.0, 1.0] {
        let places: Vec<[f64; 2]> = (0..=60)
            .map(|k| {
                let share = f64::from(k) / 60.0;
                let t = run.forces_from_s + share * (run.forces_to_s - run.forces_from_s);
                let size = peak_m.abs() * (run.growth_per_s * (t - peak_s)).exp();
                [time.at(t), deflection.at(1e3 * sign * size)]
            })
            .collect();
        for part in clip(&places, panel) {
            let dashed = Stroke {
                dash: Some(FINE_DASH),
                ..Stroke::solid(FLUTTER, CURVE)
            };
            sheet.line(part, dashed);
        }
    }
}

fn draw_verdict(sheet: &mut Sheet, panel: &Frame, run: &CutRunEntry) {
    let (word, colour): (&str, Colour) = match run.verdict {
        Verdict::Stable => ("stable in the cut", FORWARD),
        Verdict::Unstable => ("unstable in the cut", ALARM),
    };
    let title = Lettering {
        weight: Weight::SemiBold,
        ..Lettering::regular(SUBTITLE_SIZE + 2.0, colour, Anchor::Start)
    };
    let text = format!("{:.0} rpm: {word}", run.rpm);
    sheet.text([panel.left, panel.top - 32.0], title, &text);
    let hertz = |value: Option<f64>| value.map_or(String::new(), |hz| format!(" at {hz:.2} Hz"));
    let by_eigenvalue = format!(
        "eigenvalue {:.2} 1/s{}",
        run.growth_per_s,
        hertz(run.frequency_hz.filter(|_| run.growth_per_s > 0.0))
    );
    let by_history = run.transient_growth_per_s.map_or(String::new(), |growth| {
        // Rounding of either sign is no growth.
        let growth = if growth.abs() < 5e-3 { 0.0 } else { growth };
        format!("; fitted to this curve {growth:.2} 1/s")
    });
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start);
    let text = format!("{by_eigenvalue}{by_history}");
    sheet.text([panel.left, panel.top - 12.0], letters, &text);
}
