//! Makes intervals from snapshots: the interval between two snapshots is projected, its error is estimated in
//! the middle, and it is accepted or halved.

use std::sync::Arc;

use faer::{Col, Mat, Scale};
use rayon::prelude::*;

use super::{Builder, Guided, Snapshot};
use crate::model::tuning::Tuned;
use crate::modes::critical_speed::NamedCriticalSpeed;
use crate::modes::error::SpectrumError;
use crate::modes::hamiltonian_reduction::HamiltonianReduction;
use crate::modes::interval::{Interval, KnownModes, SPAN_MARGIN, states_at, states_between};
use crate::modes::projection::Projection;
use crate::modes::vectors::{orthonormal, split};

/// Vectors closer than this to the span of the others are omitted. The error of the eigenvalues of a projected
/// symmetric problem is the square of this distance.
const SPAN_TOLERANCE: Tuned = Tuned::new("modes/guided_reduction::SPAN_TOLERANCE", 1e-6);
/// Largest estimated error of a projected frequency, relative to the window. With 1e-8 two pads need 15 speeds of the full model
/// instead of 8; edges of bands of the saws of the gallery then differ by at most 7e-9, and their growth by 2e-6.
const FREQUENCY_TOLERANCE: Tuned = Tuned::new("modes/guided_reduction::FREQUENCY_TOLERANCE", 1e-7);
/// Largest estimated error of a frequency from the states of an interval's ends, relative to the height up to
/// which they are used. It suffices for diagrams; edges and peaks are then computed on the projection.
const STATES_TOLERANCE: Tuned = Tuned::new("modes/guided_reduction::STATES_TOLERANCE", 1e-5);
/// Factor for [`FREQUENCY_TOLERANCE`] and [`STATES_TOLERANCE`] in a preview: it halves its time for an undamped blade and changes
/// the bands of the saws of the gallery by less than 0.1 rpm.
const SKETCHED: f64 = 10.0;
/// Number of times that the interval between a snapshot and the middle to the next one may be halved for the
/// accuracy of states.
const MOST_HALVINGS: usize = 3;
/// Length given to vectors that the basis must represent completely.
const KEPT_WHOLE: f64 = 1e6;
/// Largest number of speeds at which modes of the full model are computed.
const MAX_SNAPSHOTS: usize = 33;

/// The projection between two snapshots on trial.
struct Tried {
    /// Its intervals if it is kept, otherwise empty.
    intervals: Vec<Interval>,
    /// Speed of the next snapshot if it is not kept.
    middle: f64,
    is_kept: bool,
    /// Estimated error of a frequency that exceeds the tolerance, in rad/s; otherwise 0.
    unsettled_rad_per_s: f64,
}

impl Builder<'_> {
    /// Orthonormal basis of the modes at two snapshots, of the modes of other snapshots that the search follows,
    /// and of the standing waves of the critical speeds in between: because of these waves the projected K(Ω) is
    /// singular at exactly the critical speeds of the full model.
    pub(super) fn basis(&self, [from, to]: [&Snapshot; 2]) -> Mat<f64> {
        let system = self.guided.system;
        let between = from.speed..=to.speed;
        let inside = |c: &&NamedCriticalSpeed| between.contains(&c.speed_rad_per_s);
        let standing = self.guided.critical.iter().filter(inside);
        let kept = standing.map(|c| &c.shape).chain(&system.free_rigid);
        let mut vectors: Vec<Col<f64>> = kept.map(|x| Scale(KEPT_WHOLE) * x).collect();
        for snapshot in &self.snapshots {
            let height = if between.contains(&snapshot.speed) {
                self.window
            } else {
                self.reflected
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
            let tried: Vec<(f64, Tried)> = open
                .into_par_iter()
                .map(|pair| {
                    let tried = self.tried([&pair[0], &pair[1]])?;
                    Ok((pair[1].speed, tried))
                })
                .collect::<Result<_, SpectrumError>>()?;
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
        let factor = if self.is_sketch { SKETCHED } else { 1.0 };
        [FREQUENCY_TOLERANCE, STATES_TOLERANCE].map(|usual| factor * usual.get())
    }

    /// Projects between two snapshots and estimates the error in the middle.
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
        let unsettled_rad_per_s = if error > frequencies * self.window {
            error
        } else {
            0.0
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
        // `is_good` is true if the states are accurate enough. It is false also if their eigenproblem fails,
        // because then the interval is halved or the eigenproblem of the projection replaces it.
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
