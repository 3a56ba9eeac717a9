//! Sweeps of the paper's saw, compared with critical speeds and energies.

use faer::Col;

use super::equilibria::{MODES, under};
use super::*;
use crate::model::plate::Plate;
use crate::model::scene::{Accuracy, Polar, SideForceFile, SpeedRange, rad_per_s};
use crate::motion::stretched_blade::{Equilibrium, ForcedPlate};
use crate::stability::ChosenBasis;

/// The paper's saw under a side force.
fn pressed(force: SideForceFile) -> Scene {
    let saw = draft().edited(|saw| saw.side_force = Some(force));
    saw.unwrap()
}

fn draft() -> Scene {
    Scene::paper()
        .edited(|saw| saw.accuracy = Accuracy::Draft)
        .unwrap()
}

/// The blade on the basis that `deflect` chooses for speeds up to `to_rpm`.
fn plate(to_rpm: f64) -> Plate {
    let swept = draft().swept(SpeedRange::between_rpm(0.0, to_rpm)).unwrap();
    let chosen = ChosenBasis::new(&swept, swept.tolerance());
    chosen.unwrap().saw.plate
}

/// Without a force the blade is exactly flat up to its first critical speed and deflects beyond it; for
/// falling speed it returns to the flat equilibrium there.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn without_a_force_the_blade_deflects_from_its_first_critical_speed_on() {
    let options = Options {
        to_rpm: Some(1600.0),
    };
    let saw = pressed(SideForceFile::of(0.0));
    let found = Equilibria::new(&saw, &options, &saw.side_force()).unwrap();
    let critical = found.analysis.model.critical[0].speed_rad_per_s;
    let sites = found.blade.sites();
    for sweep in [&found.up, &found.down] {
        assert!(sweep.ends.is_empty() && sweep.arcs.len() == 1, "{sweep:?}");
        let arc = || sweep.arcs[0].iter();
        assert!(arc().all(|e| e.negative_eigenvalues == 0));
        let flat = |e: &Equilibrium| sites.largest_m(&e.coordinates) < 1e-9;
        let leaned = arc().filter(|e| !flat(e));
        let edge = leaned
            .map(|e| e.speed_rad_per_s)
            .min_by(f64::total_cmp)
            .unwrap();
        assert!((edge / critical - 1.0).abs() < 1e-4, "{edge} {critical}");
        let below = arc().filter(|e| e.speed_rad_per_s < 0.999 * critical);
        assert!(below.clone().count() > 3 && below.clone().all(flat));
        let above = arc().filter(|e| e.speed_rad_per_s > 1.001 * critical);
        assert!(above.clone().count() > 3 && !above.clone().any(flat));
    }
}

/// Small forces deflect a slow blade as in the linear model: K(Ω)⁻¹f at the probe.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn a_small_force_deflects_a_slow_blade_as_the_linear_model_says() {
    use faer::linalg::solvers::Solve;
    let options = Options {
        to_rpm: Some(1000.0),
    };
    let force = SideForceFile {
        angle_deg: Some(90.0),
        ..SideForceFile::of(1e-3)
    };
    let report = deflect(&pressed(force), &options).unwrap();
    let plate = plate(1000.0);
    let system = crate::model::system::GyroscopicSystem::of_plate(&plate);
    let values = plate.functions_at(plate.blade.outer_radius_m, 90_f64.to_radians());
    let place = Col::from_fn(values.len(), |i| values[i]);
    for arc in &report.up.arcs {
        for (rpm, deflection_m) in arc.rpm.iter().zip(&arc.deflection_m) {
            let stiffness = system.stiffness_at(rad_per_s(*rpm));
            let answer = stiffness.partial_piv_lu().solve(&place);
            let linear = 1e-3 * (place.transpose() * answer);
            let error = deflection_m / linear - 1.0;
            assert!(error.abs() < 1e-6, "{rpm}: {error:e}");
        }
    }
}

#[test]
fn a_speed_out_of_range_and_a_free_blade_are_refused() {
    let options = Options { to_rpm: Some(-3.0) };
    assert_eq!(options.checked().unwrap_err().key, "to_rpm");
    let free = draft().edited(|saw| saw.guides.clear()).unwrap();
    let free = deflect(&free, &Options::default());
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
    };
    let report = deflect(&draft(), &options).unwrap();
    let speed = rad_per_s(2000.0);
    let plate = plate(2200.0);
    let force = draft().side_force();
    let forced = ForcedPlate::new(&plate, rad_per_s(2200.0), &[(force.at.polar(), 1.0)]).unwrap();
    let blade = under(&force, &forced, MODES).unwrap();
    let probe = draft().probe();
    let mut seen = Vec::new();
    for k in 0..12 {
        let angle = std::f64::consts::TAU * f64::from(k) / 12.0;
        let pushed = Polar::new(plate.blade.outer_radius_m, angle);
        let pushed = blade.clone().pressed(200.0, pushed).unwrap();
        let begun = pushed.settled(speed, &blade.flat()).unwrap();
        let rest = blade.settled(speed, &begun.coordinates).unwrap();
        let deflection_m = blade.deflection_m(&rest, probe.radius_m, probe.angle_deg.to_radians());
        let is_on = |curve: &EquilibriumCurve| {
            let mut pairs = curve.rpm.windows(2).zip(curve.deflection_m.windows(2));
            pairs.any(|(rpm, m)| {
                let share = (2000.0 - rpm[0]) / (rpm[1] - rpm[0]);
                let between = m[0] + share * (m[1] - m[0]);
                (0.0..=1.0).contains(&share) && (between - deflection_m).abs() < 2e-4
            })
        };
        assert!(report.curves.iter().any(is_on), "{k}: {deflection_m}");
        if !seen.iter().any(|w: &f64| (w - deflection_m).abs() < 1e-5) {
            seen.push(deflection_m);
        }
    }
    assert!(seen.len() > 1, "{seen:?}");
}

/// The force that the refusal allows is accepted.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn a_force_that_deflects_the_blade_beyond_the_model_is_refused() {
    let at = |force_n: f64| {
        let options = Options {
            to_rpm: Some(300.0),
        };
        deflect(&pressed(SideForceFile::of(force_n)), &options)
    };
    for force_n in [1e6, -1e4] {
        let Err(DeflectError::Refused(refused)) = at(force_n) else {
            panic!("{force_n}");
        };
        assert_eq!(refused.key, "side_force.force_n");
        let allowed: f64 = refused.allowed.split(' ').nth(3).unwrap().parse().unwrap();
        assert!(allowed < force_n.abs(), "{refused}");
        let found = at(allowed.copysign(force_n)).unwrap();
        assert_eq!(found.up.valid_until_rpm, None, "{refused}");
        let mut slopes = found.up.arcs.iter().flat_map(|arc| &arc.largest_slope);
        assert!(slopes.all(|slope| *slope > 0.0));
    }
}
