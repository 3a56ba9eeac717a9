//! Goal: the output of `cut` and `runup` is reliable for the person or script that runs them.
//!
//! Source: `--help`, docs/explanation/paper.md, and the paper's verdicts (section 3.2).

use crate::common::says;
use sawflutter::analyses::cut::{CutReport, CutStability};
use sawflutter::analyses::runup::RunUpReport;
use sawflutter::model::scene::{Accuracy, RunUpFile, Scene, SceneFile};
use tempfile::TempDir;

use super::program::{
    assert_in_80_columns, names_in, out, run, sawflutter, text, write_scene, written,
};

#[test]
fn the_built_in_cut_is_stable_at_1800_and_unstable_at_2800() {
    let folder = TempDir::new().unwrap();
    let output = run(&["cut", "--details"], &folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let expected_files = [
        "cut-map.png",
        "cut-map.svg",
        "cut.json",
        "cut.png",
        "cut.svg",
    ];
    assert_eq!(names_in(&out(&folder)), expected_files);
    let summary = text(&output.stdout);
    assert!(
        summary.contains("UNSTABLE") && summary.contains("agrees"),
        "{summary}"
    );
    assert_in_80_columns(summary);
    let report: CutReport = written(&folder, "cut.json");
    let verdicts: Vec<(f64, CutStability, Option<bool>)> = report
        .runs
        .iter()
        .map(|run| (run.rpm, run.stability, run.agree))
        .collect();
    let expected = [
        (1800.0, CutStability::Stable, Some(true)),
        (2800.0, CutStability::Unstable, Some(true)),
    ];
    assert_eq!(verdicts, expected);
    // The certificate of each speed, in text and JSON, with as many growing modes as the verdict states.
    let in_one_line = summary.split_whitespace().collect::<Vec<_>>().join(" ");
    for (run, growing) in report.runs.iter().zip([0, 1]) {
        let certificate = &run.certificate;
        assert!(certificate.is_clean(), "{certificate:?}");
        let modes = [certificate.growing_modes, certificate.idle_growing_modes];
        assert_eq!(modes, [growing, 0]);
        assert!(certificate.full_basis_counts > 2, "{certificate:?}");
        assert!(in_one_line.contains(&certificate.statement), "{summary}");
    }
}

#[test]
fn a_speed_on_the_command_line_replaces_that_of_the_scene() {
    let folder = TempDir::new().unwrap();
    let arguments = ["cut", "--rpm", "2800", "--accuracy", "draft", "--json"];
    let output = run(&arguments, &folder);
    let report: CutReport = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report.runs.len(), 1);
    assert_eq!(report.scene.accuracy, Accuracy::Draft);
}

/// The speed is given as 1.8 instead of 1800.
#[test]
fn a_speed_in_another_unit_is_warned_of() {
    let folder = TempDir::new().unwrap();
    let output = run(&["cut", "--rpm", "1.8", "--json"], &folder);
    let report: CutReport = serde_json::from_slice(&output.stdout).unwrap();
    let is_said = |w: &String| w.contains("thousands of rpm? That would be 1800 rpm");
    let unusual = &report.unusual_numbers;
    assert!(unusual.iter().any(is_said), "{unusual:?}");
}

#[test]
fn a_run_up_lists_every_band_it_passes() {
    let folder = TempDir::new().unwrap();
    let mut file = Scene::paper().file().clone();
    file.runup = Some(RunUpFile {
        from_rpm: 1000.0,
        to_rpm: 2000.0,
        duration_s: 5.0,
        stretching: false,
    });
    let scene = write_scene(&folder, &file);
    let output = run(
        &["runup", scene.to_str().unwrap(), "--accuracy", "draft"],
        &folder,
    );
    assert!(output.status.success(), "{}", text(&output.stderr));
    let expected = [
        "response-map.png",
        "response-map.svg",
        "runup.json",
        "runup.png",
        "runup.svg",
    ];
    assert_eq!(names_in(&out(&folder)), expected);
    let report: RunUpReport = written(&folder, "runup.json");
    // The band of divergence near 1540 rpm is 21 rpm wide, and is passed at 200 rpm/s.
    let band = &report.bands[0];
    assert!((band.time_s - (band.band.to_rpm - band.band.from_rpm) / 200.0).abs() < 1e-9);
    let bound = band.band.peak_growth_per_s * band.time_s;
    assert!(band.growth_exponent > 0.5 * bound && band.growth_exponent < bound);
}

/// The error names the missing block, with exit code 2 and nothing written.
#[test]
fn a_scene_without_the_forces_is_refused() {
    type Case<'a> = (&'a [&'a str], &'a str, fn(&mut SceneFile));
    let cases: [Case<'_>; 7] = [
        (&["cut"], "cut is missing", |file| file.cut = None),
        (&["runup"], "runup is missing", |file| file.runup = None),
        (
            &["cut", "--rpm", "-5"],
            "rpm must be … (you gave -5)",
            |_| (),
        ),
        (
            &["cut", "--stretching"],
            "nothing holds the blade laterally",
            |file| file.guides.clear(),
        ),
        (
            &["runup", "--stretching"],
            "nothing holds the blade laterally",
            |file| file.guides.clear(),
        ),
        (&["cut"], "cut.speeds is missing", |file| {
            file.operating_rpm = None;
            file.cut.as_mut().unwrap().speeds.clear();
        }),
        (&["cut"], "cut.teeth_in_cut is missing", |file| {
            file.cut.as_mut().unwrap().depth_m = None;
        }),
    ];
    for (arguments, expected, change) in cases {
        let folder = TempDir::new().unwrap();
        let mut file = Scene::paper().file().clone();
        change(&mut file);
        let scene = write_scene(&folder, &file);
        let mut arguments = arguments.to_vec();
        arguments.insert(1, scene.to_str().unwrap());
        let output = run(&arguments, &folder);
        assert_eq!(output.status.code(), Some(2), "{expected}");
        let error = text(&output.stderr);
        assert!(says(error, expected), "{expected}: {error}");
        assert_eq!(names_in(&out(&folder)), Vec::<String>::new(), "{expected}");
    }
}

/// The exit code is the verdict, so that scripts need not read the text.
#[test]
fn a_check_passes_fails_or_is_refused() {
    let cases: [(&[&str], i32, &str); 8] = [
        (&["--rpm", "1200"], 0, "Can it run at 1200 rpm? YES: "),
        (&["--rpm", "1400"], 1, "RISK 85 % rule: 91"),
        (
            &["--rpm", "1400"],
            1,
            "Can it run at 1400 rpm? AT RISK: 91 % of the first critical speed",
        ),
        (&["--rpm", "1200", "--min-critical", "1600"], 1, "FAIL"),
        (
            &["--rpm", "1200", "--min-flutter", "2300"],
            1,
            "FAIL flutter speed of at least 2300 rpm: 22",
        ),
        // The flutter speed is that of `analyze`, also above a small limit.
        (
            &["--rpm", "1200", "--min-flutter", "1400"],
            0,
            "PASS flutter speed of at least 1400 rpm: 2256 rpm",
        ),
        (&["--rpm", "-3"], 2, "--rpm must be … (you gave -3)"),
        (
            &["--margin", "2"],
            2,
            "limits.margin must be … (you gave 2)",
        ),
    ];
    for (arguments, code, expected) in cases {
        let output = sawflutter()
            .args(["check", "--accuracy", "draft"])
            .args(arguments)
            .output()
            .unwrap();
        let said = format!("{}{}", text(&output.stdout), text(&output.stderr));
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {said}");
        assert!(says(&said, expected), "{arguments:?}: {said}");
    }
}
