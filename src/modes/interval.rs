//! The reduced models of a guided blade, one for each interval of speeds.
//!
//! Within an interval a blade is projected on real vectors: its low modes at both ends, and the modes that
//! the search for bands follows at all speeds. For an undamped blade the states of the modes at both ends,
//! projected once more, give every mode in between from half as many unknowns; these results are corrected on
//! the real vectors.

use std::sync::Arc;
use std::sync::atomic::Ordering;

use faer::{Col, Scale, c64};

use super::error::SpectrumError;
use super::half_order;
use super::hamiltonian_reduction::{HamiltonianReduction, State};
use super::projection::Projection;
use super::vectors::{Eigenpair, complex};
use super::work::WorkCounters;
use crate::model::system::GyroscopicSystem;
use crate::model::tuning::Tuned;

/// Modes up to this multiple of the window are included, because some of them enter it between two speeds.
pub(super) const SPAN_MARGIN: Tuned = Tuned::new("modes/interval::SPAN_MARGIN", 1.5);

/// The same multiple for the states of an interval, whose error is estimated at its middle: with 1.5 a sweep of the paper's saw to
/// 6000 rpm takes 1.25 times as long, with 1.1 more intervals are halved. Edges of bands differ by less than 1e-14, growth by 1e-7.
const STATES_MARGIN: f64 = 1.2;

/// Eigenpairs at a speed, in the coordinates of a projection.
#[derive(Debug, Clone)]
pub struct KnownModes {
    pub speed_rad_per_s: f64,
    pub pairs: Vec<Eigenpair>,
}

impl KnownModes {
    /// All eigenpairs of a projection at a speed.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub(super) fn of(
        projection: &Projection,
        speed_rad_per_s: f64,
        counters: &WorkCounters,
    ) -> Result<Self, SpectrumError> {
        counters.cancellation.check()?;
        counters.reduced_solves.fetch_add(1, Ordering::Relaxed);
        Ok(KnownModes {
            speed_rad_per_s,
            pairs: half_order::eigenpairs(&projection.reduced, speed_rad_per_s)?,
        })
    }
}

/// A critical speed, in rad/s, and the wave that stands still there, in the unknowns of the component.
pub(super) type StandingWave<'a> = (f64, &'a Col<f64>);

/// The reduced model of an interval of speeds.
#[derive(Debug, Clone)]
pub struct Interval {
    /// End of the interval, which begins at the end of the one before.
    pub(super) to_rad_per_s: f64,
    pub(super) projection: Arc<Projection>,
    /// Projection on the states of the modes at both ends up to the height of the diagram, if it represents the
    /// modes in between.
    pub(super) drawn: Option<HamiltonianReduction>,
    /// As `drawn`, up to the height of the search for bands.
    pub(super) searched: Option<HamiltonianReduction>,
}

/// Projection on the states of the modes at two speeds up to slightly above a frequency, and of the waves that
/// stand still between the two. Its error falls with the fourth power of the distance of the speeds, and
/// vanishes at both and where a wave stands still. `None` for a blade with damping or free rigid motions, and if
/// the symplectic form is singular on the states.
pub(super) fn states_between(
    projection: &Projection,
    ends: [&KnownModes; 2],
    standing: &[StandingWave<'_>],
    window_rad_per_s: f64,
) -> Option<HamiltonianReduction> {
    let system = &projection.reduced;
    // The modes at two speeds do not represent the momentum of free rigid motions, which depends on the
    // speed.
    if !system.is_conservative() || !system.free_rigid.is_empty() {
        return None;
    }
    let [from, to] = ends.map(|end| end.speed_rad_per_s);
    let mut states: Vec<State> = Vec::new();
    let inside = |(speed, _): &&StandingWave<'_>| (from..=to).contains(speed);
    for (speed, shape) in standing.iter().filter(inside) {
        let shape = projection.basis.transpose() * *shape;
        states.extend(standing_states(system, *speed, &shape, window_rad_per_s));
    }
    let height = STATES_MARGIN * window_rad_per_s;
    let low = |pair: &&Eigenpair| pair.0.im <= height && pair.0.norm() <= 2.0 * height;
    for end in ends {
        let low = end.pairs.iter().filter(low).cloned();
        states.extend(low.map(|pair| State::new(system, end.speed_rad_per_s, pair)));
    }
    HamiltonianReduction::new(system, window_rad_per_s, &states)
}

/// The two states of a wave that stands still at its critical speed: its deflection, and a momentum of the same
/// shape.
fn standing_states(
    system: &GyroscopicSystem,
    speed_rad_per_s: f64,
    shape: &Col<f64>,
    scale: f64,
) -> [State; 2] {
    let q = complex(shape);
    let still = State::new(system, speed_rad_per_s, (c64::new(0.0, 0.0), q.clone()));
    let momentum = State {
        lambda: c64::new(0.0, 0.0),
        q: Col::zeros(q.nrows()),
        p: Scale(c64::new(scale, 0.0)) * q,
    };
    [still, momentum]
}

impl Interval {
    /// Eigenpairs of the interval's projection at a speed.
    pub(super) fn projected_pairs(
        &self,
        speed_rad_per_s: f64,
        counters: &WorkCounters,
    ) -> Result<Vec<Eigenpair>, SpectrumError> {
        KnownModes::of(&self.projection, speed_rad_per_s, counters).map(|known| known.pairs)
    }
}

/// Eigenpairs of a projection on states at a speed.
pub(super) fn states_at(
    states: &HamiltonianReduction,
    speed_rad_per_s: f64,
    counters: &WorkCounters,
) -> Result<Vec<Eigenpair>, SpectrumError> {
    counters.cancellation.check()?;
    counters.local_solves.fetch_add(1, Ordering::Relaxed);
    states.eigenpairs(speed_rad_per_s)
}

/// The interval that contains a speed; the last one beyond the end.
pub(super) fn interval_at(intervals: &[Interval], speed_rad_per_s: f64) -> &Interval {
    let place = intervals.partition_point(|interval| interval.to_rad_per_s < speed_rad_per_s);
    &intervals[place.min(intervals.len() - 1)]
}
