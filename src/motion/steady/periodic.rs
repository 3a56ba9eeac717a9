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

/// The product of two of these functions as a sum of two others, each with its factor.
pub(super) fn product(one: usize, other: usize) -> [(usize, f64); 2] {
    let [i, j] = [one, other].map(|k| k.div_ceil(2) as isize);
    let is_sine = |k: usize| k > 0 && k.is_multiple_of(2);
    let cos = |m: isize, factor: f64| ((2 * m.unsigned_abs()).saturating_sub(1), factor);
    let sin = |m: isize, factor: f64| (2 * m.unsigned_abs(), factor * m.signum() as f64);
    match (is_sine(one), is_sine(other)) {
        (false, false) => [cos(i - j, 0.5), cos(i + j, 0.5)],
        (true, true) => [cos(i - j, 0.5), cos(i + j, -0.5)],
        (false, true) => [sin(j - i, 0.5), sin(i + j, 0.5)],
        (true, false) => [sin(i - j, 0.5), sin(i + j, 0.5)],
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_of_functions_are_sums_of_functions() {
        for one in 0..9 {
            for other in 0..9 {
                for phase in [0.3, 1.7, 4.1] {
                    let sum: f64 = product(one, other)
                        .iter()
                        .map(|(k, factor)| factor * function(*k, phase))
                        .sum();
                    let exact = function(one, phase) * function(other, phase);
                    assert!((sum - exact).abs() < 1e-14, "{one} {other}: {sum} {exact}");
                }
            }
        }
    }
}
