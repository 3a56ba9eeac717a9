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
mod other_clamp;
mod outline;
mod pad;

pub use change::Change;
pub use decisive_speed::{DecidedSpeed, DecisiveSpeed};
pub use error::DesignError;
pub use options::Options;
pub use other_clamp::OtherClamp;
pub(crate) use outline::outline;
pub use pad::LoadedPad;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::campbell::{Report, Sensitivity, caution};
use super::gap::{self, GapError, GapReport, gap};
use super::response::{self, ResponseReport};
use super::size::{SizeReport, size};
use super::verdict::{Answer, Verdict};
use crate::analyses::door::Progress;
use crate::model::scene::{Freed, Scene, SceneFile};
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
    /// The saw whose collar holds the blade in its plane the other way; null without a collar or an operating speed.
    pub other_clamp: Option<OtherClamp>,
    /// Thicknesses of the blade with which the saw keeps its limits; null unless it does not keep them now.
    pub thickness: Option<SizeReport>,
    /// Guides with a gap; null if no guide is one-sided.
    pub gap: Option<GapReport>,
    /// Remarks on the validity of the result.
    pub warnings: Vec<String>,
}

/// Thickest blade that is tried where the saw does not keep its limits, relative to its own, and number of thicknesses.
const MOST: f64 = 2.0;
const THICKNESSES: usize = 9;

/// Computes the report of a saw.
///
/// # Errors
/// [`DesignError`].
pub fn report(
    scene: &Scene,
    options: &Options,
    progress: Progress<'_>,
) -> Result<DesignReport, DesignError> {
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
    let verdict = worst.unwrap_or_else(|| idling.verdict.clone());
    let thickness = match verdict.answer {
        None | Some(Answer::Yes) => None,
        Some(Answer::AtRisk | Answer::No) => thickness(deciding_scene, progress)?,
    };
    Ok(DesignReport {
        verdict,
        other_clamp: OtherClamp::of(deciding_scene)?,
        thickness,
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

/// Thicknesses with which a saw keeps its limits, up to twice its own; `None` where the scene refuses such a blade.
fn thickness(scene: &Scene, progress: Progress<'_>) -> Result<Option<SizeReport>, DesignError> {
    let own_m = scene.file().blade.thickness_m;
    let freed = Freed::new(scene.file(), "blade.thickness_m", own_m, MOST * own_m);
    let sized = freed
        .ok()
        .map(|freed| size(scene, &[freed], THICKNESSES, progress));
    Ok(sized.transpose()?)
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
        report(&scene.unwrap(), &Options::default(), &|_| ()).unwrap()
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
        let ratio = thickness.first_critical_rpm.unwrap() / critical.rpm.unwrap();
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
        assert_eq!(found.idling.flutter_rpm, scene(None).flutter_rpm);
        assert_eq!(cut.flutter_rpm, scene(operating).flutter_rpm);
        let margins: Vec<f64> = found
            .speeds
            .iter()
            .filter_map(|speed| speed.margin_rpm)
            .collect();
        assert_eq!(margins.len(), 4);
        assert!((margins[3] - (cut.flutter_rpm.unwrap() - operating.unwrap())).abs() < 1e-9);
        // Both changes raise the flutter speed in the cut.
        assert_eq!(
            (found.raised, found.changes.len()),
            (DecidedSpeed::Flutter, 2)
        );
        for change in &found.changes {
            assert!(
                change
                    .flutter_rpm
                    .is_none_or(|rpm| rpm > cut.flutter_rpm.unwrap())
            );
        }
    }

    /// Source: analyses by hand of this saw of 550 mm with two pads, with either condition of the collar and with eight thicknesses.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
    fn a_saw_at_risk_has_its_thickness_and_its_other_clamp() {
        let pad = |angle: f64| {
            format!(
                r#"{{"radius_m": 0.22, "angle_deg": {angle}, "radial_length_m": 0.06, "tangential_length_m": 0.05,
                    "stiffness_n_per_m": 1e7}}"#
            )
        };
        let [left, right] = [-40.0, 40.0].map(pad);
        let saw = Scene::from_json(&format!(
            r#"{{"name": "oak", "accuracy": "draft", "operating_rpm": 2400, "guides": [{left}, {right}],
                "blade": {{"outer_diameter_m": 0.55, "inner_diameter_m": 0.04, "thickness_m": 0.0022, "teeth": 36, "material":
                    {{"youngs_modulus_pa": 2.1e11, "poisson_ratio": 0.3, "density_kg_per_m3": 7850}}}},
                "mount": {{"kind": "collar", "diameter_m": 0.12, "in_plane": "free"}}}}"#
        ));
        let found = report(&saw.unwrap(), &Options::default(), &|_| ()).unwrap();
        assert_eq!(found.verdict.answer, Some(Answer::AtRisk));
        let other = found.other_clamp.unwrap();
        assert_eq!(other.in_plane, crate::model::scene::InPlane::Fixed);
        let rpm = other.first_critical_rpm.unwrap();
        assert!((rpm / 2421.0 - 1.0).abs() < 3e-3, "{rpm}");
        assert_eq!(other.verdict.cause.as_deref(), Some("critical"));
        let sized = found.thickness.unwrap();
        let [window] = sized.windows.as_slice() else {
            panic!("{:?}", sized.windows);
        };
        assert!((window.from / 2.36e-3 - 1.0).abs() < 3e-3, "{window:?}");
        assert_eq!(sized.answer.unwrap().value, 2.4e-3);
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
        let found = report(&saw.unwrap(), &Options::default(), &|_| ()).unwrap();
        let mut changes = found.changes.iter();
        let rolling = changes
            .find(|change| change.path.ends_with("eigenstrain"))
            .unwrap();
        assert!((rolling.to + 6.4e-4).abs() < 1e-12, "{rolling:?}");
        assert!(
            rolling.first_critical_rpm > found.speeds[0].rpm,
            "{rolling:?}"
        );
    }
}
