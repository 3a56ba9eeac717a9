//! Small motions about a periodic one: every force is linearized along it.
//!
//! The exponents of small motions are those of the monodromy matrix over a period.

use std::f64::consts::TAU;

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, Scale, c64};

use crate::model::linalg::{real_eigenvalues, symmetric_eigenvalues};
use crate::model::system::dynamic_stiffness;

use super::balance::{Balance, LEAST_TIMES};
use super::periodic::{Periodic, function, times};

/// Number of steps of the monodromy matrix in a period of the highest frequency that it resolves; they change this frequency by
/// 0.02 %, and its decay by 0.06 %.
const STEPS: f64 = 128.0;
/// Number of natural frequencies that are resolved; higher modes hardly follow the motion.
const RESOLVED: usize = 6;
/// Largest number of times in a period at which forces are evaluated for neglected harmonics.
const MOST_TIMES: usize = 4096;

/// Fastest growth of a small motion about a periodic one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Growth {
    /// Growth rate, the real part of the exponent.
    pub per_s: f64,
    /// Smallest frequency of the small motion, at most half of that of the periodic one.
    pub frequency_rad_per_s: f64,
}

/// A motion with the stiffness along it.
pub struct Along<'a> {
    balance: &'a Balance<'a>,
    motion: &'a Periodic,
    /// Coefficients of the stiffness of cubic forces, a column each, with the entries of the matrix below each other.
    cubic: Mat<f64>,
    /// Mean of the stiffness over a period.
    mean: Mat<f64>,
    /// The highest frequency that small motions need: that of the harmonics of the motion, and of the lowest modes with the mean
    /// stiffness.
    highest_rad_per_s: f64,
}

impl<'a> Along<'a> {
    /// Linearizes every force along a motion; `None` if an eigenproblem fails.
    pub fn new(balance: &'a Balance<'a>, motion: &'a Periodic) -> Option<Self> {
        let order = balance.order();
        let harmonic = balance.harmonics as f64 * balance.frequency_rad_per_s;
        let mut along = Along {
            cubic: cubic_stiffness(balance, motion),
            mean: Mat::zeros(order, order),
            highest_rad_per_s: harmonic,
            balance,
            motion,
        };
        let at: Mat<f64> = Mat::from_fn(balance.width(), LEAST_TIMES, |k, time| {
            function(k, TAU * time as f64 / LEAST_TIMES as f64)
        });
        let states = &motion.0 * at;
        let equal = Mat::full(LEAST_TIMES, 1, 1.0 / LEAST_TIMES as f64);
        // The first function of the stiffness of cubic forces is its mean.
        let mut means = along.cubic.subcols(0, 1).to_owned();
        for term in balance.terms.iter().filter(|term| !term.is_cubic) {
            means += term.force.stiffness_sums(&states, &equal);
        }
        along.mean = Mat::from_fn(order, order, |i, j| {
            balance.stiffness[(i, j)] + means[(j * order + i, 0)]
        });
        let squares = symmetric_eigenvalues(along.mean.as_ref()).ok()?;
        let natural = squares.iter().take(RESOLVED);
        let natural = natural.map(|square| square.abs().sqrt());
        along.highest_rad_per_s = natural.fold(harmonic, f64::max);
        Some(along)
    }

    /// Stiffness matrix at a phase of the motion.
    fn stiffness_at(&self, phase: f64) -> Mat<f64> {
        let order = self.balance.order();
        let own = &self.cubic * Col::from_fn(self.cubic.ncols(), |k| function(k, phase));
        let cubic = Mat::from_fn(order, order, |i, j| own[j * order + i]);
        let mut stiffness = &self.balance.stiffness + cubic;
        let at = self.motion.at(phase);
        for term in self.balance.terms.iter().filter(|term| !term.is_cubic) {
            term.force.add_stiffness(&at, &mut stiffness);
        }
        stiffness
    }

    /// The harmonics that the motion neglects, as the linear response to the forces along it: order and complex amplitudes of each, up
    /// to the highest frequency that small motions need, and to twice the harmonics of the motion at least.
    pub fn neglected(&self) -> Vec<(usize, Col<c64>)> {
        let balance = self.balance;
        let order = balance.order();
        let reach = (self.highest_rad_per_s / balance.frequency_rad_per_s).ceil() as usize;
        let last = reach.clamp(2 * balance.harmonics, MOST_TIMES / 4);
        let width = 1 + 2 * last;
        let mut coefficients = Mat::<f64>::zeros(order, width);
        for term in balance.terms {
            // Coefficients of cubic forces beyond those that they have are zero.
            let own = if term.is_cubic {
                width.min(6 * balance.harmonics + 1)
            } else {
                width
            };
            let (at, back) = times(LEAST_TIMES.max(4 * own), own);
            let along = Mat::from_fn(balance.width(), at.ncols(), |k, time| {
                function(k, TAU * time as f64 / at.ncols() as f64)
            });
            let mut columns = coefficients.subcols_mut(0, own);
            columns += term.force.forces_at(&(&self.motion.0 * along)) * back;
        }
        (balance.harmonics + 1..=last)
            .map(|k| {
                let frequency = k as f64 * balance.frequency_rad_per_s;
                let dynamic =
                    dynamic_stiffness(&self.mean, &balance.velocity, c64::new(0.0, frequency));
                let load = Col::from_fn(order, |i| {
                    c64::new(coefficients[(i, 2 * k - 1)], -coefficients[(i, 2 * k)])
                });
                (k, dynamic.partial_piv_lu().solve(&load))
            })
            .collect()
    }

    /// The fastest growth of small motions; `None` if the eigenvalues are not found. The monodromy matrix is that of the implicit
    /// midpoint rule, which keeps the energy of an undamped blade at constant stiffness.
    pub fn growth(&self) -> Option<Growth> {
        let balance = self.balance;
        let order = balance.order();
        let period_s = TAU / balance.frequency_rad_per_s;
        let steps = (STEPS * self.highest_rad_per_s / balance.frequency_rad_per_s).ceil() as usize;
        let step_s = period_s / steps as f64;
        let mut state = Mat::<f64>::identity(2 * order, 2 * order);
        for step in 0..steps {
            let phase = TAU * (step as f64 + 0.5) / steps as f64;
            let stiffness = self.stiffness_at(phase);
            // With the step Δ, D = `velocity`, K = `stiffness` and the mean velocity v̄, a step solves
            // (2/Δ + D + K Δ/2) v̄ = 2v₀/Δ − K q₀ and sets q₁ = q₀ + Δ v̄, v₁ = 2v̄ − v₀.
            let mut left = &balance.velocity + Scale(0.5 * step_s) * &stiffness;
            (0..order).for_each(|i| left[(i, i)] += 2.0 / step_s);
            let (q, v) = (state.subrows(0, order), state.subrows(order, order));
            let mean = left
                .partial_piv_lu()
                .solve(Scale(2.0 / step_s) * v - &stiffness * q);
            let next_q = q + Scale(step_s) * &mean;
            let next_v = Scale(2.0) * &mean - v;
            state.subrows_mut(0, order).copy_from(&next_q);
            state.subrows_mut(order, order).copy_from(&next_v);
        }
        let largest = real_eigenvalues(state.as_ref())
            .ok()?
            .into_iter()
            .max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
        let growth = Growth {
            per_s: largest.norm().ln() / period_s,
            frequency_rad_per_s: largest.arg().abs() / period_s,
        };
        growth.per_s.is_finite().then_some(growth)
    }
}

/// Coefficients of the stiffness that cubic forces have along a motion, a column each, with the entries of the matrix below each
/// other; the derivatives of such forces have twice the harmonics of the motion.
fn cubic_stiffness(balance: &Balance<'_>, motion: &Periodic) -> Mat<f64> {
    let (order, width) = (balance.order(), 4 * balance.harmonics + 1);
    let mut coefficients = Mat::zeros(order * order, width);
    for term in balance.terms.iter().filter(|term| term.is_cubic) {
        let (at, back) = times(balance.count(term), width);
        let at = at.subrows(0, balance.width());
        coefficients += term.force.stiffness_sums(&(&motion.0 * at), &back);
    }
    coefficients
}
