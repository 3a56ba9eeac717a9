//! The reduced model over an interval of speeds, as a Chebyshev series in the speed.

use std::f64::consts::PI;

use faer::Mat;
use rayon::prelude::*;

use crate::model::scene::SpeedRange;
use crate::model::system::GyroscopicSystem;
use crate::modes::connected_parts::connected_parts;
use crate::modes::error::SpectrumError;
use crate::modes::work::Cancellation;

/// Number of nodes of the series: with 10 its error is up to 2e-8 of the window on drawn saws up to 1.9 times the lowest critical
/// speed, with 12 up to 2e-10.
const NODES: usize = 12;
/// Share of half the range by which a speed may lie beyond an end, for iterations that end at it: there the error of the series is
/// T₁₁(1.01) = 2.4 times that at the end. Further beyond, it grows without limit.
const BEYOND: f64 = 0.01;
/// Entries below this in every term do not couple two components, in units of the window.
const UNCOUPLED: f64 = 1e-9;

/// Angle whose cosine is a node.
fn angle(node: usize) -> f64 {
    PI * (node as f64 + 0.5) / NODES as f64
}

/// Values of a function at the nodes of a range of speeds, which are numbered from its end.
///
/// # Errors
/// [`SpectrumError::Cancelled`], and the errors of the function.
pub fn at_nodes<T: Send>(
    range: SpeedRange,
    at: impl Fn(usize, f64) -> Result<T, SpectrumError> + Sync,
) -> Result<Vec<T>, SpectrumError> {
    let [from, to] = range.ends();
    let cancellation = Cancellation::current();
    let of_node = |k: usize| {
        cancellation.check()?;
        at(k, 0.5 * (from + to) + 0.5 * (to - from) * angle(k).cos())
    };
    (0..NODES).into_par_iter().map(of_node).collect()
}

/// The reduced model from one speed to another.
#[derive(Debug)]
pub struct WaveModel {
    /// First and last speed, in rad/s.
    range: SpeedRange,
    /// Number of nodal diameters of each unknown; `None` for the displacement of a damper.
    diameters: Vec<Option<usize>>,
    /// Top of the window, in 1/s: the unit of λ.
    pub(super) window: f64,
    /// Number of free rigid motions, each with λ = 0 at most twice.
    pub(super) rigid: usize,
    /// Whether nothing damps: L(λ)ᴴ = L(−λ̄).
    pub(super) is_conservative: bool,
    /// Number of terms L₀, L₁, ….
    terms: usize,
    /// Their entries, one matrix after another, by degree.
    coefficients: Mat<f64>,
}

impl WaveModel {
    /// A model from its terms L₀, L₁, … side by side at the nodes, see [`at_nodes`], in units of the window.
    pub(super) fn of(
        terms_at: &[Mat<f64>],
        range: SpeedRange,
        diameters: Vec<Option<usize>>,
        window: f64,
        full: &GyroscopicSystem,
    ) -> Self {
        let size = diameters.len();
        let columns = terms_at.first().map_or(0, Mat::ncols);
        let values = Mat::from_fn(size * columns, NODES, |row, node| {
            terms_at[node][(row % size, row / size)]
        });
        let weights = Mat::from_fn(NODES, NODES, |node, degree| {
            let share = if degree == 0 { 1.0 } else { 2.0 } / NODES as f64;
            share * (degree as f64 * angle(node)).cos()
        });
        WaveModel {
            range,
            diameters,
            window,
            rigid: full.free_rigid.len(),
            is_conservative: full.is_conservative(),
            terms: columns.checked_div(size).unwrap_or(0),
            coefficients: values * weights,
        }
    }

    /// Number of unknowns.
    pub fn size(&self) -> usize {
        self.diameters.len()
    }

    /// First and last speed, in rad/s.
    pub fn range_rad_per_s(&self) -> SpeedRange {
        self.range
    }

    /// The parts, which do not act on one another, with the places of their unknowns: a free blade has one for each number of nodal
    /// diameters, and saws with equal pads have several.
    pub fn parts(&self) -> Vec<(Vec<usize>, WaveModel)> {
        let size = self.size();
        let are_coupled = |[i, k]: &[usize; 2]| {
            let mut entries = (0..self.terms)
                .flat_map(|power| [self.row(power, *i, *k), self.row(power, *k, *i)]);
            entries.any(|row| self.coefficients.row(row).norm_max() > UNCOUPLED)
        };
        let pairs = (0..size).flat_map(|i| (0..i).map(move |k| [i, k]));
        let of = |kept: Vec<usize>| {
            let count = kept.len();
            let coefficients = Mat::from_fn(self.terms * count * count, NODES, |row, degree| {
                let (power, entry) = (row / (count * count), row % (count * count));
                let [i, k] = [entry % count, entry / count].map(|place| kept[place]);
                self.coefficients[(self.row(power, i, k), degree)]
            });
            let diameters: Vec<Option<usize>> = kept.iter().map(|k| self.diameters[*k]).collect();
            // Rigid motions are heave and tilts. No other component has them, but at a critical speed it has λ = 0.
            let is_held = diameters.iter().flatten().all(|n| *n > 1);
            let model = WaveModel {
                diameters,
                rigid: if is_held { 0 } else { self.rigid },
                coefficients,
                ..*self
            };
            (kept, model)
        };
        let parts = connected_parts(size, pairs.filter(are_coupled)).into_iter();
        parts.map(of).collect()
    }

    /// The model projected on orthonormal columns.
    #[cfg(test)]
    pub(super) fn projected(&self, basis: faer::MatRef<'_, f64>) -> WaveModel {
        let size = basis.ncols();
        let mut coefficients = Mat::zeros(self.terms * size * size, NODES);
        for degree in 0..NODES {
            for power in 0..self.terms {
                let term = Mat::from_fn(self.size(), self.size(), |i, k| {
                    self.coefficients[(self.row(power, i, k), degree)]
                });
                let inner = basis.transpose() * term * basis;
                for k in 0..size {
                    for i in 0..size {
                        coefficients[((power * size + k) * size + i, degree)] = inner[(i, k)];
                    }
                }
            }
        }
        WaveModel {
            diameters: vec![None; size],
            coefficients,
            ..*self
        }
    }

    /// Index of an entry of the coefficient of a power of λ.
    fn row(&self, power: usize, i: usize, k: usize) -> usize {
        (power * self.size() + k) * self.size() + i
    }

    /// Largest coefficient of the highest degree, which is the error of the series in the speed, in units of the window.
    pub fn tail(&self) -> f64 {
        self.coefficients.col(NODES - 1).norm_max()
    }

    /// Entries of L₀, L₁, … at a speed, one matrix after another, and in a second column their derivatives with respect to
    /// the speed. `None` beside the range, where the series is not the model.
    pub(super) fn sums(&self, speed_rad_per_s: f64) -> Option<Mat<f64>> {
        let [from, to] = self.range.ends();
        let half = (0.5 * (to - from)).max(f64::MIN_POSITIVE);
        let x = (speed_rad_per_s - 0.5 * (from + to)) / half;
        if x.abs() > 1.0 + BEYOND {
            return None;
        }
        let (mut value, mut slope) = (vec![1.0, x], vec![0.0, 1.0]);
        for k in 2..NODES {
            value.push(2.0 * x * value[k - 1] - value[k - 2]);
            slope.push(2.0 * value[k - 1] + 2.0 * x * slope[k - 1] - slope[k - 2]);
        }
        let weights = Mat::from_fn(NODES, 2, |degree, k| {
            [value[degree], slope[degree] / half][k]
        });
        Some(&self.coefficients * weights)
    }
}
