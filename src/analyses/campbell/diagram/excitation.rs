//! Names of the lines at multiples of the rotation speed.

use super::plan::Chart;
use crate::page::figure::canvas::{Anchor, Lettering, Sheet, text_frame};
use crate::page::figure::items::Line;
use crate::page::figure::style::{INK, LABEL_SIZE};

/// Distance of the baseline of a label from the upper end of its line or the upper edge of the panel.
const LABEL_DROP: f64 = 34.0;
/// Distance of a label from its line.
const LABEL_INSET: f64 = 8.0;

/// Labels every line near its upper end.
pub fn label(sheet: &mut Sheet, chart: &Chart) {
    let lines = chart
        .lines()
        .filter(|line| line.dashed && line.branch.is_none());
    for line in lines {
        let parts = chart.upper_ground().parts(line);
        if let Some(ends) = parts.first().and_then(|part| part.first_chunk::<2>()) {
            label_line(sheet, chart, line, *ends);
        }
    }
}

fn label_line(sheet: &mut Sheet, chart: &Chart, line: &Line, [from, to]: [[f64; 2]; 2]) {
    let name = &line.name;
    let letters = Lettering::regular(LABEL_SIZE, INK, Anchor::End);
    // A steep line ends at the upper edge, a flat one at the right edge.
    let wanted = if to[0] < chart.upper.right - 1.0 {
        to[1] + LABEL_DROP
    } else {
        to[1].max(chart.upper.top + LABEL_DROP)
    };
    let slope = (to[0] - from[0]) / (to[1] - from[1]).min(-f64::MIN_POSITIVE);
    let x = (to[0] + slope * (wanted - to[1])).min(chart.upper.right) - LABEL_INSET;
    let at = [x, wanted];
    // The label is to the left of its line, or to the right if there is no room.
    if text_frame(at, &letters, name).left < chart.upper.left {
        let letters = Lettering::regular(LABEL_SIZE, INK, Anchor::Start);
        sheet.text_on_paper([x + 2.0 * LABEL_INSET, wanted], letters, name);
    } else {
        sheet.text_on_paper(at, letters, name);
    }
}
