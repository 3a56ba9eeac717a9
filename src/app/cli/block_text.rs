//! Typical blocks that the user can paste into a scene that lacks them.

use serde_json::Value;

use crate::model::scene::{RefusedValue, Scene, SceneFile, typical_block};

/// Returns the block of a scene that a command needs. If it is missing, prints a typical one on the error stream.
pub fn pasted<T>(scene: &Scene, needed: Result<T, RefusedValue>) -> anyhow::Result<T> {
    needed.map_err(|refused| {
        let (block, place) = match refused.key.as_str() {
            "cut" => (cut_block(scene.file()), "the scene"),
            "runup" => (
                block("runup", &typical_block::runup(scene.file())),
                "the scene",
            ),
            "cut.washboarding" => {
                let washboarding = block("washboarding", &typical_block::washboarding());
                (washboarding, "its block \"cut\"")
            }
            _ => return refused.into(),
        };
        // The block is printed separately, because the message of an error has only one line.
        eprintln!(
            "{block}\n\nInsert this after the opening brace of {place}, with your own numbers.\n"
        );
        refused.into()
    })
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
