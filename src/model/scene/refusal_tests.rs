//! What is refused is named by its key, with its value and what is allowed.

use serde_json::{Value, json};

use super::quantities::QUANTITIES;
use super::{Kind, Quantity, Scene};
use crate::page::text::shown;

/// Puts a value at a path like `guides.0.gap_m`.
fn put(scene: &mut Value, path: &str, value: Value) {
    let (parent, key) = path.rsplit_once('.').unwrap_or(("", path));
    let holder = scene.pointer_mut(&pointer(parent)).unwrap();
    match key.parse::<usize>() {
        Ok(index) => holder[index] = value,
        Err(_) => holder[key] = value,
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

/// Parts of the paper's scene, each with its path, that together have every number of the table.
const COMPLETE: &str = include_str!("../../../tests/refusals/complete.json");
/// Numbers that contradict others: the changes of the scene, and the key that is refused.
const CONTRADICTIONS: &str = include_str!("../../../tests/refusals/contradictions.json");

/// The paper's scene with other values at some paths.
fn with(changes: impl IntoIterator<Item = (String, Value)>) -> Value {
    let mut scene = serde_json::to_value(Scene::paper().file()).unwrap();
    for (path, value) in changes {
        put(&mut scene, &path, value);
    }
    scene
}

/// Ends of a range, each with a number just inside and one just outside.
fn ends(quantity: &Quantity) -> [[f64; 2]; 2] {
    let allowed = quantity.allowed;
    if quantity.kind == Kind::Count {
        return [
            [allowed.from, allowed.from - 1.0],
            [allowed.to, allowed.to + 1.0],
        ];
    }
    let below = if allowed.is_open_below {
        [allowed.from.next_up(), allowed.from]
    } else {
        [allowed.from, allowed.from.next_down()]
    };
    let above = if allowed.is_open_above {
        [allowed.to.next_down(), allowed.to]
    } else {
        [allowed.to, allowed.to.next_up()]
    };
    [below, above]
}

/// A number just inside of its range is refused at most by a rule that joins it with other keys.
#[test]
fn every_number_out_of_its_range_is_refused_by_its_key() {
    let parts: Vec<(String, Value)> = serde_json::from_str(COMPLETE).unwrap();
    let scenes: Vec<Value> = parts.into_iter().map(|part| with([part])).collect();
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
        let put_there = |value: f64| {
            let mut scene = scene.clone();
            *scene.pointer_mut(&place).unwrap() = match quantity.kind {
                Kind::Count => json!(value as i64),
                _ => json!(value),
            };
            scene
        };
        for [inside, outside] in ends(quantity) {
            let file = Scene::file_from_json(&put_there(inside).to_string()).unwrap();
            if let Err(error) = file.check_numbers() {
                wrong.push(format!("{inside}: {error}"));
            }
            let bound = if outside > inside {
                quantity.allowed.to
            } else {
                quantity.allowed.from
            };
            let message = refusal(&put_there(outside));
            let is_negative_count = quantity.kind == Kind::Count && outside < 0.0;
            let is_right = if is_negative_count {
                let words = "must be a whole number, 0 or more (you gave -1)";
                message.starts_with(&format!("{key}: {words}"))
            } else {
                let names =
                    |range: &str| range.contains(&shown(bound)) || range.starts_with("above 0");
                let range = message
                    .strip_prefix(&format!("{key} must be "))
                    .and_then(|rest| rest.split_once(&format!(" (you gave {}); ", shown(outside))));
                range.is_some_and(|(range, _)| names(range))
            };
            if !is_right {
                wrong.push(format!("{key} {outside} {bound}: {message}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn numbers_that_contradict_others_are_refused_by_their_keys() {
    let cases: Vec<(serde_json::Map<String, Value>, String)> =
        serde_json::from_str(CONTRADICTIONS).unwrap();
    let mut wrong = Vec::new();
    for (changes, key) in cases {
        let message = refusal(&with(changes));
        let is_by_key = ["must be ", "is missing; "]
            .iter()
            .any(|words| message.starts_with(&format!("{key} {words}")));
        if !is_by_key {
            wrong.push(format!("{key}: {message}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Numbers that JSON does not have, from the library.
#[test]
fn what_is_no_number_is_refused_by_its_key() {
    let thick = Scene::paper().edited(|file| file.blade.thickness_m = f64::NAN);
    let off = Scene::paper().edited(|file| file.guides[0].offset_m = f64::INFINITY);
    for (key, edited) in [("blade.thickness_m", thick), ("guides[0].offset_m", off)] {
        let refused = edited.unwrap_err().to_string();
        let words = format!("{key} must be ");
        assert!(refused.starts_with(&words), "{refused}");
        assert!(
            refused.contains(" (you gave no finite number); "),
            "{refused}"
        );
    }
}

/// A diameter of 550 m, a pad and a head that no machine has, and a modulus in GPa are refused before any work, with the unit that may be
/// meant.
#[test]
fn numbers_beyond_physics_are_refused_with_the_unit_that_is_meant() {
    let cases = [
        (
            "blade.outer_diameter_m",
            json!(550.0),
            "are these mm? That would be 0.55 m",
        ),
        (
            "blade.material.youngs_modulus_pa",
            json!(210.0),
            "are these GPa? That would be 2.1e11 Pa",
        ),
        (
            "guides.0.stiffness_n_per_m",
            json!(1e15),
            "give a number in this range",
        ),
        (
            "guides.0.arm",
            json!({ "stiffness_n_per_m": 1e7, "mass_kg": 1e15 }),
            "give a number in this range",
        ),
        ("operating_rpm", json!(0.0), "give a number in this range"),
    ];
    for (path, value, remedy) in cases {
        let message = refusal(&with([(path.to_owned(), value)]));
        let key = path.replace(".0.", "[0].");
        let is_named = message.starts_with(&key) && message.contains(" must be ");
        assert!(is_named && message.contains(remedy), "{message}");
    }
}

#[test]
fn a_pad_that_is_typed_twice_is_refused() {
    let mut scene = with([]);
    let pad = scene["guides"][0].clone();
    scene["guides"] = json!([pad, pad]);
    let message = refusal(&scene);
    let said = "guides[1] must be another pad than guides[0]";
    assert!(message.starts_with(said), "{message}");
    scene["guides"][1]["angle_deg"] = json!(55.5);
    assert_eq!(refusal(&scene), "accepted");
}
