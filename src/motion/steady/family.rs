//! Steady states at many speeds or frequencies, on a basis of full solutions.
//!
//! Each steady state q e^{iωt} solves L(iω; Ω) q = f. Neighbouring solutions differ little, so that a few solutions of the full
//! model span the others. The residual of the full model shows where another solution is needed, so that no mode is truncated.

use faer::linalg::solvers::{Llt, Solve};
use faer::{Col, Mat, Scale, Side, c64};
use rayon::prelude::*;

use super::reduced_model::{Reduced, State};
use crate::model::linalg::complex_eigenvalues;
use crate::model::system::{GyroscopicSystem, dynamic_stiffness};
use crate::modes::{Cancellation, SpectrumError};

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

/// Place around which poles are found, as a share of the range: it is at least half of the range away from all real places, so that L
/// is regular there, and all poles within the range are resolved equally well.
const CENTRE: c64 = c64::new(0.5, 0.5);
/// Relative distance from a pole within which an excited motion deflects as far as under the load at rest; a motion that does so only
/// closer to it is not excited.
const EXCITED: f64 = 1e-6;
/// Largest imaginary part of a pole relative to its real part: more strongly damped motions have no peak.
const PEAKED: f64 = 0.5;
/// First place of a pole as a share of the last place, because free rigid motions have poles at zero.
const LEAST: f64 = 1e-6;
/// Relative distance of two poles that are one, such as those of cos nθ and sin nθ of a free blade.
const SAME: f64 = 1e-7;

/// The steady states of a system under a load, on the solutions of the full model that are known.
pub struct Family<'a> {
    system: &'a GyroscopicSystem,
    load: &'a Col<c64>,
    factor: Llt<f64>,
    /// Solutions of the full model, of unit length.
    vectors: Vec<Col<c64>>,
}

impl<'a> Family<'a> {
    /// The states under a load f.
    ///
    /// # Errors
    /// [`SpectrumError::UnstableAtRest`] if the stiffness at rest is not positive definite.
    pub fn new(system: &'a GyroscopicSystem, load: &'a Col<c64>) -> Result<Self, SpectrumError> {
        Ok(Family {
            factor: factor_at_rest(system)?,
            system,
            load,
            vectors: Vec::new(),
        })
    }

    /// Readings cᵀq at each state; `None` where the dynamic stiffness is singular. Readings whose absolute value exceeds `beyond`
    /// are rough.
    ///
    /// # Errors
    /// [`SpectrumError::Cancelled`].
    pub fn readings(
        &mut self,
        states: &[State],
        probes: &[Col<f64>],
        beyond: f64,
    ) -> Result<Vec<Option<Vec<c64>>>, SpectrumError> {
        let cancellation = Cancellation::current();
        let mut found: Vec<Option<Vec<c64>>> = vec![None; states.len()];
        // A coarse selection of the states comes first, because a basis for them represents nearly all solutions
        // at the other states.
        let stride = states.len().div_ceil(COARSE).max(1);
        let (coarse, others): (Vec<usize>, Vec<usize>) =
            (0..states.len()).partition(|k| k.is_multiple_of(stride));
        for mut left in [coarse, others] {
            let mut asked = if self.vectors.is_empty() {
                let first = spread(left.len(), FIRST).into_iter();
                first.map(|k| left[k]).collect()
            } else {
                Vec::new()
            };
            while !left.is_empty() {
                cancellation.check()?;
                let solved: Vec<Col<c64>> = asked
                    .par_iter()
                    .map(|k| solution(self.system, self.load, states[*k]))
                    .collect();
                for (k, q) in asked.iter().zip(&solved) {
                    let norm = q.norm_l2();
                    if norm > 0.0 && norm.is_finite() {
                        found[*k] = Some(probes.iter().map(|c| reading(c, q)).collect());
                        self.vectors.push(Scale(c64::new(1.0 / norm, 0.0)) * q);
                    }
                }
                left.retain(|k| !asked.contains(k));
                let reduced = self.reduced(probes);
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
                    if residual <= allowed {
                        found[k] = Some(read)
                    } else {
                        worst.push((k, residual))
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

    fn reduced(&self, probes: &[Col<f64>]) -> Reduced {
        let basis = orthonormal(self.system.order(), &self.vectors);
        Reduced::new(self.system, self.load, probes, &basis, &self.factor)
    }

    /// Resonances between two places t of a path of states, t ↦ (Ω, s) with linear functions Ω and s: the poles t of L⁻¹f, each as its
    /// real part and its distance from the real axis, ascending. A pole whose motion the load does not excite is none.
    ///
    /// On the path L is quadratic in t, so that its poles are eigenvalues on the basis. The basis holds the solutions at the states of
    /// [`Family::readings`], so that it also holds each motion that is excited there.
    ///
    /// # Errors
    /// [`SpectrumError`].
    pub fn poles(
        &self,
        [from, to]: [f64; 2],
        path: impl Fn(c64) -> (c64, c64),
    ) -> Result<Vec<(f64, f64)>, SpectrumError> {
        let reduced = self.reduced(&[]);
        let width = reduced.small_load.nrows();
        let at = |place: c64| {
            let (speed, s) = path(place);
            reduced.dynamic(speed, s)
        };
        let [middle, above, below] =
            [0.0, 1.0, -1.0].map(|off| at(from + (to - from) * (CENTRE + off)));
        let half = Scale(c64::new(0.5, 0.0));
        let slope = half * (&above - &below);
        let bend = half * (&above + &below) - &middle;
        // At the distance 1/u from the centre: (u² L₀ + u L₁ + L₂) x = 0.
        let factors = middle.partial_piv_lu();
        let mut companion = Mat::zeros(2 * width, 2 * width);
        for (column, of) in [(0, &slope), (width, &bend)] {
            let mut block = companion.submatrix_mut(0, column, width, width);
            block.copy_from(Scale(c64::new(-1.0, 0.0)) * factors.solve(of));
        }
        (0..width).for_each(|i| companion[(width + i, i)] = c64::new(1.0, 0.0));
        let inverses = complex_eigenvalues(companion.as_ref())
            .map_err(SpectrumError::at(path(c64::new(to, 0.0)).0.re))?;
        let mut found: Vec<(f64, f64)> = inverses
            .into_iter()
            .map(|u| from + (to - from) * (CENTRE + 1.0 / u))
            .filter(|pole| (from.max(LEAST * to)..=to).contains(&pole.re))
            .filter(|pole| pole.im.abs() <= PEAKED * pole.re)
            .filter(|pole| reduced.excitation(*pole, at) > EXCITED)
            .map(|pole| (pole.re, pole.im.abs()))
            .collect();
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        found.dedup_by(|a, b| (a.0 - b.0).abs() <= SAME * b.0);
        Ok(found)
    }
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

/// Cholesky's factor C of K₀ = CCᵀ, with a small stiffness of free rigid motions.
fn factor_at_rest(system: &GyroscopicSystem) -> Result<Llt<f64>, SpectrumError> {
    let mut stiffness = system.stiffness.clone();
    let order = system.order();
    let largest = (0..order).map(|i| stiffness[(i, i)]).fold(0.0, f64::max);
    (0..order).for_each(|i| stiffness[(i, i)] += LEAST_STIFFNESS * largest);
    let factor = stiffness.llt(Side::Lower);
    factor.map_err(|_| SpectrumError::UnstableAtRest { order })
}
