//! Labels of the bands of instability, in rows at the top of the lower panel.

use super::plan::{Chart, WIDTH};
use super::speeds::operating_place;
use crate::page::figure::bands::{NARROW, places};
use crate::page::figure::canvas::{Anchor, Frame, Lettering, Sheet, Stroke, text_frame};
use crate::page::figure::items::Band;
use crate::page::figure::style::{HAIRLINE, LABEL_SIZE, MARGIN, PAPER};

/// Largest number of rows of labels.
const ROWS: usize = 5;
const ROW_HEIGHT: f64 = 16.0;
/// Space between a band and its label, in which a short line connects them.
const FLAG_GAP: f64 = 8.0;

/// A label and its position.
struct Placed {
    at: [f64; 2],
    letters: Lettering,
    frame: Frame,
    row: usize,
    /// Penalty for the side of the band on which the label is; the position with the smallest sum of penalties is
    /// selected.
    penalty: usize,
    label: String,
}

/// Positions of the labels of the bands.
pub struct BandLabels {
    placed: Vec<Placed>,
    /// Left and right edge of narrow bands and of the line of the operating speed. Where a label crosses one of
    /// them, it has a ground in the colour of the paper.
    thin: Vec<[f64; 2]>,
}

impl BandLabels {
    /// Finds a position for the label of each shaded band, in descending order of growth. A label without
    /// room is omitted.
    pub fn new(chart: &Chart) -> Self {
        let mut order: Vec<&Band> = chart.bands().filter(|b| !b.shaded.is_empty()).collect();
        order.sort_by(|a, b| b.peak_growth_per_s.total_cmp(&a.peak_growth_per_s));
        let places = chart
            .bands()
            .filter_map(|b| places(&chart.speed, [b.from, b.to]));
        let mut thin: Vec<_> = places
            .filter(|[left, right]| right - left < NARROW)
            .collect();
        thin.extend(operating_place(chart).map(|x| [x - 0.5, x + 0.5]));
        let mut labels = Self {
            placed: Vec::new(),
            thin,
        };
        for band in order {
            labels.placed.extend(labels.best_place(chart, band));
        }
        labels
    }

    /// The best position without overlap with other labels: it crosses few thin lines, is in a high row, and is next
    /// to its band. `None` if there is no such position.
    fn best_place(&self, chart: &Chart, band: &Band) -> Option<Placed> {
        let own = places(&chart.speed, [band.from, band.to])?;
        let free = |place: &Placed| {
            let Frame { left, right, .. } = place.frame;
            let inside = left >= chart.lower.left + 4.0 && right <= f64::from(WIDTH) - MARGIN;
            inside
                && !self
                    .placed
                    .iter()
                    .any(|other| other.frame.overlaps(&place.frame))
        };
        let cost = |place: &Placed| {
            let foreign = self.thin.iter().filter(|line| **line != own);
            let crossed = foreign.filter(|line| crosses(line, &place.frame)).count();
            4 * crossed + place.row + place.penalty
        };
        let candidates = (0..ROWS).flat_map(|row| places_in_row(chart, band, own, row));
        candidates.filter(free).min_by_key(cost)
    }

    /// Number of labelled bands.
    pub fn count(&self) -> usize {
        self.placed.len()
    }

    /// Height of the rows of labels at the top of the panel.
    pub fn height(&self) -> f64 {
        let rows = self.placed.iter().map(|place| place.row + 1).max();
        8.0 + rows.unwrap_or(0) as f64 * ROW_HEIGHT
    }

    /// Draws the labels, with short lines to their bands.
    pub fn draw(&self, sheet: &mut Sheet) {
        for Placed {
            at,
            letters,
            frame,
            label,
            ..
        } in &self.placed
        {
            for line in self.thin.iter().filter(|line| crosses(line, frame)) {
                sheet.fill(frame.between([line[0] - 1.0, line[1] + 1.0]), PAPER);
            }
            let [x, y] = [at[0], at[1] - 0.36 * LABEL_SIZE];
            let flag = |way: f64| [2.0, FLAG_GAP].map(|away| [x + way * away, y]);
            let stroke = Stroke::solid(letters.colour, HAIRLINE);
            match letters.anchor {
                Anchor::Start => sheet.line(flag(-1.0), stroke),
                Anchor::End => sheet.line(flag(1.0), stroke),
                Anchor::Middle => {}
            }
            sheet.text(*at, *letters, label);
        }
    }
}

fn crosses([left, right]: &[f64; 2], frame: &Frame) -> bool {
    *left < frame.right && frame.left < *right
}

/// Positions in a row of labels: to the right of the band, to its left, and across it.
fn places_in_row(chart: &Chart, band: &Band, [left, right]: [f64; 2], row: usize) -> [Placed; 3] {
    let baseline = chart.lower.top + 13.0 + row as f64 * ROW_HEIGHT;
    let sides = [
        (right + FLAG_GAP, Anchor::Start),
        (left - FLAG_GAP, Anchor::End),
        ((left + right) / 2.0, Anchor::Middle),
    ];
    sides.map(|(x, anchor)| {
        let letters = Lettering::regular(LABEL_SIZE, band.colour.colour(), anchor);
        let frame = text_frame([x, baseline], &letters, &band.label);
        let fits_inside = frame.right - frame.left < right - left;
        let penalty = match anchor {
            Anchor::Start if fits_inside => 2,
            Anchor::Start => 0,
            Anchor::End => 1,
            Anchor::Middle if fits_inside => 0,
            Anchor::Middle => 6,
        };
        Placed {
            at: [x, baseline],
            letters,
            frame: frame.widened(3.0),
            row,
            penalty,
            label: band.label.clone(),
        }
    })
}
