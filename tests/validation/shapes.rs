//! Goal: the shapes shown are those of the events.
//!
//! Independent values: a free blade has the shape cos nθ, with n nodal diameters; the basis functions at points, which
//! the profiles of a report do not use; K(Ω)x = 0 at a critical speed, from the assembled matrices.

use std::f64::consts::TAU;

use faer::c64;
use sawflutter::analyses::campbell::{EventShape, ModeHarmonic, Report, ShapeOccasion, VtkFile};
use sawflutter::model::scene::{Accuracy, Scene, rad_per_s};
use sawflutter::stability::Analysis;

fn charted(scene: &Scene, asked_rpm: &[f64]) -> (Analysis, Report) {
    let scene = scene.edited(|file| file.accuracy = Accuracy::Draft);
    let analysis = Analysis::new(&scene.unwrap()).unwrap();
    let mut report = analysis.report();
    let asked: Vec<f64> = asked_rpm.iter().map(|rpm| rad_per_s(*rpm)).collect();
    report.add_shapes(&analysis, &asked).unwrap();
    (analysis, report)
}

/// Complex deflection at the k-th radius of the shape.
fn at(shape: &EventShape, k: usize, angle_rad: f64) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for wave in &shape.harmonics {
        let (sin, cos) = (wave.nodal_diameters as f64 * angle_rad).sin_cos();
        sum[0] += wave.cosine.re[k] * cos + wave.sine.re[k] * sin;
        sum[1] += wave.cosine.im[k] * cos + wave.sine.im[k] * sin;
    }
    sum
}

#[test]
fn shapes_of_a_free_blade_are_cosines_of_its_nodal_diameters() {
    let scene = Scene::from_path(crate::common::path("scenes/free-blade.json")).unwrap();
    let (_, report) = charted(&scene, &[]);
    let standing: Vec<_> = report
        .shapes
        .iter()
        .filter(|shape| shape.occasion == ShapeOccasion::CriticalSpeed)
        .collect();
    assert_eq!(standing.len(), report.critical_speeds.len());
    for (shape, critical) in standing.iter().zip(&report.critical_speeds) {
        assert_eq!(shape.name, critical.name);
        assert!((shape.rpm / critical.rpm - 1.0).abs() < 1e-12);
        let n = critical.nodal_diameters as f64;
        let rim = shape.radius_m.len() - 1;
        let count = 720;
        let angle = |k: usize| TAU * k as f64 / count as f64;
        let values: Vec<f64> = (0..count).map(|k| at(shape, rim, angle(k))[0]).collect();
        // Least squares of a cosine and a sine at evenly spaced angles are sums.
        let sum = |of: fn(f64) -> f64| -> f64 {
            let terms = values.iter().enumerate();
            2.0 / count as f64 * terms.map(|(k, w)| w * of(n * angle(k))).sum::<f64>()
        };
        let (a, b) = (sum(f64::cos), sum(f64::sin));
        for (k, w) in values.iter().enumerate() {
            let cosine = a * (n * angle(k)).cos() + b * (n * angle(k)).sin();
            assert!((w - cosine).abs() < 1e-9, "{n}");
        }
        // The rim of a free blade without nodal circles deflects most.
        assert!((a.hypot(b) - 1.0).abs() < 1e-3, "{n}: {}", a.hypot(b));
    }
}

#[test]
fn the_wave_of_a_critical_speed_has_no_stiffness_on_a_guided_blade() {
    let (analysis, report) = charted(&Scene::paper(), &[]);
    let model = &analysis.model;
    let critical = &model.critical[0];
    let shape = &report.shapes[0];
    assert_eq!(shape.occasion, ShapeOccasion::CriticalSpeed);
    let component = &model.components[critical.component];
    let (stiffness, x) = (
        component.full.stiffness_at(critical.speed_rad_per_s),
        &critical.shape,
    );
    let residual = (&stiffness * x).norm_l2();
    assert!(
        residual < 1e-9 * stiffness.norm_l2() * x.norm_l2(),
        "{residual}"
    );
    // The shape at points, by the basis functions there, up to the factor that normalizes it.
    let deflection = |radius_m: f64, angle_rad: f64| -> f64 {
        let functions = model.plate.functions_at(radius_m, angle_rad);
        let own = functions.iter().skip(component.first);
        own.zip(x.iter()).map(|(phi, x)| phi * x).sum()
    };
    let points = [(0, 0.3), (17, 2.0), (40, -1.1), (40, 4.0)];
    let pairs = points.map(|(k, angle)| {
        let [re, im] = at(shape, k, angle);
        assert!(im.abs() < 1e-12, "it stands");
        (re, deflection(shape.radius_m[k], angle))
    });
    let factor = pairs[2].1 / pairs[2].0;
    for (shown, by_functions) in pairs {
        let error = (shown - by_functions / factor).abs();
        assert!(error < 1e-3, "{shown} {} {error}", by_functions / factor);
    }
}

/// Each event has one shape; its largest deflection is 1 at the beginning.
#[test]
fn every_event_is_shown_and_scaled() {
    let (_, report) = charted(&Scene::paper(), &[1000.0]);
    let count = |occasion| {
        let shapes = report.shapes.iter();
        shapes.filter(|shape| shape.occasion == occasion).count()
    };
    let bands = count(ShapeOccasion::Divergence) + count(ShapeOccasion::Flutter);
    assert_eq!(bands, report.instabilities.len());
    assert_eq!(
        count(ShapeOccasion::CriticalSpeed),
        report.critical_speeds.len()
    );
    assert_eq!(count(ShapeOccasion::AskedSpeed), 4);
    for band in &report.instabilities {
        let of_band = report
            .shapes
            .iter()
            .find(|shape| shape.rpm == band.peak_rpm);
        let shape = of_band.expect("each band has one");
        assert!((shape.growth_per_s / band.peak_growth_per_s - 1.0).abs() < 0.05);
        assert_eq!(Some(&shape.name), band.name.as_ref());
    }
    for shape in &report.shapes {
        let mut largest = 0.0_f64;
        for k in 0..shape.radius_m.len() {
            for step in 0..720 {
                let [re, im] = at(shape, k, TAU * f64::from(step) / 720.0);
                largest = largest.max(re.hypot(im));
                assert!(re <= 1.0 + 5e-3, "{}: {re}", shape.name);
            }
        }
        assert!((largest - 1.0).abs() < 5e-3, "{}: {largest}", shape.name);
    }
}

/// Kinetic energy ∫|(λ + Ω∂θ)w|² of each harmonic of a shape on a blade of one thickness, by the trapezoidal rule over
/// the radii of the report, as shares.
fn energy_shares(shape: &EventShape) -> Vec<f64> {
    let lambda = c64::new(shape.growth_per_s, TAU * shape.frequency_hz);
    let energy = |wave: &ModeHarmonic| {
        let carried = rad_per_s(shape.rpm) * wave.nodal_diameters as f64;
        let density = |k: usize| {
            let [c, s] = [&wave.cosine, &wave.sine].map(|part| c64::new(part.re[k], part.im[k]));
            let velocities = [lambda * c + s * carried, lambda * s - c * carried];
            let twice = if wave.nodal_diameters == 0 { 2.0 } else { 1.0 };
            twice * shape.radius_m[k] * velocities.map(|v| v.norm_sqr()).iter().sum::<f64>()
        };
        let pairs = (1..shape.radius_m.len()).map(|k| {
            let width = shape.radius_m[k] - shape.radius_m[k - 1];
            0.5 * width * (density(k - 1) + density(k))
        });
        pairs.sum::<f64>()
    };
    let energies: Vec<f64> = shape.harmonics.iter().map(energy).collect();
    let total: f64 = energies.iter().sum();
    energies.iter().map(|energy| energy / total).collect()
}

/// A shape has one measure of its harmonics: the kinetic energy, by which modes are named, or the waves of an event. By
/// the squared deflection, the mode of four diameters of the paper's saw at 1800 rpm had a share of 6 % of them.
#[test]
fn shares_of_harmonics_are_those_of_the_name() {
    let (_, report) = charted(&Scene::paper(), &[1800.0]);
    let mut modes = 0;
    for shape in &report.shapes {
        let first = &shape.harmonics[0];
        let most = first.nodal_diameters.to_string();
        let named: Vec<&str> = shape.name.split_whitespace().collect();
        assert!(named.contains(&most.as_str()), "{}: {most}", shape.name);
        let (Some(dominant), true) = (named.first(), named.len() == 2) else {
            continue;
        };
        assert_eq!(**dominant, most, "{}", shape.name);
        assert!(first.share > 0.66, "{}: {}", shape.name, first.share);
        if shape.occasion == ShapeOccasion::AskedSpeed {
            for (wave, energy) in shape.harmonics.iter().zip(energy_shares(shape)) {
                let error = (wave.share - energy).abs();
                let n = wave.nodal_diameters;
                assert!(error < 2e-3, "{}, {n}: {} {energy}", shape.name, wave.share);
            }
            modes += 1;
        }
    }
    assert_eq!(modes, 3);
}

/// The files for ParaView: a grid of every phase, with the points on the blade and the deflections there.
#[test]
fn the_grids_of_vtk_hold_the_deflections_of_their_phase() {
    let (_, report) = charted(&Scene::paper(), &[1000.0]);
    let files = report.vtk_files();
    let list = &files[0];
    assert_eq!(list.name, "modes.pvd");
    for VtkFile { name, .. } in &files[1..] {
        assert_eq!(list.text.matches(name).count(), 1, "{name}");
    }
    let numbers = |text: &str, array: usize| -> Vec<f64> {
        let body = text
            .split("<DataArray")
            .nth(array)
            .unwrap()
            .split_once('>')
            .unwrap()
            .1
            .split_once("</DataArray>")
            .unwrap()
            .0;
        body.split_whitespace()
            .map(|n| n.parse().unwrap())
            .collect()
    };
    let flutter = report
        .shapes
        .iter()
        .position(|s| s.occasion == ShapeOccasion::Flutter)
        .unwrap();
    // A quarter of a period later, Re(w e^{iπ/2}) = −Im w.
    for (phase, turned) in [(0, 0), (3, 1)] {
        let text = &files[1 + phase].text;
        let (points, values) = (numbers(text, 1), numbers(text, 5 + flutter));
        assert_eq!(points.len(), 3 * values.len());
        for k in [0, 77, 1234, values.len() - 1] {
            let [x, y] = [points[3 * k], points[3 * k + 1]];
            let radii = &report.shapes[flutter].radius_m;
            let ring = radii.iter().position(|r| (r - x.hypot(y)).abs() < 2e-6);
            let w = at(&report.shapes[flutter], ring.unwrap(), y.atan2(x));
            let expected = if turned == 0 { w[0] } else { -w[1] };
            assert!(
                (values[k] - expected).abs() < 2e-5,
                "{k}: {} {expected}",
                values[k]
            );
        }
    }
}
