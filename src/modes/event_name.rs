//! Names of events, which are critical speeds and bands, by their waves at their own speed. Events are named
//! nowhere else.
//!
//! - A shape that is fixed in space (λ real) is named by the waves that rotation softens: waves of n nodal
//!   diameters lose qᴴ(N − K_σ)q Ω² of their stiffness, where K_σ is centrifugal stiffening. For n = 0 and 1
//!   this is never positive, so they have no critical speed.
//! - Flutter is named by waves of both signs of energy. With amplitudes f of e^{i(ωt − nθ)}, forward in
//!   space, and b of e^{i(ωt + nθ)}, backward, the action (ω − nΩ)|f|² + (ω + nΩ)|b|² summed over n has the
//!   Krein sign, and is zero for two coalesced modes. The energy of a free wave is 2ω times its action; both
//!   are negative for a reflected one. The energy of motions that a guide forces on the blade is smaller than
//!   this (for rigid motions) or larger (for short waves, which are stiff). A wave is weighted by the smaller
//!   of the two if they have the same sign.

use faer::{Col, c64};

use super::mode::{Mode, ModeKind};
use super::mode_name::{Direction, HarmonicShare, STANDING, in_words, mixed, share_of, short};
use super::wave::{Wave, circles, square};
use crate::model::plate::Plate;

/// Largest number of waves in a name if none dominates.
const MOST_NAMED: usize = 2;
/// Waves with a smaller share of the weights are omitted.
const LEAST: f64 = 1e-3;
/// In a damped blade, the waves of one sign of energy are named only if their weight is at least this share of
/// the weight of the other sign: a wave that grows alone has no partner.
const LEAST_PARTNER: f64 = 1.0 / 3.0;

/// Waves of one direction that belong to an event.
#[derive(Debug, Clone, PartialEq)]
pub struct EventWaves {
    /// Direction in space.
    pub direction: Direction,
    /// Waves with their shares of the sum of the weights, largest first.
    pub shares: Vec<HarmonicShare>,
}

/// The waves of an event: for a critical speed or divergence, those of the shape fixed in space; for flutter,
/// the reflected waves and those with which they coalesce.
#[derive(Debug, Clone, PartialEq)]
pub struct EventName {
    /// One or two groups, reflected waves first.
    pub waves: Vec<EventWaves>,
}

impl EventName {
    /// The name of a shape fixed in space, in the basis of the plate.
    pub fn standing(plate: &Plate, shape: &Col<c64>, speed_rad_per_s: f64) -> Self {
        let waves = waves(plate, c64::new(0.0, 0.0), shape, speed_rad_per_s);
        let softened = |wave: &Wave| {
            let spin = &plate.harmonics[wave.diameters].spin;
            let both = [&wave.forward, &wave.backward];
            let lost: f64 = both.map(|c| -form(c, |i, k| spin[(i, k)])).iter().sum();
            lost.max(0.0)
        };
        let amplitude = |wave: &Wave| square(&wave.forward) + square(&wave.backward);
        // Rotation softens no wave at rest, and an event caused by follower loads may have no softened wave.
        // The weights are then squared amplitudes.
        let is_softened = speed_rad_per_s > 0.0 && waves.iter().any(|wave| softened(wave) > 0.0);
        let weight = |wave: &Wave| {
            if is_softened {
                softened(wave)
            } else {
                amplitude(wave)
            }
        };
        let weighed = waves.iter().map(|wave| (wave, weight(wave))).collect();
        let named = |wave: &Wave| (wave.diameters, wave.circles(plate));
        let made_by = EventWaves::new(Direction::Standing, weighed, named);
        EventName {
            waves: made_by.into_iter().collect(),
        }
    }

    /// The name of the mode that grows in a band, with its shape in the basis of the plate.
    pub fn growing(plate: &Plate, mode: &Mode, shape: &Col<c64>, speed_rad_per_s: f64) -> Self {
        if mode.kind == ModeKind::Divergent || mode.lambda.im == 0.0 {
            return Self::standing(plate, shape, speed_rad_per_s);
        }
        let omega = mode.frequency_rad_per_s();
        let waves = waves(plate, mode.lambda, shape, speed_rad_per_s);
        let parts: Vec<Part<'_>> = waves
            .iter()
            .flat_map(|wave| parts(plate, mode.lambda, wave, speed_rad_per_s))
            .collect();
        let of_sign = |sign: f64| -> Vec<&Part> {
            let agree = |part: &&Part| sign * part.weight(omega) > 0.0;
            parts.iter().filter(agree).collect()
        };
        let (reflected, others) = (of_sign(-1.0), of_sign(1.0));
        let sum = |of: &[&Part]| of.iter().map(|part| part.weight(omega).abs()).sum::<f64>();
        let sums = [sum(&reflected), sum(&others)];
        let least = match mode.kind {
            ModeKind::Damped => LEAST_PARTNER * sums[0].max(sums[1]),
            _ => 0.0,
        };
        let direction = direction(&others, omega);
        let groups = [(reflected, Direction::Reflected), (others, direction)];
        let named = groups
            .into_iter()
            .zip(sums)
            .filter(|(_, sum)| *sum >= least)
            .filter_map(|((parts, direction), _)| {
                let weight = |part| (part, Part::weight(part, omega).abs());
                let weighed = parts.into_iter().map(weight).collect();
                EventWaves::new(direction, weighed, |part| part.named(plate))
            });
        EventName {
            waves: named.collect(),
        }
    }

    /// Nodal diameters of the first wave.
    pub fn diameters(&self) -> usize {
        self.first().map_or(0, |wave| wave.diameters)
    }

    /// Nodal circles of the first wave.
    pub fn circles(&self) -> usize {
        self.first().map_or(0, |wave| wave.circles)
    }

    fn first(&self) -> Option<&HarmonicShare> {
        self.waves.first()?.shares.first()
    }

    /// Share of n nodal diameters, between 0 and 1, among the waves of its direction, as in the name.
    pub fn share(&self, diameters: usize) -> f64 {
        let shares = self
            .waves
            .iter()
            .map(|waves| share_of(&waves.shares, diameters));
        shares.fold(0.0, f64::max)
    }

    /// Name in words, such as "2 diameters" or "4 reflected with 2 forward".
    pub fn in_words(&self) -> String {
        match self.waves.as_slice() {
            [waves] => waves.in_words(),
            both => {
                let named: Vec<String> = both.iter().map(EventWaves::in_short).collect();
                named.join(" with ")
            }
        }
    }
}

impl EventWaves {
    /// The waves of an event from all waves with their weights; `named` gives nodal diameters and circles.
    /// `None` if every weight is zero.
    fn new<W>(
        direction: Direction,
        mut weighed: Vec<(&W, f64)>,
        named: impl Fn(&W) -> (usize, usize),
    ) -> Option<Self> {
        let total: f64 = weighed.iter().map(|(_, weight)| weight).sum();
        weighed.sort_by(|(_, x), (_, y)| y.total_cmp(x));
        let counted = weighed
            .iter()
            .filter(|(_, weight)| *weight >= LEAST * total);
        let shares = counted.map(|(wave, weight)| {
            let (diameters, circles) = named(wave);
            HarmonicShare {
                diameters,
                circles,
                share: weight / total,
            }
        });
        (total > 0.0).then(|| EventWaves {
            direction,
            shares: shares.collect(),
        })
    }

    /// "2 diameters, forward", or shares if no wave dominates: "3 (52 %) + 2 (41 %), reflected".
    pub fn in_words(&self) -> String {
        let (diameters, circles) = self.first();
        let dominant = || in_words(diameters, circles, self.direction);
        mixed(&self.shares, 0.0, MOST_NAMED)
            .map_or_else(dominant, |shares| shares + &self.direction.ending(", "))
    }

    /// "2 forward", "3 (52 %) + 2 (41 %) reflected".
    fn in_short(&self) -> String {
        let (diameters, circles) = self.first();
        let dominant = || short(diameters, circles);
        mixed(&self.shares, 0.0, MOST_NAMED).unwrap_or_else(dominant) + &self.direction.ending(" ")
    }

    /// Nodal diameters and circles of the wave with the largest share.
    fn first(&self) -> (usize, usize) {
        let first = self.shares.first();
        first.map_or((0, 0), |wave| (wave.diameters, wave.circles))
    }
}

fn waves(plate: &Plate, lambda: c64, shape: &Col<c64>, speed_rad_per_s: f64) -> Vec<Wave> {
    let wave = |n| Wave::new(plate, lambda, shape, n, speed_rad_per_s);
    (0..=plate.max_diameters()).map(wave).collect()
}

/// One of the two waves of a harmonic, or both if their energies have the same sign, because the standing part
/// of the two has nearly no action.
struct Part<'a> {
    wave: &'a Wave,
    forward: &'a [c64],
    backward: &'a [c64],
    /// Twice the kinetic plus potential energy, seen from space.
    energy: f64,
}

fn parts<'a>(plate: &Plate, lambda: c64, wave: &'a Wave, speed_rad_per_s: f64) -> Vec<Part<'a>> {
    let block = &plate.harmonics[wave.diameters];
    let stiffness = |i: usize, k: usize| {
        let membrane = block.membrane.as_ref().map_or(0.0, |m| m[(i, k)]);
        block.bending[(i, k)] + membrane + speed_rad_per_s.powi(2) * block.spin[(i, k)]
    };
    let energy = |c: &[c64]| lambda.norm_sqr() * square(c) + form(c, stiffness);
    let (forward, backward) = (wave.forward.as_slice(), wave.backward.as_slice());
    let part = |forward, backward, energy| Part {
        wave,
        forward,
        backward,
        energy,
    };
    match [energy(forward), energy(backward)] {
        [ahead, behind] if (ahead < 0.0) == (behind < 0.0) => {
            vec![part(forward, backward, ahead + behind)]
        }
        [ahead, behind] => vec![part(forward, &[], ahead), part(&[], backward, behind)],
    }
}

impl Part<'_> {
    /// (ω − nΩ)|f|² + (ω + nΩ)|b|².
    fn action(&self, omega: f64) -> f64 {
        let carried = self.wave.carried;
        (omega - carried) * square(self.forward) + (omega + carried) * square(self.backward)
    }

    /// The smaller in magnitude of the energy and 2ω times the action, with its sign; zero if the signs differ.
    fn weight(&self, omega: f64) -> f64 {
        let by_action = 2.0 * omega * self.action(omega);
        if by_action * self.energy > 0.0 {
            by_action.abs().min(self.energy.abs()).copysign(self.energy)
        } else {
            0.0
        }
    }

    /// Nodal diameters, and the circles of the stronger wave.
    fn named(&self, plate: &Plate) -> (usize, usize) {
        let stronger = if square(self.forward) >= square(self.backward) {
            self.forward
        } else {
            self.backward
        };
        let diameters = self.wave.diameters;
        (diameters, circles(plate, diameters, stronger))
    }
}

/// Common direction of weighted waves in space. Waves without nodal diameters have no direction.
fn direction(parts: &[&Part<'_>], omega: f64) -> Direction {
    let [mut forward, mut backward, mut all] = [0.0; 3];
    for part in parts {
        let squares = [square(part.forward), square(part.backward)];
        let weight = part.weight(omega) / (squares[0] + squares[1]);
        all += part.weight(omega);
        if part.wave.diameters > 0 {
            forward += weight * squares[0];
            backward += weight * squares[1];
        }
    }
    if (forward - backward).abs() < STANDING * all {
        Direction::Standing
    } else if forward > backward {
        Direction::Forward
    } else {
        Direction::Backward
    }
}

/// cᴴAc of a symmetric matrix A.
fn form(c: &[c64], entry: impl Fn(usize, usize) -> f64) -> f64 {
    let row = |i: usize| -> c64 { (0..c.len()).map(|k| c[k] * entry(i, k)).sum() };
    (0..c.len()).map(|i| (c[i].conj() * row(i)).re).sum()
}
