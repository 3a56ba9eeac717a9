//! The list of instability bands is a property of the saw, not of the sweep.

use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{Accuracy, Scene, SpeedRange, rpm};
use sawflutter::modes::{SpectralModel, Strategy};
use sawflutter::stability::InstabilityKind;

use crate::certified::{self, assert_same, bands_of};

#[test]
fn the_paper_saw_has_the_same_bands_from_25_to_400_speeds() {
    let range = SpeedRange::between_rpm(0.0, 3000.0);
    let plate = Plate::new(&Scene::paper(), Resolution::of(Accuracy::Design));
    let model = SpectralModel::new(plate, range, Strategy::Reduced).unwrap();
    let reference = bands_of(&model, range, 400);
    for count in [25, 50, 100] {
        assert_same(
            &bands_of(&model, range, count),
            &reference,
            &format!("{count} speeds"),
        );
    }
    // Widths in rpm of the narrow bands that a sweep in steps of 50 rpm misses.
    for (near, narrowest, widest) in [
        (1905.0, 1.0, 3.0),
        (2261.0, 8.0, 14.0),
        (2397.0, 8.0, 14.0),
        (2705.0, 6.0, 14.0),
        (2852.0, 8.0, 16.0),
    ] {
        let found = reference.iter().find(|b| {
            b.kind == InstabilityKind::Flutter
                && (rpm(b.from_rad_per_s) - 9.0..=rpm(b.to_rad_per_s) + 9.0).contains(&near)
        });
        let width = found.map(|b| rpm(b.range().width()));
        assert!(
            width.is_some_and(|w| w > narrowest && w < widest),
            "{near}: {width:?}"
        );
    }
}

/// One of the 200 saws in `tests/trials/drawn_bands.rs`.
#[test]
fn drawn_saws_have_the_same_bands_from_25_and_from_100_speeds() {
    let mut bands = [0, 0];
    for file in certified::drawn_saws(16) {
        let found = certified::assert_same_from_few_speeds(&file);
        bands = [bands[0] + found[0], bands[1] + found[1]];
    }
    assert!(
        bands.iter().all(|count| *count > 16),
        "the draw tests nothing: {bands:?}"
    );
}

/// The reduced and the full model have the same onsets to 1e-6; the reduced model is accurate to 1e-8 of the chart's
/// height in frequency.
#[test]
fn onsets_of_the_projection_are_those_of_the_full_model() {
    let range = SpeedRange::between_rpm(0.0, 2300.0);
    let resolution = Resolution {
        max_diameters: 7,
        radial_functions: 4,
    };
    let model = |strategy| {
        SpectralModel::new(Plate::new(&Scene::paper(), resolution), range, strategy).unwrap()
    };
    let reduced = bands_of(&model(Strategy::Reduced), range, 40);
    let dense = bands_of(&model(Strategy::Dense), range, 40);
    assert_eq!(reduced.len(), dense.len());
    for (x, y) in reduced.iter().zip(&dense) {
        assert!(
            (x.from_rad_per_s / y.from_rad_per_s - 1.0).abs() < 1e-6
                && (x.to_rad_per_s / y.to_rad_per_s - 1.0).abs() < 1e-6
        );
        assert!((x.peak_growth_per_s / y.peak_growth_per_s - 1.0).abs() < 1e-4);
    }
}
