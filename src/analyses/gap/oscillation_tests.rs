//! Oscillations compared with the linear response and with time histories.

use std::f64::consts::TAU;

use faer::{Col, Mat, c64};

use super::*;
use crate::analyses::gap::{Options, OscillationPlace, gap};
use crate::analyses::response::{Options as ResponseOptions, response};
use crate::model::plate::Resolution;
use crate::model::scene::{
    Accuracy, ContactLaw, DampingFile, GuideFile, ResponseFile, Scene, SideForceFile, SweepFile,
    rad_per_s,
};
use crate::motion::transient::{Force, Integrator, Newmark, State as MovingState};

/// The built-in saw with damping and a lack of flatness.
fn saw(change: impl FnOnce(&mut GuideFile)) -> Scene {
    let scene = Scene::paper().edited(|file| {
        (file.accuracy, file.operating_rpm) = (Accuracy::Draft, Some(900.0));
        file.sweep = Some(SweepFile {
            from_rpm: 0.0,
            to_rpm: 1400.0,
        });
        file.damping = Some(DampingFile {
            air_n_s_per_m3: 400.0,
            ..DampingFile::default()
        });
        file.side_force = Some(SideForceFile::of(1.0));
        file.response = Some(ResponseFile {
            flatness_m: 1.5e-4,
            ..ResponseFile::default()
        });
        change(&mut file.guides[0]);
    });
    scene.unwrap()
}

/// The blade of a scene in a basis for its oscillations.
fn oscillating(
    scene: &Scene,
    resolution: Resolution,
    asked: (f64, f64),
    modes: usize,
) -> OscillatingBlade {
    let plate = Plate::new(scene, resolution);
    let oscillators = Oscillators::of(scene).unwrap();
    let loads = loads(&plate, scene, 0.0).unwrap();
    OscillatingBlade::new(&plate, scene, (&oscillators, loads), asked, modes).unwrap()
}

/// Complex amplitude of a part of a motion.
fn harmonic(place: &OscillationPlace, part: usize) -> c64 {
    let phase = place.phase_deg[part].to_radians();
    place.lines_m[part] * c64::new(phase.cos(), phase.sin())
}

const SMALL: Resolution = Resolution {
    max_diameters: 8,
    radial_functions: 4,
};

/// Independent value: a gap of a picometre makes a linear guide, for which `response` solves the full model.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn without_a_gap_the_motion_is_the_linear_response() {
    let typed = saw(|_| ()).edited(|file| {
        if let Some(response) = &mut file.response {
            // Small deflections, which do not stretch the blade.
            (response.flatness_m, response.imbalance_kg_m2) = (1e-5, 1e-6);
        }
        file.side_force = Some(SideForceFile::of(0.01));
    });
    let typed = typed.unwrap();
    let linear = response(&typed, &ResponseOptions::default()).unwrap();
    let lifting = typed.edited(|file| {
        let pad = &mut file.guides[0];
        (pad.contact, pad.gap_m) = (ContactLaw::OneSided, Some(1e-12));
    });
    let analysis = Analysis::new(&lifting.unwrap()).unwrap();
    let oscillators = Oscillators::of(&analysis.scene).unwrap();
    let speed = rad_per_s(900.0);
    assert_eq!(oscillators.base_order(), 1);
    assert_eq!(oscillators.name_of(2), "flatness, imbalance");
    let to = analysis.range_rad_per_s.to_rad_per_s;
    let blade = oscillating(
        &analysis.scene,
        analysis.model.plate.resolution,
        (speed, to),
        MODES,
    );
    let speeds = (1..=SPEEDS).map(|k| to * k as f64 / SPEEDS as f64);
    let motions = speeds.chain([speed]).filter_map(|speed| {
        let (found, _) = blade.at(speed).unwrap();
        Some((speed, reading(&blade, speed, &found?)))
    });
    let largest = |order: u32| {
        let own = linear.lines.iter().filter(|line| line.order == order);
        let all = own.flat_map(|line| line.amplitude_m.iter().flatten());
        all.copied().fold(0.0, f64::max)
    };
    let mut compared = 0;
    for (own_speed, at) in motions.filter(|(_, at)| at.stable) {
        let away = |k: &usize| (rad_per_s(linear.rpm[*k]) / own_speed - 1.0).abs();
        let speeds = 0..linear.rpm.len();
        let place = speeds.min_by(|a, b| away(a).total_cmp(&away(b))).unwrap();
        assert!(away(&place) < 1e-4);
        // The basis contains the linear response at the speed of the map, where the motion is more accurate.
        let tolerance = if (own_speed / speed - 1.0).abs() < 1e-9 {
            1e-3
        } else {
            1e-2
        };
        for order in [1, 2] {
            let own = linear.lines.iter().filter(|line| line.order == order);
            let sum: Option<c64> = own
                .map(|line| {
                    let phase = line.phase_deg[place]?.to_radians();
                    Some(c64::from_polar(line.amplitude_m[place]?, phase))
                })
                .sum();
            let Some(expected) = sum else { continue };
            let w = harmonic(&at.probe, order as usize - 1);
            // Between resonances the contributions of the modes cancel each other, which enlarges the relative error.
            let size = expected.norm().max(0.1 * largest(order));
            assert!(
                (w - expected).norm() < tolerance * size,
                "{} rpm, {order}: {w} {expected}",
                at.rpm
            );
            compared += 1;
        }
    }
    assert!(compared > 20, "{compared}");
}

/// Independent value: the time history of the same blade, from rest until its oscillation is steady.
#[test]
#[cfg_attr(debug_assertions, ignore = "many steps: run it in release")]
fn the_motion_of_a_blade_that_is_not_flat_is_that_of_the_time_history() {
    compare_with_time_history(true, 0.0, 2);
}

/// Independent value: the time history of the same blade, from rest until its oscillation is steady.
#[test]
#[cfg_attr(debug_assertions, ignore = "many steps: run it in release")]
fn the_motion_under_an_oscillating_force_is_that_of_the_time_history() {
    compare_with_time_history(false, 0.6, 1);
}

fn compare_with_time_history(turning: bool, oscillating_n: f64, base: u32) {
    let scene = saw(|pad| (pad.contact, pad.gap_m) = (ContactLaw::OneSided, Some(4e-5)));
    let speed = rad_per_s(900.0);
    let scene = scene
        .edited(|file| {
            if !turning {
                file.response = None;
            }
            file.side_force = Some(SideForceFile {
                oscillating_n,
                ..SideForceFile::of(1.0)
            });
        })
        .unwrap();
    let oscillators = Oscillators::of(&scene).unwrap();
    assert_eq!(oscillators.base_order(), base);
    let asked = (speed, rad_per_s(1400.0));
    let blade = oscillating(&scene, SMALL, asked, 10);
    let (found, _) = blade.at(speed).unwrap();
    let at = reading(&blade, speed, &found.unwrap());
    let growth_per_s = at.growth_per_s.unwrap();
    assert!(growth_per_s <= 0.0, "{at:?}");
    // Without lifting off there would be one harmonic only. The oscillating force is too small for a large second one.
    let [first, second] = [0, 1].map(|k| at.cut.lines_m[k]);
    assert!(!turning || second > 0.02 * first, "{first} {second}");

    let terms = blade.terms();
    let forces: Vec<&dyn Force> = terms.iter().map(|term| term.force).collect();
    let order = blade.system.order();
    let zero = Mat::zeros(order, 1 + 2 * HARMONICS);
    let load = blade.load(zero, speed);
    let loads: Vec<Col<f64>> = (0..3).map(|k| load.col(k).to_owned()).collect();
    let steps = 200;
    let frequency = f64::from(base) * speed;
    let step_s = TAU / frequency / f64::from(steps);
    let newmark = Newmark::new(&blade.system, (speed, 0.0), &loads, step_s).with_forces(&forces);
    let sizes = |step: u32| {
        let (sin, cos) = (TAU * f64::from(step % steps) / f64::from(steps)).sin_cos();
        [1.0, cos, sin]
    };
    let rest = blade.blade.settled(speed, &blade.blade.flat()).unwrap();
    let mut state = MovingState::still(rest.coordinates);
    let (mut mean, mut first) = (0.0, c64::new(0.0, 0.0));
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    // Until the last period, small motions decay to less than three thousandths.
    let decay = -growth_per_s;
    let periods = (6.0 * frequency / TAU / decay).ceil() as u32;
    assert!((20..1200).contains(&periods), "{periods}");
    let periods = 1 + periods;
    for step in 0..periods * steps {
        let now = sizes(step);
        if step >= (periods - 1) * steps {
            let w = blade.cut.transpose() * &state.displacement;
            mean += w / f64::from(steps);
            first += 2.0 / f64::from(steps) * w * c64::new(now[1], -now[2]);
            (low, high) = (low.min(w), high.max(w));
        }
        state = newmark.step(&state, [&now, &sizes(step + 1)]).unwrap();
    }
    let amplitude = 0.5 * (high - low);
    assert!(
        (at.cut.amplitude_m / amplitude - 1.0).abs() < 1e-2,
        "{} {amplitude}",
        at.cut.amplitude_m
    );
    assert!(
        (at.cut.mean_m - mean).abs() < 1e-2 * amplitude,
        "{} {mean}",
        at.cut.mean_m
    );
    let own = harmonic(&at.cut, 0);
    assert!((own - first).norm() < 1e-2 * amplitude, "{own} {first}");
}

/// More harmonics change the amplitude by less than 2 %, more modes by less than 5 %.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn more_harmonics_and_modes_change_little() {
    let scene = saw(|pad| (pad.contact, pad.gap_m) = (ContactLaw::OneSided, Some(4e-5)));
    let found = gap(&scene, &Options::default())
        .unwrap()
        .oscillation
        .unwrap();
    let errors = [found.harmonics_error_share, found.basis_error_share];
    let [harmonics, basis] = errors.map(Option::unwrap);
    assert!(harmonics < 0.02 && basis < 0.05, "{harmonics} {basis}");
    let second = &found.lines[1];
    assert_eq!((second.order, &*second.name), (4, "contact"));
}

#[test]
fn a_force_too_fast_for_the_turning_blade_is_refused() {
    let scene = saw(|pad| (pad.contact, pad.gap_m) = (ContactLaw::OneSided, Some(4e-5)));
    let checked = |scene: &Scene, order: u32| {
        let scene = scene.edited(|file| {
            file.side_force = Some(SideForceFile {
                oscillating_n: 1.0,
                order: Some(order),
                ..SideForceFile::default()
            });
        });
        Options::default().checked(&scene.unwrap())
    };
    assert_eq!(checked(&scene, 41).unwrap_err().key, "side_force.order");
    assert!(checked(&scene, 4).is_ok());
    let alone = scene.edited(|file| file.response = None).unwrap();
    assert!(checked(&alone, 41).is_ok());
    assert!(Oscillators::of(&alone).is_none());
}
