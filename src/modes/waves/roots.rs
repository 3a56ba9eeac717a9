//! Eigenvalues of the reduced model at a speed, with their slopes.
//!
//! The eigenvalues within the reach are those of the matrix B of a pair (X, B) with Σ L_k X Bᵏ = 0 (`pair`). With the vectors
//! u, w of B and the left vectors Y,
//!
//! dλ/dΩ = −(Σ λᵏ w Y (∂L_k/∂Ω) X u) / (Σ k λᵏ⁻¹ w Y L_k X u).

use faer::{Col, Mat, MatRef, c64};

use super::pair::{END, Pair, inverse};
use super::speed_series::WaveModel;
use crate::model::linalg::{LinalgError, RealEigen};
use crate::modes::error::SpectrumError;
use crate::modes::vectors::{joined, product};

/// An eigenvalue with Im λ ≥ 0 and its vector.
#[derive(Debug, Clone)]
pub struct Root {
    /// λ, in 1/s.
    pub lambda: c64,
    /// dλ/dΩ, not finite where two eigenvalues coalesce.
    pub slope: c64,
    /// Sign of the action of an oscillation, +1 or −1.
    pub action: i8,
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
    /// [`SpectrumError`] when an eigenproblem fails, or beside the range of the model.
    pub fn roots(&self, speed_rad_per_s: f64) -> Result<Vec<Root>, SpectrumError> {
        let range = self.range_rad_per_s();
        let beside = || SpectrumError::beside_model(speed_rad_per_s, range);
        let sums = self.sums(speed_rad_per_s).ok_or_else(beside)?;
        let side_by_side = |column: usize| {
            let entries = sums.col_as_slice(column);
            MatRef::from_column_major_slice(entries, self.size(), entries.len() / self.size())
        };
        let of = sloped(side_by_side(0), side_by_side(1), self.is_conservative);
        let mut found = of.map_err(SpectrumError::at(speed_rad_per_s))?;
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
    /// [`SpectrumError`] as [`WaveModel::roots`].
    pub fn eigenvalues(&self, speed_rad_per_s: f64) -> Result<Vec<(c64, c64)>, SpectrumError> {
        let roots = self.roots(speed_rad_per_s)?.into_iter();
        Ok(roots.map(|root| (root.lambda, root.slope)).collect())
    }
}

/// Eigenvalues by the matrices L₀, L₁, … side by side and by their derivatives with respect to the speed.
fn sloped(
    terms: MatRef<'_, f64>,
    slopes: MatRef<'_, f64>,
    is_conservative: bool,
) -> Result<Vec<Root>, LinalgError> {
    let Some(Pair { x, y, b }) = Pair::new(terms, is_conservative)? else {
        return Ok(Vec::new());
    };
    let size = terms.nrows();
    let eigen = RealEigen::new(b.as_ref())?;
    let upper = eigen.upper();
    let (right, left) = (x * eigen.halves_of(&upper), inverse(&eigen) * y);
    // λᵏXu and kλᵏ⁻¹Xu, one power below another.
    let mut powers = Mat::zeros(terms.ncols(), right.ncols());
    let mut by_root = Mat::zeros(terms.ncols(), right.ncols());
    for (k, i) in upper.iter().enumerate() {
        let (mut power, mut before) = (c64::ONE, c64::ZERO);
        for (degree, row) in (0..terms.ncols()).step_by(size).enumerate() {
            place_multiple(&mut powers, row, &right, k, power);
            place_multiple(&mut by_root, row, &right, k, before * degree as f64);
            (power, before) = (power * eigen.values[*i], power);
        }
    }
    let [moved, by_root] = [slopes * powers, terms * by_root];
    let [by_velocity, by_inertia] = [1, 2].map(|power| terms.subcols(power * size, size) * &right);
    let of = |(k, i): (usize, &usize)| {
        let mu = eigen.values[*i];
        // With the rows a and b of the left vectors of a pair, w = (a − ib)/2.
        let form = |vectors: &Mat<f64>| {
            let dot =
                |row: usize, part: usize| -> f64 { left.row(i + row) * vectors.col(2 * k + part) };
            if mu.im > 0.0 {
                c64::new(dot(0, 0) + dot(1, 1), dot(0, 1) - dot(1, 0)) * 0.5
            } else {
                c64::from(dot(0, 0))
            }
        };
        // xᴴ(2ωM̃ − iC̃)x, where the skew part of C̃ acts alone.
        let turned = product(&right, k, &by_velocity, k).im;
        let action = turned + 2.0 * mu.im * product(&right, k, &by_inertia, k).re;
        Root {
            lambda: mu,
            slope: -form(&moved) / form(&by_root),
            action: if action < 0.0 { -1 } else { 1 },
            vector: joined(&right, k),
        }
    };
    Ok(upper.iter().enumerate().map(of).collect())
}

/// Writes a multiple of vector `k` of some halves into vector `k` of others, from a row on.
fn place_multiple(all: &mut Mat<f64>, row: usize, halves: &Mat<f64>, k: usize, factor: c64) {
    for i in 0..halves.nrows() {
        let entry = factor * c64::new(halves[(i, 2 * k)], halves[(i, 2 * k + 1)]);
        all[(row + i, 2 * k)] = entry.re;
        all[(row + i, 2 * k + 1)] = entry.im;
    }
}
