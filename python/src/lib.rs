//! `sawflutter._native`: arguments are scenes as JSON and plain numbers; results are reports as JSON and matrices as
//! bytes of doubles. The package around it makes the Python objects.

mod arguments;
mod commands;
mod failure;
mod figures;
mod map;
mod matrices;
mod study;
mod watch;

use pyo3::prelude::*;
use sawflutter::model::scene::{MAX_SCENE_BYTES, Quantity, Scene, SceneError, number_of};
use sawflutter::page::text::{Kind, OtherEncodings, read_path};

use crate::failure::Failure;

#[pymodule]
mod _native {
    #[pymodule_export]
    use super::commands::{compare, run};
    #[pymodule_export]
    use super::figures::{
        campbell_csv, chart, figure_names, html, page, palette, picture, summary, tradeoff_chart,
        vtk_files,
    };
    #[pymodule_export]
    use super::map::Map;
    #[pymodule_export]
    use super::matrices::{functions_at, matrices};
    #[pymodule_export]
    use super::study::{Study, StudyLog, processor};
    #[pymodule_export]
    use super::{number, outlines, panic, paper, program, read_scene, read_text, scene, schema};
}

/// The scene of a JSON text, validated, as JSON.
#[pyfunction]
fn scene(text: &str) -> PyResult<String> {
    written(&arguments::scene(text)?)
}

fn written(scene: &Scene) -> PyResult<String> {
    Ok(serde_json::to_string(scene.file()).map_err(Failure::from)?)
}

/// Corners of the guides of a scene in metres, each as x and y.
#[pyfunction]
fn outlines(text: &str) -> PyResult<Vec<Vec<[f64; 2]>>> {
    let scene = arguments::scene(text)?;
    let guides = scene.file().guides.iter();
    Ok(guides.map(|guide| guide.outline_m()).collect())
}

/// The number of a text like `2.6mm` in the unit of a path of a scene; none if the path is not that of a number.
#[pyfunction]
fn number(path: &str, text: &str) -> PyResult<Option<f64>> {
    if Quantity::of(path).is_none() {
        return Ok(None);
    }
    let found = number_of(path, text).map_err(SceneError::Value);
    Ok(Some(found.map_err(Failure::from)?))
}

/// The scene that comes with the program.
#[pyfunction]
fn paper() -> PyResult<String> {
    written(&Scene::paper())
}

/// The scene of a file, validated, as JSON.
#[pyfunction]
fn read_scene(path: std::path::PathBuf) -> PyResult<String> {
    written(&Scene::from_path(&path).map_err(Failure::from)?)
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
