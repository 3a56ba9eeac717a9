//! Makes intervals from snapshots: the interval between two snapshots is projected, its error is estimated in
//! the middle, and it is accepted or halved.

use std::sync::Arc;

use faer::{Col, Mat, Scale};
use rayon::prelude::*;

use super::{Builder, Guided, Snapshot};
use crate::spectrum::critical::NamedCriticalSpeed;
use crate::spectrum::error::SpectrumError;
use crate::spectrum::hamiltonian::HamiltonianReduction;
use crate::spectrum::interval::{Interval, KnownModes, SPAN_MARGIN, states_at, states_between};
use crate::spectrum::projection::Projection;
use crate::spectrum::vectors::{orthonormal, split};
use crate::tuned::Tuned;

/// Vectors closer than this to the span of the others are omitted. The error of eigenvalues of a projected
/// symmetric problem is the square of it.
const SPAN_TOLERANCE: Tuned = Tuned::new("spectrum/guided_reduction::SPAN_TOLERANCE", 1e-6);
/// Largest estimated error of a projected frequency, relative to the height of the diagram.
const FREQUENCY_TOLERANCE: Tuned =
    Tuned::new("spectrum/guided_reduction::FREQUENCY_TOLERANCE", 1e-8);
/// Largest estimated error of a frequency from the states of an interval's ends, relative to the highest of
/// these. It suffices for diagrams; edges and peaks are computed from there on the projection.
const STATES_TOLERANCE: Tuned = Tuned::new("spectrum/guided_reduction::STATES_TOLERANCE", 1e-5);
/// Factors for these two tolerances in a preview: together they halve its cost for an undamped blade. The
/// bands of the saws of the gallery then change by less than 0.1 rpm.
const SKETCHED: [f64; 2] = [100.0, 10.0];
/// Number of times that the interval between a snapshot and its middle may be halved for these states.
const MOST_HALVINGS: usize = 3;
/// Length given to vectors that must be represented completely.
const KEPT_WHOLE: f64 = 1e6;
/// Largest number of speeds at which modes of the full model are computed.
const MAX_SNAPSHOTS: usize = 33;

/// A trial between two snapshots.
struct Tried {
    intervals: Vec<Interval>,
    middle: f64,
    is_kept: bool,
    unsettled_rad_per_s: f64,
}

impl Builder<'_> {
    /// The modes at two snapshots, those modes of others that the search follows, and the standing waves of
    /// the critical speeds in between: with these the projected K(Ω) is singular at exactly the same speeds
    /// as that of the full model.
    pub(super) fn basis(&self, [from, to]: [&Snapshot; 2]) -> Mat<f64> {
        let system = self.guided.system;
        let between = from.speed..=to.speed;
        let inside = |c: &&NamedCriticalSpeed| between.contains(&c.speed_rad_per_s);
        let standing = self.guided.critical.iter().filter(inside);
        let kept = standing.map(|c| &c.shape).chain(&system.free_rigid);
        let mut vectors: Vec<Col<f64>> = kept.map(|x| Scale(KEPT_WHOLE) * x).collect();
        let followed = match system.is_conservative() {
            true => self.reflected,
            false => 0.0,
        };
        for snapshot in &self.snapshots {
            let height = match between.contains(&snapshot.speed) {
                true => self.window,
                false => followed,
            };
            for (lambda, q) in &snapshot.pairs {
                if lambda.norm() <= SPAN_MARGIN.get() * height {
                    let (re, im) = split(q);
                    vectors.extend([re, im]);
                }
            }
        }
        orthonormal(system.order(), &vectors, SPAN_TOLERANCE.get())
    }

    /// The reduced models between neighbouring snapshots, of which more are added until each model is
    /// accurate in its middle.
    pub(super) fn intervals(&mut self) -> Result<Vec<Interval>, SpectrumError> {
        let mut finished: Vec<(f64, Vec<Interval>)> = Vec::new();
        loop {
            self.counters.cancellation.check()?;
            let is_open = |pair: &&[Snapshot]| finished.iter().all(|(to, _)| *to != pair[1].speed);
            let open: Vec<&[Snapshot]> = self.snapshots.windows(2).filter(is_open).collect();
            let tried = open.into_par_iter().map(|pair| {
                let tried = self.tried([&pair[0], &pair[1]])?;
                Ok((pair[1].speed, tried))
            });
            let tried: Vec<(f64, Tried)> = tried.collect::<Result<_, SpectrumError>>()?;
            let mut coarse = Vec::new();
            for (to, tried) in tried {
                if !tried.is_kept {
                    coarse.push(tried.middle);
                    continue;
                }
                finished.push((to, tried.intervals));
                self.unsettled_rad_per_s = self.unsettled_rad_per_s.max(tried.unsettled_rad_per_s);
            }
            if coarse.is_empty() {
                finished.sort_by(|x, y| x.0.total_cmp(&y.0));
                return Ok(finished
                    .into_iter()
                    .flat_map(|(_, intervals)| intervals)
                    .collect());
            }
            self.add_snapshots(&coarse)?;
        }
    }

    /// Largest relative errors of the frequencies of a projection, and of those from states.
    fn tolerances(&self) -> [f64; 2] {
        let usual = [FREQUENCY_TOLERANCE.get(), STATES_TOLERANCE.get()];
        let factors = if self.is_sketch { SKETCHED } else { [1.0; 2] };
        [usual[0] * factors[0], usual[1] * factors[1]]
    }

    fn tried(&self, ends: [&Snapshot; 2]) -> Result<Tried, SpectrumError> {
        let Guided {
            system, structure, ..
        } = self.guided;
        let [frequencies, _] = self.tolerances();
        let projection = Arc::new(Projection::new(system, structure, self.basis(ends)));
        let [from, to] = ends.map(|end| end.speed);
        let middle = KnownModes::of(&projection, 0.5 * (from + to), self.counters)?;
        let speed = middle.speed_rad_per_s;
        let error = self.frequency_error(&projection, speed, self.window, &middle.pairs);
        let unsettled_rad_per_s = match error > frequencies * self.window {
            true => error,
            false => 0.0,
        };
        let is_kept = unsettled_rad_per_s == 0.0 || self.snapshots.len() >= MAX_SNAPSHOTS;
        let mut intervals = Vec::new();
        if is_kept {
            let inward = |end: &Snapshot| {
                let pairs = end.pairs.iter().map(|pair| projection.inward(pair));
                KnownModes {
                    speed_rad_per_s: end.speed,
                    pairs: pairs.collect(),
                }
            };
            let [first, last] = ends.map(inward);
            for ends in [[&first, &middle], [&middle, &last]] {
                intervals.extend(self.between(&projection, ends, MOST_HALVINGS)?);
            }
        }
        Ok(Tried {
            intervals,
            middle: middle.speed_rad_per_s,
            is_kept,
            unsettled_rad_per_s,
        })
    }

    /// The intervals between two speeds, each so short that the states of its ends are accurate enough for
    /// diagram and search.
    fn between(
        &self,
        projection: &Arc<Projection>,
        ends: [&KnownModes; 2],
        halvings: usize,
    ) -> Result<Vec<Interval>, SpectrumError> {
        let [from, to] = ends.map(|end| end.speed_rad_per_s);
        let middle = 0.5 * (from + to);
        let [_, tolerance] = self.tolerances();
        // The flag states whether the states are accurate enough. They are not if their eigenproblem fails; that of
        // the projection then replaces it.
        let states_up_to = |height: f64| {
            let states = states_between(projection, ends, &self.standing, height)?;
            let pairs = states_at(&states, middle, self.counters);
            let is_good = pairs.is_ok_and(|pairs| {
                let error = self.frequency_error(projection, middle, height, &pairs);
                error <= tolerance * height
            });
            Some((states, is_good))
        };
        let drawn = states_up_to(self.window);
        let searched = if self.reflected == 0.0 {
            None
        } else if self.reflected == self.window {
            drawn.clone()
        } else {
            states_up_to(self.reflected)
        };
        let are_good = [&drawn, &searched]
            .into_iter()
            .flatten()
            .all(|(_, is_good)| *is_good);
        if !are_good && halvings > 0 {
            let middle = KnownModes::of(projection, middle, self.counters)?;
            let mut halves = self.between(projection, [ends[0], &middle], halvings - 1)?;
            halves.extend(self.between(projection, [&middle, ends[1]], halvings - 1)?);
            return Ok(halves);
        }
        let good = |found: Option<(HamiltonianReduction, bool)>| {
            found.and_then(|(states, is_good)| is_good.then_some(states))
        };
        Ok(vec![Interval {
            to_rad_per_s: to,
            projection: projection.clone(),
            drawn: good(drawn),
            searched: good(searched),
        }])
    }
}
