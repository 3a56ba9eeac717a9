//! Goal: the user of a heated or rolled saw gets its heat limits in words, numbers and a picture; a blade that buckles
//! or a table out of balance is refused with the remedy.

use crate::common::says;
use sawflutter::analyses::campbell::Report;
use sawflutter::analyses::runup::RunUpReport;

use super::program::{assert_in_80_columns, sawflutter, text};

fn analyze(
    scene: &serde_json::Value,
    arguments: &[&str],
) -> (tempfile::TempDir, assert_cmd::assert::Assert) {
    command("analyze", scene, arguments)
}

fn command(
    name: &str,
    scene: &serde_json::Value,
    arguments: &[&str],
) -> (tempfile::TempDir, assert_cmd::assert::Assert) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    std::fs::write(&path, scene.to_string()).unwrap();
    let assert = sawflutter()
        .arg(name)
        .arg(&path)
        .args(["--accuracy", "draft", "--out"])
        .arg(folder.path().join("out"))
        .args(arguments)
        .assert();
    (folder, assert)
}

fn tensioned() -> serde_json::Value {
    let text = std::fs::read_to_string(crate::common::path("scenes/collar-400mm-tensioned.json"));
    serde_json::from_str(&text.unwrap()).unwrap()
}

#[test]
fn heat_and_tension_reach_the_report_the_summary_and_a_picture() {
    let (folder, assert) = analyze(&tensioned(), &["--sensitivity"]);
    let printed = text(&assert.success().get_output().stdout).to_owned();
    for words in [
        "Heat, peak of the profile now +20.0 K",
        "brings the first critical speed down to the operating speed",
        "buckles the blade at rest",
        "membrane.temperature.rim_rise_k",
        "membrane.png",
    ] {
        assert!(printed.contains(words), "{words}: {printed}");
    }
    assert_in_80_columns(&printed);
    let out = folder.path().join("out");
    let content = std::fs::read_to_string(out.join("report.json")).unwrap();
    let report: Report = serde_json::from_str(&content).unwrap();
    for term in ["heat K_m", "roll tension K_m"] {
        assert!(
            report.terms.iter().any(|own| own == term),
            "{:?}",
            report.terms
        );
    }
    let membrane = report.membrane.unwrap();
    let heat = membrane.heat.unwrap();
    let (critical, buckling) = (heat.operating_limit.unwrap(), heat.buckling.unwrap());
    assert!(20.0 < critical.rise_k && critical.rise_k < buckling.rise_k);
    assert!(!heat.buckles_first && !heat.past_critical_when_cold);
    assert!(out.join("membrane.png").exists() && out.join("membrane.svg").exists());
}

/// The notes of the scene state that the hot saw needs its roll tension.
#[test]
fn without_its_tension_the_hot_saw_is_past_its_critical_speed() {
    let mut scene = tensioned();
    scene["membrane"]["roll_tension"] = serde_json::json!([]);
    let (_folder, assert) = analyze(&scene, &["--json"]);
    let report: Report = serde_json::from_str(text(&assert.success().get_output().stdout)).unwrap();
    assert!(report.critical_speeds[0].rpm < 3800.0);
    let limit = report
        .membrane
        .unwrap()
        .heat
        .unwrap()
        .operating_limit
        .unwrap();
    assert!(limit.rise_k < 20.0);
}

/// The blade is 2.2 mm thick, and displaced metal spreads equally along and across the groove.
#[test]
fn a_groove_is_the_same_band_as_its_strain() {
    let mut scene = tensioned();
    scene["membrane"]["roll_tension"][0]["eigenstrain"] = serde_json::Value::Null;
    scene["membrane"]["roll_tension"][0]["groove_depth_m"] = (7e-4 * 2.2e-3).into();
    let run = |scene: &serde_json::Value| -> Report {
        let (_folder, assert) = analyze(scene, &["--json"]);
        serde_json::from_str(text(&assert.success().get_output().stdout)).unwrap()
    };
    let (by_groove, by_strain) = (run(&scene), run(&tensioned()));
    for report in [&by_groove, &by_strain] {
        let band = &report.membrane.as_ref().unwrap().roll_bands[0];
        assert!((band.eigenstrain / 7e-4 - 1.0).abs() < 1e-12, "{band:?}");
        assert!(
            (band.groove_depth_m / 1.54e-6 - 1.0).abs() < 1e-12,
            "{band:?}"
        );
    }
    let [groove, strain] = [by_groove, by_strain].map(|r| r.critical_speeds[0].rpm);
    assert!((groove / strain - 1.0).abs() < 1e-9, "{groove} {strain}");
}

#[test]
fn a_light_gap_reaches_report_and_summary_and_gives_back_its_strain() {
    let with = |edge: serde_json::Value| {
        let mut scene = tensioned();
        scene["membrane"]["straight_edge"] = edge;
        scene
    };
    let (_folder, assert) = analyze(&with(serde_json::json!({})), &["--json"]);
    let report: Report = serde_json::from_str(text(&assert.success().get_output().stdout)).unwrap();
    let edge = report.membrane.unwrap().straight_edge.unwrap();
    let gap_m = edge.gap_m.unwrap();
    assert!(gap_m > edge.gap_without_rolling_m && edge.measured.is_none());
    let given = with(serde_json::json!({ "measured_gap_m": gap_m }));
    let (folder, remeasured) = analyze(&given, &[]);
    let printed = text(&remeasured.success().get_output().stdout).to_owned();
    for words in [
        "Straight edge of 400 mm, blade level on two points at 200 mm:",
        "times the rolling,\n  eigenstrain 0.0007 at 100 mm",
    ] {
        assert!(printed.contains(words), "{words}: {printed}");
    }
    assert_in_80_columns(&printed);
    let content = std::fs::read_to_string(folder.path().join("out/report.json")).unwrap();
    let remeasured_report: Report = serde_json::from_str(&content).unwrap();
    let measured = remeasured_report
        .membrane
        .unwrap()
        .straight_edge
        .unwrap()
        .measured;
    assert!((measured.unwrap().factor - 1.0).abs() < 1e-9);
}

#[test]
fn a_blade_that_buckles_is_refused_with_the_share_it_tolerates() {
    let mut scene = tensioned();
    scene["membrane"]["temperature"]["rim_rise_k"] = 400.into();
    let (folder, assert) = analyze(&scene, &[]);
    let message = text(&assert.code(2).get_output().stderr).to_owned();
    assert!(message.contains("buckles at rest, in "), "{message}");
    assert!(message.contains("lower the temperature"), "{message}");
    assert!(!folder.path().join("out/report.json").exists());
}

#[test]
fn refusals_name_key_value_and_remedy() {
    let row = |radius: f64, hoop: f64| serde_json::json!({ "radius_m": radius, "hoop_pa": hoop });
    let cases = [
        (
            serde_json::json!({ "temperature": { "expansion_per_k": 1.2e-5 } }),
            "membrane.temperature",
        ),
        (
            serde_json::json!({ "temperature": { "expansion_per_k": 1.2, "rim_rise_k": 10 } }),
            "membrane.temperature.expansion_per_k must be … (you gave 1.2)",
        ),
        (
            serde_json::json!({ "temperature": { "expansion_per_k": 1e-5, "rim_rise_k": 10,
                "from_radius_m": 0.2 } }),
            "membrane.temperature.from_radius_m must be … (you gave 0.2)",
        ),
        (
            serde_json::json!({ "temperature": { "expansion_per_k": 1e-5, "exponent": 2,
                "table": [{ "radius_m": 0.1, "rise_k": 1 }] } }),
            "membrane.temperature.exponent must be … (you gave 2)",
        ),
        (
            serde_json::json!({ "roll_tension": [{ "radius_m": 0.195, "width_m": 0.02,
                "eigenstrain": 1e-4 }] }),
            "membrane.roll_tension[0].radius_m must be … (you gave 0.195)",
        ),
        (
            serde_json::json!({ "roll_tension": [{ "radius_m": 0.1, "width_m": 0.02,
                "groove_depth_m": 1e-3 }] }),
            "membrane.roll_tension[0].groove_depth_m must be between 0 and 0.00011 … (you gave 0.001)",
        ),
        (
            serde_json::json!({ "roll_tension": [{ "radius_m": 0.1, "width_m": 0.02 }] }),
            "membrane.roll_tension[0] must be given by eigenstrain or by groove_depth_m (you gave neither)",
        ),
        (
            serde_json::json!({ "straight_edge": { "measured_gap_m": 1e-4 } }),
            "membrane.straight_edge.measured_gap_m must be given beside a rolled band … (you gave 0.0001)",
        ),
        (
            serde_json::json!({ "straight_edge": { "length_m": 0.5 } }),
            "membrane.straight_edge.length_m must be above 0.03 and at most 0.4 … (you gave 0.5)",
        ),
        (
            serde_json::json!({ "roll_tension": [{ "radius_m": 0.1, "width_m": 0.02,
                "eigenstrain": 1e-4 }], "straight_edge": { "measured_gap_m": 0.5 } }),
            "membrane.straight_edge.measured_gap_m must be between … (you gave 0.5)",
        ),
        (
            serde_json::json!({ "residual_stress": [row(0.1, 1e6), row(0.1, 2e6)] }),
            "membrane.residual_stress[1].radius_m must be … (you gave 0.1)",
        ),
        (
            serde_json::json!({ "residual_stress": [row(0.1, -20e6),
                { "radius_m": 0.15, "hoop_pa": 30e6, "radial_pa": 40e6 }, row(0.2, 40e6)] }),
            "membrane.residual_stress[1].radial_pa must be … (you gave 4e7)",
        ),
    ];
    for (membrane, words) in cases {
        let mut scene = tensioned();
        scene["membrane"] = membrane;
        let (_folder, assert) = analyze(&scene, &[]);
        let message = text(&assert.code(2).get_output().stderr).to_owned();
        assert!(
            says(&message, words) && message.contains("; "),
            "{words}: {message}"
        );
    }
}

/// The hoop stress of a blade with free edges is in balance, so that a table out of balance is measured wrongly.
#[test]
fn a_table_out_of_balance_is_refused_with_the_number() {
    let text_of = std::fs::read_to_string(crate::common::path("scenes/free-blade.json")).unwrap();
    let mut scene: serde_json::Value = serde_json::from_str(&text_of).unwrap();
    scene["membrane"] = serde_json::json!({ "residual_stress": [
        { "radius_m": 0.1, "hoop_pa": -10e6 }, { "radius_m": 0.355, "hoop_pa": 20e6 }] });
    let (_folder, assert) = analyze(&scene, &[]);
    let message = text(&assert.code(2).get_output().stderr).to_owned();
    // The imbalance is (20 − 10)/2 = 5, the integral of the absolute value (10²/30 + 20²/30)/2 = 8.33.
    assert!(message.contains("60.0 % of ∫|hoop_pa| dr"), "{message}");
    scene["membrane"]["residual_stress"][1]["hoop_pa"] = 10.2e6.into();
    let (_balanced_folder, balanced) = analyze(&scene, &[]);
    let printed = text(&balanced.success().get_output().stdout).to_owned();
    assert!(printed.contains("out of balance by"), "{printed}");
}

/// Other commands include heat and tension too: a run-up passes the critical speeds that the hot rim and the rolled
/// band have moved.
#[test]
fn cut_run_up_and_matrices_have_heat_and_tension() {
    let mut scene = tensioned();
    scene["cut"] = serde_json::json!({
        "angle_deg": 0, "depth_m": 0.06, "tangential_n_per_tooth": 60,
        "radial_n_per_tooth": 20, "lateral_n_per_tooth": 2, "speeds": [{"rpm": 3000}]
    });
    scene["runup"] = serde_json::json!({
        "from_rpm": 0, "to_rpm": 6000, "duration_s": 5
    });
    let runup = |scene: &serde_json::Value| -> RunUpReport {
        let (folder, assert) = command("runup", scene, &[]);
        assert.success();
        let path = folder.path().join("out/runup.json");
        serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
    };
    let (folder, assert) = analyze(&scene, &[]);
    assert.success();
    let content = std::fs::read_to_string(folder.path().join("out/report.json")).unwrap();
    let report: Report = serde_json::from_str(&content).unwrap();
    let lowest = report.critical_speeds[0].rpm;
    let met = runup(&scene).critical_speeds[0].rpm;
    assert!((met / lowest - 1.0).abs() < 1e-9, "{met} {lowest}");
    let (_folder, cut) = command("cut", &scene, &[]);
    cut.success();

    let stiffness = |scene: &serde_json::Value| {
        let (folder, cut) = command("export", scene, &["--matrices"]);
        cut.success();
        std::fs::read(folder.path().join("out/stiffness.npy")).unwrap()
    };
    let tensioned = stiffness(&scene);
    scene["membrane"] = serde_json::Value::Null;
    assert!(stiffness(&scene) != tensioned);
    let cold = runup(&scene).critical_speeds[0].rpm;
    assert!((cold / lowest - 1.0).abs() > 0.01, "{cold} {lowest}");
}
