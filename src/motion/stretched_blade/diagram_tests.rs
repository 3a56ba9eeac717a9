//! Stationary deflections over the speed, compared with time histories that come to rest.

use super::PressedBlade;
use crate::model::plate::Plate;
use crate::model::scene::rad_per_s;
use crate::motion::history::{History, SMALL, at_cut, product, saws};

/// Damping in 1/s, which does not change the deflection at rest.
const DAMPING: f64 = 40.0;
const SPEEDS_RPM: [f64; 12] = [
    0.0, 150.0, 300.0, 450.0, 600.0, 750.0, 900.0, 1000.0, 1100.0, 1200.0, 1350.0, 1500.0,
];
/// Speed from which the histories contain stretching, which hardly matters for the small deflections below.
const STRETCHED_RPM: f64 = 1500.0;

/// Independent value: time histories from the flat shape. The largest difference on one pad, between two and at the collar is 0.05, 0.05 and
/// 0.01 %; where a pad touches only with its edges, that of 14 points in either direction is 0.5 %.
fn compare(place: usize) {
    let (name, scene) = &saws(5e-6, 0.6, 0.0)[place];
    let scene = &scene.edited(|file| file.damping = None).unwrap();
    let order = Plate::new(scene, SMALL).degrees_of_freedom();
    let pressed = PressedBlade::new(scene, SMALL, 2000.0, order).unwrap();
    let (cut, force_n) = (at_cut(scene), scene.file().side_force_n());
    for rpm in SPEEDS_RPM {
        let stretches = rpm >= STRETCHED_RPM;
        let history = History::new(scene, rad_per_s(rpm), Some(DAMPING), stretches);
        let rest = history.settled(5.0);
        let found = pressed.deviation(force_n, rpm).unwrap();
        let [own, found] = [
            rest.map(|q| product(&cut, &q)),
            found.map(|at| at.deviation_m),
        ];
        let [own, found] = [own, found].map(Option::unwrap);
        assert!(
            (found / own - 1.0).abs() < 2e-3,
            "{name}, {rpm} rpm: {own:e} {found:e}"
        );
    }
}

#[test]
#[cfg_attr(debug_assertions, ignore = "many steps: run it in release")]
fn one_pad_holds_the_blade_as_in_its_time_history() {
    compare(0);
}

#[test]
#[cfg_attr(debug_assertions, ignore = "many steps: run it in release")]
fn two_pads_with_unlike_gaps_hold_the_blade_as_in_its_time_history() {
    compare(1);
}

#[test]
#[cfg_attr(debug_assertions, ignore = "many steps: run it in release")]
fn a_collar_and_a_pad_hold_the_blade_as_in_its_time_history() {
    compare(2);
}
