//! Modes of a saw with a loss factor and measured damping ratios.

use std::f64::consts::TAU;

use super::Analysis;
use crate::model::plate::{Plate, Resolution};
use crate::model::scene::{
    Accuracy, DampingFile, InPlane, ModeRatioRow, Mount, Scene, SceneFile, SpeedRange, SweepFile,
    rad_per_s,
};
use crate::modes::{SpectralModel, Strategy};

fn ratios() -> DampingFile {
    DampingFile {
        loss_factor: 0.004,
        mode_ratios: vec![ModeRatioRow {
            diameters: 3,
            damping_ratio: 0.005,
        }],
        ..DampingFile::default()
    }
}

fn scene(edit: impl FnOnce(&mut SceneFile)) -> Scene {
    let scene = Scene::paper().edited(|saw| {
        saw.accuracy = Accuracy::Draft;
        (saw.measured, saw.cut, saw.spline) = (None, None, None);
        saw.damping = Some(ratios());
        edit(saw);
    });
    scene.unwrap()
}

fn collar(saw: &mut SceneFile) {
    saw.guides.clear();
    saw.mount = Mount::Collar {
        diameter_m: 0.25,
        in_plane: InPlane::Free,
        clamp_stiffness_n_m_per_rad_per_m: None,
    };
    saw.sweep = Some(SweepFile {
        from_rpm: 0.0,
        to_rpm: 2000.0,
    });
}

/// Independent value: λ² + 2ζωλ + ω² has |λ| = ω and the damping ratio ζ, half the loss factor or the
/// measured ratio.
#[test]
fn modes_at_rest_have_the_ratio_that_was_given() {
    let analysis = Analysis::new(&scene(collar)).unwrap();
    assert!(analysis.modes_at_rest.len() >= 6);
    for mode in &analysis.modes_at_rest {
        let expected = if mode.name.diameters == 3 {
            0.005
        } else {
            0.002
        };
        let ratio = mode.mode.damping_ratio().unwrap();
        assert!(
            (ratio / expected - 1.0).abs() < 1e-6,
            "{:?}: {ratio}",
            mode.name
        );
    }
}

/// Independent value: in the frame of the blade a wave with n diameters obeys μ² + C_i μ + K_b + Ω²K_σ = 0,
/// whose decay rate follows by first-order perturbation; in space λ = μ ± inΩ.
#[test]
fn turning_waves_decay_as_in_the_frame_of_the_blade() {
    let scene = scene(collar);
    let plate = Plate::new(&scene, Resolution::of(Accuracy::Draft));
    let speed = rad_per_s(1500.0);
    let model =
        SpectralModel::new(plate.clone(), SpeedRange::new(0.0, speed), Strategy::Dense).unwrap();
    let modes = model.all_modes(speed).unwrap();
    for n in 2..=3 {
        let block = &plate.harmonics[n];
        let eigen = block
            .body_frame_stiffness(speed)
            .self_adjoint_eigen(faer::Side::Lower)
            .unwrap();
        let (omega, shape) = (eigen.S()[0].sqrt(), eigen.U().col(0).to_owned());
        let damping = block.material_damping.as_ref().unwrap();
        let size = shape.nrows();
        let pairs = (0..size).flat_map(|j| (0..size).map(move |k| (j, k)));
        let rate: f64 = pairs
            .map(|(j, k)| shape[j] * damping[(j, k)] * shape[k])
            .sum();
        for direction in [-1.0, 1.0] {
            let in_space = omega + direction * n as f64 * speed;
            let near =
                |lambda: &&faer::c64| (lambda.im.abs() - in_space.abs()).abs() < 1e-3 * omega;
            let lambda = modes.iter().map(|mode| &mode.lambda).find(near);
            let found = lambda.unwrap_or_else(|| panic!("{n}: {} Hz", in_space / TAU));
            assert!(
                (found.re / (-0.5 * rate) - 1.0).abs() < 1e-3,
                "{n}: {found} {rate}"
            );
        }
    }
}

/// The certificate counts the modes of a guided saw with this damping too. Without guides nothing grows,
/// because in the frame of the blade every wave loses energy.
#[test]
fn the_certificate_counts_a_saw_with_a_loss_factor() {
    let analysis = Analysis::new(&scene(|_| ())).unwrap();
    let report = analysis.report();
    assert!(report.certificate.is_clean(), "{:?}", report.certificate);
    assert!(
        report
            .terms
            .iter()
            .any(|term| term.contains("material damping"))
    );
    let reflected = Analysis::new(&scene(|saw| {
        collar(saw);
        saw.sweep = Some(SweepFile {
            from_rpm: 0.0,
            to_rpm: 4000.0,
        });
    }))
    .unwrap();
    // Dissipation that turns with a free blade never makes it unstable.
    assert!(reflected.first_critical_rpm().unwrap() < 4000.0);
    assert!(reflected.bands().is_empty(), "{:?}", reflected.bands());
}
