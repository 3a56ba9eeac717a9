//! Growth rates of a system at one speed from eigenvalues alone, which takes a third of the time of modes.

use faer::c64;

use crate::model::linalg::real_eigenvalues;
use crate::model::system::GyroscopicSystem;

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
    let noise = if is_undamped {
        GROWTH_NOISE * (lambda.norm() + speed_rad_per_s.abs())
    } else {
        DAMPED_NOISE * lambda.norm()
    };
    lambda.re > noise
}

/// How the motions of a system grow at one speed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Growing {
    /// The eigenvalue of largest real part, Im λ ≥ 0; `None` for an undamped system without growth beyond
    /// rounding.
    pub fastest: Option<c64>,
    /// Whether a motion grows without oscillation, the fastest one or another.
    pub diverges: bool,
}

impl Growing {
    /// Growth of a system at a speed.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn at(system: &GyroscopicSystem, speed_rad_per_s: f64) -> Result<Self, SpectrumError> {
        let values = eigenvalues(system, speed_rad_per_s)?;
        Ok(Self::of(&values, speed_rad_per_s, system.is_conservative()))
    }

    /// Growth of a system with these eigenvalues at a speed.
    pub fn of(values: &[c64], speed_rad_per_s: f64, is_undamped: bool) -> Self {
        let grows = |lambda: &c64| grows(*lambda, speed_rad_per_s, is_undamped);
        let known = values.iter().filter(|lambda| !is_undamped || grows(lambda));
        Growing {
            fastest: known.max_by(|x, y| x.re.total_cmp(&y.re)).copied(),
            diverges: values
                .iter()
                .any(|lambda| lambda.im == 0.0 && grows(lambda)),
        }
    }
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
    Ok(Growing::at(system, speed_rad_per_s)?.fastest)
}
