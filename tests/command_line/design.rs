//! Goal: the output of `fit` and `place` is reliable for the person or script that runs them.
//!
//! Source: `--help` and docs/how-to.

use crate::common::says;
use std::path::PathBuf;

use sawflutter::analyses::check::CheckReport;
use sawflutter::analyses::fit::FitReport;
use sawflutter::analyses::place::{Neighbour, PlaceReport};
use sawflutter::model::scene::Scene;
use tempfile::TempDir;

use super::program::{assert_in_80_columns, assert_refused, names_in, out, run, text, written};

fn read(folder: &TempDir, name: &str) -> String {
    std::fs::read_to_string(out(folder).join(name)).unwrap()
}

fn scene() -> String {
    concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/paper.json").to_owned()
}

fn table(folder: &TempDir, content: &str) -> String {
    let path: PathBuf = folder.path().join("measured.csv");
    std::fs::write(&path, content).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn a_check_draws_its_limits_where_it_is_asked_to() {
    let folder = TempDir::new().unwrap();
    let arguments = [
        "check",
        "--accuracy",
        "draft",
        "--rpm",
        "1250",
        "--min-flutter",
        "2800",
        "--json",
    ];
    let output = run(&arguments, &folder);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    assert_eq!(
        names_in(&out(&folder)),
        ["check.json", "check.png", "check.svg"]
    );
    let printed: CheckReport = serde_json::from_str(text(&output.stdout)).unwrap();
    assert_eq!(printed, written::<CheckReport>(&folder, "check.json"));
    let kept: Vec<_> = printed
        .verdict
        .limits
        .iter()
        .map(|c| (c.key.as_str(), c.is_kept()))
        .collect();
    let expected = [
        ("operating", true),
        ("critical", true),
        ("margin", true),
        ("min_flutter", false),
        ("rim_speed", true),
        ("held", true),
    ];
    assert_eq!(kept, expected);
    assert!(!printed.passed && printed.critical_rpm.len() == 6);
    assert!(read(&folder, "check.svg").contains("FAIL flutter speed of at least 2800 rpm"));
}

/// Numbers of the paper's Table 5, without one of them.
const TABLE: &str = "rpm,f1,f2,f3,f4\n0,9,10.5,26,43\n500,4.5,15.5,28,\n1000,3,13.5,26.5,40.5\n";

#[test]
fn a_table_is_fitted_and_the_scene_it_gives_can_be_used() {
    let folder = TempDir::new().unwrap();
    let measured = table(&folder, TABLE);
    let arguments = [
        "fit",
        &scene(),
        &measured,
        "--accuracy",
        "draft",
        "--starts",
        "3",
        "--free",
        "guides[0].radius_m=0.12..0.3",
        "--free",
        "guides[0].stiffness_n_per_m",
    ];
    let output = run(&arguments, &folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let expected = ["fit.json", "fit.png", "fit.svg", "fitted-scene.json"];
    assert_eq!(names_in(&out(&folder)), expected);
    let summary = text(&output.stdout);
    assert_in_80_columns(summary);
    assert!(
        summary.contains("Fitted to 11 frequencies (measured.csv)"),
        "{summary}"
    );
    let report: FitReport = written(&folder, "fit.json");
    assert_eq!(
        (report.measured_frequencies, report.degrees_of_freedom),
        (11, 9)
    );
    let squares: f64 = report
        .residuals
        .iter()
        .map(|r| (r.fitted_hz - r.measured_hz).powi(2))
        .sum();
    assert!(((squares / 11.0).sqrt() - report.rms_hz).abs() < 1e-6);
    let fitted = Scene::from_json(&read(&folder, "fitted-scene.json")).unwrap();
    assert_eq!(*fitted.file(), report.scene);
    assert_eq!(fitted.file().guides[0].radius_m, report.parameters[0].value);
}

#[test]
fn a_table_that_cannot_be_fitted_is_refused_and_nothing_is_written() {
    let cases: [(&str, &[&str], &str); 9] = [
        ("rpm,f\n0,x\n", &[], "line 2"),
        ("rpm,f\n", &[], "no frequency in measured.csv"),
        (TABLE, &["--to", "-1"], "--to must be … (you gave -1)"),
        (
            TABLE,
            &["--confidence", "1"],
            "--confidence must be … (you gave 1)",
        ),
        (TABLE, &["--starts", "0"], "--starts must be … (you gave 0)"),
        (
            TABLE,
            &["--free", "guides[3].radius_m"],
            "guides[3].radius_m",
        ),
        (TABLE, &["--free", "guides[0].radius_m=0.3"], "0.15..0.3"),
        (
            TABLE,
            &["--free", "guides[0].radius_m=0.3..0.2"],
            "from a number to a larger",
        ),
        (TABLE, &["--free", "guides[0].angle_deg"], "no free number"),
    ];
    for (content, more, expected) in cases {
        let folder = TempDir::new().unwrap();
        let measured = table(&folder, content);
        let scene = scene();
        let mut arguments = vec!["fit", &scene, &measured, "--accuracy", "draft"];
        arguments.extend(more);
        assert_refused(&arguments, expected, &folder);
        assert_eq!(names_in(&out(&folder)), Vec::<String>::new(), "{more:?}");
    }
}

/// Draft accuracy, a narrow range of radii and few saws: the test checks the texts and not the quality of the optimum.
const QUICK: [&str; 10] = [
    "--accuracy",
    "draft",
    "--free",
    "guides[0].radius_m=0.195..0.205",
    "--samples",
    "3",
    "--refine",
    "4",
    "--map",
    "2",
];

#[test]
fn a_place_is_found_and_written() {
    let folder = TempDir::new().unwrap();
    let scene = scene();
    let mut arguments = vec!["place", &scene];
    arguments.extend(QUICK);
    let output = run(&arguments, &folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let expected = [
        "place-log.jsonl",
        "place.json",
        "place.png",
        "place.svg",
        "placed-scene.json",
    ];
    assert_eq!(names_in(&out(&folder)), expected);
    assert_in_80_columns(text(&output.stdout));
    let report: PlaceReport = written(&folder, "place.json");
    let goal = |saw: &Neighbour| saw.outcome.unwrap().goal_rpm;
    let worst = report.worst_neighbour.as_ref().unwrap();
    assert!(report.kept && goal(worst) >= goal(&report.worst_before));
    let summary = text(&output.stdout).replace("\n  ", " ");
    let certificate = &report.certificate;
    let checks = certificate.speeds_checked + certificate.full_basis_counts;
    let said = format!("all {checks} independent checks agree");
    assert!(certificate.is_clean && summary.contains(&said), "{summary}");
    assert_eq!(report.best.flutter_rpm, Some(report.best.goal_rpm));
    let placed = Scene::from_json(&read(&folder, "placed-scene.json")).unwrap();
    assert_eq!(placed.file().guides[0].radius_m, report.parameters[0].value);
}

#[test]
fn the_exit_code_says_whether_the_limit_is_kept_or_the_input_refused() {
    let cases: [(&[&str], i32, &str); 5] = [
        (&["--min-critical", "9000"], 1, "misses it by"),
        (
            &["--min-critical", "-9"],
            2,
            "--min-critical was refused: limits.min_critical_rpm must be … (you gave -9)",
        ),
        (&["--map", "1"], 2, "--map must be … (you gave 1)"),
        (&["--samples", "0"], 2, "--samples must be … (you gave 0)"),
        (
            &["--radius-tolerance", "-2mm"],
            2,
            "--radius-tolerance must be from 0 to 0.1 … (you gave -0.002)",
        ),
    ];
    for (more, code, expected) in cases {
        let folder = TempDir::new().unwrap();
        let scene = scene();
        let mut arguments = vec!["place", &scene];
        // Removes an option from the defaults if the test gives it, because clap does not accept every option twice.
        let quick = QUICK.chunks(2).filter(|pair| !more.contains(&pair[0]));
        arguments.extend(quick.flatten());
        arguments.extend(more);
        let output = run(&arguments, &folder);
        let said = format!("{}{}", text(&output.stdout), text(&output.stderr));
        assert_eq!(output.status.code(), Some(code), "{more:?}: {said}");
        assert!(
            says(&said.replace("\n  ", " "), expected),
            "{more:?}: {said}"
        );
    }
}
