//! Derivatives of eigenvalues, critical speeds and onsets against central differences
//! of whole analyses, with the numbers of the scene really moved.

use sawflutter::plate::{Plate, Resolution};
use sawflutter::scene::{Scene, SceneFile, rad_per_s};
use sawflutter::spectrum::{SpectralModel, Strategy};
use sawflutter::stability::{Analysis, chart, sensitivities};

const RESOLUTION: Resolution = Resolution {
    max_diameters: 5,
    radial_functions: 4,
};

/// On the whole basis, so that no projection differs between two scenes.
fn analysis_of(scene: &Scene) -> Analysis {
    let range = (rad_per_s(300.0), rad_per_s(2350.0));
    let plate = Plate::new(scene, RESOLUTION);
    let model = SpectralModel::new(plate, range, Strategy::Dense).unwrap();
    let chart = chart(&model, range, 40, &|_, _| ()).unwrap();
    Analysis {
        model,
        range,
        chart,
        flutter_speed: None,
        first_merge: None,
        root_loci: None,
        estimated_relative_error: None,
    }
}

fn moved(path: &str, share: f64) -> Scene {
    let mut file: SceneFile = Scene::paper().file;
    let factor = 1.0 + 0.01 * share;
    match path {
        "blade.thickness_m" => file.blade.thickness_m *= factor,
        "blade.material.density_kg_per_m3" => file.blade.material.density_kg_per_m3 *= factor,
        "blade.material.youngs_modulus_pa" => file.blade.material.youngs_modulus_pa *= factor,
        "guides[0].radius_m" => file.guides[0].radius_m *= factor,
        "guides[0].angle_deg" => file.guides[0].angle_deg += share,
        "guides[0].stiffness_n_per_m" => file.guides[0].stiffness_n_per_m *= factor,
        other => panic!("a sensitivity nobody checks: {other}"),
    }
    Scene::try_from(file).unwrap()
}

#[test]
fn sensitivities_agree_with_central_differences() {
    let at = rad_per_s(1800.0);
    let middle = analysis_of(&Scene::paper());
    let found = sensitivities(&Scene::paper(), &middle, at).unwrap();
    assert_eq!(found.len(), 6);
    assert!(
        middle.chart.instabilities.len() >= 4,
        "both kinds of onset are there"
    );
    let share = 0.01;
    // Rounding 1e-11 and truncation (1e-4)² of the differences, over a step of 2e-4.
    let tolerance = 1e-6;
    for sensitivity in &found {
        let path = sensitivity.parameter.as_str();
        let (low, high) = (
            analysis_of(&moved(path, -share)),
            analysis_of(&moved(path, share)),
        );
        let difference =
            |of: &dyn Fn(&Analysis) -> f64| (of(&high) - of(&low)) / (2.0 * share * of(&middle));
        // Of a change of 1 %, so numbers of size 0.01.
        let close = |x: f64, y: f64, what: &str| {
            assert!(
                (x - y).abs() < tolerance * 0.01_f64.max(y.abs()),
                "{path} {what}: {x} {y}"
            );
        };
        for (k, value) in sensitivity.critical_speeds.iter().enumerate() {
            let of = |a: &Analysis| a.model.critical[k].speed_rad_per_s;
            close(*value, difference(&of), "critical speed");
        }
        for (k, value) in sensitivity.onsets.iter().enumerate() {
            let of = |a: &Analysis| a.chart.instabilities[k].from;
            close(value.unwrap(), difference(&of), "onset");
        }
        for (k, value) in sensitivity.eigenvalues.iter().enumerate() {
            let of = |a: &Analysis| a.model.modes(at).unwrap()[k].lambda.im;
            close(value.im / of(&middle), difference(&of), "frequency");
        }
    }
}
