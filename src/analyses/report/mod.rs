//! The report of a saw for a decision: can it run at its speed, by which margin, how far does it deviate, and what should be changed.
//!
//! [`report`](report()) joins what the other commands compute: the analysis of the idling saw, that under the forces of its cut, and the
//! steady response. It adds how far the critical speeds and the flutter speed are from the operating speed and how much of that usual
//! tolerances of production take ([`DecisiveSpeed`]), and the changes of the saw that raise the speed which decides most
//! ([`Change`]), each computed anew. A part that the scene does not need is absent: the cut without a cut, the gap without a one-sided
//! guide.

mod change;
mod command;
mod decisive_speed;
mod error;
mod options;
mod outline;
mod pad;

pub use change::Change;
pub use decisive_speed::{DecidedSpeed, DecisiveSpeed};
pub use error::DesignError;
pub use options::Options;
pub(crate) use outline::outline;
pub use pad::LoadedPad;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::campbell::{Report, Sensitivity, caution};
use super::gap::{self, GapError, GapReport, gap};
use super::response::{self, ResponseReport};
use super::verdict::Verdict;
use crate::model::scene::{Scene, SceneFile};
use crate::stability::Analysis;

/// Report of a saw for a decision (`design.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DesignReport {
    /// Version of the program that wrote the report.
    pub sawflutter: String,
    /// The scene, as typed.
    pub scene: SceneFile,
    /// Whether the saw is shown idling only: "idling", or "idling, and in the cut at 1800 rpm (3.77 teeth)".
    pub condition: String,
    /// Numbers that no saw has, each with its key, the usual range, and the remedy. The results hold for the numbers as typed.
    pub unusual_numbers: Vec<String>,
    /// For whom the report is; null if not given.
    pub customer: Option<String>,
    /// Date of the report as typed; null if not given.
    pub date: Option<String>,
    /// The verdict of the condition with the worse answer, idling or in the cut.
    pub verdict: Verdict,
    /// Analysis of the idling saw, with sensitivities; the deviation of the board is that of the cut, if there is one.
    pub idling: Report,
    /// Analysis under the forces of the cut, with sensitivities; null for a scene without a cut.
    pub in_cut: Option<Report>,
    /// Steady response of the saw in its cut, or idling without a cut.
    pub response: ResponseReport,
    /// First critical speed and flutter speed, idling and in the cut.
    pub speeds: Vec<DecisiveSpeed>,
    /// Speed that the changes raise.
    pub raised: DecidedSpeed,
    /// The changes of one number that raise it most, the best first.
    pub changes: Vec<Change>,
    /// Linear pads under the side force at the cut at the operating speed; empty unless the saw is stable there.
    #[serde(default)]
    pub pads: Vec<LoadedPad>,
    /// Guides with a gap; null if no guide is one-sided.
    pub gap: Option<GapReport>,
    /// Remarks on the validity of the result.
    pub warnings: Vec<String>,
}

/// Computes the report of a saw.
///
/// # Errors
/// [`DesignError`].
pub fn report(scene: &Scene, options: &Options) -> Result<DesignReport, DesignError> {
    let still = scene.idling()?;
    let cutting = scene.cutting_rpm().map(|rpm| scene.charted_in_cut(rpm));
    let cutting = cutting.transpose()?;
    let analysed = |scene: &Scene| -> Result<(Analysis, Report), DesignError> {
        let analysis = Analysis::new(scene)?;
        let mut report = analysis.report();
        report.sensitivities = Sensitivity::all(&analysis)?;
        Ok((analysis, report))
    };
    let (analysis, mut idling) = analysed(&still)?;
    let cut = cutting.as_ref().map(analysed).transpose()?;
    let deciding_scene = cutting.as_ref().unwrap_or(&still);
    let (deciding_analysis, deciding) = match &cut {
        Some((analysis, report)) => (analysis, report),
        None => (&analysis, &idling),
    };
    let response = response::of_analysis(deciding_analysis, &response::Options::default())?;
    let reports = || {
        [&idling]
            .into_iter()
            .chain(cut.iter().map(|(_, report)| report))
    };
    let speeds = reports().flat_map(DecisiveSpeed::of).collect();
    let raised = DecidedSpeed::to_raise(deciding);
    let changes = Change::best(
        deciding_scene,
        deciding_analysis.range_rad_per_s,
        deciding,
        raised,
    )?;
    let pads = LoadedPad::all(deciding_analysis);
    let one_sided = gap::Options::default();
    let (gap, gap_refused) = match one_sided.checked(scene) {
        Ok(()) => match gap(&still, &one_sided) {
            Err(GapError::Refused(refused)) => (None, Some(refused)),
            found => (Some(found?), None),
        },
        Err(_) => (None, None),
    };
    let condition = match &cut {
        Some((_, report)) => format!("idling, and {}", report.condition),
        None => idling.condition.clone(),
    };
    // The verdicts say what other analyses warn of.
    let told: Vec<String> = reports().filter_map(caution).collect();
    let mut warnings: Vec<String> = Vec::new();
    let analysed = reports().map(|report| &report.warnings);
    let others = gap.iter().map(|gap| &gap.warnings);
    for warning in analysed.chain([&response.warnings]).chain(others).flatten() {
        if !warnings.contains(warning) && !told.contains(warning) {
            warnings.push(warning.clone());
        }
    }
    let unevaluated = |refused| format!("the guides with a gap are not evaluated: {refused}");
    warnings.extend(gap_refused.map(unevaluated));
    if cut.is_some()
        && let Some(operating) = idling.operating.as_mut()
    {
        // The board is sawn in the cut.
        operating.deviation = None;
    }
    let in_cut = cut.map(|(_, report)| report);
    let verdicts = [Some(&idling), in_cut.as_ref()].into_iter().flatten();
    let worst = verdicts.map(|report| &report.verdict);
    let worst = worst.max_by_key(|verdict| verdict.answer).cloned();
    Ok(DesignReport {
        verdict: worst.unwrap_or_else(|| idling.verdict.clone()),
        sawflutter: idling.sawflutter.clone(),
        scene: scene.file().clone(),
        condition,
        unusual_numbers: idling.unusual_numbers.clone(),
        customer: options.customer.clone(),
        date: options.date.clone(),
        idling,
        in_cut,
        response,
        speeds,
        raised,
        changes,
        pads,
        gap,
        warnings,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::Accuracy;

    fn reported(change: impl FnOnce(&mut SceneFile)) -> DesignReport {
        let scene = Scene::paper().edited(|file| {
            file.accuracy = Accuracy::Draft;
            change(file);
        });
        report(&scene.unwrap(), &Options::default()).unwrap()
    }

    /// Without guides every critical speed is in proportion to the thickness h, to √E and to 1/√ρ: tolerances of 1 % of each change it by
    /// the root of 1² + 0.5² + 0.5² percent.
    #[test]
    fn tolerances_of_a_free_blade_are_those_of_the_closed_form() {
        let found = reported(|file| {
            file.guides.clear();
            file.cut = None;
        });
        let critical = &found.speeds[0];
        let share = critical.tolerance_rpm.unwrap() / critical.rpm.unwrap();
        assert!(
            (share / (1e-2 * 1.5_f64.sqrt()) - 1.0).abs() < 1e-6,
            "{share}"
        );
        assert!(found.in_cut.is_none() && found.gap.is_none());
        assert_eq!(found.condition, "idling");
        // The operating speed breaks the 85 % rule, but nothing flutters.
        assert_eq!(found.raised, DecidedSpeed::FirstCritical);
        let [thickness] = found.changes.as_slice() else {
            panic!("{:?}", found.changes);
        };
        let ratio = thickness.critical_rpm.unwrap() / critical.rpm.unwrap();
        assert!((ratio / (3.0 / 2.8) - 1.0).abs() < 1e-4, "{ratio}");
    }

    /// The parts are those of the commands for each condition.
    #[test]
    fn a_saw_with_a_cut_is_reported_idling_and_in_the_cut() {
        let found = reported(|file| file.measured = None);
        let cut = found.in_cut.as_ref().unwrap();
        let scene = |rpm: Option<f64>| {
            let edited = Scene::paper().edited(|file| {
                file.accuracy = Accuracy::Draft;
                file.cut.as_mut().unwrap().chart_rpm = rpm;
            });
            Analysis::new(&edited.unwrap()).unwrap().report()
        };
        let operating = found.scene.operating_rpm;
        assert_eq!(
            found.idling.flutter_speed_rpm,
            scene(None).flutter_speed_rpm
        );
        assert_eq!(cut.flutter_speed_rpm, scene(operating).flutter_speed_rpm);
        let margins: Vec<f64> = found
            .speeds
            .iter()
            .filter_map(|speed| speed.margin_rpm)
            .collect();
        assert_eq!(margins.len(), 4);
        assert!((margins[3] - (cut.flutter_speed_rpm.unwrap() - operating.unwrap())).abs() < 1e-9);
        // Both changes raise the flutter speed in the cut.
        assert_eq!(
            (found.raised, found.changes.len()),
            (DecidedSpeed::Flutter, 2)
        );
        for change in &found.changes {
            assert!(
                change
                    .flutter_rpm
                    .is_none_or(|rpm| rpm > cut.flutter_speed_rpm.unwrap())
            );
        }
    }

    /// Rolling inwards lowers the first critical speed of this blade, so that less of it raises the speed.
    #[test]
    fn a_change_of_a_negative_number_goes_the_way_that_raises_the_speed() {
        let saw = Scene::from_json(
            r#"{"name": "rolled", "accuracy": "draft", "operating_rpm": 3000,
                "blade": {"outer_diameter_m": 0.4, "inner_diameter_m": 0.1, "thickness_m": 0.0022, "material":
                    {"youngs_modulus_pa": 2.1e11, "poisson_ratio": 0.3, "density_kg_per_m3": 7850}},
                "mount": {"kind": "collar", "diameter_m": 0.13, "in_plane": "fixed"},
                "membrane": {"roll_tension": [{"radius_m": 0.14, "width_m": 0.02, "eigenstrain": -8e-4}]}}"#,
        );
        let found = report(&saw.unwrap(), &Options::default()).unwrap();
        let mut changes = found.changes.iter();
        let rolling = changes
            .find(|change| change.path.ends_with("eigenstrain"))
            .unwrap();
        assert!((rolling.to + 6.4e-4).abs() < 1e-12, "{rolling:?}");
        assert!(rolling.critical_rpm > found.speeds[0].rpm, "{rolling:?}");
    }
}
