//! Bands of saws whose pads stand on arms, against every eigenvalue of the full model.

use sawflutter::model::scene::{GuideArmFile, Scene, SceneFile};

use crate::bands::wrong_bands;
use crate::damped_bands::peak_growth_of_bands;

/// The built-in saw with its pad on an arm.
fn saw_on(arm: GuideArmFile) -> SceneFile {
    let mut file = Scene::paper().file().clone();
    file.guides[0].arm = Some(arm);
    (file.cut, file.runup, file.sweep) = (None, None, None);
    file
}

/// Arms whose heads have frequencies below, among and above those of the blade.
const ARMS: [GuideArmFile; 3] = [arm(1e5, 2.0), arm(2e6, 10.0), arm(2e7, 5.0)];

const fn arm(stiffness_n_per_m: f64, mass_kg: f64) -> GuideArmFile {
    GuideArmFile {
        stiffness_n_per_m,
        mass_kg,
        damping_n_s_per_m: 0.0,
        loss_factor: 0.0,
    }
}

#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn every_growing_mode_of_a_saw_on_an_arm_has_its_band() {
    for arm in ARMS {
        let wrong = wrong_bands(&saw_on(arm));
        assert!(wrong.is_empty(), "{arm:?}: {wrong:#?}");
    }
}

/// A damped arm damps some waves hardly at all, whose growth is near rounding.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn every_growing_mode_of_a_saw_on_a_damped_arm_has_its_band() {
    for arm in ARMS {
        for damping_n_s_per_m in [20.0, 2000.0] {
            let damped = GuideArmFile {
                damping_n_s_per_m,
                ..arm
            };
            let peak_per_s = peak_growth_of_bands(&saw_on(damped)).unwrap();
            assert!(peak_per_s > 0.1, "{damped:?} {peak_per_s}");
        }
    }
}

/// A damper so strong that it holds the blade like a spring, on the frame and on an arm.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn every_growing_mode_of_a_saw_on_a_strong_damper_has_its_band() {
    for arm in [None, Some(ARMS[1])] {
        let mut file = saw_on(ARMS[0]);
        file.guides[0].arm = arm;
        file.guides[0].damping_n_s_per_m = 20_000.0;
        let peak_per_s = peak_growth_of_bands(&file).unwrap();
        assert!(peak_per_s > 0.1, "{arm:?} {peak_per_s}");
    }
}
