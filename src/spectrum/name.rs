//! What to call a mode: nodal diameters, nodal circles, and how it runs.

use faer::{Col, c64};
use serde::{Deserialize, Serialize};

use crate::plate::Plate;

use super::mode::{Mode, ModeKind};

/// How a wave runs, seen from space.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Direction {
    /// With the rotation.
    Forward,
    /// Against the rotation.
    Backward,
    /// Against the rotation on the blade, but carried forward in space: a backward
    /// wave past its critical speed.
    Reflected,
    /// Neither: no nodal diameters, or as much of both.
    Standing,
}

/// Share of n nodal diameters in the kinetic energy of a mode.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HarmonicShare {
    /// n.
    pub diameters: usize,
    /// Between 0 and 1.
    pub share: f64,
}

/// Name of a mode.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeName {
    /// Nodal diameters of the dominant harmonic.
    pub diameters: usize,
    /// Nodal circles of the dominant harmonic.
    pub circles: usize,
    /// How the dominant harmonic runs in space.
    pub direction: Direction,
    /// Shares of all harmonics, largest first.
    pub harmonics: Vec<HarmonicShare>,
    /// Frequency of the dominant harmonic seen from the blade, in rad/s.
    pub body_frequency_rad_per_s: f64,
}

/// Waves whose energies differ by less than this share make a standing wave.
const STANDING: f64 = 0.2;
/// A sign change of the radial profile counts where it leaves this share of its peak.
const CIRCLE: f64 = 0.03;

impl ModeName {
    /// Names a mode from its coordinates q in the basis of the plate.
    pub fn new(plate: &Plate, mode: &Mode, q: &Col<c64>, speed_rad_per_s: f64) -> Self {
        let waves: Vec<Wave> = (0..=plate.max_diameters())
            .map(|n| Wave::new(plate, mode.lambda, q, n, speed_rad_per_s))
            .collect();
        let total: f64 = waves.iter().map(Wave::energy).sum();
        let mut harmonics: Vec<HarmonicShare> = waves
            .iter()
            .map(|wave| HarmonicShare {
                diameters: wave.diameters,
                share: wave.energy() / total.max(f64::MIN_POSITIVE),
            })
            .collect();
        harmonics.sort_by(|x, y| y.share.total_cmp(&x.share));
        let wave = &waves[harmonics[0].diameters];
        ModeName {
            diameters: wave.diameters,
            circles: wave.circles(plate),
            direction: wave.direction(mode),
            harmonics,
            body_frequency_rad_per_s: wave.body_frequency(mode).abs(),
        }
    }

    /// How the wave runs on the blade, where a reflected wave is a backward one.
    pub fn direction_on_blade(&self) -> Direction {
        match self.direction {
            Direction::Reflected => Direction::Backward,
            other => other,
        }
    }
}

/// "2 diameters, 1 circle, backward".
pub fn in_words(diameters: usize, circles: usize, direction: Direction) -> String {
    let count = |number: usize, noun: &str| match number {
        1 => format!("1 {noun}"),
        _ => format!("{number} {noun}s"),
    };
    let mut words = count(diameters, "diameter");
    if circles > 0 {
        words += &format!(", {}", count(circles, "circle"));
    }
    match direction {
        Direction::Forward => words + ", forward",
        Direction::Backward => words + ", backward",
        Direction::Reflected => words + ", reflected",
        Direction::Standing => words,
    }
}

/// One harmonic, split into the two waves e^{i(ωt − nθ)} and e^{i(ωt + nθ)}.
///
/// Their weight is the kinetic energy of the lateral motion, in which the material
/// moves at Dw/Dt = (λ + Ω∂θ)w. Of a standing wave in space, where ∂w/∂t says
/// nothing, it is the n² that a rigid tilt would otherwise outweigh.
struct Wave {
    diameters: usize,
    carried: f64,
    forward: Vec<c64>,
    backward: Vec<c64>,
    forward_energy: f64,
    backward_energy: f64,
}

impl Wave {
    /// q_c cos nθ + q_s sin nθ has (q_c + i q_s)/2 on e^{−inθ}, (q_c − i q_s)/2 on e^{+inθ}.
    fn new(plate: &Plate, lambda: c64, q: &Col<c64>, diameters: usize, speed: f64) -> Self {
        let size = plate.basis.count();
        let offset = plate.offset(diameters);
        let wave = |sign: f64| {
            let combine = |j: usize| {
                let sine = if diameters > 0 {
                    q[offset + size + j]
                } else {
                    c64::new(0.0, 0.0)
                };
                (q[offset + j] + c64::new(0.0, sign) * sine) * std::f64::consts::FRAC_1_SQRT_2
            };
            (0..size).map(combine).collect::<Vec<c64>>()
        };
        let carried = diameters as f64 * speed;
        let energy = |wave: &[c64], velocity: c64| {
            velocity.norm_sqr() * wave.iter().map(|c| c.norm_sqr()).sum::<f64>()
        };
        let (forward, backward) = (wave(1.0), wave(-1.0));
        Wave {
            diameters,
            carried,
            forward_energy: energy(&forward, lambda - c64::new(0.0, carried)),
            backward_energy: energy(&backward, lambda + c64::new(0.0, carried)),
            forward,
            backward,
        }
    }

    fn energy(&self) -> f64 {
        self.forward_energy + self.backward_energy
    }

    fn runs_forward(&self) -> bool {
        self.diameters > 0 && self.forward_energy >= self.backward_energy
    }

    /// Frequency of the stronger wave on the blade, negative when it runs backward there.
    fn body_frequency(&self, mode: &Mode) -> f64 {
        let omega = mode.frequency_rad_per_s();
        if self.runs_forward() {
            omega - self.carried
        } else {
            -(omega + self.carried)
        }
    }

    fn direction(&self, mode: &Mode) -> Direction {
        let balance =
            (self.forward_energy - self.backward_energy) / self.energy().max(f64::MIN_POSITIVE);
        if mode.kind == ModeKind::Negative {
            Direction::Reflected
        } else if self.diameters == 0 || balance.abs() < STANDING {
            Direction::Standing
        } else if balance < 0.0 {
            Direction::Backward
        } else if self.body_frequency(mode) < 0.0 {
            Direction::Reflected
        } else {
            Direction::Forward
        }
    }

    /// Sign changes of the radial profile of the stronger wave.
    fn circles(&self, plate: &Plate) -> usize {
        let wave = if self.runs_forward() {
            &self.forward
        } else {
            &self.backward
        };
        let turn: c64 = wave.iter().map(|c| c * c).sum::<c64>().sqrt();
        let real: Vec<f64> = wave.iter().map(|c| (c * turn.conj()).re).collect();
        let profile: Vec<f64> = plate
            .sampled_functions(self.diameters)
            .iter()
            .map(|values| values.iter().zip(&real).map(|(v, c)| v * c).sum())
            .collect();
        let threshold = CIRCLE * profile.iter().fold(0.0_f64, |peak, w| peak.max(w.abs()));
        let signs: Vec<bool> = profile
            .iter()
            .filter(|w| w.abs() > threshold)
            .map(|w| *w > 0.0)
            .collect();
        signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
    }
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
