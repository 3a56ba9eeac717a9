//! The program's own figures, summary and colours, made from a report's JSON.

use pyo3::prelude::*;
use pyo3::types::PyBytes;
use sawflutter::analyses::campbell::Report;
use sawflutter::analyses::commands::{Command, CommandReport};
use sawflutter::analyses::tradeoff::{self, Setting};
use sawflutter::page::figure;

use crate::failure::Failure;

/// The command of a name.
fn named(command: &str) -> Result<&'static Command, Failure> {
    Command::named(command).ok_or_else(|| Failure::Failed(format!("no command {command:?}")))
}

/// Reads a report of the command of this name.
pub fn read(command: &str, report: &str) -> Result<Box<dyn CommandReport>, Failure> {
    Ok(named(command)?.read(report)?)
}

/// File names of the figures that reports of the command of this name may have, SVG before PNG.
#[pyfunction]
pub fn figure_names(command: &str) -> PyResult<Vec<&'static str>> {
    let figures = named(command)?.figures.iter();
    Ok(figures.flat_map(|[png, svg]| [*svg, *png]).collect())
}

/// A figure of a report by the name of its file; `None` if the saw has no data for it.
#[pyfunction]
pub fn picture(
    py: Python<'_>,
    command: &str,
    name: &str,
    report: &str,
) -> PyResult<Option<Py<PyBytes>>> {
    let bytes = py.detach(|| drawn(&*read(command, report)?, name))?;
    Ok(bytes.map(|bytes| PyBytes::new(py, &bytes).unbind()))
}

fn drawn(report: &dyn CommandReport, name: &str) -> Result<Option<Vec<u8>>, Failure> {
    let mut names = report.command().figures.iter().flatten();
    if !names.any(|own| *own == name) {
        return Err(Failure::argument(
            "name",
            format!("{name:?}"),
            "the name of a figure that the program writes for this report".to_owned(),
            "the method figure_names lists them",
        ));
    }
    let mut figures = report.figures().into_iter();
    Ok(figures.find_map(|figure| figure.file(name)).transpose()?)
}

/// The text that the program prints for a report of the command of this name, with its details if asked for.
#[pyfunction]
pub fn summary(command: &str, report: &str, details: bool) -> PyResult<String> {
    Ok(read(command, report)?.text(details))
}

/// The answer of a report of the command of this name in one line.
#[pyfunction]
pub fn answer(command: &str, report: &str) -> PyResult<String> {
    Ok(read(command, report)?.answer())
}

/// The text of a report of the command of this name as HTML.
#[pyfunction]
pub fn html(command: &str, report: &str) -> PyResult<String> {
    Ok(read(command, report)?.html())
}

/// The page of a report of the command of this name; `None` if reports of this kind have none.
#[pyfunction]
pub fn page(command: &str, report: &str) -> PyResult<Option<String>> {
    if command == "study" {
        return Ok(None);
    }
    let page = read(command, report)?.page().map_err(Failure::from)?;
    Ok(Some(page))
}

/// The description of a figure of this name, as JSON; `None` if the report has no data for it.
#[pyfunction]
pub fn chart(command: &str, name: &str, report: &str) -> PyResult<Option<String>> {
    let chart = read(command, report)?.chart(name);
    let text = chart.map(|chart| serde_json::to_string(&chart));
    Ok(text.transpose().map_err(Failure::from)?)
}

/// The description of the figure of a tradeoff, as JSON; `scene` is the name of the scene.
#[pyfunction]
pub fn tradeoff_chart(scene: &str, settings: &str) -> PyResult<String> {
    let settings: Vec<Setting> = serde_json::from_str(settings).map_err(Failure::from)?;
    let chart = tradeoff::chart::chart(scene, &settings);
    Ok(serde_json::to_string(&chart).map_err(Failure::from)?)
}

/// `campbell.csv` of a report.
#[pyfunction]
pub fn campbell_csv(report: &str) -> PyResult<String> {
    let report: Report = serde_json::from_str(report).map_err(Failure::from)?;
    let table = report
        .campbell_csv()
        .map_err(|error| Failure::Failed(error.to_string()))?;
    Ok(String::from_utf8_lossy(&table).into_owned())
}

/// The VTK files of a report with shapes: names and texts.
#[pyfunction]
pub fn vtk_files(report: &str) -> PyResult<Vec<(String, String)>> {
    let report: Report = serde_json::from_str(report).map_err(Failure::from)?;
    let files = report.vtk_files().into_iter();
    Ok(files
        .map(|file| (file.name.to_owned(), file.text))
        .collect())
}

/// The colours of the figures, red, green and blue for each subject, as JSON.
#[pyfunction]
pub fn palette() -> PyResult<String> {
    Ok(serde_json::to_string(&figure::PALETTE).map_err(Failure::from)?)
}
