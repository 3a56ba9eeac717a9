//! Oscillations of a blade between guides with a gap, in `gap.json`.

use std::f64::consts::TAU;

use faer::c64;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::gap::{AtSpeed, Motion, Oscillation};
use crate::scene::rpm;

/// Periodic motion of the blade under the steady side force of the map, with the gaps of the scene. Its causes are an
/// oscillating side force at the cut and `response.runout_m`, `flatness_m` and `imbalance_kg_m2` of the scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OscillationEntry {
    /// Steady side force at the rim at the cut.
    pub force_n: f64,
    /// Amplitude of the oscillating side force at the rim at the cut; 0 without one.
    pub oscillating_force_n: f64,
    /// Ratio of its frequency to that of rotation; 0 without one.
    pub oscillating_order: u32,
    /// The parts of the motion, by their order of the rotation speed.
    pub lines: Vec<OscillationLineEntry>,
    /// The motion at the speed of the map; null if no periodic motion was found.
    pub at: Option<OscillationAtEntry>,
    /// Deflection of the rim at the cut at the speed of the map without oscillation.
    pub still_deflection_m: f64,
    /// Relative change of the amplitude at the cut at the speed of the map with ten harmonics instead of six; null if no
    /// motion was found.
    pub harmonics_error_share: Option<f64>,
    /// Relative change of this amplitude with 24 modes at rest instead of 16; null if no motion was found.
    pub basis_error_share: Option<f64>,
    /// Rotation speeds of the series below, ascending.
    pub rpm: Vec<f64>,
    /// Mean deflection at the probe, whose sign is the side to which the blade leans; null where no stable periodic motion was
    /// found, and where the blade deflects by more than its thickness.
    pub probe_mean_m: Vec<Option<f64>>,
    /// Half of the difference between the largest and the smallest deflection at the probe.
    pub probe_amplitude_m: Vec<Option<f64>>,
    /// Mean deflection of the rim at the cut.
    pub cut_mean_m: Vec<Option<f64>>,
    /// Half of the difference between the largest and the smallest deflection of the rim at the cut.
    pub cut_amplitude_m: Vec<Option<f64>>,
}

/// A part of the motion, with a multiple of the rotation frequency.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OscillationLineEntry {
    /// Ratio of its frequency to that of rotation.
    pub order: u32,
    /// Causes of this part, such as "run-out" or "flatness"; "contact" if only the contact of the pads has this order.
    pub name: String,
    /// Amplitude at the probe at the speeds of the series.
    pub probe_m: Vec<Option<f64>>,
}

/// The motion at one speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OscillationAtEntry {
    /// Rotation speed.
    pub rpm: f64,
    /// Frequency of the motion.
    pub frequency_hz: f64,
    /// Deflection of the rim at the cut.
    pub cut: OscillationPlaceEntry,
    /// Deflection at the probe.
    pub probe: OscillationPlaceEntry,
    /// One-sided pads, in the order of the scene.
    pub pads: Vec<OscillationPadEntry>,
    /// Largest deflection of the blade, as an absolute value.
    pub largest_deflection_m: f64,
    /// Growth rate of the fastest small motion about this one, negative if all decay; null if it was not found.
    pub growth_per_s: Option<f64>,
    /// Frequency of that small motion, at most half of `frequency_hz`; a motion with exactly half has twice the period.
    pub growth_frequency_hz: Option<f64>,
    /// Whether no small motion about this one grows faster than the threshold of the scene.
    pub stable: bool,
}

/// A periodic deflection at a point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OscillationPlaceEntry {
    /// Mean deflection.
    pub mean_m: f64,
    /// Half of the difference between the largest and the smallest deflection.
    pub amplitude_m: f64,
    /// Largest deflection, as an absolute value.
    pub largest_m: f64,
    /// Amplitude of each part of the motion, in the order of `lines`.
    pub lines_m: Vec<f64>,
    /// Phase of each part, −180 to 180: the angle by which it precedes the time at which the oscillating force, or the wave of a
    /// shape at the angle 0, is largest, in angles of this part.
    pub phase_deg: Vec<f64>,
}

/// Forces and contact of a pad over one period of the motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OscillationPadEntry {
    /// Index among the guides of the scene.
    pub guide: usize,
    /// Mean force on the blade beyond the gap.
    pub mean_force_n: f64,
    /// Largest force, as an absolute value.
    pub largest_force_n: f64,
    /// Share of the period in which the pad touches the blade.
    pub contact_share: f64,
}

impl OscillationEntry {
    /// Reports an oscillation under a steady side force.
    pub(super) fn new(found: &Oscillation, force_n: f64) -> Self {
        let force = found.oscillators.force;
        let of = |of: fn(&AtSpeed) -> f64| -> Vec<Option<f64>> {
            let at = |at: &Option<AtSpeed>| at.as_ref().map(of);
            found.over_speed.iter().map(at).collect()
        };
        let line = |k: usize| {
            let order = (k as u32 + 1) * found.base_order;
            let size = |at: &Option<AtSpeed>| Some(at.as_ref()?.probe.harmonics_m.get(k)?.norm());
            OscillationLineEntry {
                order,
                name: found.name_of(order),
                probe_m: found.over_speed.iter().map(size).collect(),
            }
        };
        OscillationEntry {
            force_n,
            oscillating_force_n: force.map_or(0.0, |force| force.amplitude_n),
            oscillating_order: force.map_or(0, |force| force.order),
            lines: (0..found.harmonics).map(line).collect(),
            at: found.at.as_ref().map(|at| at_entry(at, found)),
            still_deflection_m: found.still_m,
            harmonics_error_share: found.harmonics_error,
            basis_error_share: found.basis_error,
            rpm: found.speeds_rad_per_s.iter().map(|s| rpm(*s)).collect(),
            probe_mean_m: of(|at| at.probe.mean_m),
            probe_amplitude_m: of(|at| at.probe.amplitude_m),
            cut_mean_m: of(|at| at.cut.mean_m),
            cut_amplitude_m: of(|at| at.cut.amplitude_m),
        }
    }
}

fn at_entry(at: &AtSpeed, found: &Oscillation) -> OscillationAtEntry {
    let pads = at.pads.iter().map(|pad| OscillationPadEntry {
        guide: pad.guide,
        mean_force_n: pad.mean_n,
        largest_force_n: pad.largest_n,
        contact_share: pad.contact_share,
    });
    OscillationAtEntry {
        rpm: rpm(at.speed_rad_per_s),
        frequency_hz: f64::from(found.base_order) * at.speed_rad_per_s / TAU,
        cut: place(&at.cut),
        probe: place(&at.probe),
        pads: pads.collect(),
        largest_deflection_m: at.largest_m,
        growth_per_s: at.growth.map(|(per_s, _)| per_s),
        growth_frequency_hz: at.growth.map(|(_, frequency)| frequency / TAU),
        stable: at.is_stable(found.threshold_per_s),
    }
}

fn place(motion: &Motion) -> OscillationPlaceEntry {
    let harmonics = || motion.harmonics_m.iter();
    OscillationPlaceEntry {
        mean_m: motion.mean_m,
        amplitude_m: motion.amplitude_m,
        largest_m: motion.largest_m,
        lines_m: harmonics().map(|w: &c64| w.norm()).collect(),
        phase_deg: harmonics().map(|w| w.arg().to_degrees()).collect(),
    }
}

/// Relative change of the amplitude above which the report contains a warning.
const LARGE_ERROR: f64 = 0.05;

/// Remarks on the validity of the oscillation.
pub(super) fn warnings(found: &Oscillation) -> Vec<String> {
    let at = found.at.as_ref();
    let mut warnings = Vec::new();
    if at.is_none() {
        warnings.push(
            "no periodic motion was found at the speed of the map: the blade may chatter between its guides without a period"
                .to_owned(),
        );
    }
    if let Some(at) = at.filter(|at| !at.is_stable(found.threshold_per_s)) {
        let half = 0.5 * f64::from(found.base_order) * at.speed_rad_per_s;
        let (_, frequency) = at.growth.unwrap_or_default();
        let what = match (frequency / half - 1.0).abs() < 1e-3 {
            true => "a motion of twice the period (a subharmonic, X/2) takes its place",
            false => "small motions about it grow",
        };
        warnings.push(format!(
            "the periodic motion at the speed of the map is unstable: {what}"
        ));
    }
    let errors = [
        ("harmonics", found.harmonics_error),
        ("modes at rest", found.basis_error),
    ];
    for (what, error) in errors {
        if let Some(error) = error.filter(|error| *error > LARGE_ERROR) {
            warnings.push(format!(
                "the oscillation at the cut is not converged: with more {what} its amplitude changes by {:.0} %",
                1e2 * error
            ));
        }
    }
    warnings
}
