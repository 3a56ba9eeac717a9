//! Options that are short for numbers of a scene.

use super::common::with_settings;
use crate::analyses::commands::Argument;
use crate::model::scene::Scene;

/// An option that is short for `--set PATH=…`.
pub struct Given<'a> {
    /// Name of the option, without dashes.
    pub option: &'static str,
    /// Path of the number in the scene.
    pub path: &'static str,
    /// Text of the option; `None` if it is not given.
    pub text: Option<&'a String>,
}

impl<'a> Given<'a> {
    pub fn new(argument: &Argument, text: &'a Option<String>) -> Self {
        Given {
            option: argument.option,
            path: argument.sets,
            text: text.as_ref(),
        }
    }
}

/// The scene with numbers of options that are short for `--set PATH=…`.
pub fn with_shorthands(mut scene: Scene, given: &[Given<'_>]) -> anyhow::Result<Scene> {
    for Given { option, path, text } in given {
        if let Some(text) = text {
            let setting = format!("{path}={text}");
            let option = format!("--{option}");
            scene = with_settings(&scene, std::iter::once(setting.as_str()), &option)?;
        }
    }
    Ok(scene)
}
