//! Washboarding: vibration of the blade that arises because each tooth cuts the surface left by the preceding
//! one.
//!
//! A scene whose cut has the block `washboarding` gives a [`Washboard`]: whether a motion grows at the
//! operating speed, its mode, and the smallest cutting stiffness for growth over the speed.
//!
//! The force on a tooth is −k (w(t) − μ w(t − τ)). The wood is fixed in space, and each tooth passes the same
//! arc one tooth period after the preceding one. The delayed term is therefore constant in the frame fixed in
//! space, and eigenvalues are those of
//!
//! λ² + λD(Ω) + K(Ω) + k h(λ) P, h(λ) = 1 − μ/p Σ e^(−λτ_j), P = ∫ φφᵀ dθ/arc on the arc of the rim.
//!
//! References: S. A. Tobias, *Machine-Tool Vibration* (1965), for the regenerative effect; J. F. Tian &
//! S. G. Hutton, *Cutting-induced vibration in circular saws*, J. Sound Vib. 242 (2001), 907–922, for
//! saws; Z. Luo, *Parametric vibrations of traveling plates and the mechanics of washboarding in
//! bandsaws*, thesis, University of British Columbia (2001); Y. Altintas, S. Engin & E. Budak, *Analytical
//! stability prediction and design of variable pitch cutters*, J. Manuf. Sci. Eng. 121 (1999), 173–178,
//! for teeth that are not evenly spaced, and for the mean over the passing teeth.

mod basis;
mod count;
mod delay;
mod delayed;
mod modes;
mod roots;
#[cfg(test)]
mod tests;
mod transfer;

use std::sync::atomic::{AtomicUsize, Ordering};

use faer::Mat;
use rayon::prelude::*;

pub(crate) use self::delayed::Boundary;
pub(crate) use self::modes::WashboardMode;

use self::basis::Motions;
use self::count::LoopGains;
use self::delayed::DelayedSaw;
use self::modes::described;
use crate::campbell::{Progress, even_speeds};
use crate::linalg::SymmetricEigen;
use crate::plate::Plate;
use crate::scene::{CutRun, MAX_CUTTING_STIFFNESS, Scene, SceneError, Washboarding};
use crate::spectrum::{Cancellation, SpectrumError};
use crate::stability::AnalysisError;

/// Reason for which an analysis of washboarding failed.
#[derive(Debug, thiserror::Error)]
pub enum WashboardError {
    /// The scene was refused.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// An eigenproblem failed.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// The saw could not be analysed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// The mode has no damping that could balance the delayed force.
    #[error(
        "damping is missing or too small for the mode of {frequency_hz:.1} Hz at {rpm:.0} rpm, but every mode must lose energy: a delayed force, however small, makes an undamped mode grow or leaves it at the limit; give damping.material_retardation_time_s (1e-6 s is of the order of steel) or damping.air_n_s_per_m3"
    )]
    Undamped {
        /// Rotation speed.
        rpm: f64,
        /// Frequency of the mode.
        frequency_hz: f64,
    },
    /// The saw has so many modes that those driven by the teeth cannot all be computed.
    #[error(
        "blade.teeth at {rpm:.0} rpm drive modes between {:.0} and {:.0} Hz, but the blade has so many that only those up to {complete_hz:.0} Hz can be included; give a thicker blade, a lower speed or fewer teeth",
        0.5 * passing_hz, passing_hz
    )]
    Incomplete {
        /// Rotation speed.
        rpm: f64,
        /// Tooth passing frequency.
        passing_hz: f64,
        /// Frequency up to which modes are complete.
        complete_hz: f64,
    },
    /// A rigid motion has no stiffness.
    #[error(
        "guides is empty or too soft, but must hold the blade against every rigid motion; give a guide with a stiffness, cut.wood, or mount the blade on a collar"
    )]
    Loose,
}

/// Result of an analysis of washboarding.
#[derive(Debug)]
pub struct Washboard {
    /// Scene of the saw.
    pub scene: Scene,
    /// The saw in the cut, without the delayed force.
    pub plate: Plate,
    /// Speed, forces and feed of the cut.
    pub run: CutRun,
    /// Cutting stiffness, overlap and delays of the force.
    pub(crate) washboarding: Washboarding,
    /// Frequency in space up to which the modes are complete.
    pub complete_to_rad_per_s: f64,
    /// Frequency up to which complete modes are needed at the fastest speed of the diagram.
    pub needed_to_rad_per_s: f64,
    /// Estimated relative error of the critical speeds in this basis.
    pub estimated_relative_error: f64,
    /// Number of eigenvalues in the right half plane, by the argument principle; `None` if one is on the
    /// imaginary axis.
    pub growing: Option<usize>,
    /// Number of eigenvalues in the right half plane without the delayed force.
    pub growing_without: usize,
    /// Modes at the speed of the cut, in descending order of growth.
    pub(crate) modes: Vec<WashboardMode>,
    /// Smallest cutting stiffness at which a motion grows at the speed of the cut; `None` if it exceeds the ceiling.
    pub(crate) boundary: Option<Boundary>,
    /// Smallest cutting stiffness at which a motion grows, over the speed.
    pub(crate) lobes: Vec<LobePoint>,
    /// Largest cutting stiffness of the search.
    pub ceiling_n_per_m: f64,
    /// Smallest cutting stiffness at which a mode above `complete_to_rad_per_s` may grow, given its damping.
    pub safe_beyond_n_per_m: f64,
}

/// The boundary at one speed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LobePoint {
    /// Rotation speed.
    pub speed_rad_per_s: f64,
    /// Smallest cutting stiffness at which a motion grows; `None` if it exceeds the ceiling.
    pub boundary: Option<Boundary>,
    /// Whether the count confirms that nothing grows just below it.
    pub confirmed: bool,
}

/// Speeds of the diagram, relative to the speed of the cut.
const DIAGRAM: [f64; 2] = [0.6, 1.25];
/// Number of speeds in the diagram.
const SPEEDS: usize = 121;
/// Number of times that the interval between two speeds is halved if the critical mode changes in between.
const HALVINGS: usize = 3;
/// Relative change of the frequency between two speeds that indicates another mode.
const JUMP: f64 = 0.03;
/// Ceiling of the search, relative to the cutting stiffness. The search also ends where omitted modes may
/// grow.
const CEILING: f64 = 1e3;

impl Washboard {
    /// Analyses the washboarding of a saw at and around one speed of the scene's cut, see
    /// [`Cut::at_rpm`](crate::scene::Cut::at_rpm).
    ///
    /// # Errors
    /// [`WashboardError`].
    pub fn new(
        scene: &Scene,
        run: &CutRun,
        progress: Progress<'_>,
    ) -> Result<Self, WashboardError> {
        let cut = scene.needed_washboarding().map_err(SceneError::from)?;
        let washboarding = cut.needed_washboarding().map_err(SceneError::from)?;
        let idling = scene.idling()?;
        let motions = Motions::new(&idling, cut, washboarding, run, DIAGRAM[1])?;
        let at = |speed: f64| motions.delayed_at(washboarding, speed);
        let (speed, stiffness) = (run.speed_rad_per_s, washboarding.stiffness_n_per_m);
        let saw = at(speed)?;
        let safe_beyond_n_per_m = motions.safe_beyond_n_per_m(washboarding);
        let ceiling = (CEILING * stiffness).min(MAX_CUTTING_STIFFNESS);
        let ceiling = ceiling.min(safe_beyond_n_per_m.max(stiffness));
        let gains = LoopGains::new(&saw, ceiling);
        let growing = gains.as_ref().and_then(|gains| gains.growing(stiffness));
        let modes = described(&motions, &saw, washboarding, run, growing);
        let lobes = lobes(&at, speed, ceiling, progress)?;
        Ok(Washboard {
            scene: scene.clone(),
            run: *run,
            washboarding: washboarding.clone(),
            complete_to_rad_per_s: motions.complete_to_rad_per_s,
            needed_to_rad_per_s: motions.needed_to_rad_per_s,
            estimated_relative_error: motions.estimated_relative_error,
            growing,
            growing_without: saw.unstable_poles(),
            modes,
            boundary: saw.grows_without().or_else(|| gains?.boundary()),
            lobes,
            ceiling_n_per_m: ceiling,
            safe_beyond_n_per_m,
            plate: motions.plate,
        })
    }

    /// Cutting stiffness up to which no motion grows at a speed of the diagram; zero if this is not confirmed.
    pub(crate) fn stable_to_n_per_m(&self, point: &LobePoint) -> f64 {
        let searched = point.boundary.map(|b| b.stiffness_n_per_m);
        match point.confirmed {
            true => (searched.unwrap_or(self.ceiling_n_per_m)).min(self.safe_beyond_n_per_m),
            false => 0.0,
        }
    }

    /// Number of speeds whose boundary the count does not confirm.
    pub fn unconfirmed(&self) -> usize {
        self.lobes.iter().filter(|point| !point.confirmed).count()
    }
}

/// The boundary over the speeds of the diagram, with more of them where the critical mode changes.
fn lobes(
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
    let mut speeds = even_speeds((from, to), SPEEDS);
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

/// B with BBᵀ = P, without the columns that are rounding compared with the largest one.
fn columns(arc: &Mat<f64>) -> Result<Mat<f64>, SpectrumError> {
    const LEAST: f64 = 1e-8;
    let order = arc.nrows();
    let eigen = SymmetricEigen::new(arc.as_ref()).map_err(SpectrumError::at(0.0))?;
    let largest = eigen.values[order - 1];
    let kept: Vec<usize> = (0..order)
        .filter(|&k| eigen.values[k] > LEAST * largest)
        .collect();
    Ok(Mat::from_fn(order, kept.len(), |i, k| {
        eigen.vectors[(i, kept[k])] * eigen.values[kept[k]].sqrt()
    }))
}
