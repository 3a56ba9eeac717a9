//! The effect of bands on a run-up: each integrates its own eigenvalue.

use rayon::prelude::*;
use sawflutter::analyses::runup::runup;
use sawflutter::model::plate::Plate;
use sawflutter::model::scene::{Accuracy, RunUpFile, Scene, SideForceFile, rad_per_s};
use sawflutter::modes::LowestModes;
use sawflutter::stability::ChosenBasis;

const SPEEDS_RPM: [f64; 2] = [2540.0, 2630.0];
const DURATION_S: f64 = 1.35;

/// ∫ Σ Re λ dt over all growing modes of the full model, by the rectangle rule.
fn growth_of_all_modes(plate: &Plate) -> f64 {
    const SAMPLES: usize = 300;
    let lowest = LowestModes::new(plate);
    let at = |k: usize| {
        let share = (k as f64 + 0.5) / SAMPLES as f64;
        let rpm = SPEEDS_RPM[0] + share * (SPEEDS_RPM[1] - SPEEDS_RPM[0]);
        let modes = lowest.at(rad_per_s(rpm), 16).unwrap();
        let growths = modes.iter().map(|mode| mode.lambda.re);
        growths.filter(|growth| *growth > 1e-4).sum::<f64>()
    };
    let sum: f64 = (0..SAMPLES).into_par_iter().map(at).sum();
    sum * DURATION_S / SAMPLES as f64
}

/// The exponents of a divergence and of the flutter within its speeds add up to the integral over all growing modes:
/// neither includes the growth of the other.
#[test]
fn overlapping_bands_divide_the_growth_of_all_modes() {
    for damping_n_s_per_m in [0.0, 0.5] {
        let scene = Scene::paper()
            .edited(|saw| {
                saw.accuracy = Accuracy::Draft;
                saw.guides[0].damping_n_s_per_m = damping_n_s_per_m;
                saw.runup = Some(RunUpFile {
                    from_rpm: SPEEDS_RPM[0],
                    to_rpm: SPEEDS_RPM[1],
                    duration_s: DURATION_S,
                    stretching: false,
                });
                saw.side_force = Some(SideForceFile::of(1e-6));
            })
            .unwrap();
        let bands = runup(&scene, &|_, _| ()).unwrap().bands;
        let overlap = bands
            .windows(2)
            .any(|pair| pair[1].band.from_rpm < pair[0].band.to_rpm);
        let swept = scene.swept(scene.runup().unwrap().speeds()).unwrap();
        let chosen = ChosenBasis::new(&swept, scene.tolerance()).unwrap();
        let all = growth_of_all_modes(&chosen.saw.plate);
        let sum: f64 = bands.iter().map(|band| band.growth_exponent).sum();
        assert!(overlap, "{bands:?}");
        assert!((sum / all - 1.0).abs() < 0.01, "{sum} {all}");
    }
}
