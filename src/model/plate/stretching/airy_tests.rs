//! References that use no displacements: lower bounds by truncated series of Airy's stress function, and
//! rings by a shooting method.

use std::f64::consts::PI;

use faer::linalg::solvers::Solve;
use faer::{Col, Mat};

use super::test_blades::{Wave, collar, plate, profiled, projected};
use super::*;
use crate::model::plate::quadrature;
use crate::model::scene::{Blade, InPlane};

/// A function and its first and second derivative at one radius.
type Jet = [f64; 3];
/// Number n of nodal diameters, and the radial factor of cos nθ.
type EvenWave<'a> = (usize, &'a dyn Fn(f64) -> Jet);
/// Radius, step, and [S, V].
type Marched = (f64, f64, [f64; 2]);

/// Radial factors ψ of cos mθ in Airy's function for free edges: F and its slope vanish at the rim; at the
/// bore they are those of a linear function, which exerts no force.
fn stress_functions(blade: &Blade, order: usize, count: usize, r: f64) -> Vec<Jet> {
    let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
    let product = |x: Jet, y: Jet| {
        [
            x[0] * y[0],
            x[1] * y[0] + x[0] * y[1],
            x[2] * y[0] + 2.0 * x[1] * y[1] + x[0] * y[2],
        ]
    };
    let line = |root: f64| [r - root, 1.0, 0.0];
    let square = |root: f64| product(line(root), line(root));
    let mapped: Jet = [(2.0 * r - a - b) / (b - a), 2.0 / (b - a), 0.0];
    let mut functions = Vec::new();
    // The bowl (b − r)²(r − c) has zero slope at a.
    let bowl = product(square(b), line(a + 0.5 * (a - b)));
    match order {
        0 => functions.push(bowl),
        1 => functions.push(product(line(0.0), bowl)),
        _ => (),
    }
    let mut next = product(square(a), square(b));
    while functions.len() < count {
        functions.push(next);
        next = product(next, mapped);
    }
    functions
}

/// Energy of the best truncated series for w = Σ wₙ(r) cos nθ. Its stresses are in equilibrium, so that it
/// does not exceed U₄.
fn lower_bound(blade: &Blade, waves: &[EvenWave<'_>], count: usize) -> f64 {
    let e = blade.material.youngs_modulus_pa;
    let highest = 2 * waves.iter().map(|wave| wave.0).max().unwrap();
    let mut energy = 0.0;
    for m in 0..=highest {
        let turn = if m == 0 { 2.0 * PI } else { PI };
        let mut compliance: Mat<f64> = Mat::zeros(count, count);
        let mut work: Col<f64> = Col::zeros(count);
        for (r, w) in quadrature::piecewise(&blade.edges_m(), 40).iter() {
            let m2 = (m * m) as f64;
            let functions = stress_functions(blade, m, count, r);
            // The strains do work on the stresses F′/r − m²F/r², F″ and m(F/r)′.
            let strain = strain_of(waves, m, r);
            for (i, f) in functions.iter().enumerate() {
                let laplacian = |f: &Jet| f[2] + f[1] / r - m2 * f[0] / (r * r);
                let radial = f[1] / r - m2 * f[0] / (r * r);
                let shear = m as f64 * (f[1] / r - f[0] / (r * r));
                let on = radial * strain[0] + f[2] * strain[1] + shear * strain[2];
                work[i] += turn * w * r * on;
                for (k, g) in functions.iter().enumerate() {
                    compliance[(i, k)] +=
                        turn * w * r * laplacian(f) * laplacian(g) / (e * blade.thickness_m);
                }
            }
        }
        // The powers are badly scaled; each is normalized by its own energy.
        let unit: Vec<f64> = (0..count)
            .map(|i| compliance[(i, i)].sqrt().recip())
            .collect();
        let scaled = Mat::from_fn(count, count, |i, k| compliance[(i, k)] * unit[i] * unit[k]);
        let scaled_work = Col::from_fn(count, |i| work[i] * unit[i]);
        let solution = scaled.partial_piv_lu().solve(&scaled_work);
        energy += 0.5 * (solution.transpose() * &scaled_work);
    }
    energy
}

/// Factors of cos mθ, cos mθ and sin mθ of w_r²/2, w_θ²/2r² and w_r w_θ/r, w even in θ.
fn strain_of(waves: &[EvenWave<'_>], m: usize, r: f64) -> [f64; 3] {
    let points = 64;
    let mut strain = [0.0; 3];
    for k in 0..points {
        let angle = 2.0 * PI * f64::from(k) / f64::from(points);
        let (mut slope, mut hoop) = (0.0, 0.0);
        for (n, of_radius) in waves {
            let (sin, cos) = (*n as f64 * angle).sin_cos();
            let w = of_radius(r);
            slope += w[1] * cos;
            hoop -= *n as f64 * w[0] * sin / r;
        }
        let (sin, cos) = (m as f64 * angle).sin_cos();
        let share = if m == 0 { 1.0 } else { 2.0 } / f64::from(points);
        strain[0] += share * cos * 0.5 * slope * slope;
        strain[1] += share * cos * 0.5 * hoop * hoop;
        strain[2] += share * sin * slope * hoop;
    }
    strain
}

/// The bound rises towards U₄ and does not exceed it: exact displacements and admissible stresses enclose the
/// energy.
#[test]
fn truncated_stress_functions_bound_it_from_below() {
    let plate = plate([4, 8], |_| ());
    let stretching = Stretching::new(&plate).unwrap();
    let bowl = |r: f64| [r * r * (1.0 - r), 2.0 * r - 3.0 * r * r, 2.0 - 6.0 * r];
    let tilt = |r: f64| [0.3 * r * r, 0.6 * r, 0.6];
    let saddle = |r: f64| [r.powi(3), 3.0 * r * r, 6.0 * r];
    let shapes: [&[EvenWave<'_>]; 4] = [
        &[(0, &bowl)],
        &[(2, &saddle)],
        &[(1, &tilt), (2, &saddle)],
        &[(0, &bowl), (1, &tilt), (4, &saddle)],
    ];
    for waves in shapes {
        let values: Vec<Box<dyn Fn(f64) -> f64>> = waves
            .iter()
            .map(|(_, of_radius)| Box::new(move |r| of_radius(r)[0]) as Box<dyn Fn(f64) -> f64>)
            .collect();
        let zero: &dyn Fn(f64) -> f64 = &|_| 0.0;
        let projected_waves: Vec<Wave<'_>> = waves
            .iter()
            .zip(&values)
            .map(|((n, _), value)| (*n, [value.as_ref(), zero]))
            .collect();
        let energy = stretching
            .energy_j(&projected(&plate, &projected_waves))
            .unwrap();
        let mut before = 0.0;
        for count in [2, 4, 6, 9, 12] {
            let bound = lower_bound(&plate.blade, waves, count);
            assert!(bound <= energy * (1.0 + 1e-9), "{count}: {bound} {energy}");
            assert!(bound >= before * (1.0 - 1e-9), "{count}: {bound} {before}");
            before = bound;
        }
        assert!((before / energy - 1.0).abs() < 1e-6, "{before} {energy}");
    }
}

/// Energy of w(r) on a ring of varying thickness, by a shooting method: S = r h σ_rr and V = E u, with S′ =
/// hV/r + νS/r and V′ = (1 − ν²)σ_rr − νV/r − Ew′²/2, both continuous at a step.
fn by_shooting(blade: &Blade, slope: &dyn Fn(f64) -> f64) -> f64 {
    let (e, nu) = (
        blade.material.youngs_modulus_pa,
        blade.material.poisson_ratio,
    );
    // S and V at all steps, from given values at the bore, with or without forcing.
    let march = |start: [f64; 2], forced: f64| {
        let mut states = Vec::new();
        let [mut s, mut v] = start;
        for ends in blade.edges_m().windows(2) {
            let steps = 400;
            let step = (ends[1] - ends[0]) / f64::from(steps);
            let rate = |r: f64, [s, v]: [f64; 2]| {
                // The radius stays within the piece despite rounding.
                let inside = r.clamp(ends[0] + 1e-9, ends[1]);
                let h = blade.thickness_at_m(inside);
                let radial = s / (r * h);
                let force = forced * 0.5 * e * slope(r).powi(2);
                [
                    h * v / r + nu * s / r,
                    (1.0 - nu * nu) * radial - nu * v / r - force,
                ]
            };
            for k in 0..steps {
                let r = ends[0] + f64::from(k) * step;
                states.push((r, step, [s, v]));
                let k1 = rate(r, [s, v]);
                let k2 = rate(
                    r + 0.5 * step,
                    [s + 0.5 * step * k1[0], v + 0.5 * step * k1[1]],
                );
                let k3 = rate(
                    r + 0.5 * step,
                    [s + 0.5 * step * k2[0], v + 0.5 * step * k2[1]],
                );
                let k4 = rate(r + step, [s + step * k3[0], v + step * k3[1]]);
                s += step / 6.0 * (k1[0] + 2.0 * (k2[0] + k3[0]) + k4[0]);
                v += step / 6.0 * (k1[1] + 2.0 * (k2[1] + k3[1]) + k4[1]);
            }
            states.push((ends[1], 0.0, [s, v]));
        }
        states
    };
    // S or V is unknown at the bore, and S vanishes at the rim.
    let free = match blade.bore {
        crate::model::scene::Bore::Clamped(InPlane::Fixed) => [1.0, 0.0],
        _ => [0.0, 1.0],
    };
    let (forced, natural) = (march([0.0; 2], 1.0), march(free, 0.0));
    let share = -forced.last().unwrap().2[0] / natural.last().unwrap().2[0];
    // The work of the stress on w′²/2 is twice the energy: ½∫σ:E, and ∫σ:ε(u) = 0.
    let density = |(forced, natural): (&Marched, &Marched)| {
        let (r, _, [s, _]) = *forced;
        0.5 * 2.0 * PI * (s + share * natural.2[0]) * 0.5 * slope(r).powi(2)
    };
    let values: Vec<(f64, f64)> = forced
        .iter()
        .zip(&natural)
        .map(|pair| (pair.0.1, density(pair)))
        .collect();
    // Simpson's rule on pairs of steps; the last state of a piece starts no step.
    let mut energy = 0.0;
    let mut at = 0;
    while at + 2 < values.len() {
        let step = values[at].0;
        energy += step / 3.0 * (values[at].1 + 4.0 * values[at + 1].1 + values[at + 2].1);
        at += if values[at + 2].0 == 0.0 { 3 } else { 2 };
    }
    energy
}

#[test]
fn steps_tapers_and_collars_have_the_energy_of_a_shooting_method() {
    let edits: [&dyn Fn(&mut crate::model::scene::SceneFile); 4] = [
        &|_| (),
        &|saw| profiled(saw),
        &|saw| {
            profiled(saw);
            collar(saw, InPlane::Free);
        },
        &|saw| {
            profiled(saw);
            collar(saw, InPlane::Fixed);
        },
    ];
    for (index, edit) in edits.iter().enumerate() {
        let plate = plate([2, 6], edit);
        let stretching = Stretching::new(&plate).unwrap();
        let a = plate.blade.inner_radius_m;
        let shape: &dyn Fn(f64) -> f64 = &|r| (r - a).powi(2) * (1.0 + 2.0 * r);
        let slope = |r: f64| 2.0 * (r - a) * (1.0 + 2.0 * r) + 2.0 * (r - a).powi(2);
        let q = projected(&plate, &[(0, [shape, &|_| 0.0])]);
        let energy = stretching.energy_j(&q).unwrap();
        let shot = by_shooting(&plate.blade, &slope);
        // Near the knots of a profile functions are accurate to 1e-9, their slopes to fewer digits.
        let most = if index == 0 { 1e-9 } else { 1e-6 };
        let error = energy / shot - 1.0;
        assert!(error.abs() < most, "{index}: {error:e}");
    }
}
