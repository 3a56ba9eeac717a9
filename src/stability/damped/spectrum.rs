//! Eigenvalues of a damped blade at one speed, with their slopes.

use std::sync::atomic::{AtomicUsize, Ordering};

use faer::c64;

use crate::spectrum::{ModeKind, SpectralModel, SpectrumError};
use crate::stability::partition::Sample;
use crate::stability::pieces::Piece;

/// Growth below this share of the highest frequency is rounding.
const NOISE: f64 = 1e-10;
/// Largest number of spectra in one chart: a hundred times what a saw needs.
const MOST_SPECTRA: usize = 12_000;

/// Number of modes above the highest accurate frequency among which a search finds a gap to end in.
const BESIDES: usize = 8;

/// An eigenvalue further than this share of its size from the prediction may be another one.
const SAME: f64 = 1e-5;

/// An eigenvalue with Im λ ≥ 0.
#[derive(Debug, Clone, Copy)]
pub struct Eigenvalue {
    /// Eigenvalue λ.
    pub lambda: c64,
    /// Derivative dλ/dΩ.
    pub slope: c64,
}

/// Eigenvalues at one speed.
#[derive(Debug, Clone)]
pub struct Spectrum {
    /// Rotation speed Ω.
    pub speed: f64,
    /// Eigenvalues in no particular order.
    pub values: Vec<Eigenvalue>,
}

/// Computes spectra, and counts them.
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
            values.extend(self.eigenvalues(speed, component)?);
        }
        values.retain(|value| value.lambda.im <= self.highest());
        Ok(Spectrum { speed, values })
    }

    /// Computes the spectra of a search, for a saw of one component.
    pub fn spectra(&self, pieces: &[Piece]) -> Vec<Spectrum> {
        let of = |sample: &Sample| {
            let upper = sample
                .eigenvalues
                .iter()
                .filter(|(z, _)| (0.0..=self.highest()).contains(&z.im));
            Spectrum {
                speed: sample.speed_rad_per_s,
                values: upper
                    .map(|&(lambda, slope)| Eigenvalue { lambda, slope })
                    .collect(),
            }
        };
        let first = pieces.first().map(|piece| of(&piece.ends[0]));
        let others = pieces.iter().map(|piece| of(&piece.ends[1]));
        first.into_iter().chain(others).collect()
    }

    /// Computes eigenvalues of a component as a sample for a search; `None` once the allowed number is used
    /// up.
    pub fn sample(&self, speed: f64, component: usize) -> Result<Option<Sample>, SpectrumError> {
        if self.is_exhausted() {
            return Ok(None);
        }
        let mut values = self.eigenvalues(speed, component)?;
        values.sort_by(|x, y| x.lambda.im.total_cmp(&y.lambda.im));
        let followed = values.partition_point(|value| value.lambda.im <= self.highest());
        values.truncate(followed + BESIDES);
        let sloped = values.iter().map(|value| (value.lambda, value.slope));
        Ok(Some(Sample::new(speed, sloped)))
    }

    /// Eigenvalue of a component at a speed nearest to an expected one.
    pub fn nearest(
        &self,
        speed: f64,
        component: usize,
        expected: c64,
    ) -> Result<Option<Eigenvalue>, SpectrumError> {
        let found = self.model.eigenvalue_next_to(component, speed, expected);
        let is_same = |lambda: c64| (lambda - expected).norm() <= SAME * expected.norm();
        if let Some((lambda, slope)) = found.filter(|(lambda, _)| is_same(*lambda)) {
            return Ok(Some(Eigenvalue { lambda, slope }));
        }
        let values = self.eigenvalues(speed, component)?;
        let distance = |value: &Eigenvalue| (value.lambda - expected).norm();
        let nearest = values
            .into_iter()
            .min_by(|x, y| distance(x).total_cmp(&distance(y)));
        Ok(nearest)
    }

    /// Eigenvalues of a component without its rigid motions.
    fn eigenvalues(&self, speed: f64, component: usize) -> Result<Vec<Eigenvalue>, SpectrumError> {
        self.spent.fetch_add(1, Ordering::Relaxed);
        let modes = self.model.modes_of(component, speed)?;
        let slopes = self.model.eigenvalue_slopes(component, speed, &modes);
        let is_finite = |slope: c64| slope.re.is_finite() && slope.im.is_finite();
        let values = modes
            .iter()
            .zip(slopes)
            .filter(|(mode, _)| mode.kind != ModeKind::Rigid)
            .map(|(mode, slope)| Eigenvalue {
                lambda: mode.lambda,
                // At the coalescence of two eigenvalues the slope is not finite.
                slope: if is_finite(slope) {
                    slope
                } else {
                    c64::new(0.0, 0.0)
                },
            });
        Ok(values.collect())
    }

    /// Frequency up to which eigenvalues are complete and accurate.
    pub fn highest(&self) -> f64 {
        self.model.complete_to_rad_per_s
    }

    /// Growth that is rounding: relative to the blade's frequencies, not to a vanishing λ.
    pub fn noise(&self) -> f64 {
        NOISE * self.highest()
    }

    /// Whether the allowed number of spectra is used up.
    pub fn is_exhausted(&self) -> bool {
        self.spent.load(Ordering::Relaxed) >= MOST_SPECTRA
    }
}
