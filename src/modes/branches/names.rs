//! Names of the modes along branches.
//!
//! The waves of a mode change over speed far more slowly than a drawn line needs points. A mode is named where its eigenproblem was
//! solved; an interpolated one has the waves of the nearest such point of its branch.

use faer::c64;
use rayon::prelude::*;

use super::points::{Branch, ModesAt, SpeedSample};
use crate::modes::{ModeName, NamedMode, SpectralModel, SpectrumError, smallest};

/// Samples with names, from the branches through all their modes.
///
/// # Errors
/// [`SpectrumError`] of the eigenproblem for a branch whose points are all interpolated.
pub fn named(
    model: &SpectralModel,
    samples: Vec<ModesAt>,
    branches: &[Branch],
) -> Result<Vec<SpeedSample>, SpectrumError> {
    let solved: Vec<Option<SpeedSample>> = samples
        .par_iter()
        .map(|sample| sample.is_solved().then(|| sample.named(model)))
        .collect();
    let mut taken: Vec<Vec<Option<ModeName>>> = samples
        .iter()
        .map(|sample| vec![None; sample.modes.len()])
        .collect();
    for Branch { points } in branches {
        let of_solved = |&(at, mode): &(usize, usize)| {
            let sample = solved[at].as_ref()?;
            Some((sample.speed_rad_per_s, sample.modes[mode].name.clone()))
        };
        let mut known: Vec<(f64, ModeName)> = points.iter().filter_map(of_solved).collect();
        if known.is_empty() {
            let (at, mode) = points[points.len() / 2];
            let (speed, lambda) = (samples[at].speed_rad_per_s, samples[at].modes[mode].lambda);
            known.extend(solved_name(model, speed, lambda)?.map(|name| (speed, name)));
        }
        for &(at, mode) in points.iter().filter(|(at, _)| solved[*at].is_none()) {
            let away = |known: &&(f64, ModeName)| (known.0 - samples[at].speed_rad_per_s).abs();
            let nearest = smallest(&known, away);
            taken[at][mode] = nearest.map(|(_, name)| name.of_same_waves(&samples[at].modes[mode]));
        }
    }
    let all = samples.into_iter().zip(solved).zip(taken);
    let named = all.map(|((sample, solved), taken)| {
        solved.unwrap_or_else(|| {
            let modes = sample.modes.into_iter().zip(taken);
            let named = modes.filter_map(|(mode, name)| Some(NamedMode { mode, name: name? }));
            SpeedSample {
                speed_rad_per_s: sample.speed_rad_per_s,
                modes: named.collect(),
            }
        })
    });
    Ok(named.collect())
}

/// Name of the mode nearest to an eigenvalue, by an eigenproblem of its own.
fn solved_name(
    model: &SpectralModel,
    speed_rad_per_s: f64,
    lambda: c64,
) -> Result<Option<ModeName>, SpectrumError> {
    let modes = model.modes(speed_rad_per_s)?;
    let Some(nearest) = smallest(modes, |mode| (mode.lambda - lambda).norm()) else {
        return Ok(None);
    };
    let named = model.name(speed_rad_per_s, vec![nearest]).pop();
    Ok(named.map(|named| named.name))
}
