//! A fault that tests introduce into the reduced model, for the certificate to detect.

use super::super::vectors::split;
use super::*;

impl SpectralModel {
    /// Removes the oscillation at a `place` in the order of frequency, among all of a damped saw or those of sign + of another, at a
    /// speed, from the reduced model.
    pub(crate) fn lose_wave(&mut self, speed_rad_per_s: f64, place: usize) {
        let modes = self.modes(speed_rad_per_s).unwrap();
        let is_wave = |m: &&Mode| matches!(m.kind, ModeKind::Positive | ModeKind::Damped);
        let mut waves = modes.iter().filter(is_wave);
        let (re, im) = split(&waves.nth(place).unwrap().coordinates);
        let Solution::Waves(modes) = &mut self.components[0].solution else {
            panic!("no reduced model");
        };
        modes.lose(&[re, im]);
    }
}
