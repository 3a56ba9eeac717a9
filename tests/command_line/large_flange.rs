//! Goal: a blade with a large flange, whose first standing wave has dozens of nodal diameters, gets the right critical
//! speed, and a sweep that the program chooses itself is never refused.
//!
//! Source: Hermite cubics on 24 equal elements of the radius, n = 0 … 150, with the plane stress of the spinning ring
//! that does not move at the flange.

use sawflutter::analyses::campbell::Report;
use sawflutter::analyses::check::CheckReport;
use tempfile::TempDir;

use super::program::{run, text, written};

/// A blade in a flange, sizes in mm.
fn blade(folder: &TempDir, sizes_mm: [f64; 4], material: [f64; 2], more: &str) -> String {
    let [outer, bore, thickness, flange] = sizes_mm.map(|mm| 1e-3 * mm);
    let [modulus, density] = material;
    let scene = format!(
        r#"{{ "name": "large flange", "blade": {{ "outer_diameter_m": {outer}, "inner_diameter_m": {bore},
            "thickness_m": {thickness}, "material": {{ "youngs_modulus_pa": {modulus}, "poisson_ratio": 0.3,
            "density_kg_per_m3": {density} }} }}, "mount": {{ "kind": "collar", "diameter_m": {flange},
            "in_plane": "fixed" }}{more} }}"#
    );
    let path = folder.path().join("scene.json");
    std::fs::write(&path, scene).unwrap();
    path.to_str().unwrap().to_owned()
}

const STEEL: [f64; 2] = [2.1e11, 7850.0];

#[track_caller]
fn assert_first(report: &Report, rpm: f64, diameters: usize) {
    let lowest = report.critical_speeds.first().unwrap();
    assert!((lowest.rpm / rpm - 1.0).abs() < 1e-3, "{}", lowest.rpm);
    assert_eq!(lowest.nodal_diameters, diameters);
    assert!(report.accuracy.max_diameters >= diameters);
    assert!(report.accuracy.complete_to_rpm >= lowest.rpm);
    assert!(report.campbell.to_rpm >= lowest.rpm);
}

#[test]
fn the_sweep_of_a_large_flange_ends_after_forty_critical_speeds() {
    let folder = TempDir::new().unwrap();
    let operating = r#", "operating_rpm": 3000"#;
    let scene = blade(&folder, [300.0, 30.0, 0.6, 288.0], STEEL, operating);
    let output = run(&[&scene], &folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let report: Report = written(&folder, "report.json");
    assert_first(&report, 35_506.03, 48);
    // A cosine and a sine stand still at each.
    assert_eq!(report.critical_speeds.len(), 20);
    let warnings = report.warnings.join("\n");
    assert!(warnings.contains("20 critical speeds"), "{warnings}");
    // A rim of 150 mm reaches 100 m/s before 85 % of this speed.
    assert_eq!(report.verdict.allowed_to_rpm.map(f64::floor), Some(6366.0));
}

#[test]
fn a_hub_blade_is_judged_at_its_speed() {
    let folder = TempDir::new().unwrap();
    let operating = r#", "operating_rpm": 30000"#;
    let sizes = [55.6, 40.0, 0.03, 54.0];
    let scene = blade(&folder, sizes, [2e11, 7500.0], operating);
    let output = run(&[&scene], &folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("YES"));
    assert_first(&written(&folder, "report.json"), 71_677.99, 67);
}

/// The first critical speed lies far above the sweep.
#[test]
fn a_check_with_a_short_sweep_knows_the_first_critical_speed() {
    let folder = TempDir::new().unwrap();
    let sweep = r#", "operating_rpm": 3000, "sweep": { "to_rpm": 6000 }"#;
    let scene = blade(&folder, [300.0, 30.0, 1.0, 260.0], STEEL, sweep);
    let output = run(&["check", &scene], &folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let check: CheckReport = written(&folder, "check.json");
    let found = check
        .verdict
        .limits
        .iter()
        .find(|limit| limit.key == "margin")
        .and_then(|limit| limit.found_rpm);
    assert!((found.unwrap() / 17_888.80 - 1.0).abs() < 1e-3, "{found:?}");
}

/// Reference: all eigenvalues of the state space of n = 0 … 60 on the same elements, five shapes of each phase, with the
/// spring as a matrix of rank one: Re λ = 15.45 1/s at 17 905 rpm, real.
#[test]
fn a_spring_at_a_large_flange_makes_the_waves_of_many_diameters_diverge() {
    let folder = TempDir::new().unwrap();
    let guided = r#", "operating_rpm": 17905, "sweep": { "from_rpm": 17870, "to_rpm": 17920 },
        "guides": [{ "radius_m": 0.147, "angle_deg": -60, "radial_length_m": 0, "tangential_length_m": 0,
            "stiffness_n_per_m": 1e5 }]"#;
    let scene = blade(&folder, [300.0, 30.0, 1.0, 260.0], STEEL, guided);
    let output = run(&[&scene], &folder);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let report: Report = written(&folder, "report.json");
    assert_first(&report, 17_888.80, 14);
    let operating = report.operating.unwrap();
    let growth = operating.growth_per_s.unwrap();
    assert!((growth / 15.45 - 1.0).abs() < 0.01, "{growth}");
    assert_eq!(operating.frequency_hz, Some(0.0));
    let first = &report.instabilities[0];
    assert!((first.from_rpm / 17_888.80 - 1.0).abs() < 1e-6);
}

/// Hoop strain ρ(Ωb)²/E of 0.1: 104 125 rpm for a rim of 150 mm. The sweep of this saw would be refused, too, after the choice of its basis.
#[test]
fn a_speed_that_tears_the_blade_is_refused_before_its_basis_is_chosen() {
    let folder = TempDir::new().unwrap();
    let guided = r#", "operating_rpm": 3000, "sweep": { "to_rpm": 36500 },
        "guides": [{ "radius_m": 0.1485, "angle_deg": -60, "radial_length_m": 0, "tangential_length_m": 0,
            "stiffness_n_per_m": 1e5 }]"#;
    let scene = blade(&folder, [300.0, 30.0, 0.6, 288.0], STEEL, guided);
    let hoop = |rpm: f64| {
        let speed = rpm * std::f64::consts::TAU / 60.0 * 0.15;
        STEEL[1] * speed * speed / STEEL[0]
    };
    let fastest = (0.1 / hoop(1.0)).sqrt();
    for command in ["analyze", "response"] {
        let refused = run(&[command, &scene, "--rpm", "1e8"], &folder);
        assert_eq!(refused.status.code(), Some(2), "{command}");
        let told = text(&refused.stderr);
        let begin = format!("error: --rpm must be at most {fastest:.0} (you gave 1e8)");
        assert!(told.contains(&begin), "{command}: {told}");
    }
}
