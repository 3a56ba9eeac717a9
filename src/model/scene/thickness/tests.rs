use super::*;
use crate::model::scene::{Blade, RimFile, Scene};

fn rows(list: &[[f64; 2]]) -> Vec<ThicknessRow> {
    let row = |&[radius_m, thickness_m]: &[f64; 2]| ThicknessRow {
        radius_m,
        thickness_m,
    };
    list.iter().map(row).collect()
}

fn blade_with(list: &[[f64; 2]]) -> Result<Blade, SceneError> {
    let scene = Scene::paper().edited(|saw| saw.blade.profile = rows(list));
    scene.map(|scene| *scene.blade())
}

/// The hub is 2.8 mm thick; a taper from 0.2 m leads to 2 mm at 0.3 m, where a step leads to 1.6 mm.
#[test]
fn thickness_is_that_of_the_hub_then_straight_between_rows_then_constant() {
    let blade = blade_with(&[[0.2, 2.8e-3], [0.3, 2.0e-3], [0.3, 1.6e-3]]).expect("a blade");
    for [radius, expected] in [
        [0.11, 2.8e-3],
        [0.25, 2.4e-3],
        [0.3, 2.0e-3],
        [0.35, 1.6e-3],
    ] {
        assert!(
            (blade.thickness_at_m(radius) - expected).abs() < 1e-15,
            "{radius}"
        );
    }
    assert_eq!(blade.knots_m(), [0.2, 0.3]);
    assert_eq!(
        blade.edges_m(),
        [blade.inner_radius_m, 0.2, 0.3, blade.outer_radius_m]
    );
    let [least, largest] = blade.thickness_range_m();
    assert!((least - 1.6e-3).abs() < 1e-15 && (largest - 2.8e-3).abs() < 1e-15);
}

/// The volume of a taper follows from Pappus's theorem.
#[test]
fn the_mass_is_that_of_the_rings() {
    let step = blade_with(&[[0.2, 1.4e-3]]).expect("a blade");
    let (a, b) = (step.inner_radius_m, step.outer_radius_m);
    let expected =
        7800.0 * std::f64::consts::PI * (2.8e-3 * (0.04 - a * a) + 1.4e-3 * (b * b - 0.04));
    assert!((step.mass_kg() / expected - 1.0).abs() < 1e-14);
    let plain = *Scene::paper().blade();
    let inertia = 0.5 * plain.mass_kg() * (a * a + b * b);
    assert!((plain.polar_inertia_kg_m2() / inertia - 1.0).abs() < 1e-14);
    let taper = blade_with(&[[a, 2.8e-3], [b, 1.4e-3]]).expect("a blade");
    // The volume of the trapezium with sides of 2.8 and 1.4 mm is its area times the path of its centroid.
    let width = b - a;
    let area = 2.1e-3 * width;
    let centroid = a + width / 3.0 * (2.8 + 2.0 * 1.4) / (2.8 + 1.4);
    let expected_taper = 7800.0 * std::f64::consts::TAU * area * centroid;
    assert!((taper.mass_kg() / expected_taper - 1.0).abs() < 1e-14);
}

#[test]
fn rows_that_no_blade_has_are_refused_by_name() {
    let cases: [(&[[f64; 2]], &str); 5] = [
        (&[[0.3, 2e-3], [0.2, 2e-3]], "blade.profile[1].radius_m"),
        (&[[0.4, 2e-3]], "blade.profile[0].radius_m"),
        (
            &[[0.2, 2e-3], [0.2, 3e-3], [0.2, 2e-3]],
            "blade.profile[2].radius_m",
        ),
        (&[[0.2, 2e-4]], "blade.profile[0].thickness_m"),
        (&[[0.2, f64::NAN]], "blade.profile[0].thickness_m"),
    ];
    for (list, expected) in cases {
        match blade_with(list) {
            Err(SceneError::Value(refused)) => assert_eq!(refused.key, expected),
            other => panic!("{expected}: {other:?}"),
        }
    }
    let many = [[0.2, 2e-3]; 9];
    let error = blade_with(&many).expect_err("too many").to_string();
    assert!(error.contains("blade.profile must be "), "{error}");
    assert!(error.contains("(you gave 9)"), "{error}");
}

#[test]
fn the_mass_of_teeth_needs_their_number_and_a_place_on_the_blade() {
    let with = |mass: f64, radius_m: Option<f64>, teeth: Option<u32>| {
        Scene::paper().edited(|saw| {
            saw.cut = None;
            saw.blade.teeth = teeth;
            saw.blade.rim = Some(RimFile {
                mass_per_tooth_kg: mass,
                radius_m,
            });
        })
    };
    let scene = with(0.002, None, Some(40)).expect("a saw");
    let rim = scene.blade().rim.expect("a mass");
    assert_eq!((rim.mass_kg, rim.radius_m), (0.08, 0.355));
    assert!(
        with(0.0, None, Some(40))
            .expect("a saw")
            .blade()
            .rim
            .is_none()
    );
    for (result, expected) in [
        (with(0.002, None, None), "blade.teeth"),
        (with(0.002, Some(0.4), Some(40)), "blade.rim.radius_m"),
        (with(-0.002, None, Some(40)), "blade.rim.mass_per_tooth_kg"),
        // A mass of 4 g is given as 4 kg.
        (with(4.0, None, Some(40)), "blade.rim.mass_per_tooth_kg"),
    ] {
        match result {
            Err(SceneError::Value(refused)) => assert_eq!(refused.key, expected),
            other => panic!("{expected}: {other:?}"),
        }
    }
}
