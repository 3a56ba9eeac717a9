//! Which numbers move what was measured.

use rayon::prelude::*;

use super::Measurement;
use super::model::Model;
use crate::plate::Resolution;
use crate::scene::{Freed, Scene, common_turn, spread};
use crate::spectrum::SpectrumError;

/// Frequencies that move by less than this between the bounds do not move, in Hz.
const IDLE_HZ: f64 = 1e-5;

/// Sorts the freed numbers into those that move a measured frequency and those that do not:
/// the angle of a single pad, say, which turns the saw as a whole. Looked at from several
/// places, for a number may rest at one.
pub fn effective(
    scene: &Scene,
    measurement: &Measurement,
    freed: &[Freed],
    resolution: Resolution,
) -> Result<(Vec<Freed>, Vec<Freed>), SpectrumError> {
    let model = Model {
        scene: scene.file(),
        freed,
        measurement,
        resolution,
    };
    let own: Vec<f64> = freed.iter().map(|f| f.share_of(scene.file())).collect();
    let held = common_turn(scene, freed);
    let moves = |k: usize| -> Result<bool, SpectrumError> {
        if held == Some(k) {
            return Ok(false);
        }
        for base in [own.clone(), spread(freed.len(), 0, 0)] {
            let mut reference: Option<Vec<f64>> = None;
            for share in [0.1, 0.37, 0.83] {
                let mut shares = base.clone();
                shares[k] = share;
                let residuals = model.residuals_hz(&shares)?;
                if residuals.iter().any(|r| r.is_nan()) {
                    continue;
                }
                let first = reference.get_or_insert_with(|| residuals.clone());
                let moved = first
                    .iter()
                    .zip(&residuals)
                    .any(|(x, y)| (x - y).abs() > IDLE_HZ);
                if moved {
                    return Ok(true);
                }
            }
        }
        Ok(false)
    };
    let moving: Vec<bool> = (0..freed.len())
        .into_par_iter()
        .map(moves)
        .collect::<Result<_, _>>()?;
    let with = |wanted: bool| {
        let pairs = freed
            .iter()
            .zip(&moving)
            .filter(move |(_, m)| **m == wanted);
        pairs.map(|(f, _)| f.clone()).collect()
    };
    Ok((with(true), with(false)))
}
