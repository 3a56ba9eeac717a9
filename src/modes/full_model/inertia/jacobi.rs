//! Eigenvalues and eigenvectors of a small symmetric matrix with approximately known vectors.
//!
//! Jacobi's method: in an approximate basis of eigenvectors the matrix is nearly diagonal, and one or two
//! sweeps of rotations suffice.

use nalgebra::DMatrix;

/// Eigenvalues and eigenvectors of a symmetric matrix A: VᵀAV = diag(values) + R with |Rᵢⱼ| ≤ [`LEFT`] √|valuesᵢ
/// valuesⱼ|.
#[derive(Debug)]
pub struct Eigenvectors {
    pub values: Vec<f64>,
    /// V, orthogonal.
    pub vectors: DMatrix<f64>,
}

/// Share of √|aᵢᵢaⱼⱼ| below which aᵢⱼ is neglected. A smaller value would cost a further sweep and make no more
/// counts certain, because they allow for errors a thousand times as large elsewhere.
pub const LEFT: f64 = 1e-10;
/// Number of sweeps after which the remainder is rounding of cancelling numbers.
const MOST_SWEEPS: usize = 12;

impl Eigenvectors {
    /// Diagonalizes a matrix; one that is not nearly diagonal takes more rotations.
    pub fn of(mut matrix: DMatrix<f64>) -> Self {
        let order = matrix.nrows();
        let mut vectors = DMatrix::identity(order, order);
        let columns = matrix.as_mut_slice();
        for _ in 0..MOST_SWEEPS {
            let mut is_diagonal = true;
            for k in 1..order {
                for i in 0..k {
                    let coupling = columns[k * order + i];
                    let size = columns[i * order + i] * columns[k * order + k];
                    if coupling * coupling > LEFT * LEFT * size.abs() {
                        is_diagonal = false;
                        rotate(columns, vectors.as_mut_slice(), order, [i, k]);
                    }
                }
            }
            if is_diagonal {
                break;
            }
        }
        Eigenvectors {
            values: (0..order).map(|i| matrix[(i, i)]).collect(),
            vectors,
        }
    }
}

/// Annihilates element (i, k), i < k, of a symmetric matrix that is stored completely.
fn rotate(matrix: &mut [f64], vectors: &mut [f64], order: usize, [i, k]: [usize; 2]) {
    let coupling = matrix[k * order + i];
    let (own_i, own_k) = (matrix[i * order + i], matrix[k * order + k]);
    let half = (own_k - own_i) / (2.0 * coupling);
    // The tangent t of the rotation angle is the smaller root of t² + 2 half t − 1 = 0.
    let tangent = half.signum() / (half.abs() + (half * half + 1.0).sqrt());
    let cosine = 1.0 / (tangent * tangent + 1.0).sqrt();
    let sine = tangent * cosine;
    turn(matrix, order, [i, k], [cosine, sine]);
    turn(vectors, order, [i, k], [cosine, sine]);
    for j in 0..order {
        matrix[j * order + i] = matrix[i * order + j];
        matrix[j * order + k] = matrix[k * order + j];
    }
    matrix[i * order + i] = own_i - tangent * coupling;
    matrix[k * order + k] = own_k + tangent * coupling;
    matrix[k * order + i] = 0.0;
    matrix[i * order + k] = 0.0;
}

/// Rotates columns i < k in their plane.
fn turn(matrix: &mut [f64], order: usize, [i, k]: [usize; 2], [cosine, sine]: [f64; 2]) {
    let (before, after) = matrix.split_at_mut(k * order);
    let left = &mut before[i * order..(i + 1) * order];
    for (x, y) in left.iter_mut().zip(&mut after[..order]) {
        (*x, *y) = (cosine * *x - sine * *y, sine * *x + cosine * *y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// VᵀAV is as diagonal as documented and VᵀV = 1, for matrices that are nearly diagonal, far from
    /// diagonal, and graded.
    #[test]
    fn the_vectors_diagonalize_the_matrix() {
        let mut state = 1.0_f64;
        let mut draw = || {
            state = (state * 997.0 + 0.123).fract();
            state - 0.5
        };
        for order in 1..14 {
            let drawn = DMatrix::from_fn(order, order, |_, _| draw());
            let symmetric = &drawn + drawn.transpose();
            let graded = DMatrix::from_fn(order, order, |i, k| {
                let own = if i == k { 2.0 * order as f64 } else { 0.0 };
                10_f64.powi((i + k) as i32) * (symmetric[(i, k)] + own)
            });
            let identity = DMatrix::identity(order, order);
            let near = DMatrix::from_fn(order, order, |i, k| {
                let own = if i == k { i as f64 + 1.0 } else { 0.0 };
                own + 1e-3 * symmetric[(i, k)]
            });
            for matrix in [symmetric, graded, near, identity.clone()] {
                let found = Eigenvectors::of(matrix.clone());
                let v = &found.vectors;
                let values = nalgebra::DVector::from_vec(found.values.clone());
                let left = v.transpose() * &matrix * v - DMatrix::from_diagonal(&values);
                for (i, k) in (0..order).flat_map(|k| (0..order).map(move |i| (i, k))) {
                    let most = LEFT * (values[i] * values[k]).abs().sqrt();
                    let rounding = 1e-14 * order as f64 * matrix.amax();
                    assert!(left[(i, k)].abs() <= most + rounding, "order {order}");
                }
                let unit = v.transpose() * v - &identity;
                assert!(unit.amax() <= 1e-13, "order {order}: {}", unit.amax());
                let mut ascending = found.values;
                ascending.sort_by(f64::total_cmp);
                let mut exact: Vec<f64> = matrix.symmetric_eigenvalues().iter().copied().collect();
                exact.sort_by(f64::total_cmp);
                for (x, y) in ascending.iter().zip(&exact) {
                    let error = (x - y).abs();
                    let most = order as f64 * LEFT * x.abs() + 1e-12 * matrix.amax();
                    assert!(error <= most, "order {order}: {x} {y}");
                }
            }
        }
    }
}
