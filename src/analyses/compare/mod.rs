//! `compare.json`: saws side by side, the first being the one that the others are compared with.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::analysis::Report;
use super::chart::CampbellEntry;
use super::critical_speed::CriticalSpeedEntry;
use super::instability::InstabilityEntry;
use super::operating::OperatingEntry;
use crate::analyses::check::rim_stiffness_at_rest_n_per_m;
use crate::scene::{Scene, SceneError, SceneFile, SpeedRange, in_words};
use crate::stability::{Analysis, AnalysisError, end_of_sweep};

/// Report of a comparison (`compare.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CompareReport {
    /// Version of the program that wrote the report.
    pub sawflutter: String,
    /// The first scene, with which the others are compared.
    pub scene: SceneFile,
    /// The saws.
    pub saws: Vec<ComparedEntry>,
    /// Keys of the scenes that are not the same in all of them; names, notes and measured frequencies are not compared.
    pub differences: Vec<DifferenceEntry>,
}

/// A saw among others.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ComparedEntry {
    /// Label of the saw: the name of its file, or the change of its scene.
    pub label: String,
    /// Scene of the saw.
    pub scene: SceneFile,
    /// Whether the saw idles or is in its cut: "idling", or "in the cut at 2800 rpm (4 teeth)".
    #[serde(default)]
    pub condition: String,
    /// Critical speeds up to the end of its sweep, ascending.
    pub critical_speeds: Vec<CriticalSpeedEntry>,
    /// The bands of instability within its sweep.
    pub instabilities: Vec<InstabilityEntry>,
    /// Lowest speed at which flutter counts.
    pub flutter_speed_rpm: Option<f64>,
    /// Operating speed, and whether the saw is stable there.
    pub operating: Option<OperatingEntry>,
    /// Lateral stiffness of a point of the rim at the middle of the cut, at rest; null if the blade has free rigid
    /// motions, and for a saw whose report was given instead of its scene.
    pub rim_stiffness_at_rest_n_per_m: Option<f64>,
    /// Estimated relative error of its critical speeds.
    pub estimated_relative_error: Option<f64>,
    /// Branches of the saw over speed.
    pub campbell: CampbellEntry,
    /// Numbers that no saw has, and remarks on the validity of its result.
    pub warnings: Vec<String>,
}

/// A key that is not the same in all scenes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DifferenceEntry {
    /// JSON path of the key.
    pub path: String,
    /// Its value in each scene, as in the file; empty where a scene has none.
    pub values: Vec<String>,
}

impl ComparedEntry {
    /// Makes the entry of a saw whose report exists already.
    pub fn of_report(label: String, report: &Report) -> Self {
        let warnings = report.unusual_numbers.iter().chain(&report.warnings);
        ComparedEntry {
            label,
            scene: report.scene.clone(),
            condition: report.condition.clone(),
            critical_speeds: report.critical_speeds.clone(),
            instabilities: report.instabilities.clone(),
            flutter_speed_rpm: report.flutter_speed_rpm,
            operating: report.operating.clone(),
            rim_stiffness_at_rest_n_per_m: None,
            estimated_relative_error: report.accuracy.estimated_relative_error,
            campbell: report.campbell.clone(),
            warnings: warnings.cloned().collect(),
        }
    }

    /// Makes the entry of an analysed saw, with the stiffness of its rim.
    pub fn of_analysis(label: String, analysis: &Analysis) -> Self {
        ComparedEntry {
            rim_stiffness_at_rest_n_per_m: rim_stiffness_at_rest_n_per_m(analysis),
            ..Self::of_report(label, &analysis.report())
        }
    }
}

impl CompareReport {
    /// Whether the saws idle or are in their cuts: one statement, or one for each saw where they differ.
    pub fn condition(&self) -> String {
        let mut conditions: Vec<&str> = self.saws.iter().map(|saw| &*saw.condition).collect();
        if conditions.windows(2).all(|pair| pair[0] == pair[1]) {
            conditions.truncate(1);
        }
        conditions.join(" | ")
    }

    /// Warnings of every saw, with its label.
    pub(crate) fn warnings_of_saws(&self) -> Vec<String> {
        let of_saws = self.saws.iter().flat_map(|saw| {
            let warnings = saw.warnings.iter();
            warnings.map(|warning| format!("{}: {warning}", saw.label))
        });
        of_saws.collect()
    }

    /// Compares saws with the first of them; `None` where there is none.
    pub fn new(saws: Vec<ComparedEntry>) -> Option<Self> {
        let scene = saws.first()?.scene.clone();
        let typed = saws.iter().map(|saw| keys(&saw.scene)).collect::<Vec<_>>();
        let mut paths: Vec<&String> = Vec::new();
        for (path, _) in typed.iter().flatten() {
            if !paths.contains(&path) {
                paths.push(path);
            }
        }
        let value = |keys: &Vec<(String, String)>, path: &String| {
            let own = keys.iter().find(|(own, _)| own == path);
            own.map_or(String::new(), |(_, value)| value.clone())
        };
        let differences = paths.into_iter().map(|path| DifferenceEntry {
            path: path.clone(),
            values: typed.iter().map(|keys| value(keys, path)).collect(),
        });
        let differ =
            |entry: &DifferenceEntry| entry.values.windows(2).any(|pair| pair[0] != pair[1]);
        let differences = differences.filter(differ).collect();
        Some(CompareReport {
            sawflutter: env!("CARGO_PKG_VERSION").to_owned(),
            scene,
            saws,
            differences,
        })
    }
}

/// The keys of a scene with their values, in its order.
fn keys(scene: &SceneFile) -> Vec<(String, String)> {
    let inputs = scene.inputs().into_iter();
    inputs
        .map(|(path, value)| (path, in_words(&value)))
        .collect()
}

/// Gives every scene without a sweep the same one: from rest to the largest end that the program chooses for any of
/// these scenes.
///
/// # Errors
/// [`AnalysisError`] if no end can be chosen for a scene, or a scene refuses these speeds.
pub fn over_common_speeds(scenes: Vec<Scene>) -> Result<Vec<Scene>, AnalysisError> {
    let mut last = 0.0_f64;
    for scene in scenes.iter().filter(|scene| scene.sweep().is_none()) {
        last = last.max(end_of_sweep(scene)?);
    }
    let swept = scenes.into_iter().map(|scene| match scene.sweep() {
        Some(_) => Ok(scene),
        None => scene.swept(SpeedRange::from((0.0, last))),
    });
    Ok(swept.collect::<Result<_, SceneError>>()?)
}
