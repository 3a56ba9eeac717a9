//! The one entrance to a command of one saw, for the command line, the Python package and the live page.
//!
//! The struct of a command's options is their only declaration: its fields have names that end in their units, doc comments and
//! defaults, from which help texts, signatures and readers of texts are made ([`Argument`]). A face collects what it was given as
//! JSON by name; [`entered`] makes a scene and the options of it.

mod argument;
mod error;
mod text;

pub(crate) use argument::described;
pub use argument::{Argument, ArgumentKind, SceneNumber};
pub use error::CommandError;
pub use text::named_bounds;

use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use crate::model::scene::{AssumedBlock, RefusedValue, Scene, SceneFile, Setting};

/// Options of a command, with what it computes of a scene. The doc comment of the struct says what the command does.
pub trait CommandOptions: DeserializeOwned + JsonSchema {
    /// The result.
    type Report: Serialize;

    /// Name of the command, such as `gap`.
    const COMMAND: &'static str;
    /// Name of the method of a scene in Python, such as `run_gap`.
    const METHOD: &'static str;
    /// Options beside those of the struct: numbers of the scene that they replace.
    const SETS: &'static [SceneNumber] = &[];
    /// Block of the scene for which typical numbers are assumed beside those given.
    const ASSUMED: Option<AssumedBlock> = None;

    /// Computes the report.
    ///
    /// # Errors
    /// [`CommandError`].
    fn compute(&self, scene: &Scene, progress: Progress<'_>) -> Result<Self::Report, CommandError>;

    /// What the options assume of the scene, in words.
    fn assumptions(&self, _scene: &Scene) -> Option<String> {
        None
    }

    /// File name of the scene that results, and this scene, unless it keeps not all limits.
    fn resulting_scene(_report: &Self::Report) -> Option<(&'static str, Option<&SceneFile>)> {
        None
    }

    /// Whether the saw keeps all limits of the command.
    fn is_kept(_report: &Self::Report) -> bool {
        true
    }
}

/// Progress callback of a command.
pub type Progress<'a> = &'a (dyn Fn(Step) + Sync);

/// Progress of a command.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Name of the counted items.
    pub what: &'static str,
    /// Number of finished items.
    pub done: usize,
    /// Number of all items.
    pub of: usize,
    /// Highest speed found so far, of a search for one.
    pub best_rpm: Option<f64>,
}

impl Step {
    /// A step that searches no best speed.
    pub(crate) fn new(what: &'static str, done: usize, of: usize) -> Self {
        Step {
            what,
            done,
            of,
            best_rpm: None,
        }
    }
}

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
                    "the scene has no {key}; assumed beside what was given: {words} (typical values, whose sources the schema of scenes states)"
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
