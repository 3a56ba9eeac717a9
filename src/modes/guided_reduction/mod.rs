//! Division of a range of speeds into intervals, each with a small basis for the low modes.

mod error;
mod interval_search;

use std::sync::atomic::Ordering;

use faer::c64;
use rayon::prelude::*;

use super::arnoldi::{lowest_eigenpairs, nearly_lowest_eigenpairs};
use super::chart_height::{CHART_MODES, Strategy, chart_height};
use super::critical_speed::NamedCriticalSpeed;
use super::error::SpectrumError;
use super::full_model::FullModel;
use super::interval::{Interval, StandingWave};
use super::mode::{classify, is_seen, krein_index};
use super::vectors::Eigenpair;
use super::work::WorkCounters;
use crate::model::evenly_spaced;
use crate::model::scene::SpeedRange;
use crate::model::system::GyroscopicSystem;
use crate::model::tuning::Tuned;

/// Modes up to this multiple of the frequency of the highest reflected wave may coalesce with that wave.
const REFLECTED_MARGIN: Tuned = Tuned::new("modes/guided_reduction::REFLECTED_MARGIN", 1.3);
/// Relative distance of the first interval from the first critical speed if only bands are searched for; it is
/// larger than the distance that the search keeps from critical speeds.
const BELOW_CRITICAL: f64 = 1e-3;

/// Number of even speeds of the first snapshots.
const FIRST_SNAPSHOTS: usize = 5;

/// The reduced models of a guided blade.
pub struct Reduction {
    /// Intervals by ascending speed.
    pub intervals: Vec<Interval>,
    /// Frequency up to which every mode is accurate.
    pub complete_to_rad_per_s: f64,
    /// Frequency up to which instabilities are searched for, slightly above the highest reflected wave; 0 if
    /// there is none.
    pub reflected_to_rad_per_s: f64,
    /// Largest estimated error of a frequency that exceeds the tolerance, in rad/s; 0 unless the number of
    /// snapshots reached its limit.
    pub unsettled_rad_per_s: f64,
}

/// A guided blade with the data that its reduction uses.
pub struct Guided<'a> {
    pub system: &'a GyroscopicSystem,
    /// Blocks and columns of the matrices, if a solve by them costs less than a dense one.
    pub structure: Option<&'a FullModel>,
    /// Frequency scale of the blade, in rad/s.
    pub scale: f64,
    /// Critical speeds, ascending, at least those of the range.
    pub critical: &'a [NamedCriticalSpeed],
}

/// Computes modes of the guided blade at a few speeds, and at further ones until every mode up to the height of
/// the diagram, and every reflected one, is accurate in between too.
///
/// For bands alone, modes that only a diagram shows are omitted, and so are speeds below the lowest critical
/// speed, where no wave is reflected. This takes a sixth of the time.
///
/// # Errors
/// [`SpectrumError::Cancelled`].
pub fn of_guided(
    guided: Guided<'_>,
    range: SpeedRange,
    strategy: Strategy,
    counters: &WorkCounters,
) -> Result<Reduction, SpectrumError> {
    let mut builder = Builder::new(guided, range, counters);
    builder.is_sketch = strategy == Strategy::Sketch;
    let reflected = || builder.reflected_height(range.to_rad_per_s);
    let chart = || builder.chart_height(range.from_rad_per_s);
    let ((reflected, last), chart) = match strategy {
        Strategy::Bands => (reflected()?, None),
        _ => {
            let (reflected, chart) = rayon::join(reflected, chart);
            (reflected?, Some(chart?))
        }
    };
    let chart = match chart {
        None if reflected == 0.0 => Some(builder.chart_height(range.from_rad_per_s)?),
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
        None => builder.range.from_rad_per_s = builder.first_reflecting(),
    }
    builder.add_first_snapshots(known)?;
    Ok(Reduction {
        intervals: builder.intervals()?,
        complete_to_rad_per_s: builder.window,
        reflected_to_rad_per_s: reflected,
        unsettled_rad_per_s: builder.unsettled_rad_per_s,
    })
}

/// Frequencies in rad/s up to which a diagram of a guided blade with damping shows modes, and up to which reflected waves, or
/// those that coalesce with them, may grow: the height of the diagram is at least the latter, which is 0 without reflected waves.
///
/// # Errors
/// [`SpectrumError::Cancelled`].
pub fn heights(
    guided: Guided<'_>,
    range: SpeedRange,
    counters: &WorkCounters,
) -> Result<(f64, f64), SpectrumError> {
    let builder = Builder::new(guided, range, counters);
    let reflected = || builder.reflected_height(range.to_rad_per_s);
    let (reflected, chart) = rayon::join(reflected, || builder.chart_height(range.from_rad_per_s));
    let ((reflected, _), (chart, _)) = (reflected?, chart?);
    Ok((chart.max(reflected), reflected))
}

/// Low modes of the whole system at one speed.
#[derive(Clone)]
struct Snapshot {
    speed: f64,
    pairs: Vec<Eigenpair>,
}

struct Builder<'a> {
    guided: Guided<'a>,
    standing: Vec<StandingWave<'a>>,
    range: SpeedRange,
    counters: &'a WorkCounters,
    /// Frequency up to which diagram or search need modes.
    window: f64,
    /// Frequency up to which the search needs modes; 0 without reflected waves.
    reflected: f64,
    snapshots: Vec<Snapshot>,
    unsettled_rad_per_s: f64,
    /// Whether the larger errors of a preview are allowed.
    is_sketch: bool,
}

impl<'a> Builder<'a> {
    fn new(guided: Guided<'a>, range: SpeedRange, counters: &'a WorkCounters) -> Self {
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
            is_sketch: false,
        }
    }

    /// Adds the first snapshots; known ones with every mode of the window are not computed again.
    fn add_first_snapshots(&mut self, known: Vec<Snapshot>) -> Result<(), SpectrumError> {
        let mut speeds = evenly_spaced(self.range.ends(), FIRST_SNAPSHOTS);
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

    /// Height of a diagram from the modes at a speed, in rad/s, and these modes.
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
            // Modes that decay without oscillation are not drawn but are among the computed ones, so that
            // more modes must be computed.
            count *= 2;
        }
    }

    /// Whether a snapshot contains every mode of the window.
    fn covers(&self, snapshot: &Snapshot) -> bool {
        let highest = snapshot.pairs.last();
        highest.is_some_and(|(lambda, _)| lambda.norm() > self.window)
    }

    /// Frequency of the highest reflected wave at the top speed, with a margin for waves that may coalesce with
    /// it, and the modes there; 0 below the first critical speed. For a damped blade the frequency is that
    /// without damping, because damping destabilizes reflected waves.
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
            if krein_index(&modes) >= index || 2 * count >= system.order() {
                let highest = modes.iter().filter(|mode| mode.kind.krein_index() > 0);
                let top = highest.fold(0.0, |top, mode| mode.frequency_rad_per_s().max(top));
                let height = REFLECTED_MARGIN.get() * top.max(0.1 * scale);
                return Ok((height, (!is_damped).then_some(Snapshot { speed, pairs })));
            }
            count *= 2;
        }
    }

    /// Adds snapshots, each with every mode of the window and at least one above it.
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

    /// Speed from which on waves are reflected: slightly below the first critical speed; the start of the range
    /// if no critical speed is within it.
    fn first_reflecting(&self) -> f64 {
        let [from, to] = self.range.ends();
        let lowest = self
            .guided
            .critical
            .first()
            .map_or(from, |c| c.speed_rad_per_s);
        if lowest * (1.0 + BELOW_CRITICAL) < to {
            (lowest * (1.0 - BELOW_CRITICAL)).max(from)
        } else {
            from
        }
    }
}
