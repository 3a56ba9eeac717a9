//! Modes at rest are those at rest, wherever the sweep begins.

use std::f64::consts::TAU;

use sawflutter::model::scene::{Accuracy, Scene};
use sawflutter::stability::Analysis;

/// Four equal pads, swept from 4000 rpm on, where the lowest frequency is 12.5 Hz. Reference: frequencies by radial functions of
/// another program.
#[test]
fn a_sweep_that_begins_fast_lists_the_frequencies_at_rest() {
    let pad = |angle_deg: f64| {
        format!(
            r#"{{"radius_m": 0.17, "angle_deg": {angle_deg}, "radial_length_m": 0.03, "tangential_length_m": 0.04,
                "stiffness_n_per_m": 3e4}}"#
        )
    };
    let pads = [10.0, 100.0, 190.0, 280.0].map(pad).join(", ");
    let scene = Scene::from_json(&format!(
        r#"{{"name": "four pads", "accuracy": "draft", "sweep": {{"from_rpm": 4000, "to_rpm": 4500}},
            "blade": {{"outer_diameter_m": 0.4, "inner_diameter_m": 0.05, "thickness_m": 0.002, "material":
                {{"youngs_modulus_pa": 2.06e11, "poisson_ratio": 0.3, "density_kg_per_m3": 7850}}}},
            "mount": {{"kind": "collar", "diameter_m": 0.12, "in_plane": "fixed"}},
            "guides": [{pads}]}}"#
    ));
    let report = Analysis::new(&scene.unwrap()).unwrap().report();
    let found = report.modes_at_rest.iter().map(|mode| mode.frequency_hz);
    for (found, expected) in found.zip([93.79, 93.79, 95.78, 98.63]) {
        assert!((found - expected).abs() < 0.02, "{found} {expected}");
    }
    assert!(report.modes_at_rest.len() >= 12);
    for mode in &report.modes_at_rest {
        assert_eq!(mode.branch, None, "the diagram does not begin at rest");
        let error = mode.estimated_relative_error;
        assert!(error.is_some_and(|error| error < 1e-2), "{error:?}");
    }
}

/// Frequencies and damping of a saw with a damped pad. Reference: dense eigenvalues of the whole matrices at rest.
#[test]
fn damping_at_rest_is_that_of_the_full_model_at_rest() {
    let scene = Scene::paper().edited(|saw| {
        saw.guides[0].damping_n_s_per_m = 50.0;
        saw.accuracy = Accuracy::Draft;
        saw.sweep.as_mut().unwrap().from_rpm = 1500.0;
        saw.sweep.as_mut().unwrap().to_rpm = 1600.0;
    });
    let analysis = Analysis::new(&scene.unwrap()).unwrap();
    let exact = analysis.model.full_modes(0.0).unwrap();
    let at_rest = &analysis.modes_at_rest;
    assert!(at_rest.len() >= 12, "{}", at_rest.len());
    for mode in at_rest {
        let found = mode.mode.lambda;
        let off = exact.iter().map(|mode| (mode.lambda - found).norm());
        let off = off.fold(f64::INFINITY, f64::min) / found.norm();
        assert!(off < 1e-6, "{} Hz: {off:e}", found.im / TAU);
    }
}

/// At the highest accuracy the listed modes are refined on the full model at their own speed, which the sweep does not contain.
#[test]
fn a_sweep_that_begins_fast_is_refined_at_rest() {
    let scene = Scene::paper().edited(|saw| {
        saw.accuracy = Accuracy::Reference;
        saw.sweep.as_mut().unwrap().from_rpm = 1500.0;
        saw.sweep.as_mut().unwrap().to_rpm = 1600.0;
    });
    let analysis = Analysis::new(&scene.unwrap()).unwrap();
    let error = analysis.listed_backward_error;
    assert!(error.is_some_and(|error| error < 1e-9), "{error:?}");
}
