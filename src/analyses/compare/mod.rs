//! Compares saws with the first of them: over the same speeds, unless their scenes name others.

pub(crate) mod chart;
mod outline;
mod report;

use crate::analyses::campbell::Report;
use crate::analyses::check::rim_stiffness_at_rest_n_per_m;
use crate::model::scene::{Entry, Scene, SpeedRange, in_words};
use crate::modes::branches::Progress;
use crate::stability::{Analysis, AnalysisError, end_of_sweep};
pub(crate) use outline::outline;

pub use report::{CompareReport, ComparedSaw, Difference};

/// A saw to compare.
#[derive(Debug, Clone)]
pub enum Saw {
    /// Scene of a saw, which is analysed.
    Scene(Box<Scene>),
    /// Report of a saw that was analysed before.
    Report(Box<Report>),
}

/// A saw with its name in the comparison.
pub struct NamedSaw {
    /// The name.
    pub name: String,
    /// The saw.
    pub saw: Saw,
}

/// Reason for which saws could not be compared.
#[derive(Debug, thiserror::Error)]
pub enum CompareError {
    /// The list of saws is empty.
    #[error("there is no saw to compare")]
    NoSaw,
    /// No end of the sweep can be chosen for a scene.
    #[error(transparent)]
    Sweep(#[from] AnalysisError),
    /// The saw with this name could not be analysed.
    #[error("{0}: {1}")]
    Saw(String, AnalysisError),
}

/// Compares named saws with the first of them. Every scene without a sweep gets the same one: from rest to the
/// largest end that the program chooses for any of these scenes.
///
/// # Errors
/// [`CompareError`] if there is no saw, or one cannot be analysed.
pub fn compare(saws: Vec<NamedSaw>, progress: Progress<'_>) -> Result<CompareReport, CompareError> {
    let ends = saws
        .iter()
        .filter_map(|named| match &named.saw {
            Saw::Scene(scene) if scene.sweep().is_none() => Some(end_of_sweep(scene)),
            _ => None,
        })
        .collect::<Result<Vec<_>, _>>()?;
    let end_rad_per_s = ends.into_iter().fold(0.0, f64::max);
    let of = saws.len();
    let mut compared = Vec::new();
    for (done, NamedSaw { name, saw }) in saws.into_iter().enumerate() {
        progress(done, of);
        compared.push(match saw {
            Saw::Report(report) => of_report(name, *report),
            Saw::Scene(scene) => of_scene(name, &scene, end_rad_per_s)?,
        });
    }
    Ok(CompareReport {
        sawflutter: env!("CARGO_PKG_VERSION").to_owned(),
        scene: compared.first().ok_or(CompareError::NoSaw)?.scene.clone(),
        differences: differences(&compared),
        saws: compared,
    })
}

/// Analyses a saw over the speeds of its scene; without any, up to a common end. The result has the stiffness of its rim.
fn of_scene(name: String, scene: &Scene, end_rad_per_s: f64) -> Result<ComparedSaw, CompareError> {
    let analysed = || match scene.sweep() {
        Some(_) => Analysis::new(scene),
        None => Analysis::new(&scene.swept(SpeedRange::new(0.0, end_rad_per_s))?),
    };
    let analysis = analysed().map_err(|reason| CompareError::Saw(name.clone(), reason))?;
    Ok(ComparedSaw {
        rim_stiffness_at_rest_n_per_m: rim_stiffness_at_rest_n_per_m(&analysis),
        ..of_report(name, analysis.report())
    })
}

/// A saw whose report exists already.
fn of_report(name: String, report: Report) -> ComparedSaw {
    ComparedSaw {
        name,
        scene: report.scene,
        condition: report.condition,
        critical_speeds: report.critical_speeds,
        instabilities: report.instabilities,
        first_critical_rpm: report.first_critical_rpm,
        flutter_rpm: report.flutter_rpm,
        verdict: report.verdict,
        operating: report.operating,
        rim_stiffness_at_rest_n_per_m: None,
        estimated_relative_error: report.accuracy.estimated_relative_error,
        campbell: report.campbell,
        warnings: [report.unusual_numbers, report.warnings].concat(),
    }
}

/// The keys that are not the same in all scenes, in the order in which the scenes name them.
fn differences(saws: &[ComparedSaw]) -> Vec<Difference> {
    let keys: Vec<_> = saws.iter().map(|saw| saw.scene.inputs()).collect();
    let mut found: Vec<Difference> = Vec::new();
    for Entry { path, .. } in keys.iter().flatten() {
        let value = |own: &Vec<Entry>| {
            let own = own.iter().find(|own| own.path == *path);
            own.map_or(String::new(), |own| in_words(&own.value))
        };
        if found.iter().all(|known| known.path != *path) {
            let (path, values) = (path.clone(), keys.iter().map(value).collect());
            found.push(Difference { path, values });
        }
    }
    found.retain(|key| key.values.windows(2).any(|pair| pair[0] != pair[1]));
    found
}
