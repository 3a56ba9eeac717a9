//! The potential of stretching on a few shapes, as a quadratic form in the products of their coordinates.
//!
//! Many quadratic forms Q in the products give the same potential, because p_a p_b · p_c p_d does not depend on the order of
//! the four. Of these the one whose entries do not depend on it either is kept: one product Qz then gives the energy, the
//! gradient and the second derivatives.

use std::sync::Arc;

use faer::{Col, Mat, MatRef, Scale};
use rayon::prelude::*;

use super::strain::Strain;
use super::{Stretching, StretchingError};

/// [`Stretching`] on r shapes, the columns of V: U₄(V p) = ½ zᵀQz with the r(r+1)/2 products
/// z = (p_a p_b), a ≥ b, and Q = (m_ab m_cd s_abcd), where m is 1 for a = b and 2 otherwise, and s is the same for every
/// order of its four indices.
#[derive(Debug, Clone)]
pub struct ReducedStretching {
    order: usize,
    /// Matrix Q, of order r(r+1)/2, for the pairs (0, 0), (1, 0), (1, 1), (2, 0) …
    /// Copies of a blade under other forces or with other gaps share it.
    quartic: Arc<Mat<f64>>,
}

impl ReducedStretching {
    /// Computes the potential on the shapes that are the columns of V, N × r.
    ///
    /// # Errors
    /// [`StretchingError::Length`] if V does not have N rows.
    pub fn new(stretching: &Stretching, basis: MatRef<'_, f64>) -> Result<Self, StretchingError> {
        let order = basis.ncols();
        let slopes = (0..order)
            .map(|k| stretching.slopes(&basis.col(k).to_owned()))
            .collect::<Result<Vec<_>, _>>()?;
        let pairs: Vec<[usize; 2]> = pairs(order).collect();
        let columns: Vec<Vec<f64>> = pairs
            .par_iter()
            .map(|&[a, b]| stretching.relaxed(&Strain::of(&slopes[a], &slopes[b])))
            .collect();
        let height = columns.first().map_or(0, Vec::len);
        let relaxed = Mat::from_fn(height, pairs.len(), |i, k| columns[k][i]);
        // The potential is U₄ = |Z e|², in which p_a p_b · p_c p_d has this product of the columns of both pairs.
        let products = relaxed.transpose() * &relaxed;
        let entry = |i: usize, k: usize| {
            let ([a, b], [c, d]) = (pairs[i], pairs[k]);
            let orders = [
                products[(i, k)],
                products[(pair(a, c), pair(b, d))],
                products[(pair(a, d), pair(b, c))],
            ];
            2.0 / 3.0 * orders.iter().sum::<f64>() * times(a, b) * times(c, d)
        };
        let mut quartic = Mat::zeros(pairs.len(), pairs.len());
        for k in 0..pairs.len() {
            for i in k..pairs.len() {
                let value = entry(i, k);
                (quartic[(i, k)], quartic[(k, i)]) = (value, value);
            }
        }
        Ok(ReducedStretching {
            order,
            quartic: Arc::new(quartic),
        })
    }

    /// Number of shapes r.
    pub fn order(&self) -> usize {
        self.order
    }

    /// U₄, in J.
    ///
    /// # Errors
    /// [`StretchingError::Length`].
    pub fn energy_j(&self, coordinates: &Col<f64>) -> Result<f64, StretchingError> {
        Ok(self.energy_with(coordinates, &self.tension(coordinates)?))
    }

    /// ∂U₄/∂p, in N/√kg.
    ///
    /// # Errors
    /// [`StretchingError::Length`].
    pub fn gradient(&self, coordinates: &Col<f64>) -> Result<Col<f64>, StretchingError> {
        Ok(self.gradient_with(coordinates, &self.tension(coordinates)?))
    }

    /// ∂²U₄/∂p², in 1/s², symmetric.
    ///
    /// # Errors
    /// [`StretchingError::Length`].
    pub fn hessian(&self, coordinates: &Col<f64>) -> Result<Mat<f64>, StretchingError> {
        Ok(self.hessian_with(&self.tension(coordinates)?))
    }

    /// [`ReducedStretching::gradient`] at many coordinates, a column each.
    ///
    /// # Errors
    /// [`StretchingError::Length`].
    pub fn gradients(&self, coordinates: &Mat<f64>) -> Result<Mat<f64>, StretchingError> {
        let tensions = &*self.quartic * self.all_products(coordinates)?;
        let mut gradients = Mat::zeros(self.order, coordinates.ncols());
        for (k, mut gradient) in gradients.col_iter_mut().enumerate() {
            let tension = tensions.col(k).to_owned();
            gradient.copy_from(self.gradient_with(&coordinates.col(k).to_owned(), &tension));
        }
        Ok(gradients)
    }

    /// Weighted sums of [`ReducedStretching::hessian`] over many coordinates: one for each column of `weights`, with the columns of the
    /// matrix below each other. The derivatives are linear in the products z, so that these are summed first.
    ///
    /// # Errors
    /// [`StretchingError::Length`].
    pub fn hessian_sums(
        &self,
        coordinates: &Mat<f64>,
        weights: &Mat<f64>,
    ) -> Result<Mat<f64>, StretchingError> {
        let tensions = &*self.quartic * (self.all_products(coordinates)? * weights);
        let mut sums = Mat::zeros(self.order * self.order, weights.ncols());
        for (tension, mut sum) in tensions.col_iter().zip(sums.col_iter_mut()) {
            let hessian = self.hessian_with(&tension.to_owned());
            for j in 0..self.order {
                sum.as_mut()
                    .subrows_mut(j * self.order, self.order)
                    .copy_from(hessian.col(j));
            }
        }
        Ok(sums)
    }

    /// Products z of many coordinates, a column each.
    fn all_products(&self, coordinates: &Mat<f64>) -> Result<Mat<f64>, StretchingError> {
        let mut all = Mat::zeros(self.quartic.nrows(), coordinates.ncols());
        for (p, mut products) in coordinates.col_iter().zip(all.col_iter_mut()) {
            products.copy_from(self.products(&p.to_owned())?);
        }
        Ok(all)
    }

    /// Tension Qz of each pair, with which [`ReducedStretching::energy_with`] and others need no product of order r⁴.
    ///
    /// # Errors
    /// [`StretchingError::Length`].
    pub fn tension(&self, coordinates: &Col<f64>) -> Result<Col<f64>, StretchingError> {
        Ok(&*self.quartic * self.products(coordinates)?)
    }

    /// U₄, in J, with the tension of the same coordinates.
    pub fn energy_with(&self, coordinates: &Col<f64>, tension: &Col<f64>) -> f64 {
        let pairs = pairs(self.order).zip(tension.iter());
        let sum: f64 = pairs
            .map(|([a, b], tension)| coordinates[a] * coordinates[b] * tension)
            .sum();
        0.5 * sum
    }

    /// ∂U₄/∂p, in N/√kg, with the tension of the same coordinates.
    pub fn gradient_with(&self, coordinates: &Col<f64>, tension: &Col<f64>) -> Col<f64> {
        self.symmetric(tension) * coordinates
    }

    /// ∂²U₄/∂p², in 1/s², symmetric, with the tension of the coordinates. The gradient is 2 Σ s_abcd p_b p_c p_d, and its
    /// derivative by p_b is 6 Σ s_abcd p_c p_d.
    pub fn hessian_with(&self, tension: &Col<f64>) -> Mat<f64> {
        Scale(3.0) * self.symmetric(tension)
    }

    /// Products z of the coordinates p.
    fn products(&self, p: &Col<f64>) -> Result<Col<f64>, StretchingError> {
        if p.nrows() != self.order {
            return Err(StretchingError::Length {
                given: p.nrows(),
                expected: self.order,
            });
        }
        let products: Vec<f64> = pairs(self.order).map(|[a, b]| p[a] * p[b]).collect();
        Ok(Col::from_fn(products.len(), |i| products[i]))
    }

    /// Matrix S with S p = Σ tᵢ ∂zᵢ/∂p: the tension t of each pair is at its two positions, twice on the
    /// diagonal.
    fn symmetric(&self, tension: &Col<f64>) -> Mat<f64> {
        let mut matrix = Mat::zeros(self.order, self.order);
        for (i, [a, b]) in pairs(self.order).enumerate() {
            matrix[(a, b)] += tension[i];
            matrix[(b, a)] += tension[i];
        }
        matrix
    }
}

/// Number of times that the product of a pair of coordinates occurs among all products p_a p_b.
fn times(a: usize, b: usize) -> f64 {
    if a == b { 1.0 } else { 2.0 }
}

/// Index of a pair among the products.
fn pair(a: usize, b: usize) -> usize {
    let (more, less) = (a.max(b), a.min(b));
    more * (more + 1) / 2 + less
}

/// Iterates over the pairs a ≥ b in the order of the products.
fn pairs(order: usize) -> impl Iterator<Item = [usize; 2]> {
    (0..order).flat_map(|a| (0..=a).map(move |b| [a, b]))
}
