//! Checks of modes by counts on the full model, which do not depend on the projection that gave the modes.
//!
//! For an undamped blade L(iω) is Hermitian, and with p modes of Krein sign + and m of sign − between 0 and ω
//!
//! n₋(L(iω)) = n₋(K) + p − m.
//!
//! A count between two modes of opposite sign therefore confirms both, and one above all of them confirms
//! that none is missing. A coalesced pair does not change the count. A + and a − mode that are neighbours
//! change only the count between them.

use std::f64::consts::TAU;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::sample::{Sample, Wave};
use crate::model::scene::rpm;
use crate::modes::{AtSpeed, FullModel, SpectralModel, SpectrumError};

/// Mode counts on the full model of an undamped guided blade.
pub struct ModeCounts<'a> {
    model: &'a SpectralModel,
    basis: &'a FullModel,
    counted: AtomicUsize,
}

/// Modes at a speed that are missing or superfluous according to a count on the full model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "MiscountEntry")]
pub struct MiscountedModes {
    /// The speed.
    pub rpm: f64,
    /// Lower end of the range of frequencies.
    pub from_hz: f64,
    /// Upper end of the range of frequencies.
    pub to_hz: f64,
    /// Number of modes of Krein sign + that the spectrum lacks there, minus that of sign −; negative if it
    /// has superfluous ones.
    pub missing: i64,
}

impl MiscountedModes {
    /// The result of a count at a speed between two frequencies in rad/s.
    pub(super) fn new(speed_rad_per_s: f64, [from, to]: [f64; 2], missing: isize) -> Self {
        MiscountedModes {
            rpm: rpm(speed_rad_per_s),
            from_hz: from / TAU,
            to_hz: to / TAU,
            missing: missing as i64,
        }
    }

    /// Text such as "1 missing between 10.0 and 12.0 Hz".
    pub(crate) fn in_words(&self) -> String {
        let what = if self.missing > 0 {
            "missing"
        } else {
            "too many"
        };
        let (count, from, to) = (self.missing.unsigned_abs(), self.from_hz, self.to_hz);
        format!("{count} {what} between {from:.1} and {to:.1} Hz")
    }
}

/// Count at a frequency, as the modes of a speed imply it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Claim {
    /// ω, in rad/s.
    pub frequency_rad_per_s: f64,
    /// p − m of the modes below that frequency.
    pub net: isize,
}

/// Position of the last count in its gap, as a share: close below the upper mode, so that the count includes
/// nearly all modes below.
const BELOW_UPPER: f64 = 0.9;
/// Smallest relative distance of all waves from a coalesced pair at whose frequency modes are counted.
const CLEAR: f64 = 1e-3;

/// Claims that confirm a sample: below all modes, between modes of opposite sign, and at the frequency of
/// every coalesced pair, ascending, and only below `height_rad_per_s`.
pub(super) fn claims(sample: &Sample, height_rad_per_s: f64) -> Vec<Claim> {
    let waves = sample.waves();
    let mut claims = Vec::new();
    if let Some(lowest) = waves.first() {
        claims.push(Claim {
            frequency_rad_per_s: 0.5 * lowest.frequency,
            net: 0,
        });
    }
    let mut net = 0;
    for (k, pair) in waves.windows(2).enumerate() {
        net += isize::from(pair[0].sign);
        if pair[0].sign != pair[1].sign {
            let share = if k + 2 == waves.len() {
                BELOW_UPPER
            } else {
                0.5
            };
            let low = pair[0].frequency;
            let high = pair[1].frequency.min(height_rad_per_s);
            claims.push(Claim {
                frequency_rad_per_s: low + share * (high - low),
                net,
            });
        }
    }
    for (square, _) in sample.quadruples() {
        let frequency = square.sqrt().im;
        let is_clear = |other: f64| (other / frequency - 1.0).abs() > CLEAR;
        let highest = waves.last().map_or(0.0, |w| w.frequency);
        if frequency < highest && waves.iter().all(|w| is_clear(w.frequency)) {
            let below = waves.iter().filter(|w| w.frequency < frequency);
            claims.push(Claim {
                frequency_rad_per_s: frequency,
                net: below.map(|w| isize::from(w.sign)).sum(),
            });
        }
    }
    claims.retain(|claim| claim.frequency_rad_per_s < height_rad_per_s);
    claims.sort_by(|x, y| x.frequency_rad_per_s.total_cmp(&y.frequency_rad_per_s));
    claims
}

/// Gap between two waves of opposite sign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Gap {
    /// ω and dω/dΩ of the wave below, and of the wave above or of the upper limit.
    pub sides: [(f64, f64); 2],
    /// p − m of the waves below.
    pub net: isize,
}

impl Gap {
    /// Frequency in the middle of the gap, in rad/s.
    pub fn middle_rad_per_s(&self) -> f64 {
        0.5 * (self.sides[0].0 + self.sides[1].0)
    }

    /// Width of the gap, in rad/s.
    pub fn width_rad_per_s(&self) -> f64 {
        self.sides[1].0 - self.sides[0].0
    }
}

/// Gaps between waves of opposite sign up to a height.
pub(super) fn gaps(sample: &Sample, height_rad_per_s: f64) -> Vec<Gap> {
    let mut net = 0;
    let mut gaps = Vec::new();
    for pair in sample.waves().windows(2) {
        net += isize::from(pair[0].sign);
        if pair[0].sign != pair[1].sign {
            let [low, high] = [pair[0], pair[1]].map(
                |Wave {
                     frequency, slope, ..
                 }| (frequency, slope),
            );
            let top = (height_rad_per_s.max(low.0), 0.0);
            let high = if high.0 < top.0 { high } else { top };
            gaps.push(Gap {
                sides: [low, high],
                net,
            });
        }
    }
    gaps
}

impl<'a> ModeCounts<'a> {
    /// Mode counts of a guided blade; `None` for a free one, whose waves are known for each harmonic.
    pub fn new(model: &'a SpectralModel) -> Option<Self> {
        (!model.plate.is_axisymmetric()).then(|| ModeCounts {
            model,
            basis: model.full_model(),
            counted: AtomicUsize::new(0),
        })
    }

    /// Number of conclusive counts so far.
    pub fn counted(&self) -> usize {
        self.counted.load(Ordering::Relaxed)
    }

    /// Whether a count needs a factorization of the order of the basis.
    pub fn is_dense(&self) -> bool {
        self.basis.is_dense()
    }

    /// Number n₋ of negative eigenvalues of K(Ω).
    pub fn negative_stiffness(&self, speed_rad_per_s: f64) -> usize {
        self.model.negative_stiffness_directions(speed_rad_per_s)
    }

    /// Whether rigid motions are free, so that K is singular at every speed and n₋(L(iω)) does not start at
    /// n₋(K).
    pub fn has_free_motions(&self) -> bool {
        self.model.has_free_motions()
    }

    /// Data common to the counts at a speed.
    pub fn at(&self, speed_rad_per_s: f64) -> AtSpeed {
        self.basis.at(speed_rad_per_s)
    }

    /// Whether the count is proven to be `count` along a line between two speeds.
    pub fn is_count_along(&self, ends: [&AtSpeed; 2], line: [f64; 2], count: usize) -> bool {
        self.basis.is_count_along(ends, line, count)
    }

    /// Contradictions between counts and samples of several speeds, up to a height.
    ///
    /// # Errors
    /// [`SpectrumError::Cancelled`].
    pub fn miscounts(
        &self,
        samples: &[&Sample],
        height_rad_per_s: f64,
    ) -> Result<Vec<MiscountedModes>, SpectrumError> {
        let at = |sample: &&Sample| {
            self.model.counters.cancellation.check()?;
            Ok(self.of_claims(sample.speed_rad_per_s, &claims(sample, height_rad_per_s)))
        };
        let found: Vec<Result<Vec<MiscountedModes>, SpectrumError>> =
            samples.par_iter().map(at).collect();
        let all = found.into_iter().collect::<Result<Vec<_>, _>>()?;
        Ok(all.into_iter().flatten().collect())
    }

    /// Compares ascending claims at a speed with counts; inconclusive counts contradict nothing.
    pub fn of_claims(&self, speed_rad_per_s: f64, claims: &[Claim]) -> Vec<MiscountedModes> {
        let negative = self.negative_stiffness(speed_rad_per_s) as isize;
        let begins = (!self.has_free_motions()).then_some(negative);
        let counted = of_claims(self.basis, speed_rad_per_s, claims, begins);
        self.counted.fetch_add(counted.certain, Ordering::Relaxed);
        counted.miscounts
    }
}

/// Result of the comparison of claims with counts.
pub(super) struct Counted {
    /// Number of conclusive counts.
    pub certain: usize,
    /// Counts that contradict the claims.
    pub miscounts: Vec<MiscountedModes>,
}

/// Compares ascending claims with counts; inconclusive counts contradict nothing. `begins` is n₋(K), the
/// count at ω = 0; if it is unknown, the first count is assumed to be right.
pub(super) fn of_claims(
    basis: &FullModel,
    speed_rad_per_s: f64,
    claims: &[Claim],
    begins: Option<isize>,
) -> Counted {
    let at = basis.at(speed_rad_per_s);
    let differences = claims.iter().filter_map(|claim| {
        let frequency = claim.frequency_rad_per_s;
        let count = basis.count_along([&at; 2], [frequency; 2])?;
        Some((frequency, count as isize - claim.net))
    });
    let mut counted = Counted {
        certain: 0,
        miscounts: Vec::new(),
    };
    let mut before = begins.map(|count| (0.0, count));
    for (frequency, difference) in differences {
        counted.certain += 1;
        let (from, last) = before.unwrap_or((frequency, difference));
        if difference != last {
            let missing = difference - last;
            let miscount = MiscountedModes::new(speed_rad_per_s, [from, frequency], missing);
            counted.miscounts.push(miscount);
        }
        before = Some((frequency, difference));
    }
    counted
}
