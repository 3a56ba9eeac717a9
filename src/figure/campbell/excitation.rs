//! Lines at multiples of the rotation speed, and their crossings.

use super::super::canvas::{Anchor, Lettering, Sheet, Stroke, text_frame};
use super::super::clip::clip;
use super::super::style::{FINE_DASH, HAIRLINE, INK, LABEL_SIZE, PAPER, QUIET};
use super::Chart;

/// From the upper edge to the baseline of a label on its line.
const LABEL_DROP: f64 = 34.0;
/// From the right edge to the end of a label of a line that leaves there.
const LABEL_INSET: f64 = 8.0;

/// Draws every line over the branches, labelled near its upper end.
pub fn draw(sheet: &mut Sheet, chart: &Chart) {
    let Some(excitation) = &chart.report.excitation else {
        return;
    };
    let stroke = Stroke {
        dash: Some(FINE_DASH),
        ..Stroke::solid(QUIET, HAIRLINE)
    };
    let campbell = &chart.report.campbell;
    for line in &excitation.lines {
        let place = |rpm: f64| {
            let hz = f64::from(line.order) * rpm / 60.0;
            [chart.speed.at(rpm), chart.frequency.at(hz)]
        };
        let whole = [place(campbell.from_rpm), place(campbell.to_rpm)];
        let parts = clip(&whole, &chart.upper);
        let Some([from, to]) = parts.first().and_then(|part| part.first_chunk::<2>()) else {
            continue;
        };
        sheet.line([*from, *to], stroke);
        label(sheet, chart, &line.name, [*from, *to]);
    }
    for crossing in &excitation.crossings {
        if chart.speed.shows(crossing.rpm) && chart.frequency.shows(crossing.frequency_hz) {
            let at = [
                chart.speed.at(crossing.rpm),
                chart.frequency.at(crossing.frequency_hz),
            ];
            sheet.ring(at, 2.5, Stroke::solid(QUIET, 1.0), PAPER);
        }
    }
}

fn label(sheet: &mut Sheet, chart: &Chart, name: &str, [from, to]: [[f64; 2]; 2]) {
    let letters = Lettering::regular(LABEL_SIZE, INK, Anchor::End);
    // A steep line leaves above, a flat one on the right.
    let wanted = match to[0] < chart.upper.right - 1.0 {
        true => to[1] + LABEL_DROP,
        false => to[1].max(chart.upper.top + LABEL_DROP),
    };
    let slope = (to[0] - from[0]) / (to[1] - from[1]).min(-f64::MIN_POSITIVE);
    let x = (to[0] + slope * (wanted - to[1])).min(chart.upper.right) - LABEL_INSET;
    let at = [x, wanted];
    let frame = text_frame(at, &letters, name);
    let letters = match frame.left < chart.upper.left {
        true => Lettering::regular(LABEL_SIZE, INK, Anchor::Start),
        false => letters,
    };
    let at = match frame.left < chart.upper.left {
        true => [x + 2.0 * LABEL_INSET, wanted],
        false => at,
    };
    sheet.fill(text_frame(at, &letters, name), PAPER);
    sheet.text(at, letters, name);
}
