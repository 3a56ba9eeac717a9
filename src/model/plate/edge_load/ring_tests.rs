//! Axisymmetric loads, compared with Lamé's ring and pure shear.

use std::f64::consts::TAU;

use faer::{Mat, Side};

use super::tests::LOADS;
use super::*;
use crate::model::analytical::annulus::{Annulus, RadialAndHoop};
use crate::model::plate::{Plate, Resolution};
use crate::model::scene::Scene;

/// A plate without guides, with n ≤ 5.
fn free_plate(radial_functions: usize) -> Plate {
    let scene = Scene::paper()
        .edited(|saw| {
            saw.blade.inner_diameter_m = 0.3 * saw.blade.outer_diameter_m;
            saw.guides.clear();
        })
        .unwrap();
    let resolution = Resolution {
        max_diameters: 5,
        radial_functions,
    };
    Plate::new(&scene, resolution)
}

/// Equal forces, more than there are harmonics, act like a uniform pressure, positive in tension. N forces P
/// make p = N P / 2πbh.
fn uniform_tension(blade: &Blade, pressure_pa: f64, forces: usize) -> Vec<RimForce> {
    let each = pressure_pa * TAU * blade.outer_radius_m * blade.thickness_m / forces as f64;
    (0..forces)
        .map(|k| RimForce {
            angle_rad: TAU * k as f64 / forces as f64 + 0.1,
            radial_n: each,
            tangential_n: 0.0,
        })
        .collect()
}

fn annulus(blade: &Blade) -> Annulus {
    Annulus {
        bore_radius_m: blade.inner_radius_m,
        rim_radius_m: blade.outer_radius_m,
    }
}

fn lame(blade: &Blade, pressure_pa: f64, r: f64) -> RadialAndHoop {
    annulus(blade).stress_under_rim_tension(pressure_pa, r)
}

/// K of the axisymmetric stress of Lamé's ring for n, in the form of `HarmonicBlock`.
fn lame_block(plate: &Plate, pressure_pa: f64, n: usize) -> Mat<f64> {
    let density = plate.blade.material.density_kg_per_m3;
    let size = plate.basis.count();
    let mut block = Mat::zeros(size, size);
    for (r, w) in plate.basis.rule().iter() {
        let f = plate.basis.evaluate(n, r);
        let stress = lame(&plate.blade, pressure_pa, r);
        for j in 0..size {
            for k in 0..size {
                let hoop_term = (n * n) as f64 * stress.hoop_pa / (r * r) * f.value[j] * f.value[k];
                let energy = stress.radial_pa * f.slope[j] * f.slope[k] + hoop_term;
                block[(j, k)] += w * r / density * energy;
            }
        }
    }
    block
}

#[test]
fn a_uniform_pressure_is_lames_ring() {
    let plate = free_plate(6);
    for pressure in [2.0e6, -3.0e6] {
        let loads = uniform_tension(&plate.blade, pressure, 11);
        let stress = EdgeStress::new(&plate.blade, &loads, 10);
        let stiffness = edge_stiffness(&plate, &stress);
        for r in [0.12, 0.2, 0.34] {
            let at = stress.harmonic(0, r);
            let expected = lame(&plate.blade, pressure, r);
            let scale = 1e-13 * pressure.abs();
            assert!((at.radial_pa[0] - expected.radial_pa).abs() < scale);
            assert!((at.hoop_pa[0] - expected.hoop_pa).abs() < scale);
            assert!(at.shear_pa[0].abs() < scale);
        }
        let mut expected = Mat::zeros(stiffness.nrows(), stiffness.ncols());
        for n in 0..=5 {
            let block = lame_block(&plate, pressure, n);
            for j in 0..6 {
                for k in 0..6 {
                    for first in [plate.offset(n), plate.offset(n) + if n > 0 { 6 } else { 0 }] {
                        expected[(first + j, first + k)] = block[(j, k)];
                    }
                }
            }
        }
        let error = (&stiffness - &expected).norm_l2() / expected.norm_l2();
        assert!(error < 1e-12, "{error}");
    }
}

/// Squared frequencies of n diameters at rest, from the cosine block of K_b + K_e.
fn squared_frequencies(plate: &Plate, stiffness: &Mat<f64>, n: usize) -> Vec<f64> {
    let (size, first) = (plate.basis.count(), plate.offset(n));
    let bending = &plate.harmonics[n].bending;
    Mat::from_fn(size, size, |j, k| {
        bending[(j, k)] + stiffness[(first + j, first + k)]
    })
    .self_adjoint_eigenvalues(Side::Lower)
    .unwrap()
}

/// Under uniform tension a blade tilts nearly as a rigid body; the frequencies of n = 2 … 5 change as the
/// matrix of the ring predicts.
#[test]
fn uniform_pressure_moves_the_frequencies_as_the_closed_form_does() {
    let plate = free_plate(8);
    let annulus = annulus(&plate.blade);
    let pressure = 10.0;
    let loads = uniform_tension(&plate.blade, pressure, 11);
    let stiffness = edge_stiffness(&plate, &EdgeStress::new(&plate.blade, &loads, 10));
    let density = plate.blade.material.density_kg_per_m3;
    let exact = annulus.tilt_frequency_squared_under_rim_tension(density, pressure);
    let found = squared_frequencies(&plate, &stiffness, 1)[0];
    assert!((found / exact - 1.0).abs() < 1e-5, "{found} {exact}");

    let strong_pressure = 5.0e6;
    let strong_loads = uniform_tension(&plate.blade, strong_pressure, 11);
    let strong_stiffness =
        edge_stiffness(&plate, &EdgeStress::new(&plate.blade, &strong_loads, 10));
    for n in 2..=5 {
        let loaded = squared_frequencies(&plate, &strong_stiffness, n)[0];
        let bending = &plate.harmonics[n].bending;
        let block = lame_block(&plate, strong_pressure, n);
        let direct = Mat::from_fn(8, 8, |j, k| bending[(j, k)] + block[(j, k)])
            .self_adjoint_eigenvalues(Side::Lower)
            .unwrap()[0];
        assert!(
            (loaded / direct - 1.0).abs() < 1e-11,
            "{n}: {loaded} {direct}"
        );
    }
}

#[test]
fn a_torque_is_pure_shear() {
    let blade = *Scene::paper().blade();
    let stress = EdgeStress::new(&blade, &LOADS, 12);
    let torque = blade.outer_radius_m * LOADS.iter().map(|load| load.tangential_n).sum::<f64>();
    for r in [blade.inner_radius_m, 0.2, blade.outer_radius_m] {
        let exact = Annulus::shear_under_torque_pa(torque, blade.thickness_m, r);
        let [shear, _] = stress.harmonic(0, r).shear_pa;
        assert!((shear / exact - 1.0).abs() < 1e-14, "{shear} {exact}");
    }
}
