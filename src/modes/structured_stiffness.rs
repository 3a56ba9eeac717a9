//! K₀ of a guided blade by its structure: one block for each number of nodal diameters, and few columns.

use faer::MatRef;

use super::full_model::{Elimination, FullModel};
use super::work::Cancellation;
use crate::model::plate::Plate;
use crate::model::system::GyroscopicSystem;

/// Below this order a dense factorization costs less than one by blocks and columns.
pub const LARGE: usize = 200;

/// Blocks and columns of K₀, and its factorization.
#[derive(Debug)]
pub struct StructuredStiffness {
    /// Blocks and columns of the full model.
    pub full: FullModel,
    /// Factorization of K₀.
    pub at_rest: Elimination<f64>,
}

impl StructuredStiffness {
    /// The structure of a plate on guides; `None` if the guides need too many columns, if loads at the rim
    /// couple all waves, if K₀ is singular, or if the computation was cancelled.
    pub fn of(plate: &Plate) -> Option<Self> {
        Cancellation::current().check().ok()?;
        Self::by(FullModel::new(plate))
    }

    /// The structure as from [`StructuredStiffness::of`], accurate to a millionth.
    pub fn nearly(plate: &Plate) -> Option<Self> {
        Self::by(FullModel::nearly(plate))
    }

    fn by(full: FullModel) -> Option<Self> {
        Cancellation::current().check().ok()?;
        let at_rest = full.eliminated_stiffness(0.0)?;
        Some(StructuredStiffness { full, at_rest })
    }
}

/// The matrices of a system times the columns of V, by the structure of an undamped blade if it is exact.
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
