//! Every command of the program that computes results of one saw: the scene and the report are JSON.

use pyo3::prelude::*;
use sawflutter::check::{Check, Limits, LimitsFile};
use sawflutter::deflect::{Deflecting, Options as DeflectOptions};
use sawflutter::fit::{Fit, Measurement, Options as FitOptions};
use sawflutter::gap::{Friction, GuideGaps, Options as GapOptions, OscillatingForce};
use sawflutter::place::{Demands, GapDemands, Options as PlaceOptions, Placement, Tolerances};
use sawflutter::report::{
    CheckReport, CompareReport, ComparedEntry, CutReport, DeflectReport, FitReport, GapReport,
    ModeEntry, PlaceReport, ResponseReport, RunUpReport, SensitivityEntry, WashboardReport,
    over_common_speeds,
};
use sawflutter::response::{ForcedResponse, Options as ResponseOptions};
use sawflutter::scene::{Freed, NamedBounds, Scene, SpeedRange};
use sawflutter::spectrum::{SpectralModel, Strategy};
use sawflutter::stability::{Analysis, AnalysisOptions, ChosenBasis, ExpectedWork};
use sawflutter::transient::{Cutting, RunningUp};
use sawflutter::washboarding::Washboard;
use serde::Serialize;

use crate::arguments;
use crate::failure::Failure;
use crate::watch::compute;

/// JSON as the program writes it to its files.
fn json(report: &impl Serialize) -> Result<String, Failure> {
    Ok(serde_json::to_string_pretty(report)?)
}

/// `report.json` of a scene.
#[pyfunction]
#[pyo3(signature = (scene, *, sensitivity=false, amplitude=false, shapes_at_rpm=None, progress=None))]
pub fn analyze(
    py: Python<'_>,
    scene: &str,
    sensitivity: bool,
    amplitude: bool,
    shapes_at_rpm: Option<Vec<f64>>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<String> {
    let scene = arguments::scene(scene)?;
    compute(py, progress, move |meter| {
        let say_if_long = |expected: ExpectedWork| {
            if expected.is_long() {
                meter.remark(expected.to_string());
            }
        };
        let options = AnalysisOptions {
            expected: Some(&say_if_long),
            ..AnalysisOptions::default()
        };
        let analysis = Analysis::with_options(&scene, options)?;
        let mut report = analysis.report();
        if amplitude {
            report.add_amplitudes(&analysis)?;
        }
        if let Some(asked_rpm) = shapes_at_rpm {
            let range = SpeedRange::from(analysis.range_rad_per_s);
            let asked = asked_rpm.iter().map(|rpm| range.speed_at("shapes", *rpm));
            let asked = asked.collect::<Result<Vec<_>, _>>()?;
            report.add_shapes(&analysis, &asked)?;
        }
        if sensitivity {
            report.sensitivities = SensitivityEntry::all(&analysis)?;
        }
        json(&report)
    })
}

/// `compare.json` of saws by their labels. Each is the text of a scene or of a report.
#[pyfunction]
#[pyo3(signature = (saws, *, progress=None))]
pub fn compare(
    py: Python<'_>,
    saws: Vec<(String, String, bool)>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<String> {
    let scenes = saws.iter().filter(|(_, _, is_report)| !is_report);
    let scenes = scenes.map(|(_, text, _)| arguments::scene(text));
    let scenes = scenes.collect::<Result<Vec<_>, _>>()?;
    compute(py, progress, move |meter| {
        let mut scenes = over_common_speeds(scenes)?.into_iter();
        let mut compared = Vec::new();
        for (done, (label, text, is_report)) in saws.iter().enumerate() {
            meter.show_of("saws", done, saws.len());
            let scene = if *is_report { None } else { scenes.next() };
            compared.push(match scene {
                Some(scene) => ComparedEntry::of_analysis(label.clone(), &Analysis::new(&scene)?),
                None => ComparedEntry::of_report(label.clone(), &serde_json::from_str(text)?),
            });
        }
        json(&CompareReport::new(compared))
    })
}

/// Modes of a scene at speeds of its sweep, ascending by frequency at each, from one basis.
#[pyfunction]
#[pyo3(signature = (scene, at_rpm, *, progress=None))]
pub fn modes(
    py: Python<'_>,
    scene: &str,
    at_rpm: Vec<f64>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<String> {
    let scene = arguments::scene(scene)?;
    compute(py, progress, move |meter| {
        let chosen = ChosenBasis::new(&scene, scene.tolerance())?;
        let range = chosen.range_rad_per_s;
        let speeds = at_rpm.iter();
        let speeds = speeds.map(|rpm| SpeedRange::from(range).speed_at("rpm", *rpm));
        let speeds = speeds.collect::<Result<Vec<_>, _>>()?;
        let model =
            SpectralModel::with_critical(chosen.saw, chosen.critical, range, Strategy::Reduced)?;
        let mut entries = Vec::new();
        for (done, speed) in speeds.iter().enumerate() {
            meter.show(done, speeds.len());
            let found = model.describe(*speed, model.modes(*speed)?);
            let entry = |mode| ModeEntry::new(&model.plate, *speed, mode);
            entries.push(found.iter().map(entry).collect::<Vec<_>>());
        }
        json(&entries)
    })
}

/// `check.json` of a scene.
#[allow(clippy::too_many_arguments, reason = "they are Python's")]
#[pyfunction]
#[pyo3(signature = (scene, *, operating_rpm=None, margin=0.85, min_flutter_rpm=None,
                    min_critical_rpm=None, max_rim_m_per_s=100.0, max_amplitude_mm=None, accept_unusual=false,
                    progress=None))]
pub fn check(
    py: Python<'_>,
    scene: &str,
    operating_rpm: Option<f64>,
    margin: f64,
    min_flutter_rpm: Option<f64>,
    min_critical_rpm: Option<f64>,
    max_rim_m_per_s: f64,
    max_amplitude_mm: Option<f64>,
    accept_unusual: bool,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<String> {
    let scene = arguments::scene(scene)?;
    let asked = LimitsFile {
        operating_rpm,
        margin,
        min_flutter_rpm,
        min_critical_rpm,
    };
    let limits = asked.limits(&scene);
    let limits = limits.and_then(|limits| limits.with_rim_speed(max_rim_m_per_s));
    let limits = limits.and_then(|limits| limits.with_amplitude(max_amplitude_mm));
    let limits = Limits {
        accept_unusual,
        ..limits.map_err(Failure::from)?
    };
    compute(py, progress, move |_| {
        let check = Check::new(&scene, &limits)?;
        json(&CheckReport::new(&scene, &limits, &check))
    })
}

/// `cut.json` of a scene, at the speeds given or, without any, at those of the scene.
#[pyfunction]
#[pyo3(signature = (scene, rpm, *, progress=None))]
pub fn cut(
    py: Python<'_>,
    scene: &str,
    rpm: Vec<f64>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<String> {
    let scene = arguments::scene(scene)?;
    compute(py, progress, move |meter| {
        let runs = scene.needed_cut()?.runs_at(&rpm)?;
        let cutting = Cutting::new(&scene, &runs, &|done, of| meter.show(done, of))?;
        json(&CutReport::new(&cutting))
    })
}

/// `runup.json` of a scene.
#[pyfunction]
#[pyo3(signature = (scene, *, progress=None))]
pub fn runup(py: Python<'_>, scene: &str, progress: Option<Bound<'_, PyAny>>) -> PyResult<String> {
    let scene = arguments::scene(scene)?;
    compute(py, progress, move |meter| {
        scene.needed_runup()?;
        let found = RunningUp::new(&scene, &|done, of| meter.show(done, of))?;
        json(&RunUpReport::new(&found))
    })
}

/// `deflect.json` of a scene, under a force, up to a speed.
#[pyfunction]
#[pyo3(signature = (scene, *, force_n=None, angle_deg=None, to_rpm=None, progress=None))]
pub fn deflect(
    py: Python<'_>,
    scene: &str,
    force_n: Option<f64>,
    angle_deg: Option<f64>,
    to_rpm: Option<f64>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<String> {
    let scene = arguments::scene(scene)?;
    let options = DeflectOptions {
        force_n,
        angle_deg,
        to_rpm,
    };
    options.checked(&scene).map_err(Failure::from)?;
    compute(py, progress, move |_| {
        json(&DeflectReport::new(&Deflecting::new(&scene, &options)?))
    })
}

/// `response.json` of a scene, with the frequency response at a speed.
#[pyfunction]
#[pyo3(signature = (scene, *, rpm=None, to_hz=None, progress=None))]
pub fn response(
    py: Python<'_>,
    scene: &str,
    rpm: Option<f64>,
    to_hz: Option<f64>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<String> {
    let scene = arguments::scene(scene)?;
    let options = ResponseOptions { rpm, to_hz };
    options.checked().map_err(Failure::from)?;
    compute(py, progress, move |_| {
        json(&ResponseReport::new(&ForcedResponse::new(
            &scene, &options,
        )?))
    })
}

/// `gap.json` of a scene, under a side force at the cut, at a speed.
#[pyfunction]
#[pyo3(signature = (scene, *, force_n=None, rpm=None, max_deviation_mm=None, oscillating_force_n=None,
                    oscillating_order=1, friction=None, heat_share=1.0, convection_w_per_m2_k=60.0,
                    conductivity_w_per_m_k=45.0, progress=None))]
#[allow(clippy::too_many_arguments, reason = "they are Python's")]
pub fn gap(
    py: Python<'_>,
    scene: &str,
    force_n: Option<f64>,
    rpm: Option<f64>,
    max_deviation_mm: Option<f64>,
    oscillating_force_n: Option<f64>,
    oscillating_order: u32,
    friction: Option<f64>,
    heat_share: f64,
    convection_w_per_m2_k: f64,
    conductivity_w_per_m_k: f64,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<String> {
    let scene = arguments::scene(scene)?;
    let options = GapOptions {
        force_n,
        rpm,
        max_deviation_mm,
        oscillating: oscillating_force_n.map(|amplitude_n| OscillatingForce {
            amplitude_n,
            order: oscillating_order,
        }),
        friction: friction.map(|coefficient| Friction {
            coefficient,
            heat_share,
            convection_w_per_m2_k,
            conductivity_w_per_m_k,
        }),
    };
    options.checked(&scene).map_err(Failure::from)?;
    compute(py, progress, move |_| {
        json(&GapReport::new(&GuideGaps::new(&scene, &options)?))
    })
}

/// `washboard.json` of a scene, at its operating speed or another one.
#[pyfunction]
#[pyo3(signature = (scene, rpm=None, *, progress=None))]
pub fn washboard(
    py: Python<'_>,
    scene: &str,
    rpm: Option<f64>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<String> {
    let scene = arguments::scene(scene)?;
    compute(py, progress, move |meter| {
        let cut = scene.needed_washboarding()?;
        let run = cut.at_rpm(scene.needed_operating_rpm(rpm)?)?;
        let progress = |done, of| meter.show(done, of);
        let found = Washboard::new(&scene, &run, &progress)?;
        json(&WashboardReport::new(&found))
    })
}

/// `fit.json` of a scene. `measured` is a name and a table as comma-separated values; without it the fit uses the
/// scene's own frequencies.
#[pyfunction]
#[pyo3(signature = (scene, measured, free, *, to_rpm=None, confidence=0.95, starts=12, seed=0,
                    progress=None))]
#[allow(clippy::too_many_arguments, reason = "they are Python's")]
pub fn fit(
    py: Python<'_>,
    scene: &str,
    measured: Option<(String, String)>,
    free: Vec<NamedBounds>,
    to_rpm: Option<f64>,
    confidence: f64,
    starts: usize,
    seed: u64,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<String> {
    let scene = arguments::scene(scene)?;
    let measurement = measurement(&scene, measured)?;
    let options = FitOptions {
        confidence,
        starts,
        seed,
        to_rpm: to_rpm.unwrap_or(f64::INFINITY),
        ..FitOptions::default()
    };
    let options = options.checked(&measurement).map_err(Failure::from)?;
    let freed = Freed::to_fit(&scene, &free).map_err(Failure::from)?;
    compute(py, progress, move |meter| {
        let progress = |done, of| meter.show(done, of);
        let fit = Fit::new(&scene, &measurement, &freed, &options, &progress)?;
        json(&FitReport::new(&fit))
    })
}

fn measurement(scene: &Scene, measured: Option<(String, String)>) -> Result<Measurement, Failure> {
    match measured {
        Some((name, table)) => Ok(Measurement::from_csv(&name, &table)?),
        None => Ok(Measurement::of_scene(scene.needed_measured()?)),
    }
}

/// `place.json` of a scene.
#[pyfunction]
#[pyo3(signature = (scene, free, *, goal="flutter", min_critical_rpm=None, amplitude_mm=None,
                    max_deviation_mm=None, force_n=None, samples=64, refine=60,
                    map=17, radius_tolerance_m=0.002, angle_tolerance_deg=1.0,
                    guide_tolerance_share=0.1, other_tolerance_share=0.01, progress=None))]
#[allow(clippy::too_many_arguments, reason = "they are Python's")]
pub fn place(
    py: Python<'_>,
    scene: &str,
    free: Vec<NamedBounds>,
    goal: &str,
    min_critical_rpm: Option<f64>,
    amplitude_mm: Option<f64>,
    max_deviation_mm: Option<f64>,
    force_n: Option<f64>,
    samples: usize,
    refine: u64,
    map: usize,
    radius_tolerance_m: f64,
    angle_tolerance_deg: f64,
    guide_tolerance_share: f64,
    other_tolerance_share: f64,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<String> {
    let scene = arguments::scene(scene)?;
    let gap = GapDemands::new(&scene, amplitude_mm, max_deviation_mm, force_n);
    let demands = Demands {
        gap: gap.map_err(Failure::from)?,
        ..arguments::demands(&scene, goal, min_critical_rpm)?
    };
    let options = PlaceOptions {
        samples,
        refine: refine.max(1),
        map,
        tolerances: Tolerances {
            radius_m: radius_tolerance_m,
            angle_deg: angle_tolerance_deg,
            guide_share: guide_tolerance_share,
            other_share: other_tolerance_share,
        },
        ..PlaceOptions::default()
    };
    let options = options.checked().map_err(Failure::from)?;
    let freed = Freed::to_place(&scene, &free).map_err(Failure::from)?;
    compute(py, progress, move |meter| {
        let progress = |what, done, of| meter.show_of(what, done, of);
        let found = Placement::new(&scene, &freed, &demands, &options, &progress)?;
        json(&PlaceReport::new(&demands, &found))
    })
}

/// `tradeoff.json` of a scene.
#[pyfunction]
#[pyo3(signature = (scene, *, progress=None))]
pub fn tradeoff(
    py: Python<'_>,
    scene: &str,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<String> {
    let scene = arguments::scene(scene)?;
    compute(py, progress, move |meter| {
        let progress = |done, of| meter.show(done, of);
        json(&sawflutter::stability::tradeoff(&scene, &progress)?)
    })
}
