//! Equilibria compared with critical speeds, closed forms of one shape, and Morse's count.

use faer::{Col, Mat, Scale};

use super::*;
use crate::model::plate::Resolution;
use crate::model::scene::{Polar, Scene, SpeedRange, rad_per_s};
use crate::model::system::GyroscopicSystem;
use crate::modes::SpectralModel;
use crate::motion::transient::{Force, Integrator, Newmark, State};

const RESOLUTION: Resolution = Resolution {
    max_diameters: 8,
    radial_functions: 5,
};

pub(super) fn paper() -> Plate {
    Plate::new(&Scene::paper(), RESOLUTION)
}

/// The critical speeds of the full model, and those of thirty of its 85 shapes.
#[test]
fn pitchforks_are_at_the_critical_speeds() {
    let plate = paper();
    let blade = StretchedBlade::new(&plate, 30).unwrap();
    let critical = SpectralModel::critical_speeds(&plate).unwrap();
    let pitchforks = blade.pitchforks().unwrap();
    for (critical, (speed, _)) in critical.iter().zip(&pitchforks).take(4) {
        let error = speed / critical.speed_rad_per_s - 1.0;
        // The Rayleigh–Ritz method never gives lower values.
        assert!((-1e-9..2e-3).contains(&error), "{error:e}");
    }
}

/// Along the flat blade every pitchfork is a bifurcation, and there are no others.
#[test]
fn the_curve_of_the_flat_blade_has_every_pitchfork() {
    let blade = StretchedBlade::new(&paper(), 16).unwrap();
    let start = blade.equilibrium(rad_per_s(1000.0), None).unwrap();
    assert_eq!(start.negative_eigenvalues, 0);
    let range = SpeedRange::between_rpm(900.0, 2400.0);
    let flat = blade.branch(&start, true, range, Extent::Whole).unwrap();
    let speeds = blade.pitchforks().unwrap().into_iter().map(|p| p.0);
    let expected: Vec<f64> = speeds.filter(|speed| *speed < range.to_rad_per_s).collect();
    assert_eq!(flat.turns.len(), expected.len());
    assert!(expected.len() >= 4);
    for (index, (turn, speed)) in flat.turns.iter().zip(&expected).enumerate() {
        assert_eq!(turn.kind, TurnKind::Bifurcation);
        assert_eq!(turn.equilibrium.negative_eigenvalues, index);
        let found = turn.equilibrium.speed_rad_per_s;
        assert!((found / speed - 1.0).abs() < 1e-7, "{found} {speed}");
    }
    let last = flat.equilibria.last().unwrap();
    assert_eq!(last.speed_rad_per_s, range.to_rad_per_s);
    assert_eq!(last.coordinates.norm_l2(), 0.0);
}

/// The curve that branches at the first pitchfork leads down to the flat blade at the critical speed, and up
/// again on the other side.
#[test]
fn the_leaned_blade_comes_back_to_the_flat_one_at_the_critical_speed() {
    let blade = StretchedBlade::new(&paper(), 16).unwrap();
    let (critical, shape) = blade.pitchforks().unwrap().swap_remove(0);
    let leaned = blade.leaned(1.004 * critical, &shape).unwrap();
    assert_eq!(leaned.negative_eigenvalues, 0);
    let range = SpeedRange::new(0.99 * critical, 1.004 * critical);
    let curve = blade.branch(&leaned, false, range, Extent::Whole).unwrap();
    let turn = &curve.turns[0];
    assert_eq!((curve.turns.len(), turn.kind), (1, TurnKind::Bifurcation));
    let error = turn.equilibrium.speed_rad_per_s / critical - 1.0;
    assert!(error.abs() < 1e-6, "{error:e}");
    let end = &curve.equilibria.last().unwrap().coordinates;
    let mirrored = (end + &leaned.coordinates).norm_l2() / end.norm_l2();
    assert!(mirrored < 1e-6, "{mirrored:e}");
}

/// Near the pitchfork ε² = −vᵀKv/4U₄(v), and the stiffness of the shape about the deflected equilibrium is
/// twice the magnitude of that about the flat one: ω² about the first is twice −ω² = λ² about the second.
#[test]
fn near_a_pitchfork_lean_and_frequency_follow_the_normal_form() {
    let blade = StretchedBlade::new(&paper(), 16).unwrap();
    let (critical, shape) = blade.pitchforks().unwrap().swap_remove(0);
    let error = |excess: f64| {
        let speed = critical * (1.0 + excess);
        let leaned = blade.leaned(speed, &shape).unwrap();
        let held = shape.transpose() * blade.system.stiffness_at(speed) * &shape;
        let square = -held / (4.0 * blade.stretching.energy_j(&shape).unwrap());
        let lean = leaned.coordinates.squared_norm_l2() / square - 1.0;
        let flat = blade.equilibrium(speed, None).unwrap();
        assert_eq!(
            (flat.negative_eigenvalues, leaned.negative_eigenvalues),
            (1, 0)
        );
        let growing = blade
            .small_motions(&flat)
            .unwrap()
            .iter()
            .map(|lambda| lambda.re)
            .fold(0.0, f64::max);
        let swinging = blade.small_motions(&leaned).unwrap()[0];
        assert!(swinging.re.abs() < 1e-6 * swinging.im, "{swinging}");
        [lean, swinging.im.powi(2) / (2.0 * growing.powi(2)) - 1.0]
    };
    let (near, nearer) = (error(1e-4), error(1e-5));
    for (near, nearer) in near.iter().zip(nearer) {
        assert!(
            near.abs() < 0.05 && nearer.abs() < 0.2 * near.abs(),
            "{near:e} {nearer:e}"
        );
    }
}

/// V grows without bound in every direction, so that Σ(−1)^(negative eigenvalues) over all equilibria is one
/// (Morse): one flat equilibrium below the bands, the flat one and a deflected pair in the first band, and
/// another pair above it.
#[test]
fn equilibria_are_as_many_as_morse_counts() {
    let blade = StretchedBlade::new(&paper(), 16).unwrap();
    let pitchforks = blade.pitchforks().unwrap();
    let parity = |e: &Equilibrium| {
        if e.negative_eigenvalues.is_multiple_of(2) {
            1
        } else {
            -1
        }
    };
    let (first, second) = (&pitchforks[0], &pitchforks[1]);
    let within = 0.5 * (first.0 + second.0);
    let past = second.0 * 1.0005;
    for (speed, shapes) in [(0.9 * first.0, 0), (within, 1), (past, 2)] {
        let flat = blade.equilibrium(speed, None).unwrap();
        assert_eq!(flat.negative_eigenvalues, shapes);
        let mut sum = parity(&flat);
        for (critical, shape) in &pitchforks[..shapes] {
            // The curve starts near the pitchfork.
            let near = blade.leaned(critical * 1.0001, shape).unwrap();
            let curve = blade
                .branch(
                    &near,
                    true,
                    SpeedRange::new(near.speed_rad_per_s, speed),
                    Extent::Whole,
                )
                .unwrap();
            let end = curve.equilibria.last().unwrap();
            assert_eq!(end.speed_rad_per_s, speed);
            sum += 2 * parity(end);
        }
        assert_eq!(sum, 1, "{speed}");
    }
}

/// The blade on the shape of its first pitchfork alone, under a side force; the critical speed of this shape, and γ
/// of its equilibria κ(Ω)p + γp³ = f.
fn one_shape() -> (StretchedBlade, f64, f64) {
    let plate = paper().conservative();
    let several = StretchedBlade::new(&plate, 16).unwrap();
    let (critical, shape) = several.pitchforks().unwrap().swap_remove(0);
    let lifted = several.shapes() * &shape;
    let one = Mat::from_fn(lifted.nrows(), 1, |i, _| lifted[i]);
    let blade = StretchedBlade::on(plate.clone(), &GyroscopicSystem::of_plate(&plate), one)
        .unwrap()
        .pressed(2.0, Polar::new(0.355, 0.4))
        .unwrap();
    let gamma = 4.0 * blade.stretching.energy_j(&unit()).unwrap();
    (blade, critical, gamma)
}

/// The coordinate 1 of a single shape.
fn unit() -> Col<f64> {
    Col::from_fn(1, |_| 1.0)
}

/// One shape under a side force: the curve on the side opposite to the force turns back where κ = −3(γf²/4)^⅓.
#[test]
fn a_side_force_unfolds_the_pitchfork_as_the_cubic_says() {
    let (blade, critical, gamma) = one_shape();
    let force = blade.force[0];
    let stiffness = |speed: f64| blade.system.stiffness_at(speed)[(0, 0)];
    let most = 2.0 * critical;
    let against = -force.signum() * (-stiffness(most) / gamma).sqrt();
    let start = blade
        .equilibrium(most, Some(&(Scale(against) * unit())))
        .unwrap();
    let curve = blade
        .branch(&start, false, SpeedRange::new(0.0, most), Extent::Whole)
        .unwrap();
    assert_eq!(curve.turns.len(), 1);
    let turn = &curve.turns[0];
    assert_eq!(turn.kind, TurnKind::Fold);
    let expected = -3.0 * (gamma * force * force / 4.0).cbrt();
    let found = stiffness(turn.equilibrium.speed_rad_per_s);
    assert!((found / expected - 1.0).abs() < 1e-6, "{found} {expected}");
    // From rest the blade deflects in the direction of the force, further with every speed, without a fold.
    let rest = blade.equilibrium(0.0, None).unwrap();
    let pressed = blade
        .branch(&rest, true, SpeedRange::new(0.0, most), Extent::Whole)
        .unwrap();
    assert!(pressed.turns.is_empty());
    let at_rim = |e: &Equilibrium| blade.deflection_m(e, 0.355, 0.4);
    let rises = pressed.equilibria.windows(2);
    assert!(
        rises
            .into_iter()
            .all(|pair| at_rim(&pair[1]) > at_rim(&pair[0]))
    );
    let end = pressed.equilibria.last().unwrap();
    let p = end.coordinates[0];
    let rest = stiffness(most) * p + gamma * p.powi(3) - force;
    assert!(rest.abs() < 1e-8 * force.abs(), "{rest:e}");
}

/// One shape under a side force: a blade that is deflected against the force jumps, for falling speed, where
/// κ = −3(γf²/4)^⅓, to the equilibrium that it would have reached with rising speed.
#[test]
fn a_sweep_jumps_where_the_cubic_folds() {
    let (blade, critical, gamma) = one_shape();
    let force = blade.force[0];
    let most = 2.0 * critical;
    let range = SpeedRange::new(0.0, most);
    let up = blade.sweep(&blade.flat(), true, range).unwrap();
    assert!(up.ends.is_empty());
    let high = -blade.system.stiffness_at(most)[(0, 0)];
    let against = Scale(-force.signum() * (high / gamma).sqrt()) * unit();
    let down = blade.sweep(&against, false, range).unwrap();
    assert_eq!((down.arcs.len(), down.ends.len()), (2, 1));
    let fold = &down.ends[0];
    assert_eq!(fold.kind, TurnKind::Fold);
    let found = blade.system.stiffness_at(fold.equilibrium.speed_rad_per_s)[(0, 0)];
    let expected = -3.0 * (gamma * force * force / 4.0).cbrt();
    assert!((found / expected - 1.0).abs() < 1e-6, "{found} {expected}");
    let landed = &down.arcs[1][0];
    let p = landed.coordinates[0];
    let rest = blade.system.stiffness_at(landed.speed_rad_per_s)[(0, 0)] * p + gamma * p.powi(3);
    assert!((rest / force - 1.0).abs() < 1e-6, "{rest} {force}");
    assert!(p * force > 0.0);
}

/// One shape without a force: p² = −κ/γ past the pitchfork, which the blade leaves and reaches without a jump.
#[test]
fn a_sweep_does_not_jump_at_a_pitchfork() {
    let (blade, critical, gamma) = one_shape();
    let blade = blade.unforced();
    let range = SpeedRange::new(0.0, 2.0 * critical);
    let up = blade.sweep(&blade.flat(), true, range).unwrap();
    let top = up.arcs[0].last().unwrap().coordinates.clone();
    let down = blade.sweep(&top, false, range).unwrap();
    for sweep in [up, down] {
        assert_eq!((sweep.arcs.len(), sweep.ends.len()), (1, 0), "{sweep:?}");
        assert_eq!(sweep.stopped_rad_per_s, None);
        for at in &sweep.arcs[0] {
            let softness = -blade.system.stiffness_at(at.speed_rad_per_s)[(0, 0)];
            let expected = (softness.max(0.0) / gamma).sqrt();
            let off = (at.coordinates[0].abs() - expected).abs();
            // The root amplifies the error of the speed of the pitchfork.
            assert!(off < 1e-3 * blade.size(), "{off:e} of {expected:e}");
        }
    }
}

/// One shape far beyond its critical speed, where it deflects by hundreds of thicknesses in steps of a fiftieth.
#[test]
fn a_sweep_says_where_its_number_of_equilibria_ends_it() {
    let (blade, critical, _) = one_shape();
    let range = SpeedRange::new(0.0, 500.0 * critical);
    let up = blade.sweep(&blade.flat(), true, range).unwrap();
    let last = up.arcs.last().unwrap().last().unwrap().speed_rad_per_s;
    assert!(last < range.to_rad_per_s);
    assert_eq!(up.stopped_rad_per_s, Some(last));
}

/// Damping fixed in space only dissipates energy (Thomson, Tait & Chetaev): from a flat blade under a force,
/// within a band and between bands, where without damping gyroscopic forces stabilize it, H decreases at
/// every step.
#[test]
fn damping_in_space_only_takes_energy() {
    let blade = StretchedBlade::new(&paper(), 12)
        .unwrap()
        .pressed(0.5, Polar::new(0.355, 0.4))
        .unwrap();
    let pitchforks = blade.clone().unforced().pitchforks().unwrap();
    let between = 0.5 * (pitchforks[1].0 + pitchforks[2].0);
    let within = 0.5 * (pitchforks[0].0 + pitchforks[1].0);
    for speed in [within, between] {
        let mut damped = blade.system.clone();
        damped.damping = Some(Scale(20.0) * Mat::<f64>::identity(12, 12));
        let loads = [blade.force.clone()];
        let forces: [&dyn Force; 1] = [&blade.stretching];
        let newmark = Newmark::new(&damped, (speed, 0.0), &loads, 2e-3).with_forces(&forces);
        let mut state = State::rest(12);
        let total = |state: &State| {
            let potential = blade.potential_j(&state.displacement, speed).unwrap();
            0.5 * state.velocity.squared_norm_l2() + potential
        };
        let mut energy = total(&state);
        for _ in 0..5000 {
            state = newmark.step(&state, [&[1.0], &[1.0]]).unwrap();
            let next = total(&state);
            let scale = blade.stretching.energy_j(&state.displacement).unwrap();
            assert!(next <= energy + 1e-9 * scale, "{next:e} {energy:e}");
            energy = next;
        }
        // The motion began at rest, undeflected, with zero energy.
        assert!(energy < 0.0, "{energy:e}");
        // The equilibrium without inertia has the same or a lower energy.
        let settled = blade.settled(speed, &state.displacement).unwrap();
        assert_eq!(settled.negative_eigenvalues, 0);
        let lowest = blade.potential_j(&settled.coordinates, speed).unwrap();
        assert!(lowest <= energy, "{lowest:e} {energy:e}");
    }
}

/// The slope equals central differences of the deflection at the evaluated points.
#[test]
fn the_largest_slope_is_that_of_the_deflection() {
    let blade = StretchedBlade::new(&paper(), 12)
        .unwrap()
        .pressed(40.0, Polar::new(0.355, 1.1))
        .unwrap();
    let bent = blade.equilibrium(rad_per_s(800.0), None).unwrap();
    let step = 1e-5;
    let mut largest = 0.0_f64;
    for radius_m in blade.plate.sampled_radii_m() {
        for angle in (0..72).map(|k| std::f64::consts::TAU * f64::from(k) / 72.0) {
            let w = |r: f64, t: f64| blade.deflection_m(&bent, r, t);
            let radial = w(radius_m + step, angle) - w(radius_m - step, angle);
            let hoop = w(radius_m, angle + step) - w(radius_m, angle - step);
            largest = largest.max(radial.hypot(hoop / radius_m) / (2.0 * step));
        }
    }
    let found = blade.slopes().largest(&bent.coordinates);
    assert!((found / largest - 1.0).abs() < 1e-6, "{found} {largest}");
}

/// A collar without guides: the blade is flat at any speed, and its deflected equilibria have no direction
/// unless a force defines it.
#[test]
fn a_deflection_without_a_direction_is_refused() {
    let collar = Scene::paper().edited(|saw| {
        saw.guides.clear();
        saw.cut = None;
        saw.mount = crate::model::scene::Mount::Collar {
            diameter_m: 0.24,
            in_plane: crate::model::scene::InPlane::Free,
            clamp_stiffness_n_m_per_rad_per_m: None,
        };
    });
    let blade = StretchedBlade::new(&Plate::new(&collar.unwrap(), RESOLUTION), 12).unwrap();
    let (critical, shape) = blade.pitchforks().unwrap().swap_remove(0);
    assert_eq!(
        blade
            .equilibrium(1.1 * critical, None)
            .unwrap()
            .negative_eigenvalues,
        2
    );
    let leaned = blade.leaned(1.01 * critical, &shape);
    assert!(matches!(leaned, Err(StretchedError::Axisymmetric)));
    let pressed = blade.pressed(5.0, Polar::new(0.355, 0.3)).unwrap();
    let rest = pressed.equilibrium(0.0, None).unwrap();
    let curve = pressed
        .branch(
            &rest,
            true,
            SpeedRange::new(0.0, 1.1 * critical),
            Extent::Whole,
        )
        .unwrap();
    assert!(curve.turns.is_empty());
    let end = curve.equilibria.last().unwrap();
    // The blade is deflected in the direction of the force, and the equilibrium is a minimum.
    assert!(end.negative_eigenvalues == 0 && pressed.deflection_m(end, 0.355, 0.3) > 0.0);
}

#[test]
fn unrestrained_blades_and_other_ranges_are_refused() {
    let free = Scene::paper().edited(|saw| saw.guides.clear()).unwrap();
    let unheld = StretchedBlade::new(&Plate::new(&free, RESOLUTION), 8);
    assert!(matches!(unheld, Err(StretchedError::NotHeld)));
    let none = StretchedBlade::new(&paper(), 0);
    assert!(matches!(none, Err(StretchedError::Shapes { given: 0, .. })));
    let blade = StretchedBlade::new(&paper(), 4).unwrap();
    assert!(blade.equilibrium(f64::NAN, None).is_err());
    let start = blade.equilibrium(10.0, None).unwrap();
    assert!(
        blade
            .branch(&start, true, SpeedRange::new(20.0, 30.0), Extent::Whole)
            .is_err()
    );
    assert!(
        blade
            .branch(&start, true, SpeedRange::new(10.0, 10.0), Extent::Whole)
            .is_err()
    );
    let (critical, shape) = blade.pitchforks().unwrap().swap_remove(0);
    let below = blade.leaned(0.9 * critical, &shape);
    assert!(matches!(below, Err(StretchedError::NotFound { .. })));
    assert!(blade.pressed(f64::INFINITY, Polar::new(0.3, 0.0)).is_err());
}

/// At every fold and bifurcation of the curves of a saw on six equal pads, whose symmetries are many, the forces balance and ∂²V/∂p² is
/// singular: its smallest eigenvalue is one of rounding beside those a step away.
#[test]
fn turns_are_equilibria_at_which_the_stiffness_is_singular() {
    let scene = Scene::paper().edited(|file| {
        let pad = file.guides[0].clone();
        file.guides = (0..6)
            .map(|k| {
                let mut pad = pad.clone();
                pad.angle_deg = -150.0 + 60.0 * f64::from(k);
                (pad.radius_m, pad.stiffness_n_per_m) = (0.25, 1e7);
                (pad.radial_length_m, pad.tangential_length_m) = (0.06, 0.06);
                pad
            })
            .collect();
    });
    let plate = Plate::new(&scene.unwrap(), RESOLUTION);
    let range = SpeedRange::between_rpm(0.0, 6100.0);
    let place = Polar::new(plate.blade.outer_radius_m, 0.0);
    let blade = StretchedBlade::up_to(&plate, range.to_rad_per_s, place, 16).unwrap();
    let blade = blade.pressed(1.0, place).unwrap();
    let unforced = blade.clone().unforced();
    let mut turns = 0;
    for (critical, shape) in unforced.pitchforks().unwrap().into_iter().take(6) {
        let above = critical * 1.004;
        if !range.contains(above) {
            continue;
        }
        let near = unforced.leaned_near(above, &shape).unwrap();
        let Ok(start) = blade.equilibrium(above, Some(&near)) else {
            continue;
        };
        let curve = blade.branch(&start, true, range, Extent::Drawn).unwrap();
        for turn in &curve.turns {
            let Equilibrium {
                coordinates,
                speed_rad_per_s,
                ..
            } = &turn.equilibrium;
            let values = blade.stiffnesses(coordinates, *speed_rad_per_s).unwrap();
            let smallest = values.iter().map(|x| x.abs()).fold(f64::INFINITY, f64::min);
            let change = speed_rad_per_s.powi(2);
            assert!(
                smallest < 1e-5 * change,
                "{:?} at {speed_rad_per_s}: {smallest:e} {change:e}",
                turn.kind
            );
            let rest = blade.residual(coordinates, *speed_rad_per_s).unwrap();
            let elastic = blade.system.stiffness_at(*speed_rad_per_s) * coordinates;
            assert!(rest.norm_l2() < 1e-5 * elastic.norm_l2().max(blade.force.norm_l2()));
            turns += 1;
        }
    }
    assert!(turns > 2, "{turns}");
}
