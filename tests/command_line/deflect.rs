//! Goal: `deflect` gives the equilibria of the blade equally in text, JSON and figure, and refuses a scene that it
//! cannot answer.
//!
//! Source: `--help`, docs/how-to/deflect.md.

use sawflutter::analyses::campbell::{InstabilityBand, Report};
use sawflutter::analyses::check::CheckReport;
use sawflutter::analyses::deflect::DeflectReport;
use sawflutter::model::scene::{Accuracy, ContactLaw, Scene};
use tempfile::TempDir;

use super::program::{assert_in_80_columns, assert_refused, names_in, out, run, text, written};

#[test]
fn the_built_in_saw_has_deflected_equilibria_past_its_first_critical_speed() {
    let folder = TempDir::new().unwrap();
    let options = ["--force", "2", "--to", "1700", "--accuracy", "draft"];
    let output = run(&[&["deflect"], &options[..]].concat(), &folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let expected = ["deflect.json", "deflect.png", "deflect.svg"];
    assert_eq!(names_in(&out(&folder)), expected);
    let summary = text(&output.stdout);
    assert_in_80_columns(summary);
    let report: DeflectReport = written(&folder, "deflect.json");
    let critical = report.critical_speeds[0].rpm;
    let beyond = report.beyond_thickness_rpm.unwrap();
    assert!(
        (0.95 * critical..1.05 * critical).contains(&beyond),
        "{beyond}"
    );
    assert!(
        summary.contains(&format!("above {beyond:.0} rpm")),
        "{summary}"
    );
    let [first, last] = [report.up.arcs.first(), report.up.arcs.last()].map(Option::unwrap);
    assert_eq!(first.rpm[0], 0.0);
    assert!((last.rpm.last().unwrap() - 1700.0).abs() < 1e-6);
    // At rest the frequencies are those of the linear model, apart from the stretching by the force.
    let at_rest = report.campbell.branches[0].frequency_hz[0];
    assert!((first.frequencies_hz[0][0] / at_rest - 1.0).abs() < 1e-2);
}

#[test]
fn a_force_or_a_saw_without_an_answer_is_refused() {
    let folder = TempDir::new().unwrap();
    for (options, said) in [
        (&["--force", "1e9"][..], "--force"),
        (
            &["--force", "1e5", "--accuracy", "draft"],
            "side_force.force_n must be … (you gave 100000)",
        ),
        (
            &["--set", "side_force.angle_deg=inf"],
            "side_force.angle_deg",
        ),
        (&["--to", "-5"], "--to"),
    ] {
        assert_refused(&[&["deflect"], options].concat(), said, &folder);
    }
    let free = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/free-blade.json");
    assert_refused(
        &["deflect", free, "--accuracy", "draft"],
        "add a guide",
        &folder,
    );
    assert!(!folder.path().join("out").exists());
}

/// The force of a pad that lifts off balances the side force, and text and JSON state how the linear chart treats the
/// pad. Without a side force nothing restrains the blade.
#[test]
fn a_pad_that_lifts_off_is_reported() {
    let folder = TempDir::new().unwrap();
    let scene = Scene::paper().edited(|file| {
        let pad = &mut file.guides[0];
        (pad.contact, pad.gap_m) = (ContactLaw::OneSided, Some(4e-5));
        file.accuracy = Accuracy::Draft;
    });
    let json = serde_json::to_string(scene.unwrap().file()).unwrap();
    let path = folder.path().join("saw.json");
    std::fs::write(&path, json).unwrap();
    let path = path.to_str().unwrap();
    let asked = ["deflect", path, "--to", "600", "--force"];
    let output = run(&[&asked[..], &["3"]].concat(), &folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let summary = text(&output.stdout);
    assert!(summary.contains("guides[0] -3 N at"), "{summary}");
    let report: DeflectReport = written(&folder, "deflect.json");
    let forces = report.up.arcs.iter().flat_map(|arc| &arc.pad_forces_n[0]);
    assert!(forces.clone().count() > 3);
    assert!(forces.clone().all(|force| (force + 3.0).abs() < 1e-6));
    let said = |warning: &String| warning.contains("guides[0] lifts off");
    assert!(report.warnings.iter().any(said));
    let still = [&asked[..], &["0"]].concat();
    assert_refused(&still, "film_stiffness_n_per_m", &folder);
}

/// The limit of `check` applies to the amplitude of flutter that `analyze` reports, times √2 because it is larger near an
/// edge of the band: a limit just below that is not kept, one just above it is.
#[test]
fn a_limit_of_the_amplitude_of_flutter_applies_to_every_band() {
    let folder = TempDir::new().unwrap();
    let speed = ["--accuracy", "draft"];
    let output = run(
        &[&["analyze", "--amplitude", "--json"], &speed[..]].concat(),
        &folder,
    );
    let report: Report = serde_json::from_slice(&output.stdout).unwrap();
    let amplitude = |band: &InstabilityBand| band.saturated_amplitude_m;
    let flutter = report
        .instabilities
        .iter()
        .filter(|band| band.frequency_hz > 0.0);
    let first = flutter
        .clone()
        .find(|band| amplitude(band).is_some())
        .unwrap();
    let known = flutter
        .clone()
        .filter(|band| amplitude(band).is_some())
        .count();
    assert!(known >= 6 && known == flutter.count(), "{known}");
    // The amplitude of the first band, at a speed within it, where the saw breaks the 85 % rule.
    let operating = format!("{}", 0.5 * (first.from_rpm + first.to_rpm));
    let most_mm = 1e3 * std::f64::consts::SQRT_2 * amplitude(first).unwrap();
    for (share, passed) in [(0.99, false), (1.01, true)] {
        let limit = format!("{}mm", share * most_mm);
        let asked = [
            "check",
            "--rpm",
            &operating,
            "--max-amplitude",
            &limit,
            "--json",
        ];
        let output = run(&[&asked[..], &speed].concat(), &folder);
        let report: CheckReport = serde_json::from_slice(&output.stdout).unwrap();
        let criterion = report
            .verdict
            .limits
            .iter()
            .find(|c| c.key == "max_amplitude")
            .unwrap();
        assert_eq!(criterion.is_kept(), passed, "{criterion:?}");
        assert_eq!(output.status.code(), Some(1));
    }
    let negative = ["check", "--max-amplitude", "-1mm"];
    assert_refused(&negative, "--max-amplitude", &folder);
}
