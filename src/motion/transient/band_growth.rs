//! Effect of a band of instability on a run-up: ∫ Re λ dt of its eigenvalue.

use std::f64::consts::PI;

use faer::c64;
use rayon::prelude::*;

use crate::modes::{Mode, ModeKind, SpectralModel, SpectrumError};
use crate::stability::{CurvePoint, Instability, InstabilityKind};

use super::TransientError;

/// Number of quadrature points over a band.
const BAND_POINTS: usize = 24;

/// ∫ Re λ dt over each band, at the rate of the run-up; overlapping bands are integrated separately.
///
/// # Errors
/// [`TransientError::Spectrum`].
pub fn band_exponents(
    model: &SpectralModel,
    bands: &[Instability],
    rate_rad_per_s2: f64,
) -> Result<Vec<f64>, TransientError> {
    bands
        .par_iter()
        .map(|band| {
            let integral = if band.curve.is_empty() {
                followed(model, band)?
            } else {
                of_curve(&band.curve)
            };
            Ok(integral / rate_rad_per_s2)
        })
        .collect()
}

/// ∫ Re λ dΩ of the cubics through the points of a damped band, which have its slopes.
fn of_curve(curve: &[CurvePoint]) -> f64 {
    let pairs = curve.windows(2);
    let parts = pairs.map(|pair| {
        let width = pair[1].speed_rad_per_s - pair[0].speed_rad_per_s;
        let ends = pair[0].number.re + pair[1].number.re;
        let bend = pair[0].slope.re - pair[1].slope.re;
        width * (0.5 * ends + width * bend / 12.0)
    });
    parts.sum()
}

/// ∫ Re λ dΩ over a band of an undamped blade. Growth starts and ends as a square root, which Gauss–Chebyshev
/// points of the second kind integrate exactly. The eigenvalue is known at the peak and is followed from
/// there through the points on both sides.
fn followed(model: &SpectralModel, band: &Instability) -> Result<f64, SpectrumError> {
    let (from, half) = (band.from_rad_per_s, 0.5 * band.range().width());
    let weight = PI / (BAND_POINTS + 1) as f64;
    let points: Vec<(f64, f64)> = (1..=BAND_POINTS)
        .map(|k| (weight * k as f64).sin_cos())
        .map(|(sin, cos)| (from + half * (1.0 - cos), weight * sin))
        .collect();
    let above = points.partition_point(|(speed, _)| *speed < band.peak_rad_per_s);
    let mut sum = 0.0;
    let (before, after) = points.split_at(above);
    let ways: [&mut dyn Iterator<Item = &(f64, f64)>; 2] =
        [&mut before.iter().rev(), &mut after.iter()];
    let at_peak = Growing::at_peak(band);
    for way in ways {
        let mut last = at_peak;
        for (speed, weight) in way {
            // Near an edge of the band the growth may be as small as rounding errors. Then no growing mode is
            // found, and the speed contributes nothing.
            let Some(next) = last.at(*speed, &model.modes(*speed)?, band.kind) else {
                continue;
            };
            sum += weight * next.lambda.re;
            last = next;
        }
    }
    Ok(sum * half)
}

/// A growing eigenvalue at a speed.
#[derive(Debug, Clone, Copy)]
struct Growing {
    speed: f64,
    lambda: c64,
    slope: c64,
    /// Component of the mode; `None` at the peak, where it is not known yet.
    component: Option<usize>,
}

impl Growing {
    fn at_peak(band: &Instability) -> Self {
        Growing {
            speed: band.peak_rad_per_s,
            lambda: c64::new(band.peak_growth_per_s, band.frequency_rad_per_s),
            slope: c64::default(),
            component: None,
        }
    }

    /// The eigenvalue at another speed: the growing mode that is nearest to the extrapolation.
    fn at(&self, speed: f64, modes: &[Mode], kind: InstabilityKind) -> Option<Self> {
        let kind = match kind {
            InstabilityKind::Divergence => ModeKind::Divergent,
            InstabilityKind::Flutter => ModeKind::Flutter,
        };
        let own = |mode: &&Mode| {
            mode.kind == kind && self.component.is_none_or(|own| own == mode.component)
        };
        let expected = self.expected(speed);
        let off = |mode: &Mode| (mode.lambda - expected).norm();
        let candidates = modes.iter().filter(own);
        let mode = candidates.min_by(|x, y| off(x).total_cmp(&off(y)))?;
        Some(Growing {
            speed,
            lambda: mode.lambda,
            slope: mode.slope,
            component: Some(mode.component),
        })
    }

    /// Extrapolates σ² and ω to a speed. They are smooth over the speed, unlike σ where growth starts.
    fn expected(&self, speed: f64) -> c64 {
        let step = speed - self.speed;
        let (sigma, omega) = (self.lambda.re, self.lambda.im);
        let square = sigma * (sigma + 2.0 * self.slope.re * step);
        c64::new(square.max(0.0).sqrt(), omega + self.slope.im * step)
    }
}
