//! The figures of the cut and of the run-up, drawn from reports made up for it.

use super::tidy::{assert_tidy, texts};
use super::{cut, cut_map, response_map, runup, spline_orbit};
use crate::report::{CutReport, Report, RunUpReport};
use crate::scene::{Accuracy, CutRun, RunUp, Scene, SpeedRange, rad_per_s};
use crate::transient::{Cutting, RunningUp};

/// As many speeds as make two rows.
fn cut_report(scene: &Scene) -> CutReport {
    let cut = scene.cut().unwrap();
    let runs = [1800.0, 2800.0, 2600.0].map(|rpm| cut.at_rpm(rpm).unwrap());
    let cutting = Cutting::new(scene, cut, &runs, &|_, _| ()).unwrap();
    CutReport::new(scene, &cutting)
}

fn draft() -> Scene {
    let scene = Scene::from_json(include_str!("../../scenes/paper-spline.json")).unwrap();
    scene.edited(|saw| saw.accuracy = Accuracy::Draft).unwrap()
}

#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn the_figures_of_a_cut_are_tidy_and_say_the_verdict() {
    let report = cut_report(&draft());
    let sheet = cut::sheet(&report);
    assert_tidy(&sheet);
    for (run, word) in report.runs.iter().zip(["stable", "unstable", "unstable"]) {
        let title = format!("{:.0} rpm: {} in the cut", run.rpm, run.verdict);
        assert!(
            texts(&sheet).iter().any(|(_, text)| *text == title),
            "{title} {word}"
        );
    }
    assert_tidy(&cut_map::sheet(&report));
    assert_tidy(&spline_orbit::sheet(&report).unwrap());
}

#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn without_a_lateral_force_the_figure_is_a_flat_line() {
    let scene = draft();
    let cut = scene.cut().unwrap();
    let run = CutRun {
        lateral_n: 0.0,
        ..cut.at_rpm(2800.0).unwrap()
    };
    let cutting = Cutting::new(&scene, cut, &[run], &|_, _| ()).unwrap();
    let report = CutReport::new(&scene, &cutting);
    assert_eq!(report.runs[0].transient_verdict, None);
    assert!(
        report
            .warnings
            .iter()
            .any(|w| w.contains("cut.lateral_n_per_tooth"))
    );
    assert_tidy(&cut::sheet(&report));
}

#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn the_figures_of_a_run_up_are_tidy() {
    let paper = Scene::paper();
    let scene = paper.edited(|saw| saw.accuracy = Accuracy::Draft).unwrap();
    let runup = RunUp {
        speeds: SpeedRange {
            from_rad_per_s: 0.0,
            to_rad_per_s: rad_per_s(2000.0),
        },
        duration_s: 10.0,
        ..*scene.runup().unwrap()
    };
    let found = RunningUp::new(&scene, &runup, &|_, _| ()).unwrap();
    let report = RunUpReport::new(&scene, &runup, &found).unwrap();
    assert_tidy(&runup::sheet(&report));
    assert_tidy(&response_map::sheet(&report));
    let chart = Report::new(&scene, &found.analysis).unwrap();
    assert_eq!(chart.instabilities.len(), report.bands.len());
}
