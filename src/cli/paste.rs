//! Blocks of a scene that lacks them: to paste, and assumed where options give a part of one.

use std::f64::consts::PI;

use serde_json::{Value, json};

use crate::scene::{RefusedValue, Scene, SceneFile};

/// Rim speed of a saw that says no speed of its own: between those of the stone and the
/// timber industry.
const RIM_SPEED_M_PER_S: f64 = 60.0;
/// Power of a cut in each metre of depth, of the order of the paper's saw.
const POWER_W_PER_M: f64 = 200e3;

/// The input of a command from a scene. If it is missing, a block to paste is printed on the error stream.
pub fn pasted<T>(scene: &Scene, needed: Result<T, RefusedValue>) -> anyhow::Result<T> {
    needed.map_err(|refused| {
        let (block, place) = match refused.key.as_str() {
            "cut" => (cut_block(scene.file()), "the scene"),
            "runup" => (block("runup", &usual_runup(scene.file())), "the scene"),
            "cut.washboarding" => (washboarding_block(), "its block \"cut\""),
            _ => return refused.into(),
        };
        // By itself, for the words of an error are one line.
        eprintln!(
            "{block}\n\nPaste this behind the first brace of {place}, with your own numbers.\n"
        );
        refused.into()
    })
}

/// A typical cut for this blade.
pub fn usual_cut(scene: &SceneFile) -> Value {
    let depth_m = rounded(0.25 * scene.blade.outer_diameter_m);
    let mut cut = json!({
        "depth_m": depth_m,
        "power_w": rounded(POWER_W_PER_M * depth_m),
        "radial_n_per_tooth": 20,
        "lateral_n_per_tooth": 1,
        "feed_m_per_s": 1,
        "board_length_m": 2
    });
    if scene.operating_rpm.is_none() {
        cut["speeds"] = json!([{ "rpm": usual_rpm(scene) }]);
    }
    cut
}

/// The key `cut`, of a middling cut.
fn cut_block(scene: &SceneFile) -> String {
    let mut text = block("cut", &usual_cut(scene));
    if scene.blade.teeth.is_none_or(|teeth| teeth == 0) {
        text += "\n\nand the number of its teeth, \"teeth\": 40, into its block \"blade\"";
    }
    text
}

/// The key `cut.washboarding`, of a cut of middling stiffness.
fn washboarding_block() -> String {
    block(
        "washboarding",
        &json!({ "stiffness_n_per_m": 20000, "overlap": 1 }),
    )
}

/// A run-up to half as fast again as the saw runs.
pub fn usual_runup(scene: &SceneFile) -> Value {
    let usual_rpm = scene.operating_rpm.unwrap_or_else(|| usual_rpm(scene));
    json!({
        "from_rpm": 0,
        "to_rpm": rounded(1.5 * usual_rpm),
        "duration_s": 60,
        "force_n": 1
    })
}

fn usual_rpm(scene: &SceneFile) -> f64 {
    rounded(60.0 * RIM_SPEED_M_PER_S / (PI * scene.blade.outer_diameter_m))
}

/// To two digits.
fn rounded(value: f64) -> f64 {
    let digit = 10f64.powf(value.abs().max(f64::MIN_POSITIVE).log10().floor() - 1.0);
    // A decimal text and back, for a multiple of 0.01 is not one in binary.
    let text = format!("{:.3e}", (value / digit).round() * digit);
    text.parse().unwrap_or(value)
}

/// `"key": { … },` indented like a key of a scene.
fn block(key: &str, value: &Value) -> String {
    // A JSON value made here has no keys but texts, which is all that could fail.
    let text = serde_json::to_string_pretty(value).unwrap_or_default();
    let text = text.replace('\n', "\n  ");
    format!("  \"{key}\": {text},")
}
