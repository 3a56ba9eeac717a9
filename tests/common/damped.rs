//! Bands of damped saws against every eigenvalue of the full model.
#![allow(dead_code)]

use faer::c64;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use sawflutter::model::evenly_spaced;
use sawflutter::model::plate::Plate;
use sawflutter::model::scene::{DampingFile, SceneFile, SpeedRange, rpm};
use sawflutter::modes::{SpectralModel, Strategy as Solver};
use sawflutter::stability::{Instability, InstabilityKind, chart};

use crate::draws::*;

/// Growth that the projection may miss, in 1/s: 1e-7 of a chart's height.
const TOLERANCE_PER_S: f64 = 2e-4;

prop_compose! {
    /// A saw with damping in its pads, in the air, in its material, or in several of these.
    pub fn any_damped_saw()(
        file in any_saw(),
        pads in prop::option::weighted(0.7, 0.5..3.5_f64),
        air in prop::option::weighted(0.4, -1.0..2.0_f64),
        material in prop::option::weighted(0.3, -7.5..-5.0_f64),
    ) -> SceneFile {
        let mut file = file;
        let power = |decades: Option<f64>| decades.map_or(0.0, |d| 10_f64.powf(d));
        for pad in &mut file.guides {
            pad.damping_n_s_per_m = power(pads);
        }
        let is_damped = air.is_some() || material.is_some();
        file.damping = is_damped.then(|| DampingFile {
            air_n_s_per_m3: power(air),
            air_rotation_share: if pads.is_some() { 0.3 } else { 0.0 },
            material_retardation_time_s: power(material),
            ..DampingFile::default()
        });
        if pads.is_none() && !is_damped {
            file.guides[0].damping_n_s_per_m = 20.0;
        }
        file
    }
}

/// Compares the bands at a speed with the growing eigenvalues: their number and kind agree, no growth exceeds the peak
/// of its band, and each growth is that of a band's curve.
pub fn holds(bands: &[Instability], all: &[c64], speed: f64) -> Result<(), String> {
    let covering: Vec<&Instability> = bands
        .iter()
        .filter(|b| b.from_rad_per_s < speed && speed < b.to_rad_per_s)
        .collect();
    let mut growing: Vec<c64> = all.iter().copied().filter(|l| l.re > 0.0).collect();
    growing.sort_by(|x, y| y.re.total_cmp(&x.re));
    let certain = growing.iter().filter(|l| l.re > TOLERANCE_PER_S).count();
    let possible = all.iter().filter(|l| l.re > -TOLERANCE_PER_S).count();
    let told = |what: &str| {
        let bands: Vec<String> = covering
            .iter()
            .map(|b| {
                format!(
                    "{:?} {}–{}, {:?} here, {} at most",
                    b.kind,
                    rpm(b.from_rad_per_s),
                    rpm(b.to_rad_per_s),
                    b.growth_at(speed),
                    b.peak_growth_per_s
                )
            })
            .collect();
        Err(format!(
            "{what} at {} rpm: {growing:?}, bands {bands:?}",
            rpm(speed)
        ))
    };
    if !(certain..=possible).contains(&covering.len()) {
        return told("uncovered");
    }
    let mut left = covering.clone();
    for lambda in &growing[..certain] {
        let off = |b: &&Instability| {
            let found = b.growth_at(speed).unwrap_or(f64::INFINITY);
            let diverges = b.kind == InstabilityKind::Divergence;
            let other_kind = f64::from(u8::from(diverges != (lambda.im == 0.0)));
            (found - lambda.re).abs() + 1e6 * other_kind
        };
        let nearest = (0..left.len())
            .min_by(|&i, &k| off(&left[i]).total_cmp(&off(&left[k])))
            .unwrap();
        let band = left.swap_remove(nearest);
        let tolerance = TOLERANCE_PER_S + 5e-3 * lambda.re;
        if off(&band) > tolerance {
            return told("another growth");
        }
        if lambda.re > band.peak_growth_per_s + TOLERANCE_PER_S {
            return told("more than the peak");
        }
    }
    Ok(())
}

/// The peak growth of the bands of a saw, or the first error of its list.
pub fn peak_growth_of_bands(file: &SceneFile) -> Result<f64, String> {
    let range = SpeedRange::new(0.0, 1.9 * first_critical(file));
    let model =
        SpectralModel::new(Plate::new(&scene(file), SMALL), range, Solver::Reduced).unwrap();
    let chart = chart(&model, range, 31, &|_, _| ()).unwrap();
    let violations = &chart.certificate.violations_rad_per_s;
    if !violations.is_empty() {
        return Err(format!("the certificate fails at {violations:?} rad/s"));
    }
    let bands = &chart.instabilities;
    for band in bands {
        let span = band.from_rad_per_s..=band.to_rad_per_s;
        let ends = band.closed
            || band.to_rad_per_s == range.to_rad_per_s
            || band.from_rad_per_s == range.from_rad_per_s;
        let grows = band.to_rad_per_s > band.from_rad_per_s && band.peak_growth_per_s > 0.0;
        if !(ends && grows && span.contains(&band.peak_rad_per_s)) {
            return Err(format!("{band:?}"));
        }
    }
    for speed in speeds(bands, range) {
        holds(bands, &eigenvalues(file, speed), speed)?;
    }
    let peaks = bands.iter().map(|b| b.peak_growth_per_s);
    Ok(peaks.fold(0.0, f64::max))
}

/// Even speeds, the middles and the peaks of the bands, none of them at an edge.
fn speeds(bands: &[Instability], range: SpeedRange) -> Vec<f64> {
    let middle = |b: &Instability| 0.5 * (b.from_rad_per_s + b.to_rad_per_s);
    let mut speeds = evenly_spaced(range.ends(), 24);
    speeds.extend(bands.iter().map(middle));
    speeds.extend(bands.iter().map(|b| b.peak_rad_per_s));
    let is_edge = |speed: f64, edge: f64| (edge / speed - 1.0).abs() < 1e-5;
    let near_an_edge = |speed: f64| {
        let edges = bands.iter().map(|b| [b.from_rad_per_s, b.to_rad_per_s]);
        edges.flatten().any(|edge| is_edge(speed, edge))
    };
    speeds.retain(|speed| *speed > 0.0 && !near_an_edge(*speed));
    speeds
}

/// The first saws of a sequence that is the same in every run.
pub fn drawn_saws(count: usize) -> Vec<SceneFile> {
    let mut runner = TestRunner::deterministic();
    let mut draw = || any_damped_saw().new_tree(&mut runner).unwrap().current();
    (0..count).map(|_| draw()).collect()
}
