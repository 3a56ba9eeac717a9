//! An undamped blade projected on the states (q, p) of given modes.
//!
//! With p = q̇ + ΩGq the blade is Hamiltonian, H = ½|p − ΩGq|² + ½qᵀK(Ω)q, and a mode is a state z = (q, p)
//! with Jᵀz λ = S(Ω)z, S = S₀ + ΩS₁ + Ω²S₂ the Hessian of H. The real and imaginary parts of m modes span 2m
//! states, whereas a basis of deflections needs 2m more for velocities: half the order takes an eighth of the
//! time. Galerkin's projection of zᵀJᵀz and zᵀSz preserves the Hamiltonian structure, so the error of
//! eigenvalues is the square of that of the states, and none loses its Krein sign.

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, Scale, c64};

use crate::model::linalg::RealEigen;
use crate::model::system::GyroscopicSystem;

use super::canonical_basis::{canonical_basis, turned};
use super::error::SpectrumError;
use super::half_order::hamiltonian_eigenpairs;
use super::vectors::{Eigenpair, by_magnitude, joined, orthonormal, split, unit};

/// A mode as a state: ‖q‖ = 1 and p = λq + ΩGq.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// λ, in 1/s.
    pub lambda: c64,
    /// Deflection q.
    pub q: Col<c64>,
    /// Momentum p, in 1/s.
    pub p: Col<c64>,
}

impl State {
    /// The state of a mode at a speed.
    pub fn new(system: &GyroscopicSystem, speed_rad_per_s: f64, (lambda, q): Eigenpair) -> Self {
        let (re, im) = split(&q);
        let (g_re, g_im) = (&system.gyroscopic * re, &system.gyroscopic * im);
        let p = Col::from_fn(q.nrows(), |i| {
            lambda * q[i] + c64::new(g_re[i], g_im[i]) * speed_rad_per_s
        });
        State { lambda, q, p }
    }
}

/// A system projected on few states.
#[derive(Debug, Clone)]
pub struct HamiltonianReduction {
    /// Projection on orthonormal states.
    own: Coordinates,
    /// Projection on states W with WᵀJᵀW = Jᵀ, if they are well conditioned for an eigenproblem of half the
    /// order.
    canonical: Option<Coordinates>,
    /// Unit of λ and of momenta, in 1/s.
    scale: f64,
}

/// A basis W of states.
#[derive(Debug, Clone)]
struct Coordinates {
    /// q of the states.
    deflections: Mat<f64>,
    /// (WᵀJᵀW)⁻¹ Wᵀ S_k W in units of the scale.
    terms: [Mat<f64>; 3],
}

impl Coordinates {
    /// A with ż = Az, in units of the scale.
    fn matrix(&self, speed: f64) -> Mat<f64> {
        let [rest, linear, square] = &self.terms;
        rest + Scale(speed) * linear + Scale(speed * speed) * square
    }
}

/// States closer than this to the span of the others are omitted.
const SPAN_TOLERANCE: f64 = 1e-9;
/// Smallest pivot of the symplectic form that can be divided by.
const LEAST_PIVOT: f64 = 1e-9;
/// Order of the projection on two modes.
const ORDER_OF_TWO_MODES: usize = 4;

impl HamiltonianReduction {
    /// Projects a system on the real and imaginary parts of states; `scale`, in 1/s, gives momenta the size
    /// of deflections. `None` if the symplectic form is singular on them, because a state lacks its partner.
    pub fn new(system: &GyroscopicSystem, scale: f64, states: &[State]) -> Option<Self> {
        let order = system.order();
        let stacked = |part: fn(&c64) -> f64, state: &State| {
            let state = Col::from_fn(2 * order, |i| match i.checked_sub(order) {
                Some(i) => part(&state.p[i]) / scale,
                None => part(&state.q[i]),
            });
            let norm = state.norm_l2();
            (norm > 1e-12).then(|| Scale(1.0 / norm) * state)
        };
        let vectors: Vec<Col<f64>> = states
            .iter()
            .flat_map(|state| [stacked(|c| c.re, state), stacked(|c| c.im, state)])
            .flatten()
            .collect();
        if vectors.is_empty() {
            return None;
        }
        let basis = orthonormal(2 * order, &vectors, SPAN_TOLERANCE);
        let q = basis.get(..order, ..);
        let p = basis.get(order.., ..);
        let gq = &system.gyroscopic * q;
        let pq = p.transpose() * q;
        let form = &pq - pq.transpose();
        let rest = q.transpose() * &system.stiffness * q + Scale(scale * scale) * p.transpose() * p;
        let cross = gq.transpose() * p;
        let linear = Scale(-scale) * (&cross + cross.transpose());
        let square = q.transpose() * &system.spin * q + gq.transpose() * &gq;
        let terms = [rest, linear, square].map(|term| Scale(scale.powi(-2)) * term);
        let factors = form.partial_piv_lu();
        let upper = factors.U();
        let singular = (0..form.nrows()).any(|i| {
            let pivot: f64 = upper[(i, i)];
            pivot.is_nan() || pivot.abs() < LEAST_PIVOT
        });
        if singular {
            return None;
        }
        // A model of two modes needs no canonical basis, because [`HamiltonianReduction::pair_invariants`]
        // does not use one.
        let canonical = if form.nrows() > ORDER_OF_TWO_MODES {
            canonical_basis(form)
        } else {
            None
        };
        Some(HamiltonianReduction {
            canonical: canonical.map(|basis| Coordinates {
                deflections: q * &basis,
                terms: [0, 1, 2].map(|k| turned(basis.transpose() * &terms[k] * &basis)),
            }),
            own: Coordinates {
                deflections: q.to_owned(),
                terms: terms.map(|term| factors.solve(term)),
            },
            scale,
        })
    }

    /// Number of states of the basis.
    pub fn order(&self) -> usize {
        self.own.deflections.ncols()
    }

    /// Eigenpairs (λ, q) with Im λ ≥ 0, ‖q‖ = 1, ordered by |λ|.
    ///
    /// # Errors
    /// [`SpectrumError::Decomposition`].
    pub fn eigenpairs(&self, speed_rad_per_s: f64) -> Result<Vec<Eigenpair>, SpectrumError> {
        let failed = || SpectrumError::at(speed_rad_per_s);
        let mut found = None;
        if let Some(canonical) = &self.canonical {
            let matrix = canonical.matrix(speed_rad_per_s);
            let pairs = hamiltonian_eigenpairs(matrix.as_ref()).map_err(failed())?;
            found = pairs.map(|pairs| (pairs.lambdas, &canonical.deflections * pairs.halves));
        }
        let (lambdas, shapes) = match found {
            Some(found) => found,
            None => {
                let matrix = self.own.matrix(speed_rad_per_s);
                let eigen = RealEigen::new(matrix.as_ref()).map_err(failed())?;
                let upper = eigen.upper();
                let lambdas = upper.iter().map(|&i| eigen.values[i]).collect();
                (lambdas, &self.own.deflections * eigen.halves_of(&upper))
            }
        };
        let pairs = lambdas
            .into_iter()
            .enumerate()
            .map(|(k, lambda): (_, c64)| {
                let q = joined(&shapes, k);
                (lambda * self.scale, unit(q.as_ref()))
            });
        Ok(by_magnitude(pairs.collect()))
    }

    /// (ω₁² + ω₂², ω₁ω₂) of a model of two modes, from the traces of A² and A⁴: smooth through a coalescence,
    /// where the eigenvalues are not.
    pub fn pair_invariants(&self, speed_rad_per_s: f64) -> [f64; 2] {
        let matrix = self.own.matrix(speed_rad_per_s);
        let square = &matrix * &matrix;
        let trace = |m: &Mat<f64>| (0..m.nrows()).map(|i| m[(i, i)]).sum::<f64>();
        let fourth: f64 = trace(&(&square * &square));
        let sum = -0.5 * trace(&square);
        let product_square = 0.5 * (sum * sum - 0.5 * fourth);
        let unit = self.scale * self.scale;
        [sum * unit, product_square.max(0.0).sqrt() * unit]
    }
}
