//! Arguments of Python's methods.

use pyo3::conversion::FromPyObjectOwned;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use sawflutter::model::scene::Scene;

use crate::failure::Failure;

/// The scene of a JSON text.
pub fn scene(text: &str) -> Result<Scene, Failure> {
    Ok(Scene::from_json(text)?)
}

/// Options of a command by their names.
pub struct Options<'py>(pub Bound<'py, PyDict>);

impl<'py> Options<'py> {
    /// The option of a name. Its error names the option in a note, as PyO3 does for arguments of functions.
    pub fn get<T: FromPyObjectOwned<'py>>(&self, name: &str) -> PyResult<T> {
        let item = self.0.as_any().get_item(name)?;
        let found: PyResult<T> = item.extract().map_err(Into::into);
        found.inspect_err(|error| {
            let (py, note) = (self.0.py(), format!("while processing '{name}'"));
            // Python 3.10 has no notes.
            let _ = error.value(py).call_method1("add_note", (note,));
        })
    }
}
