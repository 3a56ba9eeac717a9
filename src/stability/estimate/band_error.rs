//! Estimated errors of a band.

use crate::stability::band::{BandEnd, Instability};
use crate::stability::basis::REMAINDER;
use crate::stability::instability_kind::InstabilityKind;

/// Factor for the estimated errors of growth rates, which converge less evenly than speeds: on twelve random
/// saws the true error was up to 2.9 times the estimate without the factor.
const GROWTH_REMAINDER: f64 = 3.0;
/// Share of the error of a critical speed that the difference of two critical speeds has even if the
/// estimated errors of both cancel. Of 176 bands of random saws, two (narrower than a hundredth of their
/// speed) had errors of growth that correspond to a share of 0.07. A band of flutter that ends in divergence is such a difference, too:
/// of twelve on a saw with a soft pad, the narrowest, 8e-5 of its speed, had 1.5 times the error that was estimated without this share.
const WIDTH_REMAINDER: f64 = 0.1;

/// Estimated errors of a band; `None` if the larger basis gives no estimate.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct BandError {
    /// Relative error of the onset and the end, the larger of both.
    pub speed: Option<f64>,
    /// Relative error of the largest growth rate.
    pub growth: Option<f64>,
}

impl BandError {
    /// Errors of a band, from the changes by the larger basis. A band is the coalescence of two waves whose
    /// errors may cancel by chance, so the error of the critical speeds is added. Relative to the width of
    /// the band, its edges are no more accurate than its growth, unless growth is largest at an edge: its error is then that of
    /// the place of this edge.
    pub fn of(self, band: &Instability, critical: f64) -> Self {
        // The width is taken relative to the end, because a band may begin at rest.
        let width = band.range().width() / band.to_rad_per_s;
        let is_real = band.kind == InstabilityKind::Divergence || band.real_peak().is_some();
        let of_width = if is_real {
            WIDTH_REMAINDER * critical / width
        } else {
            0.0
        };
        let growth = self
            .growth
            .map(|difference| GROWTH_REMAINDER * difference + 2.0 * critical + of_width);
        let follows_an_edge = band.ends_at_peak().any(|(_, end)| end != BandEnd::Range);
        let by_growth = if follows_an_edge {
            0.0
        } else {
            2.0 * growth.unwrap_or(0.0) * width
        };
        BandError {
            speed: self
                .speed
                .map(|change| REMAINDER.get() * change + critical + by_growth),
            growth,
        }
    }
}

/// Magnitude of a relative difference, if it is finite.
pub fn magnitude(difference: f64) -> Option<f64> {
    difference.is_finite().then_some(difference.abs())
}

#[cfg(test)]
mod tests {
    use faer::c64;

    use super::*;

    /// Flutter of a blade with six slow films begins where two real λ coalesce, and its growth is largest there. On a basis with twice the
    /// unknowns this speed is 1.3e-4 of itself lower, while the growth beside it changes by a fifth.
    #[test]
    fn growth_that_follows_an_edge_does_not_widen_its_error() {
        let band = |peak_rad_per_s: f64| Instability {
            kind: InstabilityKind::Flutter,
            from_rad_per_s: 518.0,
            to_rad_per_s: 796.0,
            ends: [BandEnd::Coalescence(c64::new(11.6, 0.0)), BandEnd::Range],
            closed: false,
            peak_rad_per_s,
            peak_growth_per_s: 11.6,
            frequency_rad_per_s: 0.0,
            curve: Vec::new(),
        };
        let changes = BandError {
            speed: Some(1e-5),
            growth: Some(0.07),
        };
        let of = |peak: f64| changes.of(&band(peak), 4.2e-4).speed.unwrap();
        assert!((1.3e-4..1e-3).contains(&of(518.0)), "{}", of(518.0));
        assert!(of(600.0) > 0.1, "{}", of(600.0));
        assert!(of(796.0) > 0.1, "{}", of(796.0));
    }
}
