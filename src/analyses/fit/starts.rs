//! Least squares from several starts.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::exchange::exchanged;
use super::least_squares::{Ends, Found, minimum};
use super::model::Model;
use super::{Options, Start};
use crate::model::scene::spread;
use crate::modes::SpectrumError;
use crate::modes::branches::Progress;

/// Largest number of starts with different results that are refined.
const REFINED: usize = 5;
/// Results whose shares of the bounds differ by less than this are one minimum.
const APART: f64 = 1e-2;
/// Seed of the starts that are spread between the bounds.
const SEED: u64 = 0;

/// Results of minimizing from every start.
pub struct Searched {
    pub starts: Vec<Start>,
    /// The best few minima, best first.
    pub candidates: Vec<Found>,
}

/// Minimizes from every start, then from the best result with the numbers of two guides exchanged.
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
    let mut from: Vec<Vec<f64>> = std::iter::once(own).chain(others).collect();
    let done = AtomicUsize::new(0);
    let reach = |starts: &[Vec<f64>], of: usize| -> Result<Vec<Option<Found>>, SpectrumError> {
        let each = starts.par_iter().map(|start| {
            let found = minimum(model, start, Ends::COARSE);
            progress(done.fetch_add(1, Ordering::Relaxed) + 1, of);
            found
        });
        each.collect()
    };
    let mut found = reach(&from, count)?;
    let lowest = found.iter().flatten();
    let best = lowest.min_by(|x, y| x.rms_hz.total_cmp(&y.rms_hz));
    let exchanged = best.map_or_else(Vec::new, |best| exchanged(freed, &best.shares));
    found.extend(reach(&exchanged, count + exchanged.len())?);
    from.extend(exchanged);
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
    let mut candidates = different(found);
    candidates.truncate(REFINED);
    Ok(Searched { starts, candidates })
}

/// One result of each minimum, best first.
fn different(found: Vec<Option<Found>>) -> Vec<Found> {
    let mut reached: Vec<Found> = found.into_iter().flatten().collect();
    reached.sort_by(|x, y| x.rms_hz.total_cmp(&y.rms_hz));
    let mut minima: Vec<Found> = Vec::new();
    for found in reached {
        let is_apart = |other: &Found| {
            let pairs = found.shares.iter().zip(&other.shares);
            pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) > APART
        };
        if minima.iter().all(is_apart) {
            minima.push(found);
        }
    }
    minima
}

/// The minima reached from candidates on a finer basis, best first; none if no candidate is a valid saw there.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub fn refined(model: &Model<'_>, candidates: &[Found]) -> Result<Vec<Found>, SpectrumError> {
    let refined: Vec<Option<Found>> = candidates
        .par_iter()
        .map(|found| minimum(model, &found.shares, Ends::EXACT))
        .collect::<Result<_, _>>()?;
    Ok(different(refined))
}
