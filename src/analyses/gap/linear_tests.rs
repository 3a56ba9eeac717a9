//! Deflections within the gap and far beyond it, compared with those of linear guides, and the balance of forces.

use super::*;
use crate::model::scene::{ContactLaw, Polar, Scene};
use crate::motion::stretched_blade::PressedBlade;

/// Three saws whose guides lift off, for small deflections: one pad, two pads with unlike gaps, and a collar with a pad.
fn saws(film_stiffness_n_per_m: f64, offset_m: f64) -> [Scene; 3] {
    let pad = |angle_deg: f64, gap_m: f64| crate::model::scene::GuideFile {
        angle_deg,
        contact: ContactLaw::OneSided,
        gap_m: Some(gap_m),
        film_stiffness_n_per_m,
        ..Scene::paper().file().guides[0].clone()
    };
    let of = |guides: Vec<crate::model::scene::GuideFile>, is_clamped: bool| {
        let scene = Scene::paper().edited(|file| {
            (file.cut, file.guides) = (None, guides);
            if is_clamped {
                file.mount = crate::model::scene::Mount::Collar {
                    diameter_m: 0.25,
                    in_plane: crate::model::scene::InPlane::Free,
                    clamp_stiffness_n_m_per_rad_per_m: None,
                };
            }
        });
        scene.unwrap()
    };
    let shifted = crate::model::scene::GuideFile {
        offset_m,
        ..pad(60.0, 1e-7)
    };
    [
        of(
            vec![crate::model::scene::GuideFile {
                offset_m,
                ..pad(-50.0, 1e-7)
            }],
            false,
        ),
        of(vec![pad(-50.0, 4e-8), shifted.clone()], false),
        of(vec![shifted], true),
    ]
}

const SMALL: crate::model::plate::Resolution = crate::model::plate::Resolution {
    max_diameters: 5,
    radial_functions: 4,
};
const SPEEDS_RPM: [f64; 5] = [0.0, 300.0, 600.0, 900.0, 1200.0];

/// Independent value: K(Ω) q = f + o K_p h on all functions, with linear guides, a pad K_p with the offset o and the unit heave h; a
/// blade without guides where the gap is wide. The forces are so small that the blade does not stretch.
#[test]
fn without_a_gap_and_far_within_it_the_blade_is_linear_at_every_speed() {
    use crate::model::plate::Plate;
    use faer::linalg::solvers::Solve;
    let (force_n, offset_m) = (1e-3, 3e-8);
    for (place, scene) in saws(0.0, offset_m).into_iter().enumerate() {
        let plate = Plate::new(&scene, SMALL);
        let order = plate.degrees_of_freedom();
        let pressed = PressedBlade::new(&scene, SMALL, 1500.0, order).unwrap();
        let rim = Polar::new(plate.blade.outer_radius_m, scene.cut_angle_rad());
        let functions = crate::motion::transient::at_point(&plate, rim);
        let of = |scene: &Scene| {
            crate::model::system::GyroscopicSystem::of_plate(&Plate::new(scene, SMALL))
        };
        let typed = |offset_m: f64, keeps: &dyn Fn(usize) -> bool| {
            let scene = scene.edited(|file| {
                file.guides
                    .iter_mut()
                    .for_each(|pad| pad.offset_m = offset_m);
                let guides = std::mem::take(&mut file.guides).into_iter().enumerate();
                file.guides = guides
                    .filter(|(k, _)| keeps(*k))
                    .map(|(_, pad)| pad)
                    .collect();
            });
            of(&scene.unwrap())
        };
        let shifted = usize::from(place == 1);
        let (whole, others) = (typed(0.0, &|_| true), typed(0.0, &|k| k != shifted));
        let mut heave = faer::Col::<f64>::zeros(order);
        heave[0] = 1.0 / plate.functions_at(0.3, 0.0)[0];
        // A clamped blade has no heave: its pad is not shifted.
        let is_shifted = place < 2;
        for rpm in SPEEDS_RPM {
            let stiffness = whole.stiffness_at(rad_per_s(rpm));
            let mut load = faer::Scale(force_n) * &functions;
            if is_shifted {
                load += faer::Scale(offset_m) * ((&whole.stiffness - &others.stiffness) * &heave);
            }
            let expected = functions.transpose() * stiffness.partial_piv_lu().solve(&load);
            let own = if is_shifted {
                pressed.with_gaps(1e-6).deviation(force_n, rpm)
            } else {
                let flat = scene.edited(|file| file.guides[0].offset_m = 0.0).unwrap();
                let pressed = PressedBlade::new(&flat, SMALL, 1500.0, order).unwrap();
                pressed.with_gaps(1e-6).deviation(force_n, rpm)
            };
            let own = own.unwrap().unwrap().deviation_m;
            assert!(
                (own / expected - 1.0).abs() < 1e-4,
                "{place} {rpm}: {own:e} {expected:e}"
            );
            if place == 2 {
                let bare = typed(0.0, &|_| false).stiffness_at(rad_per_s(rpm));
                let expected =
                    force_n * (functions.transpose() * bare.partial_piv_lu().solve(&functions));
                let far = pressed
                    .with_gaps(1e4)
                    .deviation(force_n, rpm)
                    .unwrap()
                    .unwrap();
                assert!(
                    (far.deviation_m / expected - 1.0).abs() < 1e-4,
                    "{rpm}: {far:?} {expected:e}"
                );
            }
        }
    }
}

/// A blade that slides along its arbor is held by its pads alone: at every speed, gap and force their forces, by contact and film,
/// balance the side force.
#[test]
fn pads_and_films_balance_the_side_force_at_every_speed() {
    for film in [0.0, 2e4] {
        for scene in &saws(film, 3e-6)[..2] {
            let pressed = PressedBlade::new(scene, SMALL, 1500.0, 40).unwrap();
            for rpm in SPEEDS_RPM {
                for (factor, force_n) in [(1e-4, 2.0), (100.0, -2.0), (1e3, 5.0), (1e4, 50.0)] {
                    let found = pressed
                        .with_gaps(factor)
                        .deviation(force_n, rpm)
                        .unwrap()
                        .unwrap();
                    let sum: f64 = found.pad_forces_n.iter().sum();
                    assert!(
                        (sum + force_n).abs() < 1e-5 * force_n.abs(),
                        "{film} {rpm} {factor}: {found:?}"
                    );
                }
            }
        }
    }
}
