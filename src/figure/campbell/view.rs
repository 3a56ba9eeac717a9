//! The part of a Campbell diagram that its figure shows.

use super::super::axis::proper_range;
use super::super::bands::is_shaded;
use super::waves;
use crate::report::{InstabilityEntry, Report};

/// The part of the Campbell diagram that its figure shows. An end that is `None` is chosen automatically: the
/// whole sweep, or, with very many bands, as much as can be read.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct CampbellView {
    /// First rotation speed.
    pub from_rpm: Option<f64>,
    /// Last rotation speed.
    pub to_rpm: Option<f64>,
    /// Highest frequency.
    pub to_hz: Option<f64>,
}

/// Largest number of bands that can be distinguished: a few have labels, all have visible growth curves.
const MOST_BANDS: usize = 40;
/// Factor by which the axis exceeds the last important speed.
const BEYOND: f64 = 1.1;

/// First and last rotation speed, and highest frequency.
pub struct Shown {
    pub rpm: [f64; 2],
    pub hz: f64,
}

impl CampbellView {
    pub(super) fn of(self, report: &Report) -> Shown {
        let sweep = [report.campbell.from_rpm, report.campbell.to_rpm];
        let from = self.from_rpm.map_or(sweep[0], |rpm| rpm.max(sweep[0]));
        let to = self
            .to_rpm
            .map_or_else(|| last_readable(report, from), |rpm| rpm.min(sweep[1]));
        // An axis cannot be empty.
        let [from, to] = proper_range([from, to]);
        let hz = self.to_hz;
        let hz = hz.unwrap_or_else(|| waves::highest_shown_hz(report, [from, to]));
        let [_, hz] = proper_range([0.0, hz]);
        Shown {
            rpm: [from, to],
            hz,
        }
    }
}

/// The end of the sweep, or, with too many bands, the onset of the first one that exceeds their largest
/// number; but at least the operating speed and the flutter speed.
fn last_readable(report: &Report, from_rpm: f64) -> f64 {
    let end = report.campbell.to_rpm;
    let later = report.instabilities.iter().filter(|b| b.to_rpm >= from_rpm);
    let mut onsets: Vec<f64> = later.map(|band| band.from_rpm).collect();
    onsets.sort_by(f64::total_cmp);
    let Some(onset) = onsets.get(MOST_BANDS) else {
        return end;
    };
    let marks = [report.scene.operating_rpm, report.flutter_speed_rpm];
    let marks = marks.into_iter().flatten().map(|rpm| BEYOND * rpm);
    marks.fold(*onset, f64::max).min(end)
}

/// Sentence on what the figure omits, if only `labelled` bands have labels.
pub fn left_out(report: &Report, [from, to]: [f64; 2], labelled: usize) -> Vec<String> {
    let mut notes = Vec::new();
    let [first, last] = [report.campbell.from_rpm, report.campbell.to_rpm];
    if first < from || to < last {
        notes.push(format!(
            "shown: {from:.0} to {to:.0} of {first:.0} to {last:.0} rpm (--draw-to-rpm)"
        ));
    }
    let is_shown = |b: &&InstabilityEntry| b.from_rpm <= to && from <= b.to_rpm;
    let shown = report.instabilities.iter().filter(is_shown);
    let weak = shown.clone().filter(|band| !is_shaded([from, to], band));
    let (shown, weak) = (shown.count(), weak.count());
    let threshold = report.flutter_threshold_per_s;
    let of_weak = match weak {
        0 => String::new(),
        1 => format!("1 wide band that grows by less than {threshold} 1/s: not shaded"),
        _ => format!("{weak} wide bands that grow by less than {threshold} 1/s: not shaded"),
    };
    // A band without shade has no label.
    let others = shown.saturating_sub(labelled + weak);
    let of_others = match others {
        0 => String::new(),
        _ => format!("{others} of {shown} bands without a label"),
    };
    notes.extend([of_weak, of_others].into_iter().filter(|n| !n.is_empty()));
    notes
}
