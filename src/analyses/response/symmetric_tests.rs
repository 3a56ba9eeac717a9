//! Steady states of a blade without guides, compared with a blade at rest in its own frame.

use faer::Mat;
use faer::linalg::solvers::Solve;

use super::tests::{clamped_free_blade, plate, scene};
use super::*;
use crate::model::scene::{DampingFile, ResponseFile, SideForceFile, SweepFile};

/// A blade between collars without guides, with every excitation; `order` is that of the oscillating force.
fn collared(order: u32, edit: impl FnOnce(&mut crate::model::scene::SceneFile)) -> Scene {
    let force = SideForceFile {
        oscillating_n: 1.0,
        order: Some(order),
        ..SideForceFile::of(1.0)
    };
    let turning = ResponseFile {
        runout_m: 1e-4,
        flatness_m: 1e-4,
        imbalance_kg_m2: 1e-6,
    };
    scene(force, turning, |saw| {
        clamped_free_blade(saw);
        saw.sweep = Some(SweepFile {
            from_rpm: 0.0,
            to_rpm: 3000.0,
        });
        edit(saw);
    })
}

/// Independent value: in its own frame the waves of n diameters of a symmetric blade have the stiffness K_b + Ω²K_σ and no gyroscopic
/// term, and a force of the order k in space has the frequencies (k ± n)Ω there. It is in resonance where
/// (K_b + Ω²K_σ) z = Ω²(k ± n)² z, up to frequencies far above those of the diagram.
#[test]
fn a_symmetric_blade_resonates_where_its_waves_do_in_its_own_frame() {
    for order in [0, 1, 42] {
        let scene = collared(order.max(1), |_| ());
        let report = response(&scene, &Options::default()).unwrap();
        let plate = plate(&scene);
        let mut expected = Vec::new();
        for (n, block) in plate.harmonics.iter().enumerate() {
            let rest = block.body_frame_stiffness(0.0);
            let spin = block.body_frame_stiffness(1.0) - &rest;
            let lower = rest.llt(faer::Side::Lower).unwrap().L().to_owned();
            let inverse = lower
                .partial_piv_lu()
                .solve(Mat::<f64>::identity(rest.nrows(), rest.nrows()));
            let waves = if n == 0 { 1 } else { 2 };
            for sign in [1.0, -1.0].into_iter().take(waves) {
                let ratio = f64::from(order) + sign * n as f64;
                let inertia = Mat::<f64>::identity(rest.nrows(), rest.nrows());
                let inertia = faer::Scale(ratio * ratio) * inertia - &spin;
                let inertia = &inverse * inertia * inverse.transpose();
                let values = inertia.self_adjoint_eigenvalues(faer::Side::Lower).unwrap();
                let speeds = values
                    .into_iter()
                    .filter(|x| *x > 0.0)
                    .map(|x| rpm(x.powf(-0.5)));
                expected.extend(speeds.filter(|speed| *speed <= 3000.0));
            }
        }
        expected.sort_by(f64::total_cmp);
        // Without rotation of the force both waves of n diameters have one critical speed.
        expected.dedup_by(|a, b| (*a / *b - 1.0).abs() < 1e-7);
        let mut lines = report.lines.iter();
        let line = lines.rfind(|line| line.order == order).unwrap();
        let found: Vec<f64> = line.resonances.iter().map(|at| at.rpm).collect();
        assert_eq!(
            found.len(),
            expected.len(),
            "{order}: {found:?} {expected:?}"
        );
        assert_eq!(found.len() > 30, order == 42, "{found:?}");
        for (found, expected) in found.iter().zip(&expected) {
            assert!(
                (found / expected - 1.0).abs() < 1e-7,
                "{order}: {found} {expected}"
            );
        }
        assert!(
            line.resonances
                .iter()
                .all(|at| at.steady_state == SteadyState::Unbounded)
        );
    }
}

/// A load that turns with a symmetric blade does not work on a wave of another number of diameters, and its own wave turns with it, so
/// that it has no resonance. At rest an imbalance has no load.
#[test]
fn a_load_that_turns_with_a_symmetric_blade_has_no_resonance() {
    let air = |saw: &mut crate::model::scene::SceneFile| {
        saw.damping = Some(DampingFile {
            air_n_s_per_m3: 3.0,
            ..DampingFile::default()
        });
    };
    let unsymmetric = |saw: &mut crate::model::scene::SceneFile| {
        saw.guides = vec![Scene::paper().file().guides[0].clone()];
    };
    let of = |edit: &dyn Fn(&mut crate::model::scene::SceneFile)| {
        response(&collared(3, edit), &Options::default()).unwrap()
    };
    for report in [of(&|_| ()), of(&air)] {
        let turning = report
            .lines
            .iter()
            .filter(|line| line.order < 3 && line.order > 0);
        for line in turning {
            assert!(
                line.resonances.is_empty(),
                "{} {:?}",
                line.name,
                line.resonances
            );
            let is_imbalance = line.cause == Cause::Imbalance;
            assert_eq!(
                line.amplitude_m[0] == Some(0.0),
                is_imbalance,
                "{}",
                line.name
            );
        }
    }
    // A pad turns past the blade, so that every wave is excited.
    let report = of(&unsymmetric);
    assert!(report.lines.iter().all(|line| !line.resonances.is_empty()));
}
