//! Pads whose force has states: films, whose force lags, and controllers.
//!
//! Source: τ df/dt + f = c dw/dt of the heave and of both tilts over the pad, and the canonical form of a controller, written down here
//! as dz/dt = Az with states of first order; the program has unknowns of second order.

use faer::{Mat, c64};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{
    GuideArmFile, GuideControllerFile, GuideFile, GuideFilmFile, Scene, rad_per_s,
};
use sawflutter::model::system::GyroscopicSystem;
use sawflutter::modes::companion_eigenpairs;

use crate::common::Worst;

const SMALL: Resolution = Resolution {
    max_diameters: 6,
    radial_functions: 4,
};

/// A usual frequency, in rad/s.
const USUAL: f64 = 1e3;

/// The built-in saw on a pad with a film.
fn saw_on(pad: GuideFile) -> Scene {
    let scene = Scene::paper().edited(|saw| saw.guides = vec![pad]);
    scene.unwrap()
}

/// The pad of the built-in saw with a film, of its own extent or a point.
fn pad(damping_n_s_per_m: f64, lag_s: f64, is_point: bool) -> GuideFile {
    let mut pad = Scene::paper().file().guides[0].clone();
    pad.damping_n_s_per_m = damping_n_s_per_m;
    pad.film = Some(GuideFilmFile { lag_s });
    if is_point {
        (pad.radial_length_m, pad.tangential_length_m) = (0.0, 0.0);
    }
    pad
}

/// Points of a pad inside the blade, with their shares of the film.
fn points(pad: &GuideFile) -> Vec<(f64, f64, f64)> {
    if pad.radial_length_m == 0.0 {
        return vec![(pad.radius_m, pad.angle_deg.to_radians(), 1.0)];
    }
    // The rule of Gauss and Legendre with eight points.
    let rule = [
        (0.183_434_642_495_649_8, 0.362_683_783_378_362),
        (0.525_532_409_916_329, 0.313_706_645_877_887_3),
        (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
        (0.960_289_856_497_536_2, 0.101_228_536_290_376_3),
    ];
    let rule: Vec<(f64, f64)> = rule
        .iter()
        .flat_map(|(x, w)| [(*x, *w), (-*x, *w)])
        .collect();
    let mut points = Vec::new();
    for (x, along) in &rule {
        for (y, across) in &rule {
            let radial = pad.radius_m + 0.5 * x * pad.radial_length_m;
            let tangential = 0.5 * y * pad.tangential_length_m;
            let angle = tangential.atan2(radial) + pad.angle_deg.to_radians();
            points.push((radial.hypot(tangential), angle, 0.25 * along * across));
        }
    }
    points
}

/// The heave and the tilts of a pad at its points, orthonormal with the shares of the points; of a point the heave alone.
fn rigid_motions(points: &[(f64, f64, f64)]) -> Vec<Vec<f64>> {
    let place =
        |(radius, angle, _): &(f64, f64, f64)| [1.0, radius * angle.cos(), radius * angle.sin()];
    let mut motions: Vec<Vec<f64>> = Vec::new();
    for coordinate in 0..if points.len() == 1 { 1 } else { 3 } {
        let mut motion: Vec<f64> = points
            .iter()
            .map(|point| place(point)[coordinate])
            .collect();
        let product = |x: &[f64], y: &[f64]| -> f64 {
            let all = x.iter().zip(y).zip(points);
            all.map(|((x, y), (_, _, share))| x * y * share).sum()
        };
        for other in &motions {
            let along = product(other, &motion);
            motion
                .iter_mut()
                .zip(other)
                .for_each(|(x, y)| *x -= along * y);
        }
        let size = product(&motion, &motion).sqrt();
        motions.push(motion.into_iter().map(|x| x / size).collect());
    }
    motions
}

/// All eigenvalues of dz/dt = Az with z of displacements, velocities and the forces of the film on the rigid motions over the pad.
fn expected(pad: &GuideFile, speed: f64) -> Vec<c64> {
    let points = points(pad);
    lagging(pad, speed, &points, &rigid_motions(&points))
}

/// The same with a force of the film at each point of the pad.
fn expected_of_points(pad: &GuideFile, speed: f64) -> Vec<c64> {
    let points = points(pad);
    let alone = |k: usize| {
        let mut motion = vec![0.0; points.len()];
        motion[k] = points[k].2.sqrt().recip();
        motion
    };
    let motions: Vec<Vec<f64>> = (0..points.len()).map(alone).collect();
    lagging(pad, speed, &points, &motions)
}

/// The same with forces of the film on motions, given at points of the pad.
fn lagging(
    pad: &GuideFile,
    speed: f64,
    points: &[(f64, f64, f64)],
    motions: &[Vec<f64>],
) -> Vec<c64> {
    let mut spring = pad.clone();
    (spring.damping_n_s_per_m, spring.film) = (0.0, None);
    let plate = Plate::new(&saw_on(spring), SMALL);
    let system = GyroscopicSystem::of_plate(&plate);
    let order = system.order();
    let (damping, film) = (pad.damping_n_s_per_m, pad.film.unwrap());
    let mut columns = vec![vec![0.0; order]; motions.len()];
    for (p, (radius, angle, share)) in points.iter().enumerate() {
        let mut functions = plate.functions_at(*radius, *angle);
        if let Some(arm) = pad.arm {
            functions[plate.radial_functions()] -= 1.0 / arm.mass_kg.sqrt();
        }
        for (column, motion) in columns.iter_mut().zip(motions) {
            for i in 0..order {
                column[i] += share * motion[p] * functions[i];
            }
        }
    }
    let size = 2 * order + columns.len();
    let mut a = Mat::<f64>::zeros(size, size);
    let (stiffness, velocity) = (system.stiffness_at(speed), system.velocity_at(speed));
    for i in 0..order {
        a[(i, order + i)] = 1.0;
        for k in 0..order {
            a[(order + i, k)] = -stiffness[(i, k)];
            a[(order + i, order + k)] = -velocity[(i, k)];
        }
        for (force, column) in (2 * order..).zip(&columns) {
            // The force over c/τ.
            a[(order + i, force)] = -column[i] * damping / film.lag_s;
            a[(force, order + i)] = column[i];
        }
    }
    for force in 2 * order..size {
        a[(force, force)] = -1.0 / film.lag_s;
    }
    balanced(&a, order, |_| 1.0).eigenvalues().unwrap()
}

/// A similar matrix: velocities over a usual frequency, states over their sizes.
fn balanced(a: &Mat<f64>, order: usize, state: impl Fn(usize) -> f64) -> Mat<f64> {
    let size = |i: usize| match i {
        i if i < order => 1.0,
        i if i < 2 * order => USUAL,
        i => state(i - 2 * order),
    };
    Mat::from_fn(a.nrows(), a.ncols(), |i, k| a[(i, k)] * size(k) / size(i))
}

/// Largest relative distance of an eigenvalue of the program up to a frequency, in rad/s, from one of the matrix A.
fn distance(pad: &GuideFile, up_to: f64) -> f64 {
    distance_from(pad, expected, up_to)
}

/// Largest relative distance of an eigenvalue of the program up to a magnitude, in rad/s, from the nearest one expected, and of one
/// expected from the nearest one of the program: the program has none that is not of the saw.
fn distance_from(
    pad: &GuideFile,
    expected: impl Fn(&GuideFile, f64) -> Vec<c64>,
    up_to: f64,
) -> f64 {
    let system = GyroscopicSystem::of_plate(&Plate::new(&saw_on(pad.clone()), SMALL));
    let mut worst = Worst::default();
    for rpm in [0.0, 900.0, 1540.0, 2300.0, 3000.0] {
        let speed = rad_per_s(rpm);
        let expected = expected(pad, speed);
        let pairs = companion_eigenpairs(&system, speed).unwrap();
        let found: Vec<c64> = pairs.iter().map(|(lambda, _)| *lambda).collect();
        for (some, others) in [(&found, &expected), (&expected, &found)] {
            // Rigid motions that nothing holds are near zero, without one value.
            let sized = some
                .iter()
                .filter(|z| z.im >= 0.0 && (1.0..up_to).contains(&z.norm()));
            for z in sized {
                let apart = others.iter().map(|value| (value - z).norm());
                let nearest = apart.fold(f64::INFINITY, f64::min);
                // Rounding of the highest frequencies reaches the lowest ones by its square root.
                worst.add(nearest / (10.0 + z.norm()), || format!("{pad:?} {rpm} {z}"));
            }
        }
    }
    assert!(worst.count > 20, "{}", worst.count);
    worst.error
}

#[test]
fn a_point_with_a_film_has_the_eigenvalues_of_a_force_of_first_order() {
    for (damping, lag_s) in [
        (50.0, 1e-4),
        (300.0, 1e-3),
        (2e4, 1e-3),
        (3e3, 0.05),
        (300.0, 1e-6),
    ] {
        let distance = distance(&pad(damping, lag_s, true), 2e3);
        println!("{damping} {lag_s} {distance:e}");
        assert!(distance < 1e-8, "{damping} {lag_s}: {distance:e}");
    }
}

#[test]
fn a_film_on_an_arm_has_the_eigenvalues_of_a_force_of_first_order() {
    let arm = GuideArmFile {
        stiffness_n_per_m: 2e6,
        mass_kg: 1.5,
        damping_n_s_per_m: 10.0,
        loss_factor: 0.0,
    };
    let on_arm = GuideFile {
        arm: Some(arm),
        ..pad(300.0, 1e-3, false)
    };
    let distance = distance(&on_arm, 2e3);
    assert!(distance < 1e-8, "{distance:e}");
}

#[test]
fn a_pad_with_a_film_has_the_eigenvalues_of_a_force_of_first_order() {
    for (damping, lag_s) in [(300.0, 1e-3), (3e3, 1e-2), (3e3, 1e-4)] {
        let distance = distance(&pad(damping, lag_s, false), 2e3);
        println!("{damping} {lag_s} {distance:e}");
        assert!(distance < 1e-8, "{damping} {lag_s}: {distance:e}");
    }
}

/// A slow film on a stiff pad damps less than one that lags at every point, by the bending of the blade within the pad, and not ten times
/// as much, as with a part that does not lag.
#[test]
fn a_slow_film_damps_no_more_than_one_that_lags_at_every_point() {
    let pad = pad(300.0, 1e-2, false);
    let [rigid, at_points] = [expected(&pad, 0.0), expected_of_points(&pad, 0.0)];
    let mut compared = 0;
    for lambda in at_points.iter().filter(|z| (200.0..500.0).contains(&z.im)) {
        let apart = |z: &&c64| (**z - lambda).norm();
        let nearest = rigid.iter().min_by(|x, y| apart(x).total_cmp(&apart(y)));
        let ratio = nearest.unwrap().re / lambda.re;
        println!("{lambda} {} {ratio}", -lambda.re / lambda.norm());
        assert!((0.1..1.0 + 1e-6).contains(&ratio), "{lambda}: {ratio}");
        compared += 1;
    }
    assert!(compared > 2);
}

/// All eigenvalues of dz/dt = Az with z of displacements, velocities and states of the controller of a point pad in controllable
/// canonical form.
fn controlled(pad: &GuideFile, speed: f64) -> Vec<c64> {
    let mut spring = pad.clone();
    spring.controller = None;
    let plate = Plate::new(&saw_on(spring), SMALL);
    let system = GyroscopicSystem::of_plate(&plate);
    let order = system.order();
    let functions = plate.functions_at(pad.radius_m, pad.angle_deg.to_radians());
    let GuideControllerFile {
        numerator,
        denominator,
    } = pad.controller.clone().unwrap();
    let states = denominator.len() - 1;
    // κ = c s + k∞ + (Σ g_j sʲ)/D(s) with a monic D.
    let lead = denominator[0];
    let monic: Vec<f64> = denominator.iter().map(|d| d / lead).collect();
    let mut rest: Vec<f64> = numerator.iter().map(|n| n / lead).collect();
    let mut quotient = Vec::new();
    while rest.len() > states {
        let factor = rest.remove(0);
        quotient.push(factor);
        for (rest, d) in rest.iter_mut().zip(&monic[1..]) {
            *rest -= factor * d;
        }
    }
    let direct = quotient.pop().unwrap_or(0.0);
    let of_velocity = quotient.pop().unwrap_or(0.0);
    rest.reverse();
    let mut a = Mat::<f64>::zeros(2 * order + states, 2 * order + states);
    let (stiffness, velocity) = (system.stiffness_at(speed), system.velocity_at(speed));
    for i in 0..order {
        a[(i, order + i)] = 1.0;
        for k in 0..order {
            let both = functions[i] * functions[k];
            a[(order + i, k)] = -stiffness[(i, k)] - direct * both;
            a[(order + i, order + k)] = -velocity[(i, k)] - of_velocity * both;
        }
        for (j, g) in rest.iter().enumerate() {
            a[(order + i, 2 * order + j)] = -functions[i] * g;
        }
        if states > 0 {
            a[(2 * order + states - 1, i)] = functions[i];
        }
    }
    for j in 0..states {
        if j + 1 < states {
            a[(2 * order + j, 2 * order + j + 1)] = 1.0;
        }
        a[(2 * order + states - 1, 2 * order + j)] = -monic[states - j];
    }
    let state = |k: usize| USUAL.powi(k as i32 - states as i32);
    balanced(&a, order, state).eigenvalues().unwrap()
}

/// Controllers of velocity, through low passes of either sign, with a resonance, with a lead, with growing poles, one that multiplies
/// the pad's stiffness, and two that integrate.
#[test]
fn a_controlled_point_has_the_eigenvalues_of_the_canonical_form() {
    let controllers: [(&[f64], &[f64]); 12] = [
        (&[200.0, 1e5], &[1.0]),
        (&[2e5], &[1e-3, 1.0]),
        (&[3e9], &[1.0, 20.0, 9e4]),
        (&[3e8], &[1.0, 0.0, 9e4]),
        (&[300.0, 1e5, 2e6], &[1e-3, 1.0]),
        (&[-1e4, 2e6, 1e9], &[1.0, -5.0, 4e4]),
        (&[1e7, 0.0, 2e12], &[1.0, 1e3, 3e5, 4e7]),
        (&[3e4], &[0.2, 1.0]),
        (&[-3e4], &[0.2, 1.0]),
        (&[2e6], &[1.0, -20.0]),
        (&[22.0, 20050.0, 5e5], &[1e-4, 1.0, 0.0]),
        (&[-5e5], &[1.0, 0.0]),
    ];
    for (numerator, denominator) in controllers {
        let controlled_pad = GuideFile {
            controller: Some(GuideControllerFile {
                numerator: numerator.to_vec(),
                denominator: denominator.to_vec(),
            }),
            film: None,
            damping_n_s_per_m: 0.0,
            stiffness_n_per_m: 1e5,
            ..pad(0.0, 1.0, true)
        };
        let distance = distance_from(&controlled_pad, controlled, 2e3);
        println!("{numerator:?} {denominator:?} {distance:e}");
        assert!(distance < 1e-8, "{numerator:?}: {distance:e}");
    }
}
