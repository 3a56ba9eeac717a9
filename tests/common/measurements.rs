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

/// Normal deviates from a linear congruential generator and the formula of Box and Muller.
pub struct Noise(pub u64);

impl Noise {
    fn uniform(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        ((self.0 >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }

    pub fn normal(&mut self) -> f64 {
        (-2.0 * self.uniform().ln()).sqrt() * (TAU * self.uniform()).cos()
    }
}

/// A measurement of the frequencies, each as it is read.
pub fn measured(exact: &[Vec<f64>], mut read: impl FnMut(f64) -> f64) -> Measurement {
    let rows = SPEEDS.iter().zip(exact).map(|(rpm, exact)| {
        let columns: Vec<_> = exact.iter().map(|hz| Some(read(*hz).abs())).collect();
        Row::new(*rpm, &columns)
    });
    Measurement {
        source: "drawn".into(),
        rows: rows.collect(),
    }
}
