use super::*;
use crate::model::analytical::annulus::Annulus;
use crate::model::scene::{Scene, ThicknessRow};

/// A blade of uniform thickness has the stress of the closed form.
#[test]
fn the_constant_blade_has_the_stress_of_the_textbook() {
    let blade = *Scene::paper().blade();
    let density = blade.material.density_kg_per_m3;
    let load = InPlaneLoad {
        body_n_per_m3: &|r| density * 100.0 * r,
        ..InPlaneLoad::default()
    };
    let field = InPlaneField::new(&blade, 0, &load);
    let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
    let annulus = Annulus {
        bore_radius_m: a,
        rim_radius_m: b,
    };
    for r in [a, 0.15, 0.2731, 0.34, b] {
        let nu = blade.material.poisson_ratio;
        let exact = annulus.stress_of_rotation_with_free_edges(nu, density * 100.0, r);
        let found = field.at(r, 0.0);
        let error = (found.radial_pa - exact.radial_pa).hypot(found.hoop_pa - exact.hoop_pa);
        assert!(error < 1e-11 * density * 100.0 * b * b, "{r}: {error:e}");
    }
}

/// A disk whose thickness falls as 1/r is Stodola's hyperbolic disk, with a closed form.
///
/// u = c₁ r^s₁ + c₂ r^s₂ + p r³ with s² − s − (1 + ν) = 0 for h ∝ 1/r, and p = −(1 − ν²)ρΩ²/E /(9 − 3 − (1 +
/// ν)) (A. Stodola, *Steam and Gas Turbines*, 1927). A profile is linear between rows; eight rows approximate
/// 1/r to 0.1 %.
#[test]
fn a_hyperbolic_disk_has_the_stress_of_stodola() {
    let (a, b) = (0.2_f64, 0.24_f64);
    let rows: Vec<ThicknessRow> = (0..8)
        .map(|k| {
            let radius_m = a + (b - a) * f64::from(k) / 7.0;
            ThicknessRow {
                radius_m,
                thickness_m: 2e-3 * a / radius_m,
            }
        })
        .collect();
    let saw = Scene::paper().edited(|saw| {
        saw.guides.clear();
        saw.cut = None;
        saw.blade.inner_diameter_m = 2.0 * a;
        saw.blade.outer_diameter_m = 2.0 * b;
        saw.blade.thickness_m = 2e-3;
        saw.blade.profile = rows;
    });
    let blade = *saw.expect("a saw").blade();
    let load = InPlaneLoad {
        body_n_per_m3: &|r| 1e6 * r,
        ..InPlaneLoad::default()
    };
    let field = InPlaneField::new(&blade, 0, &load);
    let (e, nu) = (
        blade.material.youngs_modulus_pa,
        blade.material.poisson_ratio,
    );
    let root = (0.25 + 1.0 + nu).sqrt();
    let exponents = [0.5 + root, 0.5 - root, 3.0];
    let particular = -(1.0 - nu * nu) * 1e6 / e / (9.0 - 3.0 - (1.0 + nu));
    let plane = e / (1.0 - nu * nu);
    let radial = |s: f64, r: f64| plane * (s + nu) * r.powf(s - 1.0);
    let hoop = |s: f64, r: f64| plane * (1.0 + nu * s) * r.powf(s - 1.0);
    let edges = nalgebra::Matrix2::from_fn(|i, k| radial(exponents[k], [a, b][i]));
    let right = nalgebra::Vector2::from_fn(|i, _| -particular * radial(3.0, [a, b][i]));
    let c = edges.lu().solve(&right).expect("two conditions");
    let factors = [c[0], c[1], particular];
    let scale = 1e6 * b * b;
    for r in [0.201, 0.215, 0.2283, 0.239] {
        let of = |part: &dyn Fn(f64, f64) -> f64| -> f64 {
            (0..3).map(|k| factors[k] * part(exponents[k], r)).sum()
        };
        let found = field.at(r, 0.0);
        let error = (found.radial_pa - of(&radial)).hypot(found.hoop_pa - of(&hoop));
        assert!(error < 1e-3 * scale, "{r}: {error:e} of {scale:e}");
    }
}
