//! Unknowns of half a pitch, by the symmetry of waves.
//!
//! N slots make N equal pitches, and a mirror stands in the middle of each. A deflection that turns by the phase kα from one pitch, of
//! the angle α = 2π/N, to the next is Re e^{ikαj} (e + i o), with e even and o odd about the middle of the pitch, both real. Where the
//! blade is whole, on the line θ = α/2 of the slot inside its end, the pitches join where
//!
//! e = s cos ψ, o = s sin ψ and ∂e/∂θ = −t sin ψ, ∂o/∂θ = t cos ψ, ψ = kα/2,
//!
//! with one unknown s and one t for both. So half a pitch with e and o has the waves of n = k, N ± k, 2N ± k … diameters, cosine and
//! sine of which have equal frequencies. For 2k = 0 or N e and o are free of each other: the two branches of a split pair.

use std::f64::consts::PI;

use super::chain::Place;
use crate::model::scene::{Blade, Bore};

/// Parts of a deflection on half a pitch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// Even about the middle between two slots, a cosine.
    Even,
    /// Odd, a sine.
    Odd,
}

/// A class of waves that the slots do not couple with others.
#[derive(Debug, Clone, Copy)]
pub struct Class {
    /// Phase between neighbouring pitches, in pitches of the circle: k.
    pub phase: usize,
    /// Number N of slots.
    pub count: usize,
    /// The part that is alone; `None` if both are joined.
    pub alone: Option<Part>,
}

/// Unknowns of a node: w, ∂w/∂θ, ∂w/∂r, ∂²w/∂r∂θ.
pub const OF_NODE: usize = 4;

impl Class {
    /// The classes of waves of up to `most` nodal diameters.
    pub fn all(count: usize, most: usize) -> Vec<Class> {
        let phases = 0..=most.min(count / 2);
        let of_phase = |phase: usize| {
            let parts = if (2 * phase).is_multiple_of(count) {
                vec![Some(Part::Even), Some(Part::Odd)]
            } else {
                vec![None]
            };
            parts.into_iter().map(move |alone| Class {
                phase,
                count,
                alone,
            })
        };
        phases.flat_map(of_phase).collect()
    }

    /// The parts of the deflection.
    pub fn parts(&self) -> &'static [Part] {
        match self.alone {
            None => &[Part::Even, Part::Odd],
            Some(Part::Even) => &[Part::Even],
            Some(Part::Odd) => &[Part::Odd],
        }
    }

    /// Share ±1 or 0 of a part in the wave of n diameters: e = cos nθ, o = ±sin nθ; `None` if the wave is of another class.
    pub fn sign_of(&self, n: usize) -> Option<f64> {
        let over = n % self.count;
        let is_sine = self.alone == Some(Part::Odd);
        if over == self.phase && !(is_sine && n == 0) {
            Some(1.0)
        } else if self.count - over == self.phase {
            Some(-1.0)
        } else {
            None
        }
    }

    /// Factors of s in w and of t in ∂w/∂θ on the line of the slot.
    fn joined(&self, part: Part) -> [f64; 2] {
        let (sin, cos) = match (self.phase, self.alone) {
            (0, _) => (0.0, 1.0),
            (_, Some(_)) => (1.0, 0.0),
            _ => (PI * self.phase as f64 / self.count as f64).sin_cos(),
        };
        match part {
            Part::Even => [cos, -sin],
            Part::Odd => [sin, cos],
        }
    }
}

/// Condition at the inner edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Held {
    /// Deflection and slope are free.
    Nothing,
    /// No deflection.
    Deflection,
    /// No deflection and no slope.
    Slope,
}

impl Held {
    /// The condition of a blade.
    pub fn of(blade: &Blade) -> Self {
        match (blade.bore, blade.clamp_n_m_per_rad_per_m) {
            (Bore::Free, _) => Held::Nothing,
            (Bore::Clamped(_), Some(_)) => Held::Deflection,
            (Bore::Clamped(_), None) => Held::Slope,
        }
    }
}

/// Numbers of the unknowns of a class; a block is a circle.
pub struct Unknowns {
    /// By part, circle, angle and unknown of the node: the place and the factor.
    places: Vec<Option<(Place, f64)>>,
    circles: usize,
    angles: usize,
    pub orders: Vec<usize>,
}

impl Unknowns {
    /// Numbers the unknowns on so many circles and angles; the slot ends at the circle `end`.
    pub fn new(class: &Class, [circles, angles]: [usize; 2], end: usize, held: Held) -> Self {
        let parts = class.parts();
        let mut orders = vec![0; circles];
        let mut places = vec![None; parts.len() * circles * angles * OF_NODE];
        for circle in 0..circles {
            let mut next = || {
                orders[circle] += 1;
                (circle, orders[circle] - 1)
            };
            // The unknowns s and t of deflection and radial slope on the line of the slot.
            let mut shared: [Option<Place>; OF_NODE] = [None; OF_NODE];
            for (part, own) in parts.iter().enumerate() {
                for angle in 0..angles {
                    for unknown in 0..OF_NODE {
                        let turns = unknown % 2;
                        let is_held = circle == 0
                            && match held {
                                Held::Nothing => false,
                                Held::Deflection => unknown < 2,
                                Held::Slope => true,
                            };
                        let vanishes = angle == 0 && (*own == Part::Even) == (turns == 1);
                        if is_held || vanishes {
                            continue;
                        }
                        let found = if angle + 1 == angles && circle <= end {
                            let factor = class.joined(*own)[turns];
                            (factor != 0.0)
                                .then(|| (*shared[unknown].get_or_insert_with(&mut next), factor))
                        } else {
                            Some((next(), 1.0))
                        };
                        places[((part * circles + circle) * angles + angle) * OF_NODE + unknown] =
                            found;
                    }
                }
            }
        }
        Unknowns {
            places,
            circles,
            angles,
            orders,
        }
    }

    /// Place and factor of an unknown of a node in a part of the deflection; `None` if it vanishes.
    pub fn of_node(
        &self,
        part: usize,
        [circle, angle]: [usize; 2],
        unknown: usize,
    ) -> Option<(Place, f64)> {
        self.places[((part * self.circles + circle) * self.angles + angle) * OF_NODE + unknown]
    }
}
