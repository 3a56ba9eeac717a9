//! Goal: every scene that comes with the program is one that the program accepts,
//! says where its numbers come from, and reads back as it was written.

use std::path::{Path, PathBuf};

use sawflutter::scene::{Scene, SceneFile, json_schema};
use sawflutter::study::{self, Study, StudyFile, StudyReport};

/// Every file in `scenes/` and in its gallery, by name.
fn scene_paths() -> Vec<PathBuf> {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let mut paths: Vec<PathBuf> = [scenes.join("gallery"), scenes]
        .iter()
        .flat_map(|folder| std::fs::read_dir(folder).expect("a folder of scenes"))
        .map(|entry| entry.expect("a readable entry").path())
        .filter(|path| path.is_file())
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
    let paper = serde_json::to_value(Scene::paper().file()).unwrap();
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
        assert!(!scene.file().notes.is_empty(), "{}", path.display());
        let written = serde_json::to_string_pretty(scene.file()).unwrap();
        let file: SceneFile = serde_json::from_str(&written).unwrap();
        assert_eq!(file, *scene.file(), "{}", path.display());
        let again = Scene::from_json(&written).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(again, scene, "{}", path.display());
    }
}

/// The embedded default is the file that users can read.
#[test]
fn the_built_in_saw_is_the_papers() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/paper.json");
    assert_eq!(
        Scene::from_path(path).unwrap_or_else(|error| panic!("{error}")),
        Scene::paper()
    );
}

/// Every study that comes with the program suits the scene that its name begins with.
#[test]
fn every_study_suits_its_scene_and_the_schema() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let schema = study::json_schema();
    let validator = jsonschema::validator_for(&schema).expect("the schema is a JSON schema");
    let studies: Vec<_> = std::fs::read_dir(folder.join("studies"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    assert!(!studies.is_empty());
    for path in studies {
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(validator.is_valid(&serde_json::from_str(&text).unwrap()));
        let file = StudyFile::from_json(&text).unwrap_or_else(|error| panic!("{error}"));
        assert!(!file.notes.is_empty(), "{}", path.display());
        let stem = path.file_stem().unwrap().to_string_lossy().into_owned();
        let scene = scene_paths().into_iter().find(|scene| {
            let name = scene.file_stem().unwrap().to_string_lossy().into_owned();
            stem.starts_with(&format!("{name}-"))
        });
        let scene = Scene::from_path(scene.expect("a scene of this name")).unwrap();
        let study = Study::new(scene, file).unwrap_or_else(|error| panic!("{error}"));
        assert!(study.count() > 1);
    }
    for bad in [
        r#"{"name": "x"}"#,
        r#"{"name": "x", "parameters": [], "points": 3}"#,
        r#"{"name": "x", "parameters": [{"path": "y", "distribution": {"kind": "even"}}]}"#,
        r#"{"name": "x", "parameters": [{"path": "y", "distribution":
            {"kind": "tolerance", "plus_minus": 1, "to": 2}}]}"#,
    ] {
        assert!(
            !validator.is_valid(&serde_json::from_str(bad).unwrap()),
            "{bad}"
        );
        assert!(StudyFile::from_json(bad).is_err(), "{bad}");
    }
}

/// The gallery draws it, for it takes minutes to make.
#[test]
fn the_stored_report_is_of_the_sample_study_and_the_papers_saw() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |inside: &str| std::fs::read_to_string(root.join(inside)).unwrap();
    let report: StudyReport = serde_json::from_str(&read("figures/paper-study.json")).unwrap();
    let study = StudyFile::from_json(&read("scenes/studies/paper-tolerances.json")).unwrap();
    assert_eq!(report.study, study);
    // By --tolerance, as docs/tutorials/thousand-saws.md says.
    let mut paper = Scene::paper().file().clone();
    paper.tolerance = Some(6e-3);
    assert_eq!(report.scene, paper);
    assert_eq!(report.sawflutter, env!("CARGO_PKG_VERSION"));
    assert_eq!(report.all.saws, study.saws.unwrap() as usize);
}
