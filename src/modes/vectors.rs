//! Operations on vectors and eigenpairs.

use faer::{Col, ColRef, Mat, Scale, c64};

/// λ, in 1/s, and q with (λ² + λD + K) q = 0.
pub type Eigenpair = (c64, Col<c64>);

/// Real and imaginary parts of a vector.
pub fn split(q: &Col<c64>) -> (Col<f64>, Col<f64>) {
    (
        Col::from_fn(q.nrows(), |i| q[i].re),
        Col::from_fn(q.nrows(), |i| q[i].im),
    )
}

/// A real vector as a complex one.
pub fn complex(x: &Col<f64>) -> Col<c64> {
    Col::from_fn(x.nrows(), |i| c64::new(x[i], 0.0))
}

/// A q for a real matrix A.
pub fn real_times(matrix: &Mat<f64>, q: &Col<c64>) -> Col<c64> {
    let (re, im) = split(q);
    let (re, im) = (matrix * re, matrix * im);
    Col::from_fn(matrix.nrows(), |i| c64::new(re[i], im[i]))
}

/// Real and imaginary parts of vectors, in two columns each.
pub fn halves<'a>(rows: usize, vectors: impl ExactSizeIterator<Item = &'a Col<c64>>) -> Mat<f64> {
    let mut halves = Mat::zeros(rows, 2 * vectors.len());
    for (k, q) in vectors.enumerate() {
        for i in 0..rows {
            halves[(i, 2 * k)] = q[i].re;
            halves[(i, 2 * k + 1)] = q[i].im;
        }
    }
    halves
}

/// Vector k of the columns that [`halves`] makes.
pub fn joined(halves: &Mat<f64>, k: usize) -> Col<c64> {
    Col::from_fn(halves.nrows(), |i| {
        c64::new(halves[(i, 2 * k)], halves[(i, 2 * k + 1)])
    })
}

/// xᴴy of vector `x` of some [`halves`] and vector `y` of others.
pub fn product(left: &Mat<f64>, x: usize, right: &Mat<f64>, y: usize) -> c64 {
    let dot =
        |a: usize, b: usize| -> f64 { left.col(2 * x + a).transpose() * right.col(2 * y + b) };
    c64::new(dot(0, 0) + dot(1, 1), dot(0, 1) - dot(1, 0))
}

/// q/‖q‖; zero remains zero.
pub fn unit(q: ColRef<'_, c64>) -> Col<c64> {
    let norm = q.norm_l2();
    let factor = if norm > 0.0 { 1.0 / norm } else { 0.0 };
    Scale(c64::new(factor, 0.0)) * q
}

/// The item with the smallest value of a function; of equal ones the first.
pub fn smallest<T>(items: impl IntoIterator<Item = T>, value: impl Fn(&T) -> f64) -> Option<T> {
    let all = items.into_iter();
    all.min_by(|x, y| value(x).total_cmp(&value(y)))
}

/// Sorts eigenpairs by |λ|, ascending.
pub fn by_magnitude(mut pairs: Vec<Eigenpair>) -> Vec<Eigenpair> {
    pairs.sort_by(|x, y| x.0.norm().total_cmp(&y.0.norm()));
    pairs
}

/// Orthonormal basis of the span of unit vectors, by QR with column pivoting; vectors closer than `tolerance`
/// to the span of the others are omitted.
pub fn orthonormal(rows: usize, vectors: &[Col<f64>], tolerance: f64) -> Mat<f64> {
    let matrix = Mat::from_fn(rows, vectors.len(), |i, k| vectors[k][i]);
    independent(&matrix, tolerance)
}

/// Orthonormal basis of the span of columns, as [`orthonormal`]: the pivots of A = QR are those of R, which has few rows, so that
/// products of matrices do most of the work.
pub fn independent(columns: &Mat<f64>, tolerance: f64) -> Mat<f64> {
    let tall = columns.qr();
    let qr = tall.thin_R().col_piv_qr();
    let rank = (0..qr.thin_R().nrows())
        .take_while(|&k| qr.thin_R()[(k, k)].abs() > tolerance)
        .count();
    tall.compute_thin_Q() * qr.compute_thin_Q().subcols(0, rank)
}
