//! Oscillations of a blade between guides with a gap: under a side force that oscillates, and of a blade with a run-out, a
//! lack of flatness or an imbalance that turns with it.
//!
//! The loads have the frequencies of some orders of the rotation speed; the motion has those of all multiples of their
//! greatest common divisor, because the force of a pad that touches for a part of the period contains all of them. The mean
//! of the motion is the mean deflection. Shape and imbalance are the loads of [`response`](crate::analyses::response).

use rayon::prelude::*;

use crate::spectrum::Work;
use crate::stability::Analysis;

use super::GapError;
use super::oscillating_blade::{AtSpeed, HARMONICS, OscillatingBlade, amplitude_m};
use super::oscillators::Oscillators;

/// Oscillations with the gaps of the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Oscillation {
    /// Causes of the oscillation.
    pub oscillators: Oscillators,
    /// Ratio of the frequency of the motion to that of rotation.
    pub base_order: u32,
    /// Number of harmonics of the motion.
    pub harmonics: usize,
    /// Growth rate above which a motion is unstable.
    pub threshold_per_s: f64,
    /// The motion at the speed of the map; `None` if none was found.
    pub at: Option<AtSpeed>,
    /// Deflection of the rim at the cut without oscillation.
    pub still_m: f64,
    /// Relative change of the amplitude at the cut with more harmonics; `None` if a motion was not found.
    pub harmonics_error: Option<f64>,
    /// Relative change of the amplitude at the cut on a larger basis; `None` if a motion was not found.
    pub basis_error: Option<f64>,
    /// Speeds, ascending.
    pub speeds_rad_per_s: Vec<f64>,
    /// Stable motions at these speeds; `None` where none was found, and where the blade deflects by more than its thickness.
    pub over_speed: Vec<Option<AtSpeed>>,
}

/// Number of modes at rest in the basis, in addition to the responses to the loads.
const MODES: usize = 16;
/// Number of modes at rest in the larger basis, with which the amplitude is compared.
const MORE_MODES: usize = 24;
/// Number of evenly spaced speeds; the speed of the map is added to them.
const SPEEDS: usize = 30;

impl Oscillation {
    /// Computes the oscillations of the saw of an analysis under a steady side force, at a speed and over the sweep.
    ///
    /// # Errors
    /// [`GapError`].
    pub(super) fn new(
        analysis: &Analysis,
        oscillators: Oscillators,
        force_n: f64,
        speed_rad_per_s: f64,
    ) -> Result<Self, GapError> {
        let scene = &analysis.scene;
        let to = analysis.range_rad_per_s.1.max(speed_rad_per_s);
        let of_modes = |modes: usize| {
            let asked = (force_n, speed_rad_per_s, to);
            let resolution = analysis.model.plate.resolution;
            OscillatingBlade::new(scene, resolution, &oscillators, asked, modes)
        };
        let base = oscillators.base_order();
        let work = Work::of("oscillations", SPEEDS + 2);
        let finer = of_modes(MORE_MODES)?;
        let (fine, _) = finer.at(speed_rad_per_s, base)?;
        work.advance();
        let last = SPEEDS as f64;
        let mut speeds: Vec<f64> = (1..=SPEEDS).map(|k| to * k as f64 / last).collect();
        speeds.retain(|other| (*other - speed_rad_per_s).abs() > 1e-9 * to);
        let place = speeds.partition_point(|other| *other < speed_rad_per_s);
        speeds.insert(place, speed_rad_per_s);
        let blade = of_modes(MODES)?;
        let motions = speeds.par_iter().map(|speed| {
            let found = blade.at(*speed, base)?;
            work.advance();
            Ok(found)
        });
        let motions = motions.collect::<Result<Vec<_>, GapError>>()?;
        let still_m = motions[place].1;
        let mut motions: Vec<_> = motions.into_iter().map(|(found, _)| found).collect();
        blade.follow(&mut motions, &speeds, base);
        let found = motions[place].as_ref();
        let own_m = found.map(|at| amplitude_m(&at.motion, &blade.cut));
        let change = |other: f64| own_m.map(|own| (other / own - 1.0).abs());
        let more = found.and_then(|at| {
            let more = blade.refined(&at.motion, speed_rad_per_s, base)?;
            Some(amplitude_m(&more, &blade.cut))
        });
        let fine_m = fine.map(|at| amplitude_m(&at.motion, &finer.cut));
        let at = found.map(|found| blade.read(speed_rad_per_s, found));
        let threshold_per_s = scene.flutter_threshold_per_s();
        let thickness_m = scene.blade().thickness_m;
        let is_valid = |at: &AtSpeed| at.is_stable(threshold_per_s) && at.largest_m <= thickness_m;
        let pairs = motions.iter().zip(&speeds);
        let over_speed = pairs.map(|(found, speed)| {
            let at = found.as_ref().map(|found| blade.read(*speed, found));
            at.filter(is_valid)
        });
        Ok(Oscillation {
            over_speed: over_speed.collect(),
            oscillators,
            base_order: base,
            harmonics: HARMONICS,
            threshold_per_s,
            at,
            still_m,
            harmonics_error: more.and_then(change),
            basis_error: fine_m.and_then(change),
            speeds_rad_per_s: speeds,
        })
    }

    /// Name of the part of the motion with an order: the causes with this order, or the contact, which adds other multiples
    /// of the base order.
    pub fn name_of(&self, order: u32) -> String {
        let causes = self.oscillators.causes();
        let own = causes.iter().filter(|(_, other)| *other == order);
        let names: Vec<&str> = own.map(|(name, _)| *name).collect();
        match names.is_empty() {
            true => "contact".to_owned(),
            false => names.join(", "),
        }
    }
}

#[cfg(test)]
#[path = "oscillation_tests.rs"]
mod tests;
