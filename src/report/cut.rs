//! `cut.json`: what the saw does in the cut.

use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::SplineEntry;
use crate::scene::{Scene, SceneFile, unusual};
use crate::transient::{Cutting, CuttingRun, Growth, ToothPassing, VerdictMap};

/// `cut.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CutReport {
    /// Version of the program that wrote the report.
    pub sawflutter: String,
    /// The scene, as typed.
    pub scene: SceneFile,
    /// Size of the basis.
    pub degrees_of_freedom: usize,
    /// Growth rate from which a cut is called unstable.
    pub flutter_threshold_per_s: f64,
    /// Angles of the teeth in the cut.
    pub tooth_angles_deg: Vec<f64>,
    /// One entry a speed.
    pub runs: Vec<CutRunEntry>,
    /// Remarks on the forces and on the validity of the result.
    pub warnings: Vec<String>,
}

/// Whether a motion grows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// No motion grows as fast as the threshold.
    Stable,
    /// Some motion does.
    Unstable,
}

/// One speed of the cut.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CutRunEntry {
    /// Rotation speed.
    pub rpm: f64,
    /// Force against the rotation on each tooth.
    pub tangential_n_per_tooth: f64,
    /// Force towards the axis on each tooth.
    pub radial_n_per_tooth: f64,
    /// Force across the blade on each tooth.
    pub lateral_n_per_tooth: f64,
    /// In the cut, by the eigenvalues.
    pub verdict: Verdict,
    /// Largest Re λ in the cut.
    pub growth_per_s: f64,
    /// Frequency of the growing mode; of the largest oscillation where none grows.
    pub frequency_hz: Option<f64>,
    /// In the cut, by the time history; null where no lateral force moves the blade.
    pub transient_verdict: Option<Verdict>,
    /// Growth rate fitted on the deflection in the cut.
    pub transient_growth_per_s: Option<f64>,
    /// Frequency of the growth fitted on the deflection, where it is unstable.
    pub transient_frequency_hz: Option<f64>,
    /// Whether both verdicts are the same, and growth rates within 2 % where there is
    /// growth.
    pub agree: Option<bool>,
    /// Frequency of the largest oscillation in the cut.
    pub dominant_frequency_hz: Option<f64>,
    /// Before and after the cut, by the eigenvalues.
    pub idle_verdict: Verdict,
    /// Largest Re λ without the forces.
    pub idle_growth_per_s: f64,
    /// The same cut with the tangential force that the power allows, when it is given.
    pub by_power: Option<ByPowerEntry>,
    /// Loads that pass with the teeth against loads that stand still.
    pub tooth_passing: ToothPassingEntry,
    /// Largest deflection at the probe before the forces end.
    pub largest_deflection_in_cut_m: f64,
    /// Largest deflection at the probe after the forces ended.
    pub largest_deflection_after_m: f64,
    /// When the forces set in.
    pub forces_from_s: f64,
    /// When they end.
    pub forces_to_s: f64,
    /// Times of the record.
    pub time_s: Vec<f64>,
    /// Deflection at the probe.
    pub deflection_m: Vec<f64>,
    /// Verdict over guide angle and load.
    pub map: VerdictMapEntry,
    /// The cut with the reaction of the simulated spline teeth, when the scene asks for it.
    pub spline: Option<SplineEntry>,
}

/// A cut with the force that its power allows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ByPowerEntry {
    /// P/(Ωb) shared by the teeth.
    pub tangential_n_per_tooth: f64,
    /// By the eigenvalues.
    pub verdict: Verdict,
    /// Largest Re λ.
    pub growth_per_s: f64,
}

/// What it changes that the loads pass with the teeth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ToothPassingEntry {
    /// Teeth passing a second.
    pub tooth_frequency_hz: f64,
    /// Growth under loads that stand still.
    pub standing_growth_per_s: f64,
    /// Growth under the mean of the passing loads.
    pub mean_growth_per_s: f64,
    /// Growth under the passing loads, from Floquet multipliers.
    pub passing_growth_per_s: f64,
    /// Largest deflection at the probe in the cut under loads that stand still.
    pub standing_deflection_m: f64,
    /// The same under passing loads.
    pub passing_deflection_m: f64,
}

/// Growth rates over guide angle and load.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VerdictMapEntry {
    /// Angles of the first guide, all guides moving with it.
    pub guide_angle_deg: Vec<f64>,
    /// Multiples of the radial and tangential forces.
    pub load_level: Vec<f64>,
    /// One row a load level, one column an angle.
    pub growth_per_s: Vec<Vec<f64>>,
}

/// What the two verdicts may differ by in growth.
const AGREEMENT: f64 = 0.02;

impl CutReport {
    /// Reports a cut.
    pub fn new(scene: &Scene, cutting: &Cutting) -> Self {
        let runs: Vec<CutRunEntry> = cutting
            .runs
            .iter()
            .map(|run| CutRunEntry::new(scene, run))
            .collect();
        let thickness_m = scene.blade().thickness_m;
        CutReport {
            sawflutter: env!("CARGO_PKG_VERSION").to_owned(),
            scene: scene.file().clone(),
            degrees_of_freedom: cutting.plate.degrees_of_freedom(),
            flutter_threshold_per_s: scene.flutter_threshold_per_s(),
            tooth_angles_deg: cutting
                .cut
                .tooth_angles_rad()
                .map(f64::to_degrees)
                .collect(),
            warnings: unusual(scene.file())
                .into_iter()
                .chain(runs.iter().flat_map(|run| warnings(run, thickness_m)))
                .collect(),
            runs,
        }
    }
}

impl CutRunEntry {
    fn new(scene: &Scene, computed: &CuttingRun) -> Self {
        let CuttingRun {
            history,
            passing,
            map,
            spline,
        } = computed;
        let of = |growth: f64| Verdict::of(scene, growth);
        let run = history.run;
        let verdict = of(history.in_cut.growth_per_s);
        let transient_verdict = history.fitted.map(|fitted| of(fitted.growth_per_s));
        let dominant = history.dominant_rad_per_s;
        let (_, end_s) = history.forces_s;
        let largest = |after: bool| {
            let record = history.time_s.iter().zip(&history.deflection_m);
            record
                .filter(|(time, _)| (**time > end_s) == after)
                .fold(0.0_f64, |max, (_, w)| max.max(w.abs()))
        };
        let growing = Some(history.in_cut).filter(|growth| growth.growth_per_s > 0.0);
        CutRunEntry {
            rpm: run.rpm,
            tangential_n_per_tooth: run.tangential_n,
            radial_n_per_tooth: run.radial_n,
            lateral_n_per_tooth: run.lateral_n,
            verdict,
            growth_per_s: history.in_cut.growth_per_s,
            frequency_hz: growing
                .map(|growth| growth.frequency_rad_per_s)
                .or(dominant)
                .map(hertz),
            agree: transient_verdict
                .zip(history.fitted)
                .map(|(seen, fitted)| seen == verdict && close(verdict, fitted, history.in_cut)),
            transient_verdict,
            transient_growth_per_s: history.fitted.map(|fitted| fitted.growth_per_s),
            transient_frequency_hz: history
                .fitted
                .filter(|fitted| of(fitted.growth_per_s) == Verdict::Unstable)
                .map(|fitted| hertz(fitted.frequency_rad_per_s)),
            dominant_frequency_hz: dominant.map(hertz),
            idle_verdict: of(history.idle.growth_per_s),
            idle_growth_per_s: history.idle.growth_per_s,
            by_power: run.tangential_of_power_n.zip(history.in_cut_by_power).map(
                |(tangential_n_per_tooth, growth)| ByPowerEntry {
                    tangential_n_per_tooth,
                    verdict: of(growth.growth_per_s),
                    growth_per_s: growth.growth_per_s,
                },
            ),
            tooth_passing: passing.into(),
            largest_deflection_in_cut_m: largest(false),
            largest_deflection_after_m: largest(true),
            forces_from_s: history.forces_s.0,
            forces_to_s: end_s,
            time_s: history.time_s.clone(),
            deflection_m: history.deflection_m.clone(),
            map: VerdictMapEntry::new(scene, map),
            spline: spline.as_ref().map(|found| SplineEntry::new(scene, found)),
        }
    }
}

impl VerdictMapEntry {
    fn new(scene: &Scene, map: &VerdictMap) -> Self {
        let guide_deg = scene
            .guides()
            .first()
            .map_or(0.0, |guide| guide.angle_rad.to_degrees());
        let angle = |turn: &f64| guide_deg + turn.to_degrees();
        VerdictMapEntry {
            guide_angle_deg: map.turns_rad.iter().map(angle).collect(),
            load_level: map.load_levels.clone(),
            growth_per_s: map.growth_per_s.clone(),
        }
    }
}

fn close(verdict: Verdict, fitted: Growth, eigenvalue: Growth) -> bool {
    verdict == Verdict::Stable
        || (fitted.growth_per_s / eigenvalue.growth_per_s - 1.0).abs() <= AGREEMENT
}

pub(super) fn hertz(rad_per_s: f64) -> f64 {
    rad_per_s / TAU
}

impl From<&ToothPassing> for ToothPassingEntry {
    fn from(passing: &ToothPassing) -> Self {
        ToothPassingEntry {
            tooth_frequency_hz: hertz(passing.tooth_frequency_rad_per_s),
            standing_growth_per_s: passing.standing_growth_per_s,
            mean_growth_per_s: passing.mean_growth_per_s,
            passing_growth_per_s: passing.passing_growth_per_s,
            standing_deflection_m: passing.standing_deflection_m,
            passing_deflection_m: passing.passing_deflection_m,
        }
    }
}

/// Beyond this many thicknesses a plate stretches as it bends, and a linear one is no guide.
const LINEAR_THICKNESSES: f64 = 1.0;

fn warnings(run: &CutRunEntry, thickness_m: f64) -> Vec<String> {
    let mut warnings = Vec::new();
    if let Some(by_power) = &run.by_power {
        let ratio = run.tangential_n_per_tooth / by_power.tangential_n_per_tooth;
        if (ratio - 1.0).abs() > 0.05 {
            warnings.push(format!(
                "at {:.0} rpm the tangential force given, {:.0} N a tooth, is {ratio:.1} times the {:.0} N that the power allows at the rim; with the latter the cut is {} ({:.2} 1/s)",
                run.rpm,
                run.tangential_n_per_tooth,
                by_power.tangential_n_per_tooth,
                by_power.verdict,
                by_power.growth_per_s
            ));
        }
    }
    if run.transient_verdict.is_none() {
        warnings.push(format!(
            "at {:.0} rpm no lateral force moves the blade, so that the time history says nothing; give cut.lateral_n_per_tooth",
            run.rpm
        ));
    }
    let largest_m = run
        .largest_deflection_in_cut_m
        .max(run.largest_deflection_after_m);
    if largest_m > LINEAR_THICKNESSES * thickness_m {
        warnings.push(format!(
            "at {:.0} rpm the deflection reaches {:.1} mm, {:.1} times the thickness of the blade: the model is linear, so that it tells whether and how fast a motion begins to grow, and not how large it becomes",
            run.rpm,
            1e3 * largest_m,
            largest_m / thickness_m
        ));
    }
    warnings
}

impl Verdict {
    pub(super) fn of(scene: &Scene, growth_per_s: f64) -> Self {
        if growth_per_s >= scene.flutter_threshold_per_s() && growth_per_s > 0.0 {
            Verdict::Unstable
        } else {
            Verdict::Stable
        }
    }
}

impl std::fmt::Display for Verdict {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(match self {
            Verdict::Stable => "stable",
            Verdict::Unstable => "unstable",
        })
    }
}
