//! Typical blocks of a scene, from the typical values of their numbers.

use serde_json::{Value, json};

use super::SceneFile;
use super::quantities::typical_value;
use crate::page::text::shown_to;

/// Operating speed of a scene, in rpm; if it has none, the typical one.
pub(crate) fn operating_rpm(scene: &SceneFile) -> f64 {
    let diameter_m = scene.blade.outer_diameter_m;
    let usual =
        60.0 * const { typical_value("operating_rpm") } / (std::f64::consts::PI * diameter_m);
    scene.operating_rpm.unwrap_or_else(|| rounded(usual, 2))
}

/// A typical number of teeth for this blade.
pub(crate) fn teeth(scene: &SceneFile) -> Value {
    let pitch_m = const { typical_value("blade.teeth") };
    let count = std::f64::consts::PI * scene.blade.outer_diameter_m / pitch_m;
    json!(rounded(count, 2).max(1.0).round() as i64)
}

/// A typical cut for this blade.
pub(crate) fn cut(scene: &SceneFile) -> Value {
    let depth_m = rounded(
        const { typical_value("cut.depth_m") } * scene.blade.outer_diameter_m,
        2,
    );
    let mut cut = json!({
        "depth_m": depth_m,
        "power_w": short(rounded(const { typical_value("cut.power_w") } * depth_m, 2)),
        "radial_n_per_tooth": short(const { typical_value("cut.radial_n_per_tooth") }),
        "lateral_n_per_tooth": short(const { typical_value("cut.lateral_n_per_tooth") }),
        "feed_m_per_s": short(const { typical_value("cut.feed_m_per_s") }),
        "board_length_m": short(const { typical_value("cut.board_length_m") })
    });
    if scene.operating_rpm.is_none() {
        cut["speeds"] = json!([{ "rpm": short(operating_rpm(scene)) }]);
    }
    cut
}

/// A typical dependence of the cutting force on the surface left by the preceding tooth.
pub(crate) fn washboarding() -> Value {
    json!({ "stiffness_n_per_m": short(const { typical_value("cut.washboarding.stiffness_n_per_m") }), "overlap": short(const { typical_value("cut.washboarding.overlap") }) })
}

/// The damping of a typical material.
pub(crate) fn damping() -> Value {
    let time_s = const { typical_value("damping.material_retardation_time_s") };
    json!({ "material_retardation_time_s": time_s })
}

/// A typical run-up past the operating speed.
pub(crate) fn runup(scene: &SceneFile) -> Value {
    json!({
        "from_rpm": 0,
        "to_rpm": short(rounded(const { typical_value("runup.to_rpm") } * operating_rpm(scene), 2)),
        "duration_s": short(const { typical_value("runup.duration_s") })
    })
}

/// JSON number, without decimals if it is whole.
fn short(value: f64) -> Value {
    if value.fract() == 0.0 {
        json!(value as i64)
    } else {
        json!(value)
    }
}

/// Rounds a number to a number of significant digits.
pub(crate) fn rounded(value: f64, digits: usize) -> f64 {
    shown_to(digits, value).parse().unwrap_or(value)
}
