//! Goal: given factors of bending and of the stiffening by rotation, a blade has the frequencies and critical speeds of the slotted
//! blade from which the factors were taken, and a fit returns the factors.
//!
//! Source: `slots_four_40mm.csv`, a thin plate with doubled unknowns on the faces of four slots of 40 mm, in its own stress of rotation,
//! with its c_n and b'_n/b_n (ω² = c_n a_n + b'_n Ω², a_n and b_n of the plain plate).

use std::f64::consts::TAU;

use crate::common::{Worst, assert_close, reference_model, relative_error, table};
use crate::slots::saw;
use faer::Side;
use sawflutter::analyses::fit::{Measurement, Options, Row as Measured, fit};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{Accuracy, Freed, Scene, WaveFactorRow, rad_per_s, rpm};
use serde::Deserialize;

/// A wave of the blade with four slots.
#[derive(Deserialize)]
struct Row {
    n: usize,
    branch: String,
    rest_hz: f64,
    rpm1500_hz: f64,
    rpm3000_hz: f64,
    rpm4500_hz: f64,
    c_n: f64,
    b_ratio: f64,
    critical_rpm: Option<f64>,
}

/// The lower branches.
fn lower() -> Vec<Row> {
    let all = table::<Row>("slots_four_40mm.csv").into_iter();
    all.filter(|row| row.branch != "high").collect()
}

fn factored(factors: Vec<WaveFactorRow>) -> Scene {
    saw(None)
        .edited(|saw| saw.blade.wave_factors = factors)
        .unwrap()
}

fn factors_of(rows: &[Row]) -> Vec<WaveFactorRow> {
    let of = |row: &Row| WaveFactorRow {
        nodal_diameters: row.n as u32,
        bending: row.c_n,
        rotation: Some(row.b_ratio),
        split: None,
    };
    rows.iter().map(of).collect()
}

fn lowest_hz(plate: &Plate, n: usize, rpm: f64) -> f64 {
    let stiffness = plate.harmonics[n].body_frame_stiffness(rad_per_s(rpm));
    stiffness.self_adjoint_eigenvalues(Side::Lower).unwrap()[0].sqrt() / TAU
}

#[test]
fn factors_of_one_give_the_plain_blade() {
    let one = WaveFactorRow {
        nodal_diameters: 3,
        bending: 1.0,
        rotation: None,
        split: None,
    };
    let plates = [saw(None), factored(vec![one])]
        .map(|saw| Plate::new(&saw, Resolution::of(Accuracy::Design)));
    for n in 0..9 {
        assert_eq!(
            plates[0].harmonics[n].bending,
            plates[1].harmonics[n].bending
        );
        assert_eq!(plates[0].harmonics[n].spin, plates[1].harmonics[n].spin);
    }
}

#[test]
fn two_factors_a_wave_give_frequencies_and_critical_speeds_of_a_slotted_plate() {
    let rows = lower();
    let saw = factored(factors_of(&rows));
    let plate = Plate::new(&saw, Resolution::of(Accuracy::Reference));
    let model = reference_model(&saw, rad_per_s(6000.0));
    let mut worst = [Worst::default(), Worst::default()];
    for row in &rows {
        for (rpm, hz) in [
            (0.0, row.rest_hz),
            (1500.0, row.rpm1500_hz),
            (3000.0, row.rpm3000_hz),
            (4500.0, row.rpm4500_hz),
        ] {
            let found = lowest_hz(&plate, row.n, rpm);
            worst[0].add(relative_error(found, hz), || {
                format!("n = {} at {rpm} rpm: {found}", row.n)
            });
        }
        let Some(expected) = row.critical_rpm else {
            continue;
        };
        let mut critical = model.critical.iter();
        let own = critical.find(|c| c.name.diameters() == row.n).unwrap();
        let found = rpm(own.speed_rad_per_s);
        worst[1].add(relative_error(found, expected), || {
            format!("n = {}: {found}", row.n)
        });
    }
    assert_eq!(worst[1].count, 4);
    worst[0].assert_at_most("frequencies by factors", 2e-3);
    worst[1].assert_at_most("critical speeds by factors", 6e-4);
}

/// A wave that is not listed has the factors of the next listed one, and beyond the last the smallest of all, by the scaling of ω².
#[test]
fn waves_that_are_not_listed_have_the_next_factors() {
    let listed = [(2, 0.9, Some(0.8)), (5, 0.6, None), (7, 0.7, None)];
    let listed = listed.map(|(nodal_diameters, bending, rotation)| WaveFactorRow {
        nodal_diameters,
        bending,
        rotation,
        split: None,
    });
    let plates = [saw(None), factored(listed.to_vec())]
        .map(|saw| Plate::new(&saw, Resolution::of(Accuracy::Design)));
    for (n, bending) in [
        (0, 0.9),
        (1, 0.9),
        (2, 0.9),
        (3, 0.6),
        (5, 0.6),
        (6, 0.7),
        (8, 0.6),
    ] {
        let [plain, given] = plates.each_ref().map(|plate| lowest_hz(plate, n, 0.0));
        assert_close(
            &format!("n = {n}"),
            given.powi(2),
            bending * plain.powi(2),
            1e-9,
        );
    }
    assert_eq!(plates[1].even_from(), 8);
}

/// Taps at rest by nodal diameters give the factors of bending; frequencies at two speeds, as a fixed observer hears them, those of
/// rotation.
#[test]
fn a_fit_returns_the_factors_of_a_slotted_plate() {
    let rows = lower();
    let in_space = |rpm: f64, hz_of: fn(&Row) -> f64, count: usize| {
        let turns = rpm / 60.0;
        let of = |row: &Row| {
            let [turned, hz] = [row.n as f64 * turns, hz_of(row)];
            let both = [(hz - turned).abs(), hz + turned];
            both.into_iter()
                .take(if row.n == 0 { 1 } else { 2 })
                .collect::<Vec<_>>()
        };
        let mut heard: Vec<f64> = rows.iter().flat_map(of).collect();
        heard.sort_by(f64::total_cmp);
        let heard: Vec<Option<f64>> = heard.into_iter().take(count).map(Some).collect();
        Measured::new(rpm, &heard)
    };
    let taps: Vec<(usize, f64)> = (rows.iter())
        .filter(|row| (2..5).contains(&row.n))
        .map(|row| (row.n, row.rest_hz))
        .collect();
    let measurement = Measurement {
        source: "slotted plate".to_owned(),
        rows: vec![
            Measured::by_diameters(0.0, &taps),
            in_space(1500.0, |row| row.rpm1500_hz, 7),
            in_space(3000.0, |row| row.rpm3000_hz, 7),
        ],
    };
    // The fit begins with plain waves of 2 to 4 diameters.
    let mut begun = factors_of(&rows);
    for row in begun
        .iter_mut()
        .filter(|row| (2..5).contains(&row.nodal_diameters))
    {
        (row.bending, row.rotation) = (1.0, Some(1.0));
    }
    let saw = factored(begun);
    let free: Vec<Freed> = (2..5)
        .flat_map(|k| ["bending", "rotation"].map(|name| format!("blade.wave_factors[{k}].{name}")))
        .map(|path| Freed::new(saw.file(), &path, 0.5, 1.2).unwrap())
        .collect();
    let options = Options {
        starts: 2,
        ..Options::default()
    };
    let found = fit(&saw, &measurement, &free, &options, &|_, _| ()).unwrap();
    for (k, parameter) in found.parameters.iter().enumerate() {
        let row = &rows[2 + k / 2];
        let (expected, tolerance) = if k % 2 == 0 {
            (row.c_n, 2e-3)
        } else {
            (row.b_ratio, 1e-2)
        };
        assert_close(&parameter.path, parameter.value, expected, tolerance);
        assert!(parameter.interval_from.is_some(), "{}", parameter.path);
    }
}
