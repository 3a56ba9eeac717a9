//! Least squares from several starts.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::least_squares::{Found, minimum};
use super::model::Model;
use super::{Options, Start};
use crate::model::scene::spread;
use crate::modes::SpectrumError;
use crate::modes::branches::Progress;

/// Largest number of starts with different results that are refined.
const REFINED: usize = 3;
/// Seed of the starts that are spread between the bounds.
const SEED: u64 = 0;

/// Results of minimizing from every start.
pub struct Searched {
    pub starts: Vec<Start>,
    /// The best few of different results, best first.
    pub candidates: Vec<Found>,
}

/// Minimizes from every start.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub fn search(
    model: &Model<'_>,
    options: &Options,
    progress: Progress<'_>,
) -> Result<Searched, SpectrumError> {
    let freed = model.freed;
    let count = options.starts.max(1);
    let own: Vec<f64> = freed.iter().map(|f| f.share_of(model.scene)).collect();
    let others = (0..count - 1).map(|index| spread(freed.len(), SEED, index));
    let from: Vec<Vec<f64>> = std::iter::once(own).chain(others).collect();
    let done = AtomicUsize::new(0);
    let found: Vec<Option<Found>> = from
        .par_iter()
        .map(|start| {
            let found = minimum(model, start);
            progress(done.fetch_add(1, Ordering::Relaxed) + 1, count);
            found
        })
        .collect::<Result<_, _>>()?;
    let values = |shares: &[f64]| -> Vec<f64> {
        let pairs = freed.iter().zip(shares);
        pairs.map(|(freed, share)| freed.value(*share)).collect()
    };
    let starts = from
        .iter()
        .zip(&found)
        .map(|(from, found)| Start {
            from: values(from),
            to: found.as_ref().map(|f| values(&f.shares)),
            rms_hz: found.as_ref().map(|f| f.rms_hz),
        })
        .collect();
    let mut reached: Vec<Found> = found.into_iter().flatten().collect();
    reached.sort_by(|x, y| x.rms_hz.total_cmp(&y.rms_hz));
    let mut candidates: Vec<Found> = Vec::new();
    for found in reached {
        let apart = |other: &Found| {
            let pairs = found.shares.iter().zip(&other.shares);
            pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) > 1e-2
        };
        if candidates.len() < REFINED && candidates.iter().all(apart) {
            candidates.push(found);
        }
    }
    Ok(Searched { starts, candidates })
}

/// The best result of minimizing from candidates on a finer basis; `None` if none of them is a valid saw.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub fn refined(model: &Model<'_>, candidates: &[Found]) -> Result<Option<Found>, SpectrumError> {
    let refined: Vec<Option<Found>> = candidates
        .par_iter()
        .map(|found| minimum(model, &found.shares))
        .collect::<Result<_, _>>()?;
    let found = refined.into_iter().flatten();
    Ok(found.min_by(|x, y| x.rms_hz.total_cmp(&y.rms_hz)))
}
