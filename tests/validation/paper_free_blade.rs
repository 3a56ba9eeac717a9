//! Goal: the paper's blade without guides has its known frequencies and critical speeds.
//!
//! Sources: CalculiX 2.20 with 3-D solids (tests/reference/free_disk_calculix.csv), and an
//! independent implementation of this plate model.

use std::f64::consts::TAU;

use crate::common::{Worst, assert_close, of_diameters, reference_model, relative_error, scene};
use sawflutter::model::scene::{rad_per_s, rpm};
use sawflutter::modes::{ModeKind, SpectralModel};
use sawflutter::stability::Analysis;
use serde::Deserialize;

fn free_model() -> SpectralModel {
    reference_model(&scene("free-blade"), rad_per_s(4000.0))
}

fn free_critical_rpm(model: &SpectralModel, diameters: usize) -> f64 {
    let speeds: Vec<f64> = model
        .critical
        .iter()
        .filter(|c| (c.name.diameters(), c.name.circles()) == (diameters, 0))
        .map(|c| rpm(c.speed_rad_per_s))
        .collect();
    assert_eq!(speeds.len(), 2, "{diameters} diameters: {speeds:?}");
    // A double eigenvalue of a symmetric problem: equal to rounding.
    assert_close("both waves", speeds[0], speeds[1], 1e-10);
    speeds[0]
}

/// This saw has no pad, so that no number is calibrated. The paper gives none of these speeds: its 1475 rpm is that of
/// the guided saw.
#[test]
fn free_critical_speeds() {
    let model = free_model();
    let mut worst = Worst::default();
    for (n, expected) in (2..).zip([1476.63, 2027.50, 2496.94, 2946.33, 3386.47]) {
        let actual = free_critical_rpm(&model, n);
        worst.add(relative_error(actual, expected), || {
            format!("{n} diameters: {actual:.4} instead of {expected} rpm")
        });
    }
    worst.assert_at_most("free blade, critical speeds", 1e-5);
    assert!(model.critical.iter().all(|c| c.name.diameters() >= 2));
}

#[derive(Deserialize)]
struct Solid {
    quantity: String,
    n: usize,
    s: usize,
    value: f64,
}

/// The model's value of a quantity of the solids.
fn thin_plate(model: &SpectralModel, solid: &Solid) -> f64 {
    match solid.quantity.as_str() {
        "critical_rpm" => {
            assert_eq!(solid.s, 0);
            free_critical_rpm(model, solid.n)
        }
        "rest_hz" => {
            let multiplicity = if solid.n == 0 { 1 } else { 2 };
            let at_rest = model.all_modes(0.0).unwrap();
            let mode = of_diameters(&at_rest, solid.n)
                .filter(|mode| mode.kind != ModeKind::Rigid)
                .nth(multiplicity * solid.s)
                .expect("a mode");
            mode.frequency_rad_per_s() / TAU
        }
        other => panic!("unknown quantity {other}"),
    }
}

/// The largest error over the rows of a test.
fn against_solids(of_interest: impl Fn(&Solid) -> bool) -> Worst {
    let model = free_model();
    let mut worst = Worst::default();
    let table: Vec<Solid> = crate::common::table("free_disk_calculix.csv");
    for solid in table.iter().filter(|solid| of_interest(solid)) {
        let actual = thin_plate(&model, solid);
        let what = format!(
            "{} of {} diameters: {actual:.4} instead of {}",
            solid.quantity, solid.n, solid.value
        );
        println!("{what}");
        assert!(
            actual > solid.value,
            "the thin plate is the stiffer: {what}"
        );
        worst.add(relative_error(actual, solid.value), || what);
    }
    worst
}

fn has_one_diameter(solid: &Solid) -> bool {
    solid.n == 1
}

/// Frequencies of solids are below those of a thin plate, because of edge layers as wide as the blade is thick.
#[test]
fn free_blade_against_solid_elements() {
    let worst = against_solids(|solid| !has_one_diameter(solid));
    assert_eq!(worst.count, 7);
    worst.assert_at_most("free blade, solid elements", 3e-3);
}

/// The mode of one diameter and one circle, in which edge layers have the largest effect: the plate is 0.317 % above
/// the solid. It is converged to 1e-6, so that this is the difference between the two theories, and a change of it
/// would be an error of the program.
#[test]
fn free_blade_against_solid_elements_with_one_diameter() {
    let worst = against_solids(has_one_diameter);
    assert_eq!(worst.count, 1);
    assert!((0.0031..0.0033).contains(&worst.error), "{}", worst.error);
}

/// Nothing restrains heave and tilt of the free blade. On the blade the tilt is a wave of frequency Ω exactly; in space
/// its two waves have 0 and 2Ω. Double zeros are defective and accurate to √ε only: this must not be reported as
/// growth.
#[test]
fn rigid_motions_of_the_free_spinning_blade() {
    let model = free_model();
    let mut worst = Worst::default();
    for speed_rpm in [0.0, 100.0, 750.0, 1476.63, 1800.0, 2700.0, 4000.0] {
        let speed = rad_per_s(speed_rpm);
        let modes = model.all_modes(speed).unwrap();
        for mode in &modes {
            assert_eq!(mode.growth_per_s(), 0.0, "{speed_rpm} rpm: {:?}", mode.kind);
        }
        let rigid = |n: usize| {
            of_diameters(&modes, n)
                .filter(|mode| mode.kind == ModeKind::Rigid)
                .inspect(|mode| assert_eq!(mode.lambda.norm(), 0.0))
                .count()
        };
        assert!(rigid(0) > 0, "no heave at {speed_rpm} rpm");
        assert!(rigid(1) > 0, "no tilt at {speed_rpm} rpm");
        if speed > 0.0 {
            let tilt = of_diameters(&modes, 1)
                .filter(|mode| mode.kind != ModeKind::Rigid)
                .map(|mode| relative_error(mode.frequency_rad_per_s(), 2.0 * speed))
                .fold(f64::INFINITY, f64::min);
            worst.add(tilt, || format!("{speed_rpm} rpm"));
        }
    }
    worst.assert_at_most("free blade, tilt at twice the speed", 1e-9);
}

/// An undamped free blade has reflected waves above its critical speeds, and no wave that they could coalesce with.
#[test]
fn the_free_blade_is_never_unstable() {
    let analysis = Analysis::new(&scene("free-blade")).unwrap();
    assert_close(
        "end of the sweep",
        rpm(analysis.range_rad_per_s.to_rad_per_s),
        4000.0,
        1e-12,
    );
    let chart = &analysis.chart;
    assert!(chart.instabilities.is_empty(), "{:?}", chart.instabilities);
    assert_eq!(analysis.first_merge_rad_per_s, None);
    assert_eq!(analysis.flutter_speed_rad_per_s, None);
    // Speeds on both sides of every critical speed, each of which is a pair, and between them.
    let end = analysis.range_rad_per_s.to_rad_per_s;
    let critical = &analysis.model.critical;
    let within = critical.iter().filter(|c| c.speed_rad_per_s < end).count();
    assert!(within >= 8 && chart.certificate.speeds_checked > within);
    assert_eq!(chart.certificate.violations_rad_per_s, Vec::<f64>::new());
    let modes = chart.campbell.samples.iter().flat_map(|s| &s.modes);
    let mut reflected = 0;
    for mode in modes {
        assert_eq!(mode.mode.growth_per_s(), 0.0);
        reflected += usize::from(mode.mode.krein_sign() == -1);
    }
    assert!(reflected > 0);
}

/// The frequency of the branch of a critical speed is zero at that speed.
#[test]
fn critical_speeds_of_the_free_blade_belong_to_backward_waves() {
    let report = Analysis::new(&scene("free-blade")).unwrap().report();
    assert!(!report.critical_speeds.is_empty());
    for critical in &report.critical_speeds {
        let number = critical.branch.expect("it has a branch");
        let branch = &report.campbell.branches[number - 1];
        assert!(branch.name.ends_with("backward"), "{}", branch.name);
        let below = branch.rpm.partition_point(|rpm| *rpm < critical.rpm);
        let places = below.saturating_sub(1)..branch.rpm.len().min(below + 1);
        let least_hz = branch.frequency_hz[places]
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min);
        assert!(least_hz < 1.0, "{} rpm: {least_hz} Hz", critical.rpm);
    }
}
