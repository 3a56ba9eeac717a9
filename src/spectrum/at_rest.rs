//! The lowest modes of the undamped blade at rest: a symmetric problem.

use faer::linalg::solvers::{DenseSolveCore, Solve};
use faer::{Col, Mat, Scale, Side};

use super::component::Component;
use super::error::SpectrumError;
use crate::system::GyroscopicSystem;
use crate::tuned::Tuned;

/// A natural frequency at rest.
#[derive(Debug, Clone)]
pub struct RestingMode {
    /// ω.
    pub frequency_rad_per_s: f64,
    /// Index of the component that it belongs to.
    pub component: usize,
    /// q in the unknowns of the component, ‖q‖ = 1.
    pub shape: Col<f64>,
}

/// Below this order all eigenvectors cost less than an iteration.
const SMALL: usize = 64;
/// Vectors iterated beyond the number of modes wanted: the error of a frequency falls by the
/// fourth power of its ratio to the first one left out, each time.
const MORE: Tuned = Tuned::new("spectrum/at_rest::MORE", 10.0);
const ITERATIONS: Tuned = Tuned::new("spectrum/at_rest::ITERATIONS", 8.0);

/// The lowest `count` modes at rest of the components of a plate, ascending; without damping, and
/// without the rigid motions that nothing holds.
///
/// # Errors
/// [`SpectrumError::UnstableAtRest`], [`SpectrumError::NoConvergence`].
pub fn modes_at_rest(
    components: &[Component],
    count: usize,
) -> Result<Vec<RestingMode>, SpectrumError> {
    let mut modes = Vec::new();
    for (component, Component { full, .. }) in components.iter().enumerate() {
        for (square, shape) in lowest(full, count)? {
            modes.push(RestingMode {
                frequency_rad_per_s: square.sqrt(),
                component,
                shape,
            });
        }
    }
    modes.sort_by(|x, y| x.frequency_rad_per_s.total_cmp(&y.frequency_rad_per_s));
    modes.truncate(count);
    Ok(modes)
}

/// (ω², q), ascending: subspace iteration with K₀⁻¹, or all at once where there are few.
fn lowest(system: &GyroscopicSystem, count: usize) -> Result<Vec<(f64, Col<f64>)>, SpectrumError> {
    let order = system.order();
    let failed = || SpectrumError::NoConvergence { order, rpm: 0.0 };
    let mut stiffness = system.stiffness.clone();
    let mean = stiffness.norm_l2() / (order as f64).sqrt();
    for z in &system.free_rigid {
        stiffness += Scale(mean) * z * z.transpose();
    }
    let unstable = |_| SpectrumError::UnstableAtRest { order };
    let factor = stiffness.llt(Side::Lower).map_err(unstable)?;
    let free = |vectors: &mut Mat<f64>| {
        for z in &system.free_rigid {
            let shares = z.transpose() * &*vectors;
            *vectors -= z * shares;
        }
    };
    let width = count + MORE.count();
    let (span, flexibility) = if order <= SMALL.max(2 * width) {
        let mut inverse = factor.inverse();
        free(&mut inverse);
        (Mat::identity(order, order), inverse)
    } else {
        let mut span = Mat::from_fn(order, width, |i, k| {
            ((1.3 * i as f64 + 0.3) * (k + 1) as f64).sin() / (1.0 + i as f64).sqrt()
        });
        for _ in 0..ITERATIONS.count() {
            free(&mut span);
            span = factor.solve(&span).qr().compute_thin_Q();
        }
        let flexibility = span.transpose() * factor.solve(&span);
        (span, flexibility)
    };
    let eigen = flexibility.self_adjoint_eigen(Side::Lower);
    let eigen = eigen.map_err(|_| failed())?;
    let noise = 1e-14 * flexibility.norm_l2();
    let places = (0..flexibility.nrows()).rev();
    Ok(places
        .map(|k| (eigen.S()[k], k))
        .filter(|(inverse, _)| *inverse > noise)
        .take(count)
        .map(|(inverse, k)| (inverse.recip(), &span * eigen.U().col(k)))
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plate::{Plate, Resolution};
    use crate::scene::Scene;
    use crate::spectrum::LowestModes;

    /// Held, loose, and held at a point, which leaves rigid motions free.
    #[test]
    fn they_are_those_of_the_quadratic_problem() {
        let free = Scene::paper().edited(|saw| saw.guides.clear()).unwrap();
        let point = Scene::paper().edited(|saw| {
            saw.guides[0].radial_length_m = 0.0;
            saw.guides[0].tangential_length_m = 0.0;
        });
        let point = point.unwrap();
        for scene in [Scene::paper(), free, point] {
            let resolution = Resolution {
                max_diameters: 8,
                radial_functions: 5,
            };
            let plate = Plate::new(&scene, resolution);
            let lowest = LowestModes::new(&plate);
            let found = modes_at_rest(&lowest.components, 12).unwrap();
            let exact = lowest.at(0.0, 12).unwrap();
            assert_eq!(found.len(), exact.len());
            for (found, exact) in found.iter().zip(&exact) {
                let (found, exact) = (found.frequency_rad_per_s, exact.frequency_rad_per_s());
                assert!((found / exact - 1.0).abs() < 1e-6, "{found} {exact}");
            }
        }
    }
}
