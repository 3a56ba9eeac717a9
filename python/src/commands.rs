//! Every command of the program that computes results of one saw: the scene and the report are JSON.

use std::f64::consts::TAU;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use sawflutter::analyses::campbell::{ModeShape, Sensitivity};
use sawflutter::analyses::check::{self, Limits, LimitsFile};
use sawflutter::analyses::commands::Call;
use sawflutter::analyses::compare::{LabelledSaw, Saw, compare as compare_saws};
use sawflutter::analyses::fit::{self, Measurement, Options as FitOptions};
use sawflutter::analyses::gap::{self, Options as GapOptions};
use sawflutter::analyses::place::{self, Demands, GapDemands, Options as PlaceOptions, Tolerances};
use sawflutter::analyses::tradeoff::tradeoff;
use sawflutter::analyses::{cut, deflect, report, response, runup, washboard};
use sawflutter::model::scene::{Freed, Scene};
use sawflutter::modes::{SpectralModel, Strategy};
use sawflutter::stability::{Analysis, AnalysisOptions, ChosenBasis, ExpectedWork};
use serde::Serialize;

use crate::arguments::{self, Options};
use crate::failure::Failure;
use crate::watch::{Meter, compute};

/// A command with its options; the result is its report.
type Work = Box<dyn FnOnce(&Scene, &Meter) -> Result<String, Failure> + Send>;

/// Runs a command of the program on a scene and gives the report, and a sentence with the numbers that were assumed, if any
/// were. The options are those of the method of Python, all of them, by their names.
#[pyfunction]
#[pyo3(signature = (command, scene, options, progress=None))]
pub fn run(
    py: Python<'_>,
    command: &str,
    scene: &str,
    options: Bound<'_, PyDict>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<(String, Option<String>)> {
    let options = Options(options);
    let work = match command {
        "analyze" => analyze(&options)?,
        "check" => check(&options)?,
        "cut" => cut(&options)?,
        "deflect" => deflect(&options)?,
        "fit" => fit(&options)?,
        "gap" => gap(&options)?,
        "modes" => modes(&options)?,
        "place" => place(&options)?,
        "report" => report(&options)?,
        "response" => response(&options)?,
        "runup" => Box::new(runup),
        "tradeoff" => Box::new(|scene: &Scene, meter: &Meter| {
            json(&tradeoff(scene, &|done, of| meter.show(done, of))?)
        }),
        "washboard" => washboard(&options)?,
        _ => return Err(PyValueError::new_err(format!("no command {command:?}"))),
    };
    let scene = arguments::scene(scene)?;
    let (scene, assumed) = match Call::named(command) {
        Some(call) => options.applied(call, scene)?,
        None => (scene, None),
    };
    let report = compute(py, progress, move |meter| work(&scene, meter))?;
    Ok((report, assumed))
}

/// JSON as the program writes it to its files.
pub fn json(report: &impl Serialize) -> Result<String, Failure> {
    Ok(serde_json::to_string_pretty(report)?)
}

/// `report.json`.
fn analyze(options: &Options<'_>) -> PyResult<Work> {
    let sensitivity: bool = options.get("sensitivity")?;
    let amplitude: bool = options.get("amplitude")?;
    let shapes_at_rpm: Option<Vec<f64>> = options.get("shapes_at_rpm")?;
    Ok(Box::new(move |scene, meter| {
        let say_if_long = |expected: ExpectedWork| {
            if expected.is_long() {
                meter.remark(expected.to_string());
            }
        };
        let options = AnalysisOptions {
            expected: Some(&say_if_long),
            ..AnalysisOptions::default()
        };
        let analysis = Analysis::with_options(scene, options)?;
        let mut report = analysis.report();
        if amplitude {
            report.add_amplitudes(&analysis)?;
        }
        if let Some(asked_rpm) = shapes_at_rpm {
            let range = analysis.range_rad_per_s;
            let asked = asked_rpm
                .iter()
                .map(|rpm| range.speed_at("shapes", *rpm))
                .collect::<Result<Vec<_>, _>>()?;
            report.add_shapes(&analysis, &asked)?;
        }
        if sensitivity {
            report.sensitivities = Sensitivity::all(&analysis)?;
        }
        json(&report)
    }))
}

/// `compare.json` of saws by their labels. Each is the text of a scene or of a report.
#[pyfunction]
#[pyo3(signature = (saws, progress=None))]
pub fn compare(
    py: Python<'_>,
    saws: Vec<(String, String, bool)>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<String> {
    compute(py, progress, move |meter| {
        let saws = saws
            .into_iter()
            .map(|(label, text, is_report)| {
                let saw = if is_report {
                    Saw::Report(Box::new(serde_json::from_str(&text)?))
                } else {
                    Saw::Scene(Box::new(arguments::scene(&text)?))
                };
                Ok(LabelledSaw { label, saw })
            })
            .collect::<Result<_, Failure>>()?;
        let progress = |done, of| meter.show_of("saws", done, of);
        json(&compare_saws(saws, &progress)?)
    })
}

/// Modes at speeds of the sweep, ascending by frequency at each, from one basis: at most `n_modes`, up to `to_hz`; and the
/// frequency up to which they are complete.
fn modes(options: &Options<'_>) -> PyResult<Work> {
    let at_rpm: Vec<f64> = options.get("at_rpm")?;
    let to_hz: Option<f64> = options.number("to_hz")?;
    let n_modes: Option<usize> = options.get("n_modes")?;
    Ok(Box::new(move |scene, meter| {
        let chosen = ChosenBasis::new(scene, scene.tolerance())?;
        let range = chosen.range_rad_per_s;
        let speeds = at_rpm
            .iter()
            .map(|rpm| range.speed_at("rpm", *rpm))
            .collect::<Result<Vec<_>, _>>()?;
        let model =
            SpectralModel::with_critical(chosen.saw, chosen.critical, range, Strategy::Reduced)?;
        let complete_to_hz = model.complete_to_rad_per_s / TAU;
        let last_hz = to_hz.unwrap_or(complete_to_hz);
        if !(last_hz > 0.0 && last_hz <= complete_to_hz) {
            let allowed =
                format!("above 0 and at most {complete_to_hz}, up to which the modes are complete");
            let remedy =
                "ask for a smaller tolerance, or take matrices(basis=...) for higher modes";
            return Err(Failure::argument("to_hz", last_hz, allowed, remedy));
        }
        let mut entries = Vec::new();
        for (done, (speed, rpm)) in speeds.iter().zip(&at_rpm).enumerate() {
            meter.show(done, speeds.len());
            let found = model.describe(*speed, model.modes(*speed)?);
            let shapes = found.iter().map(|mode| ModeShape {
                // The speed as given, without the rounding of two conversions.
                rpm: *rpm,
                ..ModeShape::new(&model.plate, *speed, mode)
            });
            let below = shapes.filter(|mode| mode.frequency_hz <= last_hz);
            entries.push(
                below
                    .take(n_modes.unwrap_or(usize::MAX))
                    .collect::<Vec<_>>(),
            );
        }
        json(&serde_json::json!({ "complete_to_hz": complete_to_hz, "modes": entries }))
    }))
}

/// `check.json`.
fn check(options: &Options<'_>) -> PyResult<Work> {
    let asked = LimitsFile {
        operating_rpm: options.number("operating_rpm")?,
        margin: options.given("margin")?,
        min_flutter_rpm: options.number("min_flutter_rpm")?,
        min_critical_rpm: options.number("min_critical_rpm")?,
    };
    let max_rim_m_per_s = options.given("max_rim_m_per_s")?;
    let max_amplitude_mm = options.millimetres("max_amplitude_m")?;
    let accept_unusual = options.get("accept_unusual")?;
    Ok(Box::new(move |scene, _| {
        let limits = Limits {
            accept_unusual,
            ..asked
                .limits(scene)?
                .with_rim_speed(max_rim_m_per_s)?
                .with_amplitude(max_amplitude_mm)?
        };
        json(&check::check(scene, &limits)?)
    }))
}

/// `cut.json`, at the speeds given or, without any, at those of the scene.
fn cut(options: &Options<'_>) -> PyResult<Work> {
    let rpm: Vec<f64> = options.get("rpm")?;
    Ok(Box::new(move |scene, meter| {
        let runs = scene.needed_cut()?.runs_at(&rpm)?;
        let progress = |done, of| meter.show(done, of);
        json(&cut::cut(scene, &runs, &progress)?)
    }))
}

/// `runup.json`.
fn runup(scene: &Scene, meter: &Meter) -> Result<String, Failure> {
    scene.needed_runup()?;
    json(&runup::runup(scene, &|done, of| meter.show(done, of))?)
}

/// `deflect.json`, up to a speed.
fn deflect(options: &Options<'_>) -> PyResult<Work> {
    let options = deflect::Options {
        to_rpm: options.number("to_rpm")?,
    };
    Ok(Box::new(move |scene, _| {
        options.checked()?;
        json(&deflect::deflect(scene, &options)?)
    }))
}

/// `design.json`.
fn report(options: &Options<'_>) -> PyResult<Work> {
    let options = report::Options {
        customer: options.get("customer")?,
        date: options.get("date")?,
    };
    Ok(Box::new(move |scene, _| {
        json(&report::report(scene, &options)?)
    }))
}

/// `response.json`, with the frequency response at a speed.
fn response(options: &Options<'_>) -> PyResult<Work> {
    let options = response::Options {
        rpm: options.number("rpm")?,
        to_hz: options.number("to_hz")?,
    };
    Ok(Box::new(move |scene, _| {
        options.checked()?;
        json(&response::response(scene, &options)?)
    }))
}

/// `gap.json`, at a speed.
fn gap(options: &Options<'_>) -> PyResult<Work> {
    let gap_m = options.number("gap_m")?;
    let options = GapOptions {
        rpm: options.number("rpm")?,
        max_deviation_mm: options.millimetres("max_deviation_m")?,
    };
    Ok(Box::new(move |scene, _| {
        let tried = gap_m.map(|gap_m| scene.with_gap(gap_m)).transpose()?;
        let scene = tried.as_ref().map_or(scene, |tried| &tried.scene);
        options.checked(scene)?;
        json(&gap::gap(scene, &options)?)
    }))
}

/// `washboard.json` at the operating speed or another one.
fn washboard(options: &Options<'_>) -> PyResult<Work> {
    let rpm = options.number("rpm")?;
    Ok(Box::new(move |scene, meter| {
        let cut = scene.needed_washboarding()?;
        let run = cut.at_rpm(scene.needed_operating_rpm(rpm)?)?;
        json(&washboard::washboard(scene, &run, &|done, of| {
            meter.show(done, of)
        })?)
    }))
}

/// `fit.json`. `measured` is a name and a table as comma-separated values; without it the fit uses the scene's own
/// frequencies.
fn fit(options: &Options<'_>) -> PyResult<Work> {
    let measured: Option<(String, String)> = options.get("measured")?;
    let free = options.bounds("free")?;
    let to_rpm: Option<f64> = options.number("to_rpm")?;
    let options = FitOptions {
        confidence: options.given("confidence")?,
        starts: options.get("starts")?,
        to_rpm: to_rpm.unwrap_or(f64::INFINITY),
        ..FitOptions::default()
    };
    Ok(Box::new(move |scene, meter| {
        let measurement = match measured {
            Some((name, table)) => Measurement::from_csv(&name, &table)?,
            None => Measurement::of_scene(scene.needed_measured()?),
        };
        let options = options.checked(&measurement)?;
        let freed = Freed::to_fit(scene, &free)?;
        let progress = |done, of| meter.show(done, of);
        json(&fit::fit(scene, &measurement, &freed, &options, &progress)?)
    }))
}

/// `place.json`.
fn place(options: &Options<'_>) -> PyResult<Work> {
    let free = options.bounds("free")?;
    let goal: String = options.get("goal")?;
    let min_critical_rpm = options.number("min_critical_rpm")?;
    let amplitude_mm = options.millimetres("amplitude_m")?;
    let max_deviation_mm = options.millimetres("max_deviation_m")?;
    let refine: u64 = options.get("refine")?;
    let options = PlaceOptions {
        samples: options.get("samples")?,
        refine: refine.max(1),
        map: options.get("map")?,
        tolerances: Tolerances {
            radius_m: options.given("radius_tolerance_m")?,
            angle_deg: options.given("angle_tolerance_deg")?,
            guide_share: options.given("guide_tolerance_share")?,
            other_share: options.given("other_tolerance_share")?,
        },
        ..PlaceOptions::default()
    };
    Ok(Box::new(move |scene, meter| {
        let around_rpm = match goal.as_str() {
            "flutter" => None,
            "window" => Some(scene.needed_operating_rpm(None)?),
            _ => {
                let allowed = "\"flutter\" or \"window\"".to_owned();
                let value = format!("{goal:?}");
                return Err(Failure::argument(
                    "goal",
                    value,
                    allowed,
                    "name one of them",
                ));
            }
        };
        let demands = Demands {
            gap: GapDemands::new(scene, amplitude_mm, max_deviation_mm)?,
            ..Demands::new(around_rpm, min_critical_rpm)?
        };
        let options = options.checked()?;
        let freed = Freed::to_place(scene, &free)?;
        let progress = |step: place::Step| meter.show_of(step.what, step.done, step.of);
        json(&place::place(scene, &freed, &demands, &options, &progress)?)
    }))
}
