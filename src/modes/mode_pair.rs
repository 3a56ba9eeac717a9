//! Two neighbouring modes, refined together by inverse iteration.

use std::sync::Arc;

use faer::linalg::solvers::{Solve, SolveLstsq};
use faer::{Col, Mat, Scale, c64};

use crate::model::system::{GyroscopicSystem, dynamic_stiffness};

use super::hamiltonian::{HamiltonianReduction, State};
use super::projection::Projection;
use super::vectors::{Eigenpair, complex, real_times};

/// The invariant subspace of two modes at one speed, and its extrapolation to nearby speeds.
#[derive(Debug)]
pub struct ModePair {
    projection: Arc<Projection>,
    model: HamiltonianReduction,
    subspace: Subspace,
}

/// Two states (q, q̇), one in each column.
#[derive(Debug, Clone)]
struct Subspace {
    q: Mat<c64>,
    v: Mat<c64>,
}

/// Smallest and largest number of steps of inverse iteration, each with both shifts. A step reduces the
/// components of other modes by the ratio of the distances of the pair and of the other modes from the shifts.
const STEPS: std::ops::RangeInclusive<usize> = 2..=12;
/// Relative residual beyond which the two states are not modes.
const LARGEST_RESIDUAL: f64 = 1e-6;

impl ModePair {
    /// Refines two modes at a speed. `None` if block inverse iteration does not converge to two
    /// modes.
    pub(super) fn new(
        projection: &Arc<Projection>,
        speed_rad_per_s: f64,
        scale: f64,
        pairs: [&Eigenpair; 2],
    ) -> Option<Self> {
        let order = projection.reduced.order();
        let start = Subspace {
            q: Mat::from_fn(order, 2, |i, k| pairs[k].1[i]),
            v: Mat::from_fn(order, 2, |i, k| pairs[k].1[i] * pairs[k].0),
        };
        let lambdas = pairs.map(|pair| pair.0);
        Self::iterated(projection, speed_rad_per_s, scale, start, lambdas)
    }

    /// The pair at another speed, on the projection that is valid there.
    pub(super) fn moved(
        &self,
        projection: &Arc<Projection>,
        speed_rad_per_s: f64,
        scale: f64,
    ) -> Option<Self> {
        let lambdas = self.eigenvalues(speed_rad_per_s);
        let start = match Arc::ptr_eq(projection, &self.projection) {
            true => self.subspace.clone(),
            false => {
                let turned = projection.basis.transpose() * &self.projection.basis;
                let in_new = |part: &Mat<c64>| {
                    let columns = [0, 1].map(|k| real_times(&turned, &part.col(k).to_owned()));
                    Mat::from_fn(turned.nrows(), 2, |i, k| columns[k][i])
                };
                Subspace {
                    q: in_new(&self.subspace.q),
                    v: in_new(&self.subspace.v),
                }
            }
        };
        Self::iterated(projection, speed_rad_per_s, scale, start, lambdas)
    }

    /// Block inverse iteration with both eigenvalues as shifts in turn, because near one of them alone
    /// another mode may be closer than the partner.
    fn iterated(
        projection: &Arc<Projection>,
        speed_rad_per_s: f64,
        scale: f64,
        start: Subspace,
        lambdas: [c64; 2],
    ) -> Option<Self> {
        let system = &projection.reduced;
        let order = system.order();
        let stiffness = system.stiffness_at(speed_rad_per_s);
        let velocity = system.velocity_at(speed_rad_per_s);
        let damping = Mat::from_fn(order, order, |i, k| c64::new(velocity[(i, k)], 0.0));
        // The shifts differ slightly from the eigenvalues, so that the dynamic stiffness is not exactly
        // singular.
        let shifts = lambdas.map(|lambda| lambda * (1.0 + 1e-9));
        let factors = |shift: c64| dynamic_stiffness(&stiffness, &velocity, shift).partial_piv_lu();
        let first = factors(shifts[0]);
        // Without damping the dynamic stiffness L satisfies L(−λ̄) = L(λ)ᴴ, so that one factorization serves
        // both shifts.
        let are_mirrored = system.is_conservative() && shifts[1] == -shifts[0].conj();
        let second = (!are_mirrored).then(|| factors(shifts[1]));
        let solve = |which: usize, load: Mat<c64>| match (which, &second) {
            (0, _) => first.solve(load),
            (_, Some(second)) => second.solve(load),
            (_, None) => first.solve_adjoint(load),
        };
        let Subspace { mut q, mut v } = start;
        for step in 1..=*STEPS.end() {
            for (which, shift) in shifts.iter().enumerate() {
                // The product (A − σ)⁻¹(q, v) is (u, q + σu) with u = −L(σ)⁻¹((D + σ)q + v), where σ is the
                // shift, D is `damping` and L is the dynamic stiffness.
                let load = &damping * &q + Scale(*shift) * &q + &v;
                let u = Scale(c64::new(-1.0, 0.0)) * solve(which, load);
                v = &q + Scale(*shift) * &u;
                q = u;
                orthonormalize(&mut q, &mut v, scale)?;
            }
            let settled = || residual(&stiffness, &damping, &q, &v) <= LARGEST_RESIDUAL;
            if step >= *STEPS.start() && settled() {
                return Self::projected(projection, speed_rad_per_s, scale, Subspace { q, v });
            }
        }
        None
    }

    /// The pair as a model of two modes. `None` if the two states are dependent.
    fn projected(
        projection: &Arc<Projection>,
        speed_rad_per_s: f64,
        scale: f64,
        subspace: Subspace,
    ) -> Option<Self> {
        let system = &projection.reduced;
        let Subspace { q, v } = &subspace;
        let states: Vec<State> = (0..2)
            .map(|k| {
                let zero = c64::new(0.0, 0.0);
                let mut state = State::new(system, speed_rad_per_s, (zero, q.col(k).to_owned()));
                state.p += v.col(k);
                state
            })
            .collect();
        let model = HamiltonianReduction::new(system, scale, &states)?;
        (model.order() == 4).then(|| ModePair {
            projection: projection.clone(),
            model,
            subspace,
        })
    }

    /// σ² and ω² of the quadruple ±σ ± iω, smooth through both ends of its band: for two waves −((ω₁ −
    /// ω₂)/2)² and ((ω₁ + ω₂)/2)², for two real λ ((λ₁ + λ₂)/2)² and −((λ₁ − λ₂)/2)². Exact at the pair's
    /// speed, and of second order in the distance from it.
    pub fn squares(&self, speed_rad_per_s: f64) -> [f64; 2] {
        let (sum, product) = self.model.pair_invariants(speed_rad_per_s);
        [-0.25 * (sum - 2.0 * product), 0.25 * (sum + 2.0 * product)]
    }

    /// Estimated eigenvalues of the pair at a speed near its own.
    fn eigenvalues(&self, speed_rad_per_s: f64) -> [c64; 2] {
        let [growth, frequency] = self.squares(speed_rad_per_s);
        // The root of a negative square lies on the other axis of the complex plane.
        let half = |square: f64, positive: c64, negative: c64| {
            let part = if square >= 0.0 { positive } else { negative };
            part * square.abs().sqrt()
        };
        let mean = half(frequency, c64::new(0.0, 1.0), c64::new(1.0, 0.0));
        let distance = half(growth, c64::new(1.0, 0.0), c64::new(0.0, 1.0));
        [mean + distance, mean - distance]
    }
}

/// Makes two complex states orthonormal in (q, v/scale).
fn orthonormalize(q: &mut Mat<c64>, v: &mut Mat<c64>, scale: f64) -> Option<()> {
    let order = q.nrows();
    let stacked = Mat::from_fn(2 * order, 2, |i, k| match i.checked_sub(order) {
        Some(i) => v[(i, k)] / scale,
        None => q[(i, k)],
    });
    let qr = stacked.qr();
    let upper = qr.thin_R();
    let sound = |k: usize| upper[(k, k)].norm() > 0.0 && upper[(k, k)].is_finite();
    if !(sound(0) && sound(1)) {
        return None;
    }
    let basis = qr.compute_thin_Q();
    *q = basis.get(..order, ..).to_owned();
    *v = Scale(c64::new(scale, 0.0)) * basis.get(order.., ..);
    Some(())
}

/// Distance of A(q, v) from the span of the two states, relative to its length.
fn residual(stiffness: &Mat<f64>, damping: &Mat<c64>, q: &Mat<c64>, v: &Mat<c64>) -> f64 {
    let order = q.nrows();
    let complex = |part: Mat<f64>| Mat::from_fn(order, 2, |i, k| c64::new(part[(i, k)], 0.0));
    let re = complex(stiffness * Mat::from_fn(order, 2, |i, k| q[(i, k)].re));
    let im = complex(stiffness * Mat::from_fn(order, 2, |i, k| q[(i, k)].im));
    let force = re + Scale(c64::new(0.0, 1.0)) * im + damping * v;
    // If the subspace is invariant, v = qB and −force = vB with the same B, which is computed by least
    // squares.
    let coefficients = q.qr().solve_lstsq(v);
    let left: Mat<c64> = &force + v * &coefficients;
    let kinematic: Mat<c64> = v - q * &coefficients;
    let size = force.norm_l2().max(f64::MIN_POSITIVE);
    left.norm_l2() / size + kinematic.norm_l2() / v.norm_l2().max(f64::MIN_POSITIVE)
}

/// The two states of a wave that stands still at its critical speed: its deflection, and a momentum of the same
/// shape.
pub(super) fn standing_states(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
    shape: &Col<f64>,
    scale: f64,
) -> [State; 2] {
    let q = complex(shape);
    let still = State::new(system, speed_rad_per_s, (c64::new(0.0, 0.0), q.clone()));
    let momentum = State {
        lambda: c64::new(0.0, 0.0),
        q: Col::zeros(q.nrows()),
        p: Scale(c64::new(scale, 0.0)) * q,
    };
    [still, momentum]
}
