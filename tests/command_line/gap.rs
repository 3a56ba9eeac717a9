//! Goal: `gap` gives the amplitudes for which the chart of guides with a gap is valid, and the deflection of the blade
//! at the cut.
//!
//! Source: `--help`, docs/how-to/guide-gaps.md.

use sawflutter::analyses::gap::GapReport;
use sawflutter::model::scene::{Accuracy, ContactLaw, DampingFile, GuideShape, Scene};
use tempfile::TempDir;

use super::program::{assert_in_80_columns, assert_refused, names_in, out, run, text, written};

/// A round pad has a third of the points of contact of the paper's. The air damps resonances, at which the search for an oscillation
/// otherwise takes minutes.
fn saw(folder: &TempDir) -> String {
    let scene = Scene::paper().edited(|file| {
        let pad = &mut file.guides[0];
        pad.shape = GuideShape::Round;
        (pad.contact, pad.gap_m) = (ContactLaw::OneSided, Some(4e-5));
        file.damping = Some(DampingFile {
            air_n_s_per_m3: 400.0,
            ..DampingFile::default()
        });
        (file.accuracy, file.operating_rpm) = (Accuracy::Draft, Some(1000.0));
        if let Some(sweep) = &mut file.sweep {
            sweep.to_rpm = 1700.0;
        }
    });
    let json = serde_json::to_string(scene.unwrap().file()).unwrap();
    let path = folder.path().join("saw.json");
    std::fs::write(&path, json).unwrap();
    path.display().to_string()
}

#[test]
fn text_files_and_json_agree() {
    let folder = TempDir::new().unwrap();
    let path = saw(&folder);
    let options = [
        "--force",
        "2",
        "--max-deviation",
        "0.3mm",
        "--oscillating-force",
        "0.5",
        "--friction",
        "0.2",
    ];
    let output = run(&[&["gap", &path], &options[..]].concat(), &folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let names = [
        "gap-friction.png",
        "gap-friction.svg",
        "gap-map.png",
        "gap-map.svg",
        "gap-oscillation.png",
        "gap-oscillation.svg",
        "gap.json",
        "gap.png",
        "gap.svg",
    ];
    assert_eq!(names_in(&out(&folder)), names);
    let summary = text(&output.stdout);
    assert_in_80_columns(summary);
    let report: GapReport = written(&folder, "gap.json");
    assert!(
        summary.contains(&format!("{:.1}", report.free.critical_rpm[0])),
        "{summary}"
    );
    assert!(
        summary.contains(&format!("{:.1}", report.linear.critical_rpm[0])),
        "{summary}"
    );
    let map = &report.deviation;
    assert!((map.rpm - 1000.0).abs() < 1e-9);
    assert_eq!(map.forces_n[6], 2.0);
    let at_scene = map
        .gap_factors
        .iter()
        .position(|factor| *factor == 1.0)
        .unwrap();
    let shown = 1e3 * map.deflection_m[at_scene][6].unwrap();
    assert!(
        summary.contains(&format!("{shown:.4}")),
        "{shown} {summary}"
    );
    let oscillation = report.oscillation.unwrap();
    assert_eq!(oscillation.lines[0].name, "oscillating side force");
    let said = match &oscillation.at {
        Some(at) => format!("amplitude {:.4} mm, at most", 1e3 * at.cut.amplitude_m),
        None => "no periodic motion was found".to_owned(),
    };
    assert!(summary.contains(&said), "{said} {summary}");
    let heat = report.friction.unwrap();
    assert!(heat.pads[0].gap_left_m.unwrap() < 0.0);
    assert!(
        summary.contains("gap left   none, pressed in by"),
        "{summary}"
    );
    assert_eq!(map.force_within_n.len(), map.gap_factors.len());
    assert!(
        report
            .warnings
            .iter()
            .any(|warning| warning.contains("guides[0] lifts off"))
    );
}

#[test]
fn a_saw_without_a_gap_and_invalid_numbers_are_refused() {
    let folder = TempDir::new().unwrap();
    let path = saw(&folder);
    for (words, said) in [
        (&["gap"][..], "guides[].contact"),
        (
            &["gap", &path, "--force", "0"],
            "side_force.force_n must be … (you gave 0)",
        ),
        (&["gap", &path, "--rpm", "-3"], "--rpm"),
        (&["gap", &path, "--max-deviation", "0mm"], "--max-deviation"),
        (
            &["gap", &path, "--oscillating-force", "-1"],
            "--oscillating-force",
        ),
        (
            &[
                "gap",
                &path,
                "--oscillating-force",
                "1",
                "--oscillating-order",
                "0",
            ],
            "--oscillating-order",
        ),
        (
            &["gap", &path, "--oscillating-order", "2"],
            "side_force.oscillating_n is missing",
        ),
    ] {
        assert_refused(words, said, &folder);
    }
    assert!(!out(&folder).exists());
}
