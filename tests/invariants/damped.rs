//! Bands of damped saws against every eigenvalue of the whole basis.

use faer::c64;
use proptest::prelude::*;
use sawflutter::campbell::even_speeds;
use sawflutter::plate::Plate;
use sawflutter::scene::{DampingFile, SceneFile, rpm};
use sawflutter::spectrum::{SpectralModel, Strategy as Solver};
use sawflutter::stability::{Instability, InstabilityKind, chart};

use super::draws::*;

/// Growth that the projection may miss, in 1/s: 1e-7 of a chart's height.
const TOLERANCE_PER_S: f64 = 2e-4;

prop_compose! {
    /// A saw with damping in its pads, in the air, in its material, or in several of these.
    fn any_damped_saw()(
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
        });
        if pads.is_none() && !is_damped {
            file.guides[0].damping_n_s_per_m = 20.0;
        }
        file
    }
}

/// The bands at a speed against the growing eigenvalues: as many, of the same kind, none with
/// more growth than the peak of its band, each with the growth of a band's curve.
fn holds(bands: &[Instability], all: &[c64], speed: f64) -> Result<(), String> {
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
                    "{:?} {}–{}, {}",
                    b.kind,
                    rpm(b.from_rad_per_s),
                    rpm(b.to_rad_per_s),
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

fn every_band_is_found(cases: u32) {
    let seen = std::cell::Cell::new([0_usize; 3]);
    check(cases, any_damped_saw(), |file| {
        let range = (0.0, 1.9 * lowest_critical(&file));
        let model = SpectralModel::new(Plate::new(&scene(&file), SMALL), range, Solver::Reduced);
        let model = model.unwrap();
        let chart = chart(&model, range, 31, &|_, _| ()).unwrap();
        let bands = &chart.instabilities;
        prop_assert_eq!(&chart.certificate.violations_rad_per_s, &Vec::<f64>::new());
        for band in bands {
            prop_assert!(
                band.to_rad_per_s > band.from_rad_per_s && band.peak_growth_per_s > 0.0,
                "{:?}",
                band
            );
            prop_assert!(
                (band.from_rad_per_s..=band.to_rad_per_s).contains(&band.peak_rad_per_s),
                "{:?}",
                band
            );
            prop_assert!(
                band.closed || band.to_rad_per_s == range.1 || band.from_rad_per_s == range.0
            );
        }
        let growth = bands
            .iter()
            .map(|b| b.peak_growth_per_s)
            .fold(0.0, f64::max);
        let near_an_edge = |speed: f64| {
            let mut edges = bands
                .iter()
                .flat_map(|b| [b.from_rad_per_s, b.to_rad_per_s]);
            edges.any(|edge| (edge / speed - 1.0).abs() < 1e-5)
        };
        let mut speeds = even_speeds(range, 24);
        speeds.extend(
            bands
                .iter()
                .map(|b| 0.5 * (b.from_rad_per_s + b.to_rad_per_s)),
        );
        speeds.extend(bands.iter().map(|b| b.peak_rad_per_s));
        speeds.retain(|speed| *speed > 0.0 && !near_an_edge(*speed));
        for speed in &speeds {
            let held = holds(bands, &eigenvalues(&file, *speed), *speed);
            prop_assert!(
                held.is_ok(),
                "{}\n{}",
                held.unwrap_err(),
                serde_json::to_string(&file).unwrap()
            );
        }
        let [saws, count, strong] = seen.get();
        seen.set([
            saws + 1,
            count + bands.len(),
            strong + usize::from(growth > 0.25),
        ]);
        Ok(())
    });
    println!("saws, bands, with growth above 0.25 1/s: {:?}", seen.get());
    assert!(seen.get()[2] > 0);
}

#[test]
fn bands_of_damped_saws_are_those_of_every_eigenvalue() {
    every_band_is_found(5);
}

#[test]
#[ignore = "a minute: run it after a change of the search"]
fn bands_of_many_damped_saws_are_those_of_every_eigenvalue() {
    every_band_is_found(40);
}
