//! The light gap, compared with the series of a plate on two points, and its dependence on roll tension.

use super::*;
use crate::model::analytical::two_points::PlateOnTwoPoints;
use crate::model::scene::Scene;

fn edge(
    membrane: &str,
    change: impl FnOnce(&mut crate::model::scene::SceneFile),
) -> (StraightEdge, Vec<RollBand>) {
    let scene = Scene::paper()
        .edited(|file| {
            file.membrane = Some(serde_json::from_str(membrane).unwrap());
            change(file);
        })
        .unwrap_or_else(|error| panic!("{error}"));
    let membrane = scene.membrane().unwrap().clone();
    (membrane.straight_edge.unwrap(), membrane.roll_tension)
}

const PLAIN: &str = r#"{"straight_edge": {}}"#;
const ROLLED: &str = r#"{"straight_edge": {}, "roll_tension": [
    {"radius_m": 0.22, "width_m": 0.02, "eigenstrain": 3e-4}]}"#;

/// Gap and sag are those of the exact series, for the paper's bore and for a bore of a twentieth of the rim.
#[test]
fn a_plain_blade_has_the_gap_of_the_series() {
    for bore_m in [0.2, 0.035] {
        let (edge, bands) = edge(PLAIN, |file| file.blade.inner_diameter_m = bore_m);
        let blade = edge.blade;
        let plate = PlateOnTwoPoints {
            inner_radius_m: blade.inner_radius_m,
            outer_radius_m: blade.outer_radius_m,
            rigidity_n_m: blade.flexural_rigidity_n_m(),
            poisson_ratio: blade.material.poisson_ratio,
            weight_n_per_m2: GRAVITY_M_PER_S2 * blade.mass_per_area_kg_per_m2(),
        };
        let right = std::f64::consts::FRAC_PI_2;
        let middle = plate.height_m(blade.inner_radius_m, right);
        let gap = plate.height_m(blade.outer_radius_m, right) - middle;
        let found = StraightEdgeReading::new(&edge, &bands).unwrap().plain;
        println!("{bore_m}: {found:?}, series {gap} {middle}");
        assert!((found.gap_m / gap - 1.0).abs() < 1e-4, "{found:?} {gap}");
        assert!(
            (found.sag_m / -middle - 1.0).abs() < 1e-3,
            "{found:?} {middle}"
        );
    }
}

/// A larger basis changes the gap of a rolled blade by less than 1e-4 of the gap of the plain blade.
#[test]
fn the_gap_of_a_rolled_blade_has_converged() {
    let (edge, bands) = edge(ROLLED, |_| ());
    let at = |resolution| LyingBlade::new(&edge, &bands, resolution).at(1.0).unwrap();
    let plain = LyingBlade::new(&edge, &[], RESOLUTION).at(0.0).unwrap();
    let larger = Resolution {
        max_diameters: 100,
        radial_functions: 36,
    };
    let (usual, fine) = (at(RESOLUTION), at(larger));
    println!("{usual:?} {fine:?} {plain:?}");
    assert!((usual.gap_m - fine.gap_m).abs() < 1e-4 * plain.gap_m.abs());
}

/// Gap of a uniform blade by `count` cubic Hermite elements over the radius between any two knots, with the weight as a
/// pressure and the reactions as line loads at the rim.
fn gap_by_elements(edge: &StraightEdge, bands: &[RollBand], count: usize) -> f64 {
    let blade = &edge.blade;
    let stress = MembraneStress::new(blade, &Membrane::of_bands(bands)).unwrap();
    let knots = stress.knots_m();
    let mut nodes = vec![knots[0]];
    for panel in knots.windows(2) {
        let step = (panel[1] - panel[0]) / count as f64;
        nodes.extend((1..=count).map(|k| panel[0] + step * k as f64));
    }
    let (rigidity, nu) = (blade.flexural_rigidity_n_m(), blade.material.poisson_ratio);
    let pressure = GRAVITY_M_PER_S2 * blade.mass_per_area_kg_per_m2();
    let (weight, last) = (GRAVITY_M_PER_S2 * blade.mass_kg(), 2 * nodes.len() - 2);
    let mut gap = 0.0;
    for n in (0..=80).step_by(2) {
        let n2 = f64::from(n * n);
        let mut stiffness = DMatrix::<f64>::zeros(last + 2, last + 2);
        let mut load = DVector::<f64>::zeros(last + 2);
        for (k, pair) in nodes.windows(2).enumerate() {
            let length = pair[1] - pair[0];
            for (r, w) in crate::model::plate::quadrature::smooth(pair[0], pair[1], 6).iter() {
                let x = (r - pair[0]) / length;
                let value = [
                    1.0 - 3.0 * x * x + 2.0 * x * x * x,
                    length * (x - 2.0 * x * x + x * x * x),
                    3.0 * x * x - 2.0 * x * x * x,
                    length * (x * x * x - x * x),
                ];
                let slope = [
                    6.0 * (x * x - x) / length,
                    1.0 - 4.0 * x + 3.0 * x * x,
                    6.0 * (x - x * x) / length,
                    3.0 * x * x - 2.0 * x,
                ];
                let curvature = [
                    (12.0 * x - 6.0) / (length * length),
                    (6.0 * x - 4.0) / length,
                    (6.0 - 12.0 * x) / (length * length),
                    (6.0 * x - 2.0) / length,
                ];
                let hoop = [0, 1, 2, 3].map(|i| slope[i] / r - n2 * value[i] / (r * r));
                let twist = [0, 1, 2, 3].map(|i| slope[i] / r - value[i] / (r * r));
                let at = stress.at(r);
                for i in 0..4 {
                    load[2 * k + i] -= if n == 0 {
                        w * r * pressure * value[i]
                    } else {
                        0.0
                    };
                    for j in 0..4 {
                        let bending = curvature[i] * curvature[j]
                            + hoop[i] * hoop[j]
                            + nu * (curvature[i] * hoop[j] + hoop[i] * curvature[j])
                            + 2.0 * (1.0 - nu) * n2 * twist[i] * twist[j];
                        let tension = at.radial_pa * slope[i] * slope[j]
                            + n2 * at.hoop_pa * value[i] * value[j] / (r * r);
                        stiffness[(2 * k + i, 2 * k + j)] +=
                            w * r * (rigidity * bending + blade.thickness_m * tension);
                    }
                }
            }
        }
        let angular = if n == 0 { 2.0 } else { 1.0 } * std::f64::consts::PI;
        load[last] += weight / angular;
        if n == 0 {
            // Heave is free, so that a stiff spring fixes the bore.
            stiffness[(0, 0)] *= 1e12;
        }
        let found = stiffness.lu().solve(&load).unwrap();
        let across = if n % 4 == 0 { 1.0 } else { -1.0 };
        gap += across * (found[last] - found[0]);
    }
    gap
}

/// The factors range from no rolling to seven tenths of buckling.
#[test]
fn finite_elements_give_the_same_gap() {
    let (edge, bands) = edge(ROLLED, |_| ());
    let lying = LyingBlade::new(&edge, &bands, RESOLUTION);
    for factor in [1e-9, 1.0, 4.0] {
        let scaled = |band: &RollBand| RollBand {
            eigenstrain: factor * band.eigenstrain,
            ..*band
        };
        let bands: Vec<RollBand> = bands.iter().map(scaled).collect();
        let (gap, elements) = (
            lying.at(factor).unwrap().gap_m,
            gap_by_elements(&edge, &bands, 12),
        );
        println!("{factor}: {gap} {elements}");
        assert!(
            (gap - elements).abs() < 2e-4 * elements.abs(),
            "{factor}: {gap} {elements}"
        );
    }
}

/// Rolling raises the gap from that of the plain blade without limit towards buckling. There the inverse of the gap falls
/// in proportion to the distance from buckling (Southwell), because the dish is the shape that buckles.
#[test]
fn the_gap_rises_with_the_rolling_up_to_buckling() {
    let (edge, bands) = edge(ROLLED, |_| ());
    let lying = LyingBlade::new(&edge, &bands, RESOLUTION);
    let buckling = lying.buckling_factor().unwrap().unwrap();
    let gap = |share: f64| lying.at(share * buckling).unwrap().gap_m;
    let gaps: Vec<f64> = (0..=18).map(|k| gap(0.05 * f64::from(k))).collect();
    println!("{buckling} {gaps:?}");
    assert!(gaps.windows(2).all(|pair| pair[0] < pair[1]));
    assert!(gaps[0] < 0.0 && gaps[18] > 0.0);
    let near = gap(1.0 - 1e-4) / gap(1.0 - 2e-4);
    assert!((near - 2.0).abs() < 1e-2, "{near}");
    assert!(lying.at(1.001 * buckling).is_none());
}

/// The computed gap of a blade, given as the measured gap of a blade with another eigenstrain, gives the first
/// eigenstrain.
#[test]
fn a_measured_gap_gives_the_eigenstrain_that_causes_it() {
    let (first, bands) = edge(ROLLED, |_| ());
    let gap_m = StraightEdgeReading::new(&first, &bands)
        .unwrap()
        .rolled
        .unwrap()
        .gap_m;
    let text = ROLLED
        .replace("3e-4", "1e-5")
        .replace("{}", &format!("{{\"measured_gap_m\": {gap_m}}}"));
    let (again, bands_again) = edge(&text, |_| ());
    let (factor, found) = StraightEdgeReading::new(&again, &bands_again)
        .unwrap()
        .measured
        .unwrap();
    assert!((factor / 30.0 - 1.0).abs() < 1e-9, "{factor}");
    assert!((found.gap_m - gap_m).abs() < 1e-12);
}

#[test]
fn a_gap_that_no_rolling_causes_is_refused_with_the_range_of_gaps() {
    for gap in ["-0.01", "0.9"] {
        let text = ROLLED.replace("{}", &format!("{{\"measured_gap_m\": {gap}}}"));
        let (edge, bands) = edge(&text, |_| ());
        let refused = StraightEdgeReading::new(&edge, &bands)
            .unwrap_err()
            .to_string();
        assert!(
            refused.contains("membrane.straight_edge.measured_gap_m must be")
                && refused.contains("between -0.000748"),
            "{refused}"
        );
    }
}

/// A wave whose eigenproblem fails might be the one that buckles first: the factor of the others is not that of the blade.
#[test]
fn no_wave_is_left_out_of_the_buckling_factor() {
    let (edge, bands) = edge(ROLLED, |_| ());
    for fault in [-1.0, f64::NAN] {
        let mut lying = LyingBlade::new(&edge, &bands, RESOLUTION);
        lying.waves[2].bending *= fault;
        assert!(lying.buckling_factor().is_err(), "{fault}");
    }
}
