//! Goal: the eigenvalues agree with the matrices to the digits of double precision.
//!
//! Independent results: a second solver of the same scaled companion problem (nalgebra's Francis QR beside faer's);
//! another formulation, the inertia of the Hermitian L(ω), which needs no unsymmetric eigenproblem; and single modes
//! computed with a hundred digits.

use crate::common::Worst;
use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use faer::{Col, Mat, c64};
use nalgebra::{DMatrix, linalg::Schur};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{Scene, SpeedRange, rad_per_s};
use sawflutter::model::system::GyroscopicSystem;
use sawflutter::modes::{SpectralModel, Strategy, companion_eigenpairs};

/// Every scene that comes with the program.
const SCENES: [&str; 4] = ["paper", "free-blade", "collar-400mm", "two-pads"];
/// Stable, divergent and fluttering speeds of the guided saws.
const SPEEDS_RPM: [f64; 3] = [0.0, 1800.0, 2400.0];

/// The independent problems of a scene, each with its speed.
fn systems(scene: &Scene, resolution: Resolution) -> Vec<GyroscopicSystem> {
    let plate = Plate::new(scene, resolution);
    if plate.is_axisymmetric() {
        (0..=resolution.max_diameters)
            .map(|n| GyroscopicSystem::of_harmonic(&plate, n))
            .collect()
    } else {
        vec![GyroscopicSystem::of_plate(&plate)]
    }
}

/// Time in units of 1/s, where s is the power of two next to the root mean square frequency, as in the call of faer:
/// both solvers get the same numbers.
fn unit_of_frequency(stiffness: &Mat<f64>) -> f64 {
    let mean_square = stiffness.norm_l2() / (stiffness.nrows() as f64).sqrt();
    mean_square.sqrt().log2().round().exp2()
}

/// The eigenvalues with Im λ ≥ 0 by nalgebra, or `None` if its QR iteration, which has no exceptional shifts, does not
/// converge.
fn by_nalgebra(system: &GyroscopicSystem, speed_rad_per_s: f64) -> Option<Vec<c64>> {
    let (stiffness, velocity) = (
        system.stiffness_at(speed_rad_per_s),
        system.velocity_at(speed_rad_per_s),
    );
    let unit = unit_of_frequency(&stiffness);
    let size = system.order();
    let state = DMatrix::from_fn(2 * size, 2 * size, |i, k| match (i < size, k < size) {
        (true, _) => f64::from(u8::from(k == i + size)),
        (false, true) => -stiffness[(i - size, k)] / unit.powi(2),
        (false, false) => -velocity[(i - size, k - size)] / unit,
    });
    let schur = Schur::try_new(state, f64::EPSILON, 200 * size)?;
    let values = schur.complex_eigenvalues();
    let upper = values.iter().filter(|z| z.im >= 0.0);
    Some(upper.map(|z| c64::new(z.re, z.im) * unit).collect())
}

fn by_faer(system: &GyroscopicSystem, speed_rad_per_s: f64) -> Vec<c64> {
    let pairs = companion_eigenpairs(system, speed_rad_per_s).unwrap();
    pairs.into_iter().map(|(lambda, _)| lambda).collect()
}

/// Distance to the nearest of many eigenvalues, in units of the largest: both solvers are backward stable, so that the
/// error of each is at most about ε times the largest.
fn off_by(lambda: c64, others: &[c64]) -> f64 {
    let largest = others
        .iter()
        .fold(lambda.norm(), |top, l| top.max(l.norm()));
    let nearest = others.iter().map(|l| (l - lambda).norm());
    nearest.fold(f64::INFINITY, f64::min) / largest
}

/// A free blade has double zeros, which either solver finds to √ε only.
const RIGID: f64 = 1e-6;

#[test]
fn two_solvers_agree_on_every_scene() {
    let mut worst = Worst::default();
    let mut rigid = 0;
    for name in SCENES {
        let scene = crate::common::scene(name);
        for rpm in SPEEDS_RPM {
            let speed = rad_per_s(rpm);
            for (part, system) in systems(&scene, Resolution::of(scene.accuracy()))
                .iter()
                .enumerate()
            {
                let solved = by_nalgebra(system, speed);
                let place = || format!("{name}, part {part}, {rpm} rpm");
                let second = solved.unwrap_or_else(|| panic!("no convergence: {}", place()));
                for lambda in by_faer(system, speed) {
                    if lambda.norm() < RIGID * unit_of_frequency(&system.stiffness) {
                        rigid += 1;
                        continue;
                    }
                    worst.add(off_by(lambda, &second), || format!("{}: {lambda}", place()));
                }
            }
        }
    }
    // Heave and two tilts of the free blade, at rest and, for some, rotating.
    assert!((3..=18).contains(&rigid), "{rigid} rigid motions");
    worst.assert_at_most("faer against nalgebra", 1e-10);
}

/// Negative eigenvalues of the Hermitian L(iω) = −ω² + 2iωΩG + K, as those of the real
/// symmetric [Re L, −Im L; Im L, Re L], which has each of them twice.
fn inertia(system: &GyroscopicSystem, speed_rad_per_s: f64, omega: f64) -> usize {
    let (stiffness, velocity) = (
        system.stiffness_at(speed_rad_per_s),
        system.velocity_at(speed_rad_per_s),
    );
    let size = system.order();
    let hermitian = DMatrix::from_fn(2 * size, 2 * size, |i, k| {
        let imaginary = |i: usize, k: usize| omega * velocity[(i, k)];
        match (i < size, k < size) {
            (true, true) | (false, false) => {
                let (i, k) = (i % size, k % size);
                stiffness[(i, k)] - if i == k { omega * omega } else { 0.0 }
            }
            (true, false) => -imaginary(i, k - size),
            (false, true) => imaginary(i - size, k),
        }
    });
    let negative = hermitian.symmetric_eigenvalues();
    negative.iter().filter(|value| **value < 0.0).count() / 2
}

/// As ω passes an eigenvalue, L(iω) gains a negative direction where its Krein sign is +1,
/// and loses one where it is −1: a bracket of ±1e-9 around each of the lowest eigenvalues,
/// and the Krein sign, from symmetric matrices alone.
#[test]
fn inertia_brackets_every_low_frequency_and_its_krein_sign() {
    let resolution = Resolution {
        max_diameters: 5,
        radial_functions: 4,
    };
    for name in ["paper", "two-pads"] {
        let plate = Plate::new(&crate::common::scene(name), resolution);
        for rpm in SPEEDS_RPM {
            let speed = rad_per_s(rpm);
            let model = SpectralModel::new(
                plate.clone(),
                SpeedRange::new(0.0, speed.max(1.0)),
                Strategy::Dense,
            );
            let modes = model.unwrap().all_modes(speed).unwrap();
            let mut seen = 0;
            for mode in modes.iter().filter(|m| m.krein_sign() != 0).take(6) {
                let omega = mode.frequency_rad_per_s();
                let system = GyroscopicSystem::of_plate(&plate);
                let [below, above] =
                    [1.0 - 1e-9, 1.0 + 1e-9].map(|f| inertia(&system, speed, f * omega));
                let jump = i32::try_from(above).unwrap() - i32::try_from(below).unwrap();
                assert_eq!(
                    jump,
                    i32::from(mode.krein_sign()),
                    "{name}, {rpm} rpm, {omega}"
                );
                seen += 1;
            }
            assert_eq!(seen, 6);
        }
    }
}

/// A number of 400 bits, 120 digits.
type Long = FBig<HalfEven, 2>;
const BITS: usize = 400;

fn long(value: f64) -> Long {
    let exact = Long::try_from(value).expect("a finite number");
    exact.with_precision(BITS).value()
}

/// A complex number of 120 digits.
#[derive(Clone)]
struct Complex {
    re: Long,
    im: Long,
}

impl Complex {
    fn new(re: f64, im: f64) -> Self {
        Complex {
            re: long(re),
            im: long(im),
        }
    }

    fn times(&self, other: &Self) -> Self {
        Complex {
            re: &self.re * &other.re - &self.im * &other.im,
            im: &self.re * &other.im + &self.im * &other.re,
        }
    }

    fn plus(&self, other: &Self) -> Self {
        Complex {
            re: &self.re + &other.re,
            im: &self.im + &other.im,
        }
    }

    fn minus(&self, other: &Self) -> Self {
        Complex {
            re: &self.re - &other.re,
            im: &self.im - &other.im,
        }
    }

    fn norm_square(&self) -> Long {
        &self.re * &self.re + &self.im * &self.im
    }

    fn over(&self, other: &Self) -> Self {
        let square = other.norm_square();
        let conjugate = Complex {
            re: other.re.clone(),
            im: -other.im.clone(),
        };
        let product = self.times(&conjugate);
        Complex {
            re: product.re / &square,
            im: product.im / &square,
        }
    }

    fn rounded(&self) -> c64 {
        c64::new(self.re.to_f64().value(), self.im.to_f64().value())
    }

    fn norm(&self) -> f64 {
        self.norm_square().to_f64().value().sqrt()
    }
}

/// Solves A x = b by Gauss's elimination with row exchange.
fn solve(mut a: Vec<Vec<Complex>>, mut b: Vec<Complex>) -> Vec<Complex> {
    let size = b.len();
    for k in 0..size {
        let best = (k..size)
            .max_by(|&i, &j| a[i][k].norm().total_cmp(&a[j][k].norm()))
            .unwrap();
        a.swap(k, best);
        b.swap(k, best);
        let (pivots, rest) = a.split_at_mut(k + 1);
        let pivot = &pivots[k];
        for (row, i) in rest.iter_mut().zip(k + 1..) {
            let factor = row[k].over(&pivot[k]);
            for j in k + 1..size {
                row[j] = row[j].minus(&factor.times(&pivot[j]));
            }
            b[i] = b[i].minus(&factor.times(&b[k]));
        }
    }
    for k in (0..size).rev() {
        for j in k + 1..size {
            b[k] = b[k].minus(&a[k][j].times(&b[j]));
        }
        b[k] = b[k].over(&a[k][k]);
    }
    b
}

/// The eigenvalue next to λ with over a hundred digits: Newton's method on L(λ)q = 0, vᵀq = 1 (nonlinear inverse
/// iteration), which doubles the digits at each step. The second value is the size of the last correction relative to
/// λ.
fn refined(system: &GyroscopicSystem, speed: f64, lambda: c64, q: &Col<c64>) -> (Complex, f64) {
    let (stiffness, velocity) = (system.stiffness_at(speed), system.velocity_at(speed));
    let size = system.order();
    let number = |z: c64| Complex::new(z.re, z.im);
    let v: Vec<Complex> = q.iter().map(|z| number(z.conj())).collect();
    let mut q: Vec<Complex> = q.iter().map(|z| number(*z)).collect();
    let mut lambda = number(lambda);
    let mut correction = f64::INFINITY;
    for _ in 0..6 {
        let square = lambda.times(&lambda);
        let dynamic = |i: usize, k: usize| {
            let damped = lambda.times(&Complex::new(velocity[(i, k)], 0.0));
            let rest = damped.plus(&Complex::new(stiffness[(i, k)], 0.0));
            if i == k { rest.plus(&square) } else { rest }
        };
        let a: Vec<Vec<Complex>> = (0..size)
            .map(|i| (0..size).map(|k| dynamic(i, k)).collect())
            .collect();
        // L'(λ)q = (2λ + D)q
        let two_lambda = lambda.plus(&lambda);
        let slope = |i: usize| {
            let start = two_lambda.times(&q[i]);
            (0..size).fold(start, |sum, k| {
                sum.plus(&q[k].times(&Complex::new(velocity[(i, k)], 0.0)))
            })
        };
        let u = solve(a, (0..size).map(slope).collect());
        let along = |x: &[Complex]| {
            let products = v.iter().zip(x).map(|(v, x)| v.times(x));
            products.fold(Complex::new(0.0, 0.0), |sum, p| sum.plus(&p))
        };
        let step = along(&q).over(&along(&u));
        correction = step.norm() / lambda.norm();
        lambda = lambda.minus(&step);
        let scale = along(&u);
        q = u.iter().map(|x| x.over(&scale)).collect();
        if correction < 1e-60 {
            break;
        }
    }
    (lambda, correction)
}

/// A speed at which one of the five lowest modes flutters.
fn fluttering_rpm(system: &GyroscopicSystem) -> f64 {
    let flutters = |rpm: &f64| {
        let lambdas = by_faer(system, rad_per_s(*rpm));
        lambdas.iter().take(5).any(|l| l.re > 0.1 && l.im > 1.0)
    };
    let mut speeds = (150..400).map(|k| 10.0 * f64::from(k));
    speeds
        .find(flutters)
        .expect("every guided saw flutters somewhere")
}

/// The matrices are exact in double precision, and the mode is exact for them.
#[test]
fn both_solvers_against_a_hundred_digits() {
    let resolution = Resolution {
        max_diameters: 5,
        radial_functions: 4,
    };
    let (mut first, mut second) = (Worst::default(), Worst::default());
    let mut growing = 0;
    let flutters = fluttering_rpm(&systems(&crate::common::scene("paper"), resolution)[0]);
    for (name, rpm) in [
        ("paper", 1200.0),
        ("paper", flutters),
        ("collar-400mm", 3000.0),
    ] {
        let speed = rad_per_s(rpm);
        let systems = systems(&crate::common::scene(name), resolution);
        // The collar saw is tested with the waves of two diameters.
        let system = systems.get(2).unwrap_or(&systems[0]);
        let others = by_nalgebra(system, speed).unwrap();
        for (lambda, q) in companion_eigenpairs(system, speed).unwrap().iter().take(5) {
            let (exact, correction) = refined(system, speed, *lambda, q);
            // The next correction would be the square of this one: over a hundred digits.
            assert!(correction < 1e-55, "{correction:e}");
            let distance = |l: c64| exact.minus(&Complex::new(l.re, l.im)).norm() / exact.norm();
            let place = || format!("{name}, {rpm} rpm, {:.3e}", exact.rounded());
            growing += usize::from(lambda.re > 0.1);
            first.add(distance(*lambda), place);
            let nearest = others.iter().map(|l| distance(*l));
            second.add(nearest.fold(f64::INFINITY, f64::min), place);
        }
    }
    assert!(growing > 0, "no growing mode was looked at");
    first.assert_at_most("faer, relative to each λ", 1e-11);
    second.assert_at_most("nalgebra, relative to each λ", 1e-11);
}
