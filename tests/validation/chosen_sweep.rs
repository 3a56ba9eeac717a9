//! A sweep whose end the program chooses ends above the first critical speed, or the report says why not.

use sawflutter::analyses::campbell::Report;
use sawflutter::model::scene::Scene;
use sawflutter::stability::Analysis;

/// A ring of 0.79 mm outside a collar.
fn ring(collar_m: f64) -> Report {
    let scene = Scene::from_json(&format!(
        r#"{{"name": "ring", "accuracy": "draft",
            "blade": {{"outer_diameter_m": 0.714, "inner_diameter_m": 0.3427, "thickness_m": 0.00079, "material":
                {{"youngs_modulus_pa": 2.06e11, "poisson_ratio": 0.3, "density_kg_per_m3": 7850}}}},
            "mount": {{"kind": "collar", "diameter_m": {collar_m}, "in_plane": "free"}}}}"#
    ));
    Analysis::new(&scene.unwrap()).unwrap().report()
}

/// Waves of dozens of diameters stand still at nearly the same speed, and the modes of so many speeds do not fit into memory. Reference:
/// 47 diameters at 41145.3 rpm, by radial functions of another program.
#[test]
fn the_sweep_of_a_thin_ring_ends_above_its_first_critical_speed() {
    let report = ring(0.68544);
    let first = &report.critical_speeds[0];
    assert!((first.rpm - 41_145.3).abs() < 1.0, "{}", first.rpm);
    assert_eq!(first.nodal_diameters, 47);
    assert!(report.campbell.to_rpm > first.rpm);
    let listed = format!("{} critical speeds", report.critical_speeds.len());
    for warning in &report.warnings {
        let is_number = warning.contains("critical speeds are below");
        assert!(!is_number || warning.contains(&listed), "{warning}");
    }
}

/// Forty critical speeds end this sweep. The list has one line for the two waves of a number of diameters, and so has the warning.
#[test]
fn the_number_of_critical_speeds_in_a_warning_is_that_of_the_list() {
    let report = ring(0.6783);
    assert!(report.campbell.to_rpm > report.critical_speeds[0].rpm);
    let listed = format!("{} critical speeds are below", report.critical_speeds.len());
    let warnings = report.warnings.join("; ");
    assert!(warnings.contains(&listed), "{listed}: {warnings}");
}

/// The rim of this ring would stretch by ρ(Ωb)²/E = 0.1 at 43 331 rpm, below its first critical speed.
#[test]
fn a_sweep_that_ends_below_the_first_critical_speed_says_why() {
    let report = ring(0.69258);
    let torn = (0.1_f64 * 2.06e11 / 7850.0).sqrt() / 0.357 * 60.0 / std::f64::consts::TAU;
    assert!((report.campbell.to_rpm / torn - 1.0).abs() < 1e-9);
    assert!(report.critical_speeds.is_empty());
    let warnings = report.warnings.join("; ");
    assert!(
        warnings.contains("below the first critical speed"),
        "{warnings}"
    );
}
