//! Eigenvalues and eigenvectors of a small symmetric matrix of which the vectors are nearly known.
//!
//! Jacobi's method: in a basis that is nearly right the matrix is nearly diagonal, and two or three sweeps of
//! rotations make it so to rounding.

use nalgebra::DMatrix;

/// Of a symmetric matrix A = V diag(values) Vᵀ.
#[derive(Debug)]
pub struct Eigenvectors {
    pub values: Vec<f64>,
    /// V, orthogonal.
    pub vectors: DMatrix<f64>,
}

/// Share of √(aᵢᵢaⱼⱼ) below which aᵢⱼ is rounding.
const ROUNDING: f64 = 1e-15;
/// Sweeps after which what is left is rounding of numbers that cancel.
const MOST_SWEEPS: usize = 12;

impl Eigenvectors {
    /// From an orthogonal matrix of which the columns are near the eigenvectors; any other will do, at more
    /// rotations.
    pub fn near(guess: &DMatrix<f64>, matrix: &DMatrix<f64>) -> Self {
        let order = matrix.nrows();
        let mut vectors = guess.clone();
        let mut turned = guess.tr_mul(matrix) * guess;
        for _ in 0..MOST_SWEEPS {
            let mut is_diagonal = true;
            for k in 1..order {
                for i in 0..k {
                    let coupling = turned[(i, k)];
                    let size = (turned[(i, i)] * turned[(k, k)]).abs().sqrt();
                    if coupling.abs() > ROUNDING * size {
                        is_diagonal = false;
                        rotate(&mut turned, &mut vectors, i, k);
                    }
                }
            }
            if is_diagonal {
                break;
            }
        }
        Eigenvectors {
            values: (0..order).map(|i| turned[(i, i)]).collect(),
            vectors,
        }
    }
}

/// Makes element (i, k) zero, i < k.
fn rotate(matrix: &mut DMatrix<f64>, vectors: &mut DMatrix<f64>, i: usize, k: usize) {
    let coupling = matrix[(i, k)];
    let half = (matrix[(k, k)] - matrix[(i, i)]) / (2.0 * coupling);
    // The smaller root of t² + 2 half t − 1.
    let tangent = half.signum() / (half.abs() + half.hypot(1.0));
    let cosine = 1.0 / tangent.hypot(1.0);
    let sine = tangent * cosine;
    let (own_i, own_k) = (matrix[(i, i)], matrix[(k, k)]);
    turn(matrix, i, k, cosine, sine);
    turn(vectors, i, k, cosine, sine);
    for j in 0..matrix.nrows() {
        matrix[(i, j)] = matrix[(j, i)];
        matrix[(k, j)] = matrix[(j, k)];
    }
    matrix[(i, i)] = own_i - tangent * coupling;
    matrix[(k, k)] = own_k + tangent * coupling;
    matrix[(i, k)] = 0.0;
    matrix[(k, i)] = 0.0;
}

/// Turns columns i < k in their plane.
fn turn(matrix: &mut DMatrix<f64>, i: usize, k: usize, cosine: f64, sine: f64) {
    let rows = matrix.nrows();
    let (before, after) = matrix.as_mut_slice().split_at_mut(k * rows);
    let left = &mut before[i * rows..(i + 1) * rows];
    for (x, y) in left.iter_mut().zip(&mut after[..rows]) {
        (*x, *y) = (cosine * *x - sine * *y, sine * *x + cosine * *y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A V = V diag and VᵀV = 1, from a guess that is near, far, or of a matrix with equal eigenvalues.
    #[test]
    fn the_vectors_diagonalise_the_matrix() {
        let mut state = 1.0_f64;
        let mut draw = || {
            state = (state * 997.0 + 0.123).fract();
            state - 0.5
        };
        for order in 1..14 {
            let drawn = DMatrix::from_fn(order, order, |_, _| draw());
            let graded = DMatrix::from_fn(order, order, |i, k| {
                10_f64.powi((i + k) as i32 / 2) * (drawn[(i, k)] + drawn[(k, i)])
            });
            let near = (&graded
                + DMatrix::from_fn(order, order, |i, k| 1e-3 * graded[(i, k)].abs()))
            .symmetric_eigen()
            .eigenvectors;
            let identity = DMatrix::identity(order, order);
            for (matrix, guess) in [(&graded, &near), (&graded, &identity), (&identity, &near)] {
                let found = Eigenvectors::near(guess, matrix);
                let v = &found.vectors;
                let values = nalgebra::DVector::from_vec(found.values.clone());
                let left = matrix * v - v * DMatrix::from_diagonal(&values);
                assert!(
                    left.amax() <= 1e-13 * matrix.amax(),
                    "order {order}: {}",
                    left.amax()
                );
                let unit = v.transpose() * v - &identity;
                assert!(unit.amax() <= 1e-13, "order {order}: {}", unit.amax());
                let mut values = found.values;
                values.sort_by(f64::total_cmp);
                let mut exact: Vec<f64> = matrix.symmetric_eigenvalues().iter().copied().collect();
                exact.sort_by(f64::total_cmp);
                for (x, y) in values.iter().zip(&exact) {
                    assert!(
                        (x - y).abs() <= 1e-13 * matrix.amax(),
                        "order {order}: {x} {y}"
                    );
                }
            }
        }
    }
}
