//! Deflection under forces fixed in space, and the limits that `check` derives from it.

use nalgebra::{DMatrix, DVector};
use sawflutter::analyses::check::{Limits, check};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{Accuracy, LimitsFile, Scene, rad_per_s, rpm};
use sawflutter::model::system::GyroscopicSystem;

use crate::common::assert_close;

/// The basis on which a check solves point loads.
const POINT_LOADS: Resolution = Resolution {
    max_diameters: 30,
    radial_functions: 12,
};

fn saw(gap_m: Option<f64>) -> Scene {
    let saw = Scene::paper().edited(|saw| {
        saw.accuracy = Accuracy::Draft;
        saw.guides[0].gap_m = gap_m;
        let cut = saw.cut.as_mut().expect("a cut");
        cut.teeth_in_cut = Some(4);
        cut.speeds.clear();
    });
    saw.unwrap_or_else(|error| panic!("{error}"))
}

/// K(Ω)⁻¹ applied to a load, by another library, on all functions.
fn answer(system: &GyroscopicSystem, speed: f64, load: &DVector<f64>) -> DVector<f64> {
    let stiffness = system.stiffness_at(speed);
    let k = DMatrix::from_fn(stiffness.nrows(), stiffness.ncols(), |i, j| {
        stiffness[(i, j)]
    });
    k.lu().solve(load).expect("stiff below the critical speed")
}

#[test]
fn stiffness_over_speed_and_the_speed_that_fills_a_gap_are_those_of_the_full_model() {
    let plate = Plate::new(&saw(None), POINT_LOADS);
    let system = GyroscopicSystem::of_plate(&plate);
    let at = |radius_m: f64, angle_deg: f64| {
        DVector::from_vec(plate.functions_at(radius_m, angle_deg.to_radians()))
    };
    let rim = plate.blade.outer_radius_m;
    // Four teeth of 42, 4.5 N across the blade on each, around θ = 0.
    let pitch = 360.0 / 42.0;
    let teeth = [-1.5, -0.5, 0.5, 1.5].map(|place| at(rim, place * pitch) * 4.5);
    let load: DVector<f64> = teeth.iter().sum();
    let pad = at(0.2, -55.0);
    let filled_at = rad_per_s(1200.0);
    let gap_m = pad.dot(&answer(&system, filled_at, &load)).abs();
    let limits = Limits::at(rad_per_s(1000.0));
    let scene = saw(Some(gap_m));
    let report = check(&scene, &limits).unwrap();

    let curve = &report.rim_stiffness;
    let point = at(rim, 0.0);
    for k in [0, 17, 33, 40] {
        let speed = rad_per_s(curve.rpm[k]);
        let expected = 1.0 / point.dot(&answer(&system, speed, &point));
        assert_close("stiffness of the rim", curve.n_per_m[k], expected, 1e-6);
    }
    assert_close(
        "at rest",
        curve.n_per_m[0],
        report.rim_stiffness_at_rest_n_per_m,
        1e-9,
    );
    // Near the critical speed the stiffness of one wave decreases as 1 − Ω²/Ω_c².
    assert!(curve.rpm[40] < report.critical_rpm[0] && curve.n_per_m[40] < 0.15 * curve.n_per_m[0]);

    let gap = report
        .verdict
        .limits
        .iter()
        .find(|c| c.key == "gap")
        .expect("a gap");
    assert_close(
        "speed that fills the gap",
        gap.found_rpm.expect("filled"),
        1200.0,
        1e-6,
    );
    assert!(gap.is_kept());
    let faster = Limits::at(rad_per_s(1210.0));
    let check = check(&scene, &faster).unwrap();
    assert!(
        check
            .failures()
            .iter()
            .any(|told| told.starts_with("gap of guide 1"))
    );
}

#[test]
fn the_rim_may_run_at_a_hundred_metres_per_second() {
    let scene = saw(None);
    let limit_rpm = rpm(100.0 / 0.355);
    for (operating_rpm, passes) in [(limit_rpm - 1.0, true), (limit_rpm + 1.0, false)] {
        let limits = Limits {
            limits: LimitsFile {
                margin: Some(1.0),
                ..LimitsFile::default()
            },
            ..Limits::at(rad_per_s(operating_rpm))
        };
        let report = check(&scene, &limits).unwrap();
        let rim = report
            .verdict
            .limits
            .iter()
            .find(|c| c.key == "rim_speed")
            .expect("a rim");
        assert_eq!(rim.is_kept(), passes);
        assert_close("limit", rim.found_rpm.expect("a speed"), limit_rpm, 1e-12);
        let speed = report.rim_speed_m_per_s;
        assert_close(
            "speed of the rim",
            speed,
            operating_rpm / limit_rpm * 100.0,
            1e-12,
        );
    }
}
