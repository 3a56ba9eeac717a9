//! A list of bands, compared with one from four times as many speeds.
//!
//! Detection uses the order of Krein signs, so that it must find the same bands from a few speeds as from hundreds, and
//! the Krein index must agree everywhere.
#![allow(dead_code)]

use proptest::strategy::{Strategy as _, ValueTree};
use proptest::test_runner::TestRunner;
use sawflutter::model::evenly_spaced;
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{GuideFile, Scene, SceneFile, SpeedRange, rpm};
use sawflutter::modes::{SpectralModel, Strategy};
use sawflutter::stability::{Instability, InstabilityKind, undamped_bands};

pub fn bands_of(model: &SpectralModel, range: SpeedRange, count: usize) -> Vec<Instability> {
    let found = undamped_bands(model, range, count).unwrap();
    let (bands, certificate) = (found.instabilities, found.certificate);
    let lowest = model.critical[0].speed_rad_per_s;
    let speeds = evenly_spaced(range.ends(), count);
    let above = speeds.iter().filter(|speed| **speed > lowest).count();
    assert!(certificate.speeds_checked >= above);
    assert_eq!(
        certificate.violations_rad_per_s,
        Vec::<f64>::new(),
        "Krein index"
    );
    bands
}

/// Compares number, kind, and edges to 1e-9 of the speed.
pub fn assert_same(left: &[Instability], right: &[Instability], what: &str) {
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
        ..GuideFile::default()
    };
    file.guides = vec![pad(draw[2], draw[3], draw[4], draw[5])];
    if draw[6] > 0.5 {
        file.guides.push(pad(draw[7], draw[8], draw[0], draw[1]));
    }
    file
}

/// The first saws of a sequence that is the same in every run.
pub fn drawn_saws(count: usize) -> Vec<SceneFile> {
    let mut runner = TestRunner::deterministic();
    let numbers = proptest::array::uniform9(0.0..1.0_f64);
    let mut draw = || numbers.new_tree(&mut runner).unwrap().current();
    (0..count).map(|_| drawn_saw(draw())).collect()
}

/// Checks a saw on a basis small enough for hundreds of saws; gives the numbers of bands of flutter and of divergence.
pub fn assert_same_from_few_speeds(file: &SceneFile) -> [usize; 2] {
    let scene = Scene::try_from(file.clone()).unwrap();
    let resolution = Resolution {
        max_diameters: 5,
        radial_functions: 3,
    };
    let plate = Plate::new(&scene, resolution);
    let first = SpectralModel::critical_speeds(&plate).unwrap()[0].speed_rad_per_s;
    let range = SpeedRange::new(0.0, 1.5 * first);
    let model = SpectralModel::new(plate, range, Strategy::Reduced).unwrap();
    let fine = bands_of(&model, range, 100);
    let what = || serde_json::to_string(file).unwrap();
    assert_same(&bands_of(&model, range, 25), &fine, &what());
    let earliest = first * (1.0 - 1e-9);
    assert!(
        fine.iter().all(|band| band.from_rad_per_s >= earliest),
        "unstable below the first critical speed: {}",
        what()
    );
    let of = |kind| fine.iter().filter(|band| band.kind == kind).count();
    [InstabilityKind::Flutter, InstabilityKind::Divergence].map(of)
}
