//! Steady states at many speeds or frequencies, on a basis of full solutions.
//!
//! Each steady state q e^{iωt} solves L(iω; Ω) q = f. Neighbouring solutions differ little, so that a few solutions of the full
//! model span the others. The residual of the full model tells where another one is needed, so that no mode is truncated.

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, Scale, c64};
use rayon::prelude::*;

use crate::spectrum::{Cancellation, SpectrumError, orthonormal, split};
use crate::system::{GyroscopicSystem, dynamic_stiffness};

/// A speed and a frequency, in rad/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Ω.
    pub speed_rad_per_s: f64,
    /// ω.
    pub frequency_rad_per_s: f64,
}

/// Number of solutions of the full model at first, and in each further round.
const FIRST: usize = 9;
const MORE: usize = 6;
/// Number of states with which the search for directions begins.
const COARSE: usize = 96;
/// Largest residual relative to the load.
const RESIDUAL: f64 = 1e-8;
/// Largest residual of a state whose deflection is beyond the linear model, of which only that is reported.
const RESIDUAL_BEYOND: f64 = 1e-2;
/// Directions closer to the span of the others are omitted.
const INDEPENDENT: f64 = 1e-9;

/// Readings cᵀq of the steady state under a load, at each state; `None` where the dynamic stiffness is singular. Readings whose
/// absolute value exceeds `beyond` are rough.
///
/// # Errors
/// [`SpectrumError::Cancelled`].
pub fn readings(
    system: &GyroscopicSystem,
    load: &Col<c64>,
    states: &[State],
    probes: &[Col<f64>],
    beyond: f64,
) -> Result<Vec<Option<Vec<c64>>>, SpectrumError> {
    let cancellation = Cancellation::current();
    let mut found: Vec<Option<Vec<c64>>> = vec![None; states.len()];
    let mut vectors: Vec<Col<f64>> = Vec::new();
    // Few states find nearly all directions that the others need.
    let stride = states.len().div_ceil(COARSE).max(1);
    let (coarse, others): (Vec<usize>, Vec<usize>) =
        (0..states.len()).partition(|k| k.is_multiple_of(stride));
    for mut left in [coarse, others] {
        let mut asked = match vectors.is_empty() {
            true => spread(left.len()).into_iter().map(|k| left[k]).collect(),
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
                    let (re, im) = split(&(Scale(c64::new(1.0 / norm, 0.0)) * q));
                    vectors.extend([re, im]);
                }
            }
            left.retain(|k| !asked.contains(k));
            let basis = orthonormal(system.order(), &vectors, INDEPENDENT);
            let reduced = Reduced::new(system, load, probes, &basis);
            let tried: Vec<(usize, f64, Vec<c64>)> = left
                .par_iter()
                .map(|k| {
                    let (residual, read) = reduced.at(states[*k]);
                    (*k, residual, read)
                })
                .collect();
            let mut worst: Vec<(usize, f64)> = Vec::new();
            for (k, residual, read) in tried {
                let is_beyond = read.iter().any(|value| value.norm() > beyond);
                let allowed = if is_beyond { RESIDUAL_BEYOND } else { RESIDUAL };
                match residual <= allowed {
                    true => found[k] = Some(read),
                    false => worst.push((k, residual)),
                }
            }
            left = worst.iter().map(|(k, _)| *k).collect();
            // Far apart, because neighbours need the same directions.
            asked = spread(worst.len())
                .into_iter()
                .take(MORE)
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

/// Places evenly spread over a list, with its ends.
fn spread(count: usize) -> Vec<usize> {
    let places = FIRST.min(count);
    let last = count.saturating_sub(1);
    (0..places)
        .map(|k| k * last / places.saturating_sub(1).max(1))
        .collect()
}

/// q of L(iω; Ω) q = f on the full model.
pub fn solution(system: &GyroscopicSystem, load: &Col<c64>, state: State) -> Col<c64> {
    let State {
        speed_rad_per_s: speed,
        frequency_rad_per_s: frequency,
    } = state;
    let (stiffness, velocity) = (system.stiffness_at(speed), system.velocity_at(speed));
    let dynamic = dynamic_stiffness(&stiffness, &velocity, c64::new(0.0, frequency));
    dynamic.partial_piv_lu().solve(load)
}

pub fn reading(probe: &Col<f64>, q: &Col<c64>) -> c64 {
    (0..q.nrows()).map(|i| q[i] * probe[i]).sum()
}

/// The system on a basis V, and its products with V for the residual.
struct Reduced<'a> {
    small: GyroscopicSystem,
    tall: GyroscopicSystem,
    basis: &'a Mat<f64>,
    load: &'a Col<c64>,
    small_load: Col<c64>,
    probes: Vec<Col<f64>>,
}

impl<'a> Reduced<'a> {
    fn new(
        system: &GyroscopicSystem,
        load: &'a Col<c64>,
        probes: &[Col<f64>],
        basis: &'a Mat<f64>,
    ) -> Self {
        let tall = system.times(basis.as_ref());
        Reduced {
            small: system.project(basis.as_ref()),
            tall,
            small_load: Col::from_fn(basis.ncols(), |k| {
                (0..basis.nrows()).map(|i| load[i] * basis[(i, k)]).sum()
            }),
            probes: probes.iter().map(|c| basis.transpose() * c).collect(),
            basis,
            load,
        }
    }

    /// Residual relative to the load, and readings.
    fn at(&self, state: State) -> (f64, Vec<c64>) {
        let y = solution(&self.small, &self.small_load, state);
        let speed = state.speed_rad_per_s;
        let s = c64::new(0.0, state.frequency_rad_per_s);
        let (stiffness, velocity) = (self.tall.stiffness_at(speed), self.tall.velocity_at(speed));
        let residual = Col::from_fn(self.load.nrows(), |i| {
            let row = (0..y.nrows()).map(|k| {
                (stiffness[(i, k)] + s * velocity[(i, k)] + s * s * self.basis[(i, k)]) * y[k]
            });
            self.load[i] - row.sum::<c64>()
        });
        let share = residual.norm_l2() / self.load.norm_l2();
        let read = self.probes.iter().map(|c| reading(c, &y)).collect();
        (
            if share.is_finite() {
                share
            } else {
                f64::INFINITY
            },
            read,
        )
    }
}
