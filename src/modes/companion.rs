//! All eigenvalues of the quadratic problem, by its companion matrix.

use faer::reborrow::ReborrowMut;
use faer::{Mat, Scale, c64};

use crate::model::linalg::RealEigen;
use crate::model::system::GyroscopicSystem;

use super::deflation::Deflation;
use super::error::SpectrumError;
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
/// [`SpectrumError::NotFinite`], [`SpectrumError::Decomposition`] or [`SpectrumError::Cancelled`].
pub fn companion_eigenpairs(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
) -> Result<Vec<Eigenpair>, SpectrumError> {
    let (state, scale, deflation) = deflated_companion(system, speed_rad_per_s)?;
    let size = system.order();
    let failed = SpectrumError::at(speed_rad_per_s);
    let eigen = RealEigen::new(state.as_ref()).map_err(failed)?;
    let displacement = |i: usize| match &deflation {
        Some(deflation) => deflation.displacement(eigen.values[i], &eigen.vector(i)),
        None => eigen.vector(i).subrows(0, size).to_owned(),
    };
    let free = deflation
        .iter()
        .flat_map(|_| &system.free_rigid)
        .map(|z| (c64::new(0.0, 0.0), complex(z)));
    let pairs = eigen
        .upper()
        .into_iter()
        .map(|i| (eigen.values[i] * scale, unit(displacement(i).as_ref())))
        .chain(free)
        .collect();
    Ok(by_magnitude(pairs))
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;
    use std::time::Duration;

    use faer::Col;

    use super::*;
    use crate::model::plate::{Plate, Resolution};
    use crate::model::scene::{DampingFile, Scene, ThicknessRow};
    use crate::modes::Component;

    /// A damped free blade with three thicknesses, from a random test: every wave is double.
    fn twice_every_wave() -> Plate {
        let scene = Scene::paper().edited(|saw| {
            (saw.cut, saw.runup, saw.probe, saw.measured) = (None, None, None, None);
            saw.guides.clear();
            let blade = &mut saw.blade;
            blade.outer_diameter_m = 1.7039005956434714;
            blade.inner_diameter_m = 1.1401680670583623;
            blade.thickness_m = 0.000022727469526954823;
            let steps = [
                (0.5804473014594919, 0.000035810356070992554),
                (0.6127822457633207, 4.522951973305025e-6),
            ];
            blade.profile = steps
                .map(|(radius_m, thickness_m)| ThicknessRow {
                    radius_m,
                    thickness_m,
                })
                .to_vec();
            blade.material.youngs_modulus_pa = 100186744734.62596;
            blade.material.poisson_ratio = -0.29091325246051736;
            blade.material.density_kg_per_m3 = 29644.980423250156;
            saw.damping = Some(DampingFile {
                material_retardation_time_s: 1.2609351739477124e-6,
                air_n_s_per_m3: 1.2154437772463647,
                air_rotation_share: 0.8173495078965438,
                ..DampingFile::default()
            });
        });
        let resolution = Resolution {
            max_diameters: 5,
            radial_functions: 5,
        };
        Plate::new(&scene.unwrap(), resolution)
    }

    /// The iteration ends, and finds the eigenvalues of each harmonic.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "dense solves: run it in release")]
    fn equal_pairs_do_not_keep_the_iteration_from_its_end() {
        let (send, receive) = channel();
        std::thread::spawn(move || {
            let system = GyroscopicSystem::of_plate(&twice_every_wave());
            send.send(companion_eigenpairs(&system, 0.0).unwrap())
        });
        let limit = Duration::from_secs(60);
        let pairs = receive
            .recv_timeout(limit)
            .expect("an end of the iteration");
        let components = Component::of(&twice_every_wave());
        let mut apart: Vec<c64> = components
            .iter()
            .flat_map(|component| companion_eigenpairs(&component.full, 0.0).unwrap())
            .flat_map(with_conjugate)
            .collect();
        let whole: Vec<c64> = pairs.into_iter().flat_map(with_conjugate).collect();
        assert_eq!(whole.len(), apart.len());
        let largest = whole.last().expect("eigenvalues").norm();
        for lambda in whole {
            let distance = |other: &c64| (other - lambda).norm();
            let nearest = (0..apart.len())
                .min_by(|&i, &k| distance(&apart[i]).total_cmp(&distance(&apart[k])))
                .unwrap();
            let error = distance(&apart.swap_remove(nearest));
            // Errors are ε times the largest eigenvalue, and the root of ε for double ones.
            assert!(error <= 1e-7 * largest, "{lambda}: {error:e}");
        }
    }

    /// Where waves are double, and where they are nearly double, (λ² + λD + K)q = 0 within the rounding of K.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "dense solves: run it in release")]
    fn modes_of_a_free_blade_at_rest_and_near_it_satisfy_the_equation_of_motion() {
        let system = GyroscopicSystem::of_plate(&twice_every_wave());
        for speed in [0.0, 1e-6] {
            let (stiffness, velocity) = (system.stiffness_at(speed), system.velocity_at(speed));
            for (lambda, q) in companion_eigenpairs(&system, speed).unwrap() {
                let off = Col::from_fn(q.nrows(), |row| {
                    let factor = |k| stiffness[(row, k)] + lambda * velocity[(row, k)];
                    let terms = (0..q.nrows()).map(|k| factor(k) * q[k]);
                    terms.sum::<c64>() + lambda.powi(2) * q[row]
                });
                let error = off.norm_l2() / stiffness.norm_l2();
                assert!(error < 1e-13, "{speed} {lambda}: {error:e}");
            }
        }
    }

    /// An eigenvalue, and its conjugate if it is complex: rounding may turn two equal real ones into such a
    /// pair.
    fn with_conjugate((lambda, _): Eigenpair) -> impl Iterator<Item = c64> {
        let conjugate = (lambda.im > 0.0).then(|| lambda.conj());
        [Some(lambda), conjugate].into_iter().flatten()
    }
}
