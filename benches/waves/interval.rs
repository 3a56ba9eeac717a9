//! The reduced model over an interval of speeds, as a Chebyshev series in the speed, and its eigenvalues.

use std::f64::consts::PI;

use faer::{Mat, Scale, c64};

use super::series::{MODEL, Series};
use super::vectors::{REAL, Vectors, damped_vectors, form, undamped_vectors};

/// Number of nodes of an interval.
pub const NODES: usize = 8;

/// An eigenvalue with its slope and the error that the next terms of the series in λ show.
#[derive(Debug, Clone, Copy)]
pub struct Root {
    /// λ, in 1/s.
    pub lambda: c64,
    /// dλ/dΩ.
    pub slope: c64,
    /// −yᴴ(λ³s₃ + λ⁴s₄)x / yᴴL′x, in 1/s.
    pub error: c64,
    /// Krein sign of an undamped wave, else 0.
    pub sign: i8,
}

/// The reduced model from one speed to another.
pub struct Interval {
    /// First and last speed, in rad/s.
    pub from: f64,
    /// Last speed, in rad/s.
    pub to: f64,
    /// Number of unknowns.
    pub size: usize,
    /// Number of those that are displacements of strong dampers.
    pub strong: usize,
    window: f64,
    /// Whether nothing damps.
    pub is_conservative: bool,
    /// By power of λ, then by degree.
    terms: Vec<Vec<Mat<f64>>>,
}

impl Interval {
    /// A model of `size` unknowns from its values at any speed.
    pub fn of(
        reduced: &dyn Fn(f64) -> Series,
        (from, to): (f64, f64),
        (size, nodes): (usize, usize),
        window: f64,
        kept: usize,
    ) -> Self {
        let angle = |k: usize| PI * (k as f64 + 0.5) / nodes as f64;
        let at_nodes: Vec<_> = (0..nodes)
            .map(|k| reduced(0.5 * (from + to) + 0.5 * (to - from) * angle(k).cos()))
            .collect();
        let coefficient = |power: usize, degree: usize| {
            let share = if degree == 0 { 1.0 } else { 2.0 } / nodes as f64;
            let mut sum = Mat::zeros(size, size);
            for (k, series) in at_nodes.iter().enumerate() {
                if let Some(term) = series.term(power) {
                    sum += Scale(share * (degree as f64 * angle(k)).cos()) * term;
                }
            }
            sum
        };
        let terms = (0..kept)
            .map(|power| {
                (0..nodes)
                    .map(|degree| coefficient(power, degree))
                    .collect()
            })
            .collect();
        Interval {
            from,
            to,
            size,
            strong: 0,
            window,
            is_conservative: false,
            terms,
        }
    }

    /// The parts that do not act on one another: saws with equal pads have several. Entries below `negligible` in all
    /// terms are zero.
    pub fn parts(&self, negligible: f64) -> Vec<Interval> {
        let size = self.size;
        let mut part: Vec<usize> = (0..size).collect();
        let all = self.terms.iter().flatten();
        let coupled = |i: usize, k: usize| {
            let mut entries = all.clone().map(|m| m[(i, k)].abs().max(m[(k, i)].abs()));
            entries.any(|entry| entry > negligible)
        };
        for i in 0..size {
            for k in 0..i {
                if part[i] != part[k] && coupled(i, k) {
                    let (from, to) = (part[i], part[k]);
                    part.iter_mut()
                        .filter(|p| **p == from)
                        .for_each(|p| *p = to);
                }
            }
        }
        let mut names = part.clone();
        names.sort_unstable();
        names.dedup();
        let of = |name: &usize| {
            let kept: Vec<usize> = (0..size).filter(|k| part[*k] == *name).collect();
            let cut =
                |m: &Mat<f64>| Mat::from_fn(kept.len(), kept.len(), |i, k| m[(kept[i], kept[k])]);
            let terms = self.terms.iter().map(|term| term.iter().map(cut).collect());
            Interval {
                size: kept.len(),
                terms: terms.collect(),
                ..*self
            }
        };
        names.iter().map(of).collect()
    }

    /// Last coefficient of K̃ relative to the first: the error of the series.
    pub fn tail(&self) -> f64 {
        let size = |m: &Mat<f64>| m.norm_max();
        (0..3)
            .map(|p| self.terms[p].last().map_or(0.0, size) / size(&self.terms[p][0]).max(1.0))
            .fold(0.0, f64::max)
    }

    /// L₀, L₁, … at a speed, and their derivatives by speed.
    pub fn at(&self, speed: f64) -> (Vec<Mat<f64>>, Vec<Mat<f64>>) {
        let half = 0.5 * (self.to - self.from);
        let x = ((speed - 0.5 * (self.from + self.to)) / half).clamp(-1.0, 1.0);
        let (mut value, mut slope) = (vec![1.0, x], vec![0.0, 1.0]);
        for k in 2..self.terms[0].len() {
            value.push(2.0 * x * value[k - 1] - value[k - 2]);
            slope.push(2.0 * value[k - 1] + 2.0 * x * slope[k - 1] - slope[k - 2]);
        }
        let sum = |weights: &[f64], unit: f64| -> Vec<Mat<f64>> {
            let of = |series: &Vec<Mat<f64>>| {
                let mut sum = Mat::zeros(self.size, self.size);
                for (term, weight) in series.iter().zip(weights) {
                    sum += Scale(weight * unit) * term;
                }
                sum
            };
            self.terms.iter().map(of).collect()
        };
        (sum(&value, 1.0), sum(&slope, half.recip()))
    }

    /// The series in λ at a speed.
    pub fn series(&self, speed: f64) -> Series {
        let mut series = Series::default();
        for (into, term) in series.0.iter_mut().zip(self.at(speed).0) {
            *into = Some(term);
        }
        series
    }

    /// All eigenvalues at a speed with Im λ ≥ 0 and |λ| < `reach`, in 1/s.
    pub fn roots(&self, speed: f64, reach: f64) -> Vec<Root> {
        let (terms, slopes) = self.at(speed);
        let pairs = match self.is_conservative {
            true => undamped_vectors(&terms, reach / self.window),
            false => damped_vectors(&terms, reach / self.window),
        };
        let root = |Vectors { mu, left, right }: &Vectors| {
            let form = |matrix: &Mat<f64>| form(left, matrix, right);
            let by_root = form(&terms[1]) + 2.0 * mu * form(&terms[2]);
            let moved = form(&slopes[0]) + mu * form(&slopes[1]) + mu * mu * form(&slopes[2]);
            let mut error = c64::new(0.0, 0.0);
            for (power, term) in terms.iter().enumerate().skip(MODEL) {
                error -= mu.powi(power as i32) * form(term) / by_root;
            }
            // xᴴ(−iL′)x, where an undamped wave has x as its left vector too.
            let is_wave = self.is_conservative && mu.re.abs() <= REAL * (mu.norm() + 1e-3);
            let sign = match is_wave {
                true if (c64::new(0.0, -1.0) * by_root).re > 0.0 => 1,
                true => -1,
                false => 0,
            };
            Root {
                lambda: mu * self.window,
                slope: -moved / by_root * self.window,
                error: error * self.window,
                sign,
            }
        };
        pairs.iter().map(root).collect()
    }
}
