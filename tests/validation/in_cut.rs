//! A chart under the forces of a cut, and with the wood in the kerf.

use std::f64::consts::{PI, TAU};

use sawflutter::analytical::free_wave::on_a_bed_rad_per_s;
use sawflutter::plate::{Plate, Resolution};
use sawflutter::scene::{Accuracy, Scene, SceneFile, WoodFile, rad_per_s, rpm};
use sawflutter::stability::{Analysis, InstabilityKind, Onsets, StabilityState};
use sawflutter::system::GyroscopicSystem;

use crate::common::relative_error;

fn in_cut(change: impl FnOnce(&mut SceneFile)) -> Scene {
    let saw = Scene::paper().edited(|saw| {
        saw.cut.as_mut().expect("the paper's cut").chart_rpm = Some(2800.0);
        change(saw);
    });
    saw.unwrap_or_else(|error| panic!("{error}"))
}

/// Table 3's second row on four teeth: an independent code finds 6.0 1/s at 4.53 Hz at 2800 rpm, and no growth at 1800
/// rpm.
#[test]
fn the_chart_in_the_cut_has_the_growth_of_an_independent_code() {
    let analysis = Analysis::new(&in_cut(|_| ())).unwrap();
    let report = analysis.report();
    assert_eq!(report.certificate.krein_violations, 0);
    assert!(report.terms.iter().any(|term| term.contains("K_e")));
    let at = |speed_rpm: f64| {
        let modes = analysis.model.modes(rad_per_s(speed_rpm)).unwrap();
        let fastest = modes.iter().map(|mode| mode.lambda);
        fastest.max_by(|x, y| x.re.total_cmp(&y.re)).unwrap()
    };
    let found = at(2800.0);
    assert!(relative_error(found.re, 6.0) < 0.01, "{}", found.re);
    assert!(
        relative_error(found.im / TAU, 4.53) < 0.01,
        "{}",
        found.im / TAU
    );
    assert_eq!(
        analysis.verdict(rad_per_s(2800.0)).state,
        StabilityState::Flutter
    );
    assert_eq!(
        analysis.verdict(rad_per_s(1800.0)).state,
        StabilityState::Stable
    );
    let band = analysis.bands().iter().find(|band| {
        band.kind == InstabilityKind::Flutter
            && (rpm(band.from_rad_per_s)..rpm(band.to_rad_per_s)).contains(&2800.0)
    });
    assert!(band.is_some_and(|band| band.peak_growth_per_s >= found.re));
}

/// The report of the loaded saw has the results of the idling one beside its own.
#[test]
fn the_report_of_a_loaded_saw_includes_the_idling_one() {
    let scene = in_cut(|saw| saw.accuracy = Accuracy::Draft);
    let report = Analysis::new(&scene).unwrap().report();
    let told = report.in_cut.expect("a cut").idling.expect("a full chart");
    let own = Onsets::new(&scene.idling().unwrap()).unwrap();
    assert_eq!(told.flutter_speed_rpm, own.flutter_speed_rad_per_s.map(rpm));
    assert_eq!(told.instabilities.len(), own.instabilities.len());
    let plain = Scene::paper().edited(|saw| saw.accuracy = Accuracy::Draft);
    let plain = Analysis::new(&plain.unwrap()).unwrap().report();
    let critical: Vec<f64> = plain.critical_speeds.iter().map(|c| c.rpm).collect();
    assert_eq!(told.critical_speeds_rpm, critical);
    assert!(plain.in_cut.is_none());
}

const SMALL: Resolution = Resolution {
    max_diameters: 6,
    radial_functions: 6,
};

/// Wood over the whole ring is a uniform elastic foundation: every shape has ω_b² + k″/ρh, and the decay rate c″/2ρh.
#[test]
fn wood_over_the_whole_blade_is_an_elastic_foundation() {
    let (stiffness, damping) = (3e5, 40.0);
    let scene = in_cut(|saw| {
        saw.guides.clear();
        let blade = &saw.blade;
        let depth_m = 0.5 * (blade.outer_diameter_m - blade.inner_diameter_m);
        let cut = saw.cut.as_mut().expect("a cut");
        cut.tangential_n_per_tooth = Some(0.0);
        cut.radial_n_per_tooth = Some(0.0);
        cut.speeds.clear();
        cut.wood = Some(WoodFile {
            stiffness_n_per_m: stiffness,
            damping_n_s_per_m: damping,
            depth_m,
            arc_deg: Some(360.0),
        });
    });
    let plate = Plate::new(&scene, SMALL);
    let blade = &plate.blade;
    let area = PI * (blade.outer_radius_m.powi(2) - blade.inner_radius_m.powi(2));
    let mass = blade.mass_per_area_kg_per_m2();
    let system = GyroscopicSystem::of_plate(&plate);
    for n in 0..=6 {
        let block = plate.harmonics[n].body_frame_stiffness(0.0);
        let first = plate.offset(n);
        for j in 0..plate.radial_functions() {
            for k in 0..plate.radial_functions() {
                let bed = if j == k { stiffness / area / mass } else { 0.0 };
                let expected = block[(j, k)] + bed;
                let error = (system.stiffness[(first + j, first + k)] - expected).abs();
                assert!(
                    error < 1e-9 * system.stiffness[(first + j, first + j)].max(1.0),
                    "{n} {j} {k}"
                );
                let loss = system.damping.as_ref().expect("damped")[(first + j, first + k)];
                let expected = if j == k { damping / area / mass } else { 0.0 };
                assert!(
                    (loss - expected).abs() < 1e-10 * damping / area / mass,
                    "{n} {j} {k}"
                );
            }
        }
    }
    // The frequency in closed form, for the wave of two diameters.
    let own = |stiffness: &faer::Mat<f64>| {
        let (first, size) = (plate.offset(2), plate.radial_functions());
        let own = nalgebra::DMatrix::from_fn(size, size, |j, k| stiffness[(first + j, first + k)]);
        own.symmetric_eigenvalues().min().sqrt()
    };
    let free = Plate::new(&scene.idling().unwrap(), SMALL);
    let free = own(&GyroscopicSystem::of_plate(&free).stiffness);
    let expected = on_a_bed_rad_per_s(free, stiffness / area, mass);
    assert!(relative_error(own(&system.stiffness), expected) < 1e-9);
}

/// A small patch is a point spring at its centre; an arc of the rim is the mean of point springs along it.
#[test]
fn a_small_patch_is_a_point_spring_and_an_arc_many_of_them() {
    let with = |wood: WoodFile| {
        let scene = in_cut(|saw| {
            saw.guides.clear();
            let cut = saw.cut.as_mut().expect("a cut");
            cut.angle_deg = 17.0;
            cut.wood = Some(wood);
        });
        let plate = Plate::new(&scene, SMALL);
        let stiffness = plate.contact.stiffness().expect("wood").clone();
        (plate, stiffness)
    };
    let (arc, k) = (40.0_f64, 2e5);
    let (plate, stiffness) = with(WoodFile {
        stiffness_n_per_m: k,
        arc_deg: Some(arc),
        ..WoodFile::default()
    });
    let rim = plate.blade.outer_radius_m;
    let points = 20_000;
    let mut sum = faer::Mat::<f64>::zeros(stiffness.nrows(), stiffness.ncols());
    for i in 0..points {
        let angle = 17.0 + arc * ((f64::from(i) + 0.5) / f64::from(points) - 0.5);
        let values = plate.functions_at(rim, angle.to_radians());
        let values = faer::Col::from_fn(values.len(), |i| values[i]);
        sum += faer::Scale(k / f64::from(points)) * &values * values.transpose();
    }
    let error = (&stiffness - &sum).norm_l2() / sum.norm_l2();
    assert!(error < 1e-7, "an arc: {error:e}");
    let (plate, stiffness) = with(WoodFile {
        stiffness_n_per_m: k,
        depth_m: 1e-4,
        arc_deg: Some(1e-2),
        ..WoodFile::default()
    });
    let values = plate.functions_at(rim - 5e-5, 17.0_f64.to_radians());
    let values = faer::Col::from_fn(values.len(), |i| values[i]);
    let point = faer::Scale(k) * &values * values.transpose();
    let error = (&stiffness - &point).norm_l2() / point.norm_l2();
    assert!(error < 1e-5, "a small patch: {error:e}");
}

/// Damping makes the certificate of Krein signs impossible, and the chart names the comparison used instead.
#[test]
fn wood_that_damps_changes_what_the_chart_states() {
    let statement = |damping_n_s_per_m: f64| {
        let scene = in_cut(|saw| {
            saw.accuracy = Accuracy::Draft;
            saw.cut.as_mut().expect("a cut").wood = Some(WoodFile {
                stiffness_n_per_m: 1e5,
                damping_n_s_per_m,
                depth_m: 0.05,
                arc_deg: None,
            });
        });
        let report = Analysis::new(&scene).unwrap().report();
        let damps = report.terms.iter().any(|term| term == "wood damping C");
        assert!(report.terms.iter().any(|term| term == "wood stiffness K_g"));
        assert_eq!(damps, damping_n_s_per_m > 0.0);
        report.certificate.statement
    };
    assert!(statement(0.0).starts_with("Krein index matches"));
    assert!(statement(20.0).starts_with("growing modes match"));
}
