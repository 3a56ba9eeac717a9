//! Numbers of a periodic motion at the probe, at the cut and at the pads.

use std::f64::consts::TAU;

use faer::Col;

use crate::model::scene::rpm;
use crate::motion::steady::{Found, HARMONICS, OscillatingBlade, Periodic, extremes};

use super::oscillation_report::{OscillationAt, OscillationPad, OscillationPlace};

/// Number of phases of a motion from one evaluation of the whole blade to the next.
const EVERY: usize = 6;

/// A motion at a speed, which is stable if small motions about it grow by at most a threshold.
pub(super) fn reading(
    blade: &OscillatingBlade,
    speed_rad_per_s: f64,
    found: &Found,
) -> OscillationAt {
    let states = found.motion.states();
    let seen = states.iter().step_by(EVERY);
    OscillationAt {
        rpm: rpm(speed_rad_per_s),
        frequency_hz: f64::from(blade.base_order) * speed_rad_per_s / TAU,
        probe: at_place(&found.motion, &states, &blade.probe),
        cut: at_place(&found.motion, &states, &blade.cut),
        pads: pads(blade, &states),
        largest_deflection_m: seen.map(|q| blade.sites.largest_m(q)).fold(0.0, f64::max),
        growth_per_s: found.growth.map(|growth| growth.per_s),
        growth_frequency_hz: found.growth.map(|growth| growth.frequency_rad_per_s / TAU),
        stable: found
            .growth
            .is_some_and(|growth| growth.per_s <= blade.threshold_per_s),
    }
}

/// Forces and contact of the pads.
fn pads(blade: &OscillatingBlade, states: &[Col<f64>]) -> Vec<OscillationPad> {
    let Some(gaps) = blade.blade.gaps() else {
        return Vec::new();
    };
    let forces: Vec<Vec<f64>> = states.iter().map(|q| gaps.forces_n(q)).collect();
    let left: Vec<Vec<f64>> = states.iter().map(|q| gaps.distances_left_m(q)).collect();
    let count = states.len() as f64;
    let pads = forces.first().map_or(0, Vec::len);
    let pad = |pad: usize| {
        let own = || forces.iter().map(|all| all[pad]);
        OscillationPad {
            guide: blade.guides.get(pad).copied().unwrap_or(pad),
            mean_force_n: own().sum::<f64>() / count,
            largest_force_n: own().map(f64::abs).fold(0.0, f64::max),
            contact_share: left.iter().filter(|all| all[pad] <= 0.0).count() as f64 / count,
        }
    };
    (0..pads).map(pad).collect()
}

/// The deflection at a place, with its harmonics.
fn at_place(motion: &Periodic, states: &[Col<f64>], place: &Col<f64>) -> OscillationPlace {
    let [low, high] = extremes(states, place);
    let harmonics = || (1..=HARMONICS).map(|k| motion.harmonic(k, place));
    OscillationPlace {
        mean_m: motion.mean(place),
        amplitude_m: 0.5 * (high - low),
        largest_m: low.abs().max(high.abs()),
        lines_m: harmonics().map(|w| w.norm()).collect(),
        phase_deg: harmonics().map(|w| w.arg().to_degrees()).collect(),
    }
}
