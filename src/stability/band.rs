//! Bands of unstable speeds.

use std::f64::consts::TAU;
use std::fmt;

use faer::c64;
use serde::{Deserialize, Serialize};

use super::group::Sloped;
use super::instability_kind::InstabilityKind;
use crate::model::scene::{SpeedRange, rpm};

/// A complex number as a pair of its real and imaginary part.
mod parts {
    use faer::c64;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(number: &c64, to: S) -> Result<S::Ok, S::Error> {
        [number.re, number.im].serialize(to)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<c64, D::Error> {
        let [re, im] = <[f64; 2]>::deserialize(from)?;
        Ok(c64::new(re, im))
    }
}

/// What begins or ends a band.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum BandEnd {
    /// Critical speed: λ passes through zero.
    Critical,
    /// Coalescence of two modes with this λ.
    Coalescence(#[serde(with = "parts")] c64),
    /// Zero of Re λ of a damped blade, or the speed of its smallest value between two bands.
    Growth,
    /// End of the range inside the band.
    Range,
    /// Speed interpolated between others, because no eigenproblem gave it.
    Interpolated,
}

/// Distance of a peak at the end of an undamped band from that end, as a share of the width: at the end itself two real λ have one
/// eigenvector.
pub(super) const BESIDE_END: f64 = 1e-3;

/// A band of unstable speeds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Instability {
    /// Divergence or flutter.
    pub kind: InstabilityKind,
    /// Speed at which the band begins.
    pub from_rad_per_s: f64,
    /// Speed at which the band ends, or the end of the range inside it.
    pub to_rad_per_s: f64,
    /// What begins and ends the band.
    pub ends: [BandEnd; 2],
    /// Whether the band begins and ends within the range.
    pub closed: bool,
    /// Speed of largest growth.
    pub peak_rad_per_s: f64,
    /// Largest growth rate Re λ.
    pub peak_growth_per_s: f64,
    /// Angular frequency at the peak; 0 for divergence.
    pub frequency_rad_per_s: f64,
    /// The growing eigenvalue of a damped blade over the band, at points close enough for cubics between them;
    /// empty for an undamped blade.
    pub curve: Vec<CurvePoint>,
}

/// Writes for instance "flutter 2255.9 to 2266.1 rpm, up to 0.487 1/s at 6.01 Hz".
impl fmt::Display for Instability {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [from, to] = self.range().ends().map(rpm);
        let growth = self.peak_growth_per_s;
        match self.kind {
            InstabilityKind::Divergence => {
                write!(
                    f,
                    "divergence {from:.1} to {to:.1} rpm, up to {growth:.3} 1/s"
                )
            }
            InstabilityKind::Flutter => write!(
                f,
                "flutter {from:.1} to {to:.1} rpm, up to {growth:.3} 1/s at {:.2} Hz",
                self.frequency_rad_per_s / TAU
            ),
        }
    }
}

/// An eigenvalue at one speed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CurvePoint {
    /// Rotation speed Ω.
    pub speed_rad_per_s: f64,
    /// The number that a search follows: λ with Im λ ≥ 0 of a damped blade, λ² of an undamped one.
    #[serde(with = "parts")]
    pub number: c64,
    /// Derivative of the number with respect to the speed.
    #[serde(with = "parts")]
    pub slope: c64,
}

impl CurvePoint {
    /// A number with its slope at a speed.
    pub(super) fn new(speed_rad_per_s: f64, (number, slope): Sloped) -> Self {
        CurvePoint {
            speed_rad_per_s,
            number,
            slope,
        }
    }
}

impl Instability {
    /// Speeds of the band.
    pub fn range(&self) -> SpeedRange {
        SpeedRange::new(self.from_rad_per_s, self.to_rad_per_s)
    }

    /// The end, with its λ, beside which growth is largest because two real λ coalesce there: flutter beside divergence.
    pub(super) fn real_peak(&self) -> Option<(f64, c64)> {
        if self.kind == InstabilityKind::Divergence {
            return None;
        }
        self.ends_at_peak().find_map(|(speed, end)| match end {
            BandEnd::Coalescence(lambda) if lambda.im == 0.0 => Some((speed, lambda)),
            _ => None,
        })
    }

    /// The ends beside which growth is largest.
    pub(super) fn ends_at_peak(&self) -> impl Iterator<Item = (f64, BandEnd)> {
        let ends = self.range().ends().into_iter().zip(self.ends);
        let away = |speed: f64| (speed - self.peak_rad_per_s).abs() / self.range().width();
        ends.filter(move |(speed, _)| away(*speed) <= 2.0 * BESIDE_END)
    }

    /// Whether the band counts as an instability of the saw. Damping that the scene does not model suppresses
    /// flutter that grows more slowly than the threshold (1/s); divergence always counts.
    pub fn counts(&self, threshold_per_s: f64) -> bool {
        self.kind == InstabilityKind::Divergence || self.peak_growth_per_s >= threshold_per_s
    }
}
