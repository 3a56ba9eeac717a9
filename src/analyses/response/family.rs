//! Steady states at many speeds or frequencies, on a basis of full solutions.
//!
//! Each steady state q e^{iωt} solves L(iω; Ω) q = f. Neighbouring solutions differ little, so that a few solutions of the full
//! model span the others. The residual of the full model shows where another solution is needed, so that no mode is truncated.

use faer::linalg::solvers::{Llt, Solve};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Col, Mat, Par, Scale, Side, c64};
use rayon::prelude::*;

use crate::model::system::{GyroscopicSystem, dynamic_stiffness};
use crate::modes::{Cancellation, SpectrumError};

/// A speed and a frequency, in rad/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Rotation speed Ω.
    pub speed_rad_per_s: f64,
    /// Angular frequency ω.
    pub frequency_rad_per_s: f64,
}

/// Number of solutions of the full model in the first round.
const FIRST: usize = 9;
/// Number of remaining states for each of which one more is solved on the full model in a further round. Solving it takes
/// about as long as the others take on the basis, and may save them another round.
const SHARE: usize = 16;
/// Smallest number of solutions of the full model in a further round.
const MORE: usize = 6;
/// Number of states with which the search for directions begins.
const COARSE: usize = 96;
/// Largest residual r relative to the load f, each measured by √(rᴴK₀⁻¹r), the energy norm of its static deflection: functions
/// of high frequency, in which the load of a point has its largest parts, hardly deflect.
const RESIDUAL: f64 = 1e-7;
/// Stiffness added to all functions for this norm, as a share of the largest, because free rigid motions have none.
const LEAST_STIFFNESS: f64 = 1e-9;
/// Number of states whose residuals are computed together by products of matrices.
const TOGETHER: usize = 32;
/// Largest residual of a state whose deflection is beyond the linear model, because such a deflection is not reported.
const RESIDUAL_BEYOND: f64 = 1e-2;
/// Distance of a unit vector from the span of the others below which the basis omits it.
const INDEPENDENT: f64 = 1e-9;

/// Readings cᵀq of the steady state under a load, at each state; `None` where the dynamic stiffness is singular. Readings whose
/// absolute value exceeds `beyond` are rough.
///
/// # Errors
/// [`SpectrumError::Cancelled`], or [`SpectrumError::UnstableAtRest`] if the stiffness at rest is not positive definite.
pub fn readings(
    system: &GyroscopicSystem,
    load: &Col<c64>,
    states: &[State],
    probes: &[Col<f64>],
    beyond: f64,
) -> Result<Vec<Option<Vec<c64>>>, SpectrumError> {
    let cancellation = Cancellation::current();
    let factor = factor_at_rest(system)?;
    let mut found: Vec<Option<Vec<c64>>> = vec![None; states.len()];
    let mut vectors: Vec<Col<c64>> = Vec::new();
    // A coarse selection of the states comes first, because a basis for them represents nearly all solutions
    // at the other states.
    let stride = states.len().div_ceil(COARSE).max(1);
    let (coarse, others): (Vec<usize>, Vec<usize>) =
        (0..states.len()).partition(|k| k.is_multiple_of(stride));
    for mut left in [coarse, others] {
        let mut asked = match vectors.is_empty() {
            true => {
                let first = spread(left.len(), FIRST).into_iter();
                first.map(|k| left[k]).collect()
            }
            false => Vec::new(),
        };
        while !left.is_empty() {
            cancellation.check()?;
            let solved: Vec<Col<c64>> = asked
                .par_iter()
                .map(|k| solution(system, load, states[*k]))
                .collect();
            for (k, q) in asked.iter().zip(&solved) {
                let norm = q.norm_l2();
                if norm > 0.0 && norm.is_finite() {
                    found[*k] = Some(probes.iter().map(|c| reading(c, q)).collect());
                    vectors.push(Scale(c64::new(1.0 / norm, 0.0)) * q);
                }
            }
            left.retain(|k| !asked.contains(k));
            let basis = orthonormal(system.order(), &vectors);
            let reduced = Reduced::new(system, load, probes, &basis, &factor);
            let tried: Vec<(f64, Vec<c64>)> = left
                .par_chunks(TOGETHER)
                .flat_map_iter(|some| {
                    let states: Vec<State> = some.iter().map(|k| states[*k]).collect();
                    reduced.at(&states)
                })
                .collect();
            let mut worst: Vec<(usize, f64)> = Vec::new();
            for (&k, (residual, read)) in left.iter().zip(tried) {
                let is_beyond = read.iter().any(|value| value.norm() > beyond);
                let allowed = if is_beyond { RESIDUAL_BEYOND } else { RESIDUAL };
                match residual <= allowed {
                    true => found[k] = Some(read),
                    false => worst.push((k, residual)),
                }
            }
            left = worst.iter().map(|(k, _)| *k).collect();
            // The states to solve next are far apart, because the solutions of neighbouring states are
            // similar.
            asked = spread(worst.len(), MORE.max(worst.len() / SHARE))
                .into_iter()
                .map(|place| worst[place].0)
                .chain(most(&worst))
                .collect();
            asked.sort_unstable();
            asked.dedup();
        }
    }
    Ok(found)
}

/// The state with the largest residual.
fn most(worst: &[(usize, f64)]) -> Option<usize> {
    let largest = worst.iter().max_by(|a, b| a.1.total_cmp(&b.1));
    largest.map(|(k, _)| *k)
}

/// Indices of `places` entries that are evenly spread over a list of `count` entries, including its ends.
fn spread(count: usize, places: usize) -> Vec<usize> {
    let places = places.min(count);
    let last = count.saturating_sub(1);
    (0..places)
        .map(|k| k * last / places.saturating_sub(1).max(1))
        .collect()
}

/// The solution q of L(iω; Ω) q = f on the full model.
pub fn solution(system: &GyroscopicSystem, load: &Col<c64>, state: State) -> Col<c64> {
    let State {
        speed_rad_per_s: speed,
        frequency_rad_per_s: frequency,
    } = state;
    let (stiffness, velocity) = (system.stiffness_at(speed), system.velocity_at(speed));
    let dynamic = dynamic_stiffness(&stiffness, &velocity, c64::new(0.0, frequency));
    dynamic.partial_piv_lu().solve(load)
}

/// The reading cᵀq of a solution at a probe.
pub fn reading(probe: &Col<f64>, q: &Col<c64>) -> c64 {
    (0..q.nrows()).map(|i| q[i] * probe[i]).sum()
}

/// The system on a basis V, and its products with V for the residual.
///
/// V is complex, so that it may contain a wave that turns with the load without the wave that turns against it. The load does
/// not excite the latter, but its resonance would amplify rounding.
struct Reduced {
    /// Factors of the terms of L.
    factors: Vec<Factor>,
    /// VᴴT V of every term T of L.
    small: Vec<Mat<c64>>,
    /// Vᴴf.
    small_load: Col<c64>,
    /// Vᵀc.
    probes: Vec<Col<c64>>,
    /// C⁻¹T V of the terms side by side, with CCᵀ = K₀.
    tall: Mat<c64>,
    /// C⁻¹f.
    load: Col<c64>,
}

impl Reduced {
    fn new(
        system: &GyroscopicSystem,
        load: &Col<c64>,
        probes: &[Col<f64>],
        basis: &Mat<c64>,
        factor: &Llt<f64>,
    ) -> Self {
        let divided = |mut halves: Mat<f64>| {
            solve_lower_triangular_in_place(factor.L(), halves.as_mut(), Par::Seq);
            joined(&halves)
        };
        let own = halves(basis);
        let (matrices, factors): (Vec<_>, Vec<Factor>) = terms(system).into_iter().unzip();
        let products: Vec<Mat<f64>> = matrices
            .into_iter()
            .map(|term| term.map_or_else(|| own.clone(), |term| term * &own))
            .collect();
        let width = basis.ncols();
        let mut tall = Mat::zeros(system.order(), products.len() * width);
        for (k, product) in products.iter().enumerate() {
            let mut place = tall.subcols_mut(k * width, width);
            place.copy_from(divided(product.clone()));
        }
        let load_alone = Mat::from_fn(load.nrows(), 1, |i, _| load[i]);
        Reduced {
            factors,
            small: products
                .iter()
                .map(|product| basis.adjoint() * joined(product))
                .collect(),
            small_load: basis.adjoint() * load,
            probes: probes
                .iter()
                .map(|c| {
                    Col::from_fn(width, |k| {
                        (0..c.nrows()).map(|i| basis[(i, k)] * c[i]).sum()
                    })
                })
                .collect(),
            tall,
            load: divided(halves(&load_alone)).col(0).to_owned(),
        }
    }

    /// Residual relative to the load, and readings, at each state.
    fn at(&self, states: &[State]) -> Vec<(f64, Vec<c64>)> {
        let width = self.small_load.nrows();
        let mut shares = Mat::zeros(self.tall.ncols(), states.len());
        let mut read = Vec::with_capacity(states.len());
        for (place, state) in states.iter().enumerate() {
            let s = c64::new(0.0, state.frequency_rad_per_s);
            let factors = self.factors.iter();
            let factors: Vec<c64> = factors.map(|of| of(state.speed_rad_per_s, s)).collect();
            let dynamic = Mat::from_fn(width, width, |i, k| {
                let parts = self.small.iter().zip(&factors);
                parts
                    .map(|(term, factor)| term[(i, k)] * factor)
                    .sum::<c64>()
            });
            let y: Col<c64> = dynamic.partial_piv_lu().solve(&self.small_load);
            for (part, factor) in factors.iter().enumerate() {
                for i in 0..width {
                    shares[(part * width + i, place)] = factor * y[i];
                }
            }
            let reading = |c: &Col<c64>| -> c64 { (0..width).map(|i| c[i] * y[i]).sum() };
            read.push(self.probes.iter().map(reading).collect());
        }
        let carried = &self.tall * shares;
        let size = self.load.norm_l2();
        let residual = |place: usize| {
            let left =
                (0..carried.nrows()).map(|i| (self.load[i] - carried[(i, place)]).norm_sqr());
            let share = left.sum::<f64>().sqrt() / size;
            if share.is_finite() {
                share
            } else {
                f64::INFINITY
            }
        };
        let read = read.into_iter().enumerate();
        read.map(|(place, read)| (residual(place), read)).collect()
    }
}

/// An orthonormal basis of the span of some vectors of unit length.
fn orthonormal(rows: usize, vectors: &[Col<c64>]) -> Mat<c64> {
    let matrix = Mat::from_fn(rows, vectors.len(), |i, k| vectors[k][i]);
    let qr = matrix.col_piv_qr();
    let size = |k: usize| qr.thin_R()[(k, k)].norm();
    let rank = (0..rows.min(vectors.len()))
        .take_while(|&k| size(k) > INDEPENDENT)
        .count();
    qr.compute_thin_Q().subcols(0, rank).to_owned()
}

/// Real and imaginary parts of columns, first all real parts.
fn halves(columns: &Mat<c64>) -> Mat<f64> {
    let count = columns.ncols();
    Mat::from_fn(columns.nrows(), 2 * count, |i, k| {
        match k.checked_sub(count) {
            None => columns[(i, k)].re,
            Some(k) => columns[(i, k)].im,
        }
    })
}

/// Columns from their real and imaginary parts, as [`halves`] returns them.
fn joined(halves: &Mat<f64>) -> Mat<c64> {
    let count = halves.ncols() / 2;
    Mat::from_fn(halves.nrows(), count, |i, k| {
        c64::new(halves[(i, k)], halves[(i, count + k)])
    })
}

/// Cholesky's factor C of K₀ = CCᵀ, with a small stiffness of free rigid motions.
fn factor_at_rest(system: &GyroscopicSystem) -> Result<Llt<f64>, SpectrumError> {
    let mut stiffness = system.stiffness.clone();
    let order = system.order();
    let largest = (0..order).map(|i| stiffness[(i, i)]).fold(0.0, f64::max);
    (0..order).for_each(|i| stiffness[(i, i)] += LEAST_STIFFNESS * largest);
    let factor = stiffness.llt(Side::Lower);
    factor.map_err(|_| SpectrumError::UnstableAtRest { order })
}

/// Factor of a matrix of L, from Ω and s = iω.
type Factor = fn(f64, c64) -> c64;

/// The matrices of L(iω; Ω) that a system has, each with its factor; `None` is the unit matrix of the inertia.
fn terms(system: &GyroscopicSystem) -> Vec<(Option<&Mat<f64>>, Factor)> {
    const ONE: c64 = c64::new(1.0, 0.0);
    let always: [(_, Factor); 3] = [
        (Some(&system.stiffness), |_, _| ONE),
        (Some(&system.spin), |speed, _| ONE * speed.powi(2)),
        (Some(&system.gyroscopic), |speed, s| s * (2.0 * speed)),
    ];
    let optional: [(_, Factor); 3] = [
        (system.circulatory.as_ref(), |speed, _| ONE * speed),
        (system.nonconservative.as_ref(), |_, _| ONE),
        (system.damping.as_ref(), |_, s| s),
    ];
    let present = optional.into_iter().filter(|(term, _)| term.is_some());
    let inertia: (_, Factor) = (None, |_, s| s * s);
    always.into_iter().chain(present).chain([inertia]).collect()
}
