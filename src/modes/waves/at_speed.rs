//! The reduced model at a speed, with its derivatives.

use faer::{Mat, MatRef, Scale, c64};

use super::speed_series::WaveModel;
use crate::modes::family::{Family, MatrixPolynomial};

/// A reduced model at a speed.
pub struct WavesAt<'a> {
    model: &'a WaveModel,
    /// Entries of its terms and their derivatives with respect to the speed.
    sums: Mat<f64>,
}

impl Family for WaveModel {
    type At<'a> = WavesAt<'a>;

    fn at(&self, speed_rad_per_s: f64) -> Option<WavesAt<'_>> {
        let sums = self.sums(speed_rad_per_s)?;
        Some(WavesAt { model: self, sums })
    }
}

impl MatrixPolynomial for WavesAt<'_> {
    fn order(&self) -> usize {
        self.model.size()
    }

    fn unit_per_s(&self) -> f64 {
        self.model.window
    }

    fn by_root<const COUNT: usize>(&self, lambda: c64) -> [Mat<c64>; COUNT] {
        self.derivatives(0, lambda)
    }

    fn by_speed<const COUNT: usize>(&self, lambda: c64) -> [Mat<c64>; COUNT] {
        self.derivatives(1, lambda)
    }
}

impl WavesAt<'_> {
    /// First derivatives with respect to λ of the polynomial in a column of the sums.
    fn derivatives<const COUNT: usize>(&self, column: usize, lambda: c64) -> [Mat<c64>; COUNT] {
        let unit = self.model.window.recip();
        let mut found = polynomial(self.sums.col_as_slice(column), lambda * unit, self.order());
        let mut power = 1.0;
        for matrix in &mut found {
            *matrix *= Scale(c64::from(power));
            power *= unit;
        }
        found
    }
}

/// Σ λᵏ L_k and its first derivatives with respect to λ, from the entries of L₀, L₁, ….
fn polynomial<const ORDERS: usize>(entries: &[f64], mu: c64, size: usize) -> [Mat<c64>; ORDERS] {
    let count = entries.len() / (size * size);
    let mut powers = vec![c64::ONE; count];
    for k in 1..count {
        powers[k] = powers[k - 1] * mu;
    }
    // Real and imaginary parts of k (k − 1) … λ^(k − order), side by side for each order.
    let weights = Mat::from_fn(count, 2 * ORDERS, |k, part| {
        let order = part / 2;
        if k < order {
            return 0.0;
        }
        let factor: f64 = (0..order).map(|j| (k - j) as f64).product();
        let weight = powers[k - order] * factor;
        if part % 2 == 0 { weight.re } else { weight.im }
    });
    let sums = MatRef::from_column_major_slice(entries, size * size, count) * weights;
    std::array::from_fn(|order| {
        Mat::from_fn(size, size, |i, k| {
            let row = k * size + i;
            c64::new(sums[(row, 2 * order)], sums[(row, 2 * order + 1)])
        })
    })
}
