//! Stability and deflection of the saw in the cut, at some speeds: by eigenvalues, by the record of a probe before, during and
//! after the cut, and with tooth loads that move with the teeth; over guide angle and load; and on the teeth of a spline.
//!
//! ```no_run
//! use sawflutter::analyses::cut::cut;
//! use sawflutter::model::scene::Scene;
//!
//! let scene = Scene::paper();
//! let runs = scene.needed_cut()?.runs_at(&[1800.0, 2800.0])?;
//! for run in cut(&scene, &runs, &|_, _| ())?.runs {
//!     println!("{} rpm: {}", run.rpm, run.stability);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod certificate;
pub(crate) mod chart;
#[cfg(test)]
mod chart_tests;
mod criteria;
mod history;
mod limits;
pub(crate) mod map_chart;
mod options;
pub(crate) mod orbit_chart;
mod outline;
mod record;
mod report;
mod saw;
mod spline;
mod stretching;
#[cfg(test)]
mod tests;
mod tooth_passing;
mod verdict_map;
mod warnings;

pub(crate) use outline::outline;
use std::f64::consts::TAU;

use crate::analyses::campbell::{Verdict, lifting_off};
use crate::model::evenly_spaced;
use crate::model::plate::Plate;
use crate::model::scene::{
    Accuracy, Cut, CutRun, Scene, SceneError, SpeedRange, in_the_cut, rpm, unusual_number,
};
use crate::modes::Work;
use crate::modes::branches::Progress;
use crate::motion::transient::{TransientError, linear_limit_m};
use crate::stability::{ChosenBasis, critical_at};

pub use certificate::CutCertificate;
pub use criteria::{CutCriterion, CutFinding, CutStability};
pub use options::Options;
pub use report::{ByPower, CutAtSpeed, CutReport};
pub use spline::SplineOrbit;
pub use stretching::CutStretching;
pub use tooth_passing::ToothPassing;
pub use verdict_map::VerdictMap;

use criteria::{agree, criteria, worst};
use history::cut_history;
use limits::InCut;
use record::Growth;
use saw::SawInCut;
use spline::on_spline;
use tooth_passing::tooth_passing;
use verdict_map::verdict_map;
use warnings::warnings;

/// Smallest number of tooth positions within a pitch. With 42 teeth the growth rate changes by 0.03 % from 8 to
/// 16 positions.
const STAGES: usize = 8;
/// Largest angle between tooth positions. With 4 teeth the growth rate changes by up to 0.5 % from 32 positions
/// on.
const STAGE_DEG: f64 = 1.1;
/// Largest angle by which the map moves the guides to either side.
const MAP_TURN_DEG: f64 = 30.0;
/// Highest load level of the map.
const MAP_LOAD: f64 = 1.5;

/// Number of parts of the computation at one speed: the saw under the forces, time history, teeth and map.
const PARTS: usize = 4;

/// Computes the scene's cut at the speeds and under the forces of `runs`, see [`Cut::runs_at`].
///
/// # Errors
/// [`TransientError`].
pub fn cut(
    scene: &Scene,
    runs: &[CutRun],
    progress: Progress<'_>,
) -> Result<CutReport, TransientError> {
    let cut = scene.needed_cut().map_err(SceneError::from)?;
    let teeth = cut.teeth;
    // With 400 eigenproblems per speed the map is most of the work of a cut; a draft has 91.
    let (turn_deg, load_level) = match scene.accuracy() {
        Accuracy::Draft => (5.0, 0.25),
        Accuracy::Design | Accuracy::Reference => (2.5, 0.1),
    };
    let stage_count = (teeth.pitch_rad().to_degrees() / STAGE_DEG).ceil() as usize;
    let cutting = Cutting {
        scene,
        cut,
        plate: chosen_plate(scene, runs)?,
        turns_rad: if scene.guides().is_empty() {
            // Without guides the map has no guide angle to vary.
            vec![0.0]
        } else {
            even(-MAP_TURN_DEG, MAP_TURN_DEG, turn_deg)
                .into_iter()
                .map(f64::to_radians)
                .collect()
        },
        load_levels: even(0.0, MAP_LOAD, load_level),
        stages: STAGES.max(stage_count),
        parts: Work::of("parts of the cut", PARTS * runs.len()),
    };
    let points = cutting.turns_rad.len() * cutting.load_levels.len();
    let mut found = Vec::new();
    for (index, run) in runs.iter().enumerate() {
        let of = |done: usize, _| progress(index * points + done, runs.len() * points);
        found.push(cutting.at_speed(run, &of)?);
    }
    let [thickness_m, _] = scene.blade().thickness_range_m();
    let of_run = |run| warnings(run, teeth.mean, thickness_m);
    Ok(CutReport {
        sawflutter: env!("CARGO_PKG_VERSION").to_owned(),
        scene: scene.file().clone(),
        condition: in_the_cut(runs),
        unusual_numbers: unusual_numbers(scene, cut, runs),
        degrees_of_freedom: cutting.plate.degrees_of_freedom(),
        flutter_threshold_per_s: scene.flutter_threshold_per_s(),
        linear_limit_m: linear_limit_m(scene.blade()),
        teeth: teeth.mean,
        arc_deg: teeth.arc_rad().to_degrees(),
        warnings: lifting_off(scene)
            .into_iter()
            .chain(found.iter().flat_map(of_run))
            .collect(),
        runs: found,
    })
}

/// Data that all speeds of a cut have in common.
struct Cutting<'a> {
    scene: &'a Scene,
    cut: &'a Cut,
    /// The saw without the forces of the cut, on a basis that satisfies the tolerance of the scene.
    plate: Plate,
    /// Angles by which the map turns the guides.
    turns_rad: Vec<f64>,
    /// Factors of the forces in the map.
    load_levels: Vec<f64>,
    /// Number of tooth positions within a pitch.
    stages: usize,
    parts: Work,
}

impl Cutting<'_> {
    fn at_speed(&self, run: &CutRun, progress: Progress<'_>) -> Result<CutAtSpeed, TransientError> {
        let (scene, cut) = (self.scene, self.cut);
        let saw = SawInCut::new(&self.plate, cut, run)?;
        self.parts.advance();
        let history = cut_history(&saw, scene.probe(), scene.limits().margin())?;
        self.parts.advance();
        let loads = tooth_passing(&saw, scene.probe(), self.stages)?;
        let tooth_passing = loads.found;
        self.parts.advance();
        let spline = on_spline(scene, &self.plate, cut, run)?;
        let map = verdict_map(&saw, scene, &self.turns_rad, &self.load_levels, progress)?;
        self.parts.advance();
        let of = |growth: Growth| Verdict::of(scene, growth);
        let (idle, in_cut, fitted) = (history.idle(), history.in_cut(), history.fitted);
        let criteria = criteria(scene, &history, loads.moving, spline.as_ref());
        let decision = worst(&criteria);
        // With stretching, only the record decides whether the blade leaves the model, because moving loads
        // are computed by the linear model only.
        let linear_until_s = history.record.linear_until_s;
        let leaves_model = match &history.stretched {
            Some(found) => found.valid_until_s.is_some(),
            None => linear_until_s.is_some() || tooth_passing.passing_deflection_m.is_none(),
        };
        let critical_rad_per_s = &history.critical_rad_per_s;
        let near = critical_at(critical_rad_per_s, run.speed_rad_per_s);
        let at_critical_rpm = near.map(|place| rpm(critical_rad_per_s[place]));
        let dominant_hz = history.dominant_rad_per_s.map(|speed| speed / TAU);
        let forces_to_s = cut.idle_s + run.duration_s;
        let [in_cut_m, after_m] = history.largest_deflections_m(forces_to_s);
        let by_power = run.tangential_of_power_n.zip(history.in_cut_by_power);
        let is_critical = at_critical_rpm.is_some();
        let stability = CutStability::new(decision.verdict, leaves_model, is_critical);
        let verdict = InCut {
            speed_rad_per_s: run.speed_rad_per_s,
            stability,
            decisive: criteria.iter().find(|found| found.criterion == decision.by),
            leaves_model,
            is_stretched: history.stretched.is_some(),
            critical_rad_per_s,
            largest_deflection_m: in_cut_m,
        }
        .verdict(scene);
        Ok(CutAtSpeed {
            rpm: run.rpm,
            verdict,
            tangential_n_per_tooth: run.tangential_n,
            radial_n_per_tooth: run.radial_n,
            lateral_n_per_tooth: run.lateral_n,
            stability,
            at_critical_rpm,
            decided_by: decision.by,
            criteria,
            growth_per_s: in_cut.growth_per_s,
            frequency_hz: in_cut.growing_hz().or(dominant_hz),
            agree: fitted.map(|fitted| agree(scene, fitted, in_cut)),
            transient_verdict: fitted.map(of),
            transient_growth_per_s: fitted.map(|fitted| fitted.growth_per_s),
            transient_frequency_hz: fitted
                .filter(|fitted| of(*fitted) == Verdict::Unstable)
                .map(|fitted| fitted.frequency_rad_per_s / TAU),
            dominant_frequency_hz: dominant_hz,
            idle_verdict: of(idle),
            idle_growth_per_s: idle.growth_per_s,
            certificate: CutCertificate::new(&history.growing),
            by_power: by_power.map(|(tangential_n_per_tooth, growth)| ByPower {
                tangential_n_per_tooth,
                verdict: of(growth),
                growth_per_s: growth.growth_per_s,
            }),
            tooth_passing,
            linear_until_s,
            largest_deflection_in_cut_m: in_cut_m,
            largest_deflection_after_m: after_m,
            forces_from_s: cut.idle_s,
            forces_to_s,
            stretching: history.stretched,
            time_s: history.record.time_s,
            deflection_m: history.record.deflection_m,
            map,
            spline,
        })
    }
}

/// The plate on a basis that satisfies the scene's tolerance up to the fastest cut.
fn chosen_plate(scene: &Scene, runs: &[CutRun]) -> Result<Plate, TransientError> {
    let fastest = runs
        .iter()
        .map(|run| run.speed_rad_per_s)
        .fold(0.0, f64::max);
    let to_rad_per_s = scene.sweep().map_or(0.0, |sweep| sweep.to_rad_per_s);
    let swept = scene
        .idling()?
        .swept(SpeedRange::new(0.0, to_rad_per_s.max(fastest)))?;
    Ok(ChosenBasis::new(&swept, scene.tolerance())?.saw.plate)
}

/// Unusual numbers of the scene, and of speeds of the cut that the scene does not list.
fn unusual_numbers(scene: &Scene, cut: &Cut, runs: &[CutRun]) -> Vec<String> {
    let file = scene.file();
    let asked = runs
        .iter()
        .map(|run| run.rpm)
        .filter(|rpm| cut.runs.iter().all(|run| run.rpm != *rpm))
        .filter_map(|rpm| unusual_number(file, "the speed of the cut", "cut.speeds[].rpm", rpm));
    file.unusual_numbers().into_iter().chain(asked).collect()
}

/// Evenly spaced values over a range with its ends, a step apart.
fn even(from: f64, to: f64, step: f64) -> Vec<f64> {
    evenly_spaced([from, to], 1 + ((to - from) / step).round() as usize)
}
