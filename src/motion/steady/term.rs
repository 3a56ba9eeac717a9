//! Forces of the balance, evaluated at many deflections.

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

/// A force at some deflections, a column each.
pub(super) fn forces(term: &Term<'_>, deflections: &Mat<f64>) -> Mat<f64> {
    let mut forces = Mat::zeros(deflections.nrows(), deflections.ncols());
    for (deflection, mut column) in deflections.col_iter().zip(forces.col_iter_mut()) {
        let mut force = Col::zeros(deflection.nrows());
        term.force.add_to(&deflection.to_owned(), &mut force);
        column.copy_from(&force);
    }
    forces
}

/// The stiffness of a force at some deflections, a column each, with the columns of the matrix below each other.
pub(super) fn stiffnesses(term: &Term<'_>, deflections: &Mat<f64>) -> Mat<f64> {
    let order = deflections.nrows();
    let mut all = Mat::zeros(order * order, deflections.ncols());
    for (deflection, mut column) in deflections.col_iter().zip(all.col_iter_mut()) {
        let mut own = Mat::zeros(order, order);
        term.force.add_stiffness(&deflection.to_owned(), &mut own);
        column.copy_from(flat(&own));
    }
    all
}

/// The columns of a matrix, one below the other.
pub(super) fn flat(matrix: &Mat<f64>) -> Col<f64> {
    let rows = matrix.nrows();
    Col::from_fn(rows * matrix.ncols(), |i| matrix[(i % rows, i / rows)])
}
