//! Shapes of the blade at critical speeds, in bands and at single speeds.

use std::f64::consts::TAU;

use faer::{Col, c64};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::modes::{ModeHarmonic, profile};
use crate::model::plate::Plate;
use crate::model::scene::rpm;
use crate::modes::{Direction, EventName, Mode, ModeKind, SpectrumError};
use crate::stability::{Analysis, Instability, InstabilityKind, StabilityState};

/// Occasion of a shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ShapeOccasion {
    /// The wave that stands still at a critical speed.
    CriticalSpeed,
    /// The motion of largest growth of a band of divergence.
    Divergence,
    /// The motion of largest growth of a flutter band.
    Flutter,
    /// A mode at the operating speed.
    OperatingSpeed,
    /// A mode at a requested speed.
    AskedSpeed,
}

/// The shape of the blade at an event: w(r, θ, t) = Re Σ_n (c_n(r) cos nθ + s_n(r) sin nθ) e^{λt}. The largest
/// deflection of all points is 1, at t = 0.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "EventShapeEntry")]
pub struct EventShape {
    /// Reason for which the shape is drawn.
    pub occasion: ShapeOccasion,
    /// Waves of the shape, named as the event is.
    pub name: String,
    /// Direction of the wave, seen from space.
    pub direction: Direction,
    /// Rotation speed.
    pub rpm: f64,
    /// |Im λ|/2π in the space-fixed frame.
    pub frequency_hz: f64,
    /// Re λ.
    pub growth_per_s: f64,
    /// Radii of the profiles.
    pub radius_m: Vec<f64>,
    /// Harmonics that are visible in the deflection, by descending share in the name. The guided blade also tilts
    /// (n = 1) and heaves (n = 0), which rotation does not soften: in the name of an event their share is zero.
    pub harmonics: Vec<ModeHarmonic>,
}

/// Smallest part of the squared deflection of a listed harmonic; its amplitude is of the order of 1e-4 of the
/// largest. A blade on a stiff pad has many small harmonics: with a limit of 1e-6 the error of the deflection of the
/// paper's saw exceeded a thousandth.
const VISIBLE: f64 = 1e-8;
/// Number of modes of lowest frequency that are listed at a single speed, because a slow side force excites them
/// most. Growing modes of higher frequency are listed in addition.
const LOWEST: usize = 4;
/// Number of angles per nodal diameter at which the largest deflection is searched for.
const ANGLES_EACH: usize = 24;

/// The shapes at every critical speed, at the peak of every band, at the operating speed and at requested speeds, by
/// ascending speed.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub(super) fn shapes(
    analysis: &Analysis,
    asked_rad_per_s: &[f64],
) -> Result<Vec<EventShape>, SpectrumError> {
    let mut shapes = standing(analysis);
    for band in analysis.bands() {
        shapes.extend(of_band(analysis, band)?);
    }
    shapes.sort_by(|x, y| x.rpm.total_cmp(&y.rpm));
    if let Some(speed) = analysis.scene.operating_rad_per_s()
        && analysis.verdict(speed).state != StabilityState::OutsideSweep
    {
        shapes.extend(at_speed(analysis, speed, ShapeOccasion::OperatingSpeed)?);
    }
    for speed in asked_rad_per_s {
        shapes.extend(at_speed(analysis, *speed, ShapeOccasion::AskedSpeed)?);
    }
    Ok(shapes)
}

/// The waves that stand still at the critical speeds of the sweep. Each speed of a free blade is listed once,
/// because its two waves differ by a rotation.
fn standing(analysis: &Analysis) -> Vec<EventShape> {
    let model = &analysis.model;
    let end = analysis.range_rad_per_s.to_rad_per_s;
    let within = model.critical.iter().filter(|c| c.speed_rad_per_s <= end);
    let mut shapes: Vec<EventShape> = Vec::new();
    for critical in within {
        let speed = critical.speed_rad_per_s;
        let first = model.components[critical.component].first;
        let mut shape = Col::zeros(model.plate.degrees_of_freedom());
        for (k, x) in critical.shape.iter().enumerate() {
            shape[first + k] = c64::new(*x, 0.0);
        }
        let found = Found {
            occasion: ShapeOccasion::CriticalSpeed,
            name: critical.name.in_words(),
            share: &|n| critical.name.share(n),
            direction: Direction::Standing,
            speed_rad_per_s: speed,
            frequency_rad_per_s: 0.0,
            growth_per_s: 0.0,
            shape: &shape,
        };
        let entry = found.entry(&model.plate);
        let double = |other: &EventShape| {
            let nearness = (other.rpm / entry.rpm - 1.0).abs();
            model.plate.is_axisymmetric() && other.name == entry.name && nearness < 1e-9
        };
        if !shapes.last().is_some_and(double) {
            shapes.push(entry);
        }
    }
    shapes
}

/// The motion of largest growth of a band; `None` if no mode of its kind grows at the peak.
fn of_band(analysis: &Analysis, band: &Instability) -> Result<Option<EventShape>, SpectrumError> {
    let (model, speed) = (&analysis.model, band.peak_rad_per_s);
    // In a band of divergence λ is real, but a complex pair with larger growth may exist at the same speed.
    let is_of_band = |mode: &Mode| match band.kind {
        InstabilityKind::Divergence => mode.lambda.im == 0.0,
        InstabilityKind::Flutter => mode.lambda.im != 0.0,
    };
    let distance = |mode: &Mode| (mode.growth_per_s() - band.peak_growth_per_s).abs();
    let modes = model
        .modes(speed)?
        .into_iter()
        .filter(|mode| is_of_band(mode) && mode.growth_per_s() > 0.0);
    let Some(mode) = modes.min_by(|x, y| distance(x).total_cmp(&distance(y))) else {
        return Ok(None);
    };
    let described = model.describe(speed, vec![mode]);
    Ok(described.first().map(|described| {
        let name = EventName::growing(&model.plate, &described.mode, &described.shape, speed);
        let found = Found {
            occasion: match band.kind {
                InstabilityKind::Divergence => ShapeOccasion::Divergence,
                InstabilityKind::Flutter => ShapeOccasion::Flutter,
            },
            name: name.in_words(),
            share: &|n| name.share(n),
            direction: described.name.direction,
            speed_rad_per_s: speed,
            frequency_rad_per_s: described.mode.frequency_rad_per_s(),
            growth_per_s: described.mode.growth_per_s(),
            shape: &described.shape,
        };
        found.entry(&model.plate)
    }))
}

/// The modes that grow at a speed, and those of lowest frequency, ascending.
fn at_speed(
    analysis: &Analysis,
    speed_rad_per_s: f64,
    occasion: ShapeOccasion,
) -> Result<Vec<EventShape>, SpectrumError> {
    let model = &analysis.model;
    let modes = model.describe(speed_rad_per_s, model.modes(speed_rad_per_s)?);
    // The mirror image λ = −σ + iω of a flutter mode λ = σ + iω is not shown separately.
    let shown = modes
        .iter()
        .filter(|found| found.mode.kind != ModeKind::Decaying)
        .enumerate()
        .filter(|(place, found)| *place < LOWEST || found.mode.growth_per_s() > 0.0);
    let entries = shown.map(|(_, described)| {
        let found = Found {
            occasion,
            name: described.name.in_shares(),
            share: &|n| described.name.share(n),
            direction: described.name.direction,
            speed_rad_per_s,
            frequency_rad_per_s: described.mode.frequency_rad_per_s(),
            growth_per_s: described.mode.growth_per_s(),
            shape: &described.shape,
        };
        found.entry(&model.plate)
    });
    Ok(entries.collect())
}

/// A shape in the basis of the plate, with its description.
struct Found<'a> {
    occasion: ShapeOccasion,
    name: String,
    /// Share of n nodal diameters in the name.
    share: &'a dyn Fn(usize) -> f64,
    direction: Direction,
    speed_rad_per_s: f64,
    frequency_rad_per_s: f64,
    growth_per_s: f64,
    shape: &'a Col<c64>,
}

impl Found<'_> {
    /// The entry of this shape, normalized.
    fn entry(self, plate: &Plate) -> EventShape {
        let mut entry = EventShape {
            occasion: self.occasion,
            name: self.name,
            direction: self.direction,
            rpm: rpm(self.speed_rad_per_s),
            frequency_hz: self.frequency_rad_per_s / TAU,
            growth_per_s: self.growth_per_s,
            radius_m: plate.sampled_radii_m().collect(),
            harmonics: harmonics(plate, self.shape, self.share),
        };
        entry.normalize();
        entry
    }
}

/// Visible harmonics of a shape, by descending share. The basis functions are orthonormal with respect to mass, so
/// that the squares of their coordinates are shares of the squared deflection, which decide what is visible.
fn harmonics(plate: &Plate, shape: &Col<c64>, share: &dyn Fn(usize) -> f64) -> Vec<ModeHarmonic> {
    let size = plate.basis.count();
    let square = |n: usize| {
        let own = plate.offset(n)..plate.offset(n) + if n == 0 { size } else { 2 * size };
        own.map(|k| shape[k].norm_sqr()).sum::<f64>()
    };
    let squares: Vec<f64> = (0..=plate.max_diameters()).map(square).collect();
    let least = VISIBLE * squares.iter().sum::<f64>();
    let mut seen: Vec<ModeHarmonic> = (squares.iter().enumerate())
        .filter(|(_, square)| **square > 0.0 && **square >= least)
        .map(|(n, _)| profile(plate, shape, n, share(n)))
        .collect();
    seen.sort_by(|x, y| y.share.total_cmp(&x.share));
    seen
}

impl EventShape {
    /// Complex deflections at angles, one row for each radius.
    pub(crate) fn at(&self, angles_rad: &[f64]) -> Vec<Vec<[f64; 2]>> {
        let mut rows = vec![vec![[0.0; 2]; angles_rad.len()]; self.radius_m.len()];
        for wave in &self.harmonics {
            let n = wave.nodal_diameters as f64;
            let turns: Vec<(f64, f64)> = angles_rad.iter().map(|a| (n * a).sin_cos()).collect();
            for (k, row) in rows.iter_mut().enumerate() {
                let (c, s) = (&wave.cosine, &wave.sine);
                for (value, (sin, cos)) in row.iter_mut().zip(&turns) {
                    value[0] += c.re[k] * cos + s.re[k] * sin;
                    value[1] += c.im[k] * cos + s.im[k] * sin;
                }
            }
        }
        rows
    }

    /// Scales the shape and its phase so that its largest deflection is 1 at t = 0.
    fn normalize(&mut self) {
        let most = self.harmonics.iter().map(|wave| wave.nodal_diameters);
        let count = ANGLES_EACH * most.max().unwrap_or(0).max(1);
        let angles: Vec<f64> = (0..count).map(|k| TAU * k as f64 / count as f64).collect();
        let rows = self.at(&angles);
        let square = |[re, im]: [f64; 2]| re * re + im * im;
        let values = rows.into_iter().flatten();
        let largest = values.max_by(|x, y| square(*x).total_cmp(&square(*y)));
        let Some([re, im]) = largest.filter(|value| square(*value) > 0.0) else {
            return;
        };
        // Every deflection is divided by the largest deflection re + i·im, which thereby becomes 1.
        let size = square([re, im]);
        let (factor_re, factor_im) = (re / size, -im / size);
        for wave in &mut self.harmonics {
            for part in [&mut wave.cosine, &mut wave.sine] {
                for (x, y) in part.re.iter_mut().zip(&mut part.im) {
                    (*x, *y) = (
                        factor_re * *x - factor_im * *y,
                        factor_re * *y + factor_im * *x,
                    );
                }
            }
        }
    }
}
