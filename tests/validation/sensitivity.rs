//! Derivatives of eigenvalues, critical speeds and onsets, compared with central differences of whole analyses of
//! changed scenes.

use std::f64::consts::TAU;

use faer::c64;
use sawflutter::analyses::report::{self, DecidedSpeed};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{
    Accuracy, GuideFile, InPlane, Mount, Parameter, RimFile, Scene, SpeedRange, ThicknessRow,
    rad_per_s, rpm,
};
use sawflutter::modes::{SpectralModel, Strategy};
use sawflutter::stability::{Analysis, InstabilityKind, Sensitivity};

use super::saws::dense_analysis;

const RESOLUTION: Resolution = Resolution {
    max_diameters: 5,
    radial_functions: 4,
};

fn analysis_of(scene: &Scene) -> Analysis {
    dense_analysis(scene, RESOLUTION, [300.0, 2350.0], 20)
}

/// The scene with one number changed by a share of the change of a sensitivity.
fn moved(scene: &Scene, path: &str, share: f64) -> Scene {
    let parameter = Parameter::new(path);
    let own = parameter.get(scene.file()).unwrap();
    let value = if path.ends_with("angle_deg") {
        own + share
    } else {
        own * (1.0 + 0.01 * share)
    };
    scene.file().with(&[(&parameter, value)]).unwrap()
}

#[test]
fn sensitivities_agree_with_central_differences() {
    let bands = assert_central_differences(&Scene::paper());
    assert!(bands >= 4, "both kinds of onset are there: {bands}");
}

/// Two point springs leave a tilt free, whose momentum is constant: critical speeds then depend on the drift of that
/// motion, and so do their derivatives.
#[test]
fn sensitivities_agree_where_a_rigid_motion_is_free() {
    let paper = Scene::paper();
    let spring = |radius_m, angle_deg| GuideFile {
        radius_m,
        angle_deg,
        radial_length_m: 0.0,
        tangential_length_m: 0.0,
        ..paper.file().guides[0].clone()
    };
    let springs = vec![spring(0.2, -55.0), spring(0.25, 40.0)];
    assert_central_differences(&paper.edited(|saw| saw.guides = springs).unwrap());
}

/// A step of the thickness and the mass of teeth change the basis functions together with the matrices. Bands of this
/// saw are too narrow for differences of their onsets.
#[test]
fn critical_speeds_of_a_stepped_blade_with_heavy_teeth_move_as_reported() {
    let stepped = Scene::paper()
        .edited(|saw| {
            saw.blade.profile = vec![ThicknessRow {
                radius_m: 0.26,
                thickness_m: 2.4e-3,
            }];
            saw.blade.rim = Some(RimFile {
                mass_per_tooth_kg: 0.004,
                radius_m: Some(0.345),
            });
        })
        .unwrap();
    let found = analysis_of(&stepped)
        .sensitivities(rad_per_s(1000.0))
        .unwrap();
    let critical = |scene: &Scene| SpectralModel::critical_speeds(&Plate::new(scene, RESOLUTION));
    let middle = critical(&stepped).unwrap();
    let share = 0.01;
    for path in [
        "blade.thickness_m",
        "blade.profile[0].thickness_m",
        "blade.rim.mass_per_tooth_kg",
    ] {
        let told = found.iter().find(|own| own.parameter == path).expect(path);
        let [low, high] = [-share, share].map(|s| critical(&moved(&stepped, path, s)).unwrap());
        for (k, told) in told.critical_speeds_percent.iter().enumerate() {
            let told = 0.01 * told;
            let apart = high[k].speed_rad_per_s - low[k].speed_rad_per_s;
            let difference = apart / (2.0 * share * middle[k].speed_rad_per_s);
            let error = (told - difference).abs();
            assert!(error < 1e-6 * 0.01, "{path} {k}: {told} for {difference}");
        }
    }
}

/// A saw with flutter that becomes divergence where two real eigenvalues coalesce.
fn flutter_that_becomes_divergence() -> Scene {
    Scene::paper()
        .edited(|saw| {
            (saw.spline, saw.cut, saw.runup, saw.probe, saw.measured) =
                (None, None, None, None, None);
            saw.blade.outer_diameter_m = 0.6687;
            saw.blade.inner_diameter_m = 0.199;
            saw.blade.thickness_m = 0.002392;
            saw.mount = Mount::Collar {
                diameter_m: 0.199,
                in_plane: InPlane::Fixed,
                clamp_stiffness_n_m_per_rad_per_m: None,
            };
            saw.guides[0] = GuideFile {
                radius_m: 0.239,
                angle_deg: -7.5,
                radial_length_m: 0.111,
                tangential_length_m: 0.0502,
                stiffness_n_per_m: 113_900.0,
                ..saw.guides[0].clone()
            };
        })
        .unwrap()
}

/// Growth and frequency of a peak are those of an eigenvalue at its speed, also where flutter grows most beside the divergence that it
/// becomes. Reference: dense eigenvalues.
#[test]
fn the_peak_of_a_band_has_the_eigenvalue_of_its_speed() {
    let analysis = dense_analysis(
        &flutter_that_becomes_divergence(),
        RESOLUTION,
        [2050.0, 2200.0],
        12,
    );
    let mut beside = 0;
    for band in analysis.bands() {
        let found = c64::new(band.peak_growth_per_s, band.frequency_rad_per_s);
        let modes = analysis.model.full_modes(band.peak_rad_per_s).unwrap();
        let off = modes.iter().map(|mode| (mode.lambda - found).norm());
        let off = off.fold(f64::INFINITY, f64::min);
        assert!(off < 1e-6 * band.peak_growth_per_s, "{off:e}: {band}");
        let width = band.range().width();
        let ends = band.range().ends();
        let off_end = ends.map(|end| (band.peak_rad_per_s - end).abs());
        let is_flutter = band.kind == InstabilityKind::Flutter;
        beside += usize::from(is_flutter && off_end[0].min(off_end[1]) < 1e-2 * width);
    }
    assert!(beside > 0, "{:?}", analysis.bands());
}

/// A divergence that begins where a flutter mode becomes two real eigenvalues, 43 rpm above the nearest critical speed:
/// its onset changes as differences of the onset predict, and not as that critical speed does.
#[test]
fn the_onset_of_divergence_moves_with_its_coalescence() {
    let scene = flutter_that_becomes_divergence();
    let of = |scene: &Scene| dense_analysis(scene, RESOLUTION, [2110.0, 2200.0], 12);
    let middle = of(&scene);
    let diverges = |a: &Analysis| {
        let mut bands = a.chart.instabilities.iter();
        bands.position(|b| {
            b.kind == InstabilityKind::Divergence
                && b.from_rad_per_s > a.range_rad_per_s.from_rad_per_s
        })
    };
    let place = diverges(&middle).expect("divergence that begins within the range");
    let onset = |a: &Analysis| a.chart.instabilities[diverges(a).unwrap()].from_rad_per_s;
    let critical = middle.model.critical.iter().map(|c| c.speed_rad_per_s);
    let nearest = critical
        .map(|c| (c / onset(&middle) - 1.0).abs())
        .fold(1.0, f64::min);
    assert!(nearest > 1e-3, "{nearest}");
    let found = middle.sensitivities(rad_per_s(2150.0)).unwrap();
    let share = 0.01;
    for path in [
        "blade.thickness_m",
        "guides[0].stiffness_n_per_m",
        "guides[0].radius_m",
    ] {
        let entry = found.iter().find(|own| own.parameter == path).expect(path);
        let [low, high] = [-share, share].map(|s| onset(&of(&moved(&scene, path, s))));
        let difference = (high - low) / (2.0 * share * onset(&middle));
        let told = 0.01 * entry.onsets_percent[place].expect("an onset");
        assert!(
            (told - difference).abs() < 1e-5 * 0.01_f64.max(difference.abs()),
            "{path}: {told} {difference}"
        );
    }
}

/// The speed at which Re λ of a saw with damped material reaches the flutter threshold. Reference: differences of the speed at which the
/// fastest growing of all dense eigenvalues of the changed saw does.
#[test]
fn the_flutter_speed_of_a_damped_saw_moves_as_reported() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/gallery");
    let scene = Scene::from_path(format!("{folder}/damped-material.json")).unwrap();
    let scene = scene.edited(|saw| saw.accuracy = Accuracy::Draft).unwrap();
    let analysis = Analysis::new(&scene).unwrap();
    let speed = analysis.flutter_speed_rad_per_s.unwrap();
    let resolution = analysis.model.plate.resolution;
    let flutter = |scene: &Scene| {
        let range = SpeedRange::new(speed, speed);
        let model = SpectralModel::new(Plate::new(scene, resolution), range, Strategy::Dense);
        let model = model.unwrap();
        let growth = |speed: f64| {
            let modes = model.full_modes(speed).unwrap();
            let growth = modes.iter().map(|mode| mode.lambda.re);
            growth.fold(f64::MIN, f64::max) - scene.flutter_threshold_per_s()
        };
        let mut last = (speed, growth(speed));
        let mut next = speed * (1.0 + 1e-5);
        for _ in 0..5 {
            let found = growth(next);
            let slope = (found - last.1) / (next - last.0);
            last = (next, found);
            if found.abs() < 1e-7 {
                break;
            }
            next -= found / slope;
        }
        assert!(last.1.abs() < 1e-5, "{last:?}");
        last.0
    };
    let found = Sensitivity::all(&analysis).unwrap();
    let share = 0.1;
    let path = "guides[0].radius_m";
    let told = found.iter().find(|own| own.parameter == path).unwrap();
    let told = 0.01 * told.flutter_speed_percent.unwrap();
    let [low, high] = [-share, share].map(|share| flutter(&moved(&scene, path, share)));
    let difference = (high - low) / (2.0 * share * speed);
    let off = (told - difference).abs();
    assert!(off < 1e-2 * difference.abs(), "{told} {difference}");
}

/// `report` and `analyze --sensitivity` of a saw with damped material give the changes of its flutter speed, and what usual tolerances of
/// production take of it. Reference: the flutter speeds of analyses of the saw with one number moved. The angle of a single guide
/// changes nothing.
#[test]
fn the_report_of_a_damped_saw_says_what_tolerances_take_of_its_flutter_speed() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/gallery");
    let scene = Scene::from_path(format!("{folder}/damped-material.json")).unwrap();
    let scene = scene.edited(|saw| saw.accuracy = Accuracy::Draft).unwrap();
    let flutter = |scene: &Scene| {
        let analysis = Analysis::new(scene).unwrap();
        analysis.flutter_speed_rad_per_s.unwrap()
    };
    let told = report::report(&scene, &report::Options::default(), &|_| ()).unwrap();
    let sensitivities = &told.idling.sensitivities;
    let own = flutter(&scene);
    let share = 0.3;
    let mut square = 0.0;
    // Each tolerance in percent of the number: 2 mm of the radius, a tenth of the stiffness, a hundredth of the others.
    for (path, tolerance) in [
        ("blade.thickness_m", 1.0),
        ("blade.material.density_kg_per_m3", 1.0),
        ("blade.material.youngs_modulus_pa", 1.0),
        ("guides[0].radius_m", 1.0),
        ("guides[0].stiffness_n_per_m", 10.0),
    ] {
        let [low, high] = [-share, share].map(|share| flutter(&moved(&scene, path, share)));
        let percent = 1e2 * (high - low) / (2.0 * share * own);
        let found = sensitivities.iter().find(|one| one.parameter == path);
        let found = found.unwrap().flutter_speed_percent.unwrap();
        assert!(
            (found / percent - 1.0).abs() < 1e-3,
            "{path}: {found} {percent}"
        );
        square += (percent * tolerance).powi(2);
    }
    let mut speeds = told.speeds.iter();
    let decided = speeds.find(|one| one.speed == DecidedSpeed::Flutter);
    let found = decided.unwrap().tolerance_rpm.unwrap();
    let expected = 1e-2 * square.sqrt() * rpm(own);
    assert!((found / expected - 1.0).abs() < 1e-3, "{found} {expected}");
    assert_eq!(told.raised, DecidedSpeed::Flutter);
}

/// Derivatives at an operating speed below and above the sweep, where the reduced models of the sweep end. Reference: differences of all
/// dense eigenvalues at that speed.
#[test]
fn eigenvalues_beside_the_sweep_move_as_at_their_own_speed() {
    for operating_rpm in [300.0, 1000.0] {
        let scene = Scene::paper().edited(|saw| {
            saw.accuracy = Accuracy::Draft;
            saw.operating_rpm = Some(operating_rpm);
            let sweep = saw.sweep.as_mut().unwrap();
            (sweep.from_rpm, sweep.to_rpm) = (600.0, 700.0);
        });
        let scene = scene.unwrap();
        let analysis = Analysis::new(&scene).unwrap();
        let frequencies_hz = |scene: &Scene| {
            let plate = Plate::new(scene, analysis.model.plate.resolution);
            let range = SpeedRange::new(0.0, 1.0);
            let model = SpectralModel::new(plate, range, Strategy::Dense).unwrap();
            let modes = model.full_modes(rad_per_s(operating_rpm)).unwrap();
            let mut found: Vec<f64> = modes.iter().map(|mode| mode.lambda.im / TAU).collect();
            found.sort_by(f64::total_cmp);
            found
        };
        let path = "guides[0].radius_m";
        let share = 0.01;
        let [low, high] = [-share, share].map(|s| frequencies_hz(&moved(&scene, path, s)));
        let found = Sensitivity::all(&analysis).unwrap();
        let told = found.iter().find(|own| own.parameter == path).unwrap();
        assert!(told.frequency_hz.len() >= 8, "{:?}", told.frequency_hz);
        for (k, told) in told.frequency_hz.iter().enumerate() {
            let difference = (high[k] - low[k]) / (2.0 * share);
            let off = (told - difference).abs();
            assert!(off < 1e-5 * high[k], "{k}: {told} {difference}");
        }
    }
}

/// The modes of an analysis end with its sweep: beside it they are refused, and are not those of its end.
#[test]
fn modes_beside_the_sweep_are_refused() {
    let scene = Scene::paper().edited(|saw| {
        saw.accuracy = Accuracy::Draft;
        saw.sweep.as_mut().unwrap().to_rpm = 700.0;
    });
    let model = Analysis::new(&scene.unwrap()).unwrap().model;
    assert!(model.modes(rad_per_s(700.0)).is_ok());
    let refused = model.modes(rad_per_s(800.0)).unwrap_err().to_string();
    assert!(refused.contains("800 rpm: it reaches from"), "{refused}");
}

/// Compares every sensitivity with the difference of two analyses; returns the number of bands.
fn assert_central_differences(scene: &Scene) -> usize {
    let at = rad_per_s(1800.0);
    let middle = analysis_of(scene);
    let found = middle.sensitivities(at).unwrap();
    assert_eq!(found.len(), 3 + 3 * scene.file().guides.len());
    let share = 0.01;
    // Rounding 1e-11 and truncation (1e-4)² of the differences, over a step of 2e-4.
    let tolerance = 1e-6;
    for sensitivity in &found {
        let path = sensitivity.parameter.as_str();
        let (low, high) = (
            analysis_of(&moved(scene, path, -share)),
            analysis_of(&moved(scene, path, share)),
        );
        let difference =
            |of: &dyn Fn(&Analysis) -> f64| (of(&high) - of(&low)) / (2.0 * share * of(&middle));
        // The differences are for a change of 1 %, so that the numbers are of size 0.01.
        let close = |x: f64, y: f64, what: &str| {
            assert!(
                (x - y).abs() < tolerance * 0.01_f64.max(y.abs()),
                "{path} {what}: {x} {y}"
            );
        };
        for (k, value) in sensitivity.critical_speeds_percent.iter().enumerate() {
            let of = |a: &Analysis| a.model.critical[k].speed_rad_per_s;
            close(0.01 * value, difference(&of), "critical speed");
        }
        for (k, value) in sensitivity.onsets_percent.iter().enumerate() {
            let of = |a: &Analysis| a.chart.instabilities[k].from_rad_per_s;
            close(0.01 * value.unwrap(), difference(&of), "onset");
        }
        for (k, value_hz) in sensitivity.frequency_hz.iter().enumerate() {
            let of = |a: &Analysis| a.model.modes(at).unwrap()[k].lambda.im;
            if of(&middle) == 0.0 {
                // A diverging mode has no frequency as a reference.
                continue;
            }
            close(TAU * value_hz / of(&middle), difference(&of), "frequency");
        }
    }
    middle.chart.instabilities.len()
}
