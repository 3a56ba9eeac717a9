//! Height of a diagram, and the methods that compute its modes.

use faer::c64;

use super::mode::is_seen;

/// Method by which the modes at a speed are computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Strategy {
    /// Waves up to the height of a diagram.
    #[default]
    Reduced,
    /// Without damping those waves alone that can form bands; no diagram is possible.
    Bands,
    /// Every eigenvalue of the full model at every speed: slow, a reference for tests.
    Dense,
}

/// Number of modes that a diagram shows at the lowest speed.
pub(super) const CHART_MODES: usize = 12;
/// Height of a diagram, relative to the highest of these modes.
pub(crate) const ABOVE_LAST: f64 = 1.02;

/// A frequency slightly above that of the twelfth mode, or of the last one if there are fewer, from the
/// eigenvalues of one speed in ascending order. For a damped blade only oscillating modes count; if there are
/// none, |λ| replaces the frequency.
pub(super) fn chart_height(lambdas: &[c64], is_conservative: bool) -> Option<f64> {
    let last = |sizes: Vec<f64>| sizes.get(CHART_MODES - 1).or(sizes.last()).copied();
    let of_seen = lambdas
        .iter()
        .filter(|lambda| is_conservative || is_seen(**lambda))
        .map(|lambda| lambda.im.abs());
    let of_all = lambdas.iter().map(|lambda| lambda.norm());
    last(of_seen.collect())
        .or_else(|| last(of_all.collect()))
        .map(|frequency| ABOVE_LAST * frequency)
}
