//! Goal: the blade at rest has the natural frequencies of the exact annular plate.
//!
//! Source: tests/reference/annulus_exact.csv, roots of the Bessel determinant of the
//! Kirchhoff annulus to 16 digits, λ² = ωb²√(ρh/D), ν = 0.3; FF: both edges free (a
//! spline blade), CF: bore clamped (a collar blade); a/b from 0.1 to 0.9, n = 0 … 6. Between
//! them the same determinant in double precision, `sawflutter::model::analytical::annular_plate`.

use crate::common::{AnnulusRoot, Worst, of_diameters, reference_model, relative_error};
use proptest::prelude::*;
use sawflutter::model::analytical::annular_plate::{AnnularPlate, Bore};
use sawflutter::model::scene::{InPlane, Material, Mount, Scene, SceneFile, rad_per_s};
use sawflutter::modes::ModeKind;

fn annulus(bc: &str, nu: f64, ratio: f64) -> Scene {
    let mut file: SceneFile = Scene::paper().file().clone();
    file.guides.clear();
    file.sweep = None;
    let blade = &mut file.blade;
    blade.outer_diameter_m = 0.8;
    blade.inner_diameter_m = 0.8 * ratio;
    blade.thickness_m = 0.003;
    blade.material = Material {
        youngs_modulus_pa: 2.1e11,
        poisson_ratio: nu,
        density_kg_per_m3: 7850.0,
    };
    file.mount = match bc {
        "FF" => Mount::Spline {},
        // At rest there is no stress in the plane, and either condition gives the same result.
        "CF" => Mount::Collar {
            diameter_m: blade.inner_diameter_m,
            in_plane: InPlane::Free,
            clamp_stiffness_n_m_per_rad_per_m: None,
        },
        other => panic!("unknown condition {other}"),
    };
    Scene::try_from(file).unwrap_or_else(|error| panic!("{error}"))
}

/// Largest relative error over all roots with one s. Every n ≥ 1 must occur twice.
fn worst_of(bc: &str, s: usize) -> Worst {
    let roots: Vec<AnnulusRoot> = crate::common::table("annulus_exact.csv");
    let mut ratios: Vec<f64> = roots.iter().map(|root| root.ratio).collect();
    ratios.dedup();
    ratios.sort_by(f64::total_cmp);
    ratios.dedup();
    assert_eq!(ratios.len(), 5);
    let mut worst = Worst::default();
    for ratio in ratios {
        let scene = annulus(bc, 0.3, ratio);
        let model = reference_model(&scene, rad_per_s(1000.0));
        let modes = model.all_modes(0.0).unwrap();
        let blade = scene.blade();
        let unit = (blade.flexural_rigidity_n_m() / blade.mass_per_area_kg_per_m2()).sqrt()
            / blade.outer_radius_m.powi(2);
        let here = |root: &&AnnulusRoot| root.bc == bc && root.ratio == ratio && root.s == s;
        for root in roots.iter().filter(here) {
            assert_eq!(root.nu, 0.3);
            let elastic: Vec<f64> = of_diameters(&modes, root.n)
                .filter(|mode| mode.kind != ModeKind::Rigid)
                .map(|mode| mode.frequency_rad_per_s() / unit)
                .collect();
            let multiplicity = if root.n == 0 { 1 } else { 2 };
            for lambda2 in &elastic[multiplicity * s..multiplicity * (s + 1)] {
                worst.add(relative_error(*lambda2, root.lambda2), || {
                    format!("{bc} a/b = {ratio}, n = {}, s = {s}", root.n)
                });
            }
        }
    }
    // Five ratios, one value for n = 0 and two for n = 1 … 6.
    assert_eq!(worst.count, 5 * 13);
    worst
}

/// The promise: 1e-5 relative.
#[test]
fn free_annulus_without_and_with_one_nodal_circle() {
    for s in [0, 1] {
        worst_of("FF", s).assert_at_most(&format!("free annulus, s = {s}"), 1e-5);
    }
}

#[test]
fn clamped_annulus_without_and_with_one_nodal_circle() {
    for s in [0, 1] {
        worst_of("CF", s).assert_at_most(&format!("clamped annulus, s = {s}"), 1e-5);
    }
}

/// s = 2 lies above the range of any chart, so that the promise does not include it.
#[test]
fn third_root_of_either_annulus() {
    for bc in ["FF", "CF"] {
        worst_of(bc, 2).assert_at_most(&format!("{bc}, s = 2"), 1e-4);
    }
}

fn plate(bc: &str, radius_ratio: f64, poisson_ratio: f64) -> AnnularPlate {
    let bore = match bc {
        "FF" => Bore::Free,
        "CF" => Bore::Clamped,
        other => panic!("unknown condition {other}"),
    };
    AnnularPlate {
        bore,
        radius_ratio,
        poisson_ratio,
    }
}

/// The determinant in double precision, compared with both tables: 16 digits, and fifty digits for narrow rings, small
/// bores and large n, whose terms cancel.
#[test]
fn the_determinant_in_double_precision_has_the_roots_of_the_tables() {
    for (name, count, tolerance) in [
        ("annulus_exact.csv", 210, 1e-14),
        ("annulus_extreme.csv", 46, 1e-10),
    ] {
        let mut worst = Worst::default();
        for root in crate::common::table::<AnnulusRoot>(name) {
            let found = plate(&root.bc, root.ratio, root.nu)
                .roots(root.n, root.s + 1)
                .get(root.s)
                .copied()
                .unwrap_or(f64::NAN);
            worst.add(relative_error(found, root.lambda2), || format!("{root:?}"));
        }
        assert_eq!(worst.count, count, "{name}");
        worst.assert_at_most(name, tolerance);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// The lowest two roots for bores, Poisson's ratios and nodal diameters that no table has.
    #[test]
    fn a_drawn_annulus_has_the_roots_of_its_determinant(
        bc in prop_oneof![Just("FF"), Just("CF")],
        ratio in 0.12..0.85_f64,
        nu in 0.0..0.45_f64,
    ) {
        let scene = annulus(bc, nu, ratio);
        let model = reference_model(&scene, rad_per_s(1000.0));
        let modes = model.all_modes(0.0).unwrap();
        let blade = scene.blade();
        for n in 0..=7 {
            let elastic: Vec<f64> = of_diameters(&modes, n)
                .filter(|mode| mode.kind != ModeKind::Rigid)
                .map(|mode| mode.frequency_rad_per_s())
                .collect();
            let multiplicity = if n == 0 { 1 } else { 2 };
            let expected = plate(bc, ratio, nu).roots(n, 2);
            prop_assert_eq!(expected.len(), 2);
            for (s, root) in expected.into_iter().enumerate() {
                let expected = AnnularPlate::frequency_rad_per_s(
                    root,
                    blade.outer_radius_m,
                    blade.flexural_rigidity_n_m(),
                    blade.mass_per_area_kg_per_m2(),
                );
                let error = relative_error(elastic[multiplicity * s], expected);
                prop_assert!(error < 1e-5, "{bc} a/b = {ratio}, n = {n}, s = {s}: {error:e}");
            }
        }
    }
}
