//! Goal: every scene that comes with the program is one that the program accepts,
//! says where its numbers come from, and reads back as it was written.

use std::path::PathBuf;

use sawflutter::scene::{Scene, SceneFile, json_schema};

/// Every file in `scenes/`, by name.
fn scene_paths() -> Vec<PathBuf> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes");
    let mut paths: Vec<PathBuf> = std::fs::read_dir(folder)
        .expect("scenes/ is a folder")
        .map(|entry| entry.expect("a readable entry").path())
        .collect();
    paths.sort();
    // The paper's saw, the same blade unguided, a collar saw, a saw with two pads.
    assert!(paths.len() >= 4, "{paths:?}");
    paths
}

#[test]
fn every_scene_satisfies_the_schema() {
    let schema = json_schema();
    let validator = jsonschema::validator_for(&schema).expect("the schema is a JSON schema");
    for path in scene_paths() {
        let text = std::fs::read_to_string(&path).unwrap();
        let instance: serde_json::Value = serde_json::from_str(&text).unwrap();
        let errors: Vec<String> = validator
            .iter_errors(&instance)
            .map(|error| format!("{}: {error}", error.instance_path()))
            .collect();
        assert!(errors.is_empty(), "{}: {errors:?}", path.display());
    }
}

/// A schema that accepts everything would pass the test above.
#[test]
fn the_schema_refuses_what_the_program_refuses() {
    let schema = json_schema();
    let validator = jsonschema::validator_for(&schema).unwrap();
    let paper = serde_json::to_value(Scene::paper().file).unwrap();
    assert!(validator.is_valid(&paper));
    let with = |pointer: &str, key: &str, value: serde_json::Value| {
        let mut scene = paper.clone();
        let place = scene.pointer_mut(pointer).expect(pointer);
        place.as_object_mut().unwrap().insert(key.into(), value);
        scene
    };
    let bad = [
        ("unknown key", with("", "speed", 3.into())),
        ("unknown key below", with("/blade", "thicknes_m", 3.into())),
        ("wrong type", with("/blade", "thickness_m", "thin".into())),
        ("unknown mount", with("/mount", "kind", "glue".into())),
        ("unknown accuracy", with("", "accuracy", "perfect".into())),
    ];
    for (what, scene) in bad {
        assert!(!validator.is_valid(&scene), "{what} passes the schema");
        let refused = Scene::from_json(&scene.to_string());
        assert!(refused.is_err(), "{what} passes the program");
    }
}

#[test]
fn every_scene_loads_says_where_it_comes_from_and_round_trips() {
    for path in scene_paths() {
        let scene = Scene::from_path(&path).unwrap_or_else(|error| panic!("{error}"));
        assert!(!scene.file.notes.is_empty(), "{}", path.display());
        let written = serde_json::to_string_pretty(&scene.file).unwrap();
        let file: SceneFile = serde_json::from_str(&written).unwrap();
        assert_eq!(file, scene.file, "{}", path.display());
        let again = Scene::from_json(&written).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(again, scene, "{}", path.display());
    }
}

/// The embedded default is the file that users can read.
#[test]
fn the_built_in_saw_is_the_papers() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/paper.json");
    assert_eq!(
        Scene::from_path(path.as_ref()).unwrap_or_else(|error| panic!("{error}")),
        Scene::paper()
    );
}
