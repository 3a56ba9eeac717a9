//! Goal: `deflect` says in every face where the blade stands, and refuses what it cannot answer.
//!
//! Source: `--help`, docs/how-to/deflect.md.

use sawflutter::report::DeflectReport;
use tempfile::TempDir;

use super::program::{names_in, out, run, text};

#[test]
fn the_built_in_saw_leans_past_its_first_critical_speed() {
    let folder = TempDir::new().unwrap();
    let options = ["--force-n", "2", "--to-rpm", "1700", "--accuracy", "draft"];
    let output = run(&[&["deflect"], &options[..]].concat(), &folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let expected = ["deflect.json", "deflect.png", "deflect.svg"];
    assert_eq!(names_in(&out(&folder)), expected);
    let summary = text(&output.stdout);
    for line in summary.lines() {
        assert!(
            line.chars().count() <= 80 || line.starts_with("Written"),
            "{line}"
        );
    }
    let json = std::fs::read(folder.path().join("out/deflect.json")).unwrap();
    assert!(!text(&json).contains("NaN"));
    let report: DeflectReport = serde_json::from_slice(&json).unwrap();
    let critical = report.critical_speeds[0].rpm;
    let beyond = report.beyond_thickness_rpm.unwrap();
    assert!(
        (0.95 * critical..1.05 * critical).contains(&beyond),
        "{beyond}"
    );
    assert!(
        summary.contains(&format!("up to {beyond:.0} rpm")),
        "{summary}"
    );
    let [first, last] = [report.up.arcs.first(), report.up.arcs.last()].map(Option::unwrap);
    assert_eq!(first.rpm[0], 0.0);
    assert!((last.rpm.last().unwrap() - 1700.0).abs() < 1e-6);
    // At rest the frequencies are those of the linear model, up to what the force stretches.
    let at_rest = report.campbell.branches[0].frequency_hz[0];
    assert!((first.frequencies_hz[0][0] / at_rest - 1.0).abs() < 1e-2);
}

#[test]
fn a_force_or_a_saw_without_an_answer_is_refused() {
    let folder = TempDir::new().unwrap();
    for (options, said) in [
        (&["--force-n", "1e9"][..], "--force-n"),
        (&["--angle-deg", "inf"], "--angle-deg"),
        (&["--to-rpm", "-5"], "--to-rpm"),
    ] {
        let output = run(&[&["deflect"], options].concat(), &folder);
        assert_eq!(output.status.code(), Some(2));
        assert!(
            text(&output.stderr).contains(said),
            "{}",
            text(&output.stderr)
        );
    }
    let free = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/free-blade.json");
    let output = run(&["deflect", free, "--accuracy", "draft"], &folder);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        text(&output.stderr).contains("add a guide"),
        "{}",
        text(&output.stderr)
    );
    assert!(!folder.path().join("out").exists());
}
