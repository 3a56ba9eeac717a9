//! Stresses compared with closed forms from the literature, and with equilibrium and compatibility.

use super::*;
use crate::model::analytical::annulus::Annulus;
use crate::model::plate::{Plate, Resolution};
use crate::model::scene::{Groove, Mount, RollBand, Scene};

const BORES: [Bore; 3] = [
    Bore::Free,
    Bore::Clamped(InPlane::Free),
    Bore::Clamped(InPlane::Fixed),
];

fn paper_with(membrane: &str, bore: Bore) -> (Blade, Membrane) {
    let scene = Scene::paper()
        .edited(|file| {
            file.membrane = Some(serde_json::from_str(membrane).unwrap());
            if let Bore::Clamped(in_plane) = bore {
                let diameter_m = file.blade.inner_diameter_m;
                file.mount = Mount::Collar {
                    diameter_m,
                    in_plane,
                    clamp_stiffness_n_m_per_rad_per_m: None,
                };
            }
        })
        .unwrap_or_else(|error| panic!("{error}"));
    (*scene.blade(), scene.membrane().unwrap().clone())
}

fn stress_of(membrane: &str, bore: Bore) -> MembraneStress {
    let (blade, named) = paper_with(membrane, bore);
    MembraneStress::new(&blade, &named).unwrap()
}

const LINEAR: &str = r#"{"temperature": {"expansion_per_k": 1.2e-5, "rim_rise_k": 10}}"#;
const ROOT: &str = r#"{"temperature": {"expansion_per_k": 1.2e-5, "rim_rise_k": 10,
    "from_radius_m": 0.15, "exponent": 0.5}}"#;
const STEEP: &str = r#"{"temperature": {"expansion_per_k": 1.2e-5, "rim_rise_k": -20,
    "from_radius_m": 0.05, "exponent": 7}}"#;
const TABLE: &str = r#"{"temperature": {"expansion_per_k": 1.2e-5, "table": [
    {"radius_m": 0.08, "rise_k": 30}, {"radius_m": 0.2, "rise_k": 4},
    {"radius_m": 0.21, "rise_k": -3}, {"radius_m": 0.34, "rise_k": 20}]}}"#;
const ROLLED: &str = r#"{"roll_tension": [
    {"radius_m": 0.22, "width_m": 0.02, "eigenstrain": 3e-4},
    {"radius_m": 0.27, "width_m": 0.05, "eigenstrain": 1e-4}]}"#;
const MEASURED: &str = r#"{"residual_stress": [
    {"radius_m": 0.1, "hoop_pa": -30e6}, {"radius_m": 0.2, "hoop_pa": -42e6},
    {"radius_m": 0.3, "hoop_pa": 35e6}, {"radius_m": 0.355, "hoop_pa": 100e6}]}"#;
const PROFILES: [&str; 6] = [LINEAR, ROOT, STEEP, TABLE, ROLLED, MEASURED];

/// A groove of depth d on each face adds the volume V = 2d · 2πRw to the plane of the blade. With free edges the hoop
/// stress of the rim is then E V/(2πh (b² − a²)).
#[test]
fn a_groove_stretches_the_rim_by_the_volume_that_it_displaces() {
    let (depth_m, radius_m, width_m) = (2.1e-6, 0.23, 0.004);
    let stress = stress_of(
        r#"{"roll_tension": [{"radius_m": 0.23, "width_m": 0.004, "groove_depth_m": 2.1e-6}]}"#,
        Bore::Free,
    );
    let Blade {
        inner_radius_m: a,
        outer_radius_m: b,
        thickness_m: h,
        material,
        ..
    } = stress.blade;
    let displaced_m3 = 2.0 * depth_m * 2.0 * std::f64::consts::PI * radius_m * width_m;
    let expected = material.youngs_modulus_pa * displaced_m3
        / (2.0 * std::f64::consts::PI * h * (b * b - a * a));
    assert!((stress.at(b).hoop_pa / expected - 1.0).abs() < 1e-12);
}

/// The eigenstrain of a groove in a taper is its depth over the thickness at its own radius.
#[test]
fn a_groove_in_a_taper_refers_to_the_thickness_at_its_radius() {
    let scene = Scene::paper().edited(|file| {
        file.blade.profile = serde_json::from_str(
            r#"[{"radius_m": 0.2, "thickness_m": 0.004}, {"radius_m": 0.3, "thickness_m": 0.002}]"#,
        )
        .unwrap();
        file.membrane = Some(
            serde_json::from_str(
                r#"{"roll_tension": [{"radius_m": 0.25, "width_m": 0.01, "groove_depth_m": 3e-6}]}"#,
            )
            .unwrap(),
        );
    }).unwrap();
    let band = scene.membrane().unwrap().roll_tension[0];
    assert!((band.eigenstrain - 1e-3).abs() < 1e-15);
    let depth_m = Groove::at(scene.blade(), band.middle_m()).depth_m(band.eigenstrain);
    assert!((depth_m - 3e-6).abs() < 1e-18);
}

/// The integral of d(r σ_rr)/dr = σ_θθ is satisfied between any two radii, across every kink, jump and band, and the
/// edges satisfy their conditions.
#[test]
fn every_profile_is_in_equilibrium() {
    for (profile, bore) in PROFILES.iter().flat_map(|p| BORES.map(|bore| (*p, bore))) {
        let stress = stress_of(profile, bore);
        let knots = stress.knots_m();
        let scale = stress.at(knots[knots.len() - 1]).hoop_pa.abs();
        assert!(scale > 1e5, "{profile}");
        for panel in knots.windows(2) {
            let (low, high) = (panel[0], panel[1]);
            let rule = quadrature::graded(low, high, 40);
            let hoop: f64 = rule.iter().map(|(r, w)| w * stress.at(r).hoop_pa).sum();
            let traction = |r: f64| r * stress.at(r).radial_pa;
            let residual = traction(high) - traction(low) - hoop;
            // Near r₀ the quadrature of a root has an error of 1e-11.
            let error = residual.abs() / (scale * high);
            assert!(error < 1e-10, "{profile} {bore:?}: {error:e}");
        }
        let (a, b) = (knots[0], knots[knots.len() - 1]);
        assert!(stress.at(b).radial_pa.abs() < 1e-12 * scale);
        let measured = profile == MEASURED;
        match bore {
            Bore::Free => assert!(stress.at(a).radial_pa.abs() < 1e-12 * scale),
            Bore::Clamped(InPlane::Free) if !measured => {
                assert!(stress.at(a).radial_pa.abs() < 1e-12 * scale);
            }
            _ => assert!(stress.at(a).radial_pa.abs() > 1e-4 * scale),
        }
    }
}

/// The strains belong to a displacement: u/r = ε_θ has the derivative (ε_r − ε_θ)/r, and a fixed collar has
/// u(a) = 0.
#[test]
fn strains_are_compatible() {
    for (profile, bore) in [LINEAR, STEEP, TABLE, ROLLED]
        .iter()
        .flat_map(|p| BORES.map(|bore| (*p, bore)))
    {
        let (blade, named) = paper_with(profile, bore);
        let stress = MembraneStress::new(&blade, &named).unwrap();
        let (e, nu) = (
            blade.material.youngs_modulus_pa,
            blade.material.poisson_ratio,
        );
        let eigen = |r: f64| -> f64 {
            let heat = named
                .temperature
                .as_ref()
                .map_or(0.0, |t| t.expansion_per_k * t.rise_k(&blade, r));
            let inside = |band: &&RollBand| (band.from_radius_m..=band.to_radius_m).contains(&r);
            let rolled = named.roll_tension.iter().filter(inside);
            heat + rolled.map(|band| band.eigenstrain).sum::<f64>()
        };
        let strains = |r: f64| {
            let PlaneStress { radial_pa, hoop_pa } = stress.at(r);
            let free = eigen(r);
            [
                (radial_pa - nu * hoop_pa) / e + free,
                (hoop_pa - nu * radial_pa) / e + free,
            ]
        };
        for r in [0.13, 0.18, 0.222, 0.26, 0.31, 0.35] {
            let step = 1e-6;
            let slope = (strains(r + step)[1] - strains(r - step)[1]) / (2.0 * step);
            let [radial, hoop] = strains(r);
            let residual = slope - (radial - hoop) / r;
            assert!(
                residual.abs() < 1e-7 * 1e-4 / r,
                "{profile} {r}: {residual:e}"
            );
        }
        if bore == Bore::Clamped(InPlane::Fixed) {
            assert!(strains(blade.inner_radius_m)[1].abs() < 1e-17);
        }
    }
}

fn annulus_of(blade: &Blade) -> Annulus {
    Annulus {
        bore_radius_m: blade.inner_radius_m,
        rim_radius_m: blade.outer_radius_m,
    }
}

#[test]
fn a_square_rise_has_the_stress_of_the_textbook() {
    let text = r#"{"temperature": {"expansion_per_k": 1.1e-5, "rim_rise_k": 40, "exponent": 2}}"#;
    let stress = stress_of(text, Bore::Free);
    let blade = stress.blade;
    let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
    let load = 1.1e-5 * 40.0 * blade.material.youngs_modulus_pa;
    for r in [a, 0.15, 0.2, 0.31, b] {
        let expected = annulus_of(&blade).stress_of_square_rise(load, r);
        let found = stress.at(r);
        assert!((found.radial_pa - expected.radial_pa).abs() < 1e-12 * load);
        assert!((found.hoop_pa - expected.hoop_pa).abs() < 1e-12 * load);
    }
}

/// The stress of steady heat conduction from rim to bore is a textbook result; a table of this temperature
/// converges to it with the square of its spacing.
#[test]
fn a_table_of_the_conducted_heat_converges_to_the_textbook() {
    let blade = stress_of(LINEAR, Bore::Free).blade;
    let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
    let logarithm = (b / a).ln();
    let load = 1.2e-5 * 25.0 * blade.material.youngs_modulus_pa;
    let error = |rows: usize| {
        let table: Vec<String> = (0..=rows)
            .map(|k| {
                let r = a + (b - a) * k as f64 / rows as f64;
                let rise = 25.0 * (r / a).ln() / logarithm;
                format!(r#"{{"radius_m": {r}, "rise_k": {rise}}}"#)
            })
            .collect();
        let text = format!(
            r#"{{"temperature": {{"expansion_per_k": 1.2e-5, "table": [{}]}}}}"#,
            table.join(", ")
        );
        let stress = stress_of(&text, Bore::Free);
        let worst = (0..=50).map(|k| {
            let r = a + (b - a) * f64::from(k) / 50.0;
            let expected = annulus_of(&blade).stress_of_conducted_heat(load, r);
            let found = stress.at(r);
            let radial = (found.radial_pa - expected.radial_pa).abs();
            radial.max((found.hoop_pa - expected.hoop_pa).abs()) / load
        });
        worst.fold(0.0, f64::max)
    };
    let (coarse, fine) = (error(50), error(100));
    assert!(fine < 1e-4, "{fine:e}");
    let order = (coarse / fine).log2();
    assert!((order - 2.0).abs() < 0.1, "second order, not {order}");
}

#[test]
fn an_even_temperature_stresses_no_blade_with_free_edges() {
    let even = r#"{"temperature": {"expansion_per_k": 1.2e-5, "rim_rise_k": 80, "exponent": 0,
        "from_radius_m": 0}}"#;
    for bore in BORES {
        let stress = stress_of(even, bore);
        let load = 80.0 * 1.2e-5 * stress.blade.material.youngs_modulus_pa;
        let [a, b] = [stress.blade.inner_radius_m, stress.blade.outer_radius_m];
        for r in [a, 0.2, b] {
            let size = stress.at(r).radial_pa.hypot(stress.at(r).hoop_pa);
            match bore {
                Bore::Clamped(InPlane::Fixed) => assert!(size > 0.01 * load),
                _ => assert!(size < 1e-14 * load, "{size:e} of {load:e}"),
            }
        }
    }
}

/// A rolled band is compressed and stretches the rim; σ_rr is continuous and σ_θθ jumps by E times the
/// eigenstrain.
#[test]
fn a_rolled_band_is_compressed_and_stretches_the_rim() {
    let text = r#"{"roll_tension": [{"radius_m": 0.26, "width_m": 0.02, "eigenstrain": 5e-4}]}"#;
    let stress = stress_of(text, Bore::Free);
    let modulus = stress.blade.material.youngs_modulus_pa;
    let (outside, inside) = (stress.at(0.27 + 1e-12), stress.at(0.27 - 1e-12));
    assert!((outside.radial_pa - inside.radial_pa).abs() < 1e-6 * inside.radial_pa.abs());
    let jump = outside.hoop_pa - inside.hoop_pa;
    assert!((jump / (5e-4 * modulus) - 1.0).abs() < 1e-6);
    assert!(stress.at(0.26).hoop_pa < 0.0);
    // The band exerts an outward force on the ring outside it and on the ring inside it.
    assert!(outside.radial_pa < 0.0 && stress.at(0.25).radial_pa > 0.0);
    assert!(stress.at(0.355).hoop_pa > 0.0);
}

/// Adjacent bands approximate a table with the square of their width.
#[test]
fn bands_side_by_side_become_a_temperature() {
    let (blade, named) = paper_with(LINEAR, Bore::Clamped(InPlane::Fixed));
    let smooth = MembraneStress::new(&blade, &named).unwrap();
    let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
    let temperature = named.temperature.clone().unwrap();
    let distance = |count: usize| {
        let step = (b - a) / count as f64;
        let band = |k: usize| {
            let from_radius_m = a + step * k as f64;
            let middle = from_radius_m + 0.5 * step;
            RollBand {
                from_radius_m,
                to_radius_m: from_radius_m + step,
                eigenstrain: temperature.expansion_per_k * temperature.rise_k(&blade, middle),
            }
        };
        let bands: Vec<RollBand> = (0..count).map(band).collect();
        let stairs = MembraneStress::new(&blade, &Membrane::of_bands(&bands)).unwrap();
        let basis = RadialBasis::new(&blade, 6);
        let [one, other] = [&stairs, &smooth].map(|s| membrane_stiffness(&basis, s, 0..=3));
        (&one[3] - &other[3]).norm() / other[3].norm()
    };
    let order = (distance(20) / distance(40)).log2();
    assert!((order - 2.0).abs() < 0.15, "{order}");
}

/// Twice the points change no integral of a basis of twelve functions, because panels end at every kink.
#[test]
fn the_quadrature_resolves_kinks_and_bands() {
    for (profile, bore) in PROFILES.iter().flat_map(|p| BORES.map(|bore| (*p, bore))) {
        let stress = stress_of(profile, bore);
        let basis = RadialBasis::new(&stress.blade, 12);
        let points = stress.points(12);
        let [usual, dense] =
            [points, 2 * points].map(|points| stiffness_with(&basis, &stress, 0..=6, points));
        for (n, (usual, dense)) in usual.iter().zip(&dense).enumerate() {
            let error = (usual - dense).norm() / dense.norm();
            let tolerance = if profile == ROOT { 1e-9 } else { 1e-12 };
            assert!(error <= tolerance, "{profile} {bore:?} n = {n}: {error:e}");
        }
        // Without panels the kinks alone would cause a larger error.
        if profile == ROLLED {
            let blind: f64 = basis
                .rule()
                .iter()
                .map(|(r, w)| w * stress.at(r).hoop_pa)
                .sum();
            let exact = stress.blade.outer_radius_m
                * stress.at(stress.blade.outer_radius_m).radial_pa
                - stress.blade.inner_radius_m * stress.at(stress.blade.inner_radius_m).radial_pa;
            assert!((blind - exact).abs() > 1e3, "{blind}");
        }
    }
}

/// A stress between free edges does no work on the tilt, to rounding by quadrature alone, before exact zeros are set.
#[test]
fn the_stress_does_no_work_on_the_tilt() {
    for profile in PROFILES {
        let stress = stress_of(profile, Bore::Free);
        let basis = RadialBasis::new(&stress.blade, 8);
        let mut work = [0.0; 3];
        let mut size = 0.0;
        for panel in stress.knots_m().windows(2) {
            for (r, w) in quadrature::graded(panel[0], panel[1], 40).iter() {
                let f = basis.evaluate(1, r);
                let at = stress.at(r);
                for (j, work) in work.iter_mut().enumerate() {
                    *work += w * r * at.radial_pa * f.slope[0] * f.slope[j]
                        + w / r * at.hoop_pa * f.value[0] * f.value[j];
                }
                size += w / r * at.hoop_pa.abs() * f.value[0].powi(2);
            }
        }
        let worst = work.iter().fold(0.0_f64, |top, x| top.max(x.abs()));
        assert!(worst < 1e-9 * size, "{profile}: {worst:e} of {size:e}");
    }
}

#[test]
fn a_stress_of_zero_is_not_assembled() {
    let zero = r#"{"temperature": {"expansion_per_k": 1.2e-5, "rim_rise_k": 0},
        "roll_tension": [{"radius_m": 0.26, "width_m": 0.02, "eigenstrain": 0}],
        "residual_stress": [{"radius_m": 0.2, "hoop_pa": 0}]}"#;
    let (blade, named) = paper_with(zero, Bore::Free);
    assert!(MembraneStress::new(&blade, &named).is_none());
    let resolution = Resolution {
        max_diameters: 3,
        radial_functions: 3,
    };
    let plate = Plate::new(&Scene::paper(), resolution);
    assert!(plate.membrane.is_none() && plate.harmonics.iter().all(|h| h.membrane.is_none()));
}

#[test]
fn a_measured_table_keeps_its_hoop_stress_but_for_the_mean() {
    let (blade, named) = paper_with(MEASURED, Bore::Free);
    let residual = named.residual_stress.unwrap();
    assert!(residual.imbalance.abs() < 0.05 && residual.imbalance != 0.0);
    let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
    assert!(residual.hoop_pa.integral(a, b).abs() < 1e-9 * residual.hoop_pa.size(a, b));
}
