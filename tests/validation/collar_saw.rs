//! Goal: a rotating blade between collars has the frequencies and critical speeds of an independent computation, for
//! either condition in its plane.
//!
//! Source: tests/reference/collar_saw.json, computed by another Kirchhoff–Ritz code,
//! which 3-D solids confirm to 0.02 to 0.75 %. Its frequencies are those on the blade;
//! in space the wave of n diameters is seen at f ± nΩ/2π.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use crate::common::{Worst, of_diameters, reference_model, relative_error};
use sawflutter::analyses::check::{Limits, check};
use sawflutter::model::scene::{InPlane, Mount, Scene, rad_per_s, rpm};
use sawflutter::modes::SpectralModel;
use serde::Deserialize;

#[derive(Deserialize)]
struct Reference {
    blade: ReferenceBlade,
    in_plane_fixed: Fixed,
    in_plane_free: Free,
}

#[derive(Deserialize)]
struct ReferenceBlade {
    outer_radius_m: f64,
    collar_radius_m: f64,
    thickness_m: f64,
    youngs_modulus_pa: f64,
    poisson_ratio: f64,
    density_kg_per_m3: f64,
}

#[derive(Deserialize)]
struct Fixed {
    frequency_hz_by_rpm: BTreeMap<String, Vec<f64>>,
    critical_rpm_by_n: BTreeMap<String, f64>,
}

#[derive(Deserialize)]
struct Free {
    critical_rpm_by_n: BTreeMap<String, f64>,
}

fn reference() -> Reference {
    let text =
        std::fs::read_to_string(crate::common::path("tests/reference/collar_saw.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

/// The saw of `scenes/`, which is also that of the reference.
fn saw(in_plane: InPlane) -> Scene {
    let mount = Mount::Collar {
        diameter_m: 0.120,
        in_plane,
        clamp_stiffness_n_m_per_rad_per_m: None,
    };
    let saw = crate::common::scene("collar-400mm").edited(|saw| saw.mount = mount);
    saw.unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn the_scene_is_the_reference_blade() {
    let expected = reference().blade;
    let blade = *saw(InPlane::Fixed).blade();
    let pairs = [
        (blade.outer_radius_m, expected.outer_radius_m),
        (blade.inner_radius_m, expected.collar_radius_m),
        (blade.thickness_m, expected.thickness_m),
        (blade.material.youngs_modulus_pa, expected.youngs_modulus_pa),
        (blade.material.poisson_ratio, expected.poisson_ratio),
        (blade.material.density_kg_per_m3, expected.density_kg_per_m3),
    ];
    for (actual, expected) in pairs {
        assert_eq!(actual, expected);
    }
}

/// Both waves of n = 0 … 6 at 0 to 4000 rpm. A backward wave above its critical speed would count as reflected, with
/// Krein sign −1; these speeds are below the first critical speed.
#[test]
fn frequencies_in_space_at_every_speed() {
    let model = reference_model(&saw(InPlane::Fixed), rad_per_s(4000.0));
    let mut worst = Worst::default();
    for (speed, on_blade_hz) in reference().in_plane_fixed.frequency_hz_by_rpm {
        let speed_rpm: f64 = speed.parse().unwrap();
        let modes = model.all_modes(rad_per_s(speed_rpm)).unwrap();
        for (n, f) in on_blade_hz.into_iter().enumerate() {
            let carried = n as f64 * speed_rpm / 60.0;
            let waves = if n == 0 {
                vec![f]
            } else {
                vec![f - carried, f + carried]
            };
            for wave_hz in waves {
                assert!(wave_hz > 0.0, "{n} diameters at {speed} rpm");
                let nearest = of_diameters(&modes, n)
                    .filter(|mode| mode.krein_sign() == 1)
                    .map(|mode| (mode.frequency_rad_per_s() / TAU - wave_hz).abs())
                    .fold(f64::INFINITY, f64::min);
                worst.add(nearest / f, || format!("{n} diameters at {speed} rpm"));
            }
        }
    }
    assert_eq!(worst.count, 5 * 13);
    // The table has three decimals: half a unit of the last one is 6e-6 of 90 Hz.
    worst.assert_at_most("collar saw, frequencies", 1e-4);
}

/// Frequencies on the blade, where modes are named.
#[test]
fn frequencies_on_the_blade_at_every_speed() {
    let model = reference_model(&saw(InPlane::Fixed), rad_per_s(4000.0));
    let mut worst = Worst::default();
    for (speed, on_blade_hz) in reference().in_plane_fixed.frequency_hz_by_rpm {
        let speed_rad_per_s = rad_per_s(speed.parse().unwrap());
        let modes = model.modes(speed_rad_per_s).unwrap();
        for described in model.describe(speed_rad_per_s, modes) {
            let name = &described.name;
            assert_eq!(name.diameters, described.mode.component);
            let Some(f) = on_blade_hz
                .get(name.diameters)
                .filter(|_| name.circles == 0)
            else {
                continue;
            };
            let actual = name.body_frequency_rad_per_s(&described.mode, speed_rad_per_s) / TAU;
            worst.add(relative_error(actual, *f), || {
                format!("{} diameters at {speed} rpm", name.diameters)
            });
        }
    }
    assert!(worst.count >= 5 * 9, "{worst:?}");
    worst.assert_at_most("collar saw, frequencies on the blade", 1e-4);
}

fn critical_rpm(model: &SpectralModel, diameters: usize) -> Vec<f64> {
    model
        .critical
        .iter()
        .filter(|c| (c.name.diameters(), c.name.circles()) == (diameters, 0))
        .map(|c| rpm(c.speed_rad_per_s))
        .collect()
}

/// Both waves of n are stationary at one speed: every value occurs twice.
fn compare_critical(in_plane: InPlane, expected: &BTreeMap<String, f64>) -> Worst {
    let model = reference_model(&saw(in_plane), rad_per_s(4000.0));
    let mut worst = Worst::default();
    for (n, expected_rpm) in expected {
        let speeds = critical_rpm(&model, n.parse().unwrap());
        assert_eq!(speeds.len(), 2, "{n} diameters: {speeds:?}");
        for speed in speeds {
            worst.add(relative_error(speed, *expected_rpm), || {
                format!("{n} diameters, {speed:.3} rpm instead of {expected_rpm}")
            });
        }
    }
    let lowest = expected.values().copied().fold(f64::INFINITY, f64::min);
    crate::common::assert_close(
        "the lowest of all",
        rpm(model.critical[0].speed_rad_per_s),
        lowest,
        1e-5,
    );
    worst
}

/// n = 0 and n = 1 have no critical speed.
#[test]
fn critical_speeds_of_the_blade_held_in_its_plane() {
    let expected = reference().in_plane_fixed.critical_rpm_by_n;
    assert_eq!(expected.len(), 5);
    compare_critical(InPlane::Fixed, &expected).assert_at_most("collar saw, fixed", 1e-5);
    let model = reference_model(&saw(InPlane::Fixed), rad_per_s(4000.0));
    assert!(model.critical.iter().all(|c| c.name.diameters() >= 2));
}

/// If it is free in its plane, the critical speeds of the blade are 15 % higher.
#[test]
fn critical_speeds_of_the_blade_free_in_its_plane() {
    let expected = reference().in_plane_free.critical_rpm_by_n;
    assert_eq!(expected.len(), 2);
    compare_critical(InPlane::Free, &expected).assert_at_most("collar saw, free", 1e-5);
}

/// The reference is the deflection by one newton at the rim of the blade at rest, from the same independent code.
#[test]
fn the_rim_is_as_stiff_as_the_reference_says() {
    let text =
        std::fs::read_to_string(crate::common::path("tests/reference/collar_saw.json")).unwrap();
    let reference: serde_json::Value = serde_json::from_str(&text).unwrap();
    let expected = reference["rim_point_stiffness_n_per_m_at_rest"]
        .as_f64()
        .unwrap();
    let check = check(&saw(InPlane::Fixed), &Limits::at(rad_per_s(3000.0))).unwrap();
    let error = check.rim_stiffness_at_rest_n_per_m / expected - 1.0;
    assert!(error.abs() < 0.01, "{error}");
    // Far below the critical speed of a blade, centrifugal tension stiffens the rim less than the gyroscopic effect of
    // the stationary deflection softens it.
    assert!(check.rim_stiffness_n_per_m.unwrap() < check.rim_stiffness_at_rest_n_per_m);
    assert!(check.passed, "{:?}", check.failures());
}
