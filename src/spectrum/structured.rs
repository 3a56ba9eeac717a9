//! K₀ of a guided blade by its structure: blocks of one number of nodal diameters, and few columns.

use faer::MatRef;

use super::full_model::{Elimination, FullModel};
use super::work::Cancellation;
use crate::plate::Plate;
use crate::system::GyroscopicSystem;

/// Below this order one dense factorization costs less.
pub const LARGE: usize = 200;

/// Blocks and columns of K₀, and what solves with them.
#[derive(Debug)]
pub struct StructuredStiffness {
    /// Blocks and columns.
    pub full: FullModel,
    /// K₀, nearly.
    pub at_rest: Elimination<f64>,
}

impl StructuredStiffness {
    /// Of a plate that guides hold; `None` where they take too many columns, where loads at the rim
    /// couple every wave with every other, where K₀ is singular, and once the computation was asked to end.
    pub fn of(plate: &Plate) -> Option<Self> {
        Cancellation::current().check().ok()?;
        Self::by(FullModel::new(plate))
    }

    /// The same to a millionth.
    pub fn nearly(plate: &Plate) -> Option<Self> {
        Self::by(FullModel::nearly(plate))
    }

    fn by(full: FullModel) -> Option<Self> {
        Cancellation::current().check().ok()?;
        let at_rest = full.eliminated_at_rest()?;
        Some(StructuredStiffness { full, at_rest })
    }
}

/// The matrices of a system times the columns of V, by the structure of an undamped blade where that is exact.
pub fn times(
    system: &GyroscopicSystem,
    structure: Option<&FullModel>,
    basis: MatRef<'_, f64>,
) -> GyroscopicSystem {
    let is_sum = system.is_conservative() && system.free_rigid.is_empty();
    let structure = structure.filter(|structure| is_sum && structure.is_exact());
    let product = structure.and_then(|structure| structure.times(basis));
    product.unwrap_or_else(|| system.times(basis))
}
