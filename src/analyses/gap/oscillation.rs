//! Oscillations of a blade between guides with a gap: under a side force that oscillates, and of a blade with a run-out, a
//! lack of flatness or an imbalance that turns with it.
//!
//! The loads have the frequencies of some orders of the rotation speed; the motion has those of all multiples of their
//! greatest common divisor, because the force of a pad that touches for a part of the period contains all of them. The mean
//! of the motion is the mean deflection. Shape and imbalance are the loads of [`response`](crate::response).

use rayon::prelude::*;

use crate::model::plate::Plate;
use crate::model::scene::rpm;
use crate::modes::Work;
use crate::motion::steady::{HARMONICS, OscillatingBlade, Oscillators, loads};
use crate::stability::Analysis;

use super::error::GapError;
use super::oscillation_reading::reading;
use super::oscillation_report::{Oscillation, OscillationAt, OscillationLine};

/// Number of modes at rest in the basis, in addition to the responses to the loads.
const MODES: usize = 16;
/// Number of modes at rest in the larger basis, with which the amplitude is compared.
const MORE_MODES: usize = 24;
/// Number of evenly spaced speeds; the speed of the map is added to them.
const SPEEDS: usize = 30;

/// Relative change of the amplitude above which the report contains a warning.
const LARGE_ERROR: f64 = 0.05;

/// Computes the oscillations of the saw of an analysis under a steady side force, at a speed and over the sweep.
///
/// # Errors
/// [`GapError`].
pub(super) fn oscillation(
    analysis: &Analysis,
    oscillators: &Oscillators,
    speed_rad_per_s: f64,
) -> Result<Oscillation, GapError> {
    let scene = &analysis.scene;
    let to = analysis.range_rad_per_s.to_rad_per_s.max(speed_rad_per_s);
    let plate = Plate::new(scene, analysis.model.plate.resolution);
    let excitations = loads(&plate, scene, 0.0)?;
    let of_modes = |modes: usize| {
        let asked = (speed_rad_per_s, to);
        let causes = (oscillators, excitations.clone());
        OscillatingBlade::new(&plate, scene, causes, asked, modes)
    };
    let work = Work::of("oscillations", SPEEDS + 2);
    let finer = of_modes(MORE_MODES)?;
    let (fine, _) = finer.at(speed_rad_per_s)?;
    work.advance();
    let last = SPEEDS as f64;
    let mut speeds: Vec<f64> = (1..=SPEEDS).map(|k| to * k as f64 / last).collect();
    speeds.retain(|other| (*other - speed_rad_per_s).abs() > 1e-9 * to);
    let place = speeds.partition_point(|other| *other < speed_rad_per_s);
    speeds.insert(place, speed_rad_per_s);
    let blade = of_modes(MODES)?;
    let motions = speeds
        .par_iter()
        .map(|speed| {
            let found = blade.at(*speed)?;
            work.advance();
            Ok(found)
        })
        .collect::<Result<Vec<_>, GapError>>()?;
    let still_deflection_m = motions[place].1;
    let mut motions: Vec<_> = motions.into_iter().map(|(found, _)| found).collect();
    blade.follow(&mut motions, &speeds);
    let found = motions[place].as_ref();
    let own_m = found.map(|at| at.motion.amplitude(&blade.cut));
    let change = |other: f64| own_m.map(|own| (other / own - 1.0).abs());
    let fine_m = fine.map(|at| at.motion.amplitude(&finer.cut));
    let thickness_m = scene.blade().thickness_m;
    let pairs = motions.iter().zip(&speeds);
    let over_speed: Vec<Option<OscillationAt>> = pairs
        .map(|(found, speed)| {
            let at = reading(&blade, *speed, found.as_ref()?);
            (at.stable && at.largest_deflection_m <= thickness_m).then_some(at)
        })
        .collect();
    let of = |of: fn(&OscillationAt) -> f64| -> Vec<Option<f64>> {
        over_speed.iter().map(|at| at.as_ref().map(of)).collect()
    };
    let line = |k: usize| {
        let order = (k as u32 + 1) * oscillators.base_order();
        let size = |at: &Option<OscillationAt>| at.as_ref()?.probe.lines_m.get(k).copied();
        OscillationLine {
            order,
            name: oscillators.name_of(order),
            probe_m: over_speed.iter().map(size).collect(),
        }
    };
    let force = oscillators.force;
    Ok(Oscillation {
        force_n: scene.constant_force().force_n,
        oscillating_force_n: force.map_or(0.0, |force| force.amplitude_n),
        oscillating_order: force.map_or(0, |force| force.order),
        lines: (0..HARMONICS).map(line).collect(),
        at: found.map(|at| reading(&blade, speed_rad_per_s, at)),
        still_deflection_m,
        harmonics_error_share: found.map(|at| at.neglected_share),
        neglected_share: motions
            .iter()
            .map(|found| Some(found.as_ref()?.neglected_share))
            .collect(),
        basis_error_share: fine_m.and_then(change),
        rpm: speeds.iter().map(|speed| rpm(*speed)).collect(),
        probe_mean_m: of(|at| at.probe.mean_m),
        probe_amplitude_m: of(|at| at.probe.amplitude_m),
        cut_mean_m: of(|at| at.cut.mean_m),
        cut_amplitude_m: of(|at| at.cut.amplitude_m),
    })
}

impl Oscillation {
    /// Remarks on the validity of the oscillation.
    pub(super) fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        match &self.at {
            None => warnings.push(
                "no periodic motion of few harmonics was found at the speed of the map: the blade may chatter between its guides without a period"
                    .to_owned(),
            ),
            Some(at) if !at.stable => {
                let of_motion = at.growth_frequency_hz.unwrap_or_default() / at.frequency_hz;
                let what = if (2.0 * of_motion - 1.0).abs() < 1e-3 { "a motion of twice the period (a subharmonic, X/2) takes its place" } else { "small motions about it grow" };
                warnings.push(format!(
                    "the periodic motion at the speed of the map is unstable: {what}"
                ));
            }
            Some(_) => (),
        }
        if let Some(error) = self.basis_error_share.filter(|error| *error > LARGE_ERROR) {
            warnings.push(format!(
                "the oscillation at the cut is not converged: with more modes at rest its amplitude changes by {:.0} %",
                1e2 * error
            ));
        }
        warnings
    }
}

#[cfg(test)]
#[path = "oscillation_tests.rs"]
mod tests;
