//! How fast the motion of a saw grows at one speed, from eigenvalues alone: for saws that
//! are looked at once, such as one in the cut. A third of the work of modes.

use faer::{Col, c64};

use crate::plate::Plate;
use crate::scene::rpm;
use crate::system::GyroscopicSystem;

use super::arnoldi::lowest_eigenpairs;
use super::companion::{companion_eigenpairs, deflated_companion};
use super::component::Component;
use super::error::SpectrumError;
use super::hermitian::negative_eigenvalues;
use super::mode::{GROWTH_NOISE, Mode, classify, pairs_of};
use super::projection::Projection;
use super::real_eigen::real_eigenvalues;
use super::residual::MatrixNorms;
use super::scale::frequency_scale;
use super::vectors::{orthonormal, split};

/// The eigenvalue of largest real part, Im λ ≥ 0; `None` for an undamped system of which
/// no motion grows beyond rounding.
///
/// # Errors
/// [`SpectrumError`] when the eigenproblem fails.
pub fn fastest_growing(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
) -> Result<Option<c64>, SpectrumError> {
    let (state, scale, _) = deflated_companion(system, speed_rad_per_s)?;
    let values = real_eigenvalues(state.as_ref()).map_err(|_| SpectrumError::NoConvergence {
        order: state.nrows(),
        rpm: rpm(speed_rad_per_s),
    })?;
    // A maximum would pass over what is not a number.
    if !values.iter().all(|value| value.is_finite()) {
        return Err(SpectrumError::NotFinite {
            order: state.nrows(),
            rpm: rpm(speed_rad_per_s),
        });
    }
    let counts = values
        .iter()
        .map(|value| *value * scale)
        .filter(|lambda: &c64| {
            let noise = GROWTH_NOISE * (lambda.norm() + speed_rad_per_s.abs());
            let grows = !system.is_conservative() || lambda.re > noise;
            lambda.im >= 0.0 && grows
        });
    Ok(counts.max_by(|x, y| x.re.total_cmp(&y.re)))
}

/// The same for a plate, on its full model.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub fn fastest_growing_of(
    plate: &Plate,
    speed_rad_per_s: f64,
) -> Result<Option<c64>, SpectrumError> {
    let scale = frequency_scale(plate);
    let mut fastest: Option<c64> = None;
    for component in Component::of(plate) {
        let found = match certified(&component, scale, speed_rad_per_s)? {
            Some(found) => found,
            None => fastest_growing(&component.full, speed_rad_per_s)?,
        };
        fastest = [fastest, found]
            .into_iter()
            .flatten()
            .max_by(|x, y| x.re.total_cmp(&y.re));
    }
    Ok(fastest)
}

/// Below this order all eigenvalues cost no more than a few with their proof.
const SMALL: usize = 150;
/// Modes that are looked at; a saw run past more critical speeds takes the long way.
const LOOKED_AT: usize = 16;
/// Backward error of a mode that counts.
const CONVERGED: f64 = 1e-9;

/// The fastest growing of the lowest modes, when the Krein index proves that no other
/// grows: the negative eigenvalues of K(Ω) on the full model are all accounted for by
/// divergent, flutter and reflected modes among the lowest. A tenth of the work of every
/// eigenvalue. `None` where there is no such proof.
fn certified(
    component: &Component,
    scale: f64,
    speed_rad_per_s: f64,
) -> Result<Option<Option<c64>>, SpectrumError> {
    let full = &component.full;
    if full.order() < SMALL || !full.is_conservative() || !component.full.free_rigid.is_empty() {
        return Ok(None);
    }
    let stiffness = full.stiffness_at(speed_rad_per_s);
    let Some(negative) = negative_eigenvalues(&stiffness) else {
        return Ok(None);
    };
    let vectors: Vec<Col<f64>> = lowest_eigenpairs(full, speed_rad_per_s, LOOKED_AT, scale)?
        .into_iter()
        .flat_map(|(_, q)| {
            let (re, im) = split(&q);
            [re, im]
        })
        .collect();
    let basis = orthonormal(full.order(), &vectors, 1e-9);
    let projection = Projection::new(full, None, basis);
    let reduced = &projection.reduced;
    let pairs = companion_eigenpairs(reduced, speed_rad_per_s)?;
    let modes = classify(reduced, speed_rad_per_s, 0, pairs);
    let norms = MatrixNorms::new(full);
    let lifted = projection.lifted(speed_rad_per_s, &pairs_of(&modes));
    let modes: Vec<&Mode> = modes
        .iter()
        .zip(&lifted)
        .filter(|(mode, lifted)| {
            norms.backward_error(speed_rad_per_s, mode.lambda, lifted) < CONVERGED
        })
        .map(|(mode, _)| mode)
        .collect();
    let index: usize = modes.iter().map(|mode| mode.kind.krein_index()).sum();
    if index != negative {
        return Ok(None);
    }
    let growing = modes.iter().filter(|mode| mode.growth_per_s() > 0.0);
    let fastest = growing.max_by(|x, y| x.lambda.re.total_cmp(&y.lambda.re));
    Ok(Some(fastest.map(|mode| mode.lambda)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plate::{Resolution, RimForce};
    use crate::scene::{Scene, rad_per_s};

    /// In and out of bands and of the cut, the short way tells what every eigenvalue tells.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "dense solves: run it in release")]
    fn the_proven_few_are_the_fastest_of_all() {
        let resolution = Resolution {
            max_diameters: 12,
            radial_functions: 7,
        };
        let idle = Plate::new(&Scene::paper(), resolution);
        let pushed = idle.with_edge_loads(&[RimForce {
            angle_rad: 0.1,
            radial_n: -300.0,
            tangential_n: -4500.0,
        }]);
        let mut proven = 0;
        for plate in [&idle, &pushed] {
            let component = &Component::of(plate)[0];
            for rpm in [600.0, 1540.0, 1800.0, 2110.0, 2262.0, 2800.0] {
                let speed = rad_per_s(rpm);
                let all = fastest_growing(&component.full, speed).unwrap();
                let Some(few) = certified(component, frequency_scale(plate), speed).unwrap() else {
                    continue;
                };
                proven += 1;
                let (all, few) = (all.unwrap_or_default(), few.unwrap_or_default());
                assert!(
                    (all - few).norm() <= 1e-6 * (1.0 + all.norm()),
                    "{rpm}: {all} {few}"
                );
            }
        }
        assert_eq!(proven, 12);
    }
}
