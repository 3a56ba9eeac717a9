//! All eigenvalues of the quadratic problem, by its companion matrix.

use faer::reborrow::ReborrowMut;
use faer::{Mat, Scale, c64};

use crate::system::GyroscopicSystem;

use super::deflation::Deflation;
use super::error::SpectrumError;
use super::real_eigen::RealEigen;
use super::vectors::{Eigenpair, by_magnitude, complex, unit};
use super::work::Cancellation;

/// The power of two nearest to the root mean square of the natural frequencies. Scaling time by it is exact
/// and balances the blocks of the companion matrix: faer does not balance, and unscaled SI matrices lose six
/// digits.
pub fn time_scale(stiffness: &Mat<f64>) -> f64 {
    let mean_square = stiffness.norm_l2() / (stiffness.nrows().max(1) as f64).sqrt();
    let frequency = mean_square.sqrt();
    if frequency > 0.0 {
        frequency.log2().round().exp2()
    } else {
        1.0
    }
}

/// The companion matrix of x = (q, q̇/s), in units of s, and the scale s, in 1/s.
///
/// # Errors
/// [`SpectrumError::NotFinite`].
pub(super) fn companion(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
) -> Result<(Mat<f64>, f64), SpectrumError> {
    let stiffness = system.stiffness_at(speed_rad_per_s);
    let velocity = system.velocity_at(speed_rad_per_s);
    let size = system.order();
    if !(stiffness.is_all_finite() && velocity.is_all_finite()) {
        return Err(SpectrumError::not_finite(2 * size, speed_rad_per_s));
    }
    let scale = time_scale(&stiffness);
    let mut state = Mat::zeros(2 * size, 2 * size);
    let (mut top, mut bottom) = state.as_mut().split_at_row_mut(size);
    top.rb_mut()
        .subcols_mut(size, size)
        .copy_from(Mat::<f64>::identity(size, size));
    bottom
        .rb_mut()
        .subcols_mut(0, size)
        .copy_from(Scale(-1.0 / scale.powi(2)) * &stiffness);
    bottom
        .rb_mut()
        .subcols_mut(size, size)
        .copy_from(Scale(-1.0 / scale) * &velocity);
    Ok((state, scale))
}

/// The matrix of [`companion`] without the free rigid motions, s, and the deflation if there are such motions.
pub(super) fn deflated_companion(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
) -> Result<(Mat<f64>, f64, Option<Deflation>), SpectrumError> {
    Cancellation::current().check()?;
    let (state, scale) = companion(system, speed_rad_per_s)?;
    let deflation = Deflation::new(system, speed_rad_per_s, scale);
    let state = match &deflation {
        Some(Deflation { kept, .. }) => kept.transpose() * state * kept,
        None => state,
    };
    Ok((state, scale, deflation))
}

/// Eigenpairs with Im λ ≥ 0, ‖q‖ = 1, ordered by |λ|; the others are their conjugates. Each free rigid motion
/// has one, with λ = 0 exactly.
///
/// # Errors
/// [`SpectrumError::NotFinite`], [`SpectrumError::NoConvergence`] or [`SpectrumError::Cancelled`].
pub fn companion_eigenpairs(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
) -> Result<Vec<Eigenpair>, SpectrumError> {
    let (state, scale, deflation) = deflated_companion(system, speed_rad_per_s)?;
    let size = system.order();
    let failed = |_| SpectrumError::no_convergence(state.nrows(), speed_rad_per_s);
    let eigen = RealEigen::new(state.as_ref()).map_err(failed)?;
    let displacement = |i: usize| match &deflation {
        Some(deflation) => deflation.displacement(eigen.values[i], &eigen.vector(i)),
        None => eigen.vector(i).subrows(0, size).to_owned(),
    };
    let free = deflation.iter().flat_map(|_| &system.free_rigid);
    let free = free.map(|z| (c64::new(0.0, 0.0), complex(z)));
    let pairs = eigen
        .upper()
        .into_iter()
        .map(|i| (eigen.values[i] * scale, unit(displacement(i).as_ref())))
        .chain(free)
        .collect();
    Ok(by_magnitude(pairs))
}
