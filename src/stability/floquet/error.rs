//! Reasons for which a speed has no Floquet multipliers.

use thiserror::Error;

/// Why the multipliers of a slotted saw were not computed.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum NotComputed {
    /// The blade has no slots.
    #[error("the blade has no slots")]
    Plain,
    /// Factors of its waves stand in place of its slots.
    #[error("blade.wave_factors do not say where the slots are")]
    Unplaced,
    /// Nothing is fixed in space.
    #[error("no guide acts on the blade")]
    Nothing,
    /// A guide has a motion of its own.
    #[error("a guide has {0}, whose own motion they do not contain")]
    Guide(&'static str),
    /// Forces of the cut, or wood, act on the blade.
    #[error("they do not contain the cut")]
    Cut,
    /// Air that does not turn with the blade.
    #[error("they do not contain air that does not turn with the blade")]
    Air,
    /// A slot takes too long to pass.
    #[error(
        "at {rpm:.0} rpm a pitch of the slots takes too many steps of time; from {least_rpm:.0} rpm on they are computed"
    )]
    Slow {
        /// The speed.
        rpm: f64,
        /// The lowest speed that is allowed.
        least_rpm: f64,
    },
    /// A matrix is not finite, or an eigenproblem failed.
    #[error("the numbers of the blade differ too much in size")]
    NotFinite,
}
