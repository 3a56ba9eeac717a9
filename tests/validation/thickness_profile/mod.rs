//! Blades of varying thickness and with mass at the rim, compared with finite elements over the radius.
//!
//! The elements share nothing with the library: Hermite cubics for the deflection and quadratics for the displacement
//! in the plane, ring by ring, for each number of nodal diameters, with consistent mass. They converge with the fourth
//! power of the element's width; the error of eighty of them is about 1e-7.

mod ring;

use nalgebra::DMatrix;
use sawflutter::model::plate::{Plate, Resolution, RimForce};
use sawflutter::model::scene::{
    InPlane, MembraneFile, Mount, RimFile, Scene, SceneFile, TemperatureFile, ThicknessRow,
};

use crate::common::{Worst, relative_error};

use ring::Ring;

const ELEMENTS: usize = 80;
const HUB: f64 = 3.6e-3;
const ROWS: [(f64, f64); 4] = [
    (0.16, 3.6e-3),
    (0.26, 2.4e-3),
    (0.31, 2.4e-3),
    (0.31, 1.9e-3),
];

/// The thickness as a function of the radius: hub, taper, land, thin rim.
fn stepped(r: f64) -> f64 {
    match r {
        r if r < 0.16 => HUB,
        r if r < 0.26 => HUB - 1.2e-3 * (r - 0.16) / 0.1,
        r if r < 0.31 => 2.4e-3,
        _ => 1.9e-3,
    }
}

fn rows(list: &[(f64, f64)]) -> Vec<ThicknessRow> {
    let row = |&(radius_m, thickness_m): &(f64, f64)| ThicknessRow {
        radius_m,
        thickness_m,
    };
    list.iter().map(row).collect()
}

fn saw(change: impl FnOnce(&mut SceneFile)) -> Scene {
    let saw = Scene::paper().edited(|saw| {
        saw.guides.clear();
        saw.blade.thickness_m = HUB;
        saw.blade.profile = rows(&ROWS);
        change(saw);
    });
    saw.unwrap_or_else(|error| panic!("{error}"))
}

/// Mass of all teeth.
fn rim_kg(scene: &Scene) -> f64 {
    let typed = &scene.file().blade;
    let teeth = f64::from(typed.teeth.unwrap_or(0));
    typed.rim.map_or(0.0, |rim| teeth * rim.mass_per_tooth_kg)
}

fn ring(scene: &Scene, thickness: fn(f64) -> f64) -> Ring {
    let blade = scene.blade();
    let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
    let mut ends = vec![a];
    ends.extend([0.16, 0.26, 0.31].into_iter().filter(|r| *r > a));
    ends.push(b);
    let mut nodes = vec![a];
    for pair in ends.windows(2) {
        let count = (ELEMENTS as f64 * (pair[1] - pair[0]) / (b - a)).ceil() as usize;
        let share = |k: usize| pair[0] + (pair[1] - pair[0]) * k as f64 / count as f64;
        nodes.extend((1..=count).map(share));
    }
    let collar = matches!(scene.file().mount, Mount::Collar { .. });
    let fixed = matches!(
        scene.file().mount,
        Mount::Collar {
            in_plane: InPlane::Fixed,
            ..
        }
    );
    Ring {
        nodes,
        thickness,
        rim_kg: rim_kg(scene),
        clamped: collar,
        held: fixed,
        e: blade.material.youngs_modulus_pa,
        nu: blade.material.poisson_ratio,
        rho: blade.material.density_kg_per_m3,
        free_strain: |r| 1.2e-5 * 15.0 * (r - 0.2).max(0.0) / 0.155,
    }
}

const RESOLUTION: Resolution = Resolution {
    max_diameters: 5,
    radial_functions: 12,
};

/// Frequencies of the library in the turning frame, in rad/s, ascending.
fn frequencies(plate: &Plate, n: usize, speed: f64) -> Vec<f64> {
    let stiffness = plate.harmonics[n].body_frame_stiffness(speed);
    let k = DMatrix::from_fn(stiffness.nrows(), stiffness.ncols(), |i, j| {
        stiffness[(i, j)]
    });
    let mut squares: Vec<f64> = k.symmetric_eigenvalues().iter().copied().collect();
    squares.sort_by(f64::total_cmp);
    squares.into_iter().map(|s| s.max(0.0).sqrt()).collect()
}

fn compare(what: &str, scene: &Scene, thickness: fn(f64) -> f64, tolerance: f64) {
    let ring = ring(scene, thickness);
    let plate = Plate::new(scene, RESOLUTION);
    let mut worst = Worst::default();
    for n in 0..=5 {
        for speed in [0.0, 150.0, 300.0] {
            let heated = scene.file().membrane.is_some();
            let expected = ring.frequencies(n, speed, heated);
            let found = frequencies(&plate, n, speed);
            let free = !ring.clamped && n <= 1;
            for (found, expected) in found.iter().zip(&expected).skip(usize::from(free)).take(3) {
                worst.add(relative_error(*found, *expected), || {
                    format!("n = {n} at {speed} rad/s: {found} for {expected}")
                });
            }
        }
    }
    worst.assert_at_most(what, tolerance);
}

fn collar(in_plane: InPlane) -> Mount {
    Mount::Collar {
        diameter_m: 0.25,
        in_plane,
        clamp_stiffness_n_m_per_rad_per_m: None,
    }
}

#[test]
fn a_stepped_and_tapered_blade_has_the_frequencies_of_finite_elements() {
    compare("spline", &saw(|_| ()), stepped, 1e-4);
    for in_plane in [InPlane::Fixed, InPlane::Free] {
        let held = saw(|saw| saw.mount = collar(in_plane));
        compare(&format!("collar {in_plane:?}"), &held, stepped, 1e-4);
    }
}

#[test]
fn heat_stresses_a_stepped_blade_as_it_does_finite_elements() {
    for mount in [Mount::Spline {}, collar(InPlane::Fixed)] {
        let hot = saw(|saw| {
            saw.mount = mount;
            saw.membrane = Some(MembraneFile {
                temperature: Some(TemperatureFile {
                    expansion_per_k: 1.2e-5,
                    rim_rise_k: Some(15.0),
                    from_radius_m: Some(0.2),
                    exponent: None,
                    table: Vec::new(),
                }),
                roll_tension: Vec::new(),
                residual_stress: Vec::new(),
                straight_edge: None,
            });
        });
        compare("hot", &hot, stepped, 1e-4);
    }
}

#[test]
fn the_mass_of_teeth_is_that_of_finite_elements() {
    let heavy = |saw: &mut SceneFile| {
        saw.blade.rim = Some(RimFile {
            mass_per_tooth_kg: 0.012,
            radius_m: None,
        });
    };
    compare("steps and teeth", &saw(heavy), stepped, 1e-4);
    let plain = saw(|saw| {
        heavy(saw);
        saw.blade.profile.clear();
    });
    compare("teeth alone", &plain, |_| HUB, 1e-5);
    let held = saw(|saw| {
        heavy(saw);
        saw.mount = collar(InPlane::Fixed);
    });
    compare("steps, teeth and a collar", &held, stepped, 1e-4);
}

/// A profile of constant thickness is a blade of that thickness, and so is one with a step of a billionth.
#[test]
fn a_profile_of_one_thickness_is_the_plain_blade() {
    let plain = Plate::new(&saw(|saw| saw.blade.profile.clear()), RESOLUTION);
    for rest in [0.0, 1e-9] {
        let thickness = HUB * (1.0 - rest);
        let scene = saw(|saw| saw.blade.profile = rows(&[(0.16, HUB), (0.16, thickness)]));
        let same = Plate::new(&scene, RESOLUTION);
        for n in 0..=5 {
            let pairs = frequencies(&plain, n, 200.0)
                .into_iter()
                .zip(frequencies(&same, n, 200.0));
            for (one, other) in pairs.skip(usize::from(n <= 1)).take(3) {
                assert!(relative_error(other, one) < 1e-6, "{n}: {other} for {one}");
            }
        }
    }
}

/// The virial: the effect of dead loads on the rigid tilts depends on their points of application alone, not on the
/// blade between them.
#[test]
fn edge_loads_turn_a_stepped_blade_as_they_turn_a_plain_one() {
    let loads = [
        RimForce {
            angle_rad: 0.3,
            radial_n: -90.0,
            tangential_n: -1000.0,
        },
        RimForce {
            angle_rad: 0.7,
            radial_n: 40.0,
            tangential_n: 600.0,
        },
    ];
    let moments = |scene: &Scene| {
        let plate = Plate::new(scene, RESOLUTION).with_edge_loads(&loads);
        let stiffness = plate.edge_stiffness.as_ref().expect("loads").clone();
        let (b, count) = (plate.blade.outer_radius_m, plate.radial_functions());
        let tilt = plate.functions_at(b, 0.0)[plate.offset(1)] / b;
        let at = [plate.offset(1), plate.offset(1) + count];
        DMatrix::from_fn(2, 2, |i, j| stiffness[(at[i], at[j])] / (tilt * tilt))
    };
    let plain = moments(&saw(|saw| saw.blade.profile.clear()));
    let stepped = moments(&saw(|_| ()));
    let error = (&stepped - &plain).norm() / plain.norm();
    assert!(error < 1e-9, "{stepped} for {plain}, off by {error:e}");
}

/// The stress of edge loads of high order on a blade whose profile has one thickness.
#[test]
fn finite_elements_give_the_edge_stiffness_of_the_series() {
    let loads = [RimForce {
        angle_rad: 0.3,
        radial_n: -90.0,
        tangential_n: -1000.0,
    }];
    let buckled = |profile: Vec<ThicknessRow>| {
        let plate =
            Plate::new(&saw(|saw| saw.blade.profile = profile), RESOLUTION).with_edge_loads(&loads);
        let system = sawflutter::model::system::GyroscopicSystem::of_plate(&plate);
        let k = DMatrix::from_fn(system.order(), system.order(), |i, j| {
            system.stiffness[(i, j)]
        });
        let mut all: Vec<f64> = k.symmetric_eigenvalues().iter().copied().collect();
        all.sort_by(f64::total_cmp);
        all
    };
    let (plain, elements) = (buckled(Vec::new()), buckled(rows(&[(0.2, HUB)])));
    for (one, other) in plain.iter().zip(&elements).take(14) {
        let error = (one - other).abs() / plain[13].abs();
        assert!(error < 1e-6, "{other} for {one}");
    }
}
