//! Rigid heads on which guide pads stand, held by their arms.
//!
//! A head of mass m moves by h across the plane of the blade and is fixed in space otherwise. Its unknown √m h follows the radial
//! functions of n = 0 nodal diameters: neither turns with the blade, so that rotation acts on neither. The arm's stiffness k gives it
//! the stiffness k/m; the pad couples it with the blade.

use nalgebra::DMatrix;

use super::harmonic::HarmonicBlock;
use crate::model::scene::{Guide, GuideArmFile};

/// A rigid head with mass.
#[derive(Debug, Clone, Copy)]
pub struct Head {
    /// Index of the guide in the list of the scene.
    pub(super) guide: usize,
    /// The arm that holds the head.
    pub(super) arm: GuideArmFile,
}

impl Head {
    /// The heads of the guides whose arms have a mass.
    pub(super) fn of(guides: &[Guide]) -> Vec<Self> {
        let heads = guides.iter().filter_map(|guide| {
            let arm = guide.typed.arm.filter(|arm| arm.mass_kg > 0.0)?;
            Some(Head {
                guide: guide.index,
                arm,
            })
        });
        heads.collect()
    }
}

/// Adds the unknowns of heads, and of internal states of pads, to the block of no nodal diameters. The air resists the blade alone.
pub(super) fn stand(heads: &[Head], states: usize, blocks: &mut [HarmonicBlock]) {
    if heads.len() + states == 0 {
        return;
    }
    for block in blocks.iter_mut() {
        let size = block.bending.nrows();
        let area = block.area.take();
        block.area = Some(area.unwrap_or_else(|| DMatrix::identity(size, size)));
    }
    let block = &mut blocks[0];
    let radial = block.bending.nrows();
    let size = radial + heads.len() + states;
    let optional = [
        &mut block.membrane,
        &mut block.material_damping,
        &mut block.area,
    ];
    let optional = optional.into_iter().filter_map(|matrix| matrix.as_mut());
    for matrix in [&mut block.bending, &mut block.spin]
        .into_iter()
        .chain(optional)
    {
        *matrix = std::mem::take(matrix).resize(size, size, 0.0);
    }
    for (head, unknown) in heads.iter().zip(radial..) {
        block.bending[(unknown, unknown)] = head.arm.stiffness_n_per_m / head.arm.mass_kg;
    }
}
