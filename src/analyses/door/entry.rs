//! The scene and the options of what a face was given.

use serde_json::{Map, Value};

use super::{Argument, CommandError, CommandOptions, SceneNumber};
use crate::model::scene::{RefusedValue, Scene, Setting};

/// What a command computes with.
#[derive(Debug)]
pub struct Entered<C> {
    /// The scene with the numbers that were given.
    pub scene: Scene,
    /// The other options.
    pub options: C,
    /// What was assumed beside them, in words.
    pub assumed: Option<String>,
}

/// The scene and the options of what a face was given: values by the names of arguments, in the units of these names. A
/// null is left out.
///
/// # Errors
/// [`CommandError`] if a value is refused.
pub fn entered<C: CommandOptions>(
    scene: Scene,
    given: Map<String, Value>,
) -> Result<Entered<C>, CommandError> {
    let mut rest = given;
    rest.retain(|_, value| !value.is_null());
    let set: Vec<(&SceneNumber, Value)> = C::SETS
        .iter()
        .filter_map(|number| Some((number, rest.shift_remove(number.name)?)))
        .collect();
    let (scene, mut assumed) = with_numbers::<C>(scene, &set)?;
    for argument in Argument::of_schema::<C>() {
        if let Some(value) = rest.get(&argument.name) {
            argument.check_word(value)?;
        }
    }
    let options: C = serde_json::from_value(Value::Object(rest))
        .map_err(|error| CommandError::Failed(error.into()))?;
    assumed.extend(options.assumptions(&scene));
    Ok(Entered {
        scene,
        options,
        assumed: (!assumed.is_empty()).then(|| assumed.join("; ")),
    })
}

/// The scene with the given numbers, and what was assumed beside them.
fn with_numbers<C: CommandOptions>(
    scene: Scene,
    set: &[(&SceneNumber, Value)],
) -> Result<(Scene, Vec<String>), CommandError> {
    let refused = |source| CommandError::Set {
        names: set.iter().map(|(number, _)| number.name).collect(),
        source,
    };
    let (numbers, switches): (Vec<_>, Vec<_>) =
        set.iter().partition(|(_, value)| !value.is_boolean());
    let settings = numbers
        .into_iter()
        .map(|(number, value)| {
            let found = value.as_f64().ok_or_else(|| no_number(number, value))?;
            Ok(Setting::new(number.path.to_owned(), found))
        })
        .collect::<Result<Vec<_>, RefusedValue>>()?;
    let mut assumed = Vec::new();
    let mut scene = match C::ASSUMED {
        _ if settings.is_empty() => scene,
        None => scene.file().set(&settings).map_err(refused)?,
        Some(block) => {
            let found = block.completed(&scene, &settings).map_err(refused)?;
            if !found.assumed.is_empty() {
                let (key, words) = (block.key(), found.in_words());
                assumed.push(format!(
                    "the scene has no {key}; assumed beside what was given: {words} (typical values; `sawflutter keys {key}` states their sources)"
                ));
            }
            found.scene
        }
    };
    for (number, value) in switches {
        let is_on = *value == Value::Bool(true);
        let switched = Setting::switched(number.path, is_on, scene.file());
        scene = match switched {
            Some(setting) => scene.file().set(&[setting]).map_err(refused)?,
            // The command itself says that the block is missing.
            None => scene,
        };
    }
    Ok((scene, assumed))
}

fn no_number(number: &SceneNumber, value: &Value) -> RefusedValue {
    RefusedValue::new(
        number.name,
        value.to_string(),
        "a number",
        "give one number, like 3",
    )
}
