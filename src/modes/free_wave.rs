//! Waves of one harmonic of an undamped blade without guides or loads fixed in space.
//!
//! In the body frame they are solutions of a symmetric problem, (K_b + K_m + Ω²K_σ) x = ω_b² x, of the radial
//! functions alone. In space a forward wave has ω = ω_b + nΩ and q = (x, −ix) in (cos, sin), a backward one ω
//! = ω_b − nΩ and q = (x, ix). Above its critical speed, where nΩ > ω_b, it is reflected: ω = nΩ − ω_b and q
//! = (x, −ix).

use faer::linalg::solvers::DenseSolveCore;
use faer::{Col, Mat, Side, c64};

use super::error::SpectrumError;
use super::vectors::{Eigenpair, by_magnitude, complex, unit};
use crate::model::linalg::SymmetricEigen;
use crate::model::plate::Plate;
use crate::model::system::GyroscopicSystem;

/// Every eigenpair with Im λ ≥ 0 of n nodal diameters, ‖q‖ = 1, ordered by |λ|; each free rigid motion has
/// one with λ = 0 exactly. `system` is that of the harmonic.
///
/// # Errors
/// [`SpectrumError::NoConvergence`], [`SpectrumError::Decomposition`].
pub fn eigenpairs(
    plate: &Plate,
    n: usize,
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
) -> Result<Vec<Eigenpair>, SpectrumError> {
    let radial = plate.harmonics[n].bending.nrows();
    // If the blade has rigid motions, the first radial function for n ≤ 1 is a rigid motion, which is not
    // coupled to the other functions.
    let rigid = usize::from(plate.basis.has_rigid_motions() && n <= 1);
    let stiffness = plate.harmonics[n].body_frame_stiffness(speed_rad_per_s);
    let elastic = stiffness.get(rigid.., rigid..).to_owned();
    let drift = n as f64 * speed_rad_per_s;
    let mut pairs = Vec::new();
    let mut add = |frequency: f64, sine: c64, shape: &Col<f64>| {
        let q = Col::from_fn(system.order(), |i| match i.checked_sub(radial) {
            Some(i) => sine * shape[i],
            None => c64::new(shape[i], 0.0),
        });
        pairs.push((c64::new(0.0, frequency), unit(q.as_ref())));
    };
    let (forward, backward) = (c64::new(0.0, -1.0), c64::new(0.0, 1.0));
    for (frequency, mode) in symmetric_modes(elastic, speed_rad_per_s)? {
        let shape = Col::from_fn(radial, |i| if i < rigid { 0.0 } else { mode[i - rigid] });
        add(frequency + drift, forward, &shape);
        match frequency >= drift {
            _ if n == 0 => {}
            true => add(frequency - drift, backward, &shape),
            false => add(drift - frequency, forward, &shape),
        }
    }
    if rigid == 1 && n == 1 {
        // In space a tilt is either at rest, which is a free motion that is added below, or has twice the rotation
        // frequency.
        let tilt = Col::from_fn(radial, |i| f64::from(u8::from(i == 0)));
        add(2.0 * speed_rad_per_s, forward, &tilt);
    }
    let free = system.free_rigid.iter();
    pairs.extend(free.map(|z| (c64::new(0.0, 0.0), complex(z))));
    Ok(by_magnitude(pairs))
}

/// √(eigenvalue) and eigenvector of a positive definite matrix, from its inverse, so that low ones have a
/// small relative error; the rounding of a direct solver is relative to the largest.
fn symmetric_modes(
    matrix: Mat<f64>,
    speed_rad_per_s: f64,
) -> Result<Vec<(f64, Col<f64>)>, SpectrumError> {
    let order = matrix.nrows();
    let failed = || SpectrumError::no_convergence(order, speed_rad_per_s);
    let flexibility = matrix.llt(Side::Lower).map_err(|_| failed())?.inverse();
    let eigen =
        SymmetricEigen::new(flexibility.as_ref()).map_err(SpectrumError::at(speed_rad_per_s))?;
    let frequency = |k: usize| eigen.values[k].sqrt().recip();
    let modes = (0..order).map(|k| (frequency(k), eigen.vectors.col(k).to_owned()));
    Ok(modes
        .filter(|(frequency, _)| frequency.is_finite())
        .collect())
}

#[cfg(test)]
mod tests {
    use super::super::vectors::real_times;
    use super::*;
    use crate::model::plate::Resolution;
    use crate::model::scene::{Scene, rad_per_s};
    use crate::modes::companion_eigenpairs;

    /// L(λ)q = 0 relative to the size of its terms, and the eigenvalues of the quadratic problem in the
    /// space-fixed frame, below and above critical speeds.
    #[test]
    fn they_solve_the_quadratic_problem() {
        let scene = Scene::paper().edited(|saw| saw.guides.clear()).unwrap();
        let resolution = Resolution {
            max_diameters: 4,
            radial_functions: 6,
        };
        let plate = Plate::new(&scene, resolution);
        for n in 0..=4 {
            let system = GyroscopicSystem::of_harmonic(&plate, n);
            for speed in [0.01, 1000.0, 2600.0].map(rad_per_s) {
                let pairs = eigenpairs(&plate, n, &system, speed).unwrap();
                let dense = companion_eigenpairs(&system, speed).unwrap();
                assert_eq!(pairs.len(), dense.len(), "{n} {speed}");
                let size = system.stiffness.norm_l2();
                for ((lambda, q), (exact, _)) in pairs.iter().zip(&dense) {
                    let momentum = real_times(&system.velocity_at(speed), q);
                    let force = real_times(&system.stiffness_at(speed), q);
                    let residual = Col::<c64>::from_fn(q.nrows(), |i| {
                        lambda * (lambda * q[i] + momentum[i]) + force[i]
                    });
                    assert!(residual.norm_l2() < 1e-12 * size, "{n} {speed} {lambda}");
                    assert!((lambda - exact).norm() < 1e-6 * (1.0 + exact.norm()));
                }
            }
        }
    }
}
