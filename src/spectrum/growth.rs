//! How fast the motion of a saw grows at one speed, from eigenvalues alone: for saws that
//! are looked at once, such as one in the cut. A third of the work of modes.

use faer::c64;

use crate::plate::Plate;
use crate::scene::rpm;
use crate::system::GyroscopicSystem;

use super::SpectrumError;
use super::dense::{companion, time_scale};
use super::mode::{GROWTH_NOISE, RIGID_NOISE};
use super::part::Part;

/// The eigenvalue of largest real part, Im λ ≥ 0; `None` for an undamped system of which
/// no motion grows beyond rounding. Rigid motions that nothing holds have defective
/// zeros, known to √ε only: with `has_free_rigid_motions` they are passed over.
///
/// # Errors
/// [`SpectrumError`] when the eigenproblem fails.
pub fn fastest_growing(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
    has_free_rigid_motions: bool,
) -> Result<Option<c64>, SpectrumError> {
    let (state, scale) = companion(system, speed_rad_per_s)?;
    let values = state
        .eigenvalues()
        .map_err(|_| SpectrumError::NoConvergence {
            order: state.nrows(),
            rpm: rpm(speed_rad_per_s),
        })?;
    let rigid = match has_free_rigid_motions {
        true => RIGID_NOISE * time_scale(&system.stiffness),
        false => 0.0,
    };
    let counts = values
        .iter()
        .map(|value| *value * scale)
        .filter(|lambda: &c64| {
            let noise = GROWTH_NOISE * (lambda.norm() + speed_rad_per_s.abs());
            let grows = !system.is_conservative() || lambda.re > noise;
            lambda.im >= 0.0 && lambda.norm() >= rigid && grows
        });
    Ok(counts.max_by(|x, y| x.re.total_cmp(&y.re)))
}

/// The same for a plate, on its whole basis.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub fn fastest_growing_of(
    plate: &Plate,
    speed_rad_per_s: f64,
) -> Result<Option<c64>, SpectrumError> {
    let mut fastest: Option<c64> = None;
    for part in Part::of(plate) {
        let free_rigid = !part.full.free_rigid.is_empty();
        let found = fastest_growing(&part.full, speed_rad_per_s, free_rigid)?;
        fastest = [fastest, found]
            .into_iter()
            .flatten()
            .max_by(|x, y| x.re.total_cmp(&y.re));
    }
    Ok(fastest)
}

/// Whether heave, a tilt or a mixture of them has no stiffness.
pub fn has_free_rigid_motions(plate: &Plate) -> bool {
    Part::of(plate)
        .iter()
        .any(|part| !part.full.free_rigid.is_empty())
}
