//! Minima that the measured frequencies do not tell from the best.

use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use super::least_squares::{Found, Spread};

/// Frequencies that differ by less than this, in Hz, count as equal.
pub const EQUAL_HZ: f64 = 1e-5;

/// Of other minima, best first, those that fit about as well as the best: the sum of squares S is within the region of
/// confidence S ≤ S_min (1 + p/(m − p) F(p, m − p)) of the best (Seber and Wild, *Nonlinear Regression*, 1989, §5.4), or the
/// residuals differ by less than the computation can tell; and a number is farther from the best than the width of its
/// interval.
pub fn equally_good<'a>(
    best: &Found,
    others: &'a [Found],
    spread: &Spread,
    confidence: f64,
) -> Vec<&'a Found> {
    let (free, left) = (best.shares.len() as f64, spread.degrees_of_freedom as f64);
    let Ok(fisher) = FisherSnedecor::new(free, left) else {
        return Vec::new();
    };
    let factor = (1.0 + free / left * fisher.inverse_cdf(confidence)).sqrt();
    let limit_hz = (factor * best.rms_hz).max(best.rms_hz + EQUAL_HZ);
    let is_outside = |found: &Found| {
        let pairs = found.shares.iter().zip(&best.shares);
        let mut widths = pairs.zip(&spread.half_widths);
        widths
            .any(|((share, best), half)| half.is_some_and(|half| (share - best).abs() > 2.0 * half))
    };
    others
        .iter()
        .filter(|found| found.rms_hz <= limit_hz && is_outside(found))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With 22 degrees of freedom and two numbers the region of confidence of 95 % reaches to 1.15 times the least rms:
    /// F(2, 22) = 3.44.
    #[test]
    fn another_minimum_within_the_region_of_confidence_fits_about_as_well() {
        let found = |share: f64, rms_hz: f64| Found {
            shares: vec![share, 0.6],
            rms_hz,
        };
        let spread = Spread {
            half_widths: vec![Some(0.12), None],
            correlation: Vec::new(),
            degrees_of_freedom: 22,
        };
        let best = found(0.4, 0.9);
        let others = [
            found(0.9, 1.14 * 0.9),
            found(0.63, 0.9),
            found(0.9, 1.16 * 0.9),
        ];
        let equal = equally_good(&best, &others, &spread, 0.95);
        assert_eq!(equal.len(), 1);
        assert_eq!(equal[0].rms_hz, others[0].rms_hz);
    }

    /// Two saws with the same frequencies are solved to different numbers of digits.
    #[test]
    fn exact_frequencies_do_not_tell_saws_apart_by_rounding() {
        let found = |share: f64, rms_hz: f64| Found {
            shares: vec![share],
            rms_hz,
        };
        let spread = Spread {
            half_widths: vec![Some(1e-9)],
            correlation: Vec::new(),
            degrees_of_freedom: 3,
        };
        let others = [found(0.8, 3e-7)];
        assert_eq!(
            equally_good(&found(0.2, 1e-9), &others, &spread, 0.95).len(),
            1
        );
    }
}
