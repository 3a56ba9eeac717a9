//! Each harmonic in the equations of plane stress, evaluated by finite differences.

use std::f64::consts::{PI, TAU};

use super::*;
use crate::model::analytical::pressed_disk;
use crate::model::scene::Scene;

pub const LOADS: [RimForce; 3] = [
    RimForce {
        angle_rad: 0.3,
        radial_n: -150.0,
        tangential_n: -1200.0,
    },
    RimForce {
        angle_rad: 0.5,
        radial_n: -80.0,
        tangential_n: -900.0,
    },
    RimForce {
        angle_rad: -2.1,
        radial_n: 400.0,
        tangential_n: 250.0,
    },
];
/// Forces at the bore that do not balance the loads.
const REACTION: [BoreForce; 2] = [
    BoreForce {
        angle_rad: 1.4,
        radial_n: 300.0,
        tangential_n: 2000.0,
    },
    BoreForce {
        angle_rad: -0.7,
        radial_n: -500.0,
        tangential_n: 900.0,
    },
];
const ORDERS: [usize; 8] = [0, 1, 2, 3, 5, 12, 31, 48];

pub fn blade_with(ratio: f64) -> Blade {
    let mut blade = *Scene::paper().blade();
    blade.inner_radius_m = ratio * blade.outer_radius_m;
    blade
}

/// The paper's ring, a ring with a very small hole, and a narrow ring.
fn blades() -> [Blade; 3] {
    [200.0 / 710.0, 0.1, 0.8].map(blade_with)
}

/// First and second derivative by fourth-order central differences.
fn derivatives(f: impl Fn(f64) -> f64, x: f64, step: f64) -> [f64; 2] {
    let [low2, low, mid, high, high2] = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| f(x + k * step));
    [
        (8.0 * (high - low) - (high2 - low2)) / (12.0 * step),
        (16.0 * (high + low) - (high2 + low2) - 30.0 * mid) / (12.0 * step * step),
    ]
}

/// Calls `check` with order, radius and a step that resolves r^m, at radii over the whole blade.
fn everywhere(blade: &Blade, mut check: impl FnMut(&EdgeStress, usize, f64, f64)) {
    let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
    for reaction in [&[][..], &REACTION] {
        let stress = EdgeStress::with_reaction(blade, &LOADS, reaction, 48);
        for order in ORDERS {
            for share in [0.05, 0.4, 0.7, 0.95] {
                let r = a + share * (b - a);
                check(&stress, order, r, 3e-3 * r / (order as f64 + 2.0));
            }
        }
    }
}

fn size(stress: &HarmonicStress) -> f64 {
    [stress.radial_pa, stress.hoop_pa, stress.shear_pa]
        .as_flattened()
        .iter()
        .fold(0.0, |max, s| s.abs().max(max))
}

#[test]
fn every_harmonic_is_in_equilibrium() {
    for blade in blades() {
        everywhere(&blade, |stress, order, r, step| {
            let m = order as f64;
            let here = stress.harmonic(order, r);
            let scale = (m + 2.0) * size(&here);
            // The derivative ∂θ of the amplitudes (c, s) of cos mθ and sin mθ is (m s, −m c).
            let turned = |[cos, sin]: [f64; 2]| [m * sin, -m * cos];
            let (shear_turned, hoop_turned) = (turned(here.shear_pa), turned(here.hoop_pa));
            for part in 0..2 {
                let [radial_slope, _] =
                    derivatives(|r| stress.harmonic(order, r).radial_pa[part], r, step);
                let [shear_slope, _] =
                    derivatives(|r| stress.harmonic(order, r).shear_pa[part], r, step);
                let along_radius = r * radial_slope + shear_turned[part] + here.radial_pa[part]
                    - here.hoop_pa[part];
                let along_circle = r * shear_slope + hoop_turned[part] + 2.0 * here.shear_pa[part];
                for residual in [along_radius, along_circle] {
                    assert!(
                        residual.abs() <= 1e-9 * scale,
                        "{order} {r} {residual} {scale}"
                    );
                }
            }
        });
    }
}

/// ∇²(σ_rr + σ_θθ) = 0, the compatibility of plane stress without body force.
#[test]
fn every_harmonic_is_compatible() {
    for blade in blades() {
        everywhere(&blade, |stress, order, r, step| {
            let m2 = (order * order) as f64;
            for part in 0..2 {
                let sum = |r: f64| {
                    let stress = stress.harmonic(order, r);
                    stress.radial_pa[part] + stress.hoop_pa[part]
                };
                let [slope, curvature] = derivatives(sum, r, step);
                let laplacian = r * r * curvature + r * slope - m2 * sum(r);
                let scale = (m2 + 4.0) * size(&stress.harmonic(order, r));
                assert!(
                    laplacian.abs() <= 1e-8 * scale,
                    "{order} {r} {laplacian} {scale}"
                );
            }
        });
    }
}

/// u = U cos θ, v = V sin θ exists only if γ = V′ − (V + U)/r with U′ = ε_rr and V + U = r ε_θθ, that is γ =
/// r ε_θθ′ − ε_rr: the displacement is single-valued around the bore.
#[test]
fn the_net_force_leaves_the_displacement_single_valued() {
    for poisson_ratio in [-0.5, 0.0, 0.29, 0.49] {
        for mut blade in blades() {
            blade.material.poisson_ratio = poisson_ratio;
            let stress = EdgeStress::with_reaction(&blade, &LOADS, &REACTION, 1);
            // The strains ε_rr, ε_θθ, γ of (cos, cos, sin) and of (sin, sin, −cos), times E.
            let strain = |r: f64, part: usize| {
                let s = stress.harmonic(1, r);
                let (radial, hoop) = (s.radial_pa[part], s.hoop_pa[part]);
                let shear = [s.shear_pa[1], -s.shear_pa[0]][part];
                [
                    radial - poisson_ratio * hoop,
                    hoop - poisson_ratio * radial,
                    2.0 * (1.0 + poisson_ratio) * shear,
                ]
            };
            let r = 0.5 * (blade.inner_radius_m + blade.outer_radius_m);
            for part in 0..2 {
                let [radial, _, shear] = strain(r, part);
                let [hoop_slope, _] = derivatives(|r| strain(r, part)[1], r, 1e-3 * r);
                let gap = r * hoop_slope - radial - shear;
                let scale = size(&stress.harmonic(1, r));
                assert!(
                    gap.abs() < 1e-9 * scale,
                    "{poisson_ratio}: {gap} of {scale}"
                );
            }
        }
    }
}

fn assert_close(left: [f64; 2], right: [f64; 2], tolerance: f64) {
    for (x, y) in left.into_iter().zip(right) {
        assert!(
            (x - y).abs() <= tolerance,
            "{left:?} is not {right:?} to {tolerance}"
        );
    }
}

/// At the rim the stress has the Fourier coefficients of the load; at the bore it is the reaction of m = 0
/// and 1 only.
#[test]
fn the_edges_carry_the_loads_and_the_reaction() {
    for blade in blades() {
        let (a, b, h) = (
            blade.inner_radius_m,
            blade.outer_radius_m,
            blade.thickness_m,
        );
        let stress = EdgeStress::new(&blade, &LOADS, 48);
        let sum = |f: &dyn Fn(&RimForce) -> f64| LOADS.iter().map(f).sum::<f64>();
        let torque = b * sum(&|load| load.tangential_n);
        let force_x = sum(&|l| l.radial_n * l.angle_rad.cos() - l.tangential_n * l.angle_rad.sin());
        let force_y = sum(&|l| l.radial_n * l.angle_rad.sin() + l.tangential_n * l.angle_rad.cos());
        for order in ORDERS {
            let m = order as f64;
            let (rim, bore) = (stress.harmonic(order, b), stress.harmonic(order, a));
            let norm = PI * b * h * if order == 0 { 2.0 } else { 1.0 };
            let tolerance = 1e-11 * size(&rim).max(size(&bore));
            let coefficients = |f: &dyn Fn(&RimForce) -> f64| {
                [
                    sum(&|l| f(l) * (m * l.angle_rad).cos()) / norm,
                    sum(&|l| f(l) * (m * l.angle_rad).sin()) / norm,
                ]
            };
            assert_close(rim.radial_pa, coefficients(&|l| l.radial_n), tolerance);
            assert_close(rim.shear_pa, coefficients(&|l| l.tangential_n), tolerance);
            let per_area = 1.0 / (2.0 * PI * a * h);
            let (radial, shear) = match order {
                0 => ([0.0; 2], [torque * per_area / a, 0.0]),
                1 => (
                    [force_x * per_area, force_y * per_area],
                    [force_y * per_area, -force_x * per_area],
                ),
                _ => ([0.0; 2], [0.0; 2]),
            };
            assert_close(bore.radial_pa, radial, tolerance);
            assert_close(bore.shear_pa, shear, tolerance);
        }
    }
}

/// With forces at the bore the stress there has their Fourier coefficients for m > 1; for m = 1 the rest of
/// the net force is added, half as pressure, half as shear.
#[test]
fn the_bore_carries_the_forces_given_there() {
    for blade in blades() {
        let (a, h) = (blade.inner_radius_m, blade.thickness_m);
        let given = EdgeStress::with_reaction(&blade, &LOADS, &REACTION, 48);
        let assumed = EdgeStress::new(&blade, &LOADS, 48);
        let sum = |f: &dyn Fn(&BoreForce) -> f64| REACTION.iter().map(f).sum::<f64>();
        for order in ORDERS {
            let m = order as f64;
            let (with, without) = (given.harmonic(order, a), assumed.harmonic(order, a));
            let tolerance = 1e-11 * size(&with).max(size(&without));
            let norm = PI * a * h * if order == 0 { 2.0 } else { 1.0 };
            let coefficients = |f: &dyn Fn(&BoreForce) -> f64| {
                [
                    -sum(&|l| f(l) * (m * l.angle_rad).cos()) / norm,
                    -sum(&|l| f(l) * (m * l.angle_rad).sin()) / norm,
                ]
            };
            let [q, s] = [
                coefficients(&|l| l.radial_n),
                coefficients(&|l| l.tangential_n),
            ];
            let added = |now: [f64; 2], before: [f64; 2]| [now[0] - before[0], now[1] - before[1]];
            let radial = added(with.radial_pa, without.radial_pa);
            let shear = added(with.shear_pa, without.shear_pa);
            let (expected_radial, expected_shear) = match order {
                0 => (q, [0.0; 2]),
                1 => {
                    let even = [0.5 * (q[0] + s[1]), 0.5 * (q[1] - s[0])];
                    (even, [-even[1], even[0]])
                }
                _ => (q, s),
            };
            assert_close(radial, expected_radial, tolerance);
            assert_close(shear, expected_shear, tolerance);
        }
        let rim = blade.outer_radius_m;
        for order in ORDERS {
            let (with, without) = (given.harmonic(order, rim), assumed.harmonic(order, rim));
            let tolerance = 1e-11 * size(&with).max(size(&without));
            assert_close(with.radial_pa, without.radial_pa, tolerance);
            assert_close(with.shear_pa, without.shear_pa, tolerance);
        }
    }
}

/// The cases are orders whose powers underflow, the narrowest rings of a scene, and forces that are not finite.
#[test]
fn extreme_rings_and_loads_cause_no_panic() {
    for ratio in [1e-26, 1e-3, 0.99, 0.999] {
        let blade = blade_with(ratio);
        let stress = EdgeStress::new(&blade, &LOADS, 200);
        for order in 0..=200 {
            let bore = stress.harmonic(order, blade.inner_radius_m);
            assert!(size(&bore).is_finite(), "{ratio} {order}");
        }
    }
    let infinite = RimForce {
        radial_n: f64::INFINITY,
        ..LOADS[0]
    };
    let stress = EdgeStress::new(&blade_with(0.5), &[infinite], 4);
    assert!(!stress.at(0.3, 0.0)[0].is_finite());
    assert_eq!(stress.harmonic(5, 0.3), HarmonicStress::default());
}

/// A hole of a/b = 10⁻⁴ changes the stress of a full disk by (a/r)².
#[test]
fn a_pin_hole_is_a_disk_under_two_forces() {
    let blade = blade_with(1e-4);
    let (b, h, push) = (blade.outer_radius_m, blade.thickness_m, 1000.0);
    let loads = [0.0, PI].map(|angle_rad| RimForce {
        angle_rad,
        radial_n: -push,
        tangential_n: 0.0,
    });
    let stress = EdgeStress::new(&blade, &loads, 60);
    for (r, angle) in [(0.3 * b, 0.0), (0.4 * b, 1.1), (0.5 * b, TAU / 3.0)] {
        let closed = pressed_disk::stress_pa(b, h, push, r, angle);
        for (series, closed) in stress.at(r, angle).into_iter().zip(closed) {
            assert!(
                (series - closed).abs() < 1e-6 * push / (b * h),
                "{series} {closed}"
            );
        }
    }
}
