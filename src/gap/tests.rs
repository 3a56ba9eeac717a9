//! The mean stiffness against an integral, and its limits; deflections against the linear guide.

use std::f64::consts::TAU;

use super::*;
use crate::scene::{Accuracy, ContactLaw, Scene};

fn lifting(gap_m: f64) -> Scene {
    let scene = Scene::paper().edited(|file| {
        (file.accuracy, file.operating_rpm) = (Accuracy::Draft, Some(1000.0));
        file.sweep = Some(crate::scene::SweepFile {
            from_rpm: 0.0,
            to_rpm: 2000.0,
        });
        let pad = &mut file.guides[0];
        (pad.contact, pad.gap_m) = (ContactLaw::OneSided, Some(gap_m));
    });
    scene.unwrap()
}

/// The first Fourier coefficient of the force of a spring behind a gap.
#[test]
fn the_mean_stiffness_is_the_first_harmonic_of_the_force() {
    let count = 200_000;
    for ratio in [0.5, 1.0, 1.001, 1.1, 2.0, 30.0_f64] {
        let force = |k: usize| {
            let sin = (TAU * (k as f64 + 0.5) / count as f64).sin();
            sin * ((ratio * sin - 1.0).max(0.0) - (-ratio * sin - 1.0).max(0.0))
        };
        let harmonic = 2.0 / count as f64 * (0..count).map(force).sum::<f64>() / ratio;
        let found = equivalent_share(ratio);
        assert!(
            (found - harmonic).abs() < 1e-8,
            "{ratio}: {found} {harmonic}"
        );
    }
    assert!(equivalent_share(1e6) > 0.999_998);
}

/// Between the free blade and the linear chart: the rows approach both, and the amplitude half way is where it says.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn the_chart_over_the_amplitude_joins_the_free_blade_and_the_linear_one() {
    let found = GuideGaps::new(&lifting(4e-5), &Options::default()).unwrap();
    let chart = &found.amplitude;
    let first = |at: &AtAmplitude| at.critical_rad_per_s[0];
    let free = Scene::paper().edited(|file| {
        file.accuracy = Accuracy::Draft;
        file.guides.clear();
    });
    let free = Analysis::new(&free.unwrap()).unwrap();
    let expected = free.model.critical[0].speed_rad_per_s;
    assert!((first(&chart.free) / expected - 1.0).abs() < 2e-3);
    let lowest = &chart.amplitudes[0];
    assert!((first(lowest) / first(&chart.free) - 1.0).abs() < 0.02);
    let highest = chart.amplitudes.last().unwrap();
    assert!((first(highest) / first(&chart.linear) - 1.0).abs() < 2e-3);
    let half = chart.half_way_m.unwrap();
    let middle = 0.5 * (first(&chart.free) + first(&chart.linear));
    let rows = chart.amplitudes.iter();
    for at in rows {
        let is_below = at.amplitude_m.unwrap() < half;
        assert_eq!(
            first(at) < middle,
            is_below == (first(&chart.free) < middle)
        );
    }
    // Every pad force balances the side force, whatever the gap; a wider gap lets the blade go further.
    let map = &found.deviation;
    for (row, factor) in map.over_gap.iter().zip(&map.gap_factors) {
        for (at, force) in row.iter().zip(&map.forces_n) {
            let at = at.as_ref().unwrap();
            match *factor == 0.0 {
                true => assert!(at.pad_forces_n.is_empty()),
                false => assert!((at.pad_forces_n[0] + force).abs() < 1e-5 * force),
            }
        }
    }
    // Both maps have the scene's speed and force.
    let same = map.over_gap.iter().zip(&map.over_speed);
    for (over_force, over_speed) in same {
        let [one, other] = [&over_force[6], &over_speed[6]].map(|at| at.as_ref().unwrap());
        assert!((one.deviation_m / other.deviation_m - 1.0).abs() < 1e-9);
    }
    let error = map.basis_error.unwrap();
    assert!(error.share < 2e-3, "{error:?}");
    for gaps in map.over_gap[1..].windows(2) {
        let [narrow, wide] = [&gaps[0], &gaps[1]].map(|row| row[2].as_ref().unwrap().deviation_m);
        assert!(wide > narrow, "{narrow} {wide}");
    }
}

#[test]
fn limits_are_interpolated_between_forces() {
    let at = |deviation_m: f64| {
        Some(Deviation {
            deviation_m,
            largest_m: deviation_m,
            pad_forces_n: Vec::new(),
        })
    };
    let map = DeviationMap {
        angle_rad: 0.0,
        rpm: 1000.0,
        gap_factors: vec![0.0, 1.0, 2.0],
        forces_n: vec![1.0, 2.0, 4.0],
        over_gap: vec![
            vec![at(1e-5), at(2e-5), at(4e-5)],
            vec![at(4e-5), at(8e-5), at(2.4e-4)],
            vec![at(2e-4), None, None],
        ],
        force_n: 1.0,
        speeds_rpm: vec![0.0, 500.0, 1000.0],
        over_speed: vec![vec![at(1e-5), at(1e-4), None]; 3],
        basis_error: None,
    };
    let found = map.force_within_n(1.2e-4);
    assert_eq!((found[0], found[2]), (Some(4.0), None));
    assert!((found[1].unwrap() - 2.5).abs() < 1e-12, "{found:?}");
    // Beyond the last speed at which the deflection is known nothing is interpolated.
    assert_eq!(map.speed_within_rpm(1.2e-4), vec![Some(500.0); 3]);
    let found = map.speed_within_rpm(5.5e-5)[0].unwrap();
    assert!((found - 250.0).abs() < 1e-9, "{found}");
}

#[test]
fn what_cannot_be_answered_is_refused() {
    let options = Options::default();
    let refused = options.checked(&Scene::paper()).unwrap_err();
    assert_eq!(refused.key, "guides[].contact");
    let scene = lifting(4e-5);
    for (options, key) in [
        (
            Options {
                force_n: Some(0.0),
                ..options
            },
            "force_n",
        ),
        (
            Options {
                rpm: Some(-1.0),
                ..options
            },
            "rpm",
        ),
        (
            Options {
                max_deviation_mm: Some(f64::NAN),
                ..options
            },
            "max_deviation_mm",
        ),
        (
            Options {
                friction: Some(Friction::of(-0.1)),
                ..options
            },
            "friction",
        ),
    ] {
        assert_eq!(options.checked(&scene).unwrap_err().key, key);
    }
}

/// One pad carries the whole side force whatever the temperature: the power is that of a rigid pad, and the temperature
/// follows in one step. Heat beside the rim lowers the deflection that the pad allows no more than it softens the blade.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn the_heat_of_one_pad_is_that_of_the_side_force() {
    let scene = lifting(4e-5).edited(|file| {
        // A point pad has one radius.
        let pad = &mut file.guides[0];
        (pad.radial_length_m, pad.tangential_length_m) = (0.0, 0.0);
    });
    let analysis = Analysis::new(&scene.unwrap()).unwrap();
    let friction = Friction::of(0.2);
    let heat = FrictionHeat::new(&analysis, friction, (2.0, 1000.0)).unwrap();
    assert!(heat.has_settled(), "{heat:?}");
    let blade = analysis.scene.blade();
    let radius_m = analysis.scene.guides()[0].radius_m;
    let power_w = 0.2 * 2.0 * rad_per_s(1000.0) * radius_m;
    assert!(
        (heat.power_w / power_w - 1.0).abs() < 1e-4,
        "{}",
        heat.power_w
    );
    let disk = crate::analytical::ring_source::CooledDisk {
        inner_radius_m: blade.inner_radius_m,
        outer_radius_m: blade.outer_radius_m,
        thickness_m: blade.thickness_m,
        conductivity_w_per_m_k: friction.conductivity_w_per_m_k,
        convection_w_per_m2_k: friction.convection_w_per_m2_k,
    };
    for (r, found) in heat.radii_m.iter().zip(&heat.rise_k) {
        let exact = disk.rise_k(*r, power_w, radius_m);
        assert!((found / exact - 1.0).abs() < 2e-2, "{r}: {found} {exact}");
    }
    // The deflection of the heated scene is that of a scene with this temperature.
    let warm = analysis.scene.edited(|file| {
        let rows = heat.radii_m.iter().zip(&heat.rise_k);
        let table = rows.map(|(radius_m, rise_k)| crate::scene::TemperatureRow {
            radius_m: *radius_m,
            rise_k: *rise_k,
        });
        file.membrane = Some(crate::scene::MembraneFile {
            temperature: Some(crate::scene::TemperatureFile {
                expansion_per_k: heat.expansion_per_k,
                rim_rise_k: None,
                from_radius_m: None,
                exponent: None,
                table: table.collect(),
            }),
            roll_tension: Vec::new(),
            residual_stress: Vec::new(),
        });
    });
    let warm = Analysis::new(&warm.unwrap()).unwrap();
    let first = warm.model.critical[0].speed_rad_per_s;
    let [cold, hot] = heat.critical_rad_per_s.map(Option::unwrap);
    assert!((hot / first - 1.0).abs() < 2e-3, "{hot} {first}");
    assert!((hot / cold - 1.0).abs() > 1e-3, "{hot} {cold}");
}
