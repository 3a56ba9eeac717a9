//! Goal: heat and roll tension change the frequencies as an independent computation predicts, and in the directions
//! that saw makers know.
//!
//! Sources: tests/reference/collar_saw.json and collar_saw_membrane.json, both by other
//! Kirchhoff codes.

use std::f64::consts::TAU;

use crate::common::{Worst, of_diameters, reference_model, relative_error};
use proptest::prelude::*;
use sawflutter::analyses::check::{Limits, check};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{
    InPlane, Mount, Parameter, Scene, SceneFile, SpeedRange, rad_per_s, rpm,
};
use sawflutter::modes::{SpectralModel, SpectrumError, Strategy};
use sawflutter::stability::{Analysis, AnalysisError, HeatLimits};

use super::saws::{collar, dense_analysis, heated, rolled, scene_with};

const SMALL: Resolution = Resolution {
    max_diameters: 6,
    radial_functions: 5,
};

/// The lowest frequency at rest of each n, in Hz.
fn at_rest_hz(scene: &Scene) -> Vec<f64> {
    let model = reference_model(scene, rad_per_s(1000.0));
    let modes = model.all_modes(0.0).unwrap();
    let lowest = |n| {
        let frequencies = of_diameters(&modes, n).map(|mode| mode.frequency_rad_per_s() / TAU);
        frequencies.fold(f64::INFINITY, f64::min)
    };
    (0..=6).map(lowest).collect()
}

fn compare(name: &str, key: &str, scene: &Scene, tolerance: f64) {
    let text =
        std::fs::read_to_string(crate::common::path(&format!("tests/reference/{name}"))).unwrap();
    let reference: serde_json::Value = serde_json::from_str(&text).unwrap();
    let expected: Vec<f64> = serde_json::from_value(reference[key].clone()).unwrap();
    assert!(expected.len() >= 6);
    let mut worst = Worst::default();
    for (n, (actual, expected)) in at_rest_hz(scene).into_iter().zip(expected).enumerate() {
        let error = relative_error(actual, expected);
        worst.add(error, || {
            format!("n = {n}, {actual} instead of {expected} Hz")
        });
    }
    worst.assert_at_most(key, tolerance);
}

/// The reference has three decimals of about 100 Hz.
#[test]
fn the_rim_ten_kelvin_hotter() {
    let key = "rim_heated_10_k_linear_from_collar_alpha_1.2e-5_fixed_0_rpm_hz";
    compare("collar_saw.json", key, &heated(&collar(), 10.0), 1e-5);
}

/// The same blade with a rolled band, and with a temperature that has a kink on the blade. The reference uses finite
/// differences for the stress and Hermite elements for the plate.
#[test]
fn a_rolled_band_and_a_kinked_temperature() {
    let name = "collar_saw_membrane.json";
    let rolled = rolled(&collar(), 7e-4);
    compare(name, "rolled_100_mm_20_mm_7e-4_fixed_hz", &rolled, 1e-4);
    let table = serde_json::json!([
        { "radius_m": 0.06, "rise_k": 4.0 },
        { "radius_m": 0.15, "rise_k": 6.0 },
        { "radius_m": 0.20, "rise_k": 30.0 }
    ]);
    let temperature = serde_json::json!({ "expansion_per_k": 1.2e-5, "table": table });
    let free = collar().edited(|saw| {
        saw.mount = Mount::Collar {
            diameter_m: 0.12,
            in_plane: InPlane::Free,
            clamp_stiffness_n_m_per_rad_per_m: None,
        };
    });
    let kinked = scene_with(
        &free.unwrap(),
        serde_json::json!({ "temperature": temperature }),
    );
    compare(
        name,
        "table_4_6_30_k_at_60_150_200_mm_free_hz",
        &kinked,
        1e-4,
    );
}

#[test]
fn a_hot_rim_and_roll_tension_work_against_each_other() {
    let cold = at_rest_hz(&collar());
    let hot = at_rest_hz(&heated(&collar(), 10.0));
    let tensioned = at_rest_hz(&rolled(&collar(), 7e-4));
    for (n, ((cold, hot), tensioned)) in cold.iter().zip(hot).zip(tensioned).enumerate() {
        let (heating, tension) = (hot - cold, tensioned - cold);
        if n >= 2 {
            assert!(heating < 0.0 && tension > 0.0, "{n}: {heating} {tension}");
        } else {
            assert!(heating > 0.0 && tension < 0.0, "{n}: {heating} {tension}");
        }
    }
}

/// The matrices agree to the last bit, because terms that are zero are not assembled.
#[test]
fn without_heat_the_matrices_are_unchanged() {
    for base in [collar(), Scene::paper()] {
        let [plain, zero] = [base.clone(), heated(&base, 0.0)].map(|scene| {
            let range = SpeedRange::between_rpm(0.0, 2000.0);
            let plate = Plate::new(&scene, SMALL);
            let model = SpectralModel::new(plate, range, Strategy::Reduced).unwrap();
            let modes = model.modes(rad_per_s(900.0)).unwrap();
            let critical = model.critical.iter().map(|c| c.speed_rad_per_s);
            let values: Vec<f64> = critical.chain(modes.iter().map(|m| m.lambda.im)).collect();
            values
        });
        assert!(plain.len() > 20);
        assert_eq!(plain, zero);
    }
}

#[test]
fn a_buckled_blade_is_an_error_with_the_remedy() {
    let hot = heated(&collar(), 150.0);
    for message in [
        Analysis::new(&hot).map(drop).unwrap_err().to_string(),
        check(&hot, &Limits::at(100.0))
            .map(drop)
            .unwrap_err()
            .to_string(),
    ] {
        assert!(message.contains("buckles at rest"), "{message}");
        assert!(message.contains("lower the temperature"), "{message}");
    }
}

/// Every band is certified under guides, heat and tension together.
#[test]
fn the_krein_index_holds_under_membrane_stress() {
    let membrane = serde_json::json!({
        "temperature": { "expansion_per_k": 1.2e-5, "rim_rise_k": 3.0, "exponent": 1.5 },
        "roll_tension": [{ "radius_m": 0.25, "width_m": 0.03, "eigenstrain": 5e-5 }]
    });
    let stressed = scene_with(&Scene::paper(), membrane);
    let draft = stressed.edited(|saw| saw.tolerance = Some(1e-2)).unwrap();
    let plain = Analysis::new(&Scene::paper()).unwrap();
    let analysis = Analysis::new(&draft).unwrap();
    let certificate = &analysis.chart.certificate;
    assert!(certificate.speeds_checked > 20 && certificate.violations_rad_per_s.is_empty());
    let lowest = |a: &Analysis| rpm(a.model.critical[0].speed_rad_per_s);
    assert!((lowest(&analysis) - lowest(&plain)).abs() > 5.0);
}

/// The sensitivities contain the numbers of the block, with the derivative of the first critical speed that central
/// differences of whole scenes give.
#[test]
fn sensitivities_to_heat_and_tension() {
    let membrane = serde_json::json!({
        "temperature": { "expansion_per_k": 1.2e-5, "rim_rise_k": 3.0 },
        "roll_tension": [{ "radius_m": 0.25, "width_m": 0.03, "eigenstrain": 5e-5 }]
    });
    let scene = scene_with(&Scene::paper(), membrane);
    let analysis = dense_analysis(&scene, SMALL, [300.0, 2000.0], 12);
    let found = analysis.sensitivities(rad_per_s(400.0)).unwrap();
    let of_membrane: Vec<_> = found
        .iter()
        .filter(|s| s.parameter.starts_with("membrane."))
        .collect();
    assert_eq!(of_membrane.len(), 4);
    for sensitivity in of_membrane {
        let parameter = Parameter::new(&sensitivity.parameter);
        let value = parameter.get(scene.file()).unwrap();
        let change = match sensitivity.change.as_str() {
            "1 %" => 0.01 * value,
            "1 K" => 1.0,
            other => panic!("{other}"),
        };
        let lowest = |share: f64| {
            let moved = scene.file().with(&[(&parameter, value + share * change)]);
            let plate = Plate::new(&moved.unwrap(), SMALL);
            SpectralModel::critical_speeds(&plate).unwrap()[0].speed_rad_per_s
        };
        let share = 0.02;
        let difference = (lowest(share) - lowest(-share)) / (2.0 * share * lowest(0.0));
        let told = 0.01 * sensitivity.critical_speeds_percent[0];
        let error = (told - difference).abs();
        // The error of a central difference over a change of 1 % is of the order of its square.
        assert!(
            error < 1e-4 * difference.abs() && difference != 0.0,
            "{}: {} {difference}",
            sensitivity.parameter,
            told
        );
    }
}

fn spline_blade(bore: f64, rises: &[f64], shift: f64) -> Scene {
    let mut file: SceneFile = crate::common::scene("free-blade").file().clone();
    let outer = file.blade.outer_diameter_m;
    file.blade.inner_diameter_m = bore * outer;
    let radius = |k: usize| 0.5 * outer * (bore + (1.0 - bore) * k as f64 / 4.0);
    let rows: Vec<_> = rises
        .iter()
        .enumerate()
        .map(|(k, rise)| serde_json::json!({ "radius_m": radius(k), "rise_k": rise + shift }))
        .collect();
    let temperature = serde_json::json!({ "expansion_per_k": 1.2e-5, "table": rows });
    let membrane = serde_json::json!({ "temperature": temperature });
    file.membrane = Some(serde_json::from_value(membrane).unwrap());
    Scene::try_from(file).unwrap_or_else(|error| panic!("{error}"))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// On free edges a uniform rise adds no stress to any profile, and heave and tilt remain free.
    #[test]
    fn an_even_rise_changes_nothing_on_a_spline(
        bore in 0.05..0.8f64,
        rises in proptest::collection::vec(-2.0..2.0f64, 5),
        shift in -100.0..100.0f64,
    ) {
        let critical = |shift: f64| {
            let plate = Plate::new(&spline_blade(bore, &rises, shift), SMALL);
            SpectralModel::critical_speeds(&plate)
        };
        match (critical(0.0), critical(shift)) {
            (Ok(one), Ok(other)) => {
                prop_assert_eq!(one.len(), other.len());
                for (x, y) in one.iter().zip(&other).take(8) {
                    prop_assert!(relative_error(y.speed_rad_per_s, x.speed_rad_per_s) < 1e-8);
                }
            }
            (Err(SpectrumError::Buckled { .. }), Err(SpectrumError::Buckled { .. })) => (),
            other => prop_assert!(false, "{other:?}"),
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]

    /// Heat, rolling and guides in any combination give a certified chart or a clear message about buckling.
    #[test]
    fn a_drawn_saw_is_charted_or_said_to_buckle(
        rise_k in -40.0..40.0f64,
        exponent in 0.0..4.0f64,
        place in 0.1..0.9f64,
        eigenstrain in -8e-4..8e-4f64,
        guided in any::<bool>(),
    ) {
        let mut file = collar().file().clone();
        let radius = 0.06 + 0.14 * place;
        file.membrane = Some(serde_json::from_value(serde_json::json!({
            "temperature": { "expansion_per_k": 1.2e-5, "rim_rise_k": rise_k, "exponent": exponent },
            "roll_tension": [{ "radius_m": radius, "width_m": 0.01, "eigenstrain": eigenstrain }]
        })).unwrap());
        file.tolerance = Some(0.05);
        if guided {
            file.guides = crate::common::scene("two-pads").file().guides.clone();
            file.guides.truncate(1);
            file.guides[0].radius_m = 0.17;
            file.guides[0].radial_length_m = 0.03;
            file.guides[0].tangential_length_m = 0.05;
        }
        let mut scene = Scene::try_from(file).unwrap();
        // A sweep past many critical speeds has many bands and would take long.
        if let Ok(critical) = SpectralModel::critical_speeds(&Plate::new(&scene, SMALL)) {
            let swept = scene.swept(SpeedRange::new(0.0, 1.1 * critical[0].speed_rad_per_s));
            scene = swept.unwrap();
        }
        match Analysis::new(&scene) {
            Ok(analysis) => {
                prop_assert!(analysis.chart.certificate.violations_rad_per_s.is_empty());
                let limits = HeatLimits::new(&scene, &analysis.model).unwrap().unwrap();
                let buckling = limits.buckling.map_or(f64::INFINITY, |b| b.rise_k.abs());
                prop_assert!(buckling > rise_k.abs());
            }
            Err(AnalysisError::Spectrum(SpectrumError::Buckled { share, .. })) => prop_assert!(share < 1.0 + 1e-9),
            Err(other) => prop_assert!(false, "{other}"),
        }
    }
}
