//! The projection that a search for bands goes by.

use rayon::prelude::*;

use super::{Builder, FREQUENCY_TOLERANCE, MAX_SNAPSHOTS, Snapshot, low_pairs};
use crate::spectrum::component::ReflectedProjection;
use crate::spectrum::error::SpectrumError;
use crate::spectrum::projection::Projection;
use crate::spectrum::reflected::{KnownStates, SPAN_MARGIN};

/// Relative distance of the first speed of the search for bands from the lowest critical speed: more
/// than the search itself keeps from it.
const BELOW_CRITICAL: f64 = 1e-3;

impl Builder<'_> {
    /// Where the search for bands begins: a little below the lowest critical speed, as far as the
    /// range goes.
    pub(super) fn first_reflecting(&self) -> f64 {
        let (from, to) = self.range;
        let lowest = self.critical.first().map_or(from, |c| c.speed_rad_per_s);
        match lowest * (1.0 + BELOW_CRITICAL) < to {
            true => (lowest * (1.0 - BELOW_CRITICAL)).max(from),
            false => from,
        }
    }

    /// One projection for all speeds at which waves are reflected, from the modes up to a height
    /// at every snapshot; snapshots are added until it is right halfway between them. What was
    /// right once stays so, for the space only grows.
    pub(super) fn whole_range(
        &mut self,
        height: f64,
    ) -> Result<ReflectedProjection, SpectrumError> {
        let mut settled: Vec<Snapshot> = Vec::new();
        let from = self.first_reflecting();
        loop {
            self.counters.cancellation.check()?;
            let first = self.snapshots.partition_point(|s| s.speed <= from);
            let snapshots = &self.snapshots[first.saturating_sub(1)..];
            let basis = self.basis(&self.snapshots, height);
            let projection = Projection::new(self.system, self.structure, basis, self.range.1);
            let mut halfway = halfway(snapshots);
            halfway.retain(|speed| settled.iter().all(|known| known.speed != *speed));
            let tried: Vec<(f64, Snapshot)> = halfway
                .par_iter()
                .map(|&speed| {
                    let pairs = self.pairs(&projection, speed)?;
                    let error = self.frequency_error(&projection, speed, height, &pairs);
                    let pairs = projection.outward(low_pairs(pairs, 2.0 * height));
                    Ok((error, Snapshot { speed, pairs }))
                })
                .collect::<Result<_, SpectrumError>>()?;
            let largest = tried.iter().map(|(error, _)| *error).fold(0.0, f64::max);
            let (coarse, fine): (Vec<_>, Vec<_>) = tried
                .into_iter()
                .partition(|(error, _)| *error > FREQUENCY_TOLERANCE.get() * self.window);
            settled.extend(fine.into_iter().map(|(_, found)| found));
            let has_given_up = self.snapshots.len() >= MAX_SNAPSHOTS;
            if coarse.is_empty() || has_given_up {
                if has_given_up {
                    self.unsettled_rad_per_s = self.unsettled_rad_per_s.max(largest);
                }
                settled.extend(snapshots.iter().cloned());
                return Ok(ReflectedProjection {
                    known: self.states(&projection, height, settled)?,
                    projection,
                    height_rad_per_s: height,
                });
            }
            let speeds: Vec<f64> = coarse.into_iter().map(|(_, found)| found.speed).collect();
            self.add_snapshots(&speeds)?;
        }
    }

    /// The states of the modes that a search for bands up to a height goes by, by ascending speed.
    fn states(
        &self,
        projection: &Projection,
        height: f64,
        known: Vec<Snapshot>,
    ) -> Result<Vec<KnownStates>, SpectrumError> {
        let height = SPAN_MARGIN.get() * height;
        let states = |Snapshot { speed, pairs }| {
            let is_complete = pairs.iter().any(|(lambda, _)| lambda.norm() > height);
            let mut pairs = match is_complete {
                true => pairs.iter().map(|pair| projection.inward(pair)).collect(),
                false => self.pairs(projection, speed)?,
            };
            pairs.retain(|(lambda, _)| lambda.im <= height);
            Ok((speed, projection.states(speed, pairs)))
        };
        let states = known.into_par_iter().map(states);
        let mut states: Vec<KnownStates> = states.collect::<Result<_, SpectrumError>>()?;
        states.sort_by(|x, y| x.0.total_cmp(&y.0));
        Ok(states)
    }
}

fn halfway(snapshots: &[Snapshot]) -> Vec<f64> {
    let middle = |pair: &[Snapshot]| 0.5 * (pair[0].speed + pair[1].speed);
    snapshots.windows(2).map(middle).collect()
}
