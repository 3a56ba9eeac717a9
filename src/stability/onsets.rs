//! Onsets of instability without a chart, for studies of many saws.

use super::band::Instability;
use super::basis::ChosenBasis;
use super::certificate::Certificate;
use super::damped;
use super::detail::Detail;
use super::error::AnalysisError;
use super::search_result::FoundBands;
use super::undamped::{SEARCH_SPEEDS, undamped_bands};
use super::verdict::flutter_onsets;
use crate::model::plate::Resolution;
use crate::model::scene::{Scene, SpeedRange};
use crate::modes::{Assembled, NamedCriticalSpeed, SpectralModel, Strategy};

/// Onset speeds, equal to those of an [`Analysis`](super::Analysis) to nine digits.
#[derive(Debug)]
pub struct Onsets {
    /// First critical speed, in rad/s, also above the range.
    pub lowest_critical_rad_per_s: Option<f64>,
    /// Critical speeds, ascending, in rad/s, including those next to the range.
    pub critical_rad_per_s: Vec<f64>,
    /// Bands by onset.
    pub instabilities: Vec<Instability>,
    /// Lowest speed of flutter that counts, in rad/s, see [`Instability::counted`].
    pub flutter_speed_rad_per_s: Option<f64>,
    /// Onset of the first flutter band, including bands that do not count, in rad/s.
    pub first_merge_rad_per_s: Option<f64>,
    /// Results of the checks of the bands; empty if no search was needed.
    pub certificate: Certificate,
    /// Number of functions of the basis.
    pub functions: usize,
    /// Estimated relative error of the critical speeds within the range.
    pub estimated_relative_error: f64,
}

impl Onsets {
    /// Onsets of the saw without cutting forces over a range of speeds, in rad/s.
    ///
    /// # Errors
    /// [`AnalysisError`] when an eigenproblem fails.
    pub(super) fn idling(scene: &Scene, range: SpeedRange) -> Result<Self, AnalysisError> {
        Self::new(&scene.idling()?.swept(range)?)
    }

    /// Finds the onsets of a saw over the speeds of its scene.
    ///
    /// # Errors
    /// [`AnalysisError`] when an eigenproblem fails.
    pub fn new(scene: &Scene) -> Result<Self, AnalysisError> {
        Self::on(ChosenBasis::new(scene, scene.tolerance())?, scene)
    }

    /// Finds the onsets on a basis that is at least as large as that of a similar saw, in three quarters of
    /// the time.
    ///
    /// # Errors
    /// The errors of [`Onsets::new`].
    pub(crate) fn beside(scene: &Scene, least: Resolution) -> Result<Self, AnalysisError> {
        let chosen = ChosenBasis::at_least(scene, scene.tolerance(), least)?;
        Self::on(chosen, scene)
    }

    fn on(chosen: ChosenBasis, scene: &Scene) -> Result<Self, AnalysisError> {
        let ChosenBasis {
            saw,
            critical,
            range_rad_per_s: range,
            estimated_relative_error,
            ..
        } = chosen;
        let critical_rad_per_s: Vec<f64> = critical.iter().map(|c| c.speed_rad_per_s).collect();
        let lowest_critical = critical_rad_per_s.first().copied();
        let functions = saw.plate.degrees_of_freedom();
        // Without damping there are no bands to search for if the blade is free, because its waves are
        // uncoupled, or if the range ends below the first critical speed, because no wave is reflected
        // there.
        let is_damped = !saw.plate.is_conservative();
        let is_slow = lowest_critical.is_none_or(|lowest| lowest > range.to_rad_per_s);
        let has_none = !is_damped && (saw.plate.is_axisymmetric() || is_slow);
        let found = if has_none {
            FoundBands::default()
        } else {
            search_bands(saw, critical, range)?
        };
        let threshold = scene.flutter_threshold_per_s();
        let [flutter_speed, first_merge] = flutter_onsets(&found.instabilities, threshold)
            .map(|onset| onset.map(|onset| onset.speed_rad_per_s));
        Ok(Onsets {
            lowest_critical_rad_per_s: lowest_critical,
            critical_rad_per_s,
            flutter_speed_rad_per_s: flutter_speed,
            first_merge_rad_per_s: first_merge,
            instabilities: found.instabilities,
            certificate: found.certificate,
            functions,
            estimated_relative_error,
        })
    }
}

/// Finds every band of a saw whose critical speeds are known, with the results of its checks. Without damping
/// it uses only the modes that can coalesce.
///
/// # Errors
/// [`AnalysisError`] when an eigenproblem fails.
pub fn search_bands(
    saw: impl Into<Assembled>,
    critical: Vec<NamedCriticalSpeed>,
    range: SpeedRange,
) -> Result<FoundBands, AnalysisError> {
    let saw = saw.into();
    if saw.plate.is_conservative() {
        let model = SpectralModel::with_critical(saw, critical, range, Strategy::Bands)?;
        return Ok(undamped_bands(&model, range, SEARCH_SPEEDS)?);
    }
    let model = SpectralModel::with_critical(saw, critical, range, Strategy::Reduced)?;
    Ok(damped::bands(&model, range, Detail::Full)?)
}
