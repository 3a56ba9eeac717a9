//! Coupling of the waves of a turning blade by equal, evenly spaced springs, and the behaviour of coupled
//! waves of equal frequency in space: Chen's rules, and first order in the stiffness.
//!
//! S springs couple waves whose signed wave numbers differ by a multiple of S; others cross. If one of two
//! coupled waves is reflected the frequencies coalesce and the blade flutters; otherwise they veer. At its
//! critical speed a backward wave has the same frequency as its complex conjugate of opposite wave number:
//! the blade diverges if 2n is a multiple of S.
//!
//! Sources: J.-S. Chen, *Vibration and stability of a spinning disk in contact with evenly-spaced stationary
//! load systems*; J.-S. Chen & D. B. Bogy, *Mathematical structure of modal interactions in a spinning
//! disk–stationary load system*, J. Appl. Mech. 59 (1992), 390–397. The first orders follow from the two
//! terms of [`EvenSprings::characteristic`] that are large near equal frequencies.

use super::point_springs::{BodyWave, EvenSprings};

/// A wave e^{i(ωt − pθ)} in the space-fixed frame, with ω > 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SpaceWave {
    /// Wave number p: n for a wave in the direction of rotation, −n against it.
    pub wave_number: i64,
    /// Whether its energy in space is negative (Krein sign −1).
    pub reflected: bool,
}

impl SpaceWave {
    /// Forward wave, with the frequency ω = ω_b + nΩ.
    pub fn forward(nodal_diameters: usize) -> Self {
        SpaceWave {
            wave_number: nodal_diameters as i64,
            reflected: false,
        }
    }

    /// Backward wave below its critical speed, with the frequency ω = ω_b − nΩ.
    pub fn backward(nodal_diameters: usize) -> Self {
        SpaceWave {
            wave_number: -(nodal_diameters as i64),
            reflected: false,
        }
    }

    /// Reflected wave: the backward wave above its critical speed, which travels forward with ω = nΩ − ω_b.
    pub fn reflected(nodal_diameters: usize) -> Self {
        SpaceWave {
            wave_number: nodal_diameters as i64,
            reflected: true,
        }
    }
}

/// Behaviour of two waves at a speed at which their uncoupled frequencies in space are equal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Meeting {
    /// The waves are not coupled.
    Crossing,
    /// The frequencies repel each other; nothing grows.
    Veering,
    /// The frequencies become equal and the motion grows: flutter.
    Coalescence,
}

impl EvenSprings {
    /// Chen's rule for two waves of equal frequency.
    pub fn meeting(&self, first: SpaceWave, second: SpaceWave) -> Meeting {
        if !self.couple(first.wave_number, second.wave_number) {
            Meeting::Crossing
        } else if first.reflected != second.reflected {
            Meeting::Coalescence
        } else {
            Meeting::Veering
        }
    }

    /// Chen's rule for a critical speed: whether the springs split the critical speed of the two waves of n
    /// nodal diameters; between the two speeds the blade diverges.
    pub fn diverges(&self, nodal_diameters: usize) -> bool {
        let n = nodal_diameters as i64;
        n > 0 && self.couple(n, -n)
    }

    /// Coupling S k g₁g₂/(2√(ω₁ω₂)) of two waves, in 1/s: to first order in k the largest growth rate if they
    /// coalesce, and half of the smallest difference of their frequencies if they veer.
    pub fn coupling_per_s(&self, first: BodyWave, second: BodyWave) -> f64 {
        let shares = (first.share_per_kg() * second.share_per_kg()).sqrt();
        let frequencies = (first.frequency_rad_per_s * second.frequency_rad_per_s).sqrt();
        0.5 * self.sum_n_per_m() * shares / frequencies
    }

    /// Shift ±S k g²/(2ω) of the frequency of a wave in space, to first order in k: the springs raise this frequency,
    /// but lower that of a reflected wave.
    pub fn frequency_shift_rad_per_s(&self, wave: BodyWave, reflected: bool) -> f64 {
        let shift = self.coupling_per_s(wave, wave);
        if reflected { -shift } else { shift }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn springs(count: usize) -> EvenSprings {
        EvenSprings {
            count,
            stiffness_n_per_m: 10.0,
        }
    }

    #[test]
    fn waves_cross_veer_or_coalesce_by_chens_rules() {
        let [forward, backward, reflected] = [
            SpaceWave::forward,
            SpaceWave::backward,
            SpaceWave::reflected,
        ];
        use Meeting::{Coalescence, Crossing, Veering};
        for (count, first, second, expected) in [
            (3, reflected(4), forward(1), Coalescence),
            (3, reflected(4), forward(2), Crossing),
            (3, reflected(4), backward(2), Coalescence),
            (3, reflected(4), reflected(7), Veering),
            (3, backward(4), backward(1), Veering),
            (4, reflected(3), forward(1), Crossing),
            (4, reflected(3), backward(1), Coalescence),
            (1, reflected(3), forward(0), Coalescence),
        ] {
            assert_eq!(springs(count).meeting(first, second), expected);
        }
        assert!(springs(4).diverges(2) && !springs(4).diverges(3) && springs(3).diverges(3));
        assert!(!springs(3).diverges(0));
    }

    /// The exact equation of two waves, at the speed of coalescence to first order.
    #[test]
    fn the_first_order_is_that_of_the_exact_equation() {
        let wave = |nodal_diameters, frequency_rad_per_s, amplitude_per_sqrt_kg| BodyWave {
            nodal_diameters,
            frequency_rad_per_s,
            amplitude_per_sqrt_kg,
        };
        // ω = 4Ω − ω₁ = Ω + ω₂ at Ω = 100 1/s.
        let (reflected, forward) = (wave(4, 250.0, 1.3), wave(1, 50.0, 0.8));
        let off = |stiffness_n_per_m: f64| {
            let springs = EvenSprings {
                count: 3,
                stiffness_n_per_m,
            };
            let shifts = [
                springs.frequency_shift_rad_per_s(reflected, true),
                springs.frequency_shift_rad_per_s(forward, false),
            ];
            let speed = 100.0 + (shifts[1] - shifts[0]) / 3.0;
            let expected = springs.coupling_per_s(reflected, forward);
            let start = [expected, speed + 50.0 + shifts[1]];
            let waves = [reflected, forward];
            let found = springs.eigenvalue_near(1, &waves, speed, start).unwrap();
            (found[0] / expected - 1.0).abs()
        };
        let (coarse, fine) = (off(20.0), off(2.0));
        assert!(fine < 1e-2 && fine < 0.3 * coarse, "{coarse:e} {fine:e}");
    }
}
