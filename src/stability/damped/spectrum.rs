//! Eigenvalues of a damped blade at one speed, with their slopes.

use std::sync::atomic::{AtomicUsize, Ordering};

use faer::c64;

use crate::spectrum::{Mode, ModeKind, SpectralModel, SpectrumError};
use crate::tuned::Tuned;

/// Eigenvalues up to this multiple of the highest frequency that is sound are followed, so that
/// one that leaves the sound range is not taken for another that stays.
const MARGIN: Tuned = Tuned::new("stability/damped/spectrum::MARGIN", 1.3);
/// Growth below this share of the highest frequency is rounding.
const NOISE: f64 = 1e-10;
/// Spectra of one chart, at most: two orders above what a saw takes.
const MOST_SPECTRA: usize = 12_000;

/// An eigenvalue with Im λ ≥ 0.
#[derive(Debug, Clone, Copy)]
pub struct Eigenvalue {
    /// λ.
    pub lambda: c64,
    /// dλ/dΩ.
    pub slope: c64,
    /// Independent component of the blade that it belongs to.
    pub component: usize,
    /// Sign of the action, −1 for a reflected wave.
    pub action: i8,
}

impl Eigenvalue {
    /// The conjugate: the same motion.
    pub fn conj(self) -> Self {
        Eigenvalue {
            lambda: self.lambda.conj(),
            slope: self.slope.conj(),
            ..self
        }
    }
}

/// The eigenvalues of one speed.
#[derive(Debug, Clone)]
pub struct Spectrum {
    /// Ω.
    pub speed: f64,
    /// In no particular order.
    pub values: Vec<Eigenvalue>,
}

impl Spectrum {
    /// The eigenvalue of a component next to an expected one.
    pub fn nearest(&self, component: usize, expected: c64) -> Option<Eigenvalue> {
        let distance = |v: &Eigenvalue| (v.lambda - expected).norm();
        self.values
            .iter()
            .flat_map(|v| [*v, v.conj()])
            .filter(|v| v.component == component)
            .min_by(|x, y| distance(x).total_cmp(&distance(y)))
    }
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

    /// The eigenvalue of a component at a speed next to an expected one, or its conjugate.
    pub fn nearest(
        &self,
        speed: f64,
        component: usize,
        expected: c64,
    ) -> Result<Option<Eigenvalue>, SpectrumError> {
        let modes = self.modes(speed)?;
        let upper = c64::new(expected.re, expected.im.abs());
        let distance = |m: &&Mode| (m.lambda - upper).norm();
        let same = modes.iter().filter(|m| m.component == component);
        let nearest = same.min_by(|x, y| distance(x).total_cmp(&distance(y)));
        Ok(nearest.map(|mode| {
            let found = self.eigenvalue(speed, mode);
            if expected.im < 0.0 {
                found.conj()
            } else {
                found
            }
        }))
    }

    fn modes(&self, speed: f64) -> Result<Vec<Mode>, SpectrumError> {
        self.spent.fetch_add(1, Ordering::Relaxed);
        let mut modes = self.model.all_modes(speed)?;
        let highest = MARGIN.get() * self.highest();
        modes.retain(|m| m.kind != ModeKind::Rigid && m.lambda.im <= highest);
        Ok(modes)
    }

    fn eigenvalue(&self, speed: f64, mode: &Mode) -> Eigenvalue {
        let slope = self.model.eigenvalue_slope(speed, mode);
        let is_finite = slope.re.is_finite() && slope.im.is_finite();
        Eigenvalue {
            lambda: mode.lambda,
            // Where two eigenvalues meet.
            slope: if is_finite { slope } else { c64::new(0.0, 0.0) },
            component: mode.component,
            action: mode.action,
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
