//! `place.json`: the placement that is best in the worst case of its tolerances, and a map.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::analyses::campbell::InstabilityBand;
use crate::analyses::verdict::Verdict;
use crate::model::scene::{Kind, Quantity, SceneFile};
use crate::page::text::shown_to;

/// Report of a placement (`place.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlaceReport {
    /// Version of the program that wrote the report.
    pub sawflutter: String,
    /// The scene with the best numbers.
    pub scene: SceneFile,
    /// Whether the saw idles or is in its cut: "idling", or "in the cut at 2800 rpm (4 teeth)".
    #[serde(default)]
    pub condition: String,
    /// Numbers that no saw has, each with its key, the usual range, and the remedy. The results hold for the
    /// numbers as typed.
    #[serde(default)]
    pub unusual_numbers: Vec<String>,
    /// Verdict on the saw with the best numbers; null if it could not be analysed, see `warnings`.
    pub verdict: Option<Verdict>,
    /// Verdict on the original saw; null if it could not be analysed.
    pub verdict_before: Option<Verdict>,
    /// The quantity that was maximized.
    pub goal: Goal,
    /// Lower limit of the first critical speed, if there is one.
    pub min_critical_rpm: Option<f64>,
    /// Amplitude at guides with a gap with whose mean stiffness bands and critical speeds were computed, if one was given.
    #[serde(default)]
    pub amplitude_m: Option<f64>,
    /// Upper limit of the deflection at the cut, if there is one.
    #[serde(default)]
    pub max_deflection_m: Option<f64>,
    /// Side force for this limit and for the deflections of the front; null without both.
    #[serde(default)]
    pub force_n: Option<f64>,
    /// Whether the best saw keeps the limits in the worst case of its tolerances.
    pub kept: bool,
    /// Whether the best saw is better than the original scene, both in the worst case of their tolerances. If
    /// no saw between the bounds is better, `scene`, `best` and the numbers are those of the original scene, unless
    /// that lies outside the bounds.
    pub improved: bool,
    /// First speed of the sweep, the same for every saw.
    pub from_rpm: f64,
    /// Last speed of the sweep; flutter beyond it is unknown.
    pub to_rpm: f64,
    /// Growth rate above which a band counts as flutter.
    pub flutter_threshold_per_s: f64,
    /// Free numbers and their best values.
    pub parameters: Vec<PlacedParameter>,
    /// Freed numbers without effect, or whose effect other free numbers have as well.
    pub without_effect: Vec<String>,
    /// Result of the original scene.
    pub before: Outcome,
    /// Worst neighbour of the original scene within its tolerances, itself included.
    pub worst_before: Neighbour,
    /// Result of the best saw, which has the best goal in the worst case of its tolerances.
    pub best: Outcome,
    /// Bands of the best saw.
    pub bands: Vec<InstabilityBand>,
    /// Certificate of these bands.
    pub certificate: PlaceCertificate,
    /// Whether the best saw loses more than 5 % of the goal within its tolerances.
    pub fragile: bool,
    /// Worst neighbour of the best saw within its tolerances, itself included; the search maximizes its goal.
    pub worst_neighbour: Option<Neighbour>,
    /// Goal of this neighbour divided by that of the best saw.
    pub worst_neighbour_share: f64,
    /// The saw with the best nominal goal, if it is better than the best saw and worse within its tolerances;
    /// null otherwise.
    pub fragile_optimum: Option<FragileOptimum>,
    /// Saws that trade the goal, in the worst case of their tolerances, against the deflection at the cut at the operating speed, those
    /// that deflect least first; of the saws tried none with a smaller deflection has a better worst case. Empty if the deflection of
    /// the best saw is unknown: without an operating speed, in a band, and if rigid motions are free.
    #[serde(default)]
    pub front: Vec<FrontSaw>,
    /// Bands that nearly reach the threshold and begin below the flutter speed.
    pub almost: Vec<InstabilityBand>,
    /// The goal over two numbers, on the coarse basis of the search.
    pub map: Option<GoalMap>,
    /// Number of saws analysed.
    pub saws: usize,
    /// Number of saws that could not be computed; they count as the worst.
    pub failed_saws: usize,
    /// Largest number of nodal diameters of the best saw's basis.
    pub max_diameters: usize,
    /// Number of radial functions for each number of nodal diameters.
    pub radial_functions: usize,
    /// Remarks on the validity of the result.
    pub warnings: Vec<String>,
}

/// The quantity that is maximized.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "GoalEntry")]
pub enum Goal {
    /// The flutter speed.
    FlutterSpeed,
    /// Width of the window without instability around the operating speed.
    StableWindow,
}

/// A free number and its best value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "PlacedEntry")]
pub struct PlacedParameter {
    /// JSON path in the scene.
    pub path: String,
    /// Value in the original scene.
    pub start: f64,
    /// Best value.
    pub value: f64,
    /// Lower bound.
    pub bound_from: f64,
    /// Upper bound.
    pub bound_to: f64,
    /// Whether the value is a bound.
    pub at_bound: bool,
    /// Tolerance of production, the deviation for the next two values.
    pub offset: f64,
    /// Value of the goal if the number is smaller by `offset`; null if there is no such saw or the goal could
    /// not be computed.
    pub less_rpm: Option<f64>,
    /// Value of the goal if the number is larger by `offset`; null in the same cases.
    pub more_rpm: Option<f64>,
    /// Smallest and largest value of the goal at five values of this number from bound to bound, while the others keep their best
    /// values; null if one of these saws misses a limit or could not be computed.
    pub across_rpm: Option<[f64; 2]>,
}

/// Value of the goal for one saw, and the speeds that determine it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "OutcomeEntry")]
pub struct Outcome {
    /// Value of the goal: the flutter speed, or the end of the sweep if there is none, or the width of the
    /// window.
    pub goal_rpm: f64,
    /// Flutter speed; null if it exceeds the sweep.
    pub flutter_rpm: Option<f64>,
    /// First critical speed.
    pub first_critical_rpm: Option<f64>,
    /// Window without instability around the operating speed, if it is the goal.
    pub window_rpm: Option<[f64; 2]>,
    /// Deflection at the cut, as an absolute value, if it has a limit.
    #[serde(default)]
    pub deflection_m: Option<f64>,
    /// Whether the limits of the critical speed and of the deflection are kept.
    pub kept: bool,
}

/// Certificate of the bands of the best saw.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "PlaceCertificateEntry")]
pub struct PlaceCertificate {
    /// The result in a sentence.
    pub statement: String,
    /// Whether every check agrees.
    pub is_clean: bool,
    /// Number of speeds at which the Krein index was compared with the modes or, for a damped saw, the number
    /// of growing modes with that of the bands.
    pub speeds_checked: usize,
    /// Number of counts of eigenvalues on the full model with which the modes were compared.
    pub full_basis_counts: usize,
}

/// A saw next to a jump of the goal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "FragileOptimumEntry")]
pub struct FragileOptimum {
    /// Values of the numbers, in their order, and the goal.
    pub saw: Neighbour,
    /// Worst neighbour of this saw within the tolerances.
    pub worst: Neighbour,
}

/// A saw of the front.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "FrontSawEntry")]
pub struct FrontSaw {
    /// Values of the numbers, in their order.
    pub values: Vec<f64>,
    /// Flutter speed; null if it exceeds the sweep.
    pub flutter_rpm: Option<f64>,
    /// First critical speed.
    pub first_critical_rpm: Option<f64>,
    /// The goal in the worst case of the tolerances.
    pub worst_goal_rpm: f64,
    /// Deflection at the cut under the side force at the operating speed, as an absolute value.
    pub deflection_m: f64,
}

/// A saw whose numbers deviate from another one by the tolerances.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "NeighbourEntry")]
pub struct Neighbour {
    /// Values of the numbers, in their order.
    pub values: Vec<f64>,
    /// Result of the saw; null if it could not be computed.
    pub outcome: Option<Outcome>,
}

/// The goal over two numbers; the others have their best values.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "MapEntry")]
pub struct GoalMap {
    /// JSON path of the number along x.
    pub x_path: String,
    /// Values along x.
    pub x: Vec<f64>,
    /// JSON path of the number along y; null if only one is free.
    pub y_path: Option<String>,
    /// Values along y.
    pub y: Vec<f64>,
    /// The goal, one row for each value of y; null if there is no such saw or it could not be computed.
    pub goal_rpm: Vec<Vec<Option<f64>>>,
    /// Whether the limits of the critical speed and of the deflection are kept.
    pub kept: Vec<Vec<bool>>,
}

/// Relative difference of two goals that are the same for a designer.
const SAME: f64 = 5e-3;

impl PlacedParameter {
    /// The goals from bound to bound, if they are the same.
    pub(super) fn without_influence(&self) -> Option<[f64; 2]> {
        self.across_rpm
            .filter(|[low, high]| high - low <= SAME * high)
    }
}

impl PlaceReport {
    /// The front, if the deflection at the cut is traded against the goal at all; otherwise empty.
    pub(super) fn traded(&self) -> &[FrontSaw] {
        match self.front.as_slice() {
            all @ [first, .., last]
                if (last.worst_goal_rpm - first.worst_goal_rpm).abs()
                    > SAME * last.worst_goal_rpm =>
            {
                all
            }
            _ => &[],
        }
    }

    /// Remarks on the validity of the result; `why` is the reason for which one of the saws was not computed.
    pub(super) fn remarks(&self, why: Option<&str>) -> Vec<String> {
        let mut remarks = Vec::new();
        for path in &self.without_effect {
            remarks.push(match Quantity::kind_of(path) {
                Kind::Angle => format!(
                    "{path} was kept: without the forces of a cut a common rotation of all guides changes nothing, so a single guide may be at any angle"
                ),
                _ => format!("{path} changes no critical speed and no band, and was kept"),
            });
        }
        if self
            .scene
            .limits
            .is_some_and(|limits| limits.max_deviation_m.is_some())
            && !self.scene.has_gaps()
        {
            remarks.push(
                "limits.max_deviation_m was not part of the search, because no guide has a gap: check the placed saw"
                    .to_owned(),
            );
        }
        if !self.improved {
            remarks.push(self.not_improved().into());
        }
        let beyond = match self.goal {
            Goal::FlutterSpeed => self.best.flutter_rpm.is_none(),
            Goal::StableWindow => self
                .best
                .window_rpm
                .is_some_and(|[_, to]| to >= self.to_rpm),
        };
        if beyond {
            remarks.push(format!(
                "the best saw is stable to the end of the sweep, {:.0} rpm, so better ones cannot be distinguished: end the sweep at a higher speed",
                self.to_rpm
            ));
        }
        if self.failed_saws > 0 {
            remarks.push(format!(
                "{} of the {} saws tried could not be computed and count as the worst; the reason of one of them: {}",
                self.failed_saws,
                self.saws,
                why.unwrap_or_default()
            ));
        }
        if self.scene.cut.is_some() {
            remarks.push(
                "the search ignores the forces of the cut; check the result in the cut".into(),
            );
        }
        remarks
    }

    /// Message that no saw keeps the limits, and by how much the one that misses them least does; `None` if the limits are kept.
    pub(super) fn limits_missed(&self) -> Option<String> {
        if self.kept {
            return None;
        }
        let worst = self
            .worst_neighbour
            .as_ref()
            .and_then(|worst| worst.outcome);
        let critical = worst.and_then(|worst| worst.first_critical_rpm);
        let short = self.min_critical_rpm.zip(critical).filter(|(asked, found)| found < asked).map(|(asked, found)| {
            format!(
                "NO saw tried keeps the limit of the critical speed in the worst case of its tolerances; this one misses it by the smallest amount, {:.0} rpm",
                asked - found
            )
        });
        let deflection = worst.and_then(|worst| worst.deflection_m);
        let limit = self.max_deflection_m;
        let beyond = limit.filter(|limit| deflection.is_none_or(|found| found > *limit)).map(|_| {
            let found = deflection.map_or("more than the model is valid for".to_owned(), |m| {
                format!("{} mm", shown_to(3, 1e3 * m))
            });
            format!(
                "NO saw tried keeps the limit of the deflection at the cut in the worst case of its tolerances; this one deflects there by {found}"
            )
        });
        let both: Vec<String> = short.into_iter().chain(beyond).collect();
        Some(both.join("; "))
    }

    fn not_improved(&self) -> &'static str {
        let within = |p: &PlacedParameter| (p.bound_from..=p.bound_to).contains(&p.start);
        if self.parameters.iter().all(within) {
            "no saw between the bounds is better than the original one in the worst case of the tolerances; the scene was kept"
        } else {
            "the original saw, which lies outside the bounds, is in the worst case of its tolerances at least as good as the best one between them; widen the bounds, or keep it"
        }
    }
}
