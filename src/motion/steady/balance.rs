//! Periodic motions of a blade under periodic loads, by the balance of harmonics.
//!
//! q(t) = a₀ + Σ (aₖ cos kωt + bₖ sin kωt), k = 1 … H, in a frame fixed in space. The coefficients balance those of the loads,
//! of the linear terms and of the forces f(q): the latter are evaluated at many times of a period and expanded in the same
//! functions (alternating frequency/time method). The equations are solved by Newton's method. A correction is shortened until
//! the following one, from the same derivatives, is smaller: this test does not depend on the scaling of the equations.
//!
//! References: T. M. Cameron & J. H. Griffin, J. Appl. Mech. 56 (1989), 149–154; P. Deuflhard, *Newton Methods for Nonlinear
//! Problems*, 2004, chapter 3.

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, Scale};

use crate::model::system::GyroscopicSystem;

use super::periodic::{Periodic, product, times};
use super::term::{Term, flat};

/// The equations of the balance of a system at one speed.
pub struct Balance<'a> {
    pub(super) stiffness: Mat<f64>,
    pub(super) velocity: Mat<f64>,
    pub(super) frequency_rad_per_s: f64,
    pub(super) harmonics: usize,
    pub(super) terms: &'a [Term<'a>],
    /// Norm of coordinates relative to which small motions converge.
    size: f64,
}

/// Number of times in a period for each coefficient under forces of contact; the beginning and the end of a contact are
/// resolved to the distance of two times.
const TIMES: usize = 16;
/// Smallest number of times in a period under forces of contact.
pub(super) const LEAST_TIMES: usize = 192;
/// Number of times in a period for each coefficient under cubic forces. They have at most three times the harmonics of the motion,
/// and their derivatives twice, which then do not alias into those of the motion.
const TIMES_OF_CUBIC: usize = 2;
/// Largest number of iterations of Newton's method.
const ITERATIONS: usize = 30;
/// Relative size of the last correction.
const LAST: f64 = 1e-8;
/// Smallest share of a correction. It is applied in any case, because where a pad begins to touch the test may fail in all
/// directions.
const SHORTEST: f64 = 1.0 / 16.0;
/// Factor of the stiffness of contact and of the alternating loads with which the search starts again if Newton's method fails.
const SOFTEST: f64 = 1.0 / 4096.0;
/// Largest factor by which both then grow from one motion to the next.
const STIFFER: f64 = 4.0;
/// Smallest such factor, below which the search ends without a motion.
const LEAST_STIFFER: f64 = 1.05;

impl<'a> Balance<'a> {
    /// The balance at a speed, for motions with a frequency in rad/s and its multiples up to a number of harmonics.
    pub fn new(
        system: &GyroscopicSystem,
        speed_rad_per_s: f64,
        (frequency_rad_per_s, harmonics): (f64, usize),
        terms: &'a [Term<'a>],
        size: f64,
    ) -> Self {
        Balance {
            stiffness: system.stiffness_at(speed_rad_per_s),
            velocity: system.velocity_at(speed_rad_per_s),
            frequency_rad_per_s,
            harmonics,
            terms,
            size,
        }
    }

    pub(super) fn order(&self) -> usize {
        self.stiffness.nrows()
    }

    /// Number of coefficients of a coordinate.
    pub(super) fn width(&self) -> usize {
        1 + 2 * self.harmonics
    }

    /// Coefficients of loads, all zero: a row for each coordinate, a column for each coefficient.
    pub fn no_load(&self) -> Mat<f64> {
        Mat::zeros(self.order(), self.width())
    }

    /// Motion under constant and alternating loads. The search starts from a deflection at rest; if it fails, it starts again
    /// with small alternating loads between soft pads, which grow and become stiffer in steps. `None` if that fails too.
    pub fn motion(&self, rest: &Col<f64>, load: &Mat<f64>) -> Option<Periodic> {
        let mut still = self.no_load();
        still.col_mut(0).copy_from(rest);
        if let Some(found) = self.solved(&still, load, 1.0) {
            return Some(Periodic(found));
        }
        let part = |share: f64| {
            let mut part = Scale(share) * load;
            part.col_mut(0).copy_from(load.col(0));
            part
        };
        let mut motion = self.solved(&still, &part(SOFTEST), SOFTEST)?;
        let (mut share, mut factor) = (SOFTEST, STIFFER);
        while share < 1.0 {
            let next = (share * factor).min(1.0);
            match self.solved(&motion, &part(next), next) {
                Some(found) => {
                    (motion, share) = (found, next);
                    factor = (factor * factor).min(STIFFER);
                }
                None => factor = factor.sqrt(),
            }
            if factor < LEAST_STIFFER {
                return None;
            }
        }
        Some(Periodic(motion))
    }

    /// Motion that is close to a given one, which may have another number of harmonics; `None` if Newton's method fails.
    pub fn refined(&self, near: &Periodic, load: &Mat<f64>) -> Option<Periodic> {
        let mut motion = self.no_load();
        let known = near.0.ncols().min(self.width());
        motion
            .subcols_mut(0, known)
            .copy_from(near.0.subcols(0, known));
        self.solved(&motion, load, 1.0).map(Periodic)
    }

    /// Motion between pads that have a share of their stiffness; `None` if Newton's method fails.
    fn solved(&self, from: &Mat<f64>, load: &Mat<f64>, share: f64) -> Option<Mat<f64>> {
        let mut motion = from.clone();
        let mut rest = self.residual(&motion, load, share);
        for _ in 0..ITERATIONS {
            let factors = self.jacobian(&motion, share).partial_piv_lu();
            let correction = factors.solve(&flat(&rest));
            let length = correction.norm_l2();
            if !length.is_finite() {
                return None;
            }
            let shaped = self.shaped(&correction);
            if length <= LAST * motion.norm_l2().max(self.size) {
                return Some(motion - shaped);
            }
            let mut part = 1.0;
            (motion, rest) = loop {
                let next = &motion - Scale(part) * &shaped;
                let rest = self.residual(&next, load, share);
                let simplified = factors.solve(&flat(&rest)).norm_l2();
                if simplified <= (1.0 - 0.25 * part) * length || part <= SHORTEST {
                    break (next, rest);
                }
                part *= 0.5;
            };
        }
        None
    }

    fn shaped(&self, vector: &Col<f64>) -> Mat<f64> {
        let order = self.order();
        Mat::from_fn(order, self.width(), |i, k| vector[k * order + i])
    }

    /// Residual of each coefficient: elastic, viscous and inertial forces minus loads and nonlinear forces.
    fn residual(&self, motion: &Mat<f64>, load: &Mat<f64>, share: f64) -> Mat<f64> {
        let elastic = &self.stiffness * motion;
        let viscous = &self.velocity * motion;
        let mut rest = elastic - load;
        for k in 1..=self.harmonics {
            let frequency = k as f64 * self.frequency_rad_per_s;
            let (cos, sin) = (2 * k - 1, 2 * k);
            for i in 0..self.order() {
                let inertia = frequency * frequency;
                rest[(i, cos)] += frequency * viscous[(i, sin)] - inertia * motion[(i, cos)];
                rest[(i, sin)] -= frequency * viscous[(i, cos)] + inertia * motion[(i, sin)];
            }
        }
        for term in self.terms {
            let (at, back) = times(self.count(term), self.width());
            rest -= Scale(term.share(share)) * (term.force.forces_at(&(motion * &at)) * back);
        }
        rest
    }

    /// Number of times in a period at which a force is evaluated.
    pub(super) fn count(&self, term: &Term<'_>) -> usize {
        if term.is_cubic {
            self.width() * TIMES_OF_CUBIC
        } else {
            (self.width() * TIMES).max(LEAST_TIMES)
        }
    }

    fn jacobian(&self, motion: &Mat<f64>, share: f64) -> Mat<f64> {
        let (order, width) = (self.order(), self.width());
        let elastic = &self.stiffness;
        let mut jacobian = Mat::zeros(order * width, order * width);
        for k in 0..width {
            let frequency = k.div_ceil(2) as f64 * self.frequency_rad_per_s;
            for i in 0..order {
                for j in 0..order {
                    jacobian[(k * order + i, k * order + j)] = elastic[(i, j)];
                }
                jacobian[(k * order + i, k * order + i)] -= frequency * frequency;
            }
            if k % 2 == 1 {
                let (cos, sin) = (k * order, (k + 1) * order);
                for i in 0..order {
                    for j in 0..order {
                        jacobian[(cos + i, sin + j)] += frequency * self.velocity[(i, j)];
                        jacobian[(sin + i, cos + j)] -= frequency * self.velocity[(i, j)];
                    }
                }
            }
        }
        for term in self.terms {
            self.add_derivatives(term, share, motion, &mut jacobian);
        }
        jacobian
    }

    /// Adds the derivatives of the coefficients of a force; that of contact has a share of its stiffness.
    fn add_derivatives(
        &self,
        term: &Term<'_>,
        share: f64,
        motion: &Mat<f64>,
        jacobian: &mut Mat<f64>,
    ) {
        let (order, width) = (self.order(), self.width());
        let count = self.count(term);
        let (at, _) = times(count, 2 * width - 1);
        // Means over the period of the stiffness times each function of twice as many harmonics.
        let weights = Scale(term.share(share) / count as f64) * at.transpose();
        let means = term
            .force
            .stiffness_sums(&(motion * at.subrows(0, width)), &weights);
        for column in 0..width {
            for row in 0..width {
                let norm = if row == 0 { 1.0 } else { 2.0 };
                for (function, factor) in product(row, column) {
                    for j in 0..order {
                        for i in 0..order {
                            jacobian[(row * order + i, column * order + j)] +=
                                norm * factor * means[(j * order + i, function)];
                        }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
#[path = "balance_tests.rs"]
mod tests;
