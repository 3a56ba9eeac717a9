//! Bands of saws whose pads have films and controllers, against every eigenvalue of the full model.

use sawflutter::model::scene::{
    GuideArmFile, GuideControllerFile, GuideFilmFile, Scene, SceneFile,
};

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
