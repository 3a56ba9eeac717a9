use faer::Side;

use super::*;
use crate::model::plate::{Plate, Resolution, RimForce};
use crate::model::scene::{GuideFile, Scene, SceneFile, rad_per_s};
use crate::model::system::GyroscopicSystem;

/// Reference of the counter: all eigenvalues of L(iω).
fn exact(system: &GyroscopicSystem, place: Place) -> usize {
    let (speed, omega) = (place.speed_rad_per_s, place.frequency_rad_per_s);
    let stiffness = system.stiffness_at(speed);
    let matrix = Mat::from_fn(system.order(), system.order(), |i, k| {
        let unit = if i == k { omega * omega } else { 0.0 };
        let turning = 2.0 * omega * speed * system.gyroscopic[(i, k)];
        c64::new(stiffness[(i, k)] - unit, turning)
    });
    let values = matrix.self_adjoint_eigenvalues(Side::Lower).unwrap();
    values.iter().filter(|value| **value < 0.0).count()
}

#[derive(Debug, Clone, Copy)]
struct Place {
    speed_rad_per_s: f64,
    frequency_rad_per_s: f64,
}

fn counted(basis: &FullModel, place: Place) -> Option<usize> {
    let at = basis.at(place.speed_rad_per_s);
    basis.count_along([&at; 2], [place.frequency_rad_per_s; 2])
}

struct Draw(f64);

impl Draw {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = (self.0 * 997.0 + 0.123_456).fract();
        low + self.0 * (high - low)
    }
}

fn drawn_saw(draw: &mut Draw, guides: usize) -> SceneFile {
    let mut file = Scene::paper().file().clone();
    file.blade.thickness_m *= draw.between(0.6, 1.6);
    file.guides = (0..guides)
        .map(|k| {
            let side = if k % 3 == 2 {
                0.0
            } else {
                draw.between(0.02, 0.15)
            };
            GuideFile {
                radius_m: draw.between(0.15, 0.33),
                angle_deg: draw.between(0.0, 360.0),
                radial_length_m: side,
                tangential_length_m: side,
                stiffness_n_per_m: 10_f64.powf(draw.between(4.0, 9.0)),
                damping_n_s_per_m: 0.0,
                ..GuideFile::default()
            }
        })
        .collect();
    file
}

fn small() -> Resolution {
    Resolution {
        max_diameters: 8,
        radial_functions: 5,
    }
}

fn places(draw: &mut Draw, count: usize) -> Vec<Place> {
    (0..count)
        .map(|_| Place {
            speed_rad_per_s: rad_per_s(draw.between(0.0, 6000.0)),
            frequency_rad_per_s: draw.between(0.0, 1500.0),
        })
        .collect()
}

#[test]
fn counts_are_those_of_all_eigenvalues_for_drawn_saws() {
    let mut draw = Draw(0.37);
    let mut uncertain = 0;
    for guides in [1, 1, 2, 3, 4] {
        let scene = Scene::try_from(drawn_saw(&mut draw, guides)).unwrap();
        let plate = Plate::new(&scene, small());
        let (basis, system) = (FullModel::new(&plate), GyroscopicSystem::of_plate(&plate));
        for place in places(&mut draw, 40) {
            match counted(&basis, place) {
                Some(count) => assert_eq!(count, exact(&system, place), "{place:?}"),
                None => uncertain += 1,
            }
        }
    }
    assert!(uncertain <= 2, "{uncertain} of 200");
}

/// Evenly spaced equal pads connect waves whose numbers of nodal diameters add up to, or differ by, a multiple of the number
/// of pads: for five pads 0 and 5; 1, 4 and 6; 2, 3, 7 and 8.
#[test]
fn evenly_spaced_equal_pads_are_counted_in_parts() {
    let mut draw = Draw(0.53);
    let mut file = drawn_saw(&mut draw, 1);
    file.guides = (0..5)
        .map(|k| GuideFile {
            angle_deg: 72.0 * f64::from(k),
            radial_length_m: 0.0,
            tangential_length_m: 0.0,
            ..file.guides[0].clone()
        })
        .collect();
    let plate = Plate::new(&Scene::try_from(file).unwrap(), small());
    let (basis, system) = (FullModel::new(&plate), GyroscopicSystem::of_plate(&plate));
    let Coupling::Columns(columns) = &basis.coupling else {
        panic!("dense");
    };
    let parts: Vec<&[usize]> = columns
        .parts
        .iter()
        .map(|part| part.harmonics.as_slice())
        .collect();
    assert_eq!(parts, [&[0, 5][..], &[1, 4, 6], &[2, 3, 7, 8]]);
    let mut certain = 0;
    for place in places(&mut draw, 60) {
        if let Some(count) = counted(&basis, place) {
            assert_eq!(count, exact(&system, place), "{place:?}");
            certain += 1;
        }
    }
    assert!(certain >= 58, "{certain} of 60");
}

/// The block of a wave of the free blade that is in resonance is singular and cannot be eliminated.
#[test]
fn counts_hold_at_the_poles_of_the_free_blade() {
    let plate = Plate::new(&Scene::paper(), small());
    let (basis, system) = (FullModel::new(&plate), GyroscopicSystem::of_plate(&plate));
    assert!(!basis.is_dense());
    for speed in [0.0, 100.0, 250.0] {
        for harmonic in &basis.harmonics {
            let stiffness = &harmonic.rest + &harmonic.tension * (speed * speed);
            let frequency = stiffness.symmetric_eigenvalues().min().max(0.0).sqrt();
            for away in [0.0, 1e-13, 1e-8, -1e-5] {
                let place = Place {
                    speed_rad_per_s: speed,
                    frequency_rad_per_s: (frequency - harmonic.diameters as f64 * speed).abs()
                        * (1.0 + away),
                };
                let count = counted(&basis, place);
                let exact = exact(&system, place);
                // A wave with a node at the pad is a mode, so no count is certain there.
                assert!(
                    count.is_none_or(|count| count == exact),
                    "{place:?} {count:?}"
                );
            }
        }
    }
}

#[test]
fn counts_hold_under_edge_loads_heat_and_stiff_points() {
    let mut draw = Draw(0.71);
    let stiff = Scene::paper().edited(|saw| {
        saw.guides[0].stiffness_n_per_m = 1e9;
        (
            saw.guides[0].radial_length_m,
            saw.guides[0].tangential_length_m,
        ) = (0.0, 0.0);
    });
    let stiff_plate = Plate::new(&stiff.unwrap(), small());
    let heated = Scene::paper().edited(|saw| {
        let heat = serde_json::json!({
            "temperature": { "expansion_per_k": 1.2e-5, "rim_rise_k": 15.0 },
        });
        saw.membrane = serde_json::from_value(heat).ok();
        assert!(saw.membrane.is_some());
    });
    let heated_plate = Plate::new(&heated.unwrap(), small());
    let loads = [(0.1, 900.0, -300.0), (-0.2, 400.0, 100.0)].map(|(angle_rad, x, y)| RimForce {
        angle_rad,
        radial_n: x,
        tangential_n: y,
    });
    let cut = Plate::new(&Scene::paper(), small()).with_edge_loads(&loads);
    for (plate, is_dense) in [(stiff_plate, false), (heated_plate, false), (cut, true)] {
        let (basis, system) = (FullModel::new(&plate), GyroscopicSystem::of_plate(&plate));
        assert_eq!(basis.is_dense(), is_dense);
        for place in places(&mut draw, 30) {
            assert_eq!(
                counted(&basis, place),
                Some(exact(&system, place)),
                "{place:?}"
            );
        }
    }
}

/// Along a proven line the number of negative eigenvalues never changes; most short lines can be proven.
#[test]
fn a_line_is_proven_only_if_no_mode_crosses_it() {
    let mut draw = Draw(0.55);
    let plate = Plate::new(&Scene::paper(), small());
    let (basis, system) = (FullModel::new(&plate), GyroscopicSystem::of_plate(&plate));
    let (mut proven, mut refuted) = (0, 0);
    for width in [20.0, 5.0, 1.0] {
        for start in places(&mut draw, 40) {
            let end = Place {
                speed_rad_per_s: start.speed_rad_per_s + width,
                frequency_rad_per_s: start.frequency_rad_per_s + draw.between(-width, width),
            };
            let counts: Vec<usize> = (0..=10)
                .map(|k| {
                    let share = f64::from(k) / 10.0;
                    let at = |a: f64, b: f64| a + share * (b - a);
                    exact(
                        &system,
                        Place {
                            speed_rad_per_s: at(start.speed_rad_per_s, end.speed_rad_per_s),
                            frequency_rad_per_s: at(
                                start.frequency_rad_per_s,
                                end.frequency_rad_per_s,
                            ),
                        },
                    )
                })
                .collect();
            let changes = counts.iter().any(|count| *count != counts[0]);
            refuted += usize::from(changes);
            let ends = [&start, &end].map(|place| basis.at(place.speed_rad_per_s));
            let line = [&start, &end].map(|place| place.frequency_rad_per_s);
            if let Some(count) = basis.count_along(ends.each_ref(), line) {
                assert!(basis.is_count_along(ends.each_ref(), line, count));
                assert!(!basis.is_count_along(ends.each_ref(), line, count + 1));
                assert!(
                    counts.iter().all(|exact| *exact == count),
                    "{counts:?} {count}"
                );
                proven += 1;
            }
        }
    }
    assert!(proven > 60 && refuted > 5, "{proven} {refuted}");
}
