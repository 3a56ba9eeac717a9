//! Crossings of the lines kΩ with the branches, compared with a dense eigenproblem in Ω² and a closed form.

use std::f64::consts::TAU;

use nalgebra::{Complex, DMatrix};
use sawflutter::model::analytical::free_wave::FreeWave;
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{ExcitationFile, Scene, rad_per_s, rpm};
use sawflutter::model::system::GyroscopicSystem;
use sawflutter::stability::{Analysis, crossings};

use super::saws::dense_analysis;

const RESOLUTION: Resolution = Resolution {
    max_diameters: 5,
    radial_functions: 4,
};

fn asked(scene: &Scene, orders: u32) -> Scene {
    let asked = scene.edited(|saw| {
        saw.excitation = Some(ExcitationFile {
            orders,
            tooth_passing: 0,
        });
    });
    asked.unwrap_or_else(|error| panic!("{error}"))
}

/// K₀x = Ω²[k² − 2ikG − (K_σ − N)]x: every real Ω at which λ = ikΩ is an eigenvalue.
fn exact(system: &GyroscopicSystem, order: u32) -> Vec<f64> {
    let size = system.order();
    let k = f64::from(order);
    let complex = |re: f64, im: f64| Complex::new(re, im);
    let stiffness = DMatrix::from_fn(size, size, |i, j| complex(system.stiffness[(i, j)], 0.0));
    let inertia = DMatrix::from_fn(size, size, |i, j| {
        let unit = if i == j { k * k } else { 0.0 };
        complex(
            unit - system.spin[(i, j)],
            -2.0 * k * system.gyroscopic[(i, j)],
        )
    });
    let factor = stiffness.cholesky().expect("held by its pad").l();
    let inverse = factor.try_inverse().expect("a triangle");
    let reduced = &inverse * inertia * inverse.adjoint();
    let mut speeds: Vec<f64> = reduced
        .symmetric_eigenvalues()
        .iter()
        .filter(|inverse| **inverse > 0.0)
        .map(|inverse| inverse.recip().sqrt())
        .collect();
    speeds.sort_by(f64::total_cmp);
    speeds
}

#[test]
fn crossings_are_the_eigenvalues_of_the_problem_in_the_square_of_the_speed() {
    let scene = asked(&Scene::paper(), 4);
    let range = [200.0, 1400.0];
    let analysis = dense_analysis(&scene, RESOLUTION, range, 60);
    let model = &analysis.model;
    let found = crossings(model, &analysis.chart, scene.excitation()).unwrap();
    let system = GyroscopicSystem::of_plate(&Plate::new(&scene, RESOLUTION));
    let mut count = 0;
    for order in 1..=4 {
        let top = model.complete_to_rad_per_s;
        let expected: Vec<f64> = exact(&system, order)
            .into_iter()
            .filter(|speed| (range[0]..=range[1]).contains(&rpm(*speed)))
            .filter(|speed| f64::from(order) * speed < 0.98 * top)
            .collect();
        let own: Vec<f64> = found
            .iter()
            .filter(|c| c.line.order == order)
            .map(|c| c.speed_rad_per_s)
            .collect();
        assert!(
            own.len() >= expected.len(),
            "{order}: {own:?} for {expected:?}"
        );
        for (own, expected) in own.iter().zip(&expected) {
            let error = (own / expected - 1.0).abs();
            assert!(
                error < 1e-7,
                "{order}: {own} for {expected}, off by {error:e}"
            );
        }
        count += expected.len();
    }
    assert!(count >= 12, "{count}");
}

/// A crossing at a speed of the chart itself, in its middle and at its end.
#[test]
fn a_line_through_a_drawn_speed_crosses_there() {
    let scene = asked(&Scene::paper(), 2);
    let system = GyroscopicSystem::of_plate(&Plate::new(&scene, RESOLUTION));
    for order in [1, 2] {
        let within = |speed: &f64| (400.0..1200.0).contains(&rpm(*speed));
        let speed = exact(&system, order).into_iter().find(within).unwrap();
        for beyond in [0.0, 50.0] {
            let range = [rpm(speed) - 50.0, rpm(speed) + beyond];
            let analysis = dense_analysis(&scene, RESOLUTION, range, 11);
            let mut samples = analysis.chart.campbell.samples.iter();
            let drawn = |s: f64| (s / speed - 1.0).abs() < 1e-12;
            assert!(samples.any(|sample| drawn(sample.speed_rad_per_s)));
            let found = crossings(&analysis.model, &analysis.chart, scene.excitation()).unwrap();
            let here = |c: &&sawflutter::stability::Crossing| {
                c.line.order == order && (c.speed_rad_per_s / speed - 1.0).abs() < 1e-7
            };
            assert_eq!(found.iter().filter(here).count(), 1, "{order}: {found:?}");
        }
    }
}

/// In the fixed frame the wave of n diameters has ω_b ± nΩ: the line k crosses it where a wave of
/// k ∓ n
/// diameters with the same frequency and tension would be stationary.
#[test]
fn lines_of_a_free_blade_cross_at_the_closed_form() {
    let free = Scene::paper().edited(|saw| {
        saw.guides.clear();
        saw.cut = None;
    });
    let scene = asked(&free.unwrap(), 1);
    let analysis = Analysis::new(&scene).unwrap();
    let block = &analysis.model.plate.harmonics[2];
    let quotient = |matrix: &DMatrix<f64>, speed: f64| {
        let tension = &block.spin + DMatrix::identity(matrix.nrows(), matrix.nrows()) * 4.0;
        let eigen = (&block.bending + &tension * speed.powi(2)).symmetric_eigen();
        let x = eigen
            .eigenvectors
            .column(eigen.eigenvalues.imin())
            .into_owned();
        (x.transpose() * matrix * &x)[(0, 0)]
    };
    let tension = &block.spin + DMatrix::identity(block.spin.nrows(), block.spin.nrows()) * 4.0;
    // The backward wave of two diameters is treated as a stationary one of three.
    let mut speed = rad_per_s(900.0);
    for _ in 0..30 {
        let wave = FreeWave {
            nodal_diameters: 3,
            rest_frequency_rad_per_s: quotient(&block.bending, speed).sqrt(),
            spin_stiffening: quotient(&tension, speed),
        };
        speed = wave.critical_speed_rad_per_s().unwrap();
    }
    let near =
        |c: &&sawflutter::stability::Crossing| (c.speed_rad_per_s / speed - 1.0).abs() < 1e-8;
    let found = analysis.crossings.iter().find(near);
    assert!(
        found.is_some(),
        "{} rpm is not in {:?}",
        rpm(speed),
        analysis.crossings
    );
    let report = analysis.report();
    let entry = report.excitation.expect("asked for");
    let told = entry
        .crossings
        .iter()
        .find(|c| (c.rpm / rpm(speed) - 1.0).abs() < 1e-8)
        .expect("told");
    assert_eq!(told.mode, "2 diameters, backward");
    assert!((told.frequency_hz - speed / TAU).abs() < 1e-6);
}
