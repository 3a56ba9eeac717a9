//! All eigenvalues of the reduced model within the reach at once, as an invariant pair.
//!
//! The quadratic problem K̃ + λC̃ + λ²M̃ has the companion matrix A of the states (x, λx). With all its vectors,
//! A [V V′] = [V V′] diag(B₀, B′), where V are the p states with eigenvalues within the reach, [W; W′] = [V V′]⁻¹, and X, X′
//! the upper halves of V, V′. The pair (X + X′Z, B) with
//!
//! B = B₀ − Y R,  B′Z − ZB = Y′R,  R = Σ_{k≥3} s_k (X + X′Z) Bᵏ,  W = [·, Y M̃],  W′ = [·, Y′M̃]
//!
//! then solves Σ L_k X Bᵏ = 0 with all terms (T. Betcke and D. Kressner, *Perturbation, extraction and refinement of invariant
//! pairs for matrix polynomials*, Linear Algebra Appl. 435, 2011). In contrast to a correction of one eigenvalue after the
//! other this also holds where two of them coalesce.

use faer::linalg::solvers::Solve;
use faer::{Mat, c64};

use crate::model::linalg::{LinalgError, RealEigen};

/// |λ| in windows between which the widest gap ends the pair: beyond it the series in λ is inaccurate, and an eigenvalue next to
/// the end slows the iteration.
pub(super) const END: [f64; 2] = [1.2, 1.8];
/// Change of B in the last step, in windows. The rounding of A is larger where it is not normal.
const SETTLED: f64 = 1e-13;
/// Number of terms of the quadratic problem.
const QUADRATIC: usize = 3;
/// Largest number of steps; each leaves a tenth of the error.
const STEPS: usize = 16;

/// The pair with its left vectors.
pub(super) struct Pair {
    /// Displacements X, m × p.
    pub x: Mat<f64>,
    /// Left vectors Y of the quadratic problem, p × m.
    pub y: Mat<f64>,
    /// B, p × p.
    pub b: Mat<f64>,
}

/// States of the quadratic problem.
struct States {
    /// X, m × p, real and imaginary parts of conjugates as two columns.
    x: Mat<f64>,
    /// Y, p × m.
    y: Mat<f64>,
    /// Eigenvalues, conjugates side by side, the one with Im λ > 0 first.
    values: Vec<c64>,
}

impl Pair {
    /// The pair of L₀, L₁, …; `None` without eigenvalues within the reach.
    pub fn new(terms: &[Mat<f64>]) -> Result<Option<Self>, LinalgError> {
        let (kept, others) = States::of(terms)?;
        if kept.values.is_empty() {
            return Ok(None);
        }
        let quadratic = diagonal(&kept.values);
        let (mut x, mut b) = (kept.x.clone(), quadratic.clone());
        let mut z = Mat::zeros(others.values.len(), b.ncols());
        for _ in 0..STEPS {
            let mut sum = Mat::zeros(x.nrows(), b.ncols());
            for term in terms[QUADRATIC..].iter().rev() {
                sum = sum * &b + term * &x;
            }
            let rest = sum * &b * &b * &b;
            let next = &quadratic - &kept.y * &rest;
            let change = (&next - &b).norm_max();
            // Z B = Z B₀ + Z (B − B₀), whose last part is small.
            let right = &others.y * rest + &z * (&next - &quadratic);
            z = divided(&right, &others.values, &kept.values);
            x = &kept.x + &others.x * &z;
            b = next;
            if change <= SETTLED {
                break;
            }
        }
        Ok(Some(Pair { x, y: kept.y, b }))
    }
}

impl States {
    /// The states within the reach and all others.
    fn of(terms: &[Mat<f64>]) -> Result<(Self, Self), LinalgError> {
        let size = terms[0].nrows();
        let inertia = terms[2].partial_piv_lu();
        let [stiffness, velocity] = [0, 1].map(|k| inertia.solve(&terms[k]));
        let companion = Mat::from_fn(2 * size, 2 * size, |i, k| match (i < size, k < size) {
            (true, true) => 0.0,
            (true, false) => f64::from(u8::from(i + size == k)),
            (false, true) => -stiffness[(i - size, k)],
            (false, false) => -velocity[(i - size, k - size)],
        });
        let eigen = RealEigen::new(companion.as_ref())?;
        let (right, left) = (columns(&eigen), inverse(&eigen));
        let of = |places: &[usize]| {
            let lower = Mat::from_fn(size, places.len(), |i, k| left[(places[k], size + i)]);
            States {
                x: Mat::from_fn(size, places.len(), |i, k| right[(i, places[k])]),
                y: inertia.solve_transpose(lower).transpose().to_owned(),
                values: places.iter().map(|i| eigen.values[*i]).collect(),
            }
        };
        let reach = reach(&eigen.values);
        let is_kept = |i: &usize| eigen.values[*i].norm() < reach;
        let (kept, others): (Vec<usize>, Vec<usize>) = (0..2 * size).partition(is_kept);
        Ok((of(&kept), of(&others)))
    }
}

/// Middle of the widest gap between magnitudes within [`END`].
fn reach(values: &[c64]) -> f64 {
    let mut sizes: Vec<f64> = values.iter().map(|value| value.norm()).collect();
    sizes.retain(|size| (END[0]..END[1]).contains(size));
    sizes.extend(END);
    sizes.sort_by(f64::total_cmp);
    let gaps = sizes.windows(2).map(|ends| [ends[1] - ends[0], ends[0]]);
    let widest = gaps.max_by(|x, y| x[0].total_cmp(&y[0]));
    widest.map_or(END[0], |[gap, from]| from + 0.5 * gap)
}

/// A (r, s) = (r, s) [a b; −b a] for the real and the imaginary part of the vector of a + ib.
fn diagonal(values: &[c64]) -> Mat<f64> {
    let mut b = Mat::zeros(values.len(), values.len());
    for (k, value) in values.iter().enumerate() {
        b[(k, k)] = value.re;
        if value.im > 0.0 {
            b[(k, k + 1)] = value.im;
        } else if value.im < 0.0 {
            b[(k, k - 1)] = value.im;
        }
    }
    b
}

/// Z with B′Z − ZB = F, where B′ and B are [`diagonal`] of these values.
fn divided(f: &Mat<f64>, rows: &[c64], columns: &[c64]) -> Mat<f64> {
    let mut z = Mat::zeros(rows.len(), columns.len());
    let width = |value: c64| if value.im == 0.0 { 1 } else { 2 };
    for (k, mu) in columns.iter().enumerate().filter(|(_, mu)| mu.im >= 0.0) {
        for (i, nu) in rows.iter().enumerate().filter(|(_, nu)| nu.im >= 0.0) {
            let size = (width(*nu), width(*mu));
            let at = |row: usize, column: usize| {
                if row < size.0 && column < size.1 {
                    f[(i + row, k + column)]
                } else {
                    0.0
                }
            };
            // (r − is) F (u + iv) and its mirror image are divided by ν − μ and ν̄ − μ.
            let (even, odd) = (at(0, 0) + at(1, 1), at(0, 1) - at(1, 0));
            let turned = c64::new(even, odd) / (nu - mu);
            let (even, odd) = (at(0, 0) - at(1, 1), at(0, 1) + at(1, 0));
            let mirrored = c64::new(even, odd) / (nu.conj() - mu);
            let (sum, difference) = (0.5 * (turned + mirrored), 0.5 * (mirrored - turned));
            let block = [[sum.re, sum.im], [difference.im, -difference.re]];
            for row in 0..size.0 {
                for column in 0..size.1 {
                    z[(i + row, k + column)] = block[row][column];
                }
            }
        }
    }
    z
}

/// Columns of all vectors: that of a real λ, the real and the imaginary part for a pair.
pub(super) fn columns(eigen: &RealEigen) -> Mat<f64> {
    let halves = eigen.halves_of(&eigen.upper());
    let mut place = Vec::new();
    for (k, i) in eigen.upper().into_iter().enumerate() {
        place.push(2 * k);
        if eigen.values[i].im > 0.0 {
            place.push(2 * k + 1);
        }
    }
    Mat::from_fn(halves.nrows(), place.len(), |i, k| halves[(i, place[k])])
}

/// Inverse of the columns of all vectors.
pub(super) fn inverse(eigen: &RealEigen) -> Mat<f64> {
    let columns = columns(eigen);
    let size = columns.nrows();
    columns
        .partial_piv_lu()
        .solve(Mat::<f64>::identity(size, size))
}
