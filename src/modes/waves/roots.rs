//! Eigenvalues of the reduced model at a speed, with their slopes.
//!
//! The eigenvalues within the reach are those of the matrix B of a pair (X, B) with Σ L_k X Bᵏ = 0 (`pair`). With the vectors
//! u, w of B and the left vectors Y,
//!
//! dλ/dΩ = −(Σ λᵏ w Y (∂L_k/∂Ω) X u) / (Σ k λᵏ⁻¹ w Y L_k X u).

use faer::{Col, Mat, c64};

use super::pair::{END, Pair, columns, inverse};
use super::speed_series::WaveModel;
use crate::model::linalg::{LinalgError, RealEigen};
use crate::modes::error::SpectrumError;

/// An eigenvalue with Im λ ≥ 0 and its vector.
#[derive(Debug, Clone)]
pub struct Root {
    /// λ, in 1/s.
    pub lambda: c64,
    /// dλ/dΩ, not finite where two eigenvalues coalesce.
    pub slope: c64,
    /// Displacements of strong dampers, near waves.
    pub vector: Col<c64>,
}

/// |λ| of a free rigid motion in units of the window, which is zero except for the root of rounding.
const RIGID: f64 = 3e-6;

impl WaveModel {
    /// |λ| up to which eigenvalues may be listed, in 1/s.
    pub fn reach_per_s(&self) -> f64 {
        END[1] * self.window
    }

    /// All eigenvalues at a speed with Im λ ≥ 0 up to somewhat beyond the window, by magnitude, without free rigid motions, with
    /// slopes and vectors.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn roots(&self, speed_rad_per_s: f64) -> Result<Vec<Root>, SpectrumError> {
        let (terms, slopes) = self.at(speed_rad_per_s);
        let mut found = sloped(&terms, &slopes).map_err(SpectrumError::at(speed_rad_per_s))?;
        found.sort_by(|x, y| x.lambda.norm().total_cmp(&y.lambda.norm()));
        let zeros = found.partition_point(|root| root.lambda.norm() < RIGID);
        found.drain(..zeros.min(2 * self.rigid));
        for root in &mut found {
            root.lambda *= self.window;
            root.slope *= self.window;
        }
        Ok(found)
    }

    /// The eigenvalues of [`WaveModel::roots`] and their slopes.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn eigenvalues(&self, speed_rad_per_s: f64) -> Result<Vec<(c64, c64)>, SpectrumError> {
        let roots = self.roots(speed_rad_per_s)?.into_iter();
        Ok(roots.map(|root| (root.lambda, root.slope)).collect())
    }
}

fn sloped(terms: &[Mat<f64>], slopes: &[Mat<f64>]) -> Result<Vec<Root>, LinalgError> {
    let Some(Pair { x, y, b }) = Pair::new(terms)? else {
        return Ok(Vec::new());
    };
    let eigen = RealEigen::new(b.as_ref())?;
    let (right, left) = (x * columns(&eigen), inverse(&eigen) * y);
    let inner = |all: &[Mat<f64>]| -> Vec<Mat<f64>> {
        let of = |matrix: &Mat<f64>| &left * (matrix * &right);
        all.iter().map(of).collect()
    };
    let (terms, slopes) = (inner(terms), inner(slopes));
    let of = |i: usize| {
        let mu = eigen.values[i];
        // Columns i and i + 1 of the right vectors are the real and the imaginary part of u. With the rows a and b of the
        // left vectors at the same indices, w = (a − ib)/2.
        let form = |matrix: &Mat<f64>| {
            if mu.im > 0.0 {
                let re = matrix[(i, i)] + matrix[(i + 1, i + 1)];
                c64::new(re, matrix[(i, i + 1)] - matrix[(i + 1, i)]) * 0.5
            } else {
                c64::from(matrix[(i, i)])
            }
        };
        let (mut moved, mut by_root) = (c64::new(0.0, 0.0), c64::new(0.0, 0.0));
        let mut power = c64::new(1.0, 0.0);
        for (k, slope) in slopes.iter().enumerate() {
            moved += power * form(slope);
            if let Some(next) = terms.get(k + 1) {
                by_root += power * form(next) * (k + 1) as f64;
            }
            power *= mu;
        }
        let upper = |row: usize| {
            if mu.im > 0.0 {
                c64::new(right[(row, i)], right[(row, i + 1)])
            } else {
                c64::from(right[(row, i)])
            }
        };
        Root {
            lambda: mu,
            slope: -moved / by_root,
            vector: Col::from_fn(right.nrows(), upper),
        }
    };
    Ok(eigen.upper().into_iter().map(of).collect())
}
