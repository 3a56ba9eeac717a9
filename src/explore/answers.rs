//! Main numbers of the results of tasks, which the page shows in the units of the form.

use serde::Serialize;

use crate::analyses::cut::CutReport;
use crate::analyses::fit::FitReport;
use crate::analyses::gap::{AtAmplitude, GapReport};
use crate::analyses::place::PlaceReport;
use crate::analyses::response::ResponseReport;
use crate::analyses::runup::RunUpReport;
use crate::analyses::washboard::WashboardReport;
use crate::figure::number_name;
use crate::scene::Quantity;

/// A main number of the result of a task.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TaskAnswer {
    /// Name of the quantity.
    name: String,
    /// Path of a number of scenes that has the unit of this one.
    unit_of: &'static str,
    /// Value in the unit of this path; null if there is none.
    value: Option<f64>,
    /// The value before a search; null elsewhere.
    before: Option<f64>,
}

const LENGTH: &str = "blade.thickness_m";
const SPEED: &str = "operating_rpm";
const STIFFNESS: &str = "cut.washboarding.stiffness_n_per_m";
const FREQUENCY: &str = "measured.rows[].frequencies_hz[]";

fn answer(name: impl Into<String>, unit_of: &'static str, value: Option<f64>) -> TaskAnswer {
    TaskAnswer {
        name: name.into(),
        unit_of,
        value,
        before: None,
    }
}

/// Largest deflections at each speed of a cut, in it and after it.
pub fn of_cut(report: &CutReport) -> Vec<TaskAnswer> {
    let runs = report.runs.iter().flat_map(|run| {
        let at = |what| format!("Deflection {what} the cut at {:.0} rpm", run.rpm);
        [
            answer(at("in"), LENGTH, run.largest_deflection_in_cut_m),
            answer(at("after"), LENGTH, run.largest_deflection_after_m),
        ]
    });
    runs.collect()
}

/// Largest deflection of a run-up and its speed, and the onset of the first band that more than doubles a motion.
pub fn of_runup(report: &RunUpReport) -> Vec<TaskAnswer> {
    let deflections = report.rpm.iter().zip(&report.deflection_m);
    let largest = deflections.max_by(|x, y| x.1.abs().total_cmp(&y.1.abs()));
    vec![
        answer("Largest deflection", LENGTH, largest.map(|(_, w)| w.abs())),
        answer("at", SPEED, largest.map(|(rpm, _)| *rpm)),
        answer("Doubles first at", SPEED, report.first_doubling_rpm),
    ]
}

/// The smallest cutting stiffness at which a motion grows, and the frequency of this motion.
pub fn of_washboard(report: &WashboardReport) -> Vec<TaskAnswer> {
    let stiffness = report.critical_stiffness_n_per_m;
    vec![
        answer("A motion grows from a stiffness of", STIFFNESS, stiffness),
        answer("at", FREQUENCY, report.critical_frequency_hz),
    ]
}

/// Largest amplitude of each cause at the probe, and the deviation of the board at the operating speed.
pub fn of_response(report: &ResponseReport) -> Vec<TaskAnswer> {
    let largest = report.lines.iter().map(|line| {
        let known = line.amplitude_m.iter().flatten().copied();
        let name = format!("Largest at the probe, {}", line.name);
        answer(name, LENGTH, known.reduce(f64::max))
    });
    let board = report.operating.as_ref().map(|operating| {
        let name = format!("Deviation of the board at {:.0} rpm", operating.rpm);
        answer(name, LENGTH, operating.board_deviation_m)
    });
    largest.chain(board).collect()
}

/// Amplitude at which the first critical speed is half way between those without and with contact, and these two
/// speeds.
pub fn of_gap(report: &GapReport) -> Vec<TaskAnswer> {
    let critical = |at: &AtAmplitude| at.critical_rpm.first().copied();
    vec![
        answer(
            "Guides act half from an amplitude of",
            LENGTH,
            report.half_way_amplitude_m,
        ),
        answer(
            "First critical speed inside the gaps",
            SPEED,
            critical(&report.free),
        ),
        answer(
            "First critical speed at large amplitudes",
            SPEED,
            critical(&report.linear),
        ),
    ]
}

/// Fitted numbers, and the remaining deviation from the measured frequencies.
pub fn of_fit(report: &FitReport) -> Vec<TaskAnswer> {
    let found = report.parameters.iter();
    let found = found.filter_map(|found| number(&found.path, found.start, found.value));
    let rms = TaskAnswer {
        before: Some(report.rms_before_hz),
        ..answer("Deviation (rms)", FREQUENCY, Some(report.rms_hz))
    };
    found.chain([rms]).collect()
}

/// Placed numbers, and the flutter speed and first critical speed of the saw.
pub fn of_place(report: &PlaceReport) -> Vec<TaskAnswer> {
    let found = report.parameters.iter();
    let found = found.filter_map(|found| number(&found.path, found.start, found.value));
    let speeds = [
        (
            "Flutter speed",
            report.before.flutter_rpm,
            report.best.flutter_rpm,
        ),
        (
            "First critical speed",
            report.before.critical_rpm,
            report.best.critical_rpm,
        ),
    ];
    let speeds = speeds.map(|(name, before, value)| TaskAnswer {
        before,
        ..answer(name, SPEED, value)
    });
    found.chain(speeds).collect()
}

/// A number of the scene before and after a search; `None` if the path is not that of a number.
fn number(path: &str, before: f64, value: f64) -> Option<TaskAnswer> {
    let quantity = Quantity::of(path)?;
    Some(TaskAnswer {
        before: Some(before),
        ..answer(number_name(path), quantity.path, Some(value))
    })
}
