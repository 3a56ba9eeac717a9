//! Goal: `response` gives the deflection that other commands give where they overlap; text, JSON and figures agree.
//!
//! Independent value: the lateral stiffness at the rim that `check` reports.

use sawflutter::analyses::check::CheckReport;
use sawflutter::analyses::response::ResponseReport;
use sawflutter::model::scene::{Accuracy, ProbeFile, Scene, SideForceFile};
use tempfile::TempDir;

use super::program::{
    assert_in_80_columns, assert_refused, names_in, out, run, sawflutter, text, write_scene,
    written,
};

fn saw(folder: &TempDir) -> String {
    let mut file = Scene::paper().file().clone();
    (file.accuracy, file.measured) = (Accuracy::Draft, None);
    file.operating_rpm = Some(1000.0);
    let angle_deg = file.cut.as_ref().map_or(0.0, |cut| cut.angle_deg);
    file.probe = Some(ProbeFile {
        radius_m: None,
        angle_deg,
    });
    file.side_force = Some(SideForceFile::of(2.0));
    write_scene(folder, &file).to_str().unwrap().to_owned()
}

#[test]
fn the_deflection_at_rest_is_the_force_over_the_stiffness_of_the_rim() {
    let folder = TempDir::new().unwrap();
    let path = saw(&folder);
    let output = run(&["response", &path], &folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let names = names_in(&out(&folder));
    let pictures = ["frequency-response.png", "frequency-response.svg"];
    let own = ["response.json", "response.png", "response.svg"];
    assert_eq!(names, [&pictures[..], &own].concat());
    let summary = text(&output.stdout);
    assert_in_80_columns(summary);
    let report: ResponseReport = written(&folder, "response.json");
    let checked = sawflutter()
        .args(["check", &path, "--json"])
        .output()
        .unwrap();
    let check: CheckReport = serde_json::from_slice(&checked.stdout).unwrap();
    let expected = 2.0 / check.rim_stiffness_at_rest_n_per_m;
    let at_rest = report.lines[0].amplitude_m[0].unwrap();
    // The basis of the draft lacks the waves of many diameters in which a point force deflects its own place; `check` has
    // a larger one.
    assert!(
        (at_rest / expected - 1.0).abs() < Accuracy::Draft.tolerance(),
        "{at_rest} {expected}"
    );
    // The first frequency of the response between the points is static too, at the operating speed.
    let points = report.points.unwrap();
    assert_eq!(points.frequency_hz[0], 0.0);
    let at_speed = report.operating.unwrap().amplitude_m[0].unwrap();
    let receptance = points.receptance_m_per_n[0].unwrap();
    assert!(
        (2.0 * receptance / at_speed - 1.0).abs() < 1e-6,
        "{receptance} {at_speed}"
    );
}

#[test]
fn causes_are_set_by_their_keys_and_refused_by_them() {
    let folder = TempDir::new().unwrap();
    let path = saw(&folder);
    let line = [
        "response",
        &path,
        "--set",
        "response.flatness_m=0.05mm",
        "--json",
    ];
    let output = run(&line, &folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let report: ResponseReport = serde_json::from_slice(&output.stdout).unwrap();
    let names: Vec<&str> = report.lines.iter().map(|line| line.name.as_str()).collect();
    assert_eq!(names, ["side force, static", "flatness, 2×"]);
    for (set, said) in [
        ("response.runout_m=-1mm", "response.runout_m"),
        ("response.runout_m=0.1mm", "tilts freely"),
        (
            "side_force.radius_m=2",
            "side_force.radius_m must be … (you gave 2)",
        ),
    ] {
        assert_refused(&["response", &path, "--set", set], said, &folder);
    }
    // Beyond the sweep the saw was not analysed.
    let fast = ["response", &path, "--rpm", "9000"];
    assert_refused(&fast, "--rpm must be … (you gave 9000)", &folder);
    let still = ["response", &path, "--to-frequency", "0"];
    assert_refused(&still, "--to-frequency must be … (you gave 0)", &folder);
}
