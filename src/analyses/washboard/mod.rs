//! Washboarding: vibration of the blade that arises because each tooth cuts the surface left by the preceding
//! one.
//!
//! For a scene whose cut has the block `washboarding`, [`washboard`] reports whether a vibration grows at the
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
pub(crate) mod chart;
mod count;
mod delay;
mod delayed_saw;
mod error;
mod lobes;
mod modes;
mod options;
mod outline;
mod report;
mod roots;
#[cfg(test)]
mod tests;
mod transfer;
mod warnings;

pub(crate) use outline::outline;
use std::f64::consts::TAU;

pub use self::error::WashboardError;
pub use self::options::Options;
pub use self::report::{Lobes, WashboardMode, WashboardReport};

use self::basis::Motions;
use self::count::LoopGains;
use self::lobes::{DIAGRAM, lobe_points};
use self::modes::described;
use self::warnings::{unusual_numbers, warnings};
use crate::analyses::campbell::Verdict;
use crate::model::scene::{CutRun, MAX_CUTTING_STIFFNESS, Scene, SceneError, in_the_cut};
use crate::modes::branches::Progress;

/// Ceiling of the search, relative to the cutting stiffness. The search also ends where omitted modes may
/// grow.
const CEILING: f64 = 1e3;

/// Analyses the washboarding of a saw at and around one speed of the scene's cut, see
/// [`Cut::at_rpm`](crate::model::scene::Cut::at_rpm).
///
/// # Errors
/// [`WashboardError`].
pub fn washboard(
    scene: &Scene,
    run: &CutRun,
    progress: Progress<'_>,
) -> Result<WashboardReport, WashboardError> {
    let cut = scene.needed_washboarding().map_err(SceneError::from)?;
    let washboarding = cut.needed_washboarding().map_err(SceneError::from)?;
    let motions = Motions::new(&scene.idling()?, cut, washboarding, run, DIAGRAM[1])?;
    let at = |speed: f64| motions.delayed_at(washboarding, speed);
    let (speed, stiffness) = (run.speed_rad_per_s, washboarding.typed.stiffness_n_per_m);
    let saw = at(speed)?;
    let safe_beyond_n_per_m = motions.safe_beyond_n_per_m(washboarding);
    let ceiling = (CEILING * stiffness)
        .min(MAX_CUTTING_STIFFNESS)
        .min(safe_beyond_n_per_m.max(stiffness));
    let gains = LoopGains::new(&saw, ceiling);
    let growing = gains.as_ref().and_then(|gains| gains.growing(stiffness));
    let modes = described(&motions, &saw, washboarding, run, growing);
    let points = lobe_points(&at, speed, ceiling, progress)?;
    let boundary = saw.grows_without().or_else(|| gains?.boundary());
    let error = motions.estimated_relative_error;
    let mut report = WashboardReport {
        sawflutter: env!("CARGO_PKG_VERSION").to_owned(),
        scene: scene.file().clone(),
        condition: in_the_cut(&[*run]),
        unusual_numbers: unusual_numbers(scene.file(), run.rpm),
        rpm: run.rpm,
        verdict: match growing {
            Some(0) => Verdict::Stable,
            _ => Verdict::Unstable,
        },
        tooth_passing_hz: washboarding.tooth_passing_rad_per_s(speed) / TAU,
        delays_s: washboarding.delays_s(speed),
        stiffness_n_per_m: stiffness,
        overlap: washboarding.typed.overlap,
        arc_deg: washboarding.unit_spring().arc_rad().to_degrees(),
        feed_m_per_s: run.feed_m_per_s,
        critical_stiffness_n_per_m: boundary.map(|b| b.stiffness_n_per_m),
        critical_frequency_hz: boundary.map(|b| b.frequency_rad_per_s / TAU),
        growing_eigenvalues: growing,
        growing_eigenvalues_without: saw.unstable_poles(),
        modes,
        lobes: Lobes::new(&points, ceiling, safe_beyond_n_per_m),
        ceiling_n_per_m: ceiling,
        complete_to_hz: motions.complete_to_rad_per_s / TAU,
        max_diameters: motions.plate.resolution.max_diameters,
        radial_functions: motions.plate.radial_functions(),
        estimated_relative_error: error.is_finite().then_some(error),
        warnings: Vec::new(),
    };
    report.warnings = warnings(&report, &motions, safe_beyond_n_per_m);
    Ok(report)
}
