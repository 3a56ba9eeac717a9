//! Growth rates of a system at one speed from eigenvalues alone, which takes a third of the time of modes.

use faer::c64;

use crate::linalg::real_eigenvalues;
use crate::system::GyroscopicSystem;

use super::companion::deflated_companion;
use super::error::SpectrumError;
use super::mode::{DAMPED_NOISE, GROWTH_NOISE};

/// Every eigenvalue with Im λ ≥ 0, in 1/s, without free rigid motions, in no particular order.
///
/// # Errors
/// [`SpectrumError`] when the eigenproblem fails.
pub fn eigenvalues(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
) -> Result<Vec<c64>, SpectrumError> {
    let (state, scale, _) = deflated_companion(system, speed_rad_per_s)?;
    let failed = SpectrumError::at(speed_rad_per_s);
    let values = real_eigenvalues(state.as_ref()).map_err(failed)?;
    let upper = values.into_iter().filter(|value| value.im >= 0.0);
    Ok(upper.map(|value| value * scale).collect())
}

/// Whether Re λ is positive beyond rounding.
pub fn grows(lambda: c64, speed_rad_per_s: f64, is_undamped: bool) -> bool {
    let noise = match is_undamped {
        true => GROWTH_NOISE * (lambda.norm() + speed_rad_per_s.abs()),
        false => DAMPED_NOISE * lambda.norm(),
    };
    lambda.re > noise
}

/// The eigenvalue of largest real part, Im λ ≥ 0; `None` for an undamped system without growth beyond
/// rounding.
///
/// # Errors
/// [`SpectrumError`] when the eigenproblem fails.
pub fn fastest_growing(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
) -> Result<Option<c64>, SpectrumError> {
    let is_undamped = system.is_conservative();
    let counts = |lambda: &c64| !is_undamped || grows(*lambda, speed_rad_per_s, is_undamped);
    let values = eigenvalues(system, speed_rad_per_s)?.into_iter();
    let fastest = values.filter(counts).max_by(|x, y| x.re.total_cmp(&y.re));
    Ok(fastest)
}
