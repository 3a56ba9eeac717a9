//! Arguments of the methods of a scene, as the table of the library lists them.

use pyo3::conversion::FromPyObjectOwned;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping, PyString};
use sawflutter::analyses::door::{Argument, ArgumentKind};
use sawflutter::model::scene::{NamedBounds, NamedValues, Scene};
use serde_json::{Map, Value, json};

use crate::failure::Failure;
use crate::values::{number, refused};

/// The scene of a JSON text.
pub fn scene(text: &str) -> Result<Scene, Failure> {
    Ok(Scene::from_json(text)?)
}

/// Options of a command by their names.
pub struct Options<'py>(pub Bound<'py, PyDict>);

impl<'py> Options<'py> {
    /// The option of a name; `None` if it is not given.
    fn found(&self, name: &str) -> PyResult<Option<Bound<'py, PyAny>>> {
        Ok(self.0.get_item(name)?.filter(|value| !value.is_none()))
    }

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

    /// A number in the unit of its name; `None` if it is not given.
    pub fn number(&self, name: &str) -> PyResult<Option<f64>> {
        self.found(name)?
            .map(|value| number(name, &value))
            .transpose()
    }

    /// The values of the arguments of a command as JSON, without those that are not given.
    pub fn given(&self, arguments: &[Argument]) -> PyResult<Map<String, Value>> {
        let mut found = Map::new();
        for argument in arguments {
            let name = argument.name.as_str();
            let Some(given) = self.found(name)? else {
                continue;
            };
            let value = match &argument.kind {
                ArgumentKind::Number(_) => {
                    let named = if argument.sets.is_empty() {
                        name
                    } else {
                        argument.sets.as_str()
                    };
                    finite(named, &given)?
                }
                ArgumentKind::Count(_) => self.get::<u64>(name)?.into(),
                ArgumentKind::Flag => self.get::<bool>(name)?.into(),
                ArgumentKind::Word(_) | ArgumentKind::Text => self.get::<String>(name)?.into(),
                ArgumentKind::Speeds => self.get::<Vec<f64>>(name)?.into(),
                ArgumentKind::Bounds => json!(self.bounds(name)?),
                ArgumentKind::Values => json!(self.values(name)?),
                ArgumentKind::Table => json!(self.get::<(String, String)>(name)?),
            };
            found.insert(argument.name.clone(), value);
        }
        Ok(found)
    }

    /// Paths of numbers of the scene, with values.
    fn values(&self, name: &str) -> PyResult<Vec<NamedValues>> {
        let Some(value) = self.found(name)? else {
            return Ok(Vec::new());
        };
        let Ok(by_path) = value.cast::<PyMapping>() else {
            let allowed = "a dict of a path of the scene and its values".to_owned();
            let remedy = "write it like {\"blade.thickness_m\": [\"2 mm\", \"2.2 mm\"]}";
            return refused(name, &value, allowed, remedy);
        };
        each_path(by_path, values_at)
    }

    /// Paths of numbers of the scene, with or without bounds.
    pub fn bounds(&self, name: &str) -> PyResult<Vec<NamedBounds>> {
        let Some(value) = self.found(name)? else {
            return Ok(Vec::new());
        };
        if value.is_instance_of::<PyString>() {
            return Ok(vec![(value.extract()?, None)]);
        }
        let Ok(by_path) = value.cast::<PyMapping>() else {
            let Ok(paths) = value.try_iter() else {
                let allowed = "paths of numbers of the scene".to_owned();
                return refused(
                    name,
                    &value,
                    allowed,
                    "write it like [\"guides[0].radius_m\"]",
                );
            };
            return paths.map(|path| Ok((path?.extract()?, None))).collect();
        };
        each_path(by_path, bounds_at)
    }
}

/// The paths of a mapping, each with what `read` makes of its value.
fn each_path<T>(
    by_path: &Bound<'_, PyMapping>,
    read: impl Fn(&str, &Bound<'_, PyAny>) -> PyResult<T>,
) -> PyResult<Vec<(String, T)>> {
    let items = by_path.items()?.into_iter();
    items
        .map(|item| {
            let (path, value): (String, Bound<'_, PyAny>) = item.extract()?;
            let found = read(&path, &value)?;
            Ok((path, found))
        })
        .collect()
}

/// The numbers of a list, or one number.
fn values_at(path: &str, values: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    if values.is_instance_of::<PyString>() {
        return Ok(vec![number(path, values)?]);
    }
    match values.try_iter() {
        Ok(all) => all.map(|value| number(path, &value?)).collect(),
        Err(_) => Ok(vec![number(path, values)?]),
    }
}

/// A number, which JSON has only if it is finite.
fn finite(name: &str, given: &Bound<'_, PyAny>) -> PyResult<Value> {
    let value = number(name, given)?;
    if value.is_finite() {
        return Ok(value.into());
    }
    refused(
        name,
        given,
        "a finite number".to_owned(),
        "give a number, or None to leave it out",
    )
}

fn bounds_at(path: &str, bounds: &Bound<'_, PyAny>) -> PyResult<Option<(f64, f64)>> {
    if bounds.is_none() {
        return Ok(None);
    }
    let ends: Option<Vec<Bound<'_, PyAny>>> = bounds
        .extract()
        .ok()
        .filter(|_| !bounds.is_instance_of::<PyString>());
    match ends.as_deref() {
        Some([from, to]) => Ok(Some((number(path, from)?, number(path, to)?))),
        _ => {
            let allowed = "two bounds, the lower one first".to_owned();
            refused(path, bounds, allowed, "write it like (0.18, 0.28)")
        }
    }
}
