//! All eigenpairs of a Hamiltonian matrix by an eigenproblem of half its order.
//!
//! A is Hamiltonian if JA is symmetric, J = [0 I; −I 0]; then A² is skew-Hamiltonian, each λ² is double, and
//! the Krylov vectors of A² are isotropic, vᵀJw = 0, so that n of them span an invariant subspace of a matrix
//! of order 2n that contains each λ² once: A²V = VH, VᵀV = I (C. Van Loan, Linear Algebra Appl. 61, 1984; V.
//! Mehrmann, D. Watkins, SIAM J. Sci. Comput. 22, 2001). For an eigenvector z of A², (A + λ)z is one of A for
//! λ. An eigenproblem takes 25 times the cube of its order, so this takes half the time of that of A. λ² is
//! accurate to ε‖A‖², as if K had been rounded.

use faer::{Col, Mat, MatRef, Scale, c64};

use super::companion::{companion_eigenpairs, time_scale};
use super::error::SpectrumError;
use super::vectors::{Eigenpair, by_magnitude, joined, unit};
use super::work::Cancellation;
use crate::model::linalg::{LinalgError, RealEigen};
use crate::model::system::GyroscopicSystem;

/// A vector whose part outside the span of the others is below this share is rounding.
const BREAKDOWN: f64 = 1e-14;
/// If this share of a vector remains after an orthogonalization, the vector is orthogonal to rounding.
const MOSTLY_KEPT: f64 = 0.5;

/// Eigenpairs with Im λ ≥ 0, ‖q‖ = 1, ordered by |λ|, of a Hamiltonian system: undamped, and without free
/// rigid motions, whose double zero cannot be distinguished from a single one in the square. Other systems
/// are solved by the companion matrix.
///
/// # Errors
/// The errors of [`companion_eigenpairs`].
pub fn eigenpairs(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
) -> Result<Vec<Eigenpair>, SpectrumError> {
    if !system.is_conservative() || !system.free_rigid.is_empty() {
        return companion_eigenpairs(system, speed_rad_per_s);
    }
    Cancellation::current().check()?;
    let (matrix, scale) = hamiltonian_matrix(
        &system.stiffness_at(speed_rad_per_s),
        &system.velocity_at(speed_rad_per_s),
    );
    let failed = SpectrumError::at(speed_rad_per_s);
    let Some(found) = hamiltonian_eigenpairs(matrix.as_ref()).map_err(failed)? else {
        return companion_eigenpairs(system, speed_rad_per_s);
    };
    let shapes = found.halves.subrows(0, system.order()).to_owned();
    let pairs = found
        .lambdas
        .into_iter()
        .enumerate()
        .map(|(k, lambda)| (lambda * scale, unit(joined(&shapes, k).as_ref())));
    Ok(by_magnitude(pairs.collect()))
}

/// A of (q, p/s), p = q̇ + Dq/2, in units of s, and the scale s, in 1/s, for q̈ + Dq̇ + Kq = 0 with a skew D.
pub fn hamiltonian_matrix(stiffness: &Mat<f64>, velocity: &Mat<f64>) -> (Mat<f64>, f64) {
    let scale = time_scale(stiffness);
    let turning = Scale(-0.5 / scale) * velocity;
    let force = &turning * &turning - Scale(scale.powi(-2)) * stiffness;
    let size = stiffness.nrows();
    let mut matrix = Mat::zeros(2 * size, 2 * size);
    matrix.get_mut(..size, ..size).copy_from(&turning);
    matrix.get_mut(size.., size..).copy_from(&turning);
    matrix.get_mut(size.., ..size).copy_from(&force);
    (0..size).for_each(|i| matrix[(i, size + i)] = 1.0);
    (matrix, scale)
}

/// Share of the norm of the square above which squares can be distinguished from zero and from one another.
/// Their rounding is 1e-15 of the norm, and the root of 1e-15 where two coalesce.
const LEAST_APART: f64 = 1e-8;

/// λ with Im λ ≥ 0, and the real and imaginary parts of their vectors side by side, two columns each.
pub struct UpperPairs {
    pub lambdas: Vec<c64>,
    pub halves: Mat<f64>,
}

/// Eigenpairs of a Hamiltonian matrix. `None` if squares λ² are close to zero or to one another, at critical
/// speeds and where waves coalesce, because there only the matrix itself determines its eigenvalues; also if
/// the computation was cancelled.
///
/// # Errors
/// [`LinalgError`] if the eigenproblem fails.
pub fn hamiltonian_eigenpairs(matrix: MatRef<'_, f64>) -> Result<Option<UpperPairs>, LinalgError> {
    let square = matrix * matrix;
    let Some((span, compressed)) = isotropic(&square) else {
        return Ok(None);
    };
    let eigen = RealEigen::new(compressed.as_ref())?;
    if !are_apart(&eigen.values, LEAST_APART * square.norm_l2()) {
        return Ok(None);
    }
    let all: Vec<usize> = (0..compressed.nrows()).collect();
    let of_square = &span * eigen.halves_of(&all);
    let turned = matrix * &of_square;
    let mut places = Vec::new();
    for (k, square) in eigen.values.iter().enumerate() {
        places.extend(upper_roots(*square).map(|lambda| (lambda, 2 * k)));
    }
    let rows = matrix.nrows();
    let halves = Mat::from_fn(rows, 2 * places.len(), |i, column| {
        let (lambda, k) = places[column / 2];
        let z = c64::new(of_square[(i, k)], of_square[(i, k + 1)]);
        let az = c64::new(turned[(i, k)], turned[(i, k + 1)]);
        let y = az + lambda * z;
        if column % 2 == 0 { y.re } else { y.im }
    });
    Ok(Some(UpperPairs {
        lambdas: places.into_iter().map(|(lambda, _)| lambda).collect(),
        halves,
    }))
}

/// Whether no square is nearer than `least` to zero or to another.
fn are_apart(squares: &[c64], least: f64) -> bool {
    squares.iter().enumerate().all(|(k, square)| {
        let mut above = squares[k + 1..].iter();
        square.norm() > least && above.all(|other| (square - other).norm() > least)
    })
}

/// Both roots of a positive λ²; of any other, the one with Im λ > 0.
fn upper_roots(square: c64) -> impl Iterator<Item = c64> {
    let roots = match square.im == 0.0 {
        true if square.re > 0.0 => {
            let root = c64::new(square.re.sqrt(), 0.0);
            [Some(root), Some(-root)]
        }
        true => [Some(c64::new(0.0, (-square.re).sqrt())), None],
        false => {
            let root = square.sqrt();
            [Some(if root.im > 0.0 { root } else { -root }), None]
        }
    };
    roots.into_iter().flatten()
}

/// V and H = VᵀWV of a skew-Hamiltonian matrix W. `None` if the computation was cancelled, because for a
/// large matrix this takes seconds.
fn isotropic(square: &Mat<f64>) -> Option<(Mat<f64>, Mat<f64>)> {
    let cancellation = Cancellation::current();
    let order = square.nrows();
    let half = order / 2;
    let mut span = Span::new(order);
    let mut compressed = Mat::<f64>::zeros(half, half);
    let mut next = scattered(order, 0);
    for k in 0..half {
        if cancellation.is_cancelled() {
            return None;
        }
        let (size, shares) = span.orthogonalize(&mut next);
        if let Some(last) = k.checked_sub(1) {
            add(&shares, &mut compressed, last);
            if size > 0.0 {
                compressed[(k, last)] = size
            } else {
                next = span.fresh()
            }
        }
        span.push(&next);
        next = square * &next;
    }
    if let Some(last) = half.checked_sub(1) {
        let (_, shares) = span.orthogonalize(&mut next);
        add(&shares, &mut compressed, last);
    }
    let vectors = Mat::from_fn(order, half, |i, k| span.columns[(i, 2 * k)]);
    Some((vectors, compressed))
}

/// Sets a column to the components along v₁, v₂, …; those along Jv₁, Jv₂, … are rounding.
fn add(shares: &Col<f64>, compressed: &mut Mat<f64>, column: usize) {
    for i in 0..shares.nrows() / 2 {
        compressed[(i, column)] = shares[2 * i];
    }
}

/// Orthonormal vectors v₁, Jv₁, v₂, Jv₂, …, both as columns and as rows: products with a transposed matrix take several times as long.
struct Span {
    columns: Mat<f64>,
    rows: Mat<f64>,
    count: usize,
}

impl Span {
    fn new(order: usize) -> Self {
        Span {
            columns: Mat::zeros(order, order),
            rows: Mat::zeros(order, order),
            count: 0,
        }
    }

    /// Adds v and Jv.
    fn push(&mut self, vector: &Col<f64>) {
        let half = vector.nrows() / 2;
        for i in 0..half {
            let (q, p) = (vector[i], vector[half + i]);
            for (k, at, entry) in [(0, i, q), (0, half + i, p), (1, i, p), (1, half + i, -q)] {
                self.columns[(at, self.count + k)] = entry;
                self.rows[(self.count + k, at)] = entry;
            }
        }
        self.count += 2;
    }

    /// Orthogonalizes a vector against the span and normalizes it. Returns its remaining length, 0 if that is
    /// rounding, and its components in the span.
    fn orthogonalize(&self, next: &mut Col<f64>) -> (f64, Col<f64>) {
        let columns = self.columns.subcols(0, self.count);
        let rows = self.rows.subrows(0, self.count);
        let size = next.norm_l2();
        let mut shares = Col::zeros(self.count);
        let mut left = size;
        loop {
            let more = rows * &*next;
            *next -= columns * &more;
            shares += more;
            let before = left;
            left = next.norm_l2();
            if left.is_nan() || left <= BREAKDOWN * size {
                return (0.0, shares);
            }
            if left > MOSTLY_KEPT * before {
                *next *= Scale(1.0 / left);
                return (left, shares);
            }
        }
    }

    /// A unit vector orthogonal to the span; zero if there is none.
    fn fresh(&self) -> Col<f64> {
        let order = self.columns.nrows();
        let attempts = (0..order).map(|k| {
            let mut attempt = scattered(order, k);
            (self.orthogonalize(&mut attempt).0, attempt)
        });
        let mut found = attempts.filter(|(left, _)| *left > 0.0);
        found
            .next()
            .map_or_else(|| Col::zeros(order), |(_, found)| found)
    }
}

/// A vector with components in all directions, different for each `k`.
fn scattered(order: usize, k: usize) -> Col<f64> {
    let frequency = 0.7 + 0.31 * k as f64;
    Col::from_fn(order, |i| (frequency * i as f64 + 0.3).sin())
}

#[cfg(test)]
mod tests {
    use faer::linalg::solvers::Eigen;

    use super::*;

    /// J times a symmetric matrix that is not definite: waves, real λ and quadruples.
    fn hamiltonian(half: usize) -> Mat<f64> {
        let wave = |i: usize, k: usize| ((13 * i * k + 7 * (i + k)) as f64).sin();
        Mat::from_fn(2 * half, 2 * half, |i, k| {
            if i < half {
                wave(half + i, k)
            } else {
                -wave(i - half, k)
            }
        })
    }

    fn residual(matrix: &Mat<f64>, found: &UpperPairs) -> f64 {
        let moved = matrix * &found.halves;
        let of = |k: usize| {
            let y = |part: &Mat<f64>| {
                Col::from_fn(part.nrows(), |i| {
                    c64::new(part[(i, 2 * k)], part[(i, 2 * k + 1)])
                })
            };
            let rest = y(&moved) - Scale(found.lambdas[k]) * y(&found.halves);
            rest.norm_l2() / y(&found.halves).norm_l2()
        };
        (0..found.lambdas.len()).map(of).fold(0.0, f64::max)
    }

    /// Reference: the eigenvalues of A itself, by faer.
    #[test]
    fn the_eigenvalues_are_those_of_the_whole_matrix() {
        for half in [1, 2, 5, 12, 30] {
            let matrix = hamiltonian(half);
            let found = hamiltonian_eigenpairs(matrix.as_ref()).unwrap().unwrap();
            let whole = Eigen::new_from_real(matrix.as_ref()).unwrap();
            let upper: Vec<c64> = whole
                .S()
                .column_vector()
                .iter()
                .filter(|l| l.im >= 0.0)
                .copied()
                .collect();
            assert_eq!(found.lambdas.len(), upper.len(), "order {half}");
            for lambda in &upper {
                let away = |other: &c64| (other - lambda).norm();
                let nearest = found.lambdas.iter().map(away).fold(f64::INFINITY, f64::min);
                assert!(
                    nearest < 1e-9 * matrix.norm_l2(),
                    "{half}: {lambda} {nearest:e}"
                );
            }
            let residual = residual(&matrix, &found);
            assert!(residual < 1e-9 * matrix.norm_l2(), "{half}: {residual:e}");
        }
    }

    /// Eight oscillators of three kinds: the Krylov space of one vector contains one of each kind. The equal
    /// squares are detected, so that the eigenproblem of the matrix itself is solved.
    #[test]
    fn equal_eigenvalues_are_left_to_the_whole_matrix() {
        let half = 8;
        let kinds = [1.0, 2.0, 3.0];
        let matrix = Mat::from_fn(2 * half, 2 * half, |i, k| match (i < half, k) {
            (true, k) if k == half + i => 1.0,
            (false, k) if k + half == i => -f64::powi(kinds[k % 3], 2),
            _ => 0.0,
        });
        let (_, compressed) = isotropic(&(&matrix * &matrix)).unwrap();
        let mut squares = RealEigen::new(compressed.as_ref()).unwrap().values;
        squares.sort_by(|x, y| y.re.total_cmp(&x.re));
        let exact = [1.0, 1.0, 1.0, 4.0, 4.0, 4.0, 9.0, 9.0];
        for (found, exact) in squares.iter().zip(exact) {
            assert!((found + exact).norm() < 1e-12, "{found} {exact}");
        }
        assert!(hamiltonian_eigenpairs(matrix.as_ref()).unwrap().is_none());
    }

    /// The cancellation takes effect within the Krylov vectors of one matrix, not after them.
    #[test]
    fn a_cancelled_computation_ends_within_an_eigenproblem() {
        let matrix = hamiltonian(12);
        let flag = Cancellation::default();
        flag.cancel();
        let found = flag.watched(|| isotropic(&(&matrix * &matrix)));
        assert!(found.unwrap().is_none());
    }
}
