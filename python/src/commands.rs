//! Every command of the program that computes results of one saw: the scene and the report are JSON.

use std::f64::consts::TAU;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use sawflutter::analyses::campbell::{ModeShape, Sensitivity};
use sawflutter::analyses::commands::Call;
use sawflutter::analyses::compare::{NamedSaw, Saw, compare as compare_saws};
use sawflutter::analyses::door::{Argument, ArgumentKind, CommandError, Step};
use sawflutter::analyses::tradeoff::tradeoff;
use sawflutter::model::scene::{RefusedValue, Scene};
use sawflutter::modes::{SpectralModel, Strategy};
use sawflutter::stability::{Analysis, AnalysisOptions, ExpectedWork};
use serde::Serialize;

use crate::arguments::{self, Options};
use crate::beside::chosen_basis;
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
    if let Some(call) = Call::named(command) {
        let given = options.given(&call.arguments)?;
        let scene = arguments::scene(scene)?;
        return compute(py, progress, move |meter| {
            let show = |step: Step| meter.show_of(step.what, step.done, step.of);
            let ran = call
                .run(scene, given, &show)
                .map_err(|error| with_remedy(call, error))?;
            Ok((json(&ran.json)?, ran.assumed))
        });
    }
    let work = match command {
        "analyze" => analyze(&options)?,
        "modes" => modes(&options)?,
        "tradeoff" => Box::new(|scene: &Scene, meter: &Meter| {
            json(&tradeoff(scene, &|done, of| meter.show(done, of))?)
        }),
        _ => return Err(PyValueError::new_err(format!("no command {command:?}"))),
    };
    let scene = arguments::scene(scene)?;
    let report = compute(py, progress, move |meter| work(&scene, meter))?;
    Ok((report, None))
}

/// The error of a missing block with the arguments beside which typical numbers are assumed for it.
fn with_remedy(call: &Call, error: CommandError) -> CommandError {
    let CommandError::Refused(refused) = error else {
        return error;
    };
    let block = format!("{}.", refused.key);
    let is_number = |of: &&Argument| matches!(of.kind, ArgumentKind::Number(_));
    let of_block = call.arguments.iter().filter(is_number);
    let names: Vec<&str> = of_block
        .filter(|of| of.sets.starts_with(&block))
        .map(|of| of.name.as_str())
        .collect();
    match names.first() {
        Some(first) if refused.is_missing() => {
            let (all, method) = (names.join(", "), call.method);
            let remedy = format!(
                "{}, or give one of {all}, beside which typical numbers are assumed: {method}({first}=...)",
                refused.remedy
            );
            CommandError::Refused(RefusedValue {
                remedy: remedy.into(),
                ..refused
            })
        }
        _ => CommandError::Refused(refused),
    }
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

/// `compare.json` of saws by their names. Each is the text of a scene or of a report.
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
            .map(|(name, text, is_report)| {
                let saw = if is_report {
                    Saw::Report(Box::new(serde_json::from_str(&text)?))
                } else {
                    Saw::Scene(Box::new(arguments::scene(&text)?))
                };
                Ok(NamedSaw { name, saw })
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
    let beside: Option<String> = options.get("beside")?;
    Ok(Box::new(move |scene, meter| {
        let chosen = chosen_basis(scene, beside.as_deref())?;
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
