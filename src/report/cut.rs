//! `cut.json`: stability and deflection of the saw in the cut.

mod certificate;
mod criteria;
mod warnings;

use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use self::certificate::CutCertificateEntry;
pub(super) use self::criteria::growing_hz;
pub use self::criteria::{CutCriterion, CutCriterionEntry, CutVerdict, Verdict};
use self::criteria::{agree, criteria, worst};
use self::warnings::warnings;
use super::remarks::lifting_off;
use super::spline::SplineEntry;
use crate::scene::{CutRun, Scene, SceneFile, in_the_cut, rpm, unusual_number};
use crate::transient::{
    CutHistory, CutStretching, Cutting, CuttingRun, Growth, ToothPassing, VerdictMap,
    linear_limit_m,
};

/// Report of a cut (`cut.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CutReport {
    /// Version of the program that wrote the report.
    pub sawflutter: String,
    /// The scene, as typed.
    pub scene: SceneFile,
    /// The cut of the report: "in the cut at 1800 and 2800 rpm (4 teeth)".
    #[serde(default)]
    pub condition: String,
    /// Numbers that no saw has, each with its key, the usual range, and the remedy. The results hold for the
    /// numbers as typed.
    #[serde(default)]
    pub unusual_numbers: Vec<String>,
    /// Size of the basis.
    pub degrees_of_freedom: usize,
    /// Growth rate from which on a cut is called unstable.
    pub flutter_threshold_per_s: f64,
    /// Largest deflection that is given; beyond it the linear model is not valid.
    pub linear_limit_m: f64,
    /// Mean number of teeth in the cut: its depth over their pitch. Deflections and growth are those of the mean forces of
    /// this number of teeth; moving tooth loads are those of single teeth that enter and leave the cut.
    pub teeth: f64,
    /// Arc of the rim in which teeth cut.
    pub arc_deg: f64,
    /// One entry for each speed.
    pub runs: Vec<CutRunEntry>,
    /// Remarks on the forces and on the validity of the result.
    pub warnings: Vec<String>,
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
    /// The worst of the criteria; if no motion grows, whether the deflection stays within the model, and the speed
    /// away from critical speeds.
    pub verdict: CutVerdict,
    /// Critical speed within 5 % of this speed, of the saw in the cut or out of it; null if there is none.
    #[serde(default)]
    pub at_critical_rpm: Option<f64>,
    /// Criterion of fastest growth among those with this verdict.
    pub decided_by: CutCriterion,
    /// The result of each criterion.
    pub criteria: Vec<CutCriterionEntry>,
    /// Largest Re λ in the cut.
    pub growth_per_s: f64,
    /// Frequency of the growing mode; of the largest oscillation if none grows.
    pub frequency_hz: Option<f64>,
    /// Verdict in the cut by the time history; null if no lateral force excites the blade.
    pub transient_verdict: Option<Verdict>,
    /// Growth rate fitted to the deflection in the cut.
    pub transient_growth_per_s: Option<f64>,
    /// Frequency of this growth, if it is unstable.
    pub transient_frequency_hz: Option<f64>,
    /// Whether both verdicts are equal and, if a motion grows, growth rates agree within 2 %.
    pub agree: Option<bool>,
    /// Frequency of the largest oscillation in the cut.
    pub dominant_frequency_hz: Option<f64>,
    /// Verdict before and after the cut, by the eigenvalues.
    pub idle_verdict: Verdict,
    /// Largest Re λ without the forces.
    pub idle_growth_per_s: f64,
    /// Comparison of the growing modes with counts on the full model.
    pub certificate: CutCertificateEntry,
    /// The cut with the tangential force that follows from the power, if it is given.
    pub by_power: Option<ByPowerEntry>,
    /// Comparison of moving and stationary tooth loads.
    pub tooth_passing: ToothPassingEntry,
    /// Time at which the deflection at the probe exceeds the linear model and the record ends; null if it
    /// does not, and with stretching.
    pub linear_until_s: Option<f64>,
    /// Largest deflection at the probe before the forces end; null if the model, linear or with stretching,
    /// ends earlier.
    pub largest_deflection_in_cut_m: Option<f64>,
    /// Largest deflection at the probe after the forces end; null if the model, linear or with stretching,
    /// ends before the record.
    pub largest_deflection_after_m: Option<f64>,
    /// Start of the forces.
    pub forces_from_s: f64,
    /// End of the forces.
    pub forces_to_s: f64,
    /// Results with stretching, if the scene requests it.
    #[serde(default)]
    pub stretching: Option<CutStretching>,
    /// Times of the record.
    pub time_s: Vec<f64>,
    /// Deflection at the probe.
    pub deflection_m: Vec<f64>,
    /// Verdict over guide angle and load.
    pub map: VerdictMapEntry,
    /// The cut with the reaction of the simulated spline teeth, if the scene requests it.
    pub spline: Option<SplineEntry>,
}

/// A cut with the force that follows from its power.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ByPowerEntry {
    /// P/(Ωb) divided by the mean number of teeth in the cut.
    pub tangential_n_per_tooth: f64,
    /// Verdict by the eigenvalues.
    pub verdict: Verdict,
    /// Largest Re λ.
    pub growth_per_s: f64,
}

/// The effect of loads that move with the teeth, compared with stationary loads.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ToothPassingEntry {
    /// Number of teeth that pass per second.
    pub tooth_frequency_hz: f64,
    /// Growth under stationary loads at the mean places of the teeth.
    pub standing_growth_per_s: f64,
    /// Growth under the mean of the moving loads.
    pub mean_growth_per_s: f64,
    /// Growth under the moving loads, from Floquet multipliers.
    pub passing_growth_per_s: f64,
    /// Largest deflection at the probe in the cut under stationary loads; null if the linear model ends
    /// before the cut.
    pub standing_deflection_m: Option<f64>,
    /// Largest deflection at the probe in the cut under moving loads.
    pub passing_deflection_m: Option<f64>,
}

/// Growth rates over guide angle and load.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VerdictMapEntry {
    /// Angles of the first guide, with which all guides move; empty without guides.
    pub guide_angle_deg: Vec<f64>,
    /// Factors of the radial and tangential forces.
    pub load_level: Vec<f64>,
    /// Growth rates, one row for each load level, one column for each angle; one column without guides.
    pub growth_per_s: Vec<Vec<f64>>,
    /// Verdicts by these growth rates, in the same rows and columns.
    pub verdict: Vec<Vec<Verdict>>,
}

impl CutRunEntry {
    /// Time at which the deflection exceeds the range of the model, linear or with stretching; the record
    /// ends there.
    pub(crate) fn ends_s(&self) -> Option<f64> {
        let stretched = self.stretching.as_ref();
        self.linear_until_s
            .or_else(|| stretched.and_then(|found| found.valid_until_s))
    }
}

impl CutReport {
    /// The report of a cut.
    pub fn new(cutting: &Cutting) -> Self {
        let scene = &cutting.scene;
        let runs: Vec<CutRunEntry> = cutting
            .runs
            .iter()
            .map(|run| CutRunEntry::new(scene, run))
            .collect();
        let speeds: Vec<CutRun> = cutting.runs.iter().map(|run| run.history.run).collect();
        let teeth = cutting.cut.teeth;
        let (thickness_m, _) = scene.blade().thickness_range_m();
        let linear_limit_m = linear_limit_m(scene.blade());
        CutReport {
            sawflutter: env!("CARGO_PKG_VERSION").to_owned(),
            scene: scene.file().clone(),
            condition: in_the_cut(&speeds),
            unusual_numbers: unusual_numbers(scene, cutting),
            degrees_of_freedom: cutting.plate.degrees_of_freedom(),
            flutter_threshold_per_s: scene.flutter_threshold_per_s(),
            linear_limit_m,
            teeth: teeth.mean,
            arc_deg: (teeth.mean * teeth.pitch_rad).to_degrees(),
            warnings: lifting_off(scene)
                .into_iter()
                .chain(
                    runs.iter()
                        .flat_map(|run| warnings(run, teeth.mean, thickness_m)),
                )
                .collect(),
            runs,
        }
    }
}

/// Unusual numbers of the scene, and of speeds of the cut that the scene does not list.
fn unusual_numbers(scene: &Scene, cutting: &Cutting) -> Vec<String> {
    let named = |rpm: f64| {
        scene
            .cut()
            .is_some_and(|cut| cut.runs.iter().any(|r| r.rpm == rpm))
    };
    let speeds = cutting.runs.iter().map(|run| run.history.run.rpm);
    let asked = speeds.filter(|rpm| !named(*rpm));
    let asked = asked.filter_map(|rpm| {
        unusual_number(
            scene.file(),
            "the speed of the cut",
            "cut.speeds[].rpm",
            rpm,
        )
    });
    scene
        .file()
        .unusual_numbers()
        .into_iter()
        .chain(asked)
        .collect()
}

impl CutRunEntry {
    fn new(scene: &Scene, computed: &CuttingRun) -> Self {
        let CuttingRun {
            history,
            passing,
            map,
            spline,
        } = computed;
        let of = |growth: Growth| Verdict::of(scene, growth);
        let run = history.run;
        let transient_verdict = history.fitted.map(of);
        let criteria = criteria(scene, computed);
        let (growth, decided_by) = worst(&criteria);
        // With stretching, only the record decides whether the blade leaves the model, because moving loads
        // are computed by the linear model only.
        let leaves_model = match &history.stretched {
            Some(found) => found.valid_until_s.is_some(),
            None => history.linear_until_s.is_some() || passing.passing_deflection_m.is_none(),
        };
        let dominant = history.dominant_rad_per_s;
        let [in_cut_m, after_m] = largest_deflections(history);
        CutRunEntry {
            rpm: run.rpm,
            tangential_n_per_tooth: run.tangential_n,
            radial_n_per_tooth: run.radial_n,
            lateral_n_per_tooth: run.lateral_n,
            verdict: CutVerdict::new(growth, leaves_model, history.critical_rad_per_s.is_some()),
            at_critical_rpm: history.critical_rad_per_s.map(rpm),
            decided_by,
            criteria,
            growth_per_s: history.in_cut.growth_per_s,
            frequency_hz: growing_hz(history.in_cut).or(dominant.map(hertz)),
            agree: history
                .fitted
                .map(|fitted| agree(scene, fitted, history.in_cut)),
            transient_verdict,
            transient_growth_per_s: history.fitted.map(|fitted| fitted.growth_per_s),
            transient_frequency_hz: history
                .fitted
                .filter(|fitted| of(*fitted) == Verdict::Unstable)
                .map(|fitted| hertz(fitted.frequency_rad_per_s)),
            dominant_frequency_hz: dominant.map(hertz),
            idle_verdict: of(history.idle),
            idle_growth_per_s: history.idle.growth_per_s,
            certificate: CutCertificateEntry::new(history),
            by_power: run.tangential_of_power_n.zip(history.in_cut_by_power).map(
                |(tangential_n_per_tooth, growth)| ByPowerEntry {
                    tangential_n_per_tooth,
                    verdict: of(growth),
                    growth_per_s: growth.growth_per_s,
                },
            ),
            tooth_passing: passing.into(),
            linear_until_s: history.linear_until_s,
            largest_deflection_in_cut_m: in_cut_m,
            largest_deflection_after_m: after_m,
            forces_from_s: history.forces_s.0,
            forces_to_s: history.forces_s.1,
            stretching: history.stretched.clone(),
            time_s: history.time_s.clone(),
            deflection_m: history.deflection_m.clone(),
            map: VerdictMapEntry::new(scene, map),
            spline: spline.as_ref().map(|found| SplineEntry::new(scene, found)),
        }
    }
}

/// Largest deflections at the probe until the forces end and afterwards, while the model is valid.
fn largest_deflections(history: &CutHistory) -> [Option<f64>; 2] {
    let (_, end_s) = history.forces_s;
    let valid_until_s = history.valid_until_s().unwrap_or(f64::INFINITY);
    let largest = |after: bool| {
        let record = history.time_s.iter().zip(&history.deflection_m);
        record
            .filter(|(time, _)| (**time > end_s) == after)
            .fold(0.0_f64, |max, (_, w)| max.max(w.abs()))
    };
    let in_cut = (valid_until_s > end_s).then(|| largest(false));
    let after = history.valid_until_s().is_none().then(|| largest(true));
    [in_cut, after]
}

impl VerdictMapEntry {
    fn new(scene: &Scene, map: &VerdictMap) -> Self {
        fn each<T>(map: &VerdictMap, of: impl Fn(&Growth) -> T) -> Vec<Vec<T>> {
            let rows = map.growth.iter();
            rows.map(|row| row.iter().map(&of).collect()).collect()
        }
        let first_guide = scene.guides().first();
        let angles = first_guide.map(|guide| {
            let turns = map.turns_rad.iter();
            turns.map(|turn| (guide.typed.angle_rad() + turn).to_degrees())
        });
        VerdictMapEntry {
            guide_angle_deg: angles.into_iter().flatten().collect(),
            load_level: map.load_levels.clone(),
            growth_per_s: each(map, |growth| growth.growth_per_s),
            verdict: each(map, |growth| Verdict::of(scene, *growth)),
        }
    }
}

fn hertz(rad_per_s: f64) -> f64 {
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
