//! Options of the commands `cut` and `runup` for numbers of these blocks, and the numbers that are assumed beside them.

use serde_json::{Map, Value};

use crate::model::scene::{Scene, SceneFile, Setting, number_of};
use anyhow::Context;

use super::common::of_option;
use super::shorthand::Given;

/// A block of a scene whose numbers options may give.
pub struct Block<'a> {
    /// Key of the block.
    pub name: &'static str,
    /// Whether the scene lacks the block.
    pub is_missing: bool,
    /// The block of a typical saw.
    pub usual: fn(&SceneFile) -> Value,
    /// The options of the command.
    pub given: &'a [Given<'a>],
}

impl Block<'_> {
    /// The scene with the numbers of the options. If the scene lacks the block, typical numbers are assumed for the
    /// rest, and printed on the error stream.
    pub fn applied(&self, scene: Scene) -> anyhow::Result<Scene> {
        let given = || self.given.iter().filter(|given| given.text.is_some());
        if given().next().is_none() {
            return Ok(scene);
        }
        let path = |key: &str| format!("{}.{key}", self.name);
        let mut settings = Vec::new();
        for given in given() {
            settings.push(Setting::new(given.path.to_owned(), number(given)?));
        }
        let mut file = scene.file().clone();
        let assumed = if self.is_missing {
            self.usual_beside_given(scene.file())
        } else {
            Map::new()
        };
        for (key, value) in &assumed {
            match value.as_f64() {
                Some(number) => settings.push(Setting::new(path(key), number)),
                None => file = with_list(&file, self.name, key, value)?,
            }
        }
        let options = given()
            .map(|given| format!("--{}", given.option))
            .collect::<Vec<_>>()
            .join(", ");
        let verb = if given().count() > 1 { "were" } else { "was" };
        let set = file
            .set(&settings)
            .with_context(|| format!("{options} {verb} refused"))?;
        if !assumed.is_empty() {
            let assumed = assumed
                .iter()
                .map(|(key, value)| format!("{} = {value}", path(key)))
                .collect::<Vec<_>>()
                .join(", ");
            eprintln!(
                "The scene has no {}; assumed beside {options}: {assumed}. These are typical values, whose sources `sawflutter schema` states.",
                self.name
            );
        }
        Ok(set)
    }

    /// The typical numbers, without those that options give.
    fn usual_beside_given(&self, scene: &SceneFile) -> Map<String, Value> {
        let is_given = |key: &str| {
            let mut given = self.given.iter();
            given.any(|given| given.path == format!("{}.{key}", self.name) && given.text.is_some())
        };
        let Value::Object(mut block) = (self.usual)(scene) else {
            return Map::new();
        };
        block.retain(|key, _| !is_given(key));
        block
    }
}

/// Parses the number of an option, in the unit of its key.
fn number(given: &Given) -> anyhow::Result<f64> {
    let text = given.text.map_or("", String::as_str);
    number_of(given.path, text).map_err(|mut refused| {
        refused.key = given.option.into();
        of_option(refused)
    })
}

/// The scene with a list in a block, which a [`Setting`] cannot express.
fn with_list(file: &SceneFile, block: &str, key: &str, list: &Value) -> anyhow::Result<SceneFile> {
    let mut json = serde_json::to_value(file)?;
    json[block][key] = list.clone();
    Ok(serde_json::from_value(json)?)
}
