//! Limits of the method: the program warns of unreliable numbers, and refuses problems that would not fit into memory.

use sawflutter::model::evenly_spaced;
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{Accuracy, Scene, SceneFile, SpeedRange, rpm};
use sawflutter::modes::branches::{CampbellError, sample};
use sawflutter::modes::{SpectralModel, Strategy};
use sawflutter::stability::Analysis;

use crate::common::{relative_error, says};
use crate::guides::bed;
use crate::saws::{SMALL, critical, paper, scene, unguided};

/// A stiff pad bends the blade at its edges, which any basis represents slowly: the error that a report estimates must
/// not be smaller than the distance to a finer basis.
#[test]
fn where_the_basis_is_too_coarse_the_estimate_says_so() {
    // From 1e12 N/m on, which is rigid for any blade, the extrapolation is a quarter too small: it was calibrated up to
    // 1e9.
    for stiffness in [1e3, 1e6, 1e9] {
        let mut file = paper();
        file.guides[0].stiffness_n_per_m = stiffness;
        file.accuracy = Accuracy::Draft;
        let analysis = Analysis::new(&scene(&file)).unwrap();
        let estimated = analysis.estimated_relative_error.unwrap();
        let chosen = analysis.model.critical.iter().map(|c| c.speed_rad_per_s);
        let finer = critical(
            &file,
            Resolution {
                max_diameters: 38,
                radial_functions: 13,
            },
        );
        // The estimate is that of the critical speeds within the sweep.
        let errors = chosen.zip(&finer);
        let within =
            errors.take_while(|(speed, _)| *speed <= analysis.range_rad_per_s.to_rad_per_s);
        let error = within.fold(0.0_f64, |top, (x, y)| top.max(relative_error(x, *y)));
        assert!(error > 0.0);
        println!("{stiffness:e} N/m: draft is off by {error:.1e}, says {estimated:.1e}");
        assert!(error <= estimated, "{stiffness:e}: {error:e} {estimated:e}");
    }
}

/// The report warns of unreliable numbers instead of printing many digits.
#[test]
fn loss_of_digits_by_rounding_is_warned_of() {
    let warned = |change: &dyn Fn(&mut SceneFile)| {
        let mut file = unguided();
        file.accuracy = Accuracy::Draft;
        change(&mut file);
        let scene = scene(&file);
        let analysis = Analysis::new(&scene).unwrap();
        let report = analysis.report();
        let warning = report.warnings.iter().find(|w| w.contains("six digits"));
        warning.cloned()
    };
    // The paper's saw needs no such warning.
    assert_eq!(warned(&|file| file.guides = paper().guides), None);
    let ring = warned(&|file| {
        file.blade.inner_diameter_m = 0.995 * file.blade.outer_diameter_m;
        file.blade.thickness_m = 1e-4;
    });
    // A narrow ring without contact needs no warning: its waves are a symmetric problem.
    assert_eq!(ring, None);
    // The frequency of heave is 0.0005 Hz, and that of bending 1000 Hz.
    let softly_held = warned(&|file| file.guides = vec![bed(1e-3)]);
    assert!(softly_held.is_some());
}

/// Scenes and charts that would need too much memory are refused with the number.
#[test]
fn problems_too_large_for_memory_are_refused_with_the_number() {
    let mut file = paper();
    file.guides = vec![file.guides[0].clone(); 257];
    let message = Scene::try_from(file).unwrap_err().to_string();
    assert!(
        says(&message, "guides must be … (you gave 257)") && message.contains("256"),
        "{message}"
    );
    let plate = Plate::new(&scene(&unguided()), SMALL);
    let range = SpeedRange::between_rpm(0.0, 1000.0);
    let model = SpectralModel::new(plate, range, Strategy::Reduced).unwrap();
    let of_sweep = match sample(&model, &evenly_spaced(range.ends(), 10_000_000), &|_, _| ()) {
        Err(error @ CampbellError::TooLarge { .. }) => error.to_string(),
        other => panic!("{:?}", other.map(|samples| samples.len())),
    };
    assert!(of_sweep.contains("more than 1024 MiB"), "{of_sweep}");
}

/// The error for a sweep whose chart would not fit states where the sweep may end: at a critical speed, because each
/// has speeds of the chart next to it, here sixty.
#[test]
fn the_error_for_too_large_a_chart_states_where_its_sweep_may_end() {
    let plate = Plate::new(&scene(&paper()), SMALL);
    let range = SpeedRange::between_rpm(0.0, 3000.0);
    let model = SpectralModel::new(plate.clone(), range, Strategy::Reduced).unwrap();
    let refusal = |speeds: Vec<f64>| match sample(&model, &speeds, &|_, _| ()) {
        Err(error) => error,
        Ok(_) => panic!("{} speeds fit", speeds.len()),
    };
    let hopeless = refusal(evenly_spaced(range.ends(), 10_000_000));
    let CampbellError::TooLarge { needed_mb, .. } = &hopeless else {
        panic!("{hopeless}");
    };
    assert!(
        !hopeless.to_string().contains("end the sweep"),
        "{hopeless}"
    );
    let most = 1024.0 * 1e7 / *needed_mb as f64;
    let events = SpectralModel::critical_speeds(&plate).unwrap();
    let critical = events.iter().map(|c| c.speed_rad_per_s);
    let within: Vec<f64> = critical
        .filter(|speed| *speed < range.to_rad_per_s)
        .collect();
    let sides = (-30..=30)
        .filter(|k| *k != 0)
        .map(|k| 1.0 + 1e-5 * f64::from(k));
    let beside = within
        .iter()
        .flat_map(|c| sides.clone().map(move |side| c * side));
    // All speeds that fit are even, except a hundred.
    let even = evenly_spaced(range.ends(), most as usize - 100);
    let mut speeds: Vec<f64> = even.into_iter().chain(beside).collect();
    speeds.sort_by(f64::total_cmp);
    let message = refusal(speeds).to_string();
    // The speeds beside the first two critical speeds would fit, those beside the third would not.
    let (_, named) = message.split_once("end the sweep at ").expect(&message);
    let end: f64 = named.split_once(" rpm").unwrap().0.parse().unwrap();
    assert!(
        rpm(within[0]) < end && end < rpm(within[1]),
        "{within:?}: {message}"
    );
}
