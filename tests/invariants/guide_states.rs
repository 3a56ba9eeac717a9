//! Bands of saws whose pads have films and controllers, against every eigenvalue of the full model.

use std::f64::consts::TAU;

use sawflutter::model::scene::{
    GuideArmFile, GuideControllerFile, GuideFile, GuideFilmFile, Scene, SceneFile, SweepFile, rpm,
};
use sawflutter::stability::Analysis;

use crate::damped_bands::peak_growth_of_bands;

/// The built-in saw with its pad changed.
fn saw_with(change: impl FnOnce(&mut sawflutter::model::scene::GuideFile)) -> SceneFile {
    let mut file = Scene::paper().file().clone();
    change(&mut file.guides[0]);
    (file.cut, file.runup, file.sweep) = (None, None, None);
    file
}

const ARM: GuideArmFile = GuideArmFile {
    stiffness_n_per_m: 2e6,
    mass_kg: 10.0,
    damping_n_s_per_m: 0.0,
    loss_factor: 0.0,
};

/// Films whose lag is far below, among and above the periods of the blade, and some that hold it like springs.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn every_growing_mode_of_a_saw_with_a_film_has_its_band() {
    for (damping_n_s_per_m, lag_s, arm) in [
        (300.0, 1e-5, None),
        (300.0, 1e-3, None),
        (3e3, 2e-2, None),
        (2e4, 1e-3, None),
        (2e4, 1e-3, Some(ARM)),
        (300.0, 0.1, Some(ARM)),
    ] {
        let file = saw_with(|pad| {
            pad.damping_n_s_per_m = damping_n_s_per_m;
            pad.film = Some(GuideFilmFile { lag_s });
            pad.arm = arm;
        });
        let found = peak_growth_of_bands(&file);
        let what = format!("{damping_n_s_per_m} N·s/m, {lag_s} s, {arm:?}: {found:?}");
        assert!(found.is_ok_and(|peak_per_s| peak_per_s > 0.1), "{what}");
    }
}

/// Without a spring nothing holds the blade along its arbor, and its states follow it as at rest.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn every_growing_mode_of_a_saw_on_films_alone_has_its_band() {
    let file = saw_with(|pad| {
        (pad.stiffness_n_per_m, pad.damping_n_s_per_m) = (0.0, 300.0);
        pad.film = Some(GuideFilmFile { lag_s: 1e-3 });
    });
    let found = peak_growth_of_bands(&file);
    assert!(
        found.as_ref().is_ok_and(|peak_per_s| *peak_per_s > 0.1),
        "{found:?}"
    );
}

/// Controllers of the velocity, with a low pass of either sign, with a resonance, and with growing poles. The damper of the pad keeps
/// them from feeding waves beyond the chart.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn every_growing_mode_of_a_controlled_saw_has_its_band() {
    let controllers: [(f64, &[f64], &[f64]); 5] = [
        (0.0, &[200.0, 1e5], &[1.0]),
        (150.0, &[2e5], &[1e-3, 1.0]),
        (0.0, &[-2e5], &[1e-3, 1.0]),
        (20.0, &[3e9], &[1.0, 20.0, 9e4]),
        (50.0, &[-1e4, 2e6, 1e9], &[1.0, -5.0, 4e4]),
    ];
    for (damping_n_s_per_m, numerator, denominator) in controllers {
        let file = saw_with(|pad| {
            pad.damping_n_s_per_m = damping_n_s_per_m;
            pad.controller = Some(GuideControllerFile {
                numerator: numerator.to_vec(),
                denominator: denominator.to_vec(),
            });
        });
        let found = peak_growth_of_bands(&file);
        let what = format!("{numerator:?} over {denominator:?}: {found:?}");
        assert!(found.is_ok_and(|peak_per_s| peak_per_s > 0.1), "{what}");
    }
}

/// A clamped blade held at its rim by a controller, beside the spring of the pad.
fn clamped_saw(stiffness_n_per_m: f64, numerator: &str, denominator: &str) -> Scene {
    Scene::from_json(&format!(
        r#"{{
  "name": "clamped saw on a controlled guide",
  "blade": {{ "outer_diameter_m": 0.350, "inner_diameter_m": 0.030, "thickness_m": 0.0025,
    "material": {{ "youngs_modulus_pa": 2.1e11, "poisson_ratio": 0.3, "density_kg_per_m3": 7850 }} }},
  "mount": {{ "kind": "collar", "diameter_m": 0.100, "in_plane": "fixed" }},
  "guides": [{{ "radius_m": 0.155, "angle_deg": -60, "radial_length_m": 0.03, "tangential_length_m": 0.03,
    "stiffness_n_per_m": {stiffness_n_per_m},
    "controller": {{ "numerator": {numerator}, "denominator": {denominator} }} }}],
  "damping": {{ "material_retardation_time_s": 2e-6 }},
  "operating_rpm": 4500
}}"#
    ))
    .unwrap()
}

/// A magnetic guide with a PID controller, whose integrator has its pole at zero, and the same with this pole at 0.1 1/s. Values of
/// radial finite elements with states of first order: at 4500 rpm the slowest motion decays with 2.146 1/s at 44.84 Hz, and a growth of
/// 0.25 1/s is reached at 6637.8 rpm.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn a_saw_with_an_integrator_has_its_decay_and_its_flutter_speed() {
    for (numerator, denominator) in [
        ("[22.0, 20050.0, 500000.0]", "[1e-4, 1, 0]"),
        ("[22.0, 20052.2, 502000.0]", "[1e-4, 1.00001, 0.1]"),
    ] {
        let found = Analysis::new(&clamped_saw(0.0, numerator, denominator)).unwrap();
        let slowest = found.fastest_operating.unwrap();
        crate::common::assert_close("decay", -slowest.re, 2.146, 5e-3);
        crate::common::assert_close("frequency", slowest.im / TAU, 44.84, 1e-3);
        let flutter = rpm(found.flutter_speed_rad_per_s.unwrap());
        crate::common::assert_close("flutter speed", flutter, 6637.8, 1e-3);
        assert!(
            found.chart.certificate.miscounts.is_empty(),
            "{denominator}"
        );
    }
}

/// A guide that yields slowly, k/(1 + 2s λ): its own motion decays with 0.571 1/s by the same finite elements, and no unknown of the method is
/// slower or oscillates below the blade.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn the_slowest_motion_of_a_slow_guide_is_its_own() {
    let found = Analysis::new(&clamped_saw(1e5, "[30000.0]", "[2.0, 1.0]")).unwrap();
    let slowest = found.fastest_operating.unwrap();
    crate::common::assert_close("decay", -slowest.re, 0.571, 1e-3);
    assert_eq!(slowest.im, 0.0);
    let lowest = found.modes_at_rest[0].mode.lambda.im / TAU;
    crate::common::assert_close("frequency at rest", lowest, 127.47, 1e-3);
}

/// Six equal films that lie evenly around the blade have 18 real eigenvalues near their decay, and exactly double ones: the search does not
/// divide the speeds without end.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn six_equal_films_are_searched_in_few_speeds() {
    let saw = crate::common::scene("collar-400mm");
    let mut file = saw.file().clone();
    file.guides = (0..6)
        .map(|k| GuideFile {
            radius_m: 0.17,
            angle_deg: 10.0 + 60.0 * f64::from(k),
            radial_length_m: 0.03,
            tangential_length_m: 0.04,
            stiffness_n_per_m: 3e4,
            damping_n_s_per_m: 1e4,
            film: Some(GuideFilmFile { lag_s: 0.01 }),
            ..GuideFile::default()
        })
        .collect();
    (file.tolerance, file.operating_rpm) = (Some(0.1), None);
    file.sweep = Some(SweepFile {
        from_rpm: 4000.0,
        to_rpm: 7600.0,
    });
    let found = Analysis::new(&saw.edited(|saw| *saw = file).unwrap()).unwrap();
    let certificate = &found.chart.certificate;
    assert!(!certificate.gave_up, "{certificate:?}");
    assert!(certificate.speeds_checked < 2000, "{certificate:?}");
    assert!(
        certificate.violations_rad_per_s.is_empty(),
        "{certificate:?}"
    );
    // Counts on the full model, which know no curves, find no other growing mode on both sides of every onset and at four other speeds.
    let onsets = found.chart.instabilities.len().min(8);
    assert!(onsets > 0, "{certificate:?}");
    assert_eq!(certificate.full_basis_counts, 2 * onsets + 4);
    assert_eq!(certificate.uncertain_counts, 0);
    assert!(certificate.miscounts.is_empty(), "{certificate:?}");
}
