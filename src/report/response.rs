//! `response.json`: steady-state amplitude and phase over the speed, and over the frequency at one speed.

use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::response::{Cause, Deflection, ForcedResponse, FrequencyResponse, ResponseLine};
use crate::scene::typical_value;
use crate::scene::{SceneFile, rad_per_s, rpm};
use crate::stability::StabilityState;
use crate::text::shown;

use super::instability::InstabilityEntry;

/// Report of steady-state responses (`response.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ResponseReport {
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
    /// First speed.
    pub from_rpm: f64,
    /// Last speed.
    pub to_rpm: f64,
    /// Distance of the probe from the axis.
    pub probe_radius_m: f64,
    /// Angle of the probe.
    pub probe_angle_deg: f64,
    /// Angle of the cut, at whose place on the rim the deviation of the board is read.
    pub cut_angle_deg: f64,
    /// Whether any term of the equation of motion dissipates energy; without damping amplitudes grow without bound at a
    /// resonance.
    pub damped: bool,
    /// Largest amplitude that is reported: five times the smallest thickness.
    pub linear_limit_m: f64,
    /// Rotation speeds, ascending, the same for every line.
    pub rpm: Vec<f64>,
    /// Responses, one for each cause and order of the rotation speed.
    pub lines: Vec<ResponseLineEntry>,
    /// Largest distance of the cut surface from the middle plane of the blade at rest, at each speed: the static deflection of
    /// the rim at the cut and all amplitudes there, as if their maxima coincided; null where one of them is null.
    pub board_deviation_m: Vec<Option<f64>>,
    /// Deflections at the operating speed; null if it is not within the sweep.
    pub operating: Option<OperatingResponseEntry>,
    /// Frequency response between two points at one speed; null if neither the scene nor the options have a speed.
    pub points: Option<FrequencyResponseEntry>,
    /// Bands of instability, in which no steady state exists.
    pub instabilities: Vec<InstabilityEntry>,
    /// Remarks on the validity of the result.
    pub warnings: Vec<String>,
}

/// Cause of an excitation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CauseEntry {
    /// Constant lateral force, fixed in space.
    SideForce,
    /// One wave around the rim.
    RunOut,
    /// Two waves around the rim.
    Flatness,
    /// Imbalance beside the middle plane.
    Imbalance,
    /// Lateral force at the cut with the tooth passing frequency.
    ToothPassing,
}

/// Response to one cause with one order.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ResponseLineEntry {
    /// The cause.
    pub cause: CauseEntry,
    /// Ratio of the frequency to the rotation speed; 0 for a static deflection.
    pub order: u32,
    /// Name: "run-out, 1×".
    pub name: String,
    /// Amplitude at the probe; null where the saw is unstable, and where the deflection exceeds the linear model anywhere on
    /// the rim.
    pub amplitude_m: Vec<Option<f64>>,
    /// Phase at the probe, −180 to 180: positive if the deflection precedes the excitation. The excitation is largest at the
    /// time at which its maximum passes the angle 0, or the force is largest.
    pub phase_deg: Vec<Option<f64>>,
    /// Amplitude at the rim at the cut.
    pub at_cut_m: Vec<Option<f64>>,
    /// Speeds at which a natural frequency equals that of the excitation, up to the frequency to which the diagram is complete.
    pub resonances: Vec<ResonanceEntry>,
}

/// A resonance of a line.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ResonanceEntry {
    /// Rotation speed.
    pub rpm: f64,
    /// Frequency of the force.
    pub frequency_hz: f64,
    /// Amplitude at the probe there; null where it grows without bound or beyond the linear model, or the saw is unstable.
    pub amplitude_m: Option<f64>,
}

/// Deflections at the operating speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OperatingResponseEntry {
    /// The operating speed.
    pub rpm: f64,
    /// Amplitude of each line at the probe.
    pub amplitude_m: Vec<Option<f64>>,
    /// Deviation of the board.
    pub board_deviation_m: Option<f64>,
}

/// Deflection at the probe for a harmonic force of one newton at the place of the side force.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrequencyResponseEntry {
    /// Rotation speed.
    pub rpm: f64,
    /// Distance of the force from the axis.
    pub force_radius_m: f64,
    /// Angle of the force.
    pub force_angle_deg: f64,
    /// Frequencies, ascending.
    pub frequency_hz: Vec<f64>,
    /// Amplitude for one newton; null where it grows without bound, and everywhere if the saw is unstable at the speed.
    pub receptance_m_per_n: Vec<Option<f64>>,
    /// Phase, −180 to 180: negative if the deflection follows the force.
    pub phase_deg: Vec<Option<f64>>,
}

impl ResponseReport {
    /// The report of responses.
    pub fn new(found: &ForcedResponse) -> Self {
        let (scene, chart) = (&found.scene, found.analysis.report());
        let limit = found.linear_limit_m();
        let rpm_of: Vec<f64> = found.speeds_rad_per_s.iter().map(|s| rpm(*s)).collect();
        let lines: Vec<ResponseLineEntry> = found
            .lines
            .iter()
            .map(|line| line_entry(line, &found.speeds_rad_per_s))
            .collect();
        let board = found.board_deviation_m();
        let operating = scene.file().operating_rpm.and_then(|asked| {
            // The speeds were converted to rad/s and back, so that they agree with the operating speed only
            // up to rounding.
            let is_same = |rpm: &f64| (rpm / asked - 1.0).abs() < 1e-9;
            let place = rpm_of.iter().position(is_same)?;
            Some(OperatingResponseEntry {
                rpm: asked,
                amplitude_m: lines.iter().map(|line| line.amplitude_m[place]).collect(),
                board_deviation_m: board[place],
            })
        });
        let (radius_m, angle_rad) = found.force_place();
        let points = found
            .points
            .as_ref()
            .map(|points| points_entry(points, (radius_m, angle_rad.to_degrees())));
        let (probe_radius_m, probe_angle_rad) = found.probe_place();
        ResponseReport {
            sawflutter: chart.sawflutter,
            scene: scene.file().clone(),
            condition: scene.condition(),
            unusual_numbers: chart.unusual_numbers,
            degrees_of_freedom: chart.accuracy.degrees_of_freedom,
            from_rpm: chart.campbell.from_rpm,
            to_rpm: chart.campbell.to_rpm,
            probe_radius_m,
            probe_angle_deg: probe_angle_rad.to_degrees(),
            cut_angle_deg: scene.file().cut.as_ref().map_or(0.0, |cut| cut.angle_deg),
            damped: !found.analysis.model.is_conservative(),
            linear_limit_m: limit,
            warnings: warnings(found, &lines, chart.warnings),
            instabilities: chart.instabilities,
            rpm: rpm_of,
            lines,
            board_deviation_m: board,
            operating,
            points,
        }
    }
}

fn line_entry(line: &ResponseLine, speeds_rad_per_s: &[f64]) -> ResponseLineEntry {
    let of = |of: fn(&Deflection) -> f64| -> Vec<Option<f64>> {
        let at = |found: &Option<Deflection>| found.as_ref().map(of);
        line.deflections.iter().map(at).collect()
    };
    let amplitude_m = of(|w| w.at_probe.norm());
    let resonances = line.resonances_rad_per_s.iter().map(|speed| {
        let place = speeds_rad_per_s.partition_point(|other| other < speed);
        ResonanceEntry {
            rpm: rpm(*speed),
            frequency_hz: f64::from(line.order) * speed / TAU,
            amplitude_m: amplitude_m.get(place).copied().flatten(),
        }
    });
    let order = line.order;
    let (cause, name) = match line.cause {
        Cause::SideForce => (CauseEntry::SideForce, "side force, static".to_owned()),
        Cause::RunOut => (CauseEntry::RunOut, format!("run-out, {order}×")),
        Cause::Flatness => (CauseEntry::Flatness, format!("flatness, {order}×")),
        Cause::Imbalance => (CauseEntry::Imbalance, format!("imbalance, {order}×")),
        Cause::ToothPassing => (CauseEntry::ToothPassing, format!("tooth passing, {order}×")),
    };
    ResponseLineEntry {
        cause,
        order,
        name,
        resonances: resonances.collect(),
        phase_deg: of(|w| w.at_probe.arg().to_degrees()),
        at_cut_m: of(|w| w.at_cut.norm()),
        amplitude_m,
    }
}

fn points_entry(
    points: &FrequencyResponse,
    (force_radius_m, force_angle_deg): (f64, f64),
) -> FrequencyResponseEntry {
    let found = &points.receptance_m_per_n;
    FrequencyResponseEntry {
        rpm: rpm(points.speed_rad_per_s),
        force_radius_m,
        force_angle_deg,
        frequency_hz: points.frequency_rad_per_s.iter().map(|w| w / TAU).collect(),
        receptance_m_per_n: found.iter().map(|w| Some(w.as_ref()?.norm())).collect(),
        phase_deg: found
            .iter()
            .map(|w| Some(w.as_ref()?.arg().to_degrees()))
            .collect(),
    }
}

fn warnings(
    found: &ForcedResponse,
    lines: &[ResponseLineEntry],
    of_chart: Vec<String>,
) -> Vec<String> {
    let mut warnings = of_chart;
    if found.is_assumed {
        warnings.push(format!(
            "the scene has no excitation; a constant side force of {} N was assumed, set response.force_n, response.runout_m or others",
            shown(const { typical_value("response.force_n") })
        ));
    }
    let thickness = found.scene.blade().thickness_m;
    let all = lines.iter().flat_map(|line| &line.amplitude_m).flatten();
    let largest = all.copied().fold(0.0, f64::max);
    if largest > thickness {
        warnings.push(format!(
            "amplitudes above the thickness of the blade, {} mm, are overestimates: the blade stretches, which the linear model neglects",
            shown(1e3 * thickness)
        ));
    }
    let unbounded: usize = lines
        .iter()
        .flat_map(|line| &line.resonances)
        .filter(|resonance| {
            let speed = rad_per_s(resonance.rpm);
            let state = found.analysis.verdict(speed).state;
            resonance.amplitude_m.is_none() && state == StabilityState::Stable
        })
        .count();
    if unbounded > 0 {
        let why = match found.analysis.model.is_conservative() {
            true => "the scene has no damping, so that amplitudes grow without bound there",
            false => "amplitudes exceed five thicknesses of the blade there",
        };
        warnings.push(format!(
            "at {unbounded} resonances no amplitude is given: {why}"
        ));
    }
    warnings
}
