//! Sweeps of the paper's saw, compared with critical speeds and energies.

use super::*;
use crate::scene::Accuracy;

fn draft() -> Scene {
    Scene::paper()
        .edited(|saw| saw.accuracy = Accuracy::Draft)
        .unwrap()
}

/// Without a force the blade is exactly flat up to its first critical speed and deflects beyond it; for
/// falling speed it returns to the flat equilibrium there.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn without_a_force_the_blade_deflects_from_its_first_critical_speed_on() {
    let options = Options {
        force_n: Some(0.0),
        to_rpm: Some(1600.0),
        ..Options::default()
    };
    let found = Deflecting::new(&draft(), &options).unwrap();
    let critical = found.analysis.model.critical[0].speed_rad_per_s;
    for sweep in [&found.up, &found.down] {
        assert!(sweep.readings().all(|at| at.negative_eigenvalues == 0));
        let flat = |at: &Reading| at.largest_m < 1e-9;
        assert!(sweep.jumps.is_empty() && sweep.arcs.len() == 1, "{sweep:?}");
        let leaned = sweep.readings().filter(|at| !flat(at));
        let edge = leaned.map(|at| at.speed_rad_per_s).min_by(f64::total_cmp);
        let edge = edge.unwrap();
        assert!((edge / critical - 1.0).abs() < 1e-4, "{edge} {critical}");
        let below = sweep
            .readings()
            .filter(|at| at.speed_rad_per_s < 0.999 * critical);
        assert!(below.clone().count() > 3 && below.clone().all(flat));
        let above = sweep
            .readings()
            .filter(|at| at.speed_rad_per_s > 1.001 * critical);
        assert!(above.clone().count() > 3 && !above.clone().any(flat));
    }
}

/// Small forces deflect a slow blade as in the linear model: K(Ω)⁻¹f at the probe.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn a_small_force_deflects_a_slow_blade_as_the_linear_model_says() {
    use faer::linalg::solvers::Solve;
    let options = Options {
        force_n: Some(1e-3),
        angle_deg: Some(90.0),
        to_rpm: Some(1000.0),
    };
    let found = Deflecting::new(&draft(), &options).unwrap();
    let plate = &found.analysis.model.plate;
    let system = crate::system::GyroscopicSystem::of_plate(plate);
    let values = plate.functions_at(plate.blade.outer_radius_m, 90_f64.to_radians());
    let place = Col::from_fn(values.len(), |i| values[i]);
    for at in found.up.readings() {
        let answer = system
            .stiffness_at(at.speed_rad_per_s)
            .partial_piv_lu()
            .solve(&place);
        let linear = 1e-3 * (place.transpose() * answer);
        let error = at.deflection_m / linear - 1.0;
        assert!(error.abs() < 1e-6, "{}: {error:e}", at.speed_rad_per_s);
    }
}

#[test]
fn forces_angles_and_speeds_out_of_range_and_a_free_blade_are_refused() {
    let asked = |force_n, angle_deg, to_rpm| {
        let options = Options {
            force_n,
            angle_deg,
            to_rpm,
        };
        options.checked(&draft()).unwrap_err().to_string()
    };
    let force = asked(Some(f64::NAN), None, None);
    assert!(force.contains("force_n"), "{force}");
    let angle = asked(None, Some(1e5), None);
    assert!(angle.contains("angle_deg"), "{angle}");
    let speed = asked(None, None, Some(-3.0));
    assert!(speed.contains("to_rpm"), "{speed}");
    let free = draft().edited(|saw| saw.guides.clear()).unwrap();
    let free = Deflecting::new(&free, &Options::default());
    let said = free.unwrap_err().to_string();
    assert!(said.contains("guide"), "{said}");
}

/// The curve on the other side of the paper's first pitchfork is found at `draft` too: starting from many
/// deflections, the blade reaches equilibria on known curves.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn every_equilibrium_that_the_blade_reaches_is_on_a_curve() {
    let options = Options {
        to_rpm: Some(2200.0),
        ..Options::default()
    };
    let found = Deflecting::new(&draft(), &options).unwrap();
    let speed = rad_per_s(2000.0);
    let plate = &found.analysis.model.plate;
    let blade = found.force.on(plate, rad_per_s(2200.0), MODES).unwrap();
    let probe = found.scene.probe();
    let mut seen = Vec::new();
    for k in 0..12 {
        let angle = std::f64::consts::TAU * f64::from(k) / 12.0;
        let pushed = (plate.blade.outer_radius_m, angle);
        let pushed = blade.clone().pressed(200.0, pushed).unwrap();
        let begun = pushed.settled(speed, &blade.flat()).unwrap();
        let rest = blade.settled(speed, &begun.coordinates).unwrap();
        let deflection_m = blade.deflection_m(&rest, probe.radius_m, probe.angle_rad);
        let on_curve = |pair: &[Reading]| {
            let [from, to] = [pair[0].speed_rad_per_s, pair[1].speed_rad_per_s];
            let share = (speed - from) / (to - from);
            let between =
                pair[0].deflection_m + share * (pair[1].deflection_m - pair[0].deflection_m);
            (0.0..=1.0).contains(&share) && (between - deflection_m).abs() < 2e-4
        };
        let curves = found.curves.iter();
        assert!(
            curves.flat_map(|c| c.readings.windows(2)).any(on_curve),
            "{k}: {deflection_m}"
        );
        if !seen.iter().any(|w: &f64| (w - deflection_m).abs() < 1e-5) {
            seen.push(deflection_m);
        }
    }
    assert!(seen.len() > 1, "{seen:?}");
}

/// At the edge of a band two eigenvalues are equal, and Newton's method for one of them does not converge: the other
/// bands keep their amplitudes, and this one says that it has none.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn an_amplitude_that_does_not_converge_leaves_the_others() {
    let mut analysis = Analysis::new(&draft()).unwrap();
    let whole = saturations(&analysis).unwrap();
    let flutters = |found: &Rise| matches!(found, Ok(Some(_)));
    let place = whole.iter().position(flutters).unwrap();
    let band = &mut analysis.chart.instabilities[place];
    (band.peak_rad_per_s, band.peak_growth_per_s) = (band.from_rad_per_s, 0.0);
    let found = saturations(&analysis).unwrap();
    assert!(found[place].is_err(), "{:?}", found[place]);
    for (k, (one, other)) in whole.iter().zip(&found).enumerate() {
        let equal = one.as_ref().ok() == other.as_ref().ok();
        assert_eq!(equal, k != place, "{one:?} {other:?}");
    }
    let mut report = analysis.report();
    report.add_amplitudes(&analysis).unwrap();
    let entry = &report.instabilities[place];
    assert_eq!(entry.saturated_amplitude_m, None);
    assert!(entry.amplitude_not_computed.is_some());
    let summary = report.summary();
    assert!(summary.contains("not computed"), "{summary}");
    let limits = crate::analyses::check::Limits {
        max_amplitude_m: Some(1.0),
        ..crate::analyses::check::Limits::at(rad_per_s(1000.0))
    };
    let criterion = limits.of_amplitude(&analysis, &found).unwrap();
    assert!(criterion.finding.contains("not computed"), "{criterion:?}");
}

/// The force that the refusal allows is accepted.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn a_force_that_deflects_the_blade_beyond_the_model_is_refused() {
    let at = |force_n: f64| {
        let options = Options {
            force_n: Some(force_n),
            to_rpm: Some(300.0),
            ..Options::default()
        };
        Deflecting::new(&draft(), &options)
    };
    for force_n in [1e6, -1e4] {
        let Err(DeflectError::Refused(refused)) = at(force_n) else {
            panic!("{force_n}");
        };
        assert_eq!(refused.key, "force_n");
        let allowed: f64 = refused.allowed.split(' ').nth(3).unwrap().parse().unwrap();
        assert!(allowed < force_n.abs(), "{refused}");
        let found = at(allowed.copysign(force_n)).unwrap();
        assert_eq!(found.up.valid_until_rad_per_s, None, "{refused}");
        assert!(found.up.readings().all(|at| at.largest_slope > 0.0));
    }
}
