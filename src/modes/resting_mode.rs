//! The lowest modes of the undamped blade at rest: a symmetric problem.

use faer::linalg::solvers::{DenseSolveCore, Llt, Solve};
use faer::{Col, Mat, Scale, Side};

use super::component::Component;
use super::error::SpectrumError;
use super::symmetric_pencil::stiffened;
use crate::model::linalg::SymmetricEigen;
use crate::model::system::GyroscopicSystem;

/// A mode of the undamped blade at rest.
#[derive(Debug, Clone)]
pub struct RestingMode {
    /// Natural frequency ω.
    pub frequency_rad_per_s: f64,
    /// Index of the component of the mode.
    pub component: usize,
    /// q in the unknowns of the component, ‖q‖ = 1.
    pub shape: Col<f64>,
}

/// Below this order all eigenvectors cost less than an iteration.
const SMALL: usize = 64;
/// Number of vectors beyond the number of requested modes: in each iteration the error of a frequency falls
/// by the fourth power of the ratio of this frequency to the first one that the vectors omit.
const MORE: usize = 10;
/// Residual ‖K₀⁻¹q − q/ω²‖ω² at which the iteration ends: the relative error of the frequency is half the
/// square of the residual, divided by the relative distance to the ω² that the vectors do not represent.
const RESIDUAL: f64 = 1e-5;
/// Largest number of iterations, after which all eigenvectors are computed; eight are usual.
const MOST_ROUNDS: usize = 40;

/// The lowest `count` modes at rest of the components of a plate, ascending, without damping and without free
/// rigid motions.
///
/// # Errors
/// [`SpectrumError::UnstableAtRest`], [`SpectrumError::Decomposition`].
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

/// (ω², q), ascending: by subspace iteration with K₀⁻¹, or by a dense solver for small orders.
fn lowest(system: &GyroscopicSystem, count: usize) -> Result<Vec<(f64, Col<f64>)>, SpectrumError> {
    let order = system.order();
    let stiffness = stiffened(&system.stiffness, &system.free_rigid);
    let unstable = |_| SpectrumError::UnstableAtRest { order };
    let factor = stiffness.llt(Side::Lower).map_err(unstable)?;
    let width = count + MORE;
    let iterated = if order <= SMALL.max(2 * width) {
        None
    } else {
        iterated(system, &factor, [count, width])?
    };
    let ritz = match iterated {
        Some(ritz) => ritz,
        None => {
            let mut inverse = factor.inverse();
            release(system, &mut inverse);
            Ritz::new(Mat::identity(order, order), inverse)?
        }
    };
    Ok(ritz.lowest(count))
}

/// Removes free rigid motions from vectors.
fn release(system: &GyroscopicSystem, vectors: &mut Mat<f64>) {
    for z in &system.free_rigid {
        let shares = z.transpose() * &*vectors;
        *vectors -= z * shares;
    }
}

/// The subspace of `width` vectors on which the lowest `count` modes have converged; `None` if they do not
/// converge.
fn iterated(
    system: &GyroscopicSystem,
    factor: &Llt<f64>,
    [count, width]: [usize; 2],
) -> Result<Option<Ritz>, SpectrumError> {
    let mut solved = Mat::from_fn(system.order(), width, |i, k| {
        ((1.3 * i as f64 + 0.3) * (k + 1) as f64).sin() / (1.0 + i as f64).sqrt()
    });
    for _ in 0..MOST_ROUNDS {
        release(system, &mut solved);
        let span = solved.qr().compute_thin_Q();
        solved = factor.solve(&span);
        let ritz = Ritz::new(span, solved.clone())?;
        if ritz.residual(count) <= RESIDUAL {
            return Ok(Some(ritz));
        }
    }
    Ok(None)
}

/// Ritz pairs on orthonormal vectors.
struct Ritz {
    span: Mat<f64>,
    /// K₀⁻¹ times the vectors.
    solved: Mat<f64>,
    /// 1/ω² and the vectors in the span, descending.
    modes: Vec<(f64, Col<f64>)>,
}

impl Ritz {
    fn new(span: Mat<f64>, solved: Mat<f64>) -> Result<Self, SpectrumError> {
        let flexibility = span.transpose() * &solved;
        let eigen = SymmetricEigen::new(flexibility.as_ref()).map_err(SpectrumError::at(0.0))?;
        let noise = 1e-14 * flexibility.norm_l2();
        let modes = (0..flexibility.nrows())
            .rev()
            .map(|k| (eigen.values[k], eigen.vectors.col(k).to_owned()));
        Ok(Ritz {
            span,
            solved,
            modes: modes.filter(|(inverse, _)| *inverse > noise).collect(),
        })
    }

    /// Largest of the residuals of the first modes.
    fn residual(&self, count: usize) -> f64 {
        let off = |(inverse, share): &(f64, Col<f64>)| {
            let residual = &self.solved * share - Scale(*inverse) * (&self.span * share);
            residual.norm_l2() / inverse
        };
        self.modes.iter().take(count).map(off).fold(0.0, f64::max)
    }

    /// ω² and q of the first modes.
    fn lowest(&self, count: usize) -> Vec<(f64, Col<f64>)> {
        let modes = self.modes.iter().take(count);
        modes
            .map(|(inverse, share)| (inverse.recip(), &self.span * share))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plate::{Plate, Resolution};
    use crate::model::scene::Scene;
    use crate::modes::LowestModes;

    /// A blade on a pad, a free one, and one held at a point, which leaves tilts free.
    #[test]
    fn modes_at_rest_are_those_of_the_quadratic_problem() {
        let free = Scene::paper().edited(|saw| saw.guides.clear()).unwrap();
        let point = Scene::paper()
            .edited(|saw| {
                saw.guides[0].radial_length_m = 0.0;
                saw.guides[0].tangential_length_m = 0.0;
            })
            .unwrap();
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
