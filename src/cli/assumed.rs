//! Numbers of the blocks `cut` and `runup` as options of their commands, and what is assumed beside them.

use serde_json::{Map, Value};

use crate::scene::{Scene, SceneFile, Setting, number_of};
use anyhow::Context;

use super::common::of_option;

/// A number of a block that an option may give.
pub struct Given<'a> {
    pub option: &'static str,
    /// Key of the number in the block.
    pub key: &'static str,
    pub text: Option<&'a String>,
}

/// A block of a scene, and the numbers that are assumed where the scene has none.
pub struct Block<'a> {
    pub name: &'static str,
    pub is_missing: bool,
    pub usual: fn(&SceneFile) -> Value,
    pub given: &'a [Given<'a>],
    /// Pairs of keys, the second of which is not assumed if the first is given.
    pub wins: &'a [(&'static str, &'static str)],
}

impl Block<'_> {
    /// The scene with the numbers that options give; where it has no such block, with usual numbers for the
    /// rest, which are said on the error stream.
    pub fn applied(&self, scene: Scene) -> anyhow::Result<Scene> {
        let given = || self.given.iter().filter(|given| given.text.is_some());
        if given().next().is_none() {
            return Ok(scene);
        }
        let path = |key: &str| format!("{}.{key}", self.name);
        let mut settings = Vec::new();
        for given in given() {
            settings.push(Setting::new(path(given.key), self.number(given)?));
        }
        let mut file = scene.file().clone();
        let assumed = match self.is_missing {
            true => self.usual_beside_given(scene.file()),
            false => Map::new(),
        };
        for (key, value) in &assumed {
            match value.as_f64() {
                Some(number) => settings.push(Setting::new(path(key), number)),
                None => file = with_list(&file, self.name, key, value)?,
            }
        }
        let options = given().map(|given| format!("--{}", given.option));
        let options = options.collect::<Vec<_>>().join(", ");
        let verb = if given().count() > 1 { "were" } else { "was" };
        let set = file.set(&settings);
        let set = set.with_context(|| format!("{options} {verb} refused"))?;
        if !assumed.is_empty() {
            let assumed = assumed
                .iter()
                .map(|(key, value)| format!("{} = {value}", path(key)));
            let assumed = assumed.collect::<Vec<_>>().join(", ");
            eprintln!(
                "The scene has no {}; assumed beside {options}: {assumed}. These are typical values, whose sources `sawflutter schema` states.",
                self.name
            );
        }
        Ok(set)
    }

    /// The usual numbers without those that options give or win over.
    fn usual_beside_given(&self, scene: &SceneFile) -> Map<String, Value> {
        let is_given = |key: &str| {
            let mut given = self.given.iter();
            given.any(|given| given.key == key && given.text.is_some())
        };
        let is_beaten = |key: &str| {
            let mut wins = self.wins.iter();
            wins.any(|(by, own)| *own == key && is_given(by))
        };
        let Value::Object(mut block) = (self.usual)(scene) else {
            return Map::new();
        };
        block.retain(|key, _| !is_given(key) && !is_beaten(key));
        block
    }

    fn number(&self, given: &Given) -> anyhow::Result<f64> {
        let text = given.text.map_or("", String::as_str);
        number_of(&format!("{}.{}", self.name, given.key), text).map_err(|mut refused| {
            refused.key = given.option.into();
            of_option(refused)
        })
    }
}

/// A scene whose block has this list, which is no number to set.
fn with_list(file: &SceneFile, block: &str, key: &str, list: &Value) -> anyhow::Result<SceneFile> {
    let mut json = serde_json::to_value(file)?;
    json[block][key] = list.clone();
    Ok(serde_json::from_value(json)?)
}
