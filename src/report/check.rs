//! `check.json` and `sawflutter check --json`: every limit with its result.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::branches::Numbered;
use super::instability::InstabilityEntry;
use super::remarks::{lifting_off, side_force_in_words};
use super::saturated::add_amplitudes;
use crate::check::{Check, Criterion, Limits};
use crate::scene::{Scene, SceneFile, rpm};

/// A comparison of a saw with limits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CheckReport {
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
    /// Whether a saw with unusual numbers may pass.
    #[serde(default)]
    pub accept_unusual: bool,
    /// Whether every limit is kept and unusual numbers are absent or accepted.
    pub passed: bool,
    /// Every limit.
    pub criteria: Vec<CriterionEntry>,
    /// Operating speed.
    pub operating_rpm: f64,
    /// Largest ratio of the operating speed to the lowest critical speed.
    pub margin: f64,
    /// Last speed of the sweep; results are limited to it.
    pub to_rpm: f64,
    /// Critical speeds within the sweep, ascending.
    pub critical_speeds_rpm: Vec<f64>,
    /// Every band of instability within the sweep.
    pub instabilities: Vec<InstabilityEntry>,
    /// Growth rate from which on a band counts.
    pub flutter_threshold_per_s: f64,
    /// Lateral stiffness of a point of the rim at the middle of the cut, at rest.
    pub rim_stiffness_at_rest_n_per_m: f64,
    /// Lateral stiffness of this point at the operating speed; null above the first critical speed, where it is
    /// not defined.
    pub rim_stiffness_n_per_m: Option<f64>,
    /// Lateral stiffness of this point over the speed.
    pub rim_stiffness: RimStiffnessEntry,
    /// Rim speed at the operating speed.
    pub rim_speed_m_per_s: f64,
    /// Limit of the rim speed.
    pub max_rim_m_per_s: f64,
    /// Limit of the amplitude of flutter, if there is one.
    #[serde(default)]
    pub max_amplitude_m: Option<f64>,
    /// Estimated relative error of the critical speeds.
    pub estimated_relative_error: Option<f64>,
    /// Remarks on the validity of the result.
    pub warnings: Vec<String>,
}

/// Lateral stiffness of a point of the rim over the speed: a force fixed in space, in N, over the deflection
/// under it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RimStiffnessEntry {
    /// Speeds from rest to just below the lowest critical one; empty if nothing holds the blade.
    pub rpm: Vec<f64>,
    /// Stiffness at these speeds.
    pub n_per_m: Vec<f64>,
}

/// One limit and its result.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CriterionEntry {
    /// Short name of the limit, for programs.
    pub key: String,
    /// Requirement in words.
    pub name: String,
    /// Result in words.
    pub finding: String,
    /// Speed that was found: the critical or flutter speed itself, or the speed from which on another limit is
    /// exceeded; null if it exceeds the sweep.
    pub found_rpm: Option<f64>,
    /// Speed with which the found one is compared.
    pub asked_rpm: f64,
    /// Whether the limit is kept.
    pub passed: bool,
}

impl CheckReport {
    /// The report of a check.
    pub fn new(scene: &Scene, limits: &Limits, check: &Check) -> Self {
        let analysis = &check.analysis;
        let to_rad_per_s = analysis.range_rad_per_s.1;
        let critical = analysis.model.critical.iter().map(|c| c.speed_rad_per_s);
        let bands = analysis.chart.instabilities.iter();
        let branches = Numbered::new(analysis);
        let stiffness = check.rim_stiffness_over_speed.iter();
        let threshold_per_s = scene.flutter_threshold_per_s();
        let entry = |band| InstabilityEntry::in_chart(band, &branches, threshold_per_s);
        let mut instabilities: Vec<InstabilityEntry> = bands.map(entry).collect();
        add_amplitudes(&mut instabilities, &check.saturations);
        CheckReport {
            sawflutter: env!("CARGO_PKG_VERSION").to_owned(),
            scene: scene.file().clone(),
            condition: scene.condition(),
            unusual_numbers: check.unusual_numbers.clone(),
            accept_unusual: check.accept_unusual,
            passed: check.passed(),
            criteria: check.all_criteria().map(CriterionEntry::from).collect(),
            operating_rpm: rpm(limits.operating_rad_per_s),
            margin: limits.margin,
            to_rpm: rpm(to_rad_per_s),
            critical_speeds_rpm: critical
                .take_while(|speed| *speed <= to_rad_per_s)
                .map(rpm)
                .collect(),
            instabilities,
            max_amplitude_m: limits.max_amplitude_m,
            flutter_threshold_per_s: scene.flutter_threshold_per_s(),
            rim_stiffness_at_rest_n_per_m: check.rim_stiffness_at_rest_n_per_m,
            rim_stiffness_n_per_m: check.rim_stiffness_n_per_m,
            rim_stiffness: RimStiffnessEntry {
                rpm: stiffness.clone().map(|(speed, _)| rpm(*speed)).collect(),
                n_per_m: stiffness.map(|(_, value)| *value).collect(),
            },
            rim_speed_m_per_s: limits.operating_rad_per_s * scene.blade().outer_radius_m,
            max_rim_m_per_s: limits.max_rim_m_per_s,
            estimated_relative_error: analysis.estimated_relative_error,
            warnings: warnings(scene, limits, check),
        }
    }
}

fn warnings(scene: &Scene, limits: &Limits, check: &Check) -> Vec<String> {
    let mut warnings: Vec<String> = lifting_off(scene).into_iter().collect();
    let operating = limits.operating_rad_per_s;
    if let Some(critical_rpm) = check.analysis.critical_rpm_at(operating) {
        let deflection = side_force_in_words(rpm(operating), check.side_force_factor);
        let deflection = deflection.map_or(String::new(), |words| format!("; {words}"));
        warnings.push(format!(
            "the operating speed is within 5 % of the critical speed {critical_rpm:.1} rpm{deflection}"
        ));
    }
    let gaps = scene.file().guides.iter().filter(|g| g.gap_m.is_some());
    let compared = check.all_criteria().filter(|c| c.key == "gap").count();
    if gaps.count() > compared {
        warnings.push(
            "a guide has a gap_m, but the scene has no lateral force that could close it (cut.lateral_n_per_tooth), or nothing holds the blade"
                .to_owned(),
        );
    }
    let critical = check.analysis.model.critical.first();
    let is_above = critical.is_some_and(|first| operating >= first.speed_rad_per_s);
    if is_above && compared > 0 {
        warnings.push(
            "above the first critical speed a static deflection does not show whether the gaps of guides close".to_owned(),
        );
    }
    warnings
}

impl CheckReport {
    /// Sentence about the rim stiffness, for text and figure.
    pub fn rim_stiffness_in_words(&self) -> String {
        if self.rim_stiffness_at_rest_n_per_m == 0.0 {
            return "no rim stiffness: nothing holds the blade's rigid motions".to_owned();
        }
        let at_rest = 1e-3 * self.rim_stiffness_at_rest_n_per_m;
        let operating = match self.rim_stiffness_n_per_m {
            Some(stiffness) => format!("{:.1} N/mm at the operating speed", 1e-3 * stiffness),
            None => "none above the first critical speed".to_owned(),
        };
        format!("rim stiffness at a point {at_rest:.1} N/mm at rest, {operating}")
    }
}

impl From<&Criterion> for CriterionEntry {
    fn from(criterion: &Criterion) -> Self {
        CriterionEntry {
            key: criterion.key.to_owned(),
            name: criterion.name.clone(),
            finding: criterion.finding.clone(),
            found_rpm: criterion.found.map(rpm),
            asked_rpm: rpm(criterion.asked),
            passed: criterion.passed,
        }
    }
}
