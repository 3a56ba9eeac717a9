//! Cuts under forces that no saw tolerates.
#![allow(dead_code)]

use sawflutter::analyses::cut::{CutCriterion, CutReport, CutStability};
use sawflutter::model::scene::{CutSpeedFile, Scene, SceneFile};
use tempfile::TempDir;

use crate::program::{assert_in_80_columns, run, text, write_scene};

/// The printed text and the written file of a run.
pub fn done(command: &str, file: &SceneFile) -> (String, Vec<u8>) {
    let folder = TempDir::new().unwrap();
    // The texts do not depend on the accuracy of the result.
    let file = SceneFile {
        tolerance: Some(0.05),
        ..file.clone()
    };
    let scene = write_scene(&folder, &file);
    let arguments = [command, scene.to_str().unwrap(), "--accuracy", "draft"];
    let output = run(&arguments, &folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let json = std::fs::read(folder.path().join(format!("out/{command}.json"))).unwrap();
    (text(&output.stdout).to_owned(), json)
}

/// The paper's saw under a force at 2800 rpm.
pub fn pressed(tangential_n: f64) -> SceneFile {
    let mut file = Scene::paper().file().clone();
    let cut = file.cut.as_mut().unwrap();
    cut.tangential_n_per_tooth = Some(tangential_n);
    cut.speeds = vec![CutSpeedFile {
        rpm: 2800.0,
        ..CutSpeedFile::default()
    }];
    file
}

/// Three computations give the same growth: the eigenvalues, the fitted history, and the Floquet multipliers of the
/// loads.
pub fn assert_unstable(tangential_n: f64) {
    let (summary, json) = done("cut", &pressed(tangential_n));
    assert_in_80_columns(&summary);
    let report: CutReport = serde_json::from_slice(&json).unwrap();
    let run = &report.runs[0];
    assert_eq!(run.stability, CutStability::Unstable, "{tangential_n}");
    let violent = |c: CutCriterion| c != CutCriterion::OutOfCut;
    for row in run.criteria.iter().filter(|row| violent(row.criterion)) {
        let apart = (row.growth_per_s / run.growth_per_s - 1.0).abs();
        assert!(apart < 0.05, "{tangential_n}: {row:?} {}", run.growth_per_s);
    }
    assert_eq!(run.agree, Some(true), "{tangential_n}");
}
