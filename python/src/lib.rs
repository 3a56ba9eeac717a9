//! `sawflutter._native`: arguments are scenes as JSON and plain numbers; results are reports as JSON and matrices as
//! bytes of doubles. The package around it makes the Python objects.

mod arguments;
mod beside;
mod charts;
mod commands;
mod failure;
mod figures;
mod map;
mod matrices;
mod scenes;
mod study;
mod values;
mod watch;

use pyo3::prelude::*;
use pyo3::types::PyBytes;
use sawflutter::analyses::door::CommandError;
use sawflutter::analyses::fit::{FitError, number_columns};
use sawflutter::model::scene::{MAX_SCENE_BYTES, Scene};
use sawflutter::page::text::{Kind, OtherEncodings, read_path};

use crate::failure::Failure;

/// Largest table of an instrument: an hour of two channels at 1 kHz.
const MAX_TABLE_BYTES: u64 = 1 << 28;

#[pymodule]
mod _native {
    #[pymodule_export]
    use super::charts::{grid_chart, saw_chart, spectrum_chart, stiffness_chart, waterfall_chart};
    #[pymodule_export]
    use super::commands::{compare, run};
    #[pymodule_export]
    use super::figures::{
        answer, campbell_csv, chart, figure_names, html, page, palette, picture, summary,
        tradeoff_chart, vtk_files,
    };
    #[pymodule_export]
    use super::map::Map;
    #[pymodule_export]
    use super::matrices::{functions_at, matrices};
    #[pymodule_export]
    use super::scenes::{replace, scene, unusual_numbers, value};
    #[pymodule_export]
    use super::study::{Study, StudyLog, processor, speeds};
    #[pymodule_export]
    use super::values::{magnitude, number, plain};
    #[pymodule_export]
    use super::{
        calls, columns, keys, panic, paper, peaks, program, read_scene, read_text, schema,
    };
}

/// The scene that comes with the program.
#[pyfunction]
fn paper() -> PyResult<String> {
    Ok(scenes::written(&Scene::paper())?)
}

/// The scene of a file, validated, as JSON.
#[pyfunction]
fn read_scene(path: std::path::PathBuf) -> PyResult<String> {
    let scene = Scene::from_path(&path).map_err(Failure::from)?;
    Ok(scenes::written(&scene)?)
}

/// The text of the file of a study, or of a table of frequencies, whatever its encoding.
#[pyfunction]
fn read_text(path: std::path::PathBuf, table: bool) -> PyResult<String> {
    let (class, other_encodings) = if table {
        ("ArgumentError", OtherEncodings::AsLatin1)
    } else {
        ("StudyError", OtherEncodings::Refused)
    };
    let kind = Kind {
        limit: MAX_SCENE_BYTES,
        other_encodings,
    };
    Ok(read_path(&path, kind).map_err(|error| failure::file(class, error))?)
}

/// Columns of the table of an instrument: names, units, and numbers as little-endian doubles. A text is that of a file of
/// another format.
#[pyfunction]
#[pyo3(signature = (path, text = None))]
fn columns<'py>(
    py: Python<'py>,
    path: std::path::PathBuf,
    text: Option<String>,
) -> PyResult<Vec<(String, String, Bound<'py, PyBytes>)>> {
    let text = text.map_or_else(|| table(&path), Ok)?;
    let found = number_columns(&text).map_err(|error| in_file(&path, error))?;
    let bytes = |numbers: &[f64]| {
        numbers
            .iter()
            .flat_map(|x| x.to_le_bytes())
            .collect::<Vec<u8>>()
    };
    let found = found.into_iter();
    Ok(found
        .map(|of| (of.name, of.unit, PyBytes::new(py, &bytes(&of.numbers))))
        .collect())
}

/// Speed and frequency of each peak of a table.
#[pyfunction]
fn peaks(path: std::path::PathBuf) -> PyResult<Vec<(f64, f64)>> {
    let found = sawflutter::analyses::fit::peaks(&table(&path)?);
    Ok(found.map_err(|error| in_file(&path, error))?)
}

/// The text of the table of an instrument, whatever its encoding.
fn table(path: &std::path::Path) -> PyResult<String> {
    let kind = Kind {
        limit: MAX_TABLE_BYTES,
        other_encodings: OtherEncodings::AsLatin1,
    };
    Ok(read_path(path, kind).map_err(|error| failure::file("InputError", error))?)
}

/// The error of a line of a file.
fn in_file(path: &std::path::Path, error: FitError) -> Failure {
    match error {
        FitError::Table { line, problem } => {
            let said = format!("line {line} of {}: {problem}", path.display());
            failure::Refusal::saying("InputError", said, None)
        }
        other => CommandError::from(other).into(),
    }
}

/// JSON schemas of scenes, studies and reports, as one JSON object.
#[pyfunction]
fn schema() -> String {
    serde_json::json!({
        "scene": sawflutter::model::scene::json_schema(),
        "study": sawflutter::analyses::study::json_schema(),
        "reports": sawflutter::analyses::commands::json_schema(),
    })
    .to_string()
}

/// Arguments of each command beside its scene, as JSON.
#[pyfunction]
fn calls() -> String {
    serde_json::json!(sawflutter::analyses::commands::Call::all()).to_string()
}

/// The keys of a scene, or of a study, with these words in their path or their text.
#[pyfunction]
fn keys(words: &str, of_study: bool) -> String {
    sawflutter::app::cli::keys(words, of_study)
}

/// Runs the program with arguments, the first of which is its name, and gives its exit code.
#[pyfunction]
fn program(py: Python<'_>, arguments: Vec<std::ffi::OsString>) -> u8 {
    py.detach(|| sawflutter::app::cli::run(arguments))
}

/// Panics, for the test that a panic becomes an exception.
#[pyfunction]
fn panic(py: Python<'_>) -> PyResult<()> {
    watch::compute(py, None, |_| panic!("asked for by a test"))
}
