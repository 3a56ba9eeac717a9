//! What is refused is named by its key, with its value and what is allowed.

use serde_json::{Value, json};

use super::quantities::QUANTITIES;
use super::{Kind, Quantity, Scene};
use crate::text::shown;

/// Puts a value at a path like `guides.0.gap_m`.
fn put(scene: &mut Value, path: &str, value: Value) {
    let (parent, key) = path.rsplit_once('.').unwrap_or(("", path));
    let parent = scene.pointer_mut(&pointer(parent)).unwrap();
    match key.parse::<usize>() {
        Ok(index) => parent[index] = value,
        Err(_) => parent[key] = value,
    }
}

/// JSON pointer of a path, `/guides/0` for `guides.0` or `guides[]`.
fn pointer(path: &str) -> String {
    let keys = path.replace("[]", ".0").replace('.', "/");
    if keys.is_empty() {
        keys
    } else {
        format!("/{keys}")
    }
}

fn refusal(scene: &Value) -> String {
    let found = Scene::from_json(&scene.to_string());
    found
        .err()
        .map_or("accepted".to_owned(), |error| error.to_string())
}

/// Scenes that together contain every number of the table. Counts are written without a decimal point.
fn scenes() -> Vec<Value> {
    let lifting = json!({ "radius_m": 0.2, "angle_deg": -55.0, "radial_length_m": 0.15,
        "tangential_length_m": 0.15, "stiffness_n_per_m": 2e7, "damping_n_s_per_m": 10.0,
        "contact": "one_sided", "gap_m": 4e-5, "film_stiffness_n_per_m": 1e5, "offset_m": 1e-5 });
    let rows = json!([{ "radius_m": 0.2, "hoop_pa": 0.0, "radial_pa": 0.0 }]);
    let band = json!({ "radius_m": 0.25, "width_m": 0.02, "eigenstrain": 1e-4 });
    let groove = json!({ "radius_m": 0.25, "width_m": 0.02, "groove_depth_m": 1e-6 });
    let heat = json!({ "expansion_per_k": 1.2e-5, "rim_rise_k": 10.0, "from_radius_m": 0.11, "exponent": 2.0 });
    let table = json!({ "expansion_per_k": 1.2e-5, "table": [{ "radius_m": 0.2, "rise_k": 1.0 }] });
    let edge = json!({ "length_m": 0.4, "support_radius_m": 0.3, "measured_gap_m": 1e-5 });
    let spline = json!({ "teeth": 20, "pressure_angle_deg": 30.0, "contact_stiffness_n_per_m_3_2": 7e9,
        "contact_damping_n_s_3_2_per_m_3_2": 1.0, "clearance_m": 2.5e-4, "pitch_radius_m": 0.1,
        "weight_angle_deg": 0.0 });
    let damping = json!({ "material_retardation_time_s": 1e-6, "air_n_s_per_m3": 10.0,
        "air_rotation_share": 0.5 });
    let wood = json!({ "stiffness_n_per_m": 1e5, "damping_n_s_per_m": 10.0, "depth_m": 0.1,
        "arc_deg": 20.0 });
    let washboarding = json!({ "stiffness_n_per_m": 1e4, "overlap": 1.0, "arc_deg": 30.0,
        "pitches_deg": [8.07, 9.07] });
    let response = json!({ "force_n": 1.0, "radius_m": 0.3, "angle_deg": 0.0, "runout_m": 0.0,
        "flatness_m": 1e-5, "imbalance_kg_m2": 1e-6, "tooth_force_n": 1.0 });
    let friction = json!({ "coefficient": 0.2, "heat_share": 0.9, "convection_w_per_m2_k": 80.0,
        "conductivity_w_per_m_k": 40.0 });
    let rim = json!({ "mass_per_tooth_kg": 0.002, "radius_m": 0.35 });
    [
        ("name", json!("the paper's saw")),
        (
            "blade.profile",
            json!([{ "radius_m": 0.2, "thickness_m": 0.0028 }]),
        ),
        ("blade.rim", rim),
        (
            "mount",
            json!({ "kind": "collar", "diameter_m": 0.3, "in_plane": "free" }),
        ),
        ("guides.0", lifting),
        ("friction", friction),
        ("damping", damping),
        ("damping", json!({ "loss_factor": 1e-3 })),
        (
            "damping",
            json!({ "mode_ratios": [{ "diameters": 2, "damping_ratio": 1e-3 }] }),
        ),
        ("membrane", json!({ "temperature": heat })),
        ("membrane", json!({ "temperature": table })),
        ("membrane", json!({ "roll_tension": [groove] })),
        ("membrane", json!({ "residual_stress": rows })),
        (
            "membrane",
            json!({ "roll_tension": [band], "straight_edge": edge }),
        ),
        ("spline", spline),
        ("excitation", json!({ "orders": 2, "tooth_passing": 1 })),
        ("tolerance", json!(1e-3)),
        ("flutter_threshold_per_s", json!(0.25)),
        ("cut.teeth_in_cut", json!(4)),
        ("cut.idle_s", json!(0.5)),
        ("cut.chart_rpm", json!(1800.0)),
        ("cut.wood", wood),
        ("cut.washboarding", washboarding),
        ("response", response),
        ("probe", json!({ "radius_m": 0.3, "angle_deg": 90.0 })),
    ]
    .map(|(path, value)| {
        let mut scene = serde_json::to_value(Scene::paper().file()).unwrap();
        put(&mut scene, path, value);
        scene
    })
    .into()
}

/// Ends of a range, each with a number just inside and one just outside.
fn ends(quantity: &Quantity) -> [(f64, f64); 2] {
    let allowed = quantity.allowed;
    if quantity.kind == Kind::Count {
        return [
            (allowed.from, allowed.from - 1.0),
            (allowed.to, allowed.to + 1.0),
        ];
    }
    let below = if allowed.is_open_below {
        (allowed.from.next_up(), allowed.from)
    } else {
        (allowed.from, allowed.from.next_down())
    };
    let above = if allowed.is_open_above {
        (allowed.to.next_down(), allowed.to)
    } else {
        (allowed.to, allowed.to.next_up())
    };
    [below, above]
}

/// A number just inside of its range is refused at most by a rule that joins it with other keys.
#[test]
fn every_number_out_of_its_range_is_refused_by_its_key() {
    let scenes = scenes();
    for scene in &scenes {
        assert_eq!(refusal(scene), "accepted", "{scene}");
    }
    let mut wrong = Vec::new();
    for quantity in &QUANTITIES {
        let place = pointer(quantity.path);
        let is_there = |scene: &&Value| scene.pointer(&place).is_some_and(Value::is_number);
        let own = scenes.iter().find(is_there);
        let scene = own.unwrap_or_else(|| panic!("no scene has {}", quantity.path));
        let key = quantity.path.replace("[]", "[0]");
        let with = |value: f64| {
            let mut scene = scene.clone();
            *scene.pointer_mut(&place).unwrap() = match quantity.kind {
                Kind::Count => json!(value as i64),
                _ => json!(value),
            };
            scene
        };
        for (inside, outside) in ends(quantity) {
            let file = Scene::file_from_json(&with(inside).to_string()).unwrap();
            if let Err(error) = file.check_numbers() {
                wrong.push(format!("{inside}: {error}"));
            }
            let bound = if outside > inside {
                quantity.allowed.to
            } else {
                quantity.allowed.from
            };
            let message = refusal(&with(outside));
            let is_negative_count = quantity.kind == Kind::Count && outside < 0.0;
            let words = match is_negative_count {
                true => format!("{key}: must be a whole number, 0 or more, but is -1"),
                false => format!("{key} is {}, but must be ", shown(outside)),
            };
            let range = message.strip_prefix(&words);
            let names = |range: &str| range.contains(&shown(bound)) || range.starts_with("above 0");
            if !range.is_some_and(|range| is_negative_count || names(range)) {
                wrong.push(format!("{words}{bound}: {message}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Numbers that contradict others: the changes of the scene, and the key that is refused.
const CONTRADICTIONS: &str = r#"[
    [{ "blade.teeth": null }, "blade.teeth"],
    [{ "blade.inner_diameter_m": 0.8 }, "blade.inner_diameter_m"],
    [{ "guides.0.radius_m": 3.0 }, "guides[0].radius_m"],
    [{ "guides.0.tangential_length_m": 0 }, "guides[0].tangential_length_m"],
    [{ "guides.0.offset_m": 1e-5 }, "guides[0].offset_m"],
    [{ "guides.0.film_stiffness_n_per_m": 1e5 }, "guides[0].film_stiffness_n_per_m"],
    [{ "guides.0.side": "right" }, "guides[0].side"],
    [{ "guides.0.contact": "one_sided" }, "guides[0].gap_m"],
    [{ "guides.0.contact": "one_sided", "guides.0.gap_m": 4e-5, "guides.0.stiffness_n_per_m": 0 },
        "guides[0].stiffness_n_per_m"],
    [{ "guides.0.contact": "one_sided", "guides.0.gap_m": 4e-5, "guides.0.film_stiffness_n_per_m": 3e7 },
        "guides[0].film_stiffness_n_per_m"],
    [{ "sweep": { "from_rpm": 9, "to_rpm": 9 } }, "sweep.to_rpm"],
    [{ "cut.teeth_in_cut": 43 }, "cut.teeth_in_cut"],
    [{ "cut": { "teeth_in_cut": 1, "speeds": [{ "rpm": 1000 }] } }, "cut.tangential_n_per_tooth"],
    [{ "cut.washboarding": { "stiffness_n_per_m": 1e4, "pitches_deg": [8, 8, 8, 8, 8] } },
        "cut.washboarding.pitches_deg"],
    [{ "cut.washboarding": { "stiffness_n_per_m": 1e4, "pitches_deg": [8, 9.9] } }, "cut.washboarding.pitches_deg"],
    [{ "cut.washboarding": { "stiffness_n_per_m": 1e4, "pitches_deg": [17, 0.1] } },
        "cut.washboarding.pitches_deg[1]"],
    [{ "mount": { "kind": "collar", "diameter_m": 0.3, "in_plane": "free" },
        "spline": { "teeth": 20, "pressure_angle_deg": 30, "contact_stiffness_n_per_m_3_2": 7e9,
            "contact_damping_n_s_3_2_per_m_3_2": 0 } }, "mount.kind"],
    [{ "spline": { "teeth": 20, "pressure_angle_deg": 30, "contact_stiffness_n_per_m_3_2": 7e9,
        "contact_damping_n_s_3_2_per_m_3_2": 0, "clearance_m": 0.25 } }, "spline.clearance_m"],
    [{ "membrane": { "temperature": { "expansion_per_k": 1e-5, "table": [
        { "radius_m": 0.2, "rise_k": 1 }, { "radius_m": 0.4, "rise_k": 1 }] } } },
        "membrane.temperature.table[1].radius_m"],
    [{ "membrane": { "roll_tension": [{ "radius_m": 0.2, "width_m": 0.01 }] } }, "membrane.roll_tension[0]"],
    [{ "membrane": { "roll_tension": [
        { "radius_m": 0.2, "width_m": 0.01, "eigenstrain": 1e-4, "groove_depth_m": 1e-6 }] } },
        "membrane.roll_tension[0]"]
]"#;

#[test]
fn numbers_that_contradict_others_are_refused_by_their_keys() {
    let cases: Vec<(serde_json::Map<String, Value>, String)> =
        serde_json::from_str(CONTRADICTIONS).unwrap();
    let mut wrong = Vec::new();
    for (changes, key) in cases {
        let mut scene = serde_json::to_value(Scene::paper().file()).unwrap();
        changes
            .into_iter()
            .for_each(|(path, value)| put(&mut scene, &path, value));
        let message = refusal(&scene);
        if !message.starts_with(&format!("{key} is ")) {
            wrong.push(format!("{key}: {message}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Numbers that JSON does not have, from the library.
#[test]
fn what_is_no_number_is_refused_by_its_key() {
    let thick = Scene::paper()
        .edited(|file| file.blade.thickness_m = f64::NAN)
        .unwrap_err();
    assert!(
        thick
            .to_string()
            .starts_with("blade.thickness_m is no finite number, but must be "),
        "{thick}"
    );
    let off = Scene::paper()
        .edited(|file| file.guides[0].offset_m = f64::NAN)
        .unwrap_err();
    assert!(
        off.to_string()
            .starts_with("guides[0].offset_m is no finite number, but must be "),
        "{off}"
    );
}
