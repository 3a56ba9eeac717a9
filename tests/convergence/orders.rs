//! Goal: the changes from one basis to a larger one decrease, and the named accuracies are reached.
//!
//! A stiff pad bends the blade at its edges, which a series in nodal diameters follows
//! slowly. Quoted from an independent implementation, for pads of 1e7 to 1e8 N/m on the
//! paper's blade: critical speeds move 0.3 % from (n_max, J) = (8, 5) to (12, 8), and
//! 0.02 % from there to (20, 10).

use crate::common::relative_error;
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{Accuracy, Scene, rpm};
use sawflutter::modes::SpectralModel;

/// The pairs of two and three diameters.
const SPEEDS: usize = 4;

fn critical_rpm(scene: &Scene, (max_diameters, radial_functions): (usize, usize)) -> Vec<f64> {
    let resolution = Resolution {
        max_diameters,
        radial_functions,
    };
    SpectralModel::critical_speeds(&Plate::new(scene, resolution))
        .unwrap()
        .iter()
        .take(SPEEDS)
        .map(|c| rpm(c.speed_rad_per_s))
        .collect()
}

fn with_stiffness(newtons_per_m: f64) -> Scene {
    let scene = Scene::paper().edited(|saw| saw.guides[0].stiffness_n_per_m = newtons_per_m);
    scene.unwrap()
}

/// Largest relative difference.
fn distance(left: &[f64], right: &[f64]) -> f64 {
    let errors = left.iter().zip(right).map(|(l, r)| relative_error(*l, *r));
    let largest = errors.fold(
        0.0,
        |top: f64, e| if e > top || e.is_nan() { e } else { top },
    );
    assert_eq!((left.len(), right.len()), (SPEEDS, SPEEDS));
    assert!(largest.is_finite());
    largest
}

/// A Ritz basis is too stiff, and a larger one that contains it is never stiffer: every critical speed falls.
#[test]
fn critical_speeds_fall_towards_their_limit() {
    let scene = Scene::paper();
    let finest = critical_rpm(&scene, (20, 10));
    let mut previous = f64::INFINITY;
    let mut above: Option<Vec<f64>> = None;
    for basis in [(8, 5), (12, 8), (16, 8)] {
        let speeds = critical_rpm(&scene, basis);
        let error = distance(&speeds, &finest);
        println!("{basis:?}: {speeds:.3?} rpm, {error:.2e} from (20, 10)");
        assert!(error < previous, "{basis:?}: {error} after {previous}");
        previous = error;
        if let Some(above) = above {
            // The tolerance allows for rounding of the symmetric eigenproblem.
            let falls = above
                .iter()
                .zip(&speeds)
                .all(|(a, s)| *s <= a * (1.0 + 1e-9));
            assert!(falls, "{above:?} {speeds:?}");
        }
        above = Some(speeds);
    }
}

/// The quoted changes apply to the softest of the quoted pads. They grow with the pad's stiffness; for the two stiffer
/// pads the limits are the changes measured on this basis.
#[test]
fn movements_between_bases() {
    for (stiffness, bounds) in [
        (1e7, [3e-3, 2e-4]),
        (2e7, [4e-3, 3e-4]),
        (1e8, [9e-3, 9e-4]),
    ] {
        let scene = with_stiffness(stiffness);
        let [coarse, middle, fine] =
            [(8, 5), (12, 8), (20, 10)].map(|basis| critical_rpm(&scene, basis));
        let movements = [distance(&coarse, &middle), distance(&middle, &fine)];
        println!("{stiffness:e} N/m: {movements:?}");
        for (movement, bound) in movements.into_iter().zip(bounds) {
            assert!(movement <= bound, "{stiffness:e} N/m: {movement:e}");
        }
    }
}

/// The named accuracies from coarse to fine; the finest is compared with a finer one.
#[test]
fn named_accuracies_are_in_order() {
    let scene = Scene::paper();
    let of = |accuracy| {
        let resolution = Resolution::of(accuracy);
        critical_rpm(
            &scene,
            (resolution.max_diameters, resolution.radial_functions),
        )
    };
    let reference = of(Accuracy::Reference);
    let draft = distance(&of(Accuracy::Draft), &reference);
    let design = distance(&of(Accuracy::Design), &reference);
    println!("draft {draft:.2e}, design {design:.2e} from reference");
    assert!(design < 0.1 * draft, "draft {draft}, design {design}");
    // The promise for critical speeds at reference accuracy, 0.1 %, also leaves a margin for design accuracy.
    assert!(design < 1e-3, "{design}");
}
