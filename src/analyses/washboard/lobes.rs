//! The lobe diagram: the smallest cutting stiffness at which a vibration grows, over the speed.

use std::f64::consts::TAU;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::WashboardError;
use super::count::LoopGains;
use super::delayed_saw::{Boundary, DelayedSaw};
use super::report::Lobes;
use crate::model::evenly_spaced;
use crate::model::scene::rpm;
use crate::modes::Cancellation;
use crate::modes::branches::Progress;

/// The boundary at one speed.
#[derive(Debug, Clone, Copy)]
pub(super) struct LobePoint {
    /// Rotation speed.
    pub speed_rad_per_s: f64,
    /// Smallest cutting stiffness at which a vibration grows; `None` if it exceeds the ceiling.
    pub boundary: Option<Boundary>,
    /// Whether the count confirms that no vibration grows just below it.
    pub confirmed: bool,
}

/// Speeds of the diagram, relative to the speed of the cut.
pub(super) const DIAGRAM: [f64; 2] = [0.6, 1.25];
/// Number of speeds in the diagram.
const SPEEDS: usize = 121;
/// Number of times that the interval between two speeds is halved if the critical mode changes in between.
const HALVINGS: usize = 3;
/// Relative change of the frequency between two speeds that indicates another mode.
const JUMP: f64 = 0.03;
/// The boundary over the speeds of the diagram, with more of them where the critical mode changes.
pub(super) fn lobe_points(
    at: &(impl Fn(f64) -> Result<DelayedSaw, WashboardError> + Sync),
    speed: f64,
    ceiling: f64,
    progress: Progress<'_>,
) -> Result<Vec<LobePoint>, WashboardError> {
    let cancellation = Cancellation::current();
    let done = AtomicUsize::new(0);
    let look = |speed: f64| {
        cancellation.check()?;
        let saw = at(speed)?;
        let (boundary, confirmed) = match saw.grows_without() {
            Some(boundary) => (Some(boundary), true),
            None => {
                let gains = LoopGains::new(&saw, ceiling);
                let boundary = gains.as_ref().and_then(LoopGains::boundary);
                (
                    boundary,
                    gains.is_some_and(|gains| gains.confirms(boundary)),
                )
            }
        };
        let count = 1 + done.fetch_add(1, Ordering::Relaxed);
        progress(count.min(SPEEDS), SPEEDS);
        Ok::<_, WashboardError>(LobePoint {
            speed_rad_per_s: speed,
            boundary,
            confirmed,
        })
    };
    let [from, to] = DIAGRAM.map(|share| share * speed);
    let mut speeds = evenly_spaced([from, to], SPEEDS);
    let mut points: Vec<LobePoint> = Vec::new();
    for _ in 0..=HALVINGS {
        let more = speeds.into_par_iter().map(look);
        points.extend(more.collect::<Result<Vec<_>, _>>()?);
        points.sort_by(|x, y| x.speed_rad_per_s.total_cmp(&y.speed_rad_per_s));
        let between = points.windows(2).filter(|pair| pair[0].jumps_to(&pair[1]));
        let middle = |pair: &[LobePoint]| 0.5 * (pair[0].speed_rad_per_s + pair[1].speed_rad_per_s);
        speeds = between.map(middle).collect();
    }
    Ok(points)
}

impl LobePoint {
    /// Whether another mode becomes critical at the next speed.
    fn jumps_to(&self, next: &LobePoint) -> bool {
        match (self.boundary, next.boundary) {
            (None, None) => false,
            (Some(x), Some(y)) => {
                let [x, y] = [x, y].map(|boundary| boundary.frequency_rad_per_s);
                (x - y).abs() > JUMP * x.max(y)
            }
            _ => true,
        }
    }
}

impl Lobes {
    /// The diagram through some points, up to a ceiling of the search and the stiffness beyond which omitted modes may
    /// grow.
    pub(super) fn new(
        points: &[LobePoint],
        ceiling_n_per_m: f64,
        safe_beyond_n_per_m: f64,
    ) -> Self {
        let stiffness = |point: &LobePoint| Some(point.boundary?.stiffness_n_per_m);
        let frequency = |point: &LobePoint| Some(point.boundary?.frequency_rad_per_s / TAU);
        let stable_to = |point: &LobePoint| {
            if point.confirmed {
                (stiffness(point).unwrap_or(ceiling_n_per_m)).min(safe_beyond_n_per_m)
            } else {
                0.0
            }
        };
        let points = || points.iter();
        Lobes {
            rpm: points().map(|point| rpm(point.speed_rad_per_s)).collect(),
            critical_stiffness_n_per_m: points().map(stiffness).collect(),
            frequency_hz: points().map(frequency).collect(),
            stable_to_n_per_m: points().map(stable_to).collect(),
            confirmed: points().map(|point| point.confirmed).collect(),
        }
    }
}
