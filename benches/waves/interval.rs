//! The reduced model over an interval of speeds, as a Chebyshev series in the speed, and its eigenvalues.

use std::f64::consts::PI;

use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{ComputeEigenvectors, EvdParams, evd_real, evd_scratch};
use faer::linalg::solvers::Solve;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Auto, Mat, MatRef, Par, Scale, Spec, c64};

use sawflutter::spectrum::undamped_eigenpairs;
use sawflutter::system::GyroscopicSystem;

use super::series::{MODEL, Series};

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

    /// Least eigenvalue of the symmetric part of M̃ at a speed.
    pub fn least_inertia(&self, speed: f64) -> f64 {
        let (terms, _) = self.at(speed);
        let symmetric = Scale(0.5) * (&terms[2] + terms[2].transpose());
        let values = symmetric.self_adjoint_eigenvalues(faer::Side::Lower);
        values.map_or(f64::NAN, |v| v.first().copied().unwrap_or(f64::NAN))
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

impl Interval {
    /// Eigenvalues up to `reach` with their first-order change −yᴴ(L₊ − L)x / yᴴL′x to those of a model in the same
    /// unknowns.
    pub fn changes(&self, other: &Interval, speed: f64, reach: f64) -> Vec<(c64, c64)> {
        let ((own, _), (theirs, _)) = (self.at(speed), other.at(speed));
        let change = |v: &Vectors| {
            let mut rest = c64::new(0.0, 0.0);
            let mut power = c64::new(1.0, 0.0);
            for (x, y) in own.iter().zip(&theirs).take(MODEL) {
                rest += power * form(&v.left, &(y - x), &v.right);
                power *= v.mu;
            }
            let by_root =
                form(&v.left, &own[1], &v.right) + 2.0 * v.mu * form(&v.left, &own[2], &v.right);
            (v.mu * self.window, -rest / by_root * self.window)
        };
        let pairs = match self.is_conservative {
            true => undamped_vectors(&own, reach / self.window),
            false => damped_vectors(&own, reach / self.window),
        };
        pairs.iter().map(change).collect()
    }
}

/// Share of |λ| below which a part is rounding of an undamped wave.
pub const REAL: f64 = 1e-8;

/// An eigenvalue in units of the window with its vectors.
struct Vectors {
    mu: c64,
    left: Vec<c64>,
    right: Vec<c64>,
}

fn column(matrix: &Mat<f64>, k: usize) -> &[f64] {
    let column = matrix.as_ref().col(k).try_as_col_major();
    column.map_or(&[], |column| column.as_slice())
}

/// yᴴ X x.
fn form(left: &[c64], matrix: &Mat<f64>, right: &[c64]) -> c64 {
    let mut sum = c64::new(0.0, 0.0);
    for (k, x) in right.iter().enumerate() {
        let (mut re, mut im) = (0.0, 0.0);
        for (y, entry) in left.iter().zip(column(matrix, k)) {
            re += y.re * entry;
            im -= y.im * entry;
        }
        sum += c64::new(re, im) * x;
    }
    sum
}

/// Of an undamped saw: K̃ symmetric, C̃ skew, M̃ = RRᵀ, so that R⁻¹K̃R⁻ᵀ and R⁻¹C̃R⁻ᵀ are a system with the mass 1, whose
/// eigenvalues follow from a problem of half the order. The left vector of λ is the right one of −λ*.
fn undamped_vectors(terms: &[Mat<f64>], reach: f64) -> Vec<Vectors> {
    let size = terms[0].nrows();
    let inertia = Scale(0.5) * (&terms[2] + terms[2].transpose());
    let factor = inertia
        .llt(faer::Side::Lower)
        .expect("positive inertia")
        .L()
        .to_owned();
    let both_sides = |matrix: &Mat<f64>| {
        let mut half = matrix.clone();
        solve_lower_triangular_in_place(factor.as_ref(), half.as_mut(), Par::Seq);
        let mut half = half.transpose().to_owned();
        solve_lower_triangular_in_place(factor.as_ref(), half.as_mut(), Par::Seq);
        half.transpose().to_owned()
    };
    let (stiffness, velocity) = (both_sides(&terms[0]), both_sides(&terms[1]));
    let symmetric = Scale(0.5) * (&stiffness + stiffness.transpose());
    let skew = Scale(0.25) * (&velocity - velocity.transpose());
    let system = GyroscopicSystem {
        stiffness: symmetric,
        spin: Mat::zeros(size, size),
        gyroscopic: skew,
        damping: None,
        circulatory: None,
        nonconservative: None,
        free_rigid: Vec::new(),
        drift: None,
    };
    let pairs = undamped_eigenpairs(&system, 1.0).expect("converges");
    let kept: Vec<_> = pairs
        .into_iter()
        .filter(|(mu, _)| mu.norm() < reach)
        .collect();
    let mut shapes = Mat::from_fn(size, 2 * kept.len(), |i, k| {
        let entry = kept[k / 2].1[i];
        if k % 2 == 0 { entry.re } else { entry.im }
    });
    solve_upper_triangular_in_place(factor.transpose(), shapes.as_mut(), Par::Seq);
    let shape = |k: usize| -> Vec<c64> {
        (0..size)
            .map(|i| c64::new(shapes[(i, 2 * k)], shapes[(i, 2 * k + 1)]))
            .collect()
    };
    let partner = |mu: c64| {
        let off = |k: &usize| (kept[*k].0 + mu.conj()).norm();
        (0..kept.len()).min_by(|x, y| off(x).total_cmp(&off(y)))
    };
    let vectors = |k: usize| {
        let mu = kept[k].0;
        let is_wave = mu.re.abs() <= REAL * (mu.norm() + 1e-3);
        let left = if is_wave { k } else { partner(mu).unwrap_or(k) };
        Vectors {
            mu,
            left: shape(left),
            right: shape(k),
        }
    };
    (0..kept.len()).map(vectors).collect()
}

/// By the companion matrix. The lower half of its left vector times M̃⁻¹ is the left vector of L.
fn damped_vectors(terms: &[Mat<f64>], reach: f64) -> Vec<Vectors> {
    let size = terms[0].nrows();
    let inertia = terms[2].partial_piv_lu();
    let (mut stiffness, mut velocity) = (terms[0].clone(), terms[1].clone());
    inertia.solve_in_place(&mut stiffness);
    inertia.solve_in_place(&mut velocity);
    let companion = Mat::from_fn(2 * size, 2 * size, |i, k| match (i < size, k < size) {
        (true, true) => 0.0,
        (true, false) => f64::from(u8::from(i + size == k)),
        (false, true) => -stiffness[(i - size, k)],
        (false, false) => -velocity[(i - size, k - size)],
    });
    let eigen = TwoSided::new(companion.as_ref());
    let kept: Vec<usize> = (0..2 * size)
        .filter(|k| eigen.values[*k].im >= 0.0 && eigen.values[*k].norm() < reach)
        .collect();
    let lower: Vec<Vec<c64>> = kept
        .iter()
        .map(|k| eigen.vector(&eigen.left, *k, size, size))
        .collect();
    let mut left = Mat::from_fn(size, 2 * kept.len(), |i, k| {
        let entry = lower[k / 2][i];
        if k % 2 == 0 { entry.re } else { entry.im }
    });
    inertia.solve_transpose_in_place(&mut left);
    let vectors = |(k, place): (usize, &usize)| Vectors {
        mu: eigen.values[*place],
        left: (0..size)
            .map(|i| c64::new(left[(i, 2 * k)], left[(i, 2 * k + 1)]))
            .collect(),
        right: eigen.vector(&eigen.right, *place, 0, size),
    };
    kept.iter().enumerate().map(vectors).collect()
}

/// Eigenvalues with left and right vectors.
struct TwoSided {
    values: Vec<c64>,
    left: Mat<f64>,
    right: Mat<f64>,
}

impl TwoSided {
    fn new(matrix: MatRef<'_, f64>) -> Self {
        let order = matrix.nrows();
        let mut params = <EvdParams as Auto<f64>>::auto();
        params.schur.blocking_threshold = usize::MAX;
        let yes = ComputeEigenvectors::Yes;
        let scratch = evd_scratch::<f64>(order, yes, yes, Par::Seq, Spec::from(params));
        let (mut re, mut im) = (Diag::zeros(order), Diag::zeros(order));
        let (mut left, mut right) = (Mat::zeros(order, order), Mat::zeros(order, order));
        evd_real(
            matrix,
            re.as_mut(),
            im.as_mut(),
            Some(left.as_mut()),
            Some(right.as_mut()),
            Par::Seq,
            MemStack::new(&mut MemBuffer::new(scratch)),
            Spec::from(params),
        )
        .expect("converges");
        TwoSided {
            values: (0..order).map(|i| c64::new(re[i], im[i])).collect(),
            left,
            right,
        }
    }

    /// Rows `first` to `first + count` of a vector of an eigenvalue with Im λ ≥ 0.
    fn vector(&self, columns: &Mat<f64>, k: usize, first: usize, count: usize) -> Vec<c64> {
        let im = |i: usize| match self.values[k].im > 0.0 {
            true => columns[(i, k + 1)],
            false => 0.0,
        };
        (first..first + count)
            .map(|i| c64::new(columns[(i, k)], im(i)))
            .collect()
    }
}
