//! Goal: the temperatures that a blade tolerates agree with a search over whole computations.

use crate::common::assert_close;
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{Scene, SpeedRange, rad_per_s};
use sawflutter::modes::{SpectralModel, SpectrumError, Strategy};
use sawflutter::stability::HeatLimits;

use super::saws::{collar, heated, rolled, scene_with};

const SMALL: Resolution = Resolution {
    max_diameters: 6,
    radial_functions: 5,
};

/// The paper's saw, guided, at a speed below its first critical one; and the collar saw.
fn saws() -> [(Scene, f64); 2] {
    let mut paper = Scene::paper().file().clone();
    paper.operating_rpm = Some(1200.0);
    let mut collar = collar().file().clone();
    collar.operating_rpm = Some(3800.0);
    [paper, collar].map(|file| {
        let speed = file.operating_rpm.unwrap();
        (Scene::try_from(file).unwrap(), rad_per_s(speed))
    })
}

fn limits(scene: &Scene) -> HeatLimits {
    let plate = Plate::new(scene, SMALL);
    let model = SpectralModel::new(plate, SpeedRange::new(0.0, 100.0), Strategy::Dense).unwrap();
    HeatLimits::new(scene, &model).unwrap().unwrap()
}

/// The rise at which `holds` becomes false, between two rises.
fn bisected(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    assert!(holds(low) && !holds(high));
    for _ in 0..45 {
        let middle = 0.5 * (low + high);
        if holds(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// The reference is a search over the temperatures of whole scenes, until their first critical speed is the operating
/// speed. The limit does not depend on the temperature of the scene itself.
#[test]
fn the_operating_limit_is_the_rise_at_which_the_critical_speed_is_the_operating_speed() {
    for (base, operating) in saws() {
        let lowest = |rise_k: f64| {
            let plate = Plate::new(&heated(&base, rise_k), SMALL);
            let critical = SpectralModel::critical_speeds(&plate);
            critical.map_or(0.0, |critical| critical[0].speed_rad_per_s)
        };
        let expected = bisected(0.0, 200.0, |rise_k| lowest(rise_k) > operating);
        for scene_k in [0.0, 0.5 * expected, 1.1 * expected] {
            let found = limits(&heated(&base, scene_k));
            let limit = found.operating.unwrap();
            assert_close("operating limit", limit.rise_k, expected, 1e-9);
            assert!(limit.name.diameters() >= 2 && !found.buckles_first && !found.past_critical);
            // The curves pass through this limit.
            let curve = &found.curves[0];
            let below = curve.rise_k.partition_point(|rise| *rise < expected);
            assert!(curve.speed_rad_per_s[below - 1] > operating);
            assert!(curve.speed_rad_per_s[below] < operating);
            assert_close(
                "curve",
                curve.speed_rad_per_s[0],
                lowest(curve.rise_k[0]),
                1e-9,
            );
        }
    }
}

#[test]
fn the_blade_buckles_where_no_critical_speed_can_be_computed_any_more() {
    for (base, _) in saws() {
        let flat = |rise_k: f64| {
            SpectralModel::critical_speeds(&Plate::new(&heated(&base, rise_k), SMALL))
        };
        let expected = bisected(0.0, 500.0, |rise_k| flat(rise_k).is_ok());
        let found = limits(&heated(&base, 5.0)).buckling.unwrap();
        assert_close("buckling", found.rise_k, expected, 1e-8);
        // The error names it too, as a share of the temperature of the scene.
        match flat(2.0 * expected) {
            Err(SpectrumError::Buckled { share, diameters }) => {
                assert_close("share", share, 0.5, 1e-8);
                assert_eq!(diameters, found.name.diameters());
            }
            other => panic!("{other:?}"),
        }
    }
}

/// If the rim is cold, the blade buckles into a dish or tilts: this is the limit in the other direction.
#[test]
fn a_cold_rim_has_a_limit_of_its_own() {
    let found = limits(&heated(&collar(), -1.0));
    let dish = found.buckling.unwrap();
    assert!(dish.rise_k < 0.0 && dish.name.diameters() < 2, "{dish:?}");
    assert!(found.buckles_first && found.operating.is_none());
    let expected = -bisected(0.0, 500.0, |fall_k| {
        let plate = Plate::new(&heated(&collar(), -fall_k), SMALL);
        SpectralModel::critical_speeds(&plate).is_ok()
    });
    assert_close("dish", dish.rise_k, expected, 1e-8);
}

/// A blade that is rolled so much that it is a dish when cold, and flat when the rim is warm.
#[test]
fn an_overtensioned_blade_becomes_flat_when_it_is_warm() {
    let both = |rise_k: f64| {
        let membrane = |saw: Scene| saw.file().membrane.clone().unwrap();
        let mut both = membrane(heated(&collar(), rise_k));
        both.roll_tension = membrane(rolled(&collar(), 3e-3)).roll_tension;
        scene_with(&collar(), serde_json::to_value(both).unwrap())
    };
    let flat =
        |rise_k: f64| SpectralModel::critical_speeds(&Plate::new(&both(rise_k), SMALL)).is_ok();
    let expected = bisected(60.0, 0.0, flat);
    let found = limits(&both(60.0)).flat_from.unwrap();
    assert_close("flat from", found.rise_k, expected, 1e-8);
    assert_eq!(found.name.diameters(), 0);
    assert!(limits(&heated(&collar(), 5.0)).flat_from.is_none());
}

/// Above its critical speed the saw needs no heat to reach it.
#[test]
fn a_saw_past_its_critical_speed_is_reported() {
    let fast = heated(&collar(), 3.0).edited(|saw| saw.operating_rpm = Some(6000.0));
    let found = limits(&fast.unwrap());
    assert!(found.past_critical && found.operating.is_none());
}
