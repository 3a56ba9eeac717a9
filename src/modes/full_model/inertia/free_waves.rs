//! The waves of the free blade at a speed, in which B_n is diagonal.

use nalgebra::{DMatrix, DVector};

use super::jacobi::Eigenvectors;
use crate::modes::full_model::Harmonic;

/// The waves of a harmonic at a speed, in coordinates of the waves at rest.
#[derive(Debug)]
pub struct FreeWaves {
    pub of: Eigenvectors,
    /// Diagonal of a matrix that, in the coordinates of these waves, is an upper bound of the `weights` of a
    /// harmonic.
    pub weights: Vec<f64>,
}

impl FreeWaves {
    pub fn new(harmonic: &Harmonic, speed_rad_per_s: f64) -> Self {
        let mut block = &harmonic.resting_tension * speed_rad_per_s.powi(2);
        for (i, own) in harmonic.resting.values.iter().enumerate() {
            block[(i, i)] += own;
        }
        let of = Eigenvectors::of(block);
        let weights = diagonal_bound(&harmonic.weights, &of.vectors);
        FreeWaves { of, weights }
    }
}

/// d with VᵀWV ≤ diag(d) for diagonal and positive W: scaled to unit diagonal, its eigenvalues are at most
/// the sums of its rows (Gershgorin).
fn diagonal_bound(weights: &[f64], vectors: &DMatrix<f64>) -> Vec<f64> {
    let roots = DVector::from_iterator(weights.len(), weights.iter().map(|w| w.sqrt()));
    let scaled = DMatrix::from_diagonal(&roots) * vectors;
    let turned = scaled.tr_mul(&scaled);
    let size = |i: usize| turned[(i, i)].sqrt();
    let row = |i: usize| (0..weights.len()).map(move |k| (i, k));
    let sum = |i: usize| -> f64 { row(i).map(|(i, k)| turned[(i, k)].abs() / size(k)).sum() };
    (0..weights.len()).map(|i| size(i) * sum(i)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// diag(d) − VᵀWV has no negative eigenvalue, for small and large rotations and for graded weights.
    #[test]
    fn the_diagonal_is_no_smaller_than_the_weights() {
        let mut state = 1.0_f64;
        let mut draw = || {
            state = (state * 997.0 + 0.123).fract();
            state - 0.5
        };
        for order in 1..12 {
            for turn in [1e-6, 1e-2, 10.0] {
                let drawn = DMatrix::from_fn(order, order, |_, _| turn * draw());
                let vectors = (DMatrix::identity(order, order) + drawn).qr().q();
                let weights: Vec<f64> = (0..order).map(|i| 4_f64.powi(i as i32)).collect();
                let exact = vectors.transpose()
                    * DMatrix::from_diagonal(&DVector::from_vec(weights.clone()))
                    * &vectors;
                let bound = diagonal_bound(&weights, &vectors);
                let more = DMatrix::from_diagonal(&DVector::from_vec(bound)) - &exact;
                let least = more.symmetric_eigenvalues().min();
                assert!(least >= -1e-13 * exact.amax(), "order {order}: {least}");
            }
        }
    }
}
