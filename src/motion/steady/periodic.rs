//! Periodic motions, as sums of harmonics.

use std::f64::consts::TAU;

use faer::{Col, Mat, c64};

/// A periodic motion: columns a₀, a₁, b₁, a₂, b₂, …
#[derive(Debug, Clone, PartialEq)]
pub struct Periodic(pub(super) Mat<f64>);

/// Number of phases at which a motion is evaluated.
const PHASES: usize = 96;

/// Values of the first functions of time at the times of a period, and the weights of these times in their coefficients.
pub(super) fn times(count: usize, width: usize) -> (Mat<f64>, Mat<f64>) {
    let at = Mat::from_fn(width, count, |k, time| {
        function(k, TAU * time as f64 / count as f64)
    });
    let back = Mat::from_fn(count, width, |time, k| {
        let norm = if k == 0 { 1.0 } else { 2.0 };
        norm / count as f64 * at[(k, time)]
    });
    (at, back)
}

/// The k-th of the functions 1, cos φ, sin φ, cos 2φ, sin 2φ, … at a phase φ.
pub(super) fn function(k: usize, phase: f64) -> f64 {
    let (sin, cos) = (k.div_ceil(2) as f64 * phase).sin_cos();
    match k {
        0 => 1.0,
        _ if k % 2 == 1 => cos,
        _ => sin,
    }
}

impl Periodic {
    /// q at a phase ωt.
    pub fn at(&self, phase: f64) -> Col<f64> {
        &self.0 * Col::from_fn(self.0.ncols(), |k| function(k, phase))
    }

    /// Mean of cᵀq.
    pub fn mean(&self, probe: &Col<f64>) -> f64 {
        probe.transpose() * self.0.col(0)
    }

    /// W of the part Re W e^{ikωt} of cᵀq.
    pub fn harmonic(&self, k: usize, probe: &Col<f64>) -> c64 {
        let [cos, sin] = [2 * k - 1, 2 * k].map(|k| probe.transpose() * self.0.col(k));
        c64::new(cos, -sin)
    }

    /// The coordinates at many phases of a period.
    pub fn states(&self) -> Vec<Col<f64>> {
        let phases = (0..PHASES).map(|k| TAU * k as f64 / PHASES as f64);
        phases.map(|phase| self.at(phase)).collect()
    }

    /// Half of the difference between the largest and the smallest cᵀq.
    pub fn amplitude(&self, probe: &Col<f64>) -> f64 {
        let [low, high] = extremes(&self.states(), probe);
        0.5 * (high - low)
    }
}

/// Smallest and largest cᵀq of some states.
pub fn extremes(states: &[Col<f64>], probe: &Col<f64>) -> [f64; 2] {
    let values = || states.iter().map(|q| probe.transpose() * q);
    [
        values().fold(f64::INFINITY, f64::min),
        values().fold(f64::NEG_INFINITY, f64::max),
    ]
}
