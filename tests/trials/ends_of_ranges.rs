//! Both ends of the allowed range of each number of a small saw are computed in a limited time, or refused at once.

use std::time::{Duration, Instant};

use sawflutter::model::scene::Quantity;
use serde_json::{Map, Value, json};
use tempfile::TempDir;

use crate::program::sawflutter;
use crate::trial::{Trial, mine};

/// Time for a small saw at draft accuracy, also on a busy machine.
const COMPUTED: Duration = Duration::from_secs(60);
/// Time for a refusal, most of which is the start of the program.
const REFUSED: Duration = Duration::from_secs(5);

/// Parts of a scene that together have its numbers, each with the command that uses them.
const PARTS: &str = include_str!("../refusals/ends.json");

fn small_saw() -> Value {
    json!({
        "name": "small", "accuracy": "draft",
        "blade": { "outer_diameter_m": 0.3, "inner_diameter_m": 0.03, "thickness_m": 0.0022, "teeth": 24,
            "material": { "youngs_modulus_pa": 2.1e11, "poisson_ratio": 0.3, "density_kg_per_m3": 7850.0 } },
        "mount": { "kind": "collar", "diameter_m": 0.1, "in_plane": "free" },
        "guides": [{ "radius_m": 0.12, "angle_deg": -40.0, "radial_length_m": 0.04, "tangential_length_m": 0.04,
            "stiffness_n_per_m": 1e6 }]
    })
}

/// Pointers of all numbers below a value.
fn numbers(value: &Value, pointer: &str, found: &mut Vec<String>) {
    match value {
        Value::Object(entries) => {
            for (key, inner) in entries {
                numbers(inner, &format!("{pointer}/{key}"), found);
            }
        }
        Value::Array(items) => {
            for (k, inner) in items.iter().enumerate() {
                numbers(inner, &format!("{pointer}/{k}"), found);
            }
        }
        Value::Number(_) => found.push(pointer.to_owned()),
        _ => (),
    }
}

/// The path of a pointer, `guides[0].radius_m` for `/guides/0/radius_m`.
fn path(pointer: &str) -> String {
    let steps = pointer.split('/').skip(1);
    let path = steps.fold(String::new(), |path, step| {
        if step.parse::<usize>().is_ok() {
            format!("{path}[{step}]")
        } else {
            format!("{path}.{step}")
        }
    });
    path.trim_start_matches('.').to_owned()
}

#[test]
#[ignore = "a trial"]
fn both_ends_of_every_range_are_computed_or_refused_in_time() {
    let mut trial = Trial::new("ends of allowed ranges");
    let parts: Vec<(String, Map<String, Value>)> = serde_json::from_str(PARTS).unwrap();
    let mut known: Vec<String> = Vec::new();
    let mut cases = Vec::new();
    for (command, part) in parts {
        let mut scene = small_saw();
        for (key, value) in part {
            let (holder, key) = key.rsplit_once('.').unwrap_or(("", &key));
            let holder = if holder.is_empty() {
                String::new()
            } else {
                format!("/{}", holder.replace('.', "/"))
            };
            scene.pointer_mut(&holder).unwrap()[key] = value;
        }
        let mut pointers = Vec::new();
        numbers(&scene, "", &mut pointers);
        for pointer in pointers {
            let quantity = Quantity::of(&path(&pointer)).unwrap();
            // Damping with an arm and without is not the same model, so that numbers of a pad are tried in both.
            if known.contains(&pointer) {
                continue;
            }
            known.push(pointer.clone());
            let is_whole = scene.pointer(&pointer).is_some_and(Value::is_u64);
            for end in [quantity.allowed.from, quantity.allowed.to] {
                let mut scene = scene.clone();
                *scene.pointer_mut(&pointer).unwrap() = if is_whole {
                    json!(end as u64)
                } else {
                    json!(end)
                };
                cases.push((
                    command.clone(),
                    format!("{} = {end:e}", path(&pointer)),
                    scene,
                ));
            }
        }
    }
    assert!(known.len() > 55, "{}", known.len());
    for (command, what, scene) in mine(cases) {
        trial.saw(&what, || {
            let folder = TempDir::new().unwrap();
            let file = folder.path().join("scene.json");
            std::fs::write(&file, scene.to_string()).unwrap();
            let begun = Instant::now();
            let mut program = sawflutter();
            let program = program.timeout(COMPUTED).arg(&command).arg(&file);
            let output = program.arg("--out").arg(folder.path().join("out"));
            let output = output.output().unwrap();
            match output.status.code() {
                Some(0) => Vec::new(),
                Some(2) if begun.elapsed() < REFUSED => Vec::new(),
                code => vec![format!("exit code {code:?} after {:?}", begun.elapsed())],
            }
        });
    }
    trial.end();
}
