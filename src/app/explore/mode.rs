//! One mode of a diagram, which the page animates.

use std::f64::consts::TAU;

use serde::Deserialize;

use super::charts::Charts;
use super::refusal::Refusal;
use crate::analyses::campbell::ModeShape;
use crate::model::scene::rpm;
use crate::modes::{Mode, smallest};
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

/// Computes the mode nearest to the requested frequency at the drawn speed nearest to the requested one.
fn nearest(analysis: &Analysis, asked: &Asked) -> Option<ModeShape> {
    let samples = analysis.chart.campbell.samples.iter();
    let speeds = samples.map(|sample| sample.speed_rad_per_s);
    let speed = smallest(speeds, |speed| (rpm(*speed) - asked.rpm).abs())?;
    let model = &analysis.model;
    let off = |mode: &Mode| (mode.frequency_rad_per_s() / TAU - asked.frequency_hz).abs();
    let mode = smallest(model.modes(speed).ok()?, off)?;
    let described = model.describe(speed, vec![mode]);
    let shape = |found| ModeShape::new(&model.plate, speed, found);
    described.first().map(shape)
}
