//! Refinement of eigenpairs of a reduced model on the full model.
//!
//! Newton's method on L(λ)q = 0, qᴴδq = 0: δq = −L⁻¹r − δλ L⁻¹L′q, where r = L(λ)q is the residual with the
//! matrices of the full model. The solves by blocks and columns neglect a part of the guides, which slows the
//! convergence but does not limit the accuracy.

use faer::{Col, Mat, c64};

use super::derivative::with_lambda;
use super::error::SpectrumError;
use super::model::SpectralModel;
use super::residual::Lifted;
use super::vectors::{real_times, smallest, unit};

/// A refined eigenvalue with its backward error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RefinedPair {
    /// λ, in 1/s.
    pub lambda: c64,
    /// Backward error on the full model.
    pub backward_error: f64,
}

/// Largest number of steps; one is usually enough.
const STEPS: usize = 5;
/// Backward error below which only rounding is left.
const ROUNDING: f64 = 1e-15;
/// The iteration has found another eigenvalue if it moves by more than this share of the distance to the next
/// one.
const SAME: f64 = 0.1;

impl SpectralModel {
    /// The eigenvalue nearest to an expected one, refined on the full model. `None` if the reduced model has
    /// none there, if the iteration leaves it, and for a saw whose full model has no blocks and columns.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn refined(
        &self,
        speed_rad_per_s: f64,
        expected: c64,
    ) -> Result<Option<RefinedPair>, SpectrumError> {
        if self.plate.is_axisymmetric() || !self.full_model().is_structured() {
            return Ok(None);
        }
        let modes = self.all_modes(speed_rad_per_s)?;
        let distance = |lambda: c64| (lambda - expected).norm();
        let Some(mode) = smallest(&modes, |mode| distance(mode.lambda)) else {
            return Ok(None);
        };
        let component = &self.components[mode.component];
        let mut best: Option<RefinedPair> = None;
        let mut lambda = mode.lambda;
        let mut shape = unit(
            component
                .lifted(speed_rad_per_s, mode.lambda, &mode.coordinates)
                .as_ref(),
        );
        let matrices = [
            component.full.stiffness_at(speed_rad_per_s),
            component.full.velocity_at(speed_rad_per_s),
        ];
        for step in 0..=STEPS {
            let residual = residual(&matrices, lambda, &shape);
            let lifted = Lifted { shape, residual };
            let norms = component.norms();
            let backward_error = norms.backward_error(speed_rad_per_s, lambda, &lifted);
            if best.is_none_or(|best| backward_error < best.backward_error) {
                best = Some(RefinedPair {
                    lambda,
                    backward_error,
                });
            }
            if backward_error <= ROUNDING || step == STEPS {
                break;
            }
            let corrected = corrected(
                &matrices,
                self.full_model(),
                speed_rad_per_s,
                lambda,
                &lifted,
            );
            let Some(next) = corrected else { break };
            (lambda, shape) = next;
        }
        // Rounding of the iteration must not turn a real eigenvalue into a complex one.
        if let (Some(best), true) = (&mut best, mode.lambda.im == 0.0) {
            best.lambda.im = 0.0;
        }
        let others = modes.iter().filter(|other| !std::ptr::eq(*other, mode));
        // The mirror image −λ of a real eigenvalue, at the distance 2|λ|, is not among the modes.
        let mirror = 2.0 * mode.lambda.norm();
        let next = others.fold(mirror, |next, other| distance(other.lambda).min(next));
        Ok(best.filter(|best| distance(best.lambda) <= SAME * next))
    }
}

/// (λ² + λD + K) q.
fn residual([stiffness, velocity]: &[Mat<f64>; 2], lambda: c64, q: &Col<c64>) -> Col<c64> {
    let (stiffness, velocity) = (real_times(stiffness, q), real_times(velocity, q));
    Col::from_fn(q.nrows(), |i| {
        lambda * lambda * q[i] + lambda * velocity[i] + stiffness[i]
    })
}

/// λ and q after one step. `None` if the elimination fails or a number is not finite.
fn corrected(
    [_, velocity]: &[Mat<f64>; 2],
    full: &super::FullModel,
    speed: f64,
    lambda: c64,
    Lifted { shape, residual }: &Lifted,
) -> Option<(c64, Col<c64>)> {
    let slope = with_lambda(velocity, lambda, shape);
    let loads = Mat::from_fn(shape.nrows(), 2, |i, k| [residual[i], slope[i]][k]);
    let solved = full.eliminated(speed, lambda)?.solve(loads.as_ref());
    let (u, v) = (solved.col(0), solved.col(1));
    let change = -(shape.adjoint() * u) / (shape.adjoint() * v);
    let next = Col::from_fn(shape.nrows(), |i| shape[i] - u[i] - change * v[i]);
    let lambda = lambda + change;
    (lambda.is_finite() && next.is_all_finite()).then(|| (lambda, unit(next.as_ref())))
}
