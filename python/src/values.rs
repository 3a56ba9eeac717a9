//! Values of Python: numbers, plain or of NumPy, texts with a unit, quantities of pint, and JSON of them.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyInt, PyList, PyMapping, PyString, PyTuple};
use sawflutter::model::scene::{Quantity, RefusedValue, SceneError, number_in, number_of};
use serde_json::{Map, Value};

use crate::failure::Failure;

/// The number of a value, in the unit of a path of a scene or of an argument.
#[pyfunction]
pub fn number(name: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(read(name, &text.to_cow()?)?);
    }
    let plain = if value.hasattr("m_as")? {
        magnitude(name, value)?
    } else {
        value.clone()
    };
    let unit = Quantity::unit_of(name);
    plain.extract().or_else(|_| {
        let allowed = match unit {
            "" => "a number".to_owned(),
            unit => format!("a number in {unit}, or a text with a unit"),
        };
        refused(name, value, allowed, "give one number, like 3")
    })
}

/// The error of an argument, with the value as Python writes it.
pub fn refused<T>(
    name: &str,
    value: &Bound<'_, PyAny>,
    allowed: String,
    remedy: &'static str,
) -> PyResult<T> {
    Err(Failure::argument(name, value.repr()?, allowed, remedy).into())
}

/// The number of a text like `2.6mm`.
fn read(name: &str, text: &str) -> Result<f64, Failure> {
    // A path with a block is that of a scene, and a single word the name of an argument.
    match Quantity::of(name) {
        Some(_) if name.contains('.') => Ok(number_of(name, text).map_err(SceneError::Value)?),
        _ => Ok(number_in(name, Quantity::unit_of(name), text)?),
    }
}

/// The numbers of a quantity of pint, in the unit of a path or of an argument. To pint an angle has no dimension, so that
/// 40 Hz would be 382 rpm and 0.3 would be 17.2 degrees; such a conversion is refused.
#[pyfunction]
pub fn magnitude<'py>(name: &str, value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let unit = Quantity::unit_of(name);
    if unit.is_empty() {
        let message = format!("{name} has no unit: give a number in place of a quantity");
        return Err(PyTypeError::new_err(message));
    }
    let signs = [
        ("·", "*"),
        ("²", "**2"),
        ("³", "**3"),
        ("°", "deg"),
        ("^", "**"),
    ];
    let unit = signs.iter().fold(unit.to_owned(), |unit, (sign, word)| {
        unit.replace(sign, word)
    });
    let own = value.get_type().call1((1, &unit))?;
    let root =
        |quantity: &Bound<'py, PyAny>| quantity.call_method0("to_root_units")?.getattr("units");
    let (own, other) = (root(&own)?, root(value)?);
    let dimension = |units: &Bound<'py, PyAny>| units.getattr("dimensionality");
    if !own.eq(&other)? && dimension(&own)?.eq(dimension(&other)?)? {
        return Err(PyTypeError::new_err(format!(
            "{name} must be in {unit} (you gave {value}): turns, angles and plain numbers are not converted into each \
             other; give it in the unit of the key"
        )));
    }
    value.call_method1("m_as", (unit,))
}

/// The JSON of a dict of Python, whose numbers may have a unit.
#[pyfunction]
pub fn plain(data: &Bound<'_, PyAny>) -> PyResult<String> {
    Ok(json("", data)?.to_string())
}

/// The JSON of a scene, a part of one at a path, or a study.
pub fn json(path: &str, value: &Bound<'_, PyAny>) -> PyResult<Value> {
    if value.is_none() {
        Ok(Value::Null)
    } else if let Ok(text) = value.cast::<PyString>() {
        Ok(Value::String(text.to_cow()?.into_owned()))
    } else if value.is_instance_of::<PyBool>() {
        Ok(Value::Bool(value.extract()?))
    } else if value.is_instance_of::<PyInt>() {
        match value.extract::<i64>() {
            Ok(number) => Ok(number.into()),
            Err(_) => finite(path, value.extract()?),
        }
    } else if let Ok(block) = value.cast::<PyMapping>() {
        let dot = if path.is_empty() { "" } else { "." };
        let mut found = Map::new();
        for item in block.items()? {
            let (name, inner): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
            let name = name.str()?.to_string();
            let inner = json(&format!("{path}{dot}{name}"), &inner)?;
            found.insert(name, inner);
        }
        Ok(Value::Object(found))
    } else if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        let entries = value.try_iter()?.enumerate();
        let each = entries.map(|(place, inner)| json(&format!("{path}[{place}]"), &inner?));
        Ok(Value::Array(each.collect::<PyResult<_>>()?))
    } else if value.hasattr("m_as")? {
        json(path, &magnitude(path, value)?)
    } else if value.hasattr("tolist")? {
        // NumPy and pandas give one number also as an array of one element.
        let size = value.getattr("size").and_then(|size| size.extract());
        let size: Option<usize> = size.ok();
        let is_number = size == Some(1) && Quantity::of(path).is_some();
        json(
            path,
            &value.call_method0(if is_number { "item" } else { "tolist" })?,
        )
    } else if value.hasattr("__float__")? {
        finite(path, value.call_method0("__float__")?.extract()?)
    } else {
        let (text, kind) = (value.repr()?, value.get_type().name()?);
        let message = format!("{path}: {text} is no value of a scene, but of the type {kind}");
        Err(PyTypeError::new_err(message))
    }
}

fn finite(path: &str, number: f64) -> PyResult<Value> {
    if number.is_finite() {
        return Ok(number.into());
    }
    let refused = RefusedValue {
        key: path.to_owned(),
        value: number.to_string().to_lowercase(),
        allowed: "a finite number".to_owned(),
        remedy: "give a number, or None to leave the key out".into(),
    };
    Err(Failure::from(SceneError::Value(refused)).into())
}
