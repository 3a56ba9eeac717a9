//! Scenes as JSON, and values by their paths.

use pyo3::prelude::*;
use pyo3::types::{PyMapping, PyString};
use sawflutter::model::scene::{Quantity, Scene, SceneError, number_of};
use serde_json::{Map, Value};

use crate::arguments;
use crate::failure::{Failure, Refusal};
use crate::values;

/// The scene of a JSON text, or of a dict of Python, validated, as JSON.
#[pyfunction]
pub fn scene(data: &Bound<'_, PyAny>) -> PyResult<String> {
    let found = match data.cast::<PyString>() {
        Ok(text) => json(&text.to_cow()?)?,
        Err(_) => values::json("", data)?,
    };
    Ok(validated(found)?)
}

/// The scene as JSON.
pub fn written(scene: &Scene) -> Result<String, Failure> {
    Ok(serde_json::to_string(scene.file())?)
}

/// A scene with values at other paths; none removes a key.
#[pyfunction]
pub fn replace(scene: &str, changes: &Bound<'_, PyAny>) -> PyResult<String> {
    let mut data: Value = serde_json::from_str(scene).map_err(Failure::from)?;
    let Ok(changes) = changes.cast::<PyMapping>() else {
        let said = "values by their paths, like {\"blade.thickness_m\": \"2.6 mm\"}";
        return values::refused("changes", changes, said.to_owned(), "give a dict");
    };
    for item in changes.items()? {
        let (path, value): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
        let path = path_of(&path)?;
        let value = values::json(&path, &value)?;
        put(&mut data, &path, value)?;
    }
    Ok(validated(data)?)
}

/// The text of a path.
fn path_of(path: &Bound<'_, PyAny>) -> PyResult<String> {
    match path.extract() {
        Ok(text) => Ok(text),
        Err(_) => Err(no_path(&path.repr()?.to_string(), &path.str()?.to_string()).into()),
    }
}

/// The value at a path of a scene, as JSON.
#[pyfunction]
pub fn value(scene: &str, path: &Bound<'_, PyAny>) -> PyResult<String> {
    let path = &path_of(path)?;
    let mut data: Value = serde_json::from_str(scene).map_err(Failure::from)?;
    let (found, _) = descend(&mut data, &steps(path)?, path, false)?;
    Ok(found.to_string())
}

/// A step of a path.
enum Step {
    Key(String),
    Index(usize),
}

impl Step {
    fn append_to(&self, reached: &mut String) {
        match self {
            Step::Index(at) => *reached += &format!("[{at}]"),
            Step::Key(key) if reached.is_empty() => *reached += key,
            Step::Key(key) => *reached += &format!(".{key}"),
        }
    }
}

/// The steps of a path like `guides[0].radius_m`.
fn steps(path: &str) -> Result<Vec<Step>, Failure> {
    let parsed = || {
        let mut found = Vec::new();
        for part in path.split('.') {
            let (key, indices) = part.split_at(part.find('[').unwrap_or(part.len()));
            if key.is_empty() || key.contains(']') {
                return None;
            }
            found.push(Step::Key(key.to_owned()));
            let mut rest = indices;
            while !rest.is_empty() {
                let (index, after) = rest.strip_prefix('[')?.split_once(']')?;
                let digits = index.bytes().all(|digit| digit.is_ascii_digit());
                found.push(Step::Index(index.parse().ok().filter(|_| digits)?));
                rest = after;
            }
        }
        Some(found)
    };
    parsed().ok_or_else(|| no_path(&format!("{path:?}"), path))
}

fn no_path(shown: &str, path: &str) -> Failure {
    let remedy = "write it like guides[0].radius_m";
    let message = format!("{shown} is no path of a scene; {remedy}");
    refused_path(message, path, "a path of the scene".to_owned(), remedy)
}

fn put(data: &mut Value, path: &str, mut value: Value) -> Result<(), Failure> {
    read_numbers(path, &mut value)?;
    let steps = steps(path)?;
    let Some((last, before)) = steps.split_last() else {
        return Ok(());
    };
    let (place, reached) = descend(data, before, path, true)?;
    let error = missing(place, &reached, path);
    match (place, last) {
        (Value::Object(block), Step::Key(key)) if value.is_null() => {
            block.remove(key);
        }
        (Value::Object(block), Step::Key(key)) => {
            block.insert(key.clone(), value);
        }
        (Value::Array(list), Step::Index(at)) => *list.get_mut(*at).ok_or(error)? = value,
        _ => return Err(error),
    }
    Ok(())
}

/// The value at the end of steps, and the path up to it. Blocks that are missing can be begun.
fn descend<'a>(
    mut place: &'a mut Value,
    steps: &[Step],
    path: &str,
    can_begin: bool,
) -> Result<(&'a mut Value, String), Failure> {
    let mut reached = String::new();
    for step in steps {
        if can_begin && let (Value::Object(block), Step::Key(key)) = (&mut *place, step) {
            block
                .entry(key)
                .or_insert_with(|| Value::Object(Map::new()));
        }
        let error = missing(place, &reached, path);
        let found = match (place, step) {
            (Value::Object(block), Step::Key(key)) => block.get_mut(key),
            (Value::Array(list), Step::Index(at)) => list.get_mut(*at),
            _ => None,
        };
        place = found.ok_or(error)?;
        step.append_to(&mut reached);
    }
    Ok((place, reached))
}

/// The error of a step that a scene does not have; it lists those that it has.
fn missing(place: &Value, reached: &str, path: &str) -> Failure {
    let at = if reached.is_empty() {
        "the scene"
    } else {
        reached
    };
    let (allowed, remedy) = match place {
        Value::Array(_) if reached == "guides" => (counted(place, at), "add_guide adds a guide"),
        Value::Array(_) => (counted(place, at), "replace the list as a whole"),
        Value::Object(block) => {
            let keys: Vec<&str> = block.keys().map(String::as_str).collect();
            (
                format!("{at} has {}", keys.join(", ")),
                "name one of these; replace writes others",
            )
        }
        _ => (
            format!("{at} is a single value"),
            "name it without a further step",
        ),
    };
    let message = format!("the scene has no {path:?}: {allowed}; {remedy}");
    refused_path(message, path, allowed, remedy)
}

fn counted(list: &Value, at: &str) -> String {
    let count = list.as_array().map_or(0, Vec::len);
    let plural = if count == 1 { "entry" } else { "entries" };
    format!("{at} has {count} {plural}, counted from 0")
}

fn refused_path(message: String, path: &str, allowed: String, remedy: &str) -> Failure {
    Failure::Refused(Box::new(Refusal {
        class: "PathError",
        message,
        key: Some(path.to_owned()),
        value: None,
        allowed: Some(allowed),
        remedy: Some(remedy.to_owned()),
    }))
}

fn json(text: &str) -> Result<Value, Failure> {
    // The library says what is wrong with a text that is no JSON.
    serde_json::from_str(text)
        .or_else(|_| Ok(serde_json::to_value(arguments::scene(text)?.file())?))
}

fn validated(mut data: Value) -> Result<String, Failure> {
    read_numbers("", &mut data)?;
    written(&arguments::scene(&data.to_string())?)
}

/// Reads texts with a unit at the paths of numbers.
fn read_numbers(path: &str, value: &mut Value) -> Result<(), Failure> {
    match value {
        Value::String(text) if Quantity::of(path).is_some() => {
            *value = number_of(path, text).map_err(SceneError::Value)?.into();
        }
        Value::Array(list) => {
            for (at, entry) in list.iter_mut().enumerate() {
                read_numbers(&format!("{path}[{at}]"), entry)?;
            }
        }
        Value::Object(block) => {
            for (key, entry) in block.iter_mut() {
                let dot = if path.is_empty() { "" } else { "." };
                read_numbers(&format!("{path}{dot}{key}"), entry)?;
            }
        }
        _ => (),
    }
    Ok(())
}

/// Numbers of a scene that are implausible, each as a sentence.
#[pyfunction]
pub fn unusual_numbers(scene: &str) -> PyResult<Vec<String>> {
    Ok(arguments::scene(scene)?.file().unusual_numbers())
}
