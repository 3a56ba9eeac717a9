//! Arguments of the methods of a scene, as the table of the library lists them.

use pyo3::conversion::FromPyObjectOwned;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping, PyString};
use sawflutter::analyses::commands::{ArgumentKind, Call};
use sawflutter::model::scene::{AssumedBlock, NamedBounds, Scene, Setting};

use crate::failure::{Failure, Refusal};
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

    /// A number that has a default.
    pub fn given(&self, name: &str) -> PyResult<f64> {
        let missing = || PyKeyError::new_err(name.to_owned());
        self.number(name)?.ok_or_else(missing)
    }

    /// Millimetres of a number in metres.
    pub fn millimetres(&self, name: &str) -> PyResult<Option<f64>> {
        Ok(self.number(name)?.map(|metres| 1e3 * metres))
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
        let items = by_path.items()?.into_iter();
        items
            .map(|item| {
                let (path, bounds): (String, Bound<'_, PyAny>) = item.extract()?;
                let found = bounds_at(&path, &bounds)?;
                Ok((path, found))
            })
            .collect()
    }

    /// The scene with the numbers that the options of a command replace, and a sentence with those that were assumed beside
    /// them, if any were.
    pub fn applied(&self, call: &Call, scene: Scene) -> PyResult<(Scene, Option<String>)> {
        let (mut settings, mut flags) = (Vec::new(), Vec::new());
        for argument in call.arguments.iter().filter(|of| !of.sets.is_empty()) {
            let path = argument.sets;
            match (self.found(argument.name)?, argument.kind) {
                (None, _) => (),
                (Some(value), ArgumentKind::Flag) => flags.push((path, value.extract()?)),
                (Some(value), _) => {
                    settings.push(Setting::new(path.to_owned(), number(path, &value)?));
                }
            }
        }
        let (scene, said) = completed(call, scene, &settings)?;
        let scene = flags.into_iter().try_fold(scene, |scene, (path, value)| {
            scene.edited(|file| match path {
                "cut.stretching" => file.cut.iter_mut().for_each(|cut| cut.stretching = value),
                _ => file
                    .runup
                    .iter_mut()
                    .for_each(|runup| runup.stretching = value),
            })
        });
        Ok((scene.map_err(Failure::from)?, said))
    }
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

/// The scene with settings. For a block that it lacks, typical numbers are assumed beside them.
fn completed(
    call: &Call,
    scene: Scene,
    settings: &[Setting],
) -> Result<(Scene, Option<String>), Failure> {
    let (block, keys, example) = match call.command {
        "cut" => {
            let keys = "power_w, depth_m, feed_m_per_s";
            (AssumedBlock::Cut, keys, "run_cut(2400, power_w=12000)")
        }
        "runup" => (
            AssumedBlock::RunUp,
            "to_rpm, duration_s",
            "run_up(to_rpm=3000)",
        ),
        "washboard" if !settings.is_empty() => (AssumedBlock::Washboarding, "", ""),
        _ => return Ok((scene.file().set(settings)?, None)),
    };
    let has_block = match block {
        AssumedBlock::Cut => scene.cut().is_some(),
        AssumedBlock::RunUp => scene.runup().is_some(),
        AssumedBlock::Washboarding => scene.needed_washboarding().is_ok(),
    };
    let key = block.key();
    if settings.is_empty() {
        return if has_block {
            Ok((scene, None))
        } else {
            Err(missing(key, keys, example))
        };
    }
    let found = block.completed(&scene, settings)?;
    let said = (!found.assumed.is_empty()).then(|| {
        format!(
            "the scene has no {key}; assumed typical values: {}",
            found.in_words()
        )
    });
    Ok((found.scene, said))
}

fn missing(block: &str, keys: &str, example: &str) -> Failure {
    let remedy = format!(
        "add it with {keys}, or give a number, with which typical ones are assumed: {example}"
    );
    Failure::Refused(Box::new(Refusal {
        class: "ArgumentError",
        message: format!("the scene has no {block}; {remedy}"),
        key: Some(block.to_owned()),
        value: None,
        allowed: Some(format!("a block {block}")),
        remedy: Some(remedy),
    }))
}
