//! Measurements of known saws.

use std::f64::consts::TAU;

use sawflutter::analyses::fit::{Measurement, Row};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{Scene, rad_per_s};
use sawflutter::modes::LowestModes;

/// The basis of both the measurement and the fit.
pub const SMALL: Resolution = Resolution {
    max_diameters: 4,
    radial_functions: 3,
};

/// Frequencies of the lowest modes, one row for each speed.
pub fn exact(scene: &Scene, rpm: &[f64], count: usize) -> Vec<Vec<f64>> {
    let lowest = LowestModes::new(&Plate::new(scene, SMALL));
    let row = |rpm: &f64| -> Vec<f64> {
        let modes = lowest.at(rad_per_s(*rpm), count).unwrap();
        modes.iter().map(|m| m.lambda.im / TAU).collect()
    };
    rpm.iter().map(row).collect()
}

/// Speeds of a measurement, in rpm.
pub const SPEEDS: [f64; 4] = [0.0, 400.0, 800.0, 1200.0];

/// The frequencies as a measurement, with the noise added to each.
pub fn measured(exact: &[Vec<f64>], mut noise: impl FnMut() -> f64) -> Measurement {
    let rows = SPEEDS.iter().zip(exact).map(|(rpm, exact)| {
        let columns: Vec<_> = exact.iter().map(|hz| Some((hz + noise()).abs())).collect();
        Row::new(*rpm, &columns)
    });
    Measurement {
        source: "drawn".into(),
        rows: rows.collect(),
    }
}
