//! The saw with the delayed cutting force at one speed.
//!
//! det(L(λ) + k h(λ) BBᵀ) = det L(λ) · det(1 + k X(λ)) with X = h G. Eigenvalues are the zeros of the small
//! determinant, whose factors are 1 + k x_i with the eigenvalues x_i of the loop gain X.

use faer::{Mat, c64};
use nalgebra::DMatrix;

use crate::model::linalg::{complex_eigenvalues, view};
use crate::model::scene::Washboarding;
use crate::model::system::GyroscopicSystem;
use crate::modes::SpectrumError;

use super::delay::Delay;
use super::transfer::Transfer;

/// The smallest cutting stiffness at which a vibration grows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Boundary {
    /// Cutting stiffness; zero if a vibration grows without the delayed force.
    pub stiffness_n_per_m: f64,
    /// Frequency of the motion in space.
    pub frequency_rad_per_s: f64,
}

/// The saw at a speed: its modes without the delayed force, and the delay.
#[derive(Debug)]
pub struct DelayedSaw {
    pub(super) transfer: Transfer,
    pub(super) delay: Delay,
    /// ‖D‖, ‖K‖ and ‖BBᵀ‖, for bounds at large |λ|.
    norms: [f64; 3],
}

impl DelayedSaw {
    /// The saw of a system, the columns B of the arc, the flexibility of the omitted shapes, and the delays at a
    /// speed.
    ///
    /// # Errors
    /// [`SpectrumError`] if the eigenproblem fails.
    pub fn new(
        system: &GyroscopicSystem,
        columns: &Mat<f64>,
        flexibility: DMatrix<f64>,
        washboarding: &Washboarding,
        speed_rad_per_s: f64,
    ) -> Result<Self, SpectrumError> {
        Ok(DelayedSaw {
            transfer: Transfer::new(system, columns, flexibility, speed_rad_per_s)?,
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

    /// Eigenvalues of X(iω) in m/N; `None` if they are not finite because iω is an eigenvalue of the saw.
    pub fn gains(&self, omega: f64) -> Option<Vec<c64>> {
        let gain = self.gain(c64::new(0.0, omega));
        if !gain.iter().all(|x| x.is_finite()) {
            return None;
        }
        if gain.nrows() == 1 {
            return Some(vec![gain[(0, 0)]]);
        }
        complex_eigenvalues(view(&gain)).ok()
    }

    /// d ln det(1 + k X)/dλ = tr((1 + kX)⁻¹ k dX/dλ); `None` if the matrix is singular.
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

    /// Number of eigenvalues of the saw without the delayed force in the right half plane.
    pub fn unstable_poles(&self) -> usize {
        self.transfer.poles.iter().filter(|p| p.re > 0.0).count()
    }

    /// The boundary at zero stiffness, if the saw is unstable without the delayed force.
    pub fn grows_without(&self) -> Option<Boundary> {
        let growing = self.transfer.poles.iter().filter(|pole| pole.re > 0.0);
        let fastest = growing.max_by(|x, y| x.re.total_cmp(&y.re))?;
        Some(Boundary {
            stiffness_n_per_m: 0.0,
            frequency_rad_per_s: fastest.im.abs(),
        })
    }

    /// Whether ‖k(X − hF)‖ may exceed ½ at iω for stiffnesses k up to the given one. If it cannot, every factor
    /// 1 + k x_i has a positive real part, because F is positive definite and Re h ≥ 0.
    pub fn matters(&self, omega: f64, stiffness: f64) -> bool {
        let size = self.transfer.modal_bound(c64::new(0.0, omega));
        let part = stiffness * self.delay.bound() * size;
        part > 0.5 || part.is_nan()
    }

    /// |λ| in 1/s beyond which no eigenvalue is in the right half plane, whatever the phase of the delay: there
    /// |h| ≤ 1 + μ and ‖L(λ)⁻¹‖ ≤ 1/(|λ|² − |λ|‖D‖ − ‖K‖), so that beyond the root of
    /// |λ|² − |λ|‖D‖ − ‖K‖ = 2k(1 + μ)‖BBᵀ‖ the norm of kX − khF is at most ½. The real part of 1 + khF is
    /// at least one, because Re h ≥ 0 and F is positive definite: every factor 1 + k x_i has a positive real
    /// part.
    pub fn reach(&self, stiffness: f64) -> f64 {
        let [velocity, own, arc] = self.norms;
        let square = own + 2.0 * stiffness * self.delay.bound() * arc;
        0.5 * (velocity + (velocity * velocity + 4.0 * square).sqrt())
    }
}
