//! The saw with the delayed force of the cut at one speed.
//!
//! det(L(λ) + k h(λ) BBᵀ) = det L(λ) · det(1 + k X(λ)), X = h G: eigenvalues are where the small
//! determinant vanishes, and 1 + k x_i are its factors, x_i the eigenvalues of the loop gain X.

use faer::{Mat, c64};
use nalgebra::{DMatrix, Schur};

use crate::scene::Washboarding;
use crate::spectrum::SpectrumError;
use crate::system::GyroscopicSystem;

use super::boundary::Boundary;
use super::delay::Delay;
use super::transfer::Transfer;

/// The saw at a speed: its modes without the delayed force, and the delay.
#[derive(Debug)]
pub struct DelayedSaw {
    pub(super) transfer: Transfer,
    pub(super) delay: Delay,
    /// ‖D‖, ‖K‖ and ‖BBᵀ‖, by which everything far out is bounded.
    norms: [f64; 3],
}

impl DelayedSaw {
    /// Of a system, the columns B of the arc with the flexibility of what is left out, and the delays at
    /// a speed.
    ///
    /// # Errors
    /// [`SpectrumError`] where the eigenproblem fails.
    pub fn new(
        system: &GyroscopicSystem,
        (columns, flexibility): (&Mat<f64>, DMatrix<f64>),
        washboarding: &Washboarding,
        speed_rad_per_s: f64,
    ) -> Result<Self, SpectrumError> {
        Ok(DelayedSaw {
            transfer: Transfer::new(system, (columns, flexibility), speed_rad_per_s)?,
            delay: Delay::new(washboarding, speed_rad_per_s),
            norms: [
                system.velocity_at(speed_rad_per_s).norm_l2(),
                system.stiffness_at(speed_rad_per_s).norm_l2(),
                columns.norm_l2().powi(2),
            ],
        })
    }

    /// X(λ) = h(λ) G(λ), in m/N.
    pub fn gain(&self, lambda: c64) -> DMatrix<c64> {
        self.transfer.at(lambda) * self.delay.at(lambda)
    }

    /// Eigenvalues of X(iω). `None` where it is not finite: on an eigenvalue of the saw.
    pub fn gains(&self, omega: f64) -> Option<Vec<c64>> {
        const MOST_ITERATIONS: usize = 10_000;
        let gain = self.gain(c64::new(0.0, omega));
        if !gain.iter().all(|x| x.is_finite()) {
            return None;
        }
        if gain.nrows() == 1 {
            return Some(vec![gain[(0, 0)]]);
        }
        let schur = Schur::try_new(gain, f64::EPSILON, MOST_ITERATIONS)?;
        let (_, triangle) = schur.unpack();
        Some(triangle.diagonal().iter().copied().collect())
    }

    /// d ln det(1 + k X)/dλ = tr((1 + kX)⁻¹ k dX/dλ).
    pub fn logarithmic_slope(&self, stiffness: f64, lambda: c64) -> Option<c64> {
        let [transfer, slope] = self.transfer.with_slope(lambda);
        let (delay, delay_slope) = (self.delay.at(lambda), self.delay.slope(lambda));
        let k = c64::new(stiffness, 0.0);
        let change = (&transfer * delay_slope + slope * delay) * k;
        let unit = DMatrix::<c64>::identity(transfer.nrows(), transfer.nrows());
        let solved = (unit + transfer * (delay * k)).lu().solve(&change)?;
        let trace = solved.trace();
        trace.is_finite().then_some(trace)
    }

    /// Eigenvalues of the saw without the delayed force that lie in the right half plane.
    pub fn unstable_poles(&self) -> usize {
        self.transfer.poles.iter().filter(|p| p.re > 0.0).count()
    }

    /// The boundary of a saw of which something grows without the delayed force, at no stiffness.
    pub fn grows_without(&self) -> Option<Boundary> {
        let growing = self.transfer.poles.iter().filter(|pole| pole.re > 0.0);
        let fastest = growing.max_by(|x, y| x.re.total_cmp(&y.re))?;
        Some(Boundary {
            stiffness_n_per_m: 0.0,
            frequency_rad_per_s: fastest.im.abs(),
        })
    }

    /// Whether k(X − hF) may be larger than ½ at iω for stiffnesses up to one; where it is not, every factor
    /// 1 + k x_i has a positive real part, as F is positive and so is the real part of h.
    pub fn matters(&self, omega: f64, stiffness: f64) -> bool {
        let size = self.transfer.modal_bound(c64::new(0.0, omega));
        let part = stiffness * self.delay.bound() * size;
        part > 0.5 || part.is_nan()
    }

    /// |λ| from which on nothing lies in the right half plane, however the phase of the delay falls:
    /// there |h| ≤ 1 + μ and ‖L(λ)⁻¹‖ ≤ 1/(|λ|² − |λ|‖D‖ − ‖K‖), so that beyond the root of
    /// |λ|² − |λ|‖D‖ − ‖K‖ = 2k(1 + μ)‖BBᵀ‖ the part kX − khF is no larger than ½. The real part of
    /// 1 + khF is at least one, for that of h is not negative, and F is positive: every factor
    /// 1 + k x_i has a positive real part.
    pub fn reach(&self, stiffness: f64) -> f64 {
        let [velocity, own, arc] = self.norms;
        let square = own + 2.0 * stiffness * self.delay.bound() * arc;
        0.5 * (velocity + (velocity * velocity + 4.0 * square).sqrt())
    }
}
