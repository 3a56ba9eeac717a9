//! Saws of the trial.

use sawflutter::scene::{Scene, SceneFile};
use serde_json::{Value, json};

pub use crate::bands::{drawn_saw, drawn_saw_in_cut};
pub use crate::damped::drawn_saws as damped_saws;

/// A scene of the repository.
pub fn read(name: &str) -> SceneFile {
    let path = format!("{}/scenes/{name}.json", env!("CARGO_MANIFEST_DIR"));
    Scene::from_path(&path).expect(&path).file().clone()
}

fn pad(radius_m: f64, angle_deg: f64, side_m: f64, stiffness: f64, damping: f64) -> Value {
    json!({
        "radius_m": radius_m, "angle_deg": angle_deg, "radial_length_m": side_m, "tangential_length_m": side_m,
        "stiffness_n_per_m": stiffness, "damping_n_s_per_m": damping,
    })
}

/// The paper's blade with guides and other blocks of a scene.
fn paper(guides: Vec<Value>, others: &[(&str, Value)]) -> SceneFile {
    let mut scene = json!({
        "name": "x",
        "blade": {
            "outer_diameter_m": 0.71, "inner_diameter_m": 0.2, "thickness_m": 0.0028, "teeth": 42,
            "material": { "youngs_modulus_pa": 2.03e11, "poisson_ratio": 0.29, "density_kg_per_m3": 7800 },
        },
        "mount": { "kind": "spline" }, "operating_rpm": 1000, "sweep": { "to_rpm": 3000 }, "guides": guides,
    });
    for (key, value) in others {
        scene[*key] = value.clone();
    }
    serde_json::from_value(scene).expect("a scene")
}

fn usual(damping: f64) -> Value {
    pad(0.2, -55.0, 0.15, 2e7, damping)
}

fn cut(factor: f64, wood: Option<(f64, f64)>) -> Value {
    let mut cut = json!({
        "angle_deg": 0, "depth_m": 0.2, "tangential_n_per_tooth": 1240.0 * factor,
        "radial_n_per_tooth": 88.0 * factor, "lateral_n_per_tooth": 4.5, "chart_rpm": 2800,
        "speeds": [{ "rpm": 2800 }],
    });
    if let Some((stiffness, damping)) = wood {
        cut["wood"] = json!({ "stiffness_n_per_m": stiffness, "damping_n_s_per_m": damping, "depth_m": 0.06 });
    }
    cut
}

/// Saws with equal pads around the blade.
pub fn equal_pads(count: usize) -> SceneFile {
    let angle = |k: usize| -180.0 + 360.0 * k as f64 / count as f64;
    let guides = (0..count).map(|k| pad(0.25, angle(k), 0.06, 1e7, 0.0));
    paper(guides.collect(), &[])
}

/// Saws of the paper's blade, by name.
pub fn named() -> Vec<(&'static str, SceneFile)> {
    let damping = |value: Value| vec![("damping", value)];
    vec![
        ("pad", paper(vec![usual(0.0)], &[])),
        (
            "two pads",
            paper(vec![usual(0.0), pad(0.3, 80.0, 0.1, 1e7, 0.0)], &[]),
        ),
        ("six pads", equal_pads(6)),
        ("pad c 50", paper(vec![usual(50.0)], &[])),
        ("pad c 300", paper(vec![usual(300.0)], &[])),
        ("pad c 2000", paper(vec![usual(2000.0)], &[])),
        ("pad c 20000", paper(vec![usual(2e4)], &[])),
        (
            "pad 1e6 c 1e4",
            paper(vec![pad(0.2, -55.0, 0.15, 1e6, 1e4)], &[]),
        ),
        (
            "point 1e4 c 1e5",
            paper(vec![pad(0.3, -55.0, 0.0, 1e4, 1e5)], &[]),
        ),
        (
            "damper alone 1e3",
            paper(vec![usual(0.0), pad(0.3, 60.0, 0.06, 0.0, 1e3)], &[]),
        ),
        (
            "damper alone 1e5",
            paper(vec![usual(0.0), pad(0.3, 60.0, 0.06, 0.0, 1e5)], &[]),
        ),
        (
            "pads, one c 1e4",
            paper(vec![usual(0.0), pad(0.3, 60.0, 0.06, 1e4, 1e4)], &[]),
        ),
        (
            "retardation 1e-5",
            paper(
                vec![usual(0.0)],
                &damping(json!({ "material_retardation_time_s": 1e-5 })),
            ),
        ),
        (
            "retardation 2e-4",
            paper(
                vec![usual(0.0)],
                &damping(json!({ "material_retardation_time_s": 2e-4 })),
            ),
        ),
        (
            "loss factor 0.02",
            paper(vec![usual(0.0)], &damping(json!({ "loss_factor": 0.02 }))),
        ),
        (
            "turning air 100",
            paper(
                vec![usual(0.0)],
                &damping(json!({ "air_n_s_per_m3": 100.0, "air_rotation_share": 0.5 })),
            ),
        ),
        (
            "air 1e4",
            paper(vec![usual(0.0)], &damping(json!({ "air_n_s_per_m3": 1e4 }))),
        ),
        ("cut", paper(vec![usual(0.0)], &[("cut", cut(1.0, None))])),
        (
            "cut, wood 6e4 c 2e3",
            paper(vec![usual(0.0)], &[("cut", cut(1.0, Some((6e4, 2e3))))]),
        ),
        (
            "cut, wood 6e5 c 200",
            paper(vec![usual(0.0)], &[("cut", cut(1.0, Some((6e5, 200.0))))]),
        ),
        (
            "rim 8 K colder",
            paper(
                vec![usual(0.0)],
                &[(
                    "membrane",
                    json!({ "temperature": { "expansion_per_k": 1.2e-5, "rim_rise_k": -8.0 } }),
                )],
            ),
        ),
    ]
}
