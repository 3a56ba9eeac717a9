//! Maps: the grid of saws that is computed as a study, and the report of their rows.

use std::path::PathBuf;

use pyo3::prelude::*;
use sawflutter::analyses::map::{self, Options, Range};
use sawflutter::analyses::study::{Rows, StudyError};

use crate::arguments;
use crate::commands::json;
use crate::failure::Failure;
use crate::watch::compute;

/// A path of the scene and the ends of its axis.
type Along = (String, f64, f64);

/// A map of a scene.
#[pyclass(frozen, module = "sawflutter._native")]
pub struct Map(map::Map);

#[pymethods]
impl Map {
    #[new]
    #[pyo3(signature = (scene, x, y=None, *, points=None, rpm=None, to_rpm=None))]
    fn new(
        py: Python<'_>,
        scene: &str,
        x: Along,
        y: Option<Along>,
        points: Option<usize>,
        rpm: Option<f64>,
        to_rpm: Option<f64>,
    ) -> PyResult<Self> {
        let scene = arguments::scene(scene)?;
        let range = |(path, from, to)| Range { path, from, to };
        let options = Options {
            x: range(x),
            y: y.map(range),
            points,
            rpm,
            to_rpm,
        };
        // Without an end of the sweep, the saw of the scene itself is analysed for one.
        let map = compute(py, None, move |_| {
            map::Map::new(scene, &options).map_err(|error| match error {
                // The error of the scene names the path, by which Python names an axis, too.
                StudyError::Scene { source, .. } => source.into(),
                other => other.into(),
            })
        })?;
        Ok(Map(map))
    }

    /// The study of its saws, as JSON.
    #[getter]
    fn study(&self) -> PyResult<String> {
        let file = self.0.study().file();
        Ok(serde_json::to_string(file).map_err(Failure::from)?)
    }

    /// `map.json` of the saws in the logs of a folder.
    fn report(&self, py: Python<'_>, folder: PathBuf) -> PyResult<String> {
        let report = || {
            let rows = Rows::in_folder(self.0.study(), &folder)?;
            json(&self.0.report_of_rows(&rows)?)
        };
        Ok(py.detach(report)?)
    }
}
