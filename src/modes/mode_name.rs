//! Name of a mode: nodal diameters, nodal circles, and direction.

use faer::{Col, c64};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::model::plate::Plate;

use super::mode::{Mode, ModeKind};
use super::wave::{Wave, square};

/// Direction in which a wave runs, seen from space.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Direction {
    /// With the rotation.
    Forward,
    /// Against the rotation.
    Backward,
    /// Against the rotation on the blade, but carried forward in space: a backward wave above its critical
    /// speed.
    Reflected,
    /// In neither direction: without nodal diameters, or with similar amplitudes in both directions.
    Standing,
}

impl Direction {
    /// Direction of the wave on the blade, where a reflected wave is a backward one.
    pub fn on_blade(self) -> Self {
        match self {
            Direction::Reflected => Direction::Backward,
            other => other,
        }
    }

    /// The direction as a word after a separator; empty for a standing wave.
    pub(super) fn ending(self, separator: &str) -> String {
        let word = match self {
            Direction::Forward => "forward",
            Direction::Backward => "backward",
            Direction::Reflected => "reflected",
            Direction::Standing => return String::new(),
        };
        format!("{separator}{word}")
    }
}

/// Share of the waves of n nodal diameters in the name of a mode, by kinetic energy, or of an event, by the weights
/// of its waves. There is no other measure of a harmonic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HarmonicShare {
    /// Number n of nodal diameters.
    pub diameters: usize,
    /// Nodal circles of the radial profile; 0 in a mode if the share is below a thousandth.
    pub circles: usize,
    /// Share, between 0 and 1.
    pub share: f64,
}

/// Name of a mode.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeName {
    /// Nodal diameters of the dominant harmonic.
    pub diameters: usize,
    /// Nodal circles of the dominant harmonic.
    pub circles: usize,
    /// Direction of the whole motion in space.
    pub direction: Direction,
    /// Shares of all harmonics, largest first.
    pub harmonics: Vec<HarmonicShare>,
    /// Share of the heads of guide arms in the kinetic energy, beside those of the harmonics; zero without arms.
    pub head_share: f64,
    /// Whether the stronger wave of the dominant harmonic runs forward in space.
    pub runs_forward: bool,
}

/// A motion is a standing wave if the squared amplitudes of all forward and of all backward waves differ by less
/// than this share of their sum: the larger is less than twice the smaller.
pub(super) const STANDING: f64 = 1.0 / 3.0;
/// A harmonic with this share of the energy names the mode alone.
const DOMINANT: f64 = 2.0 / 3.0;
/// Harmonics are named until their shares reach this sum.
const NAMED_SHARE: f64 = 0.75;
/// Largest number of harmonics in a name.
const MOST_NAMED: usize = 3;
/// Nodal circles of a harmonic with a smaller share of the energy are not counted.
const COUNTED: f64 = 1e-3;

impl ModeName {
    /// Names a mode from its coordinates q in the basis of the plate.
    pub fn new(plate: &Plate, mode: &Mode, q: &Col<c64>, speed_rad_per_s: f64) -> Self {
        let waves: Vec<Wave> = (0..=plate.max_diameters())
            .map(|n| Wave::new(plate, mode.lambda, q, n, speed_rad_per_s))
            .collect();
        let heads = plate.heads().map(|unknown| q[unknown].norm_sqr());
        let of_heads = mode.lambda.norm_sqr() * heads.sum::<f64>();
        let total = of_heads + waves.iter().map(Wave::energy).sum::<f64>();
        let mut harmonics: Vec<HarmonicShare> = waves
            .iter()
            .map(|wave| HarmonicShare {
                diameters: wave.diameters,
                circles: 0,
                share: wave.energy() / total.max(f64::MIN_POSITIVE),
            })
            .collect();
        harmonics.sort_by(|x, y| y.share.total_cmp(&x.share));
        for (place, harmonic) in harmonics.iter_mut().enumerate() {
            if place == 0 || harmonic.share >= COUNTED {
                harmonic.circles = waves[harmonic.diameters].circles(plate);
            }
        }
        let wave = &waves[harmonics[0].diameters];
        ModeName {
            diameters: wave.diameters,
            circles: harmonics[0].circles,
            direction: direction(&waves, wave, mode),
            harmonics,
            head_share: of_heads / total.max(f64::MIN_POSITIVE),
            runs_forward: wave.runs_forward(),
        }
    }

    /// The name for another mode of the same waves: without damping its Krein sign tells whether it is reflected.
    pub(super) fn of_same_waves(&self, mode: &Mode) -> Self {
        let direction = match (mode.kind, self.direction) {
            (ModeKind::Damped, direction) => direction,
            (ModeKind::Negative, _) => Direction::Reflected,
            (_, direction) => direction.on_blade(),
        };
        ModeName {
            direction,
            ..self.clone()
        }
    }

    /// Frequency of the dominant harmonic in the body frame, |ω − nΩ| of a wave that runs forward in space and ω + nΩ of one that
    /// runs backward, in rad/s.
    pub fn body_frequency_rad_per_s(&self, mode: &Mode, speed_rad_per_s: f64) -> f64 {
        let (omega, carried) = (
            mode.frequency_rad_per_s(),
            self.diameters as f64 * speed_rad_per_s,
        );
        if self.runs_forward {
            (omega - carried).abs()
        } else {
            omega + carried
        }
    }

    /// "1 diameter", or the shares of the harmonics if none dominates: "0 (54 %) + 1 (45 %)"; "0/1" is one
    /// circle without diameters. "guide arm" is a motion of heads.
    pub fn in_shares(&self) -> String {
        self.named(
            MOST_NAMED,
            "guide arm",
            in_words(self.diameters, self.circles, Direction::Standing),
        )
    }

    fn named(&self, most: usize, arm: &str, wave: String) -> String {
        if self.head_share >= DOMINANT {
            return arm.to_owned();
        }
        mixed(&self.harmonics, self.head_share, most).unwrap_or(wave)
    }

    /// Share of n nodal diameters, between 0 and 1.
    pub fn share(&self, diameters: usize) -> f64 {
        share_of(&self.harmonics, diameters)
    }

    /// Short form: "1", "0/1", "0 (54 %) + 1 (45 %)".
    pub fn in_short(&self) -> String {
        self.named(2, "arm", short(self.diameters, self.circles))
    }
}

/// Share of n nodal diameters; zero if they are not listed.
pub(super) fn share_of(harmonics: &[HarmonicShare], diameters: usize) -> f64 {
    let mut harmonics = harmonics.iter();
    let found = harmonics.find(|h| h.diameters == diameters);
    found.map_or(0.0, |h| h.share)
}

/// At most `most` harmonics with their shares, largest first, and that of the heads of guide arms if it is as large; `None` if a
/// harmonic dominates.
pub(super) fn mixed(harmonics: &[HarmonicShare], heads: f64, most: usize) -> Option<String> {
    if harmonics.first().is_none_or(|h| h.share >= DOMINANT) {
        return None;
    }
    let harmonics = harmonics.iter().take(most);
    let mut parts: Vec<(f64, String)> = harmonics
        .map(|h| (h.share, short(h.diameters, h.circles)))
        .collect();
    let place = parts.partition_point(|(share, _)| *share >= heads);
    parts.insert(place, (heads, "arm".to_owned()));
    let mut named = 0.0;
    let mut terms = Vec::new();
    for (share, name) in parts.into_iter().take(most) {
        if named >= NAMED_SHARE || share == 0.0 {
            break;
        }
        named += share;
        terms.push(format!("{name} ({:.0} %)", 100.0 * share));
    }
    Some(terms.join(" + "))
}

/// Number of nodal diameters, with nodal circles after a slash: "2", "2/1".
pub(super) fn short(diameters: usize, circles: usize) -> String {
    match circles {
        0 => format!("{diameters}"),
        _ => format!("{diameters}/{circles}"),
    }
}

/// Direction of the whole motion in space. Each pair of waves e^{i(ωt ∓ nθ)} is weighted by its squared
/// amplitudes, because the energy of a standing wave in space is mostly that of its backward half, against
/// which the material moves.
fn direction(waves: &[Wave], dominant: &Wave, mode: &Mode) -> Direction {
    let [mut forward, mut backward, mut all] = [0.0; 3];
    for wave in waves {
        let squares = [square(&wave.forward), square(&wave.backward)];
        all += squares[0] + squares[1];
        if wave.diameters > 0 {
            forward += squares[0];
            backward += squares[1];
        }
    }
    let has_negative_energy =
        mode.kind == ModeKind::Negative || (mode.kind == ModeKind::Damped && mode.action < 0);
    if has_negative_energy {
        Direction::Reflected
    } else if (forward - backward).abs() < STANDING * all {
        Direction::Standing
    } else if backward > forward {
        Direction::Backward
    } else if dominant.body_frequency(mode) < 0.0 {
        // The dominant wave travels forward in space and backward on the blade, as a reflected wave does, but
        // the energy of the whole motion is positive: other waves outweigh it.
        Direction::Standing
    } else {
        Direction::Forward
    }
}

/// Name of a wave in words, such as "2 diameters, 1 circle, backward".
pub fn in_words(diameters: usize, circles: usize, direction: Direction) -> String {
    let count = |number: usize, noun: &str| match number {
        1 => format!("1 {noun}"),
        _ => format!("{number} {noun}s"),
    };
    let mut words = count(diameters, "diameter");
    if circles > 0 {
        words += &format!(", {}", count(circles, "circle"));
    }
    words + &direction.ending(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_singular_and_plural_where_they_should() {
        assert_eq!(in_words(1, 0, Direction::Forward), "1 diameter, forward");
        assert_eq!(in_words(0, 1, Direction::Standing), "0 diameters, 1 circle");
    }
}
