//! `cut.json`: stability and deflection of the saw in the cut.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    CutCertificate, CutCriterion, CutFinding, CutStability, CutStretching, SplineOrbit,
    ToothPassing, VerdictMap,
};
use crate::analyses::campbell::Verdict;
use crate::model::scene::SceneFile;

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
    /// Growth rate above which a cut is called unstable.
    pub flutter_threshold_per_s: f64,
    /// Largest deflection that is given; beyond it the linear model is not valid.
    pub linear_limit_m: f64,
    /// Mean number of teeth in the cut: its depth over their pitch. Deflections and growth are those of the mean forces of
    /// this number of teeth; moving tooth loads are those of single teeth that enter and leave the cut.
    pub teeth: f64,
    /// Arc of the rim in which teeth cut.
    pub arc_deg: f64,
    /// One entry for each speed.
    pub runs: Vec<CutAtSpeed>,
    /// Remarks on the forces and on the validity of the result.
    pub warnings: Vec<String>,
}

/// One speed of the cut.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "CutRunEntry")]
pub struct CutAtSpeed {
    /// Rotation speed.
    pub rpm: f64,
    /// Force against the rotation on each tooth.
    pub tangential_n_per_tooth: f64,
    /// Force towards the axis on each tooth.
    pub radial_n_per_tooth: f64,
    /// Force across the blade on each tooth.
    pub lateral_n_per_tooth: f64,
    /// Whether the saw can run in the cut: no if a vibration grows; at risk at a critical speed, at more than 85 % of the first one, and
    /// where the rim moves by more than the thickness of the blade or the deflection leaves the model. Critical speeds are those of the
    /// saw in the cut and out of it.
    pub verdict: crate::analyses::verdict::Verdict,
    /// The worst of the criteria; if no vibration grows, whether the deflection stays within the model, and the speed
    /// away from critical speeds.
    pub stability: CutStability,
    /// Critical speed within 5 % of this speed, of the saw in the cut or out of it; null if there is none.
    #[serde(default)]
    pub at_critical_rpm: Option<f64>,
    /// Criterion of fastest growth among those with this stability.
    pub decided_by: CutCriterion,
    /// The result of each criterion.
    pub criteria: Vec<CutFinding>,
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
    /// Whether both verdicts are equal and, if a vibration grows, growth rates agree within 2 %.
    pub agree: Option<bool>,
    /// Frequency of the largest oscillation in the cut.
    pub dominant_frequency_hz: Option<f64>,
    /// Verdict before and after the cut, by the eigenvalues.
    pub idle_verdict: Verdict,
    /// Largest Re λ without the forces.
    pub idle_growth_per_s: f64,
    /// Comparison of the growing modes with counts on the full model.
    pub certificate: CutCertificate,
    /// The cut with the tangential force that follows from the power, if it is given.
    pub by_power: Option<ByPower>,
    /// Comparison of moving and stationary tooth loads.
    pub tooth_passing: ToothPassing,
    /// Time at which the deflection of the rim exceeds the linear model and the record ends; null if it
    /// does not, and with stretching.
    pub linear_until_s: Option<f64>,
    /// Largest deflection of the rim before the forces end; null if the model, linear or with stretching,
    /// ends earlier.
    pub largest_deflection_in_cut_m: Option<f64>,
    /// Largest deflection of the rim after the forces end; null if the model, linear or with stretching,
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
    /// Deflection at the probe, up to 1.5 % of its largest value off, because it is made of the 42 lowest modes with and without
    /// the forces; with stretching up to about 3 %, of 8 modes.
    pub deflection_m: Vec<f64>,
    /// Verdict over guide angle and load.
    pub map: VerdictMap,
    /// The cut with the reaction of the simulated spline teeth, if the scene requests it.
    pub spline: Option<SplineOrbit>,
}

/// A cut with the force that follows from its power.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "ByPowerEntry")]
pub struct ByPower {
    /// P/(Ωb) divided by the mean number of teeth in the cut.
    pub tangential_n_per_tooth: f64,
    /// Verdict by the eigenvalues.
    pub verdict: Verdict,
    /// Largest Re λ.
    pub growth_per_s: f64,
}

impl CutAtSpeed {
    /// Time at which the deflection exceeds the range of the model, linear or with stretching; the record
    /// ends there.
    pub(crate) fn ends_s(&self) -> Option<f64> {
        let stretched = self.stretching.as_ref();
        self.linear_until_s
            .or_else(|| stretched.and_then(|found| found.valid_until_s))
    }
}

impl CutReport {
    /// Whether nothing grows and the deflection stays within the model, at all speeds.
    pub(crate) fn is_stable(&self) -> bool {
        let mut runs = self.runs.iter();
        runs.all(|run| run.stability == CutStability::Stable)
    }
}
