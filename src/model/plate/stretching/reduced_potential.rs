//! The potential of stretching on a few shapes, as a quadratic form in the products of their coordinates.

use faer::{Col, Mat, MatRef, Scale};
use rayon::prelude::*;

use super::strain::Strain;
use super::{Stretching, StretchingError};

/// [`Stretching`] on r shapes, the columns of V: U₄(V p) = ½ zᵀQz with the r(r+1)/2 products
/// z = (p_a p_b), a ≥ b, and Q symmetric, positive semidefinite.
#[derive(Debug, Clone)]
pub struct ReducedStretching {
    order: usize,
    /// Matrix Q, of order r(r+1)/2, for the pairs (0, 0), (1, 0), (1, 1), (2, 0) …
    quartic: Mat<f64>,
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
        // The product p_a p_b occurs once in the strain for a = b, and twice for a > b, where p_b p_a has the
        // same column. The potential is U₄ = |Z e|².
        let relaxed = Mat::from_fn(height, pairs.len(), |i, k| {
            let [a, b] = pairs[k];
            let times = if a == b { 1.0 } else { 2.0 };
            times * columns[k][i]
        });
        Ok(ReducedStretching {
            order,
            quartic: Scale(2.0) * (relaxed.transpose() * &relaxed),
        })
    }

    /// Number of shapes r.
    pub fn order(&self) -> usize {
        self.order
    }

    /// Q, in 1/(kg m²s²) for shapes in 1/√kg.
    pub fn quartic(&self) -> MatRef<'_, f64> {
        self.quartic.as_ref()
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
        Ok(self.hessian_with(coordinates, &self.tension(coordinates)?))
    }

    /// Tension Qz of each pair, with which [`ReducedStretching::energy_with`] and others need no product of order r⁴.
    ///
    /// # Errors
    /// [`StretchingError::Length`].
    pub fn tension(&self, coordinates: &Col<f64>) -> Result<Col<f64>, StretchingError> {
        Ok(&self.quartic * self.products(coordinates)?)
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

    /// ∂²U₄/∂p², in 1/s², symmetric, with the tension of the same coordinates.
    pub fn hessian_with(&self, coordinates: &Col<f64>, tension: &Col<f64>) -> Mat<f64> {
        let mut hessian = self.symmetric(tension);
        let p = coordinates;
        // The derivative ∂z/∂pₐ of the products z has one nonzero entry for each b, so that Q ∂z/∂pₐ is a sum of r columns of Q. Each
        // column, of the pair (a, b), is read once for both sums of which it is a part, because Q exceeds the cache of a processor.
        let mut tensions = Mat::<f64>::zeros(self.quartic.nrows(), self.order);
        for (k, [a, b]) in pairs(self.order).enumerate() {
            let column = self.quartic.col_as_slice(k);
            for (sum, share) in [(a, p[b]), (b, p[a])] {
                let sums = tensions.col_as_slice_mut(sum).iter_mut();
                for (sum, stiffness) in sums.zip(column) {
                    *sum += share * stiffness;
                }
            }
        }
        for a in 0..self.order {
            let tension = tensions.col_as_slice(a);
            for b in 0..=a {
                let along: f64 = (0..self.order)
                    .map(|c| {
                        let share = if b == c { 2.0 * p[b] } else { p[c] };
                        share * tension[pair(b, c)]
                    })
                    .sum();
                hessian[(a, b)] += along;
                if a != b {
                    hessian[(b, a)] += along;
                }
            }
        }
        hessian
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

/// Index of a pair among the products.
fn pair(a: usize, b: usize) -> usize {
    let (more, less) = (a.max(b), a.min(b));
    more * (more + 1) / 2 + less
}

/// Iterates over the pairs a ≥ b in the order of the products.
fn pairs(order: usize) -> impl Iterator<Item = [usize; 2]> {
    (0..order).flat_map(|a| (0..=a).map(move |b| [a, b]))
}
