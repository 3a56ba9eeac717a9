//! The list of instability bands is a property of the saw, not of the sweep.
//!
//! Detection goes by the order of Krein signs, so it must find the same bands from a
//! handful of speeds as from hundreds, and the Krein index must match everywhere.

use proptest::strategy::{Strategy as _, ValueTree};
use proptest::test_runner::TestRunner;
use sawflutter::campbell::even_speeds;
use sawflutter::plate::{Plate, Resolution};
use sawflutter::scene::{Accuracy, GuideFile, Scene, SceneFile, rad_per_s, rpm};
use sawflutter::spectrum::{SpectralModel, Strategy};
use sawflutter::stability::{Instability, InstabilityKind, undamped_bands};

fn bands_of(model: &SpectralModel, range: (f64, f64), count: usize) -> Vec<Instability> {
    let (bands, certificate) = undamped_bands(model, range, count).unwrap();
    let lowest = model.critical[0].speed_rad_per_s;
    let speeds = even_speeds(range, count);
    let above = speeds.iter().filter(|speed| **speed > lowest).count();
    assert!(certificate.speeds_checked >= above);
    assert_eq!(
        certificate.violations_rad_per_s,
        Vec::<f64>::new(),
        "Krein index"
    );
    bands
}

/// Same number and kind, and edges to 1e-9 of the speed.
fn assert_same(left: &[Instability], right: &[Instability], what: &str) {
    let list = |bands: &[Instability]| -> Vec<String> {
        let line = |b: &Instability| {
            format!(
                "{:?} {}-{} {:.2e}",
                b.kind,
                rpm(b.from_rad_per_s),
                rpm(b.to_rad_per_s),
                b.peak_growth_per_s
            )
        };
        bands.iter().map(line).collect()
    };
    assert_eq!(
        left.len(),
        right.len(),
        "{what}: {:#?} {:#?}",
        list(left),
        list(right)
    );
    for (x, y) in left.iter().zip(right) {
        assert_eq!(x.kind, y.kind, "{what}");
        for (a, b) in [
            (x.from_rad_per_s, y.from_rad_per_s),
            (x.to_rad_per_s, y.to_rad_per_s),
        ] {
            let same = (a / b - 1.0).abs() < 1e-9;
            assert!(same, "{what}: {:#?} {:#?}", list(left), list(right));
        }
    }
}

#[test]
fn the_paper_saw_has_the_same_bands_from_25_to_400_speeds() {
    let range = (0.0, rad_per_s(3000.0));
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
    // Widths in rpm of the narrow bands that a 50 rpm sweep misses.
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
        let width = found.map(|b| rpm(b.to_rad_per_s - b.from_rad_per_s));
        assert!(
            width.is_some_and(|w| w > narrowest && w < widest),
            "{near}: {width:?}"
        );
    }
}

fn drawn_saw(draw: [f64; 9]) -> SceneFile {
    let mut file = Scene::paper().file().clone();
    file.blade.inner_diameter_m = (0.15 + 0.4 * draw[0]) * file.blade.outer_diameter_m;
    file.blade.thickness_m *= 0.5 + draw[1];
    let pad = |radius: f64, angle: f64, stiffness: f64, size: f64| GuideFile {
        radius_m: 0.355 * (0.5 + 0.4 * radius),
        angle_deg: 360.0 * angle,
        radial_length_m: 0.02 + 0.12 * size,
        tangential_length_m: 0.02 + 0.12 * size,
        stiffness_n_per_m: 10_f64.powf(4.5 + 3.5 * stiffness),
        damping_n_s_per_m: 0.0,
        gap_m: None,
    };
    file.guides = vec![pad(draw[2], draw[3], draw[4], draw[5])];
    if draw[6] > 0.5 {
        file.guides.push(pad(draw[7], draw[8], draw[0], draw[1]));
    }
    file
}

/// 200 drawn saws, on a basis small enough to draw so many.
#[test]
fn drawn_saws_have_the_same_bands_from_25_and_from_100_speeds() {
    let mut runner = TestRunner::deterministic();
    let unit = || 0.0..1.0_f64;
    let numbers = proptest::array::uniform9(unit());
    let (mut flutter, mut divergence) = (0, 0);
    for saw in 0..200 {
        let draw = numbers.new_tree(&mut runner).unwrap().current();
        let scene = Scene::try_from(drawn_saw(draw)).unwrap();
        let resolution = Resolution {
            max_diameters: 5,
            radial_functions: 3,
        };
        let plate = Plate::new(&scene, resolution);
        let first = SpectralModel::critical_speeds(&plate).unwrap()[0].speed_rad_per_s;
        let range = (0.0, 1.5 * first);
        let model = SpectralModel::new(plate, range, Strategy::Reduced).unwrap();
        let coarse = bands_of(&model, range, 25);
        let fine = bands_of(&model, range, 100);
        assert_same(&coarse, &fine, &format!("saw {saw}: {draw:?}"));
        for band in &fine {
            assert!(
                band.from_rad_per_s >= first * (1.0 - 1e-9),
                "unstable below the first critical speed"
            );
            match band.kind {
                InstabilityKind::Flutter => flutter += 1,
                InstabilityKind::Divergence => divergence += 1,
            }
        }
    }
    assert!(
        flutter > 200 && divergence > 200,
        "the draw tests nothing: {flutter} {divergence}"
    );
}

/// The projected and the whole system have the same onsets: 1e-6 is asked, and what the
/// projection promises (1e-8 of the chart's height in frequency) is well below.
#[test]
fn onsets_of_the_projection_are_those_of_the_whole_basis() {
    let range = (0.0, rad_per_s(2300.0));
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
