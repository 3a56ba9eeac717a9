//! `deflect.json`: equilibria of the blade while its speed slowly rises and falls.

use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::chart::CampbellEntry;
use super::critical_speed::CriticalSpeedEntry;
use super::instability::InstabilityEntry;
use crate::deflect::{Curve, Deflecting, Reading, SlowSweep};
use crate::scene::{SceneFile, rpm};
use crate::stretched::TurnKind;

/// Report of the equilibria over speed (`deflect.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DeflectReport {
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
    /// Number of shapes of the reduced basis.
    pub shapes: usize,
    /// Largest relative change of the deflection with half as many modes more; null if the blade remains
    /// flat.
    pub estimated_relative_error: Option<f64>,
    /// Estimated relative error of a small deflection at the force, at rest, on the basis from which the shapes are
    /// made; null without a force, and for a blade that is buckled at rest.
    #[serde(default)]
    pub basis_error: Option<f64>,
    /// First speed.
    pub from_rpm: f64,
    /// Last speed.
    pub to_rpm: f64,
    /// Lateral force at the rim, fixed in space.
    pub force_n: f64,
    /// Angle of the force, positive in the direction of rotation.
    pub force_angle_deg: f64,
    /// Distance of the probe from the axis.
    pub probe_radius_m: f64,
    /// Angle of the probe.
    pub probe_angle_deg: f64,
    /// Rising speed up to which the deflection stays within the thickness everywhere; null if it does at all
    /// speeds.
    pub beyond_thickness_rpm: Option<f64>,
    /// Stable equilibria for rising speed.
    pub up: SlowSweepEntry,
    /// Stable equilibria for falling speed.
    pub down: SlowSweepEntry,
    /// Curves of equilibria, including unstable ones. It is not proven that there are no others.
    pub curves: Vec<EquilibriumCurveEntry>,
    /// Critical speeds of the flat blade, up to the last speed.
    pub critical_speeds: Vec<CriticalSpeedEntry>,
    /// Bands in which the flat blade is unstable, by the linear model.
    pub instabilities: Vec<InstabilityEntry>,
    /// Branches of the flat blade over the same speeds.
    pub campbell: CampbellEntry,
    /// Remarks on the validity of the result.
    pub warnings: Vec<String>,
}

/// Stable equilibria for slowly rising or falling speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SlowSweepEntry {
    /// Arcs between jumps, in the order of the sweep.
    pub arcs: Vec<ArcEntry>,
    /// Jumps at the ends of all arcs but the last.
    pub jumps: Vec<JumpEntry>,
    /// Speed from which on slopes of the blade exceed 0.1, where the model is not valid; there are no results
    /// beyond it. Null if they do not.
    pub valid_until_rpm: Option<f64>,
    /// Speed at which the sweep stopped at its largest number of equilibria; there are no results beyond it. Null if it
    /// did not.
    #[serde(default)]
    pub stopped_at_rpm: Option<f64>,
}

/// Stable equilibria. All lists have one entry for each speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ArcEntry {
    /// Rotation speeds, rising or falling.
    pub rpm: Vec<f64>,
    /// Deflection at the probe.
    pub deflection_m: Vec<f64>,
    /// Largest magnitude of the deflection over the blade.
    pub largest_deflection_m: Vec<f64>,
    /// Largest slope of the blade.
    pub largest_slope: Vec<f64>,
    /// Force of each pad that lifts off on the blade beyond its gap, without that of its film: a row for each such guide, in
    /// the order of the scene.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pad_forces_n: Vec<Vec<f64>>,
    /// Frequencies of small motions about the deflected blade in space, ascending, up to `campbell.complete_to_hz`.
    pub frequencies_hz: Vec<Vec<f64>>,
}

/// A jump from an equilibrium that ceases to be stable to another one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JumpEntry {
    /// Fold, beyond which the equilibrium does not exist, or bifurcation, at which another one crosses it.
    pub kind: TurnKind,
    /// Rotation speed.
    pub rpm: f64,
    /// Deflection at the probe before the jump.
    pub from_m: f64,
    /// Deflection at the probe after the jump.
    pub to_m: f64,
    /// Largest deflection over the blade before the jump.
    pub largest_from_m: f64,
    /// Largest deflection over the blade after the jump.
    pub largest_to_m: f64,
}

/// A curve of equilibria. All lists have one entry for each equilibrium, in the order of the curve.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EquilibriumCurveEntry {
    /// Rotation speeds, not necessarily ascending.
    pub rpm: Vec<f64>,
    /// Deflection at the probe.
    pub deflection_m: Vec<f64>,
    /// Largest magnitude of the deflection over the blade.
    pub largest_deflection_m: Vec<f64>,
    /// Number of directions in which the potential energy decreases; 0 for a stable equilibrium.
    pub negative_eigenvalues: Vec<usize>,
    /// Folds and bifurcations of the curve.
    pub turns: Vec<TurnEntry>,
}

/// A fold or a bifurcation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TurnEntry {
    /// Kind of the turning point.
    pub kind: TurnKind,
    /// Rotation speed.
    pub rpm: f64,
    /// Deflection at the probe.
    pub deflection_m: f64,
}

impl DeflectReport {
    /// The report of the equilibria.
    pub fn new(found: &Deflecting) -> Self {
        let chart = found.analysis.report();
        let to_hz = chart.campbell.complete_to_hz;
        let thickness_m = found.scene.blade().thickness_range_m().0;
        let probe = found.scene.probe();
        DeflectReport {
            sawflutter: chart.sawflutter,
            scene: found.scene.file().clone(),
            condition: found.scene.condition(),
            unusual_numbers: chart.unusual_numbers,
            degrees_of_freedom: chart.accuracy.degrees_of_freedom,
            shapes: found.shapes,
            estimated_relative_error: found.estimated_relative_error,
            basis_error: found.basis_error,
            from_rpm: chart.campbell.from_rpm,
            to_rpm: chart.campbell.to_rpm,
            force_n: found.force.force_n,
            force_angle_deg: found.force.angle_rad.to_degrees(),
            probe_radius_m: probe.radius_m,
            probe_angle_deg: probe.angle_rad.to_degrees(),
            beyond_thickness_rpm: beyond_rpm(&found.up, thickness_m),
            up: SlowSweepEntry::new(&found.up, to_hz),
            down: SlowSweepEntry::new(&found.down, to_hz),
            curves: found
                .curves
                .iter()
                .map(EquilibriumCurveEntry::new)
                .collect(),
            critical_speeds: chart.critical_speeds,
            instabilities: chart.instabilities,
            campbell: chart.campbell,
            warnings: chart.warnings.into_iter().chain(cut_off(found)).collect(),
        }
    }
}

/// Remark on curves that end at the largest number of equilibria of a figure.
fn cut_off(found: &Deflecting) -> Option<String> {
    let count = found.curves.iter().filter(|curve| !curve.is_whole).count();
    (count > 0).then(|| {
        format!(
            "{count} of {} curves of equilibria end at the largest number of equilibria of a figure, within the range of speeds",
            found.curves.len()
        )
    })
}

/// Speed at which the largest deflection first exceeds a limit, by linear interpolation between two
/// equilibria.
fn beyond_rpm(sweep: &SlowSweep, limit_m: f64) -> Option<f64> {
    let mut before: Option<&Reading> = None;
    for at in sweep.readings() {
        if at.largest_m > limit_m {
            let speed = at.speed_rad_per_s;
            let crossed = before.map_or(speed, |before| {
                let share = (limit_m - before.largest_m) / (at.largest_m - before.largest_m);
                before.speed_rad_per_s + share * (speed - before.speed_rad_per_s)
            });
            return Some(rpm(crossed));
        }
        before = Some(at);
    }
    None
}

impl SlowSweepEntry {
    fn new(sweep: &SlowSweep, to_hz: f64) -> Self {
        let jumps = sweep.jumps.iter().map(|jump| JumpEntry {
            kind: jump.kind,
            rpm: rpm(jump.speed_rad_per_s),
            from_m: jump.deflection_m[0],
            to_m: jump.deflection_m[1],
            largest_from_m: jump.largest_m[0],
            largest_to_m: jump.largest_m[1],
        });
        SlowSweepEntry {
            arcs: sweep
                .arcs
                .iter()
                .map(|arc| ArcEntry::new(arc, to_hz))
                .collect(),
            jumps: jumps.collect(),
            valid_until_rpm: sweep.valid_until_rad_per_s.map(rpm),
            stopped_at_rpm: sweep.stopped_rad_per_s.map(rpm),
        }
    }
}

impl ArcEntry {
    fn new(arc: &[Reading], to_hz: f64) -> Self {
        let of = |value: fn(&Reading) -> f64| arc.iter().map(value).collect();
        let frequencies = |at: &Reading| {
            let all = at.eigenvalues_per_s.iter().map(|lambda| lambda.im / TAU);
            let mut below: Vec<f64> = all.filter(|hz| *hz <= to_hz).collect();
            below.sort_by(f64::total_cmp);
            below
        };
        let pads = arc.first().map_or(0, |at| at.pad_forces_n.len());
        let of_pad = |pad: usize| arc.iter().map(|at| at.pad_forces_n[pad]).collect();
        ArcEntry {
            pad_forces_n: (0..pads).map(of_pad).collect(),
            rpm: of(|at| rpm(at.speed_rad_per_s)),
            deflection_m: of(|at| at.deflection_m),
            largest_deflection_m: of(|at| at.largest_m),
            largest_slope: of(|at| at.largest_slope),
            frequencies_hz: arc.iter().map(frequencies).collect(),
        }
    }
}

impl EquilibriumCurveEntry {
    fn new(curve: &Curve) -> Self {
        let of = |value: fn(&Reading) -> f64| curve.readings.iter().map(value).collect();
        let counts = curve.readings.iter().map(|at| at.negative_eigenvalues);
        let turns = curve.turns.iter();
        EquilibriumCurveEntry {
            rpm: of(|at| rpm(at.speed_rad_per_s)),
            deflection_m: of(|at| at.deflection_m),
            largest_deflection_m: of(|at| at.largest_m),
            negative_eigenvalues: counts.collect(),
            turns: turns
                .map(|(kind, speed, deflection_m)| TurnEntry {
                    kind: *kind,
                    rpm: rpm(*speed),
                    deflection_m: *deflection_m,
                })
                .collect(),
        }
    }
}
