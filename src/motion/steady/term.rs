//! Forces of the balance.

use faer::{Col, Mat};

use crate::motion::transient::Force;

/// A force that depends on the displacement.
#[derive(Clone, Copy)]
pub struct Term<'a> {
    /// The force.
    pub force: &'a dyn Force,
    /// Whether the force is a polynomial of third degree, whose harmonics and those of its derivatives follow from a few times of the
    /// period.
    pub is_cubic: bool,
}

impl Term<'_> {
    /// The share of the force if contact has a share of its stiffness.
    pub(super) fn share(&self, of_contact: f64) -> f64 {
        if self.is_cubic { 1.0 } else { of_contact }
    }
}

/// The columns of a matrix, one below the other.
pub(super) fn flat(matrix: &Mat<f64>) -> Col<f64> {
    let rows = matrix.nrows();
    Col::from_fn(rows * matrix.ncols(), |i| matrix[(i % rows, i / rows)])
}
