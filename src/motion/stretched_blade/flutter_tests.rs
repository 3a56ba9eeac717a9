//! The amplitude to which flutter rises, compared with simulated motions.

use faer::{Col, c64};

use super::tests::paper;
use super::*;
use crate::model::scene::{Polar, rad_per_s};
use crate::model::system::GyroscopicSystem;
use crate::modes::{companion_eigenpairs, fastest_growing};
use crate::motion::transient::{Force, Integrator, Newmark, State};

/// Flutter of the undamped blade from a small motion, by the integrator that conserves energy, compared with
/// the loop of the normal form, in the middle of a band and nearer to its onset.
#[test]
fn flutter_rises_as_far_as_the_normal_form_says() {
    let plate = paper().conservative();
    // The band near 2260 rpm is 10 rpm wide.
    for rpm in [2269.0, 2264.0] {
        let speed = rad_per_s(rpm);
        let blade = StretchedBlade::at_speed(&plate, speed, 6).unwrap();
        let predicted = blade.saturation(speed).unwrap().unwrap();
        let system = GyroscopicSystem::of_plate(&plate);
        let growth = fastest_growing(&system, speed).unwrap().unwrap().re;
        assert!((predicted.growth_per_s / growth - 1.0).abs() < 1e-5);
        let largest = simulated(&blade, &predicted);
        let error = predicted.amplitude_m / largest - 1.0;
        assert!(error.abs() < 5e-3, "{predicted:?} {largest}");
    }
    // Outside of the band nothing grows.
    let blade = StretchedBlade::at_speed(&plate, rad_per_s(1000.0), 6).unwrap();
    assert_eq!(blade.saturation(rad_per_s(1000.0)).unwrap(), None);
}

/// The largest deflection, at the predicted point, of a motion that grows from a tenth of it.
fn simulated(blade: &StretchedBlade, predicted: &Saturation) -> f64 {
    let speed = predicted.speed_rad_per_s;
    let pairs = companion_eigenpairs(&blade.system, speed).unwrap();
    let fastest = pairs.iter().max_by(|x, y| x.0.re.total_cmp(&y.0.re));
    let (lambda, wave) = fastest.unwrap();
    let reading = blade.shapes_at(Polar::new(predicted.radius_m, predicted.angle_rad));
    let order = wave.nrows();
    let at_place = (0..order).map(|i| wave[i] * reading[i]).sum::<c64>().norm();
    let small = 0.1 * predicted.amplitude_m / at_place;
    let mut state = State {
        displacement: Col::from_fn(order, |i| small * wave[i].re),
        velocity: Col::from_fn(order, |i| small * (wave[i] * *lambda).re),
    };
    let forces: [&dyn Force; 1] = [&blade.stretching];
    let step_s = std::f64::consts::TAU / predicted.frequency_rad_per_s / 60.0;
    let newmark = Newmark::new(&blade.system, (speed, 0.0), &[], step_s).with_forces(&forces);
    let mut largest = 0.0_f64;
    for _ in 0..(5.0 / predicted.growth_per_s / step_s) as usize {
        state = newmark.step(&state, [&[], &[]]).unwrap();
        largest = largest.max((reading.transpose() * &state.displacement).abs());
    }
    largest
}

/// The two waves of a band on the full model give the same result as the lowest modes, from an eigenvalue
/// known to three digits, and for a blade with damping as for one without.
#[test]
fn two_waves_are_enough() {
    let speed = rad_per_s(2267.5);
    let blade = StretchedBlade::at_speed(&paper().conservative(), speed, 6).unwrap();
    let modes = blade.saturation(speed).unwrap().unwrap();
    let near = c64::new(1.01 * modes.growth_per_s, 1.001 * modes.frequency_rad_per_s);
    let found = FlutterRise::new(&paper())
        .unwrap()
        .near(speed, near)
        .unwrap()
        .unwrap();
    assert!((found.growth_per_s / modes.growth_per_s - 1.0).abs() < 1e-5);
    let error = found.amplitude_m / modes.amplitude_m - 1.0;
    assert!(error.abs() < 1e-4, "{found:?} {modes:?}");
    // Where nothing grows there is no amplitude.
    let rise = FlutterRise::new(&paper()).unwrap();
    assert_eq!(rise.near(rad_per_s(1000.0), near).unwrap(), None);
}

/// Over a band the square of the amplitude is 1 ± √(1 − (σ/σ_max)²) times that at the fastest growth: with a
/// detuning δ and a coupling c of the two waves σ² = |c|² − δ²/4, and the square is proportional to 2|c| − δ.
#[test]
fn over_a_band_the_amplitude_follows_the_detuning() {
    let plate = paper().conservative();
    let at = |rpm: f64| {
        let blade = StretchedBlade::at_speed(&plate, rad_per_s(rpm), 6).unwrap();
        blade.saturation(rad_per_s(rpm)).unwrap().unwrap()
    };
    let fastest = at(2267.5);
    for (rpm, side) in [(2263.5, -1.0), (2264.5, -1.0), (2270.5, 1.0), (2271.5, 1.0)] {
        let found = at(rpm);
        let share = found.growth_per_s / fastest.growth_per_s;
        let expected = 1.0 + side * (1.0 - share * share).sqrt();
        let square = (found.amplitude_m / fastest.amplitude_m).powi(2);
        assert!(
            (square - expected).abs() < 0.03,
            "{rpm}: {square} {expected}"
        );
    }
}
