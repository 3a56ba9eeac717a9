//! Stretching compared with closed forms and invariants.

use std::f64::consts::PI;

use faer::{Col, Mat};

use super::test_blades::{Wave, all, any, plate, projected};
use super::*;
use crate::model::scene::rad_per_s;

const ZERO: &dyn Fn(f64) -> f64 = &|_| 0.0;

/// w = ½κr² and w = ½κr² cos 2θ on an annulus with free edges have the same energy πEhκ⁴b⁶(1 − a²/b²)³/384,
/// because their Gaussian curvatures are κ² and −κ²; it does not depend on ν.
#[test]
fn the_bowl_and_the_saddle_have_the_energy_of_the_closed_form() {
    for (bore_m, poisson) in [(0.2, 0.29), (0.02, 0.0), (0.6, 0.45)] {
        let plate = plate([2, 4], |saw| {
            saw.blade.inner_diameter_m = bore_m;
            saw.blade.material.poisson_ratio = poisson;
        });
        let stretching = Stretching::new(&plate).unwrap();
        let blade = plate.blade;
        let (a, b, curvature) = (blade.inner_radius_m, blade.outer_radius_m, 0.3_f64);
        let e = blade.material.youngs_modulus_pa;
        let exact = PI
            * e
            * blade.thickness_m
            * curvature.powi(4)
            * b.powi(6)
            * (1.0 - (a / b).powi(2)).powi(3)
            / 384.0;
        let shape: &dyn Fn(f64) -> f64 = &|r| 0.5 * curvature * r * r;
        for wave in [(0, [shape, ZERO]), (2, [shape, ZERO]), (2, [ZERO, shape])] {
            let energy = stretching.energy_j(&projected(&plate, &[wave])).unwrap();
            let error = energy / exact - 1.0;
            assert!(error.abs() < 1e-11, "{bore_m} {}: {error:e}", wave.0);
        }
    }
}

/// The radial stress of the bowl is σ_rr = Eκ²(r² − a²)(b² − r²)/16r²; the forces that it exerts at the nodes are
/// compared.
#[test]
fn the_bowl_has_the_radial_stress_of_the_closed_form() {
    let plate = plate([2, 4], |_| ());
    let stretching = Stretching::new(&plate).unwrap();
    let (a, b, curvature) = (plate.blade.inner_radius_m, plate.blade.outer_radius_m, 0.3);
    let shape: &dyn Fn(f64) -> f64 = &|r| 0.5 * curvature * r * r;
    let w = stretching
        .slopes(&projected(&plate, &[(0, [shape, ZERO])]))
        .unwrap();
    let stress = stretching.stress(&stretching.relaxed(&Strain::of(&w, &w)));
    let found = &stress.harmonics[0][0];
    let mut exact = vec![0.0; stretching.nodes.len()];
    for (r, weight) in crate::model::plate::quadrature::piecewise(&plate.blade.edges_m(), 30).iter()
    {
        let e = plate.blade.material.youngs_modulus_pa;
        let radial_pa =
            e * curvature * curvature * (r * r - a * a) * (b * b - r * r) / (16.0 * r * r);
        for own in stretching.nodes.interpolated(r) {
            exact[own.node] += PI * plate.blade.thickness_m * radial_pa * own.share * weight * r;
        }
    }
    let largest = exact.iter().fold(0.0_f64, |max, x| max.max(x.abs()));
    for (found, exact) in found.iter().zip(&exact) {
        assert!((found - exact).abs() < 1e-12 * largest, "{found} {exact}");
    }
}

/// w = (x cos α + y sin α)² bends a sheet into a cylinder without stretching, for any thickness. Functions at
/// the knots of a profile are accurate to 1e-9 of the size of the blade.
#[test]
fn a_cylinder_is_not_stretched() {
    for (plate, most) in [
        (plate([3, 5], |_| ()), 1e-24),
        (plate([3, 5], super::test_blades::profiled), 1e-16),
    ] {
        let stretching = Stretching::new(&plate).unwrap();
        let (sin, cos) = (2.0 * 0.7_f64).sin_cos();
        let waves: [Wave<'_>; 2] = [
            (0, [&|r| 0.5 * r * r, ZERO]),
            (2, [&|r| 0.5 * cos * r * r, &|r| 0.5 * sin * r * r]),
        ];
        let cylinder = stretching.energy_j(&projected(&plate, &waves)).unwrap();
        let bowl = stretching
            .energy_j(&projected(&plate, &waves[..1]))
            .unwrap();
        assert!(cylinder < most * bowl, "{cylinder:e} {bowl:e}");
    }
}

/// Heave and tilt move the blade as a rigid body, to the second order of von Kármán's strains.
#[test]
fn rigid_motions_change_nothing() {
    for (plate, most) in [
        (plate([4, 4], |_| ()), 1e-11),
        (plate([4, 4], super::test_blades::profiled), 1e-8),
    ] {
        let stretching = Stretching::new(&plate).unwrap();
        let bent = any(&plate);
        let before = stretching.energy_j(&bent).unwrap();
        let rigid: [Wave<'_>; 2] = [(0, [&|_| 4e-3, ZERO]), (1, [&|r| 0.02 * r, &|r| -0.01 * r])];
        let moved = &bent + projected(&plate, &rigid);
        let change = stretching.energy_j(&moved).unwrap() / before - 1.0;
        assert!(change.abs() < most, "{change:e}");
    }
}

#[test]
fn a_rotated_deflection_has_the_same_energy() {
    for plate in all([4, 4]) {
        let stretching = Stretching::new(&plate).unwrap();
        let bent = any(&plate);
        let size = plate.basis.count();
        let mut turned = bent.clone();
        for n in 1..=plate.max_diameters() {
            let (sin, cos) = (n as f64 * 0.83).sin_cos();
            for j in plate.offset(n)..plate.offset(n) + size {
                turned[j] = cos * bent[j] - sin * bent[j + size];
                turned[j + size] = sin * bent[j] + cos * bent[j + size];
            }
        }
        let change = stretching.energy_j(&turned).unwrap() / stretching.energy_j(&bent).unwrap();
        assert!((change - 1.0).abs() < 1e-12, "{change}");
    }
}

/// References: Euler's identities for a homogeneous function of degree four, and five-point differences.
#[test]
fn gradient_and_hessian_are_the_derivatives() {
    for plate in all([3, 3]) {
        let stretching = Stretching::new(&plate).unwrap();
        let bent = any(&plate);
        let energy = stretching.energy_j(&bent).unwrap();
        let gradient = stretching.gradient(&bent).unwrap();
        let hessian = stretching.hessian(&bent).unwrap();
        let work = gradient.transpose() * &bent;
        assert!(
            (work / (4.0 * energy) - 1.0).abs() < 1e-12,
            "{work} {energy}"
        );
        let thrice = (&hessian * &bent - faer::Scale(3.0) * &gradient).norm_l2();
        assert!(thrice < 1e-12 * gradient.norm_l2(), "{thrice:e}");
        let direction = Col::from_fn(bent.nrows(), |i| 3e-4 * (2.1 * i as f64 + 1.0).cos());
        let at = |step: f64| &bent + faer::Scale(step) * &direction;
        // This formula is exact for polynomials of degree four.
        let slope =
            |of: &dyn Fn(f64) -> f64| (8.0 * (of(0.5) - of(-0.5)) - (of(1.0) - of(-1.0))) / 6.0;
        let found = slope(&|step| stretching.energy_j(&at(step)).unwrap());
        let exact = gradient.transpose() * &direction;
        assert!((found - exact).abs() < 1e-11 * energy, "{found} {exact}");
        let found_product = Col::from_fn(bent.nrows(), |i| {
            slope(&|step| stretching.gradient(&at(step)).unwrap()[i])
        });
        let error = (found_product - &hessian * &direction).norm_l2();
        assert!(error < 1e-11 * gradient.norm_l2(), "{error:e}");
    }
}

/// On some shapes the quartic form equals the potential and so do its derivatives.
#[test]
fn the_reduced_form_is_the_potential_on_its_shapes() {
    for plate in all([3, 3]) {
        let stretching = Stretching::new(&plate).unwrap();
        let order = plate.degrees_of_freedom();
        let shapes = Mat::from_fn(order, 7, |i, k| {
            ((1 + k) as f64 * 0.7 * i as f64 + k as f64).sin() / (1.0 + i as f64 / 5.0)
        });
        let reduced = ReducedStretching::new(&stretching, shapes.as_ref()).unwrap();
        let p = Col::from_fn(7, |k| 1e-3 * (1.0 + k as f64).cos());
        let q = &shapes * &p;
        let energy = stretching.energy_j(&q).unwrap();
        let error = reduced.energy_j(&p).unwrap() / energy - 1.0;
        assert!(error.abs() < 1e-12, "{error:e}");
        let gradient = shapes.transpose() * stretching.gradient(&q).unwrap();
        let gradient_error = (reduced.gradient(&p).unwrap() - &gradient).norm_l2();
        assert!(
            gradient_error < 1e-12 * gradient.norm_l2(),
            "{gradient_error:e}"
        );
        let hessian = shapes.transpose() * stretching.hessian(&q).unwrap() * &shapes;
        let hessian_error = (reduced.hessian(&p).unwrap() - &hessian).norm_l2();
        assert!(
            hessian_error < 1e-12 * hessian.norm_l2(),
            "{hessian_error:e}"
        );
        let many = Mat::from_fn(7, 3, |k, time| 1e-3 * (1.0 + (k + 5 * time) as f64).cos());
        let weights = Mat::from_fn(3, 2, |time, k| (1.0 + (time + 2 * k) as f64).sin());
        let gradients = reduced.gradients(&many).unwrap();
        let sums = reduced.hessian_sums(&many, &weights).unwrap();
        let mut exact_sums = vec![Mat::<f64>::zeros(7, 7); 2];
        for time in 0..3 {
            let q = &shapes * many.col(time);
            let gradient = shapes.transpose() * stretching.gradient(&q).unwrap();
            let error = (gradients.col(time) - &gradient).norm_l2();
            assert!(error < 1e-12 * gradient.norm_l2(), "{error:e}");
            let hessian = shapes.transpose() * stretching.hessian(&q).unwrap() * &shapes;
            for (k, sum) in exact_sums.iter_mut().enumerate() {
                *sum += faer::Scale(weights[(time, k)]) * &hessian;
            }
        }
        for (k, exact) in exact_sums.iter().enumerate() {
            let found = Mat::from_fn(7, 7, |i, j| sums[(7 * j + i, k)]);
            let error = (found - exact).norm_l2();
            assert!(error < 1e-12 * exact.norm_l2(), "{error:e}");
        }
    }
}

/// Γ = 4U₄/Eh of the modes of a disk with a free edge, ∫φ² dA = 1, b = 1, ν = 0.33.
///
/// 1.8965, 16.933, 8.529 and 31.726 were computed by a separate program in another language, with truncated
/// series in the plane. Touzé, Thomas & Chaigne (J. Sound Vib. 258 (2002), 649–676) print 1.898, 16.92 and
/// 8.57 for the first three: they differ by 0.08 %, 0.08 % and 0.5 %.
#[test]
fn a_free_disk_has_the_published_coefficients() {
    let disk = plate([3, 12], |saw| {
        saw.blade.outer_diameter_m = 2.0;
        saw.blade.inner_diameter_m = 0.01;
        saw.blade.material.poisson_ratio = 0.33;
    });
    let stretching = Stretching::new(&disk).unwrap();
    let expected = [
        (2, 0, 1.8965),
        (3, 0, 16.933),
        (0, 1, 8.529),
        (1, 1, 31.726),
    ];
    for (diameters, circles, gamma) in expected {
        let bending = disk.harmonics[diameters].body_frame_stiffness(rad_per_s(0.0));
        let modes = bending.self_adjoint_eigen(faer::Side::Lower).unwrap();
        let mut q = Col::zeros(disk.degrees_of_freedom());
        for j in 0..disk.basis.count() {
            q[disk.offset(diameters) + j] = modes.U()[(j, circles)];
        }
        // The basis has ∫ρh φ² dA = 1, so that ∫φ² dA = 1/ρh.
        let scale = disk.blade.mass_per_area_kg_per_m2().powi(2)
            / (disk.blade.material.youngs_modulus_pa * disk.blade.thickness_m);
        let found = 4.0 * scale * stretching.energy_j(&q).unwrap();
        let error = found / gamma - 1.0;
        assert!(
            error.abs() < 2e-4,
            "({diameters}, {circles}): {found} {gamma}"
        );
    }
}

#[test]
fn a_deflection_of_another_basis_is_refused() {
    let stretching = Stretching::new(&plate([2, 3], |_| ())).unwrap();
    let error = StretchingError::Length {
        given: 4,
        expected: 15,
    };
    assert_eq!(stretching.energy_j(&Col::zeros(4)), Err(error));
    let reduced = ReducedStretching::new(&stretching, Mat::zeros(15, 2).as_ref()).unwrap();
    assert!(reduced.gradient(&Col::zeros(3)).is_err());
    assert!(ReducedStretching::new(&stretching, Mat::zeros(4, 2).as_ref()).is_err());
}
