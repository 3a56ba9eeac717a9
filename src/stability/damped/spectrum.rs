//! Eigenvalues of a damped blade at one speed, with their slopes.

use std::sync::atomic::{AtomicUsize, Ordering};

use faer::c64;

use crate::spectrum::{ModeKind, SpectralModel, SpectrumError, smallest};
use crate::stability::group::Sloped;
use crate::stability::partition::{BESIDES, Sample};
use crate::stability::pieces::Piece;

/// Growth below this share of the highest accurate frequency is rounding.
const NOISE: f64 = 1e-10;
/// Largest number of spectra in one chart, a hundred times as many as usual saws need.
const MOST_SPECTRA: usize = 12_000;
/// An eigenvalue at more than this share of its size from the expected one may be another eigenvalue.
const SAME: f64 = 1e-5;

/// Eigenvalues at one speed.
#[derive(Debug, Clone)]
pub struct Spectrum {
    /// Rotation speed Ω.
    pub speed: f64,
    /// Eigenvalues with Im λ ≥ 0 up to the highest accurate frequency, in 1/s, in no particular order.
    pub values: Vec<c64>,
}

/// Computes the spectra of a model, and counts them.
pub struct Solver<'a> {
    model: &'a SpectralModel,
    spent: AtomicUsize,
}

impl<'a> Solver<'a> {
    /// A solver for a model.
    pub fn new(model: &'a SpectralModel) -> Self {
        Solver {
            model,
            spent: AtomicUsize::new(0),
        }
    }

    /// Computes the eigenvalues at a speed.
    pub fn at(&self, speed: f64) -> Result<Spectrum, SpectrumError> {
        let mut values = Vec::new();
        for component in 0..self.model.components.len() {
            let sloped = self.eigenvalues(speed, component)?;
            values.extend(sloped.into_iter().map(|(lambda, _)| lambda));
        }
        values.retain(|lambda| lambda.im <= self.highest());
        Ok(Spectrum { speed, values })
    }

    /// The spectra at the speeds of a search, for a saw of one component.
    pub fn spectra(&self, pieces: &[Piece]) -> Vec<Spectrum> {
        let of = |sample: &Sample| {
            let all = sample.eigenvalues.iter().map(|(lambda, _)| *lambda);
            let upper = all.filter(|lambda| (0.0..=self.highest()).contains(&lambda.im));
            Spectrum {
                speed: sample.speed_rad_per_s,
                values: upper.collect(),
            }
        };
        let first = pieces.first().map(|piece| of(&piece.ends[0]));
        let others = pieces.iter().map(|piece| of(&piece.ends[1]));
        first.into_iter().chain(others).collect()
    }

    /// Computes the low eigenvalues of a component as a sample for a search; `None` once the allowed number of
    /// spectra is used up.
    pub fn sample(&self, speed: f64, component: usize) -> Result<Option<Sample>, SpectrumError> {
        if self.is_exhausted() {
            return Ok(None);
        }
        let mut values = self.eigenvalues(speed, component)?;
        values.sort_by(|x, y| x.0.im.total_cmp(&y.0.im));
        let followed = values.partition_point(|(lambda, _)| lambda.im <= self.highest());
        values.truncate(followed + BESIDES);
        Ok(Some(Sample::new(speed, values.into_iter())))
    }

    /// Eigenvalue of a component at a speed nearest to an expected one, with its slope.
    pub fn nearest(
        &self,
        speed: f64,
        component: usize,
        expected: c64,
    ) -> Result<Option<Sloped>, SpectrumError> {
        let distance = |(lambda, _): &Sloped| (lambda - expected).norm();
        let found = self.model.eigenvalue_next_to(component, speed, expected);
        if let Some(found) = found.filter(|found| distance(found) <= SAME * expected.norm()) {
            return Ok(Some(found));
        }
        Ok(smallest(self.eigenvalues(speed, component)?, distance))
    }

    /// Eigenvalues of a component with Im λ ≥ 0, without free rigid motions, and their slopes.
    fn eigenvalues(&self, speed: f64, component: usize) -> Result<Vec<Sloped>, SpectrumError> {
        self.spent.fetch_add(1, Ordering::Relaxed);
        let modes = self.model.modes_of(component, speed)?;
        let slopes = self.model.eigenvalue_slopes(component, speed, &modes);
        let all = modes.iter().zip(slopes);
        let elastic = all.filter(|(mode, _)| mode.kind != ModeKind::Rigid);
        Ok(elastic
            .map(|(mode, slope)| (mode.lambda, finite(slope)))
            .collect())
    }

    /// Frequency up to which eigenvalues are complete and accurate.
    pub fn highest(&self) -> f64 {
        self.model.complete_to_rad_per_s
    }

    /// Growth rate, in 1/s, that is rounding, which is relative to the blade's frequencies and not to a small λ.
    pub fn noise(&self) -> f64 {
        NOISE * self.highest()
    }

    /// Whether the allowed number of spectra is used up.
    pub fn is_exhausted(&self) -> bool {
        self.spent.load(Ordering::Relaxed) >= MOST_SPECTRA
    }
}

/// A slope, or zero at the coalescence of two eigenvalues, where it is not finite.
pub fn finite(slope: c64) -> c64 {
    match slope.is_finite() {
        true => slope,
        false => c64::new(0.0, 0.0),
    }
}
