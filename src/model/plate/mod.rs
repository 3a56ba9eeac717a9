//! Matrices of the spinning plate and of its contacts and loads.
//!
//! A [`Scene`](crate::model::scene::Scene) and a [`Resolution`], the size of the basis, give a [`Plate`], the matrices of the scene in
//! this basis. This module solves no eigenvalue problem.
//!
//! The deflection of a Kirchhoff plate on a < r < b is w(r, θ, t) = Σ qᵢ(t) φᵢ(r, θ) in the frame fixed in
//! space, with φ = R_nj(r)·{cos nθ, sin nθ}/√(ρh₀ π(1+δ_n0)) in 1/√kg and the reference thickness h₀, so that
//! the mass matrix ∫ φᵢφⱼ dm is the identity; q is in √kg·m. The N = J(2 n_max + 1) unknowns are J cosines for
//! n = 0, then J cosines and J sines for each n ≥ 1. With M = 1 every stiffness is in 1/s² and every damping
//! in 1/s.
//!
//! References: Timoshenko & Woinowsky-Krieger, *Theory of Plates and Shells*, 2nd ed., chapters 3 and 9, for
//! the plate; C. D. Mote, *Free vibration of initially stressed circular disks*, J. Eng. Ind. 87 (1965),
//! 258–264, for stress in its plane; W. D. Iwan & T. L. Moeller, J. Appl. Mech. 43 (1976), 485–490, for loads
//! fixed in space.

mod assembly;
mod contact;
mod edge_load;
mod harmonic;
mod head;
mod in_plane;
mod light_gap;
mod matrices;
mod membrane;
mod pad_state;
mod quadrature;
mod radial;
mod resolution;
mod slots;
mod stress;
mod stretching;
mod wave_ratio;

pub use contact::{Contact, ContactTerms};
pub(crate) use contact::{GapPotential, PadPoint, pad_force, pad_points};
#[doc(hidden)]
pub use edge_load::{BoreForce, EdgeStress, RimForce, edge_stiffness};
#[doc(hidden)]
pub use harmonic::HarmonicBlock;
pub use light_gap::{LightGap, LightGapError, StraightEdgeReading};
pub use matrices::Plate;
pub(crate) use membrane::{MembraneSource, MembraneStress, heated_disk, membrane_stiffness};
pub use resolution::Resolution;
pub(crate) use resolution::{MOST_DIAMETERS, MOST_UNKNOWNS};
#[doc(hidden)]
pub use slots::{
    Branch as SlottedBranch, MeanStress, SlottedBlade, TurningBlade, TurningCircle, TurningMode,
    TurningModes,
};
pub use stretching::{ReducedStretching, Stretching, StretchingError};

#[cfg(test)]
mod tests;
