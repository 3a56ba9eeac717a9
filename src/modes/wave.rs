//! The waves of a motion: each harmonic is the sum of a wave that travels forward in space and one that
//! travels backward.

use faer::{Col, c64};

use super::mode::Mode;
use crate::model::plate::Plate;

/// A sign change of the radial profile is counted if the profile exceeds this share of its peak on both
/// sides.
const CIRCLE: f64 = 0.03;

/// One harmonic, as the sum of the two waves e^{i(ωt − nθ)} and e^{i(ωt + nθ)}.
///
/// Each wave is weighted by the kinetic energy of the lateral motion, with the velocity Dw/Dt = (λ + Ω∂θ)w of
/// the material. For a standing wave in space, where ∂w/∂t contributes nothing, this weight contains the factor
/// n², without which a rigid tilt would dominate.
pub struct Wave {
    pub diameters: usize,
    /// Frequency nΩ by which rotation carries the wave.
    pub carried: f64,
    pub forward: Vec<c64>,
    pub backward: Vec<c64>,
    forward_energy: f64,
    backward_energy: f64,
}

impl Wave {
    /// The waves of a motion with the coordinates q in the basis of the plate: q_c cos nθ + q_s sin nθ has the
    /// amplitudes (q_c + i q_s)/2 of e^{−inθ} and (q_c − i q_s)/2 of e^{+inθ}, here times √2.
    pub fn new(plate: &Plate, lambda: c64, q: &Col<c64>, diameters: usize, speed: f64) -> Self {
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
        let energy = |wave: &[c64], velocity: c64| velocity.norm_sqr() * square(wave);
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

    pub fn energy(&self) -> f64 {
        self.forward_energy + self.backward_energy
    }

    pub fn runs_forward(&self) -> bool {
        self.diameters > 0 && self.forward_energy >= self.backward_energy
    }

    /// Frequency of the stronger wave on the blade, negative if it travels backward there.
    pub fn body_frequency(&self, mode: &Mode) -> f64 {
        let omega = mode.frequency_rad_per_s();
        if self.runs_forward() {
            omega - self.carried
        } else {
            -(omega + self.carried)
        }
    }

    /// Sign changes of the radial profile of the stronger wave.
    pub fn circles(&self, plate: &Plate) -> usize {
        if self.runs_forward() {
            circles(plate, self.diameters, &self.forward)
        } else {
            circles(plate, self.diameters, &self.backward)
        }
    }
}

/// Sum of the squared amplitudes of a wave.
pub fn square(wave: &[c64]) -> f64 {
    wave.iter().map(|c| c.norm_sqr()).sum()
}

/// Sign changes of a radial profile of n nodal diameters.
pub fn circles(plate: &Plate, diameters: usize, wave: &[c64]) -> usize {
    let turn: c64 = wave.iter().map(|c| c * c).sum::<c64>().sqrt();
    let real: Vec<f64> = wave.iter().map(|c| (c * turn.conj()).re).collect();
    let profile: Vec<f64> = plate
        .sampled_functions(diameters)
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
