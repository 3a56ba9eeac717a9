//! Goal: a tolerance is a promise, and so is the estimate that it is checked with.
//!
//! `tests/trials/accuracy.rs` takes ninety saws and a reference basis of 3999 functions.

use crate::common::Worst;
use crate::promises::{Kept, drawn_saws, promises, saws};
use sawflutter::model::plate::Resolution;
use sawflutter::model::scene::{Scene, SweepFile};
use sawflutter::stability::{Analysis, InstabilityKind};

/// A basis that is large in comparison with that of 1e-2 for saws with soft pads.
const TRUTH: Resolution = Resolution {
    max_diameters: 30,
    radial_functions: 15,
};

/// One saw of each group of thirty; no constant was chosen with the third group.
#[test]
fn estimates_and_promises_hold() {
    let mut kept = Kept::default();
    let of_each = [&saws()[8], &drawn_saws(0..1)[0], &drawn_saws(90..91)[0]];
    for saw in of_each {
        kept.add(&saw.what, &promises(saw, &[1e-2], TRUTH));
    }
    kept.assert(3);
}

/// Flutter onsets keep the promise too.
#[test]
fn onsets_keep_the_tolerance() {
    let onsets = |tolerance: f64| -> Vec<f64> {
        let scene = Scene::paper().edited(|saw| saw.tolerance = Some(tolerance));
        let analysis = Analysis::new(&scene.unwrap()).unwrap();
        let bands = analysis.chart.instabilities.into_iter();
        bands
            .filter(|b| b.kind == InstabilityKind::Flutter)
            .map(|b| b.from_rad_per_s)
            .collect()
    };
    let truth = onsets(1e-4);
    for tolerance in [1e-2, 1e-3] {
        let found = onsets(tolerance);
        assert_eq!(found.len(), truth.len(), "{tolerance}");
        let mut worst = Worst::default();
        for (found, truth) in found.iter().zip(&truth) {
            worst.add((found / truth - 1.0).abs(), || format!("{truth} rad/s"));
        }
        worst.assert_at_most(&format!("onsets at {tolerance}"), tolerance);
    }
}

/// A saw with damping has at most 732 functions. The small stiff pad of the two bends the blade more sharply than these
/// can represent, and without damping the number of functions agrees with the predicted decrease of the error, to a
/// factor of two.
#[test]
fn the_warning_of_an_accuracy_out_of_reach_names_the_pad_and_the_functions_needed() {
    let saw = |damping_n_s_per_m: f64| {
        let scene = Scene::paper().edited(|saw| {
            let mut small = saw.guides[0].clone();
            small.angle_deg += 180.0;
            small.stiffness_n_per_m = 1e8;
            (small.radial_length_m, small.tangential_length_m) = (0.06, 0.06);
            saw.guides.push(small);
            saw.guides[0].damping_n_s_per_m = damping_n_s_per_m;
            saw.tolerance = Some(1e-3);
            (saw.cut, saw.measured) = (None, None);
            // The basis is chosen from critical speeds, below which there is no search for bands.
            saw.sweep = Some(SweepFile {
                from_rpm: 0.0,
                to_rpm: 1600.0,
            });
        });
        Analysis::new(&scene.unwrap()).unwrap()
    };
    let damped = saw(10.0);
    assert_eq!(damped.model.plate.degrees_of_freedom(), 732);
    let found = damped.out_of_reach.expect("out of reach");
    assert_eq!(found.guide, Some(1));
    assert!(found.is_dense);
    let undamped = saw(0.0);
    assert_eq!(undamped.out_of_reach, None);
    let needed = undamped.model.plate.degrees_of_freedom() as f64;
    let told = found.functions.expect("a number of functions");
    println!("{told} told, {needed} needed");
    // Sizes grow in steps of 1.5, and the prediction uses the rate of decrease of the error at smaller sizes.
    assert!((0.6..2.0).contains(&(told / needed)), "{told} {needed}");
}
