//! Goal: the program accepts every scene that it is published with; each states the source of its numbers and can be
//! written and read again. `python/tests/test_schema.py` tests that all of them satisfy the schemas, with another
//! project's validator.

use std::path::{Path, PathBuf};

use sawflutter::analyses::study::{Study, StudyFile, StudyReport};
use sawflutter::model::scene::{Scene, SceneFile};

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

/// The embedded default is the published file.
#[test]
fn the_built_in_saw_is_the_papers() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/paper.json");
    assert_eq!(
        Scene::from_path(path).unwrap_or_else(|error| panic!("{error}")),
        Scene::paper()
    );
}

/// Every published study fits the scene that its name begins with.
#[test]
fn every_study_suits_its_scene() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let studies: Vec<_> = std::fs::read_dir(folder.join("studies"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    assert!(!studies.is_empty());
    for path in studies {
        let text = std::fs::read_to_string(&path).unwrap();
        let file = StudyFile::from_json(&text).unwrap_or_else(|error| panic!("{error}"));
        assert!(!file.notes.is_empty(), "{}", path.display());
        let stem = path.file_stem().unwrap().to_string_lossy().into_owned();
        let path = scene_paths().into_iter().find(|scene| {
            let name = scene.file_stem().unwrap().to_string_lossy().into_owned();
            stem.starts_with(&format!("{name}-"))
        });
        let scene = Scene::from_path(path.expect("a scene of this name")).unwrap();
        let study = Study::new(scene, file).unwrap_or_else(|error| panic!("{error}"));
        assert!(study.count() > 1);
    }
}

/// The gallery draws this stored report, because it takes minutes to compute.
#[test]
fn the_stored_report_is_of_the_sample_study_and_the_papers_saw() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |inside: &str| std::fs::read_to_string(root.join(inside)).unwrap();
    let report: StudyReport = serde_json::from_str(&read("figures/paper-study.json")).unwrap();
    let study = StudyFile::from_json(&read("scenes/studies/paper-tolerances.json")).unwrap();
    assert_eq!(report.study, study);
    // The study was run with --tolerance, as docs/tutorials/thousand-saws.md describes.
    let mut paper = Scene::paper().file().clone();
    paper.tolerance = Some(6e-3);
    assert_eq!(report.scene, paper);
    assert_eq!(report.sawflutter, env!("CARGO_PKG_VERSION"));
    assert_eq!(report.all.saws, study.saws.unwrap() as usize);
}
