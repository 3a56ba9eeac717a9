//! Eigenvalues of a damped blade at one speed, with their slopes.

use std::sync::atomic::{AtomicUsize, Ordering};

use faer::c64;

use crate::spectrum::{Mode, ModeKind, SpectralModel, SpectrumError};
use crate::stability::partition::Sample;
use crate::stability::pieces::Piece;

/// Growth below this share of the highest frequency is rounding.
const NOISE: f64 = 1e-10;
/// Spectra of one chart, at most: two orders above what a saw takes.
const MOST_SPECTRA: usize = 12_000;

/// Modes above the highest frequency that is sound among which a search finds a gap to end in.
const BESIDES: usize = 8;

/// An eigenvalue with Im λ ≥ 0.
#[derive(Debug, Clone, Copy)]
pub struct Eigenvalue {
    /// λ.
    pub lambda: c64,
    /// dλ/dΩ.
    pub slope: c64,
}

/// The eigenvalues of one speed.
#[derive(Debug, Clone)]
pub struct Spectrum {
    /// Ω.
    pub speed: f64,
    /// In no particular order.
    pub values: Vec<Eigenvalue>,
}

/// Computes spectra, and counts them.
pub struct Solver<'a> {
    model: &'a SpectralModel,
    spent: AtomicUsize,
}

impl<'a> Solver<'a> {
    /// For a model.
    pub fn new(model: &'a SpectralModel) -> Self {
        Solver {
            model,
            spent: AtomicUsize::new(0),
        }
    }

    /// The eigenvalues of a speed.
    pub fn at(&self, speed: f64) -> Result<Spectrum, SpectrumError> {
        let modes = self.modes(speed)?;
        let values = modes.iter().map(|mode| self.eigenvalue(speed, mode));
        Ok(Spectrum {
            speed,
            values: values.collect(),
        })
    }

    /// The spectra of a search on the one component of a saw.
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

    /// Those of a component as a sample of a search; `None` once no more may be asked for.
    pub fn sample(&self, speed: f64, component: usize) -> Result<Option<Sample>, SpectrumError> {
        if self.is_exhausted() {
            return Ok(None);
        }
        let mut modes = self.modes_of(speed, component)?;
        let is_followed = |mode: &Mode| mode.lambda.im <= self.highest();
        let followed = modes.iter().filter(|mode| is_followed(mode)).count();
        modes.sort_by(|x, y| x.lambda.im.total_cmp(&y.lambda.im));
        modes.truncate(followed + BESIDES);
        let sloped = modes.iter().map(|mode| {
            let found = self.eigenvalue(speed, mode);
            (found.lambda, found.slope)
        });
        Ok(Some(Sample::new(speed, sloped)))
    }

    /// The eigenvalue of a component at a speed next to an expected one.
    pub fn nearest(
        &self,
        speed: f64,
        component: usize,
        expected: c64,
    ) -> Result<Option<Eigenvalue>, SpectrumError> {
        let modes = self.modes_of(speed, component)?;
        let distance = |m: &&Mode| (m.lambda - expected).norm();
        let nearest = modes
            .iter()
            .min_by(|x, y| distance(x).total_cmp(&distance(y)));
        Ok(nearest.map(|mode| self.eigenvalue(speed, mode)))
    }

    fn modes_of(&self, speed: f64, component: usize) -> Result<Vec<Mode>, SpectrumError> {
        self.spent.fetch_add(1, Ordering::Relaxed);
        let mut modes = self.model.modes_of(component, speed)?;
        modes.retain(|m| m.kind != ModeKind::Rigid);
        Ok(modes)
    }

    fn modes(&self, speed: f64) -> Result<Vec<Mode>, SpectrumError> {
        self.spent.fetch_add(1, Ordering::Relaxed);
        let mut modes = self.model.all_modes(speed)?;
        modes.retain(|m| m.kind != ModeKind::Rigid && m.lambda.im <= self.highest());
        Ok(modes)
    }

    fn eigenvalue(&self, speed: f64, mode: &Mode) -> Eigenvalue {
        let slope = self.model.eigenvalue_slope(speed, mode);
        let is_finite = slope.re.is_finite() && slope.im.is_finite();
        Eigenvalue {
            lambda: mode.lambda,
            // Where two eigenvalues meet.
            slope: if is_finite { slope } else { c64::new(0.0, 0.0) },
        }
    }

    /// Frequency up to which eigenvalues are complete and accurate.
    pub fn highest(&self) -> f64 {
        self.model.complete_to_rad_per_s
    }

    /// Growth that is rounding: of λ it is relative to the blade's frequencies, not to a
    /// vanishing λ.
    pub fn noise(&self) -> f64 {
        NOISE * self.highest()
    }

    /// Whether no more spectra are allowed.
    pub fn is_exhausted(&self) -> bool {
        self.spent.load(Ordering::Relaxed) >= MOST_SPECTRA
    }
}
