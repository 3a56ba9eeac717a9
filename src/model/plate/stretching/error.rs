//! Reasons for which the potential of stretching, or its value, cannot be computed.

/// Reason for which the potential of stretching, or its value, could not be computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum StretchingError {
    /// The deflection belongs to another basis.
    #[error(
        "the deflection has {given} coordinates, the basis {expected} functions; give one coordinate for each"
    )]
    Length {
        /// Number of given coordinates.
        given: usize,
        /// Number of required coordinates.
        expected: usize,
    },
    /// The numbers differ too much in size.
    #[error(
        "the in-plane stiffness of the blade for {harmonic} waves is not finite; the scene's numbers differ too much in size"
    )]
    NotFinite {
        /// Number m of waves around the circle.
        harmonic: usize,
    },
}
