//! One mode of a diagram, which the page animates.

use std::f64::consts::TAU;

use serde::Deserialize;

use super::charts::Charts;
use super::refusal::Refusal;
use crate::analyses::campbell::ModeShape;
use crate::model::scene::rpm;
use crate::modes::NamedMode;
use crate::stability::Analysis;

/// A request for a mode.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Asked {
    /// Identifier of the diagram.
    chart: usize,
    /// Rotation speed at a point of a branch.
    rpm: f64,
    /// Frequency in space at this point.
    frequency_hz: f64,
}

/// Returns the requested mode.
///
/// # Errors
/// [`Refusal`] if the request cannot be read, or the diagram is no longer kept.
pub fn answer(charts: &Charts, asked: &str) -> Result<ModeShape, Refusal> {
    let asked: Asked = serde_json::from_str(asked).map_err(|error| Refusal::of(&error))?;
    let found = charts
        .named(asked.chart)
        .and_then(|analysis| nearest(&analysis, &asked));
    found.ok_or_else(|| Refusal::gone(asked.chart))
}

/// Finds the mode nearest to the requested frequency at the sampled speed nearest to the requested one.
fn nearest(analysis: &Analysis, asked: &Asked) -> Option<ModeShape> {
    let samples = analysis.chart.campbell.samples.iter();
    let samples = samples.filter(|sample| sample.is_solved());
    let off = |value: f64, wanted: f64| (value - wanted).abs();
    let sample = samples.min_by(|x, y| {
        let of = |speed| off(rpm(speed), asked.rpm);
        of(x.speed_rad_per_s).total_cmp(&of(y.speed_rad_per_s))
    })?;
    let of = |mode: &NamedMode| off(mode.mode.frequency_rad_per_s() / TAU, asked.frequency_hz);
    let mode = sample.modes.iter().min_by(|x, y| of(x).total_cmp(&of(y)))?;
    let model = &analysis.model;
    let described = model.describe(sample.speed_rad_per_s, vec![mode.mode.clone()]);
    let shape = |found| ModeShape::new(&model.plate, sample.speed_rad_per_s, found);
    described.first().map(shape)
}
