//! Typical blocks that the user can paste into a scene that lacks them.

use serde_json::Value;

use crate::analyses::door::CommandError;
use crate::model::scene::{Scene, SceneError, SceneFile, typical_block};

/// Prints a typical block on the error stream if a scene was refused because it lacks one.
pub fn say_if_missing(scene: &Scene, error: &CommandError) {
    let (CommandError::Refused(refused) | CommandError::Scene(SceneError::Value(refused))) = error
    else {
        return;
    };
    let file = scene.file();
    let (block, place) = match refused.key.as_str() {
        _ if !refused.is_missing() => return,
        "cut" => (cut_block(file), "the scene"),
        "runup" => (block("runup", &typical_block::runup(file)), "the scene"),
        "cut.washboarding" => {
            let washboarding = block("washboarding", &typical_block::washboarding());
            (washboarding, "its block \"cut\"")
        }
        _ => return,
    };
    // The block is printed separately, because the message of an error has only one line.
    eprintln!(
        "{block}\n\nInsert this after the opening brace of {place}, with your own numbers.\n"
    );
}

/// The key `cut` of a typical cut, with the number of teeth if the blade lacks it.
fn cut_block(scene: &SceneFile) -> String {
    let mut text = block("cut", &typical_block::cut(scene));
    if scene.blade.teeth.is_none_or(|teeth| teeth == 0) {
        text += "\n\nand the number of its teeth, \"teeth\": 40, into its block \"blade\"";
    }
    text
}

/// `"key": { … },` indented like a key of a scene.
fn block(key: &str, value: &Value) -> String {
    // Writing JSON fails only for keys that are not strings, and a `Value` has no such keys.
    let text = serde_json::to_string_pretty(value)
        .unwrap_or_default()
        .replace('\n', "\n  ");
    format!("  \"{key}\": {text},")
}
