//! `runup.json`: the deflection of the saw during a run-up, and its causes.

use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::chart::CampbellEntry;
use super::critical_speed::CriticalSpeedEntry;
use super::instability::InstabilityEntry;
use crate::scene::{SceneFile, rpm};
use crate::transient::{RunningUp, linear_limit_m};

/// Report of a run-up (`runup.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RunUpReport {
    /// Version of the program that wrote the report.
    pub sawflutter: String,
    /// The scene, as typed.
    pub scene: SceneFile,
    /// Whether the saw idles or is in its cut: "idling", or "in the cut at 2800 rpm (4 teeth)".
    #[serde(default)]
    pub condition: String,
    /// Numbers that no saw has, each with its key, the usual range, and the remedy. The results hold for the
    /// numbers as typed.
    #[serde(default)]
    pub unusual_numbers: Vec<String>,
    /// Size of the basis.
    pub degrees_of_freedom: usize,
    /// First speed of the run-up.
    pub from_rpm: f64,
    /// Last speed of the run-up.
    pub to_rpm: f64,
    /// Rate of the run-up.
    pub rate_rpm_per_s: f64,
    /// Time step.
    pub step_s: f64,
    /// Largest deflection that is given; beyond it the linear model is not valid.
    pub linear_limit_m: f64,
    /// Speed at which the deflection at the probe exceeds this limit and the record ends; null if it does not.
    pub linear_until_rpm: Option<f64>,
    /// Speeds of the record.
    pub rpm: Vec<f64>,
    /// Deflection at the probe.
    pub deflection_m: Vec<f64>,
    /// Critical speeds up to the end of the run-up.
    pub critical_speeds: Vec<CriticalSpeedEntry>,
    /// Bands of instability and their effect on the run-up.
    pub bands: Vec<RunUpBand>,
    /// Onset of the first band that more than doubles a motion at this rate; null if none does.
    pub first_doubling_rpm: Option<f64>,
    /// Results with stretching, if the scene requests it.
    #[serde(default)]
    pub stretching: Option<StretchingEntry>,
    /// Branches over the speeds of the run-up.
    pub campbell: CampbellEntry,
    /// Response over speed and frequency.
    pub response: ResponseEntry,
    /// Remarks on the validity of the result.
    pub warnings: Vec<String>,
}

/// A band of instability in a run-up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RunUpBand {
    /// The band.
    pub band: InstabilityEntry,
    /// Time that the run-up spends in the band.
    pub time_s: f64,
    /// Re λ of the band's eigenvalue integrated over that time: a motion in its mode grows by e to this
    /// power.
    pub growth_exponent: f64,
    /// Ratio of the largest deflection at the probe within the band to that in an interval of equal length
    /// before it; null if the record ends before the band does. All vibrating modes contribute: with a small
    /// exponent the ratio shows beating of other modes, not growth.
    pub seen_amplification: Option<f64>,
}

/// A run-up with stretching.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StretchingEntry {
    /// Number of shapes of the reduced basis.
    pub shapes: usize,
    /// Largest slope of the blade.
    pub largest_slope: f64,
    /// Speed from which on slopes exceed 0.1 and the record ends; null if they do not.
    pub valid_until_rpm: Option<f64>,
    /// Speeds of the spectrum.
    pub rpm: Vec<f64>,
    /// Frequencies of the spectrum.
    pub frequency_hz: Vec<f64>,
    /// Amplitude at the probe about a straight line, with Hann's window, one row for each speed.
    pub amplitude_m: Vec<Vec<f64>>,
}

/// Magnitude of the deflection at the probe for a harmonic force of one newton, over speed and frequency.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ResponseEntry {
    /// Rotation speeds.
    pub rpm: Vec<f64>,
    /// Frequencies of the force.
    pub frequency_hz: Vec<f64>,
    /// |w/F|, one row for each speed.
    pub receptance_m_per_n: Vec<Vec<f64>>,
}

impl RunUpReport {
    /// The report of a run-up.
    pub fn new(found: &RunningUp) -> Self {
        let (scene, runup) = (&found.scene, &found.runup);
        let chart = found.analysis.report();
        let history = &found.history;
        let speeds: Vec<f64> = history.speed_rad_per_s.iter().map(|s| rpm(*s)).collect();
        let rate_rpm_per_s = rpm(runup.acceleration_rad_per_s2());
        let linear_until_rpm = history.linear_until_rad_per_s.map(rpm);
        let valid_until = found.stretched.as_ref();
        let valid_until = valid_until.and_then(|found| found.valid_until_rad_per_s);
        let ends_rpm = linear_until_rpm.or(valid_until.map(rpm));
        let within = |band: &InstabilityEntry| ends_rpm.is_none_or(|end| band.to_rpm < end);
        let bands: Vec<RunUpBand> = chart
            .instabilities
            .into_iter()
            .zip(&found.growth_exponents)
            .map(|(band, growth_exponent)| RunUpBand {
                time_s: (band.to_rpm - band.from_rpm) / rate_rpm_per_s,
                growth_exponent: *growth_exponent,
                seen_amplification: within(&band)
                    .then(|| seen_amplification(&speeds, &history.deflection_m, &band))
                    .flatten(),
                band,
            })
            .collect();
        let response = &found.response;
        RunUpReport {
            sawflutter: chart.sawflutter,
            scene: scene.file().clone(),
            condition: scene.condition(),
            unusual_numbers: chart.unusual_numbers,
            degrees_of_freedom: chart.accuracy.degrees_of_freedom,
            from_rpm: rpm(runup.speeds().from_rad_per_s),
            to_rpm: rpm(runup.speeds().to_rad_per_s),
            rate_rpm_per_s,
            linear_limit_m: linear_limit_m(scene.blade()),
            linear_until_rpm,
            step_s: history.step_s,
            deflection_m: history.deflection_m.clone(),
            critical_speeds: chart.critical_speeds,
            first_doubling_rpm: first_doubling_rpm(&bands),
            bands,
            campbell: chart.campbell,
            response: ResponseEntry {
                rpm: response.speed_rad_per_s.iter().map(|s| rpm(*s)).collect(),
                frequency_hz: response
                    .frequency_rad_per_s
                    .iter()
                    .map(|w| w / TAU)
                    .collect(),
                receptance_m_per_n: response.receptance_m_per_n.clone(),
            },
            stretching: found.stretched.as_ref().map(|found| {
                let spectrum = &found.spectrum;
                let hz = |w: &f64| w / TAU;
                StretchingEntry {
                    shapes: found.shapes,
                    largest_slope: found.largest_slope,
                    valid_until_rpm: found.valid_until_rad_per_s.map(rpm),
                    rpm: spectrum.speed_rad_per_s.iter().map(|s| rpm(*s)).collect(),
                    frequency_hz: spectrum.frequency_rad_per_s.iter().map(hz).collect(),
                    amplitude_m: spectrum.amplitude_m.clone(),
                }
            }),
            warnings: chart.warnings,
            rpm: speeds,
        }
    }
}

/// Exponent of a motion that doubles.
const DOUBLING: f64 = std::f64::consts::LN_2;

fn first_doubling_rpm(bands: &[RunUpBand]) -> Option<f64> {
    let doubling = bands.iter().filter(|band| band.growth_exponent > DOUBLING);
    let onsets = doubling.map(|band| band.band.from_rpm);
    onsets.min_by(f64::total_cmp)
}

/// Ratio of the largest deflection in the band to that in an interval of equal length before it.
fn seen_amplification(rpm: &[f64], deflection_m: &[f64], band: &InstabilityEntry) -> Option<f64> {
    let largest = |from: f64, to: f64| {
        let record = rpm.iter().zip(deflection_m);
        let within = record.filter(|(speed, _)| (from..=to).contains(*speed));
        within.map(|(_, w)| w.abs()).reduce(f64::max)
    };
    let width = band.to_rpm - band.from_rpm;
    let before = largest(band.from_rpm - width, band.from_rpm)?;
    let inside = largest(band.from_rpm, band.to_rpm)?;
    (before > 0.0).then(|| inside / before)
}
