//! Few vectors that span the low modes over a whole range of speeds.

use std::sync::atomic::Ordering;

use faer::{Col, Mat, Side, c64};

use crate::plate::Plate;
use crate::system::{GyroscopicSystem, body_frame_stiffness};

use super::mode::{DynamicStiffness, ModeKind, classify, split};
use super::model::{NamedCriticalSpeed, WorkCounters, frequency_scale, lift};
use super::{companion_eigenpairs, lowest_eigenpairs};

/// An orthonormal basis and what it is good for.
pub struct Reduction {
    /// N × r.
    pub basis: Mat<f64>,
    /// Frequency up to which every mode is represented.
    pub complete_to_rad_per_s: f64,
}

/// Modes a chart shows at the lowest speed.
const CHART_MODES: usize = 12;
/// Radial modes of one harmonic that are kept; the fourth is ten times above a chart.
const RADIAL_MODES: usize = 4;
/// Vectors closer than this to the span of the others are left out. Eigenvalues of
/// a projected symmetric problem are off by the square of it.
const SPAN_TOLERANCE: f64 = 1e-6;
/// Largest estimated error of a projected frequency, relative to the chart's height.
const FREQUENCY_TOLERANCE: f64 = 1e-9;
/// A reflected wave may meet modes up to this multiple of the highest one's frequency.
const REFLECTED_MARGIN: f64 = 1.3;
/// Modes up to this multiple of the window go into the basis: those that dip into it between snapshots.
const SNAPSHOT_MARGIN: f64 = 1.5;
/// Speeds at which modes of the whole basis are computed, at most.
const MAX_SNAPSHOTS: usize = 33;

/// Lowest body-frame modes of one harmonic at three speeds, for cos and sin alike.
/// On these the undamped free blade is exact.
pub fn of_harmonic(plate: &Plate, n: usize, range: (f64, f64)) -> Reduction {
    let block = &plate.harmonics[n];
    let size = block.bending.nrows();
    // The rigid motion is decoupled to the last bit; it stays a vector of its own.
    let rigid = usize::from(plate.basis.has_rigid_motions() && n <= 1);
    let mut vectors = Vec::new();
    for speed in [range.0, 0.5 * (range.0 + range.1), range.1] {
        let stiffness = body_frame_stiffness(block, speed);
        let elastic = stiffness.get(rigid.., rigid..).to_owned();
        let shift = frequency_scale(plate).powi(2);
        for mode in lowest_symmetric(elastic, shift, RADIAL_MODES.min(size - rigid)) {
            let column = Col::from_fn(size, |i| if i < rigid { 0.0 } else { mode[i - rigid] });
            vectors.push(column);
        }
    }
    let elastic = orthonormal(size, &vectors);
    let radial = Mat::from_fn(size, rigid + elastic.ncols(), |i, k| {
        match k.checked_sub(rigid) {
            Some(k) => {
                if i < rigid {
                    0.0
                } else {
                    elastic[(i, k)]
                }
            }
            None => f64::from(u8::from(i == k)),
        }
    });
    let phases = if n == 0 { 1 } else { 2 };
    let width = radial.ncols();
    let basis = Mat::from_fn(size * phases, width * phases, |i, k| {
        if i / size == k / width {
            radial[(i % size, k % width)]
        } else {
            0.0
        }
    });
    Reduction {
        basis,
        complete_to_rad_per_s: f64::INFINITY,
    }
}

/// Eigenvectors of the smallest eigenvalues of A, from the inverse of A + shift:
/// its Cholesky factor keeps the low modes accurate to their own size, where the
/// rounding of a direct solver is relative to the largest eigenvalue.
fn lowest_symmetric(mut matrix: Mat<f64>, shift: f64, count: usize) -> Vec<Col<f64>> {
    let size = matrix.nrows();
    for i in 0..size {
        matrix[(i, i)] += shift;
    }
    let Ok(factor) = matrix.llt(Side::Lower) else {
        return (0..size)
            .map(|k| Col::from_fn(size, |i| f64::from(u8::from(i == k))))
            .collect();
    };
    let mut inverse = Mat::<f64>::identity(size, size);
    faer::linalg::solvers::Solve::solve_in_place(&factor, &mut inverse);
    match inverse.self_adjoint_eigen(Side::Lower) {
        Ok(eigen) => (0..count)
            .map(|k| eigen.U().col(size - 1 - k).to_owned())
            .collect(),
        Err(_) => Vec::new(),
    }
}

/// Projections of a guided blade: one for the chart, and a smaller one for the
/// search for bands, which needs the reflected waves and what they can meet, no more.
pub struct GuidedReductions {
    /// Every mode up to the height of the chart.
    pub chart: Reduction,
    /// Every mode up to a little above the highest reflected wave, if there is one.
    pub low: Option<Reduction>,
}

/// Modes of the guided blade at a few speeds, more of them until every mode up to
/// the chart's height, and every reflected one, is right in between too.
pub fn of_guided(
    system: &GyroscopicSystem,
    range: (f64, f64),
    scale: f64,
    critical: &[NamedCriticalSpeed],
    counters: &WorkCounters,
) -> GuidedReductions {
    let mut builder = Builder {
        system,
        range,
        scale,
        critical,
        counters,
        snapshots: Vec::new(),
    };
    let reflected = builder.reflected_height(range.1);
    let window = builder.chart_height(range.0).max(reflected);
    for k in 0..5 {
        builder.add_snapshot(range.0 + (range.1 - range.0) * f64::from(k) / 4.0, window);
    }
    GuidedReductions {
        chart: builder.resolve(window, window),
        low: (reflected > 0.0).then(|| builder.resolve(reflected, window)),
    }
}

/// Low modes of the whole system at one speed.
struct Snapshot {
    speed: f64,
    pairs: Vec<super::dense::Eigenpair>,
}

struct Builder<'a> {
    system: &'a GyroscopicSystem,
    range: (f64, f64),
    scale: f64,
    critical: &'a [NamedCriticalSpeed],
    counters: &'a WorkCounters,
    snapshots: Vec<Snapshot>,
}

impl Builder<'_> {
    fn lowest(&self, speed: f64, count: usize) -> Vec<super::dense::Eigenpair> {
        self.counters.full_solves.fetch_add(1, Ordering::Relaxed);
        lowest_eigenpairs(self.system, speed, count, 0.5 * self.scale)
    }

    fn chart_height(&self, speed: f64) -> f64 {
        let pairs = self.lowest(speed, CHART_MODES + 2);
        let frequencies: Vec<f64> = pairs.iter().map(|(lambda, _)| lambda.im).collect();
        1.02 * frequencies
            .get(CHART_MODES - 1)
            .or(frequencies.last())
            .copied()
            .unwrap_or(self.scale)
    }

    /// Highest reflected wave at the top speed, with a margin for what it may meet.
    fn reflected_height(&self, speed: f64) -> f64 {
        let index = self.critical.partition_point(|c| c.speed_rad_per_s < speed);
        if index == 0 || !self.system.is_conservative() {
            return 0.0;
        }
        let mut count = CHART_MODES + index;
        loop {
            let pairs = self.lowest(speed, count);
            let modes = classify(self.system, speed, 0, None, pairs);
            let negative = |kind| match kind {
                ModeKind::Negative | ModeKind::Flutter => 2,
                ModeKind::Divergent => 1,
                _ => 0,
            };
            let found: usize = modes.iter().map(|mode| negative(mode.kind)).sum();
            if found >= index || 2 * count >= self.system.order() {
                let highest = modes.iter().filter(|mode| negative(mode.kind) > 0);
                let height = highest.fold(0.0, |top, mode| mode.frequency_rad_per_s().max(top));
                return REFLECTED_MARGIN * height.max(0.1 * self.scale);
            }
            count *= 2;
        }
    }

    /// Every mode below the window at one speed, and one above it.
    fn add_snapshot(&mut self, speed: f64, window: f64) {
        let mut count = CHART_MODES + 2;
        let pairs = loop {
            let pairs = self.lowest(speed, count);
            let covered = pairs
                .last()
                .is_some_and(|(lambda, _)| lambda.norm() > window);
            if covered || 2 * count >= self.system.order() {
                break pairs;
            }
            count += count / 2;
        };
        let place = self.snapshots.partition_point(|s| s.speed < speed);
        self.snapshots.insert(place, Snapshot { speed, pairs });
    }

    /// The modes up to a window at every snapshot so far. With the standing waves
    /// themselves in it the projected K(Ω) is singular at the same speeds as the
    /// whole one, to the last digit.
    fn basis(&self, window: f64) -> Mat<f64> {
        let standing = self
            .critical
            .iter()
            .take_while(|c| c.speed_rad_per_s <= self.range.1);
        let mut vectors: Vec<Col<f64>> = standing.map(|c| c.shape.clone()).collect();
        for (lambda, q) in self.snapshots.iter().flat_map(|s| &s.pairs) {
            if lambda.norm() <= window {
                let (re, im) = split(q);
                vectors.push(re);
                vectors.push(im);
            }
        }
        orthonormal(self.system.order(), &vectors)
    }

    /// Adds snapshots until every mode up to the window is right between them too.
    fn resolve(&mut self, window: f64, chart: f64) -> Reduction {
        loop {
            let basis = self.basis(SNAPSHOT_MARGIN * window);
            let unresolved = self.unresolved(&basis, window, FREQUENCY_TOLERANCE * chart);
            if unresolved.is_empty() || self.snapshots.len() >= MAX_SNAPSHOTS {
                return Reduction {
                    basis,
                    complete_to_rad_per_s: window,
                };
            }
            for speed in unresolved {
                self.add_snapshot(speed, chart);
            }
        }
    }

    /// Midpoints between snapshots at which some mode is not right yet.
    fn unresolved(&self, basis: &Mat<f64>, window: f64, tolerance: f64) -> Vec<f64> {
        let reduced = self.system.project(basis.as_ref());
        let middles = self
            .snapshots
            .windows(2)
            .map(|pair| 0.5 * (pair[0].speed + pair[1].speed));
        middles
            .filter(|&speed| self.frequency_error(&reduced, basis, speed, window) > tolerance)
            .collect()
    }

    /// Largest |rᴴ P⁻¹ r| / |qᴴ(2ω − 2iΩG)q| over the modes below the window, r the
    /// residual on the whole basis: the second-order shift of a simple frequency. P, the
    /// diagonal of K₀, stands for L, for r lives in the high functions, which stiffness rules.
    fn frequency_error(
        &self,
        reduced: &GyroscopicSystem,
        basis: &Mat<f64>,
        speed: f64,
        window: f64,
    ) -> f64 {
        self.counters.reduced_solves.fetch_add(1, Ordering::Relaxed);
        let Ok(pairs) = companion_eigenpairs(reduced, speed) else {
            return f64::INFINITY;
        };
        let dynamic = DynamicStiffness::new(self.system, speed);
        pairs
            .iter()
            .filter(|(lambda, _)| lambda.im <= window && lambda.re >= -1e-6 * window)
            .map(|(lambda, q)| {
                let lifted = lift(basis.as_ref(), q);
                let residual: Col<c64> = dynamic.residual(*lambda, &lifted);
                let shift: f64 = (0..residual.nrows())
                    .map(|i| {
                        residual[i].norm_sqr() / (self.system.stiffness[(i, i)] + window.powi(2))
                    })
                    .sum();
                shift / window
            })
            .fold(0.0, f64::max)
    }
}

/// Orthonormal basis of the span, by QR with column pivoting.
fn orthonormal(rows: usize, vectors: &[Col<f64>]) -> Mat<f64> {
    let matrix = Mat::from_fn(rows, vectors.len(), |i, k| vectors[k][i]);
    let qr = matrix.col_piv_qr();
    let rank = (0..rows.min(vectors.len()))
        .take_while(|&k| qr.thin_R()[(k, k)].abs() > SPAN_TOLERANCE)
        .count();
    qr.compute_thin_Q().subcols(0, rank).to_owned()
}
