//! The list of bands, compared with every eigenvalue of the full model: saws that an earlier search got wrong, and
//! random saws that are computed quickly. `tests/trials/drawn_bands.rs` takes 300.

use sawflutter::model::scene::{Accuracy, GuideFile, Scene, SceneFile, SweepFile};
use sawflutter::stability::Analysis;

use crate::bands;

/// Numbers of saws of `bands::drawn_saw`.
const CHEAP: [u64; 3] = [0, 1, 2];

fn pad(radius_m: f64, angle_deg: f64, side_m: f64, stiffness_n_per_m: f64) -> GuideFile {
    GuideFile {
        radius_m,
        angle_deg,
        radial_length_m: side_m,
        tangential_length_m: side_m,
        stiffness_n_per_m,
        damping_n_s_per_m: 0.0,
        ..GuideFile::default()
    }
}

/// The 400 mm blade between collars, on guides.
fn collar_saw(guides: Vec<GuideFile>) -> SceneFile {
    let mut file = crate::common::scene("collar-400mm").file().clone();
    file.accuracy = Accuracy::Draft;
    file.guides = guides;
    file
}

fn read(name: &str) -> SceneFile {
    let path = crate::common::path(&format!("tests/reference/{name}.json"));
    let mut file = Scene::from_path(path).unwrap().file().clone();
    file.accuracy = Accuracy::Draft;
    file
}

#[track_caller]
fn assert_right(file: &SceneFile) {
    let wrong = bands::wrong_bands(file);
    assert!(wrong.is_empty(), "{wrong:#?}\n{}", bands::list(file));
}

/// Its quadruples of eigenvalues change their order in frequency within a band.
#[test]
fn bands_of_a_collar_blade_on_a_small_pad_end_where_its_eigenvalues_do() {
    assert_right(&read("band_trial_1"));
}

/// A quadruple of its eigenvalues ends on the real axis, at 3100.3 rpm, and continues as two real λ.
#[test]
fn flutter_that_ends_as_two_real_eigenvalues_ends_there() {
    assert_right(&read("band_trial_2"));
}

#[test]
fn flutter_past_the_second_pair_of_critical_speeds_is_found_on_two_equal_pads() {
    assert_right(&collar_saw(
        [0.0, 180.0]
            .map(|angle| pad(0.17, angle, 0.03, 1e5))
            .to_vec(),
    ));
}

/// Flutter of 1 Hz is not divergence.
#[test]
fn slow_flutter_is_not_called_divergence() {
    assert_right(&collar_saw(vec![pad(0.19, 0.0, 0.0, 2e5)]));
}

#[test]
fn bands_of_weak_pads_on_a_loose_blade_do_not_contradict_the_krein_index() {
    let mut file = Scene::paper().file().clone();
    (file.sweep, file.accuracy) = (None, Accuracy::Draft);
    file.guides[0].stiffness_n_per_m = 100.0;
    assert_right(&file);
    // A speed of the search may be next to an edge: these ends place one within 1e-9 of an edge.
    for to_rpm in [2950.0, 2999.4, 3006.0, 3009.0] {
        file.sweep = Some(SweepFile {
            from_rpm: 0.0,
            to_rpm,
        });
        let scene = Scene::try_from(file.clone()).unwrap();
        let certificate = Analysis::new(&scene).unwrap().report().certificate;
        assert_eq!(certificate.krein_violations, 0, "to {to_rpm} rpm");
    }
}

/// The saws among the first thirty whose spectra are computed in a second.
#[test]
#[cfg_attr(debug_assertions, ignore = "dense solves: run it in release")]
fn lists_of_bands_of_drawn_saws_are_those_of_all_eigenvalues() {
    for saw in CHEAP {
        let wrong = bands::wrong_bands(&bands::drawn_saw(saw));
        assert!(wrong.is_empty(), "saw {saw}: {wrong:#?}");
    }
}
