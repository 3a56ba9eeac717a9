//! Goal: the growth of slotted saws beside guides, by Floquet multipliers, is that of independent computations.
//!
//! Sources: `slots_four_40mm.csv`, frequencies of a thin plate with cuts in rotation; `slots_floquet.csv`, growth by another program, on
//! two meshes; eigenvalues of this program for a blade without slots, which is axisymmetric; the closed form of a split pair of waves
//! beside a point.

use std::f64::consts::TAU;

use crate::common::{Worst, reference_model, relative_error, table};
use crate::slots::{self, Row};
use sawflutter::analyses::check::{Limits, check};
use sawflutter::analyses::door::CommandOptions;
use sawflutter::analyses::size;
use sawflutter::analyses::verdict::Answer;
use sawflutter::model::plate::{Plate, Resolution, TurningBlade};
use sawflutter::model::scene::{
    Accuracy, DampingFile, GuideFile, Scene, SceneFile, Slots, rad_per_s, rpm,
};
use sawflutter::modes::SpectralModel;
use sawflutter::stability::{Analysis, FloquetGrowth, GuidedBlade, NotComputed, StabilityState};
use serde::Deserialize;

#[derive(Deserialize)]
struct Growth {
    r_m: f64,
    stiffness_n_per_m: f64,
    damping_n_s_per_m: f64,
    rpm: f64,
    coarse_per_s: f64,
    fine_per_s: f64,
}

const FOUR: Slots = Slots {
    count: 4,
    depth_m: 0.04,
};

/// The blade beside a guide.
fn saw(slots: Option<Slots>, guide: Option<GuideFile>) -> Scene {
    let blade = slots::saw(slots.map(|Slots { count, depth_m }| (count, depth_m)));
    let saw = blade.edited(|saw| {
        saw.guides = guide.into_iter().collect();
        saw.accuracy = Accuracy::Draft;
        saw.operating_rpm = None;
    });
    saw.unwrap()
}

fn guide(radius_m: f64, size_m: f64, stiffness: f64, damping: f64) -> GuideFile {
    GuideFile {
        radius_m,
        radial_length_m: size_m,
        tangential_length_m: size_m,
        stiffness_n_per_m: stiffness,
        damping_n_s_per_m: damping,
        ..GuideFile::default()
    }
}

fn loss_factor(loss_factor: f64) -> DampingFile {
    DampingFile {
        loss_factor,
        ..DampingFile::default()
    }
}

fn plate(saw: &Scene) -> Plate {
    Plate::new(saw, Resolution::of(Accuracy::Draft))
}

/// Growth rates of a saw with slots, of depth zero if it has none, at speeds in rpm.
fn growth(saw: &Scene, rpms: &[f64]) -> Vec<FloquetGrowth> {
    let plate = plate(saw);
    let depth_m = saw.blade().slots.map_or(0.0, |slots| slots.depth_m);
    let slots = Slots { depth_m, ..FOUR };
    let blade = TurningBlade::new(&plate.blade, &slots).unwrap();
    let guided = GuidedBlade::new(&blade, saw, &plate).unwrap();
    let of = |rpm: &f64| guided.growth(rad_per_s(*rpm)).unwrap();
    rpms.iter().map(of).collect()
}

/// Both branches of the plate with cuts in its own stress of rotation.
#[test]
fn modes_in_rotation_are_those_of_a_turning_plate_with_cuts() {
    let plate = plate(&saw(Some(FOUR), None));
    let blade = TurningBlade::of(&plate.blade).unwrap();
    let mut worst = Worst::default();
    for (k, speed) in [0.0, 1500.0, 3000.0, 4500.0].into_iter().enumerate() {
        let modes = blade.modes(rad_per_s(speed), None, 40).unwrap();
        let found: Vec<f64> = modes.modes.iter().map(|m| m.square.sqrt() / TAU).collect();
        for row in table::<Row>("slots_four_40mm.csv") {
            let expected = [row.rest_hz, row.rpm1500_hz, row.rpm3000_hz, row.rpm4500_hz][k];
            let errors = found.iter().map(|hz| relative_error(*hz, expected));
            worst.add(errors.fold(f64::INFINITY, f64::min), || {
                format!("n = {} {} at {speed}", row.n, row.branch)
            });
        }
    }
    assert_eq!(worst.count, 32);
    worst.assert_at_most("slotted plate in rotation", 5e-4);
}

/// Near the onset the square of the growth is linear in the speed, with 5.4 1/s² per rpm: 5 1/s² are 1 rpm.
#[test]
fn growth_beside_a_point_is_that_of_another_program() {
    for row in table::<Growth>("slots_floquet.csv") {
        let guide = guide(row.r_m, 0.0, row.stiffness_n_per_m, row.damping_n_s_per_m);
        let found = growth(&saw(Some(FOUR), Some(guide)), &[row.rpm])[0].growth_per_s;
        let square = |growth: f64| growth * growth;
        if row.damping_n_s_per_m == 0.0 {
            let expected = 2.0 * square(row.fine_per_s) - square(row.coarse_per_s);
            assert!(
                (square(found) - expected).abs() < 5.0,
                "{} rpm: {found}",
                row.rpm
            );
        } else {
            let expected = 2.0 * row.fine_per_s - row.coarse_per_s;
            let error = (found - expected).abs();
            assert!(
                error < 4e-3 + 2e-3 * expected.abs(),
                "{} rpm: {found}",
                row.rpm
            );
        }
    }
}

fn largest(model: &SpectralModel, speed: f64) -> f64 {
    let modes = model.modes(speed).unwrap();
    modes
        .iter()
        .map(|m| m.growth_per_s())
        .fold(f64::NEG_INFINITY, f64::max)
}

/// A blade without slots has constant coefficients in space: its growth is that of its eigenvalues within the estimated
/// error, with springs, pads, dampers and material damping.
#[test]
fn a_plain_blade_grows_as_its_eigenvalues() {
    for (own, loss, rpms) in [
        (guide(0.13, 0.0, 2e5, 0.0), 0.0, [4000.0, 4495.0, 4520.0]),
        (guide(0.13, 0.0, 2e5, 20.0), 1e-3, [2000.0, 4600.0, 4900.0]),
        (guide(0.18, 0.03, 1e5, 20.0), 2e-3, [1500.0, 3500.0, 4700.0]),
    ] {
        let plain = saw(None, Some(own.clone()));
        let plain = plain
            .edited(|saw| saw.damping = (loss > 0.0).then(|| loss_factor(loss)))
            .unwrap();
        let model = reference_model(&plain, rad_per_s(5000.0));
        for (rpm, found) in rpms.iter().zip(growth(&plain, &rpms)) {
            // The elements change frequencies, and so the speeds of bands, by up to 1e-4 of them.
            let bounds =
                [1.0 - 1e-4, 1.0 + 1e-4].map(|share| largest(&model, rad_per_s(share * rpm)));
            let open = 2e-3 + found.error_per_s;
            let [low, high] = [f64::min, f64::max].map(|of| of(bounds[0], bounds[1]));
            let is_within = found.growth_per_s > low - open && found.growth_per_s < high + open;
            assert!(
                is_within,
                "{} m, {rpm} rpm: {found:?} {bounds:?}",
                own.radius_m
            );
        }
    }
}

/// Of a pair with ω̄² ∓ Δ beside a point with κ = k a² divergence begins at n²Ω² = ω̄² + κ/4 − √(κ²/16 + Δ²), a the largest deflection
/// of its waves there.
#[test]
fn a_split_pair_diverges_as_in_closed_form() {
    let (radius_m, stiffness) = (0.13, 4e3);
    let saw = saw(Some(FOUR), Some(guide(radius_m, 0.0, stiffness, 0.0)));
    let plate = plate(&saw);
    let blade = TurningBlade::of(&plate.blade).unwrap();
    // The pair of two diameters is the one with single modes near 140 Hz.
    let condition = |speed: f64| {
        let modes = blade.modes(speed, None, 20).unwrap();
        let single = |m: &&sawflutter::model::plate::TurningMode| {
            !m.is_pair && m.square.sqrt() / TAU > 125.0
        };
        let pair: Vec<f64> = modes
            .modes
            .iter()
            .filter(single)
            .map(|m| m.square)
            .take(2)
            .collect();
        let (mean, split) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
        let mut largest: f64 = 0.0;
        let circle = modes.circle(radius_m);
        let places: Vec<usize> = modes
            .modes
            .iter()
            .enumerate()
            .filter(|(_, m)| pair.contains(&m.square))
            .map(|(k, _)| modes.modes[..k].iter().map(|m| m.coordinates()).sum())
            .collect();
        for angle in 0..360 {
            let mut index = 0;
            circle.at(f64::from(angle).to_radians(), |value, _| {
                if places.contains(&index) {
                    largest = largest.max(value.abs());
                }
                index += 1;
            });
        }
        let kappa = stiffness * largest * largest;
        4.0 * speed * speed - mean - kappa / 4.0 + (kappa * kappa / 16.0 + split * split).sqrt()
    };
    let bisected = |mut low: f64, mut high: f64, is_beyond: &dyn Fn(f64) -> bool| {
        for _ in 0..16 {
            let middle = 0.5 * (low + high);
            if is_beyond(middle) {
                high = middle;
            } else {
                low = middle;
            }
        }
        rpm(0.5 * (low + high))
    };
    let range = [4080.0, 4121.0].map(rad_per_s);
    let expected = bisected(range[0], range[1], &|speed| condition(speed) > 0.0);
    let guided = GuidedBlade::new(&blade, &saw, &plate).unwrap();
    let grows = |speed: f64| guided.growth(speed).unwrap().growth_per_s > 0.02;
    let found = bisected(range[0], range[1], &grows);
    assert!((found - expected).abs() < 0.3, "{found} {expected}");
}

/// The multipliers refuse by name what they do not contain, and slots that take too long to pass.
#[test]
fn what_is_not_contained_is_said() {
    let of = |change: fn(&mut SceneFile)| {
        let saw = saw(Some(FOUR), Some(guide(0.13, 0.02, 2e5, 0.0)));
        let saw = saw.edited(change).unwrap();
        let plate = plate(&saw);
        let blade = TurningBlade::of(&plate.blade).unwrap();
        let guided = GuidedBlade::new(&blade, &saw, &plate);
        guided
            .and_then(|guided| guided.growth(rad_per_s(5.0)))
            .unwrap_err()
    };
    assert_eq!(of(|saw| saw.guides.clear()), NotComputed::Nothing);
    assert_eq!(
        of(|saw| saw.guides[0].stiffness_n_per_m = 0.0),
        NotComputed::Nothing
    );
    let arm = of(|saw| {
        saw.guides[0].arm = serde_json::from_str(r#"{ "stiffness_n_per_m": 1e6 }"#).unwrap()
    });
    assert_eq!(arm, NotComputed::Guide("an arm"));
    let air = of(|saw| saw.damping = serde_json::from_str(r#"{ "air_n_s_per_m3": 20 }"#).unwrap());
    assert_eq!(air, NotComputed::Air);
    let NotComputed::Slow { rpm, least_rpm } = of(|_| ()) else {
        panic!("5 rpm");
    };
    assert!(
        (rpm - 5.0).abs() < 1e-9 && least_rpm > 50.0 && least_rpm < 300.0,
        "{least_rpm}"
    );
    for saw in [Some(FOUR), None].map(|slots| saw(slots, None)) {
        assert!(Analysis::new(&saw).unwrap().floquet.is_none());
    }
}

/// A guide well inside the slots on an arm, whose motion the multipliers do not contain: without damping motions may grow by up to 0.6 1/s
/// below the first critical speed, by the scans of the design, and none does with a loss factor of 1e-3.
#[test]
fn an_undamped_saw_without_multipliers_is_not_certain() {
    let answer = |loss: f64| {
        let saw = saw(Some(FOUR), Some(guide(0.11, 0.02, 2e5, 0.0)));
        let saw = saw.edited(|saw| {
            saw.operating_rpm = Some(2000.0);
            saw.guides[0].arm = serde_json::from_str(r#"{ "stiffness_n_per_m": 1e6 }"#).unwrap();
            saw.damping = (loss > 0.0).then(|| loss_factor(loss));
        });
        let report = Analysis::new(&saw.unwrap()).unwrap().report();
        let open = report.split_pairs.unwrap().not_certain_rpm.unwrap();
        // The speeds that the report lists as not certain are those of the verdict.
        let is_open = open
            .iter()
            .any(|[from, to]| (*from..=*to).contains(&2000.0));
        assert_eq!(
            is_open,
            report.verdict.cause.as_deref() == Some("not_covered"),
            "{open:?}"
        );
        (report.verdict.answer, report.verdict.cause)
    };
    let not_certain = (Some(Answer::AtRisk), Some("not_covered".to_owned()));
    assert_eq!(answer(0.0), not_certain);
    assert_eq!(answer(1e-3), (Some(Answer::Yes), None));
}

/// A guide beside the slots: with a loss factor the saw can run where the multipliers say so, and without one it cannot where they grow.
#[test]
fn the_multipliers_decide_at_the_operating_speed() {
    let slotted = |loss: f64, rpm: f64| {
        let saw = saw(Some(FOUR), Some(guide(0.185, 0.02, 2e5, 20.0)));
        let change = |saw: &mut SceneFile| {
            saw.operating_rpm = Some(rpm);
            saw.damping = (loss > 0.0).then(|| loss_factor(loss));
        };
        saw.edited(change).unwrap()
    };
    let saw = slotted(1e-3, 2000.0);
    let analysis = Analysis::new(&saw).unwrap();
    let report = analysis.report();
    let verdict = &report.verdict;
    assert_eq!(verdict.answer, Some(Answer::Yes), "{verdict:?}");
    let found = verdict.floquet.as_ref().unwrap();
    assert!(
        found.growth_per_s.iter().all(|growth| *growth < 0.0),
        "{found:?}"
    );
    assert_eq!(verdict.windows_rpm.len(), 1);
    let [from, to] = verdict.windows_rpm[0];
    assert!((from - 1980.0).abs() < 1e-6 && (to - 2020.0).abs() < 1e-6);
    assert_eq!(verdict.allowed_to_rpm, None);
    let state = |rpm: f64| analysis.verdict(rad_per_s(rpm)).state;
    assert_eq!(state(2010.0), StabilityState::Stable);
    assert_eq!(state(2100.0), StabilityState::NotCovered);
    let text = serde_json::to_string(&report.warnings).unwrap();
    assert!(text.contains("Floquet multipliers"), "{text}");
}

/// Multipliers belong to one speed: sizing the operating speed finds the speeds at which a check of the saw at this speed is a yes, and
/// not only those that the model covers without them, which are none for a guide beside the slots.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn the_speeds_of_a_sized_saw_are_those_of_its_checks() {
    let saw = saw(Some(FOUR), Some(guide(0.185, 0.02, 2e5, 20.0)));
    let saw = saw.edited(|saw| {
        saw.operating_rpm = Some(2000.0);
        saw.damping = Some(loss_factor(1e-3));
    });
    let saw = saw.unwrap();
    let options = size::Options {
        vary: vec![("operating_rpm".to_owned(), Some((1900.0, 2100.0)))],
        points: 3,
        ..size::Options::default()
    };
    let sized = options.compute(&saw, &|_| ()).unwrap();
    assert!(sized.answers.contains(&Some(Answer::Yes)), "{sized:?}");
    for (rpm, answer) in sized.values.iter().zip(&sized.answers) {
        let checked = check(&saw, &Limits::of(&saw, *rpm).unwrap()).unwrap();
        assert_eq!(checked.verdict.answer, *answer, "{rpm}");
    }
}
