//! A guide pad on an arm: the head is one more unknown, and changes the modes as closed forms say.
//!
//! Sources: springs in series; the motion of a rigid disk and of its heads, written down here; a weakly coupled oscillator; and the
//! eigenvalues of matrices that this test assembles, with the head as the last unknown.

use faer::{Mat, c64};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{GuideArmFile, GuideFile, Scene, SpeedRange, rad_per_s};
use sawflutter::model::system::GyroscopicSystem;
use sawflutter::modes::{SpectralModel, companion_eigenpairs};
use sawflutter::stability::{Analysis, InstabilityKind};

use super::saws::collar;
use crate::common::{Worst, assert_close};

const SMALL: Resolution = Resolution {
    max_diameters: 6,
    radial_functions: 4,
};

fn arm(stiffness_n_per_m: f64, mass_kg: f64) -> GuideArmFile {
    GuideArmFile {
        stiffness_n_per_m,
        mass_kg,
        damping_n_s_per_m: 0.0,
        loss_factor: 0.0,
    }
}

fn point(radius_m: f64, angle_deg: f64, stiffness_n_per_m: f64, arm: GuideArmFile) -> GuideFile {
    GuideFile {
        radius_m,
        angle_deg,
        stiffness_n_per_m,
        arm: Some(arm),
        ..GuideFile::default()
    }
}

/// The built-in saw on other guides.
fn saw_on(guides: Vec<GuideFile>) -> Scene {
    let scene = Scene::paper().edited(|saw| saw.guides = guides);
    scene.unwrap()
}

/// Eigenvalues with Im λ ≥ 0, by frequency.
fn eigenvalues(system: &GyroscopicSystem, speed_rad_per_s: f64) -> Vec<c64> {
    let pairs = companion_eigenpairs(system, speed_rad_per_s).unwrap();
    let mut values: Vec<c64> = pairs.into_iter().map(|(lambda, _)| lambda).collect();
    values.sort_by(|x, y| x.im.total_cmp(&y.im).then(x.re.total_cmp(&y.re)));
    values
}

/// The system of a blade on point pads, assembled from the matrices of the blade alone, in which the heads are the last unknowns and
/// have their displacement as coordinate.
fn assembled(scene: &Scene, guides: &[GuideFile]) -> GyroscopicSystem {
    let blade = scene.edited(|saw| saw.guides.clear()).unwrap();
    let plate = Plate::new(&blade, SMALL);
    let own = GyroscopicSystem::of_plate(&plate);
    let (blade_order, order) = (own.order(), own.order() + guides.len());
    let larger = |matrix: &Mat<f64>| {
        let mut larger = Mat::zeros(order, order);
        larger
            .submatrix_mut(0, 0, blade_order, blade_order)
            .copy_from(matrix);
        larger
    };
    let mut stiffness = larger(&own.stiffness);
    let mut damping = Mat::zeros(order, order);
    for (guide, head) in guides.iter().zip(blade_order..) {
        let arm = guide.arm.unwrap();
        let mut stretch = plate.functions_at(guide.radius_m, guide.angle_deg.to_radians());
        stretch.resize(order, 0.0);
        stretch[head] = -1.0;
        // The head has the mass m, all other unknowns the mass 1.
        let per_mass = |i: usize| if i == head { 1.0 / arm.mass_kg } else { 1.0 };
        for i in 0..order {
            for k in 0..order {
                let both = stretch[i] * stretch[k] * per_mass(i);
                stiffness[(i, k)] += guide.stiffness_n_per_m * both;
                damping[(i, k)] += guide.damping_n_s_per_m * both;
            }
        }
        stiffness[(head, head)] += arm.stiffness_n_per_m / arm.mass_kg;
        let of_arm = (arm.stiffness_n_per_m * arm.mass_kg).sqrt() * arm.loss_factor;
        damping[(head, head)] += (arm.damping_n_s_per_m + of_arm) / arm.mass_kg;
    }
    GyroscopicSystem {
        stiffness,
        spin: larger(&own.spin),
        gyroscopic: larger(&own.gyroscopic),
        damping: Some(damping),
        circulatory: None,
        nonconservative: None,
        free_rigid: Vec::new(),
        drift: None,
    }
}

/// Heads of very different masses, with and without damping.
fn various_guides() -> Vec<GuideFile> {
    let first = arm(3e6, 4.0);
    let mut second = arm(2e5, 0.3);
    second.damping_n_s_per_m = 40.0;
    let mut third = arm(8e6, 25.0);
    third.loss_factor = 0.04;
    let mut pads = vec![
        point(0.25, -55.0, 1e7, first),
        point(0.31, 70.0, 4e5, second),
        point(0.2, 160.0, 2e6, third),
    ];
    pads[2].damping_n_s_per_m = 300.0;
    pads
}

#[test]
fn the_matrices_are_those_with_the_head_as_one_more_unknown() {
    let guides = various_guides();
    let saw = saw_on(guides.clone());
    let plate = Plate::new(&saw, SMALL);
    let found = GyroscopicSystem::of_plate(&plate);
    let expected = assembled(&saw, &guides);
    assert_eq!(found.order(), expected.order());
    let mut worst = Worst::default();
    for rpm in [0.0, 700.0, 1540.0, 2300.0, 3000.0] {
        let [found, expected] = [&found, &expected].map(|s| eigenvalues(s, rad_per_s(rpm)));
        for expected in &expected {
            let nearest = found.iter().map(|value| (value - expected).norm());
            let nearest = nearest.fold(f64::INFINITY, f64::min);
            worst.add(nearest / (1.0 + expected.norm()), || {
                format!("{rpm} {expected}")
            });
        }
    }
    // Rounding of the highest frequencies reaches the lowest ones by its square root.
    worst.assert_at_most("eigenvalues", 1e-6);
}

/// At λ = 0 the mass has no force: critical speeds and deflection are those of the springs in series, for a point with
/// 1/(1/k + 1/k_a).
#[test]
fn critical_speeds_are_those_of_springs_in_series() {
    let (pad, of_arm) = (4e6, 1.5e6);
    let critical = |guide: GuideFile| -> Vec<f64> {
        let plate = Plate::new(&saw_on(vec![guide]), SMALL);
        let found = SpectralModel::critical_speeds(&plate).unwrap();
        found.iter().map(|c| c.speed_rad_per_s).collect()
    };
    let heavy = critical(point(0.25, -55.0, pad, arm(of_arm, 7.0)));
    let massless = critical(point(0.25, -55.0, pad, arm(of_arm, 0.0)));
    let mut in_series = point(0.25, -55.0, pad * of_arm / (pad + of_arm), arm(1.0, 0.0));
    in_series.arm = None;
    let series = critical(in_series);
    assert!(series.len() > 4);
    assert_eq!([heavy.len(), massless.len()], [series.len(); 2]);
    for ((heavy, massless), series) in heavy.iter().zip(&massless).zip(&series) {
        assert_close("with mass", *heavy, *series, 1e-8);
        assert_close("without mass", *massless, *series, 1e-8);
    }
    // A pad of some extent: with mass and without it the same.
    let mut wide = Scene::paper().file().guides[0].clone();
    wide.arm = Some(arm(of_arm, 7.0));
    let heavy = critical(wide.clone());
    wide.arm = Some(arm(of_arm, 0.0));
    for (heavy, massless) in heavy.iter().zip(critical(wide)) {
        assert_close("a pad of some extent", *heavy, massless, 1e-8);
    }
}

/// A rigid disk on three equal points with heads: κ(ω) = k (k_a − mω²)/(k + k_a − mω²) replaces k. Heave: Mω² = 3κ. Tilt, with the
/// moment of inertia I about a diameter: Iω² ± 2IΩω = 3κr²/2 in a frame fixed in space, because a thin disk has the polar moment 2I.
#[test]
fn a_rigid_disk_on_arms_moves_as_the_closed_form_says() {
    let (radius_m, k, held) = (0.3, 2e2, arm(5e2, 1.5));
    let pads = [0.0, 120.0, 240.0].map(|angle| point(radius_m, angle, k, held));
    let saw = Scene::paper().edited(|saw| {
        saw.guides = pads.to_vec();
        saw.blade.material.youngs_modulus_pa = 1e13;
        saw.blade.thickness_m = 0.04;
        saw.blade.rim = None;
        saw.blade.profile.clear();
    });
    let saw = saw.unwrap();
    let blade = saw.blade();
    let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
    let per_area = blade.mass_per_area_kg_per_m2();
    let mass = per_area * std::f64::consts::PI * (b * b - a * a);
    let inertia = per_area * std::f64::consts::PI * (b.powi(4) - a.powi(4)) / 4.0;
    let system = GyroscopicSystem::of_plate(&Plate::new(&saw, SMALL));
    let mut worst = Worst::default();
    for rpm in [0.0, 40.0, 180.0] {
        let speed = rad_per_s(rpm);
        let rigid: Vec<f64> = eigenvalues(&system, speed)
            .into_iter()
            .map(|value| value.im)
            .filter(|omega| *omega < 1e4)
            .collect();
        // Two of heave, and four of tilt: forward and backward, with and against the heads.
        assert_eq!(rigid.len(), 6, "{rigid:?}");
        for omega in &rigid {
            // The equations times k + k_a − mω², which is near zero where mostly the heads move.
            let equation = |omega: f64, inertia: f64, turning: f64, stiffness: f64| {
                let of_head = held.stiffness_n_per_m - held.mass_kg * omega * omega;
                inertia * (omega * omega + turning * omega) * (k + of_head) - stiffness * of_head
            };
            // Distance of the nearest root, by a step of Newton's method.
            let apart = |inertia: f64, turning: f64, stiffness: f64| {
                let at = |omega: f64| equation(omega, inertia, turning, stiffness);
                let h = 1e-4 * omega;
                // Rounding of the fastest mode, of 1e7 rad/s, limits the slowest one.
                (at(*omega) * 2.0 * h / (at(omega + h) - at(omega - h))).abs() / (omega + 5.0)
            };
            let heave = apart(mass, 0.0, 3.0 * k);
            let tilts = [2.0 * speed, -2.0 * speed]
                .map(|turning| apart(inertia, turning, 1.5 * k * radius_m * radius_m));
            let share = tilts.into_iter().fold(heave, f64::min);
            worst.add(share, || format!("{rpm} rpm, {omega} rad/s"));
        }
    }
    worst.assert_at_most("frequencies", 5e-6);
}

/// A head whose frequency, with the pad, is that of a mode of the blade with the pad, and which the pad couples weakly: the modes have
/// ω² ± kφ/√m, exact for two oscillators.
#[test]
fn a_tuned_head_splits_a_mode() {
    let (k, mass_kg) = (100.0, 0.5);
    let on_frame = |arm: Option<GuideArmFile>| {
        let guide = GuideFile {
            radius_m: 0.18,
            stiffness_n_per_m: k,
            arm,
            ..GuideFile::default()
        };
        let saw = collar().edited(|saw| saw.guides = vec![guide]).unwrap();
        Plate::new(&saw, SMALL)
    };
    // The lowest symmetric mode of the blade at rest on the pad, with its deflection at the pad.
    let plate = on_frame(None);
    let pairs = companion_eigenpairs(&GyroscopicSystem::of_plate(&plate), 0.0).unwrap();
    let functions = plate.functions_at(0.18, 0.0);
    let modes = pairs.into_iter().map(|(lambda, q)| {
        let at_pad: c64 = q.iter().zip(&functions).map(|(q, f)| q * *f).sum();
        (lambda.im, at_pad.norm() / q.norm_l2())
    });
    let deflecting = modes.filter(|(_, at_pad)| *at_pad > 1e-3);
    let (omega, at_pad) = deflecting.min_by(|x, y| x.0.total_cmp(&y.0)).unwrap();
    let tuned = arm(mass_kg * omega * omega - k, mass_kg);
    let system = GyroscopicSystem::of_plate(&on_frame(Some(tuned)));
    let near = |value: &c64| (value.im / omega - 1.0).abs() < 5e-3;
    let squares: Vec<f64> = eigenvalues(&system, 0.0)
        .into_iter()
        .filter(near)
        .map(|value| value.im * value.im)
        .collect();
    let [below, above] = [squares[0], squares[squares.len() - 1]];
    let split = 2.0 * k * at_pad / mass_kg.sqrt();
    assert_close("splitting", above - below, split, 1e-3);
}

/// Iwan and Moeller, J. Appl. Mech. 43 (1976): a stationary spring or mass makes a rotating disk unstable only above its first critical
/// speed.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn an_arm_without_damping_is_stable_below_the_first_critical_speed() {
    let range = SpeedRange::between_rpm(0.0, 3000.0);
    let first = |held: Option<GuideArmFile>| {
        let mut guide = Scene::paper().file().guides[0].clone();
        guide.arm = held;
        let saw = saw_on(vec![guide]).swept(range).unwrap();
        let analysis = Analysis::new(&saw).unwrap();
        let critical = analysis.model.critical[0].speed_rad_per_s;
        let bands = analysis.chart.instabilities;
        let onset = bands.iter().map(|band| band.from_rad_per_s);
        let flutter = bands
            .iter()
            .filter(|band| band.kind == InstabilityKind::Flutter);
        (
            critical,
            onset.fold(f64::INFINITY, f64::min),
            flutter.count(),
        )
    };
    for held in [None, Some(arm(5e4, 0.5)), Some(arm(5e4, 20.0))] {
        let (critical, onset, flutter) = first(held);
        println!("{held:?} {critical} {onset} {flutter}");
        assert!(
            onset >= critical * (1.0 - 1e-9),
            "{held:?}: {onset} {critical}"
        );
        assert!(flutter > 0);
    }
}

/// Iwan and Moeller, J. Appl. Mech. 43 (1976): each element of a stationary load has its own signature. From a critical speed on a spring
/// makes the wave that stands still diverge, and a damper makes it grow as long as it is reflected; a mass has no force there. Where a
/// reflected wave meets another, a spring raises both frequencies in space and a mass lowers them: the band of flutter lies above the
/// speed at which they would cross, or below it.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn spring_damper_and_mass_have_their_signatures() {
    let rpm = |speed_rad_per_s: f64| sawflutter::model::scene::rpm(speed_rad_per_s);
    let bands = |guide: GuideFile, kind: InstabilityKind| -> Vec<[f64; 2]> {
        let saw = collar().edited(|saw| {
            saw.guides = vec![guide];
            (saw.cut, saw.runup, saw.sweep) = (None, None, None);
        });
        let saw = saw.unwrap();
        let saw = saw.swept(SpeedRange::between_rpm(0.0, 5500.0)).unwrap();
        let found = Analysis::new(&saw).unwrap().chart.instabilities;
        let own = found.iter().filter(|band| band.kind == kind);
        own.map(|band| [rpm(band.from_rad_per_s), rpm(band.to_rad_per_s)])
            .filter(|[from, to]| to - from > 1e-6 * to)
            .collect()
    };
    let free = collar().edited(|saw| saw.guides.clear()).unwrap();
    let plate = Plate::new(
        &free,
        Resolution {
            max_diameters: 12,
            radial_functions: 8,
        },
    );
    let critical: Vec<f64> = SpectralModel::critical_speeds(&plate)
        .unwrap()
        .iter()
        .map(|c| rpm(c.speed_rad_per_s))
        .filter(|rpm| *rpm < 5200.0)
        .collect();
    assert_eq!(critical.len(), 4);
    let at = GuideFile {
        radius_m: 0.18,
        ..GuideFile::default()
    };
    let spring = || GuideFile {
        stiffness_n_per_m: 500.0,
        ..at.clone()
    };
    let damper = GuideFile {
        damping_n_s_per_m: 1.0,
        ..at.clone()
    };
    let mass = GuideFile {
        stiffness_n_per_m: 1e8,
        arm: Some(arm(1e-6, 0.05)),
        ..at.clone()
    };
    let diverging = bands(spring(), InstabilityKind::Divergence);
    let [on_spring, on_damper, on_mass] =
        [spring(), damper, mass.clone()].map(|guide| bands(guide, InstabilityKind::Flutter));
    assert!(bands(mass, InstabilityKind::Divergence).is_empty());
    for critical in critical.iter().step_by(2) {
        let begins = |bands: &[[f64; 2]]| {
            bands
                .iter()
                .any(|band| (band[0] / critical - 1.0).abs() < 3e-4)
        };
        assert!(
            begins(&diverging) && begins(&on_damper),
            "{critical}: {diverging:?} {on_damper:?}"
        );
        assert!(
            !begins(&on_spring) && !begins(&on_mass),
            "{critical}: {on_spring:?} {on_mass:?}"
        );
    }
    assert!(
        on_spring.len() == 3 && on_mass.len() == 3,
        "{on_spring:?} {on_mass:?}"
    );
    for (above, below) in on_spring.iter().zip(&on_mass) {
        // The crossing is at the beginning of one and at the end of the other.
        assert!(
            (below[1] / above[0] - 1.0).abs() < 5e-4,
            "{below:?} {above:?}"
        );
        assert!(
            below[0] < above[0] && below[1] < above[1],
            "{below:?} {above:?}"
        );
    }
}

/// A rigid blade on a pad that is partly beside it pushes the head as far as it moves itself: only what is on the blade couples both.
#[test]
fn a_pad_partly_beside_the_blade_has_no_spring_to_the_frame() {
    for mass_kg in [0.0, 3.0] {
        let mut guide = Scene::paper().file().guides[0].clone();
        guide.radius_m = 0.345;
        guide.arm = Some(arm(1.0, mass_kg));
        let system = GyroscopicSystem::of_plate(&Plate::new(&saw_on(vec![guide]), SMALL));
        // Heave of the built-in blade is the first function, its head the first unknown after those of n = 0.
        let mut heave = vec![0.0; system.order()];
        let blade = *Scene::paper().blade();
        let area =
            std::f64::consts::PI * (blade.outer_radius_m.powi(2) - blade.inner_radius_m.powi(2));
        heave[0] = (blade.mass_per_area_kg_per_m2() * area).sqrt();
        if mass_kg > 0.0 {
            heave[SMALL.radial_functions] = mass_kg.sqrt();
        }
        let mut energy = 0.0;
        for (i, x) in heave.iter().enumerate() {
            energy += heave
                .iter()
                .enumerate()
                .map(|(k, y)| x * y * system.stiffness[(i, k)])
                .sum::<f64>();
        }
        // The arm of 1 N/m alone is bent.
        assert_close("stiffness in heave", energy, 1.0, 1e-4);
    }
}
