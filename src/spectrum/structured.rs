//! K₀ of a guided blade by its structure: blocks of one number of nodal diameters, and few columns.

use faer::{Mat, MatRef};

use super::arnoldi::Inverse;
use super::inertia::UndampedFullModel;
use super::work::Cancellation;
use crate::plate::Plate;
use crate::system::GyroscopicSystem;

/// Below this order one dense factorization costs less.
pub const LARGE: usize = 200;

/// Blocks and columns of K₀, and what solves with them.
#[derive(Debug)]
pub struct StructuredStiffness {
    /// Blocks and columns.
    pub basis: UndampedFullModel,
    /// Nearly K₀⁻¹.
    pub inverse: Inverse,
}

impl StructuredStiffness {
    /// Of a plate that guides hold; `None` where they take too many columns, where loads at the rim
    /// couple every wave with every other, where K₀ is singular, and once the computation was asked to end.
    pub fn of(plate: &Plate) -> Option<Self> {
        Cancellation::current().check().ok()?;
        Self::by(UndampedFullModel::new(plate))
    }

    /// The same to a millionth.
    pub fn nearly(plate: &Plate) -> Option<Self> {
        Self::by(UndampedFullModel::nearly(plate))
    }

    fn by(basis: UndampedFullModel) -> Option<Self> {
        Cancellation::current().check().ok()?;
        let inverse = Inverse::by_blocks(&basis.at_rest()?)?;
        Some(StructuredStiffness { basis, inverse })
    }

    /// K₀⁻¹ X.
    pub fn solve(&self, loads: &Mat<f64>) -> Mat<f64> {
        let mut solved = Mat::zeros(loads.nrows(), loads.ncols());
        for k in 0..loads.ncols() {
            solved
                .col_mut(k)
                .copy_from(self.inverse.times(loads.col(k)));
        }
        solved
    }
}

/// The matrices of a system times the columns of V, by the structure of an undamped blade where that is exact.
pub fn times(
    system: &GyroscopicSystem,
    structure: Option<&UndampedFullModel>,
    basis: MatRef<'_, f64>,
) -> GyroscopicSystem {
    let is_sum = system.is_conservative() && system.free_rigid.is_empty();
    let structure = structure.filter(|structure| is_sum && structure.is_exact());
    let product = structure.and_then(|structure| structure.times(basis));
    product.unwrap_or_else(|| system.times(basis))
}
