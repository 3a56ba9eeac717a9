//! Motion at a constant speed, by the exponential of the state matrix.
//!
//! With x = (q, q̇/s), ẋ = A x + B f(t) and f linear over a step Δ,
//!
//! x(Δ) = E x(0) + Γ₀ f(0) + Γ₁ (f(Δ) − f(0)),
//!
//! where E, Γ₀ and Γ₁ are the first rows of exp [[ΔA, ΔB, 0], [0, 0, 1], [0, 0, 0]] (C. F. Van Loan,
//! *Computing integrals involving the matrix exponential*, IEEE Trans. Automatic Control 23 (1978) 395–404).
//! The step is limited neither by accuracy nor by stability.

use faer::{Col, Mat, Scale};
use nalgebra::DMatrix;

use crate::model::scene::rpm;
use crate::model::system::GyroscopicSystem;
use crate::modes::{Cancellation, time_scale};

use super::{Integrator, State, TransientError};

/// Exact steps of one length at one speed.
#[derive(Debug, Clone)]
pub struct Propagator {
    transition: Mat<f64>,
    load_now: Mat<f64>,
    load_change: Mat<f64>,
    scale_per_s: f64,
}

impl Propagator {
    /// Steps of `step_s` at a speed, under loads Σ fₖ(t) bₖ; `loads` are the bₖ in the unknowns of the system.
    ///
    /// # Errors
    /// [`TransientError::NotFinite`] if the exponential overflows; [`TransientError::Spectrum`] if the
    /// computation was cancelled.
    pub fn new(
        system: &GyroscopicSystem,
        speed_rad_per_s: f64,
        loads: &[Col<f64>],
        step_s: f64,
    ) -> Result<Self, TransientError> {
        Cancellation::current().check()?;
        let (order, count) = (system.order(), loads.len());
        let (stiffness, velocity) = (
            system.stiffness_at(speed_rad_per_s),
            system.velocity_at(speed_rad_per_s),
        );
        let scale_per_s = time_scale(&stiffness);
        let size = 2 * order;
        let mut augmented = DMatrix::zeros(size + 2 * count, size + 2 * count);
        for i in 0..order {
            augmented[(i, order + i)] = step_s * scale_per_s;
            for k in 0..order {
                augmented[(order + i, k)] = -step_s * stiffness[(i, k)] / scale_per_s;
                augmented[(order + i, order + k)] = -step_s * velocity[(i, k)];
            }
        }
        for (k, load) in loads.iter().enumerate() {
            for i in 0..order {
                augmented[(order + i, size + k)] = step_s * load[i] / scale_per_s;
            }
            augmented[(size + k, size + count + k)] = 1.0;
        }
        let not_finite = || TransientError::NotFinite {
            rpm: rpm(speed_rad_per_s),
            step_s,
        };
        if !augmented.iter().all(|value| value.is_finite()) {
            return Err(not_finite());
        }
        let exponential = augmented.exp();
        if !exponential.iter().all(|value| value.is_finite()) {
            return Err(not_finite());
        }
        let part = |column: usize, width: usize| {
            Mat::from_fn(size, width, |i, k| exponential[(i, column + k)])
        };
        Ok(Propagator {
            transition: part(0, size),
            load_now: part(size, count),
            load_change: part(size + count, count),
            scale_per_s,
        })
    }

    /// The matrix E of x = (q, q̇/s), with the time scale s of this propagator.
    pub fn transition(&self) -> &Mat<f64> {
        &self.transition
    }

    /// Time scale s, in 1/s.
    pub fn scale_per_s(&self) -> f64 {
        self.scale_per_s
    }
}

impl Integrator for Propagator {
    fn step(&self, state: &State, [now, next]: [&[f64]; 2]) -> Result<State, TransientError> {
        let order = state.displacement.nrows();
        let x = Col::from_fn(2 * order, |i| match i.checked_sub(order) {
            None => state.displacement[i],
            Some(i) => state.velocity[i] / self.scale_per_s,
        });
        let change = Col::from_fn(now.len(), |k| next[k] - now[k]);
        let now = Col::from_fn(now.len(), |k| now[k]);
        let x = &self.transition * x + &self.load_now * now + &self.load_change * change;
        Ok(State {
            displacement: x.subrows(0, order).to_owned(),
            velocity: Scale(self.scale_per_s) * x.subrows(order, order),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::analytical::oscillator::{response_to_a_ramp, ring_down};
    use faer::mat;

    fn oscillator(stiffness: f64, damping: f64) -> GyroscopicSystem {
        GyroscopicSystem {
            stiffness: mat![[stiffness]],
            spin: Mat::zeros(1, 1),
            gyroscopic: Mat::zeros(1, 1),
            damping: (damping > 0.0).then(|| mat![[damping]]),
            circulatory: None,
            nonconservative: None,
            free_rigid: Vec::new(),
            drift: None,
        }
    }

    /// A force that changes linearly gives an exact result for any step.
    #[test]
    fn a_ramp_on_one_mode_is_exact() {
        let omega: f64 = 7.0;
        let one = Col::from_fn(1, |_| 1.0);
        for step_s in [0.01, 0.5, 3.0] {
            let propagator = Propagator::new(
                &oscillator(omega.powi(2), 0.0),
                0.0,
                std::slice::from_ref(&one),
                step_s,
            )
            .unwrap();
            let mut state = State::rest(1);
            for step in 0..4 {
                let t = f64::from(step) * step_s;
                state = propagator.step(&state, [&[t], &[t + step_s]]).unwrap();
            }
            let exact = response_to_a_ramp(omega, 4.0 * step_s);
            assert!(
                (state.displacement[0] / exact - 1.0).abs() < 1e-11,
                "{step_s}"
            );
        }
    }

    #[test]
    fn a_damped_mode_rings_down_as_in_the_closed_form() {
        let (omega, delta): (f64, f64) = (40.0, 3.0);
        let propagator =
            Propagator::new(&oscillator(omega.powi(2), 2.0 * delta), 0.0, &[], 0.013).unwrap();
        let mut state = State::rest(1);
        state.displacement[0] = 1.0;
        for _ in 0..50 {
            state = propagator.step(&state, [&[], &[]]).unwrap();
        }
        let exact = ring_down(omega, delta, 50.0 * 0.013);
        assert!((state.displacement[0] - exact).abs() < 1e-12);
    }
}
