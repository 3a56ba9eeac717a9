//! Motion while the speed changes, or under forces that depend on the displacement: Newmark's average
//! acceleration (β = 1/4, γ = 1/2).
//!
//! With d = q₁ − q₀ and v̄ = d/Δ the step is v₁ = 2v̄ − v₀ and
//!
//! 2(v̄ − v₀)/Δ + D v̄ + K(q₀ + q₁)/2 = (b(0) + b(Δ))/2 + ∫₀¹ f(q₀ + s d) ds.
//!
//! The method is unconditionally stable, of second order, and has no numerical damping. The mean of a force
//! along the straight line from q₀ to q₁ does exactly the work that its potential loses, so that the energy
//! of an undamped, unloaded blade is conserved.
//!
//! References: N. M. Newmark, *A method of computation for structural dynamics*, J. Eng. Mech. Div. ASCE 85
//! (1959), 67–94; G. R. W. Quispel & D. I. McLaren, *A new class of energy-preserving numerical integration
//! methods*, J. Phys. A 41 (2008), 045206, for the mean along the line.

use std::cell::RefCell;

use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Col, Mat, Scale};

use crate::model::scene::rpm;
use crate::model::system::GyroscopicSystem;

use super::{Force, Integrator, State, TransientError};

/// Steps of one length at one speed and acceleration.
pub struct Newmark<'a> {
    /// K(Ω) + Ω̇G: the acceleration adds a circulatory term.
    stiffness: Mat<f64>,
    /// 4/Δ² + 2D/Δ + K.
    effective: Mat<f64>,
    factors: PartialPivLu<f64>,
    loads: &'a [Col<f64>],
    forces: &'a [&'a dyn Force],
    /// Factors of the tangent where Newton's method was last needed: stiff forces change little from step to step.
    tangent: RefCell<Option<PartialPivLu<f64>>>,
    speed_rad_per_s: f64,
    step_s: f64,
}

/// Largest number of iterations of Newton's method; a step that resolves the motion takes two to four.
const ITERATIONS: usize = 30;
/// Relative size of the last correction of Newton's method: the next one would be of the order of its square.
const LAST: f64 = 1e-9;
/// Relative size of the last correction with a fixed matrix, which converges linearly.
const CLOSEST: f64 = 1e-13;
/// Share of a correction that is applied even if the residual does not fall, which rounding may prevent.
const SHORTEST: f64 = 0.01;
/// Ratio of a correction to the preceding one above which Newton's method replaces the fixed matrix.
const QUICK: f64 = 0.3;

impl<'a> Newmark<'a> {
    /// Steps of `step_s` at Ω and Ω̇ under loads Σ sₖ(t) bₖ; `loads` are the bₖ.
    pub fn new(
        system: &GyroscopicSystem,
        (speed_rad_per_s, rate_rad_per_s2): (f64, f64),
        loads: &'a [Col<f64>],
        step_s: f64,
    ) -> Self {
        let stiffness =
            system.stiffness_at(speed_rad_per_s) + Scale(rate_rad_per_s2) * &system.gyroscopic;
        let mut effective = Scale(2.0 / step_s) * system.velocity_at(speed_rad_per_s) + &stiffness;
        for i in 0..system.order() {
            effective[(i, i)] += 4.0 / step_s.powi(2);
        }
        Newmark {
            factors: effective.partial_piv_lu(),
            stiffness,
            effective,
            loads,
            forces: &[],
            tangent: RefCell::new(None),
            speed_rad_per_s,
            step_s,
        }
    }

    /// Adds forces that depend on the displacement.
    pub fn with_forces(self, forces: &'a [&'a dyn Force]) -> Self {
        Newmark { forces, ..self }
    }

    /// Solves E d = r + 2 ∫f(q₀ + s d) ds for the change d of the displacement. The iterations use the factors of
    /// one matrix, E or the last tangent, as long as they converge fast, which they do in steps that resolve the
    /// motion; otherwise Newton's method follows.
    ///
    /// # Errors
    /// [`TransientError::NotBalanced`].
    fn balanced(&self, state: &State, right: &Col<f64>) -> Result<Col<f64>, TransientError> {
        let q = &state.displacement;
        let begun = Scale(self.step_s) * &state.velocity;
        let mut change = begun.clone();
        let mut last = f64::INFINITY;
        for _ in 0..ITERATIONS {
            let correction = match &*self.tangent.borrow() {
                Some(factors) => factors.solve(self.left(q, right, &change)),
                None => self.factors.solve(right + self.twice_mean(q, &change)) - &change,
            };
            change += &correction;
            let size = correction.norm_l2();
            if size <= CLOSEST * (q.norm_l2() + change.norm_l2()) {
                return Ok(change);
            }
            if size.is_nan() || size >= QUICK * last {
                break;
            }
            last = size;
        }
        if !change.norm_l2().is_finite() {
            change = begun;
        }
        self.by_newton(q, right, change)
    }

    /// Residual of the equation that [`Newmark::balanced`] solves.
    fn left(&self, q: &Col<f64>, right: &Col<f64>, change: &Col<f64>) -> Col<f64> {
        right + self.twice_mean(q, change) - &self.effective * change
    }

    /// 2 ∫₀¹ f(q + s d) ds.
    fn twice_mean(&self, q: &Col<f64>, change: &Col<f64>) -> Col<f64> {
        let mut mean = Col::zeros(q.nrows());
        for force in self.forces {
            force.add_mean_to(q, change, &mut mean);
        }
        Scale(2.0) * mean
    }

    /// Solves as [`Newmark::balanced`] by Newton's method. Each correction is halved until the residual falls,
    /// because a whole one may go too far where a pad begins to touch.
    fn by_newton(
        &self,
        q: &Col<f64>,
        right: &Col<f64>,
        mut change: Col<f64>,
    ) -> Result<Col<f64>, TransientError> {
        let mut residual = self.left(q, right, &change);
        for _ in 0..ITERATIONS {
            let mut stiffness = Mat::zeros(q.nrows(), q.nrows());
            for force in self.forces {
                force.add_mean_stiffness(q, &change, &mut stiffness);
            }
            let tangent = &self.effective + Scale(2.0) * stiffness;
            let factors = tangent.partial_piv_lu();
            let correction = factors.solve(&residual);
            *self.tangent.borrow_mut() = Some(factors);
            let mut share = 1.0;
            loop {
                let next = &change + Scale(share) * &correction;
                let after = self.left(q, right, &next);
                let falls = after.norm_l2() <= (1.0 - 1e-4 * share) * residual.norm_l2();
                if falls || share < SHORTEST {
                    (change, residual) = (next, after);
                    break;
                }
                share *= 0.5;
            }
            let size = q.norm_l2() + change.norm_l2();
            if correction.norm_l2() <= LAST * size {
                return Ok(change);
            }
        }
        Err(TransientError::NotBalanced {
            rpm: rpm(self.speed_rad_per_s),
            step_s: self.step_s,
        })
    }
}

impl Integrator for Newmark<'_> {
    /// (4/Δ² + 2D/Δ + K) d = b(0) + b(Δ) + 4v₀/Δ − 2K q₀ + 2∫f.
    fn step(&self, state: &State, [now, next]: [&[f64]; 2]) -> Result<State, TransientError> {
        let State {
            displacement: q,
            velocity: v,
        } = state;
        let mut right = Scale(4.0 / self.step_s) * v - Scale(2.0) * (&self.stiffness * q);
        for (load, (now, next)) in self.loads.iter().zip(now.iter().zip(next)) {
            right += Scale(now + next) * load;
        }
        let change = match self.forces {
            [] => self.factors.solve(&right),
            _ => self.balanced(state, &right)?,
        };
        Ok(State {
            displacement: q + &change,
            velocity: Scale(2.0 / self.step_s) * &change - v,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::analytical::oscillator::hardening_period_s;
    use faer::mat;

    /// The force −g q³.
    struct Hardening(f64);

    impl Force for Hardening {
        fn add_to(&self, displacement: &Col<f64>, force: &mut Col<f64>) {
            force[0] -= self.0 * displacement[0].powi(3);
        }

        fn add_stiffness(&self, displacement: &Col<f64>, stiffness: &mut Mat<f64>) {
            stiffness[(0, 0)] += 3.0 * self.0 * displacement[0].powi(2);
        }
    }

    const STIFFNESS: f64 = 900.0;
    const CUBIC: f64 = 4e5;
    const AMPLITUDE: f64 = 0.1;

    fn oscillator() -> GyroscopicSystem {
        let none = || Mat::zeros(1, 1);
        GyroscopicSystem::undamped(mat![[STIFFNESS]], none(), none())
    }

    fn energy(state: &State) -> f64 {
        let (q, v) = (state.displacement[0], state.velocity[0]);
        0.5 * v * v + 0.5 * STIFFNESS * q * q + 0.25 * CUBIC * q.powi(4)
    }

    /// The state after a period of `steps` steps, and the largest relative change of energy.
    fn after_a_period(steps: u32) -> (State, f64) {
        let force = Hardening(CUBIC);
        let forces: [&dyn Force; 1] = [&force];
        let system = oscillator();
        let step_s = hardening_period_s(STIFFNESS, CUBIC, AMPLITUDE) / f64::from(steps);
        let newmark = Newmark::new(&system, (0.0, 0.0), &[], step_s).with_forces(&forces);
        let mut state = State::still(Col::from_fn(1, |_| AMPLITUDE));
        let before = energy(&state);
        let mut lost = 0.0_f64;
        for _ in 0..steps {
            state = newmark.step(&state, [&[], &[]]).unwrap();
            lost = lost.max((energy(&state) / before - 1.0).abs());
        }
        (state, lost)
    }

    /// A spring whose stiffness rises fivefold: the energy is conserved to rounding, and the period converges
    /// with second order to that of elliptic functions.
    #[test]
    fn a_force_with_a_potential_keeps_the_energy_and_the_period() {
        let error = |steps| {
            let (state, lost) = after_a_period(steps);
            assert!(lost < 1e-12, "{steps}: {lost:e}");
            // At a turning point the velocity shows the error of phase.
            state.velocity[0] / (AMPLITUDE * (STIFFNESS + CUBIC * AMPLITUDE.powi(2)).sqrt())
        };
        let (coarse, fine) = (error(200), error(400));
        let order = (coarse / fine).log2();
        assert!((order - 2.0).abs() < 0.02, "{order}: {coarse:e} {fine:e}");
        assert!(fine.abs() < 1e-2, "{fine:e}");
    }

    /// A force that no step can balance gives an error.
    #[test]
    fn a_force_that_is_not_a_number_is_refused() {
        let force = Hardening(f64::NAN);
        let forces: [&dyn Force; 1] = [&force];
        let system = oscillator();
        let newmark = Newmark::new(&system, (0.0, 0.0), &[], 1e-3).with_forces(&forces);
        let state = State::still(Col::from_fn(1, |_| AMPLITUDE));
        let refused = newmark.step(&state, [&[], &[]]);
        assert!(matches!(refused, Err(TransientError::NotBalanced { .. })));
    }
}
