//! `place.json`: the placement that is best in the worst case of its tolerances, and a map.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::certificate::statement;
use super::instability::InstabilityEntry;
use crate::place::{
    Demands, FragileOptimum, Goal, Map, Neighbour, Neighbours, Outcome, PlacedParameter, Placement,
};
use crate::scene::{Kind, Quantity, Scene, SceneFile, rpm};
use crate::text::shown_to;

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
    /// The quantity that was maximized.
    pub goal: GoalEntry,
    /// Lower limit of the first critical speed, if there is one.
    pub min_critical_rpm: Option<f64>,
    /// Amplitude at guides with a gap with whose mean stiffness bands and critical speeds were computed, if one was given.
    #[serde(default)]
    pub amplitude_m: Option<f64>,
    /// Upper limit of the deflection at the cut, if there is one.
    #[serde(default)]
    pub max_deflection_m: Option<f64>,
    /// Side force at the cut for this limit.
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
    /// Growth rate from which on a band counts as flutter.
    pub flutter_threshold_per_s: f64,
    /// Free numbers and their best values.
    pub parameters: Vec<PlacedEntry>,
    /// Freed numbers without effect, or whose effect other free numbers have as well.
    pub without_effect: Vec<String>,
    /// Result of the original scene.
    pub before: OutcomeEntry,
    /// Worst neighbour of the original scene within its tolerances, itself included.
    pub worst_before: NeighbourEntry,
    /// Result of the best saw, which has the best goal in the worst case of its tolerances.
    pub best: OutcomeEntry,
    /// Bands of the best saw.
    pub bands: Vec<InstabilityEntry>,
    /// Certificate of these bands.
    pub certificate: PlaceCertificateEntry,
    /// Whether the best saw loses more than 5 % of the goal within its tolerances.
    pub fragile: bool,
    /// Worst neighbour of the best saw within its tolerances, itself included; the search maximizes its goal.
    pub worst_neighbour: Option<NeighbourEntry>,
    /// Goal of this neighbour divided by that of the best saw.
    pub worst_neighbour_share: f64,
    /// The saw with the best nominal goal, if it is better than the best saw and worse within its tolerances;
    /// null otherwise.
    pub fragile_optimum: Option<FragileOptimumEntry>,
    /// Bands that nearly reach the threshold and begin below the flutter speed.
    pub almost: Vec<InstabilityEntry>,
    /// The goal over two numbers, on the coarse basis of the search.
    pub map: Option<MapEntry>,
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
pub enum GoalEntry {
    /// The flutter speed.
    FlutterSpeed,
    /// Width of the window without instability around the operating speed.
    StableWindow,
}

/// A free number and its best value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlacedEntry {
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
}

/// Value of the goal for one saw, and the speeds that determine it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OutcomeEntry {
    /// Value of the goal: the flutter speed, or the end of the sweep if there is none, or the width of the
    /// window.
    pub goal_rpm: f64,
    /// Flutter speed; null if it exceeds the sweep.
    pub flutter_rpm: Option<f64>,
    /// Lowest critical speed.
    pub critical_rpm: Option<f64>,
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
pub struct PlaceCertificateEntry {
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
pub struct FragileOptimumEntry {
    /// Values of the numbers, in their order, and the goal.
    pub saw: NeighbourEntry,
    /// Worst neighbour of this saw within the tolerances.
    pub worst: NeighbourEntry,
}

/// A saw whose numbers deviate from another one by the tolerances.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NeighbourEntry {
    /// Values of the numbers, in their order.
    pub values: Vec<f64>,
    /// Result of the saw; null if it could not be computed.
    pub outcome: Option<OutcomeEntry>,
}

/// The goal over two numbers; the others have their best values.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MapEntry {
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

impl PlaceReport {
    /// The report of a placement.
    pub fn new(demands: &Demands, found: &Placement) -> Self {
        let neighbours = &found.neighbours;
        let threshold_per_s = found.scene.flutter_threshold_per_s();
        let entry = |band| InstabilityEntry::new(band, threshold_per_s);
        PlaceReport {
            sawflutter: env!("CARGO_PKG_VERSION").to_owned(),
            scene: found.scene.file().clone(),
            condition: found.scene.condition(),
            unusual_numbers: found.scene.file().unusual_numbers(),
            goal: GoalEntry::from(demands.goal),
            min_critical_rpm: demands.min_critical_rad_per_s.map(rpm),
            amplitude_m: demands.gap.and_then(|gap| gap.case.amplitude_m()),
            max_deflection_m: demands.gap.and_then(|gap| gap.max_deflection_m),
            force_n: demands
                .gap
                .and_then(|gap| gap.max_deflection_m.map(|_| gap.case.force_n())),
            kept: neighbours.keep_limit(),
            improved: found.improved,
            from_rpm: rpm(found.range.0),
            to_rpm: rpm(found.range.1),
            flutter_threshold_per_s: threshold_per_s,
            parameters: parameters(found),
            without_effect: found
                .without_effect
                .iter()
                .map(|freed| freed.parameter.path().to_owned())
                .collect(),
            before: OutcomeEntry::from(&found.before),
            worst_before: NeighbourEntry::from(&found.worst_before),
            best: OutcomeEntry::from(&found.best),
            bands: found.best.bands.iter().map(entry).collect(),
            certificate: PlaceCertificateEntry::new(found),
            fragile: neighbours.are_fragile(),
            worst_neighbour: Some(NeighbourEntry::from(&neighbours.worst)),
            worst_neighbour_share: neighbours.worst_share,
            fragile_optimum: found.fragile_optimum.as_ref().map(Into::into),
            almost: neighbours.almost.iter().map(entry).collect(),
            map: found.map.as_ref().map(MapEntry::from),
            saws: found.tally.saws,
            failed_saws: found.tally.failed,
            max_diameters: found.resolution.max_diameters,
            radial_functions: found.resolution.radial_functions_on(found.scene.blade()),
            warnings: warnings(&found.scene, demands, found),
        }
    }
}

impl PlaceCertificateEntry {
    fn new(found: &Placement) -> Self {
        let certificate = &found.best.certificate;
        PlaceCertificateEntry {
            statement: statement(certificate, found.is_undamped, None),
            is_clean: certificate.is_clean(),
            speeds_checked: certificate.speeds_checked,
            full_basis_counts: certificate.full_basis_counts,
        }
    }
}

impl From<&Neighbour> for NeighbourEntry {
    fn from(neighbour: &Neighbour) -> Self {
        NeighbourEntry {
            values: neighbour.values.clone(),
            outcome: neighbour.outcome.as_ref().map(OutcomeEntry::from),
        }
    }
}

impl From<&FragileOptimum> for FragileOptimumEntry {
    fn from(found: &FragileOptimum) -> Self {
        FragileOptimumEntry {
            saw: NeighbourEntry::from(&found.saw),
            worst: NeighbourEntry::from(&found.worst),
        }
    }
}

impl From<&Outcome> for OutcomeEntry {
    fn from(outcome: &Outcome) -> Self {
        OutcomeEntry {
            goal_rpm: rpm(outcome.value_rad_per_s),
            flutter_rpm: outcome.flutter_rad_per_s.map(rpm),
            critical_rpm: outcome.critical_rad_per_s.map(rpm),
            window_rpm: outcome.window.map(|(from, to)| [rpm(from), rpm(to)]),
            deflection_m: outcome.deflection_m,
            kept: outcome.is_kept(),
        }
    }
}

impl From<Goal> for GoalEntry {
    fn from(goal: Goal) -> Self {
        match goal {
            Goal::FlutterSpeed => GoalEntry::FlutterSpeed,
            Goal::StableWindow { .. } => GoalEntry::StableWindow,
        }
    }
}

impl From<&Map> for MapEntry {
    fn from(map: &Map) -> Self {
        let rows = map.outcomes.iter();
        let goal = |o: &Option<Outcome>| o.as_ref().map(|o| rpm(o.value_rad_per_s));
        let kept = |o: &Option<Outcome>| o.as_ref().is_some_and(Outcome::is_kept);
        MapEntry {
            x_path: map.x_path.clone(),
            x: map.x.clone(),
            y_path: map.y_path.clone(),
            y: map.y.clone(),
            goal_rpm: rows
                .clone()
                .map(|row| row.iter().map(goal).collect())
                .collect(),
            kept: rows.map(|row| row.iter().map(kept).collect()).collect(),
        }
    }
}

fn parameters(found: &Placement) -> Vec<PlacedEntry> {
    let Neighbours { offsets, along, .. } = &found.neighbours;
    let entries = found.parameters.iter().enumerate().map(|(k, p)| {
        let goal = |side: usize| {
            let neighbour = along[k][side].as_ref()?;
            let outcome = neighbour.outcome.as_ref()?;
            Some(rpm(outcome.value_rad_per_s))
        };
        PlacedEntry {
            path: p.freed.parameter.path().to_owned(),
            start: p.start,
            value: p.value,
            bound_from: p.freed.from,
            bound_to: p.freed.to,
            at_bound: p.at_bound,
            offset: offsets[k],
            less_rpm: goal(0),
            more_rpm: goal(1),
        }
    });
    entries.collect()
}

fn warnings(scene: &Scene, demands: &Demands, found: &Placement) -> Vec<String> {
    let mut warnings = Vec::new();
    for freed in &found.without_effect {
        let path = freed.parameter.path();
        warnings.push(if Quantity::kind_of(path) == Kind::Angle {
            format!(
                "{path} was kept: without the forces of a cut a common rotation of all guides changes nothing, so a single guide may be at any angle"
            )
        } else {
            format!("{path} changes no critical speed and no band, and was kept")
        });
    }
    if !found.improved {
        warnings.push(not_improved(found).into());
    }
    let beyond = match demands.goal {
        Goal::FlutterSpeed => found.best.flutter_rad_per_s.is_none(),
        Goal::StableWindow { .. } => found.best.window.is_some_and(|(_, to)| to >= found.range.1),
    };
    if beyond {
        warnings.push(format!(
            "the best saw is stable to the end of the sweep, {:.0} rpm, so better ones cannot be distinguished: end the sweep at a higher speed",
            rpm(found.range.1)
        ));
    }
    if !found.neighbours.keep_limit() {
        warnings.push(limit_missed(demands, found));
    }
    if found.tally.failed > 0 {
        warnings.push(format!(
            "{} of the {} saws tried could not be computed and count as the worst; the reason of one of them: {}",
            found.tally.failed,
            found.tally.saws,
            found.tally.why.as_deref().unwrap_or_default()
        ));
    }
    if scene.cut().is_some() {
        warnings
            .push("the search ignores the forces of the cut; check the result in the cut".into());
    }
    warnings
}

/// Message that no saw keeps the limits and that this one misses them by the smallest amount.
fn limit_missed(demands: &Demands, found: &Placement) -> String {
    let worst = found.neighbours.worst.outcome.as_ref();
    let critical = worst.and_then(|worst| worst.critical_rad_per_s);
    let short = demands.min_critical_rad_per_s.zip(critical);
    let short = short.filter(|(asked, found)| found < asked);
    let short = short.map(|(asked, found)| {
        let rpm = rpm(asked - found);
        format!(
            "no saw tried keeps the limit of the critical speed in the worst case of its tolerances; this one misses it by the smallest amount, {rpm:.0} rpm"
        )
    });
    let limit = demands.gap.and_then(|gap| gap.max_deflection_m);
    let deflection = worst.and_then(|worst| worst.deflection_m);
    let beyond = limit.filter(|limit| deflection.is_none_or(|found| found > *limit));
    let beyond = beyond.map(|_| {
        let found = deflection.map_or("more than the model is valid for".to_owned(), |m| {
            format!("{} mm", shown_to(3, 1e3 * m))
        });
        format!(
            "no saw tried keeps the limit of the deflection at the cut in the worst case of its tolerances; this one deflects there by {found}"
        )
    });
    let both: Vec<String> = short.into_iter().chain(beyond).collect();
    both.join("; ")
}

fn not_improved(found: &Placement) -> &'static str {
    let within = |p: &PlacedParameter| (p.freed.from..=p.freed.to).contains(&p.start);
    match found.parameters.iter().all(within) {
        true => {
            "no saw between the bounds is better than the original one in the worst case of the tolerances; the scene was kept"
        }
        false => {
            "the original saw, which lies outside the bounds, is in the worst case of its tolerances at least as good as the best one between them; widen the bounds, or keep it"
        }
    }
}
