//! Few vectors that span the low modes over a whole range of speeds.

mod drawn;
mod error;
mod reflecting;

use std::sync::atomic::Ordering;

use faer::{Col, Mat, Scale, c64};
use rayon::prelude::*;

use super::arnoldi::{lowest_eigenpairs, nearly_lowest_eigenpairs};
use super::component::ReflectedProjection;
use super::critical::NamedCriticalSpeed;
use super::error::SpectrumError;
use super::half_order;
use super::inertia::WholeBasis;
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
/// The same for modes that are only drawn: a chart has three digits, its numbers six.
const DRAWN_TOLERANCE: Tuned = Tuned::new("spectrum/guided_reduction::DRAWN_TOLERANCE", 1e-7);
/// A reflected wave may meet modes up to this multiple of the highest one's frequency.
const REFLECTED_MARGIN: Tuned = Tuned::new("spectrum/guided_reduction::REFLECTED_MARGIN", 1.3);
/// Modes up to this multiple of the window go into the basis: those that dip into it between snapshots.
const SNAPSHOT_MARGIN: Tuned = Tuned::new("spectrum/guided_reduction::SNAPSHOT_MARGIN", 1.5);
/// Length given to vectors of which no part may be left out.
const KEPT_WHOLE: f64 = 1e6;
/// Speeds at which modes of the whole basis are computed, at most.
const MAX_SNAPSHOTS: usize = 33;

/// Projections of a guided blade.
pub struct GuidedReductions {
    /// Every mode up to the height of the chart, one projection for each interval
    /// between neighbouring snapshots, on the modes at its two ends.
    pub chart: Vec<Projection>,
    /// Every mode up to a little above the highest reflected wave, if there is one,
    /// for the whole range: the search for bands needs no more, and so asks less.
    pub low: Option<ReflectedProjection>,
    /// Height of the chart.
    pub chart_rad_per_s: f64,
    /// Largest estimated error of a frequency above its tolerance, in rad/s: 0 unless the
    /// snapshots ran out.
    pub unsettled_rad_per_s: f64,
}

/// Modes of the guided blade at a few speeds, more of them until every mode up to
/// the chart's height, and every reflected one, is right in between too.
///
/// # Errors
/// [`SpectrumError::Cancelled`].
pub fn of_guided(
    system: &GyroscopicSystem,
    structure: Option<&WholeBasis>,
    range: (f64, f64),
    scale: f64,
    critical: &[NamedCriticalSpeed],
    counters: &WorkCounters,
) -> Result<GuidedReductions, SpectrumError> {
    let mut builder = Builder::new(system, range, scale, critical, counters);
    builder.structure = structure;
    let (reflected, drawn) = rayon::join(
        || builder.reflected_height(range.1),
        || builder.chart_height(range.0),
    );
    let ((low_rad_per_s, last), (chart_rad_per_s, first)) = (reflected?, drawn?);
    counters.cancellation.check()?;
    builder.window = chart_rad_per_s.max(low_rad_per_s);
    builder.add_first_snapshots([Some(first), last])?;
    let low = match low_rad_per_s > 0.0 && system.is_conservative() {
        true => Some(builder.whole_range(low_rad_per_s)?),
        false => None,
    };
    Ok(GuidedReductions {
        chart: builder.pieces()?,
        low,
        chart_rad_per_s: builder.window,
        unsettled_rad_per_s: builder.unsettled_rad_per_s,
    })
}

/// The projection on the modes that bands are made of alone.
pub struct BandReduction {
    /// The projection.
    pub low: ReflectedProjection,
    /// As in [`GuidedReductions`].
    pub unsettled_rad_per_s: f64,
}

/// The projection on the modes that bands are made of alone; nothing where no wave is reflected.
/// Without the modes above, that only a chart shows, and the speeds below the lowest critical one,
/// where no wave is reflected, it costs a sixth.
pub fn for_bands(
    system: &GyroscopicSystem,
    structure: Option<&WholeBasis>,
    range: (f64, f64),
    scale: f64,
    critical: &[NamedCriticalSpeed],
    counters: &WorkCounters,
) -> Result<Option<BandReduction>, SpectrumError> {
    let mut builder = Builder::new(system, range, scale, critical, counters);
    builder.structure = structure;
    let (height, last) = builder.reflected_height(range.1)?;
    if height == 0.0 {
        return Ok(None);
    }
    builder.window = height;
    builder.range.0 = builder.first_reflecting();
    builder.add_first_snapshots([None, last])?;
    Ok(Some(BandReduction {
        low: builder.whole_range(height)?,
        unsettled_rad_per_s: builder.unsettled_rad_per_s,
    }))
}

/// Low modes of the whole system at one speed.
#[derive(Clone)]
struct Snapshot {
    speed: f64,
    pairs: Vec<Eigenpair>,
}

/// A projection between two snapshots, and what its middle says of it.
struct Tried {
    piece: Projection,
    middle: f64,
    is_kept: bool,
    unsettled_rad_per_s: f64,
}

struct Builder<'a> {
    system: &'a GyroscopicSystem,
    /// Blocks and columns of its matrices, where it has such.
    structure: Option<&'a WholeBasis>,
    range: (f64, f64),
    scale: f64,
    critical: &'a [NamedCriticalSpeed],
    counters: &'a WorkCounters,
    window: f64,
    snapshots: Vec<Snapshot>,
    unsettled_rad_per_s: f64,
}

impl<'a> Builder<'a> {
    fn new(
        system: &'a GyroscopicSystem,
        range: (f64, f64),
        scale: f64,
        critical: &'a [NamedCriticalSpeed],
        counters: &'a WorkCounters,
    ) -> Self {
        Builder {
            system,
            structure: None,
            range,
            scale,
            critical,
            counters,
            window: 0.0,
            snapshots: Vec::new(),
            unsettled_rad_per_s: 0.0,
        }
    }

    /// The first snapshots, of which some may be known already.
    fn add_first_snapshots(&mut self, known: [Option<Snapshot>; 2]) -> Result<(), SpectrumError> {
        let mut speeds = first_speeds(self.range).to_vec();
        for known in known.into_iter().flatten() {
            if self.covers(&known) {
                speeds.retain(|speed| *speed != known.speed);
                self.snapshots.push(known);
            }
        }
        self.add_snapshots(&speeds)
    }

    fn lowest(&self, speed: f64, count: usize) -> Result<Vec<Eigenpair>, SpectrumError> {
        self.lowest_of(self.system, speed, count)
    }

    fn lowest_of(
        &self,
        system: &GyroscopicSystem,
        speed: f64,
        count: usize,
    ) -> Result<Vec<Eigenpair>, SpectrumError> {
        self.counters.full_solves.fetch_add(1, Ordering::Relaxed);
        let shift = 0.5 * self.scale;
        if let Some(basis) = self.structure
            && let Some(found) = nearly_lowest_eigenpairs(basis, system, speed, count, shift)?
        {
            let structured = &self.counters.structured_solves;
            structured.fetch_add(1, Ordering::Relaxed);
            return Ok(found);
        }
        lowest_eigenpairs(system, speed, count, shift)
    }

    fn chart_height(&self, speed: f64) -> Result<(f64, Snapshot), SpectrumError> {
        let is_conservative = self.system.is_conservative();
        let mut count = CHART_MODES + 2;
        loop {
            let pairs = self.lowest(speed, count)?;
            let lambdas: Vec<c64> = pairs.iter().map(|(lambda, _)| *lambda).collect();
            let seen = lambdas.iter().filter(|lambda| is_seen(**lambda)).count();
            if is_conservative || seen >= CHART_MODES || 2 * count >= self.system.order() {
                let height = chart_height(&lambdas, is_conservative).unwrap_or(self.scale);
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
        let index = self.critical.partition_point(|c| c.speed_rad_per_s < speed);
        if index == 0 {
            return Ok((0.0, None));
        }
        let is_damped = !self.system.is_conservative();
        let twin = is_damped.then(|| self.system.conservative());
        let system = twin.as_ref().unwrap_or(self.system);
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
            if found >= index || 2 * count >= self.system.order() {
                let highest = modes.iter().filter(|mode| negative(mode.kind) > 0);
                let height = highest.fold(0.0, |top, mode| mode.frequency_rad_per_s().max(top));
                let height = REFLECTED_MARGIN.get() * height.max(0.1 * self.scale);
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
            if self.covers(&snapshot) || 2 * count >= self.system.order() {
                return Ok(snapshot);
            }
            count += count / 2;
        }
    }

    /// The modes up to a height at some snapshots, and the standing waves of the critical
    /// speeds between them: with these the projected K(Ω) is singular at the same speeds as
    /// the whole one, to the last digit.
    fn basis(&self, snapshots: &[Snapshot], height: f64) -> Mat<f64> {
        let (from, to) = match (snapshots.first(), snapshots.last()) {
            (Some(first), Some(last)) => (first.speed, last.speed),
            _ => self.range,
        };
        let inside = |c: &&NamedCriticalSpeed| (from..=to).contains(&c.speed_rad_per_s);
        let standing = self.critical.iter().filter(inside);
        let kept = standing.map(|c| &c.shape).chain(&self.system.free_rigid);
        let mut vectors: Vec<Col<f64>> = kept.map(|x| Scale(KEPT_WHOLE) * x).collect();
        for (lambda, q) in snapshots.iter().flat_map(|s| &s.pairs) {
            if lambda.norm() <= SNAPSHOT_MARGIN.get() * height {
                let (re, im) = split(q);
                vectors.push(re);
                vectors.push(im);
            }
        }
        orthonormal(self.system.order(), &vectors, SPAN_TOLERANCE.get())
    }

    /// Projections between neighbouring snapshots, halved until right in their middle.
    fn pieces(&mut self) -> Result<Vec<Projection>, SpectrumError> {
        let mut finished: Vec<Projection> = Vec::new();
        loop {
            self.counters.cancellation.check()?;
            let is_open = |pair: &&[Snapshot]| {
                let to = pair[1].speed;
                finished.iter().all(|piece| piece.to_rad_per_s != to)
            };
            let open: Vec<&[Snapshot]> = self.snapshots.windows(2).filter(is_open).collect();
            let last_round = self.snapshots.len() >= MAX_SNAPSHOTS;
            let tried: Result<Vec<Tried>, SpectrumError> = open
                .into_par_iter()
                .map(|pair| {
                    let basis = self.basis(pair, self.window);
                    let mut piece =
                        Projection::new(self.system, self.structure, basis, pair[1].speed);
                    let middle = 0.5 * (pair[0].speed + pair[1].speed);
                    let pairs = self.pairs(&piece, middle)?;
                    let error = self.frequency_error(&piece, middle, self.window, &pairs);
                    let is_wrong = error > DRAWN_TOLERANCE.get() * self.window;
                    let is_kept = last_round || !is_wrong;
                    if is_kept && self.system.is_conservative() && self.system.free_rigid.is_empty()
                    {
                        piece.drawn = self.drawn(&piece, pair, (middle, pairs));
                    }
                    Ok(Tried {
                        piece,
                        middle,
                        is_kept,
                        unsettled_rad_per_s: if is_wrong { error } else { 0.0 },
                    })
                })
                .collect();
            let mut coarse = Vec::new();
            for tried in tried? {
                if !tried.is_kept {
                    coarse.push(tried.middle);
                    continue;
                }
                finished.push(tried.piece);
                self.unsettled_rad_per_s = self.unsettled_rad_per_s.max(tried.unsettled_rad_per_s);
            }
            if coarse.is_empty() {
                finished.sort_by(|x, y| x.to_rad_per_s.total_cmp(&y.to_rad_per_s));
                return Ok(finished);
            }
            self.add_snapshots(&coarse)?;
        }
    }

    fn pairs(&self, projection: &Projection, speed: f64) -> Result<Vec<Eigenpair>, SpectrumError> {
        self.counters.reduced_solves.fetch_add(1, Ordering::Relaxed);
        half_order::eigenpairs(&projection.reduced, speed)
    }
}

fn low_pairs(mut pairs: Vec<Eigenpair>, height: f64) -> Vec<Eigenpair> {
    pairs.retain(|(lambda, _)| lambda.norm() <= height);
    pairs
}

/// Speeds of the first snapshots.
fn first_speeds((from, to): (f64, f64)) -> [f64; 5] {
    [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| from + share * (to - from))
}
