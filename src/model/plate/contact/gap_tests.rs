//! Pads that lift off, compared with closed forms, differences of their potential, and the linear pad.

use faer::Scale;

use super::*;
use crate::model::plate::Resolution;
use crate::model::scene::{ContactLaw, GuideFile, Scene};

const SMALL: Resolution = Resolution {
    max_diameters: 4,
    radial_functions: 4,
};

/// The built-in saw with a pad that lifts off.
fn lifting(change: impl FnOnce(&mut GuideFile)) -> Plate {
    let scene = Scene::paper().edited(|file| {
        let pad = &mut file.guides[0];
        pad.contact = ContactLaw::OneSided;
        pad.gap_m = Some(4e-5);
        change(pad);
    });
    Plate::new(&scene.unwrap(), SMALL)
}

fn potential(plate: &Plate) -> GapPotential {
    let order = plate.degrees_of_freedom();
    GapPotential::new(plate, Mat::<f64>::identity(order, order).as_ref()).unwrap()
}

/// A deflection of about a tenth of a millimetre that contains many waves.
fn bent(plate: &Plate, size: f64) -> Col<f64> {
    let order = plate.degrees_of_freedom();
    Col::from_fn(order, |i| {
        size * ((3 * i + 1) as f64).sin() / (1.0 + i as f64)
    })
}

/// References: central differences of V and of its gradient.
#[test]
fn force_and_stiffness_are_derivatives_of_the_potential() {
    let plate = lifting(|pad| {
        pad.film_stiffness_n_per_m = 2e6;
        pad.offset_m = 1.5e-5;
    });
    let gaps = potential(&plate);
    let q = bent(&plate, 4e-4);
    let (gradient, hessian) = (gaps.gradient(&q), gaps.hessian(&q));
    assert!(gaps.energy_j(&q) > 0.0);
    let step = 1e-9;
    for i in 0..q.nrows() {
        let moved = |by: f64| {
            let mut moved = q.clone();
            moved[i] += by;
            moved
        };
        let (up, down) = (moved(step), moved(-step));
        let slope = (gaps.energy_j(&up) - gaps.energy_j(&down)) / (2.0 * step);
        let error = (slope - gradient[i]).abs();
        assert!(error < 1e-6 * gradient.norm_max(), "{i}: {error:e}");
        let column = (gaps.gradient(&up) - gaps.gradient(&down)) * faer::Scale(0.5 / step);
        let hessian_error = (column - hessian.col(i)).norm_max();
        assert!(
            hessian_error < 1e-3 * hessian.norm_max(),
            "{i}: {hessian_error:e}"
        );
    }
}

/// The deflections of a pair are near to each other or far apart.
#[test]
fn the_mean_force_does_the_work_of_the_potential() {
    let plate = lifting(|pad| {
        pad.film_stiffness_n_per_m = 2e6;
        pad.offset_m = 1.5e-5;
    });
    let gaps = potential(&plate);
    for size in [1e-9, 1e-5, 1e-3] {
        let from = bent(&plate, 3e-4);
        let change = Col::from_fn(from.nrows(), |i| size * ((7 * i + 2) as f64).cos());
        let work = gaps.mean_gradient(&from, &change).transpose() * &change;
        let to = &from + &change;
        let difference = gaps.energy_j(&to) - gaps.energy_j(&from);
        let rounding = 1e-14 * gaps.energy_j(&from);
        assert!(
            (work - difference).abs() < 1e-11 * difference.abs() + rounding,
            "{size}: {work:e} {difference:e}"
        );
        // The derivative of the mean by the change, along the change.
        let step = 1e-4;
        let longer = gaps.mean_gradient(&from, &(Scale(1.0 + step) * &change));
        let shorter = gaps.mean_gradient(&from, &(Scale(1.0 - step) * &change));
        let expected = Scale(0.5 / step) * (longer - shorter);
        let found = gaps.mean_stiffness(&from, &change) * &change;
        let error = (&found - &expected).norm_max();
        assert!(error < 1e-3 * expected.norm_max(), "{size}: {error:e}");
    }
}

/// If the blade moves rigidly by w = ±d, a pad on the side of the motion exerts the force k (d − g).
#[test]
fn the_whole_pad_acts_on_a_blade_that_heaves() {
    for (side, left, right) in [
        (GuideSide::Both, true, true),
        (GuideSide::Left, true, false),
        (GuideSide::Right, false, true),
    ] {
        let plate = lifting(|pad| {
            pad.side = side;
            pad.film_stiffness_n_per_m = 2e6;
        });
        let gaps = potential(&plate);
        for (deflection, touches) in [
            (9e-5, left),
            (-9e-5, right),
            (3.9e-5, false),
            (-3.9e-5, false),
        ] {
            let mut heave = Col::zeros(plate.degrees_of_freedom());
            heave[0] = deflection / plate.functions_at(0.2, 0.0)[0];
            let [force] = gaps.forces_n(&heave)[..] else {
                panic!("one pad")
            };
            let whole = 2e7 - 2e6;
            let pressed = if touches {
                whole * (9e-5 - 4e-5) * deflection.signum()
            } else {
                0.0
            };
            let expected = -pressed - 2e6 * deflection;
            assert!(
                (force - expected).abs() < 1e-9 * whole,
                "{side:?} {deflection}: {force}"
            );
        }
    }
}

/// A blade that heaves by the offset of its pad is in the middle of the gap, where neither pad nor film exerts a force.
#[test]
fn an_offset_moves_the_middle_of_the_gap() {
    let film = 2e6;
    let of = |offset_m: f64| {
        lifting(|pad| {
            pad.offset_m = offset_m;
            pad.film_stiffness_n_per_m = film;
        })
    };
    let (plate, moved) = (of(0.0), of(7e-5));
    let (gaps, beside) = (potential(&plate), potential(&moved));
    let heave = |deflection: f64| {
        let mut heave = Col::zeros(plate.degrees_of_freedom());
        heave[0] = deflection / plate.functions_at(0.2, 0.0)[0];
        heave
    };
    for deflection in [-9e-5, 1e-5, 9e-5] {
        let pair = [
            gaps.forces_n(&heave(deflection))[0],
            beside.forces_n(&heave(deflection + 7e-5))[0],
        ];
        assert!((pair[0] - pair[1]).abs() < 1e-9 * 2e7, "{pair:?}");
    }
    let pulled = moved.released().unwrap().contact.stiffness().unwrap() * heave(7e-5);
    let rest = pulled + beside.gradient(&heave(7e-5));
    let force = film * 7e-5 * plate.functions_at(0.2, 0.0)[0].abs();
    assert!(rest[0].abs() < 1e-6 * force, "{} {force}", rest[0]);
}

/// A pad with a nearly closed gap approaches the linear pad, whose integral is exact; with a film as stiff as
/// the pad it equals it.
#[test]
fn without_a_gap_the_pad_is_the_linear_one() {
    let plate = lifting(|pad| pad.gap_m = Some(1e-12));
    let q = bent(&plate, 4e-4);
    let linear = plate.contact.stiffness().unwrap() * &q;
    let error = (potential(&plate).gradient(&q) - &linear).norm_max() / linear.norm_max();
    assert!(error < 1e-4, "{error:e}");
    let filled = lifting(|pad| pad.film_stiffness_n_per_m = pad.stiffness_n_per_m);
    assert_eq!(potential(&filled).gradient(&q).norm_max(), 0.0);
    let released = filled.released().unwrap();
    let difference = released.contact.stiffness().unwrap() - plate.contact.stiffness().unwrap();
    assert_eq!(difference.norm_max(), 0.0);
}

/// Within the gap the matrices are those of a plate without the pad, and another linear pad is not affected.
#[test]
fn within_the_gap_there_is_no_pad() {
    let lone = lifting(|_| ()).released().unwrap();
    assert!(lone.contact.is_empty() && lone.released().is_none());
    let [linear, lifting] = [ContactLaw::Linear, ContactLaw::OneSided].map(|contact| {
        let scene = Scene::paper().edited(|file| {
            let second = GuideFile {
                angle_deg: 120.0,
                contact,
                gap_m: Some(4e-5),
                ..file.guides[0].clone()
            };
            file.guides.push(second);
        });
        Plate::new(&scene.unwrap(), SMALL)
    });
    let first = Plate::new(&Scene::paper(), SMALL);
    let released = lifting.released().unwrap();
    let stiffness = |plate: &Plate| plate.contact.stiffness().unwrap().clone();
    assert_eq!((stiffness(&released) - stiffness(&first)).norm_max(), 0.0);
    assert_eq!((stiffness(&lifting) - stiffness(&linear)).norm_max(), 0.0);
}

/// If only a part of a pad touches, its force converges with the number of points.
#[test]
fn points_of_a_pad_converge() {
    let plate = lifting(|_| ());
    let order = plate.degrees_of_freedom();
    // The tilt is so small that only a part of the pad touches.
    let mut tilt = Col::zeros(order);
    tilt[plate.offset(1)] = 4e-4;
    let identity = Mat::<f64>::identity(order, order);
    let of = |radial, angular| {
        let points = GapPotential::with_points(&plate, identity.as_ref(), radial, angular);
        let gaps = points.unwrap();
        (gaps.energy_j(&tilt), gaps.forces_n(&tilt)[0])
    };
    let (usual, fine) = (of(POINTS, POINTS), of(40, 64));
    println!("{usual:?} {fine:?}");
    assert!((usual.0 / fine.0 - 1.0).abs() < 5e-3, "{usual:?} {fine:?}");
    assert!((usual.1 / fine.1 - 1.0).abs() < 0.01, "{usual:?} {fine:?}");
}
