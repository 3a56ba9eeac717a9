//! Saws of the trial: the paper's blade with one thing after another.

use sawflutter::model::scene::{Scene, SceneFile};
use serde_json::{Value, json};

fn pad(radius_m: f64, angle_deg: f64, side_m: f64, stiffness: f64, damping: f64) -> Value {
    json!({
        "radius_m": radius_m, "angle_deg": angle_deg, "radial_length_m": side_m,
        "tangential_length_m": side_m, "stiffness_n_per_m": stiffness, "damping_n_s_per_m": damping,
    })
}

fn with(guides: &[Value], others: &Value) -> SceneFile {
    let mut scene = serde_json::to_value(Scene::paper().file()).expect("a scene");
    for key in ["cut", "runup", "probe", "measured", "spline"] {
        scene.as_object_mut().expect("an object").remove(key);
    }
    scene["sweep"] = json!({ "to_rpm": 3000 });
    scene["guides"] = json!(guides);
    for (key, value) in others.as_object().into_iter().flatten() {
        scene[key] = value.clone();
    }
    serde_json::from_value(scene).expect("a scene")
}

fn cut(wood: Option<(f64, f64)>) -> Value {
    let mut cut = json!({
        "angle_deg": 0, "depth_m": 0.2, "tangential_n_per_tooth": 1240, "radial_n_per_tooth": 88,
        "chart_rpm": 2800, "speeds": [{ "rpm": 2800 }],
    });
    if let Some((stiffness, damping)) = wood {
        cut["wood"] = json!({ "stiffness_n_per_m": stiffness, "damping_n_s_per_m": damping, "depth_m": 0.06 });
    }
    json!({ "cut": cut })
}

/// Saws by name.
pub fn named() -> Vec<(&'static str, SceneFile)> {
    let usual = |damping: f64| pad(0.2, -55.0, 0.15, 2e7, damping);
    let (one, none) = ([usual(0.0)], json!({}));
    let damped = |key: &str, value: f64| with(&one, &json!({ "damping": { key: value } }));
    let six: Vec<Value> = (0..6)
        .map(|k| pad(0.25, 60.0 * f64::from(k), 0.06, 1e7, 0.0))
        .collect();
    let two = |stiffness: f64, damping: f64| {
        let guides = [usual(0.0), pad(0.3, 60.0, 0.06, stiffness, damping)];
        with(&guides, &none)
    };
    vec![
        ("one pad", with(&one, &none)),
        ("two pads", two(1e7, 0.0)),
        ("six equal pads", with(&six, &none)),
        (
            "point alone",
            with(&[pad(0.3, -55.0, 0.0, 1e5, 0.0)], &none),
        ),
        ("damped pad", with(&[usual(300.0)], &none)),
        (
            "pad 1e6, 1e4 N s/m",
            with(&[pad(0.2, -55.0, 0.15, 1e6, 1e4)], &none),
        ),
        (
            "point 1e4, 1e5 N s/m",
            with(&[pad(0.3, -55.0, 0.0, 1e4, 1e5)], &none),
        ),
        ("damper without spring", two(0.0, 1e5)),
        (
            "damped material",
            damped("material_retardation_time_s", 2e-4),
        ),
        ("air", damped("air_n_s_per_m3", 1e4)),
        ("cut", with(&one, &cut(None))),
        ("wood 6e4, 2e3 N s/m", with(&one, &cut(Some((6e4, 2e3))))),
    ]
}
