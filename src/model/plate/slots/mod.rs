//! Slots of the rim: bending stiffness of a slotted blade relative to a plain one, and its stress in rotation.
//!
//! A blade with N radial slots of width zero and depth L from the rim is a Kirchhoff plate with cuts. Its bending is computed at
//! rest, by conforming elements of Bogner, Fox and Schmit on half a pitch, with the symmetry of waves (`symmetry`), and gives for
//! each number n of nodal diameters the ratio c_n of ω² to that of the plain blade (`waves`); pairs with 2n a multiple of N
//! split into two branches. The stress of rotation is that of a plane with the same cuts, of which the mean around the circle is
//! taken (`stress`): slot faces carry no traction, so that the mean stresses fulfil the axisymmetric equilibrium.
//!
//! The blade of the analysis remains axisymmetric, with c_n K_b of the lower branch, or of another [`SplitBranch`], in place of K_b, and
//! the mean stress in K_σ. Measured against a plate with cuts that turns, critical speeds of n = 2 to 5 are within 0.7 %
//! (docs/explanation/model.md).
//!
//! Beside guides, which are fixed in space while slots turn, the modes of the slotted blade itself are needed, in its own frame and in its
//! own stress (`turning`).
//!
//! References: F. K. Bogner, R. L. Fox & L. A. Schmit, *The generation of interelement-compatible stiffness and mass matrices by the
//! use of interpolation formulae*, Proc. Conf. Matrix Methods in Structural Mechanics, 1965, 397–443; D. L. Thomas, *Dynamics of
//! rotationally periodic structures*, Int. J. Numer. Meth. Eng. 14 (1979), 81–102.

mod chain;
mod elements;
mod krylov;
mod mesh;
mod plane;
mod stress;
mod symmetry;
mod turning;
mod turning_circle;
mod waves;

use std::sync::{Arc, Mutex, PoisonError};

use crate::model::scene::{Blade, Slots, SplitBranch};
use mesh::Mesh;
use plane::PlaneStress;
pub use stress::MeanStress;
pub use turning::{TurningBlade, TurningMode, TurningModes};
pub use turning_circle::TurningCircle;
pub use waves::Branch;
use waves::Slotted;

/// Blades kept, so that scenes that differ in other things share the work.
const KEPT: usize = 16;

/// Bending stiffness and stress of a slotted blade.
#[derive(Debug, Clone, PartialEq)]
pub struct SlottedBlade {
    /// The mean around of the stress of rotation.
    pub stress: MeanStress,
    /// Branches by number of nodal diameters n = 0, 1, …, ascending in c_n; not a number if the numbers of the blade differ too much
    /// in size.
    pub waves: Vec<Vec<Branch>>,
    /// Smallest c_n of these, which takes the place of those that are not computed.
    beyond: f64,
}

impl SlottedBlade {
    /// The slots of a blade; `None` if it has none. The blades computed last are kept.
    pub fn of(blade: &Blade) -> Option<Arc<Self>> {
        static LAST: Mutex<Vec<(Blade, Arc<SlottedBlade>)>> = Mutex::new(Vec::new());
        let slots = blade.slots?;
        let blade = &Blade {
            split_branch: SplitBranch::default(),
            ..*blade
        };
        let last = || LAST.lock().unwrap_or_else(PoisonError::into_inner);
        let known = last()
            .iter()
            .find(|(own, _)| own == blade)
            .map(|(_, slotted)| slotted.clone());
        Some(known.unwrap_or_else(|| {
            let slotted = Arc::new(Self::new(blade, &slots));
            let mut last = last();
            last.truncate(KEPT - 1);
            last.insert(0, (*blade, slotted.clone()));
            slotted
        }))
    }

    fn new(blade: &Blade, slots: &Slots) -> Self {
        let (mesh, most) = Mesh::of(blade, slots);
        let found = Slotted::new(blade, &mesh, slots.count).branches(most);
        let mut waves: Vec<Vec<Branch>> = found.into_iter().map(|(_, branches)| branches).collect();
        if waves.len() <= most {
            let unknown = Branch {
                bending: f64::NAN,
                share: f64::NAN,
            };
            waves = vec![vec![unknown]; most + 1];
        }
        (waves.iter_mut()).for_each(|own| own.sort_by(|x, y| x.bending.total_cmp(&y.bending)));
        let lowest = waves.iter().filter_map(|own| own.first());
        SlottedBlade {
            stress: MeanStress::new(&PlaneStress::new(blade, &mesh)),
            beyond: lowest.map(|branch| branch.bending).fold(f64::NAN, f64::min),
            waves,
        }
    }

    /// c_n of the lower branch; for more diameters than were computed, the smallest one of all.
    pub fn bending(&self, diameters: usize) -> f64 {
        self.bending_on(diameters, SplitBranch::Lower)
    }

    /// c_n of a branch; for more diameters than were computed, the smallest one of all.
    pub(crate) fn bending_on(&self, diameters: usize, branch: SplitBranch) -> f64 {
        match (self.waves.get(diameters).map(Vec::as_slice), branch) {
            (Some([lower, .., upper]), SplitBranch::Mean) => 0.5 * (lower.bending + upper.bending),
            (Some([.., upper]), SplitBranch::Upper) => upper.bending,
            (Some([lower, ..]), _) => lower.bending,
            _ => self.beyond,
        }
    }

    /// Largest ratio of frequencies of both branches of a pair, on up to so many diameters; 1 if none is split.
    pub(crate) fn widest_split(&self, most_diameters: usize) -> f64 {
        let ratios = self.waves.iter().take(most_diameters + 1).skip(2);
        let ratios = ratios.filter_map(|own| match own.as_slice() {
            [lower, .., upper] => Some((upper.bending / lower.bending).sqrt()),
            _ => None,
        });
        ratios.fold(1.0, f64::max)
    }

    /// Number of nodal diameters from which on c_n is the same for all.
    pub fn even_from(&self) -> usize {
        self.waves.len()
    }
}
