//! The intervals of a range of speeds, each with few vectors that span its low modes.

mod error;

use std::sync::Arc;
use std::sync::atomic::Ordering;

use faer::{Col, Mat, Scale, c64};
use rayon::prelude::*;

use super::arnoldi::{lowest_eigenpairs, nearly_lowest_eigenpairs};
use super::critical::NamedCriticalSpeed;
use super::error::SpectrumError;
use super::hamiltonian::HamiltonianReduction;
use super::inertia::UndampedFullModel;
use super::interval::{Interval, KnownModes, SPAN_MARGIN, StandingWave, states_at, states_between};
use super::mode::{ModeKind, classify, is_seen};
use super::model::{CHART_MODES, chart_height};
use super::projection::Projection;
use super::vectors::{Eigenpair, orthonormal, split};
use super::work::WorkCounters;
use crate::system::GyroscopicSystem;
use crate::tuned::Tuned;

/// Vectors closer than this to the span of the others are left out. Eigenvalues of
/// a projected symmetric problem are off by the square of it.
const SPAN_TOLERANCE: Tuned = Tuned::new("spectrum/guided_reduction::SPAN_TOLERANCE", 1e-6);
/// Largest estimated error of a projected frequency, relative to the chart's height.
const FREQUENCY_TOLERANCE: Tuned =
    Tuned::new("spectrum/guided_reduction::FREQUENCY_TOLERANCE", 1e-8);
/// A reflected wave may meet modes up to this multiple of the highest one's frequency.
const REFLECTED_MARGIN: Tuned = Tuned::new("spectrum/guided_reduction::REFLECTED_MARGIN", 1.3);
/// Largest estimated error of a frequency that is read off the states of an interval's ends, relative to the highest of
/// these: what is drawn needs no more, and edges and peaks are followed from there on the projection.
const STATES_TOLERANCE: Tuned = Tuned::new("spectrum/guided_reduction::STATES_TOLERANCE", 1e-5);
/// How often the stretch between a snapshot and the middle to the next is halved for the sake of these states.
const MOST_HALVINGS: usize = 3;
/// Relative distance of the first speed of the search for bands from the lowest critical speed: more
/// than the search itself keeps from it.
const BELOW_CRITICAL: f64 = 1e-3;
/// Length given to vectors of which no part may be left out.
const KEPT_WHOLE: f64 = 1e6;
/// Speeds at which modes of the full model are computed, at most.
const MAX_SNAPSHOTS: usize = 33;

/// The reduced models of a guided blade.
pub struct Reduction {
    /// By ascending speed.
    pub intervals: Vec<Interval>,
    /// Frequency up to which every mode is right.
    pub complete_to_rad_per_s: f64,
    /// Frequency up to which instabilities are searched for: a little above the highest reflected wave. 0 without one.
    pub reflected_to_rad_per_s: f64,
    /// Largest estimated error of a frequency above its tolerance, in rad/s: 0 unless the
    /// snapshots ran out.
    pub unsettled_rad_per_s: f64,
}

/// A guided blade, and what is known of it.
pub struct Guided<'a> {
    pub system: &'a GyroscopicSystem,
    /// Blocks and columns of its matrices, where it has such.
    pub structure: Option<&'a UndampedFullModel>,
    /// Size of its frequencies.
    pub scale: f64,
    /// Every critical speed of the range.
    pub critical: &'a [NamedCriticalSpeed],
}

/// Modes of the guided blade at a few speeds, more of them until every mode up to
/// the chart's height, and every reflected one, is right in between too.
///
/// For bands alone the modes that only a chart shows are left out, and the speeds below the lowest critical one, where no
/// wave is reflected: that costs a sixth.
///
/// # Errors
/// [`SpectrumError::Cancelled`].
pub fn of_guided(
    guided: Guided<'_>,
    range: (f64, f64),
    are_bands_enough: bool,
    counters: &WorkCounters,
) -> Result<Reduction, SpectrumError> {
    let mut builder = Builder::new(guided, range, counters);
    let reflected = || builder.reflected_height(range.1);
    let chart = || builder.chart_height(range.0);
    let ((reflected, last), chart) = match are_bands_enough {
        true => (reflected()?, None),
        false => {
            let (reflected, chart) = rayon::join(reflected, chart);
            (reflected?, Some(chart?))
        }
    };
    let chart = match chart {
        None if reflected == 0.0 => Some(builder.chart_height(range.0)?),
        chart => chart,
    };
    counters.cancellation.check()?;
    builder.reflected = reflected;
    builder.window = reflected;
    let mut known: Vec<Snapshot> = last.into_iter().collect();
    match chart {
        Some((height, first)) => {
            builder.window = height.max(reflected);
            known.push(first);
        }
        None => builder.range.0 = builder.first_reflecting(),
    }
    builder.add_first_snapshots(known)?;
    Ok(Reduction {
        intervals: builder.intervals()?,
        complete_to_rad_per_s: builder.window,
        reflected_to_rad_per_s: reflected,
        unsettled_rad_per_s: builder.unsettled_rad_per_s,
    })
}

/// Low modes of the whole system at one speed.
#[derive(Clone)]
struct Snapshot {
    speed: f64,
    pairs: Vec<Eigenpair>,
}

/// What is tried between two snapshots.
struct Tried {
    intervals: Vec<Interval>,
    middle: f64,
    is_kept: bool,
    unsettled_rad_per_s: f64,
}

struct Builder<'a> {
    guided: Guided<'a>,
    standing: Vec<StandingWave<'a>>,
    range: (f64, f64),
    counters: &'a WorkCounters,
    /// Frequency up to which modes are wanted.
    window: f64,
    /// Frequency up to which they are wanted for the search.
    reflected: f64,
    snapshots: Vec<Snapshot>,
    unsettled_rad_per_s: f64,
}

impl<'a> Builder<'a> {
    fn new(guided: Guided<'a>, range: (f64, f64), counters: &'a WorkCounters) -> Self {
        let critical = guided.critical.iter();
        Builder {
            standing: critical.map(|c| (c.speed_rad_per_s, &c.shape)).collect(),
            guided,
            range,
            counters,
            window: 0.0,
            reflected: 0.0,
            snapshots: Vec::new(),
            unsettled_rad_per_s: 0.0,
        }
    }

    /// The first snapshots, of which some may be known already.
    fn add_first_snapshots(&mut self, known: Vec<Snapshot>) -> Result<(), SpectrumError> {
        let mut speeds = first_speeds(self.range).to_vec();
        for known in known {
            if self.covers(&known) {
                speeds.retain(|speed| *speed != known.speed);
                self.snapshots.push(known);
            }
        }
        self.add_snapshots(&speeds)
    }

    fn lowest(&self, speed: f64, count: usize) -> Result<Vec<Eigenpair>, SpectrumError> {
        self.lowest_of(self.guided.system, speed, count)
    }

    fn lowest_of(
        &self,
        system: &GyroscopicSystem,
        speed: f64,
        count: usize,
    ) -> Result<Vec<Eigenpair>, SpectrumError> {
        self.counters.full_solves.fetch_add(1, Ordering::Relaxed);
        let shift = 0.5 * self.guided.scale;
        if let Some(basis) = self.guided.structure
            && let Some(found) = nearly_lowest_eigenpairs(basis, system, speed, count, shift)?
        {
            let structured = &self.counters.structured_solves;
            structured.fetch_add(1, Ordering::Relaxed);
            return Ok(found);
        }
        lowest_eigenpairs(system, speed, count, shift)
    }

    fn chart_height(&self, speed: f64) -> Result<(f64, Snapshot), SpectrumError> {
        let Guided { system, scale, .. } = self.guided;
        let is_conservative = system.is_conservative();
        let mut count = CHART_MODES + 2;
        loop {
            let pairs = self.lowest(speed, count)?;
            let lambdas: Vec<c64> = pairs.iter().map(|(lambda, _)| *lambda).collect();
            let seen = lambdas.iter().filter(|lambda| is_seen(**lambda)).count();
            if is_conservative || seen >= CHART_MODES || 2 * count >= system.order() {
                let height = chart_height(&lambdas, is_conservative).unwrap_or(scale);
                return Ok((height, Snapshot { speed, pairs }));
            }
            // Those that decay without oscillating stand between.
            count *= 2;
        }
    }

    /// Whether a snapshot has every mode of the window.
    fn covers(&self, snapshot: &Snapshot) -> bool {
        let highest = snapshot.pairs.last();
        highest.is_some_and(|(lambda, _)| lambda.norm() > self.window)
    }

    /// Highest reflected wave at the top speed, with a margin for what it may meet; of a damped
    /// blade that of its undamped twin, for these are the waves that damping feeds.
    fn reflected_height(&self, speed: f64) -> Result<(f64, Option<Snapshot>), SpectrumError> {
        let Guided {
            system,
            scale,
            critical,
            ..
        } = self.guided;
        let index = critical.partition_point(|c| c.speed_rad_per_s < speed);
        if index == 0 {
            return Ok((0.0, None));
        }
        let is_damped = !system.is_conservative();
        let twin = is_damped.then(|| system.conservative());
        let system = twin.as_ref().unwrap_or(system);
        let mut count = CHART_MODES + index;
        loop {
            let pairs = self.lowest_of(system, speed, count)?;
            let modes = classify(system, speed, 0, pairs.clone());
            let negative = |kind| match kind {
                ModeKind::Negative | ModeKind::Flutter => 2,
                ModeKind::Divergent => 1,
                _ => 0,
            };
            let found: usize = modes.iter().map(|mode| negative(mode.kind)).sum();
            if found >= index || 2 * count >= system.order() {
                let highest = modes.iter().filter(|mode| negative(mode.kind) > 0);
                let height = highest.fold(0.0, |top, mode| mode.frequency_rad_per_s().max(top));
                let height = REFLECTED_MARGIN.get() * height.max(0.1 * scale);
                return Ok((height, (!is_damped).then_some(Snapshot { speed, pairs })));
            }
            count *= 2;
        }
    }

    /// Every mode below the chart's height at each speed, and one above it.
    fn add_snapshots(&mut self, speeds: &[f64]) -> Result<(), SpectrumError> {
        let new: Result<Vec<Snapshot>, SpectrumError> = speeds
            .par_iter()
            .map(|&speed| self.snapshot(speed))
            .collect();
        self.snapshots.extend(new?);
        self.snapshots.sort_by(|x, y| x.speed.total_cmp(&y.speed));
        Ok(())
    }

    fn snapshot(&self, speed: f64) -> Result<Snapshot, SpectrumError> {
        let mut count = CHART_MODES + 2;
        loop {
            let pairs = self.lowest(speed, count)?;
            let snapshot = Snapshot { speed, pairs };
            if self.covers(&snapshot) || 2 * count >= self.guided.system.order() {
                return Ok(snapshot);
            }
            count += count / 2;
        }
    }

    /// Where waves are first reflected: a little below the lowest critical speed, as far as the
    /// range goes.
    fn first_reflecting(&self) -> f64 {
        let (from, to) = self.range;
        let lowest = self.guided.critical.first();
        let lowest = lowest.map_or(from, |c| c.speed_rad_per_s);
        match lowest * (1.0 + BELOW_CRITICAL) < to {
            true => (lowest * (1.0 - BELOW_CRITICAL)).max(from),
            false => from,
        }
    }

    /// The modes at two snapshots; of the others those that the search follows; and the standing waves of the
    /// critical speeds between the two: with these the projected K(Ω) is singular at the same speeds as
    /// the whole one, to the last digit.
    fn basis(&self, [from, to]: [&Snapshot; 2]) -> Mat<f64> {
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

    /// The reduced models between neighbouring snapshots, more of which are added until each is right in its middle.
    fn intervals(&mut self) -> Result<Vec<Interval>, SpectrumError> {
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

    fn tried(&self, ends: [&Snapshot; 2]) -> Result<Tried, SpectrumError> {
        let Guided {
            system, structure, ..
        } = self.guided;
        let projection = Arc::new(Projection::new(system, structure, self.basis(ends)));
        let [from, to] = ends.map(|end| end.speed);
        let middle = KnownModes::of(&projection, 0.5 * (from + to), self.counters)?;
        let speed = middle.speed_rad_per_s;
        let error = self.frequency_error(&projection, speed, self.window, &middle.pairs);
        let unsettled_rad_per_s = match error > FREQUENCY_TOLERANCE.get() * self.window {
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

    /// The intervals between two speeds, each so short that the states of its ends are good enough to draw from.
    fn between(
        &self,
        projection: &Arc<Projection>,
        ends: [&KnownModes; 2],
        halvings: usize,
    ) -> Result<Vec<Interval>, SpectrumError> {
        let [from, to] = ends.map(|end| end.speed_rad_per_s);
        let middle = 0.5 * (from + to);
        let up_to = |height: f64| states_between(projection, ends, &self.standing, height);
        let is_good = |states: &HamiltonianReduction, height: f64| {
            // Where the eigenproblem of the states fails, that of the projection takes its place.
            states_at(states, middle, self.counters).is_ok_and(|pairs| {
                let error = self.frequency_error(projection, middle, height, &pairs);
                error <= STATES_TOLERANCE.get() * height
            })
        };
        let mut drawn = up_to(self.window);
        let mut searched = match self.reflected > 0.0 {
            true => up_to(self.reflected),
            false => None,
        };
        let are_good = [(&drawn, self.window), (&searched, self.reflected)]
            .map(|(states, height)| states.as_ref().is_none_or(|states| is_good(states, height)));
        if are_good != [true; 2] && halvings > 0 {
            let middle = KnownModes::of(projection, middle, self.counters)?;
            let mut halves = self.between(projection, [ends[0], &middle], halvings - 1)?;
            halves.extend(self.between(projection, [&middle, ends[1]], halvings - 1)?);
            return Ok(halves);
        }
        for (states, is_good) in [&mut drawn, &mut searched].into_iter().zip(are_good) {
            if !is_good {
                *states = None;
            }
        }
        Ok(vec![Interval {
            to_rad_per_s: to,
            projection: projection.clone(),
            drawn,
            searched,
        }])
    }
}

/// Speeds of the first snapshots.
fn first_speeds((from, to): (f64, f64)) -> [f64; 5] {
    [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| from + share * (to - from))
}
