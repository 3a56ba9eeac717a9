//! A chart under the forces of a cut, and with the wood in the kerf.

use std::f64::consts::{PI, TAU};

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, c64};
use nalgebra::DMatrix;
use sawflutter::analyses::commands::CommandReport;
use sawflutter::analyses::deflect::{self, deflect};
use sawflutter::analyses::response::{self, response};
use sawflutter::analyses::runup::runup;
use sawflutter::model::analytical::free_wave::on_a_bed_rad_per_s;
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{
    Accuracy, Scene, SceneFile, SideForceFile, SpeedRange, WoodFile, rad_per_s, rpm,
};
use sawflutter::model::system::GyroscopicSystem;
use sawflutter::stability::{Analysis, ChosenBasis, InstabilityKind, Onsets, StabilityState};

use crate::common::relative_error;

fn in_cut(change: impl FnOnce(&mut SceneFile)) -> Scene {
    let saw = Scene::paper().edited(|saw| {
        let cut = saw.cut.as_mut().expect("the paper's cut");
        (cut.chart_rpm, cut.teeth_in_cut) = (Some(2800.0), Some(4));
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
    assert_eq!(told.flutter_rpm, own.flutter_speed_rad_per_s.map(rpm));
    assert_eq!(told.instabilities.len(), own.instabilities.len());
    let scene = Scene::paper().edited(|saw| saw.accuracy = Accuracy::Draft);
    let plain = Analysis::new(&scene.unwrap()).unwrap().report();
    let critical: Vec<f64> = plain.critical_speeds.iter().map(|c| c.rpm).collect();
    assert_eq!(told.critical_rpm, critical);
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
                let expected_damping = if j == k { damping / area / mass } else { 0.0 };
                assert!(
                    (loss - expected_damping).abs() < 1e-10 * damping / area / mass,
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
    let idle = Plate::new(&scene.idling().unwrap(), SMALL);
    let free = own(&GyroscopicSystem::of_plate(&idle).stiffness);
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
        let functions = plate.functions_at(rim, angle.to_radians());
        let values = faer::Col::from_fn(functions.len(), |i| functions[i]);
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
    let functions = plate.functions_at(rim - 5e-5, 17.0_f64.to_radians());
    let values = faer::Col::from_fn(functions.len(), |i| functions[i]);
    let point = faer::Scale(k) * &values * values.transpose();
    let point_error = (&stiffness - &point).norm_l2() / point.norm_l2();
    assert!(point_error < 1e-5, "a small patch: {point_error:e}");
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

/// The saw in the cut at 2800 rpm, against stiff wood that damps, in a small basis.
fn against_wood() -> Scene {
    in_cut(|saw| {
        saw.accuracy = Accuracy::Draft;
        saw.operating_rpm = Some(1200.0);
        let runup = saw.runup.as_mut().expect("a run-up");
        (runup.to_rpm, runup.duration_s) = (1750.0, 1.0);
        saw.sweep.as_mut().expect("a sweep").to_rpm = 1750.0;
        saw.cut.as_mut().expect("a cut").wood = Some(WoodFile {
            stiffness_n_per_m: 6e4,
            damping_n_s_per_m: 25.0,
            depth_m: 0.06,
            arc_deg: None,
        });
    })
}

/// The idling saw with the forces and the wood of the cut added to it, in the basis of a plate.
fn added_to_the_idling_saw(scene: &Scene, basis: &Plate) -> GyroscopicSystem {
    let idling = Plate::new(&scene.idling().unwrap(), basis.resolution);
    let cut = scene.cut().unwrap();
    GyroscopicSystem::of_plate(&idling.in_cut(cut, &cut.at_rpm(2800.0).unwrap()))
}

fn functions(plate: &Plate, (radius_m, angle_rad): (f64, f64)) -> Col<c64> {
    let values = plate.functions_at(radius_m, angle_rad);
    Col::from_fn(values.len(), |i| c64::new(values[i], 0.0))
}

/// Deflection at a place per newton at another, from (K + iωD − ω²)⁻¹ of the whole matrices.
fn receptance(
    system: &GyroscopicSystem,
    [force, probe]: [&Col<c64>; 2],
    (speed, frequency): (f64, f64),
) -> c64 {
    let (stiffness, velocity) = (system.stiffness_at(speed), system.velocity_at(speed));
    let dynamic = Mat::from_fn(system.order(), system.order(), |i, k| {
        let inertia = if i == k { frequency.powi(2) } else { 0.0 };
        c64::new(stiffness[(i, k)] - inertia, frequency * velocity[(i, k)])
    });
    probe.transpose() * dynamic.partial_piv_lu().solve(force)
}

#[test]
fn the_response_in_the_cut_is_that_of_the_whole_matrices() {
    let scene = against_wood();
    let options = response::Options {
        to_hz: Some(60.0),
        ..response::Options::default()
    };
    let report = response(&scene, &options).unwrap();
    let chosen = ChosenBasis::new(&scene, scene.tolerance()).unwrap();
    let plate = &chosen.saw.plate;
    let system = added_to_the_idling_saw(&scene, plate);
    let points = report.points.as_ref().unwrap();
    let places = [
        (points.force_radius_m, points.force_angle_deg),
        (report.probe_radius_m, report.probe_angle_deg),
    ]
    .map(|(radius_m, deg)| functions(plate, (radius_m, deg.to_radians())));
    for place in (0..points.frequency_hz.len()).step_by(97) {
        let at = (rad_per_s(points.rpm), TAU * points.frequency_hz[place]);
        let expected = receptance(&system, places.each_ref(), at);
        let phase = points.phase_deg[place].unwrap().to_radians();
        let found = c64::from_polar(points.receptance_m_per_n[place].unwrap(), phase);
        let error = (found - expected).norm();
        assert!(
            error < 1e-6 * expected.norm(),
            "{at:?}: {error:e} {expected}"
        );
    }
}

/// Text, page and figures say which saw the report is of.
fn assert_said(report: &impl CommandReport, condition: &str) {
    assert_eq!(condition, "in the cut at 2800 rpm (4 teeth)");
    let summary = report.text(true);
    assert!(summary.contains(condition), "{summary}");
    assert!(report.page().unwrap().contains(condition));
    for figure in report.figures() {
        let text = figure.svg().unwrap();
        assert!(text.contains(condition), "{:?}", figure.names());
    }
}

/// The first critical speed is 1/√µ with the largest eigenvalue µ of L⁻¹(−S)L⁻ᵀ, K₀ = LLᵀ.
#[test]
fn every_command_has_the_same_saw_in_the_cut() {
    let scene = against_wood();
    let analysis = Analysis::new(&scene).unwrap();
    let system = added_to_the_idling_saw(&scene, &analysis.model.plate);
    let dense =
        |matrix: &Mat<f64>| DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, k| matrix[(i, k)]);
    let lower = dense(&system.stiffness).cholesky().unwrap().l();
    let half = lower.solve_lower_triangular(&-dense(&system.spin)).unwrap();
    let whole = lower.solve_lower_triangular(&half.transpose()).unwrap();
    let expected = rpm(1.0 / whole.symmetric_eigenvalues().max().sqrt());

    let report = analysis.report();
    let response = response(&scene, &response::Options::default()).unwrap();
    let runup = runup(&scene, &|_, _| ()).unwrap();
    let options = deflect::Options {
        to_rpm: Some(1300.0),
    };
    let deflect = deflect(&scene, &options).unwrap();
    let found = [
        report.critical_speeds[0].rpm,
        response.lines[0].resonances[0].rpm,
        runup.critical_speeds[0].rpm,
    ];
    for found in found {
        assert!(relative_error(found, expected) < 1e-9, "{found} {expected}");
    }
    assert!(deflect.critical_speeds.is_empty() && expected > 1600.0);
    assert_said(&report, &report.condition);
    assert_said(&response, &response.condition);
    assert_said(&runup, &runup.condition);
    assert_said(&deflect, &deflect.condition);
    assert_eq!(scene.idling().unwrap().condition(), "idling");
}

/// A force so small that the blade does not stretch.
#[test]
fn a_small_force_in_the_cut_deflects_the_blade_as_the_whole_matrices_say() {
    let scene = against_wood()
        .edited(|saw| saw.side_force = Some(SideForceFile::of(1e-4)))
        .unwrap();
    let options = deflect::Options {
        to_rpm: Some(1300.0),
    };
    let report = deflect(&scene, &options).unwrap();
    let swept = scene.swept(SpeedRange::between_rpm(0.0, 1300.0)).unwrap();
    let chosen = ChosenBasis::new(&swept, scene.tolerance()).unwrap();
    let plate = &chosen.saw.plate;
    let system = added_to_the_idling_saw(&scene, plate);
    let rim = (
        plate.blade.outer_radius_m,
        report.force_angle_deg.to_radians(),
    );
    let probe = (report.probe_radius_m, report.probe_angle_deg.to_radians());
    let places = [rim, probe].map(|at| functions(plate, at));
    let arc = &report.up.arcs[0];
    // At rest the basis contains the deflection; at speed its few shapes promise 1 %.
    for (place, tolerance) in [(0, 1e-5), (arc.rpm.len() - 1, 1e-2)] {
        let speed = rad_per_s(arc.rpm[place]);
        let expected = 1e-4 * receptance(&system, places.each_ref(), (speed, 0.0)).re;
        let error = relative_error(arc.deflection_m[place], expected);
        assert!(error < tolerance, "{} rpm: {error:e}", arc.rpm[place]);
    }
}
