//! One mode of a chart, for the page to set in motion on the blade.

use std::f64::consts::TAU;

use serde::Deserialize;

use super::charts::Charts;
use super::reply::Refusal;
use crate::report::ModeEntry;
use crate::scene::rpm;
use crate::spectrum::DescribedMode;
use crate::stability::Analysis;

/// Which mode.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Asked {
    /// Name of the chart.
    chart: usize,
    /// Speed of a point of a branch.
    rpm: f64,
    /// Frequency there, in space.
    frequency_hz: f64,
}

/// The mode that is asked for.
///
/// # Errors
/// [`Refusal`] of a request that cannot be read, or of a chart that is gone.
pub fn answer(charts: &Charts, asked: &str) -> Result<ModeEntry, Refusal> {
    let asked: Asked = serde_json::from_str(asked).map_err(|error| Refusal::of(&error))?;
    let found = charts.named(asked.chart);
    let found = found
        .as_deref()
        .and_then(|analysis| Some((analysis, nearest(analysis, &asked)?)));
    let (analysis, (speed, mode)) = found.ok_or_else(|| Refusal::gone(asked.chart))?;
    Ok(ModeEntry::new(&analysis.model.plate, speed, mode))
}

/// The mode next to a frequency, of the speed next to one.
fn nearest<'a>(analysis: &'a Analysis, asked: &Asked) -> Option<(f64, &'a DescribedMode)> {
    let samples = analysis.chart.campbell.samples.iter();
    let off = |value: f64, wanted: f64| (value - wanted).abs();
    let sample = samples.min_by(|x, y| {
        let of = |speed| off(rpm(speed), asked.rpm);
        of(x.speed_rad_per_s).total_cmp(&of(y.speed_rad_per_s))
    })?;
    let of = |mode: &DescribedMode| off(mode.mode.frequency_rad_per_s() / TAU, asked.frequency_hz);
    let mode = sample.modes.iter().min_by(|x, y| of(x).total_cmp(&of(y)))?;
    Some((sample.speed_rad_per_s, mode))
}
