//! Goal: saws that are compared have the results that each has alone.
//!
//! Independent values: the report of each saw alone, of the same file with the numbers typed in; the stiffness at the rim that
//! `check` reports.

use sawflutter::analyses::campbell::Report;
use sawflutter::analyses::check::CheckReport;
use sawflutter::analyses::compare::CompareReport;
use sawflutter::model::scene::{Accuracy, Scene, SceneFile, SweepFile};
use tempfile::TempDir;

use super::program::{assert_refused, names_in, out, run, sawflutter, text, written};

fn saw() -> SceneFile {
    let mut file = Scene::paper().file().clone();
    file.accuracy = Accuracy::Draft;
    file.measured = None;
    file.operating_rpm = Some(1250.0);
    file.sweep = Some(SweepFile {
        from_rpm: 0.0,
        to_rpm: 2000.0,
    });
    file
}

fn write(folder: &TempDir, name: &str, file: &SceneFile) -> String {
    let path = folder.path().join(name);
    std::fs::write(&path, serde_json::to_string_pretty(file).unwrap()).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn a_comparison_has_the_results_of_each_saw_alone() {
    let folder = TempDir::new().unwrap();
    let mut thin = saw();
    thin.blade.thickness_m = 0.0026;
    let (first, second) = (
        write(&folder, "a.json", &saw()),
        write(&folder, "b.json", &thin),
    );
    let output = run(
        &[
            "compare",
            &first,
            &second,
            "--variant",
            "blade.thickness_m=2.6mm",
        ],
        &folder,
    );
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let names = names_in(&out(&folder));
    assert_eq!(names, ["compare.json", "compare.png", "compare.svg"]);
    let compared: CompareReport = written(&folder, "compare.json");
    let names: Vec<&str> = compared.saws.iter().map(|saw| saw.name.as_str()).collect();
    assert_eq!(names, ["a", "b", "thickness_m=2.6mm"]);
    let [difference] = &compared.differences[..] else {
        panic!("{:?}", compared.differences)
    };
    assert_eq!(difference.path, "blade.thickness_m");
    assert_eq!(difference.values, ["0.0028", "0.0026", "0.0026"]);

    let alone = TempDir::new().unwrap();
    for (path, of) in [
        (&first, &compared.saws[0]),
        (&second, &compared.saws[1]),
        (&second, &compared.saws[2]),
    ] {
        assert!(run(&["analyze", path], &alone).status.success());
        let report: Report = written(&alone, "report.json");
        assert_eq!(of.critical_speeds, report.critical_speeds);
        assert_eq!(of.instabilities, report.instabilities);
        assert_eq!(of.operating, report.operating);
        let output = sawflutter()
            .args(["check", path, "--json"])
            .output()
            .unwrap();
        let check: CheckReport = serde_json::from_slice(&output.stdout).unwrap();
        let stiffness = of.rim_stiffness_at_rest_n_per_m.unwrap();
        let expected = check.rim_stiffness_at_rest_n_per_m;
        assert!(
            (stiffness / expected - 1.0).abs() < 1e-3,
            "{stiffness} {expected}"
        );
    }

    // Reports of earlier runs are compared as well.
    let report = out(&alone).join("report.json");
    let with_report = run(
        &["compare", report.to_str().unwrap(), &first, "--json"],
        &folder,
    );
    let of_report: CompareReport = serde_json::from_slice(&with_report.stdout).unwrap();
    assert_eq!(of_report.saws[0].name, "out");
    assert_eq!(
        of_report.saws[0].instabilities,
        compared.saws[1].instabilities
    );
}

#[test]
fn scenes_without_a_sweep_are_charted_over_the_same_speeds() {
    let folder = TempDir::new().unwrap();
    let mut free = crate::common::scene("free-blade").file().clone();
    free.accuracy = Accuracy::Draft;
    free.sweep = None;
    let path = write(&folder, "free.json", &free);
    let output = run(
        &[
            "compare",
            &path,
            "--variant",
            "blade.thickness_m=4mm",
            "--json",
        ],
        &folder,
    );
    let compared: CompareReport = serde_json::from_slice(&output.stdout).unwrap();
    let ends: Vec<f64> = compared
        .saws
        .iter()
        .map(|saw| saw.campbell.to_rpm)
        .collect();
    assert_eq!(ends[0], ends[1]);
    // The first critical speed is proportional to the thickness, and the range ends at twice that of the faster saw.
    let critical: Vec<f64> = compared
        .saws
        .iter()
        .map(|saw| saw.critical_speeds[0].rpm)
        .collect();
    let thicker = 0.004 / free.blade.thickness_m;
    assert!(
        (critical[1] / critical[0] / thicker - 1.0).abs() < 1e-3,
        "{critical:?}"
    );
    assert!(ends[0] >= 2.0 * critical[1] && ends[0] < 2.2 * critical[1]);
}

#[test]
fn invalid_comparisons_are_refused() {
    let folder = TempDir::new().unwrap();
    let path = write(&folder, "a.json", &saw());
    for (arguments, words) in [
        (vec!["compare", &path], "a comparison needs two"),
        (
            vec!["compare", &path, "--variant", "thickness=2mm"],
            "--variant thickness=2mm was refused",
        ),
        (
            vec!["compare", &path, "--variant", "blade.thickness_m=2N"],
            "a number in m",
        ),
        (
            vec!["compare", &path, "--variant", "blade.thickness_m=+5%"],
            "give the new number itself, not its change in percent",
        ),
    ] {
        assert_refused(&arguments, words, &folder);
        assert!(!out(&folder).exists());
    }
}
