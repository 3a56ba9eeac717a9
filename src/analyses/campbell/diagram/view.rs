//! The part of a Campbell diagram that its figure shows.

use super::waves;
use crate::analyses::campbell::band_item::is_shaded;
use crate::analyses::campbell::{InstabilityBand, Report};
use crate::page::figure::axis::proper_range;

/// The part of a Campbell diagram that its figure shows. With the default values the figure shows the whole sweep, or,
/// if it has more than 40 bands, the speeds up to the 41st, the operating speed and the flutter speed.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct CampbellView {
    /// First rotation speed; `None` for the start of the sweep.
    pub from_rpm: Option<f64>,
    /// Last rotation speed; `None` if it is chosen automatically.
    pub to_rpm: Option<f64>,
    /// Highest frequency; `None` if the contents determine it.
    pub to_hz: Option<f64>,
}

/// Largest number of bands whose growth curves can be distinguished; only some of them have labels.
const MOST_BANDS: usize = 40;
/// Factor by which the axis exceeds the operating speed and the flutter speed.
const BEYOND: f64 = 1.1;

/// Ranges of the axes.
pub struct Shown {
    /// First and last rotation speed.
    pub rpm: [f64; 2],
    /// Highest frequency.
    pub hz: f64,
}

impl CampbellView {
    pub(super) fn of(self, report: &Report) -> Shown {
        let sweep = [report.campbell.from_rpm, report.campbell.to_rpm];
        let first_rpm = self.from_rpm.map_or(sweep[0], |rpm| rpm.max(sweep[0]));
        let last_rpm = self
            .to_rpm
            .map_or_else(|| last_readable(report, first_rpm), |rpm| rpm.min(sweep[1]));
        let [from, to] = proper_range([first_rpm, last_rpm]);
        let highest = self
            .to_hz
            .unwrap_or_else(|| waves::highest_shown_hz(report, [from, to]));
        let [_, hz] = proper_range([0.0, highest]);
        Shown {
            rpm: [from, to],
            hz,
        }
    }
}

/// The end of the sweep in rpm; with more than [`MOST_BANDS`] bands the onset of the next one, but at least
/// [`BEYOND`] times the operating speed and the flutter speed.
fn last_readable(report: &Report, from_rpm: f64) -> f64 {
    let end = report.campbell.to_rpm;
    let later = report.instabilities.iter().filter(|b| b.to_rpm >= from_rpm);
    let mut onsets: Vec<f64> = later.map(|band| band.from_rpm).collect();
    onsets.sort_by(f64::total_cmp);
    let Some(onset) = onsets.get(MOST_BANDS) else {
        return end;
    };
    let marks = [report.scene.operating_rpm, report.flutter_rpm]
        .into_iter()
        .flatten()
        .map(|rpm| BEYOND * rpm);
    marks.fold(*onset, f64::max).min(end)
}

/// Notes on contents that the figure omits between two speeds in rpm; `labelled` is the number of bands with labels.
pub fn left_out(report: &Report, [from, to]: [f64; 2], labelled: usize) -> Vec<String> {
    let mut notes = Vec::new();
    let [first, last] = [report.campbell.from_rpm, report.campbell.to_rpm];
    if first < from || to < last {
        notes.push(format!(
            "shown: {from:.0} to {to:.0} of {first:.0} to {last:.0} rpm (--draw-to)"
        ));
    }
    let is_shown = |b: &&InstabilityBand| b.from_rpm <= to && from <= b.to_rpm;
    let drawn = report.instabilities.iter().filter(is_shown);
    let unshaded = drawn.clone().filter(|band| !is_shaded([from, to], band));
    let (shown, weak) = (drawn.count(), unshaded.count());
    let threshold = report.flutter_threshold_per_s;
    let of_weak = match weak {
        0 => String::new(),
        1 => format!("1 wide band that grows by less than {threshold} 1/s: not shaded"),
        _ => format!("{weak} wide bands that grow by less than {threshold} 1/s: not shaded"),
    };
    // The bands without shade have no labels either, and `of_weak` counts them already.
    let others = shown.saturating_sub(labelled + weak);
    let of_others = match others {
        0 => String::new(),
        _ => format!("{others} of {shown} bands without a label"),
    };
    notes.extend([of_weak, of_others].into_iter().filter(|n| !n.is_empty()));
    notes
}
