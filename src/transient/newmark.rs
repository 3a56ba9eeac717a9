//! Motion while the speed changes, by Newmark's average acceleration (β = 1/4, γ = 1/2).
//!
//! Unconditionally stable, of second order, and without damping of its own: it keeps the
//! energy of an undamped, unloaded blade (N. M. Newmark, *A method of computation for
//! structural dynamics*, J. Eng. Mech. Div. ASCE 85 (1959) 67–94).

use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Col, Mat, Scale};

use crate::system::GyroscopicSystem;

/// Displacement, velocity and acceleration.
#[derive(Debug, Clone)]
pub struct Motion {
    /// q.
    pub displacement: Col<f64>,
    /// q̇.
    pub velocity: Col<f64>,
    /// q̈.
    pub acceleration: Col<f64>,
}

/// Steps of one length at one speed and rate of speed.
#[derive(Debug)]
pub struct Newmark {
    /// K(Ω) + Ω̇G: a blade that speeds up drags the waves along.
    stiffness: Mat<f64>,
    damping: Mat<f64>,
    /// 4/Δ² + 2D/Δ + K.
    factors: PartialPivLu<f64>,
    step_s: f64,
}

impl Newmark {
    /// Steps of `step_s` at Ω and Ω̇.
    pub fn new(
        system: &GyroscopicSystem,
        speed_rad_per_s: f64,
        rate_rad_per_s2: f64,
        step_s: f64,
    ) -> Self {
        let damping = system.velocity_at(speed_rad_per_s);
        let stiffness =
            system.stiffness_at(speed_rad_per_s) + Scale(rate_rad_per_s2) * &system.gyroscopic;
        let mut effective = Scale(2.0 / step_s) * &damping + &stiffness;
        for i in 0..system.order() {
            effective[(i, i)] += 4.0 / step_s.powi(2);
        }
        Newmark {
            stiffness,
            damping,
            factors: effective.partial_piv_lu(),
            step_s,
        }
    }

    /// The motion that starts from q and q̇ under a load.
    pub fn start(&self, displacement: Col<f64>, velocity: Col<f64>, load: &Col<f64>) -> Motion {
        let acceleration = load - &self.damping * &velocity - &self.stiffness * &displacement;
        Motion {
            displacement,
            velocity,
            acceleration,
        }
    }

    /// One step to the load at its end:
    /// (4/Δ² + 2D/Δ + K) q₁ = f + (4q₀/Δ² + 4q̇₀/Δ + q̈₀) + D(2q₀/Δ + q̇₀).
    pub fn step(&self, motion: &Motion, load: &Col<f64>) -> Motion {
        let (inertia, drag) = (4.0 / self.step_s.powi(2), 2.0 / self.step_s);
        let Motion {
            displacement: q,
            velocity: v,
            acceleration: a,
        } = motion;
        let pushed = Scale(inertia) * q + Scale(2.0 * drag) * v + a;
        let right = load + &pushed + &self.damping * (Scale(drag) * q + v);
        let displacement = self.factors.solve(&right);
        let acceleration = Scale(inertia) * &displacement - pushed;
        let velocity = v + Scale(0.5 * self.step_s) * (a + &acceleration);
        Motion {
            displacement,
            velocity,
            acceleration,
        }
    }
}
