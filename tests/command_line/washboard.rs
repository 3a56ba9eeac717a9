//! Goal: the output of `washboard` is reliable for the person or script that runs it.
//!
//! Source: `--help` and docs/how-to/washboarding.md.

use crate::common::says;
use sawflutter::analyses::campbell::Verdict;
use sawflutter::analyses::washboard::WashboardReport;
use sawflutter::model::scene::{Accuracy, DampingFile, Mount, Scene, SceneFile, WashboardingFile};
use tempfile::TempDir;

use super::program::{assert_in_80_columns, names_in, out, run, text, write_scene, written};

fn resaw(change: impl FnOnce(&mut SceneFile)) -> SceneFile {
    let scene = include_str!("../../scenes/gallery/washboarding.json");
    let mut file = Scene::from_json(scene).unwrap().file().clone();
    (file.accuracy, file.tolerance) = (Accuracy::Draft, Some(0.1));
    change(&mut file);
    file
}

fn delayed(saw: &mut SceneFile) -> &mut WashboardingFile {
    let cut = saw.cut.as_mut().unwrap();
    cut.washboarding.as_mut().unwrap()
}

/// The verdict comes first, the files are written, and the JSON agrees with the text.
#[test]
fn the_verdict_comes_first_and_is_that_of_the_report() {
    let folder = TempDir::new().unwrap();
    let scene = write_scene(&folder, &resaw(|_| ()));
    let output = run(&["washboard", scene.to_str().unwrap()], &folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let expected = ["washboard.json", "washboard.png", "washboard.svg"];
    assert_eq!(names_in(&out(&folder)), expected);
    let summary = text(&output.stdout);
    let answer = summary.lines().nth(2).unwrap();
    assert!(answer.starts_with("2400 rpm: UNSTABLE"), "{summary}");
    assert_in_80_columns(summary);
    let report: WashboardReport = written(&folder, "washboard.json");
    assert_eq!(report.verdict, Verdict::Unstable);
    let mode = report.growing_mode().unwrap();
    assert!(
        summary.contains(&format!("{:.3} 1/s", mode.growth_per_s)),
        "{summary}"
    );
    let pitch = format!(
        "{:.1} mm along the feed",
        1e3 * mode.pattern_pitch_m.unwrap()
    );
    assert!(
        summary
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ")
            .contains(&pitch),
        "{summary}"
    );
    // Without the delayed force, and below the boundary, nothing grows.
    let small_path = write_scene(&folder, &resaw(|saw| delayed(saw).stiffness_n_per_m = 15e3));
    let small_output = run(
        &["washboard", small_path.to_str().unwrap(), "--json"],
        &folder,
    );
    let small: WashboardReport = serde_json::from_slice(&small_output.stdout).unwrap();
    assert_eq!(
        (small.verdict, small.growing_eigenvalues),
        (Verdict::Stable, Some(0))
    );
    assert!(small.critical_stiffness_n_per_m.unwrap() > 15e3);
}

/// Without a feed, or with unevenly spaced teeth, no pitch of washboarding is stated.
#[test]
fn an_unknown_pitch_is_left_out() {
    type Change = fn(&mut SceneFile);
    let cases: [(Change, &str); 2] = [
        (
            |saw| saw.cut.as_mut().unwrap().feed_m_per_s = None,
            "cut.feed_m_per_s",
        ),
        (
            |saw| delayed(saw).pitches_deg = vec![9.0, 11.0],
            "unevenly spaced",
        ),
    ];
    for (change, said) in cases {
        let folder = TempDir::new().unwrap();
        let scene = write_scene(&folder, &resaw(change));
        let output = run(&["washboard", scene.to_str().unwrap(), "--json"], &folder);
        let report: WashboardReport = serde_json::from_slice(&output.stdout).unwrap();
        assert!(
            report
                .modes
                .iter()
                .all(|mode| mode.pattern_pitch_m.is_none())
        );
        assert!(
            report.warnings.iter().any(|w| w.contains(said)),
            "{:?}",
            report.warnings
        );
    }
}

/// The error names the missing key, with exit code 2 and nothing written.
#[test]
fn a_missing_key_of_washboarding_is_named() {
    type Change = fn(&mut SceneFile);
    let cases: [(Change, &str); 8] = [
        (
            |saw| saw.blade.teeth = Some(400),
            "blade.teeth at 2400 rpm drive modes between 8000",
        ),
        (|saw| saw.cut = None, "cut is missing"),
        (
            |saw| saw.cut.as_mut().unwrap().washboarding = None,
            "cut.washboarding is missing",
        ),
        (|saw| saw.operating_rpm = None, "operating_rpm is missing"),
        (|saw| saw.damping = None, "damping is missing"),
        (
            |saw| {
                saw.damping = Some(DampingFile {
                    air_n_s_per_m3: 1e-6,
                    ..DampingFile::default()
                });
            },
            "damping is missing or too small",
        ),
        (
            |saw| saw.mount = Mount::Spline {},
            "the guides must hold the blade against every rigid motion",
        ),
        (
            |saw| delayed(saw).overlap = -0.1,
            "cut.washboarding.overlap must be … (you gave -0.1)",
        ),
    ];
    for (change, expected) in cases {
        let folder = TempDir::new().unwrap();
        let scene = write_scene(&folder, &resaw(change));
        let output = run(&["washboard", scene.to_str().unwrap()], &folder);
        assert_eq!(output.status.code(), Some(2), "{expected}");
        let error = text(&output.stderr);
        assert!(says(error, expected), "{expected}: {error}");
        assert_eq!(names_in(&out(&folder)), Vec::<String>::new(), "{expected}");
    }
}

/// The speed is given as 24 rpm instead of 2400 rpm.
#[test]
fn a_speed_in_another_unit_is_warned_of() {
    let folder = TempDir::new().unwrap();
    let scene = write_scene(&folder, &resaw(|_| ()));
    let arguments = [
        "washboard",
        scene.to_str().unwrap(),
        "--rpm",
        "24",
        "--json",
    ];
    let output = run(&arguments, &folder);
    let report: WashboardReport = serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|_| panic!("{}", text(&output.stderr)));
    let is_said = |w: &String| w.contains("the speed of the cut is 24 rpm");
    let unusual = &report.unusual_numbers;
    assert!(unusual.iter().any(is_said), "{unusual:?}");
}
