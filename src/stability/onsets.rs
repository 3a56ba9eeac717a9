//! Onsets of instability without a chart, for studies of many saws.

use super::band::Instability;
use super::basis::ChosenBasis;
use super::certificate::Certificate;
use super::damped;
use super::detail::Detail;
use super::error::AnalysisError;
use super::listed_band::ListedBand;
use super::search_result::FoundBands;
use super::undamped::{SEARCH_SPEEDS, undamped_bands};
use super::verdict::{Evidence, flutter_onsets};
use crate::model::plate::Resolution;
use crate::model::scene::{Scene, SpeedRange};
use crate::model::system::GyroscopicSystem;
use crate::modes::{Assembled, NamedCriticalSpeed, SpectralModel, Strategy};

/// Onset speeds, equal to those of an [`Analysis`](super::Analysis) to nine digits.
#[derive(Debug)]
pub struct Onsets {
    /// First critical speed, in rad/s, also above the range.
    pub first_critical_rad_per_s: Option<f64>,
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
    /// Whether nothing holds some rigid motion of the blade.
    pub has_free_motions: bool,
    /// Size of the basis.
    pub resolution: Resolution,
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

    pub(super) fn on(chosen: ChosenBasis, scene: &Scene) -> Result<Self, AnalysisError> {
        let ChosenBasis {
            saw,
            critical,
            range_rad_per_s: range,
            estimated_relative_error,
            ..
        } = chosen;
        let critical_rad_per_s: Vec<f64> = critical.iter().map(|c| c.speed_rad_per_s).collect();
        let first_critical = critical_rad_per_s.first().copied();
        let functions = saw.plate.degrees_of_freedom();
        let resolution = saw.plate.resolution;
        let has_free_motions = GyroscopicSystem::has_free_motions(&saw.plate);
        // Without damping there are no bands to search for if the blade is free, because its waves are
        // uncoupled, or if the range ends below the first critical speed, because no wave is reflected
        // there.
        let is_damped = !saw.plate.is_conservative();
        let is_slow = first_critical.is_none_or(|lowest| lowest > range.to_rad_per_s);
        let has_none = !is_damped && (saw.plate.is_axisymmetric() || is_slow);
        let found = if has_none {
            FoundBands::default()
        } else {
            search_bands(saw, critical, range)?
        };
        let threshold = scene.flutter_threshold_per_s();
        let [flutter_speed, first_merge] = if found.certificate.has_failed() {
            [None; 2]
        } else {
            flutter_onsets(&found.instabilities, threshold)
        };
        let [flutter_speed, first_merge] =
            [flutter_speed, first_merge].map(|onset| onset.map(|onset| onset.speed_rad_per_s));
        Ok(Onsets {
            first_critical_rad_per_s: first_critical,
            critical_rad_per_s,
            flutter_speed_rad_per_s: flutter_speed,
            first_merge_rad_per_s: first_merge,
            instabilities: found.instabilities,
            certificate: found.certificate,
            has_free_motions,
            resolution,
            functions,
            estimated_relative_error,
        })
    }
}

impl Onsets {
    /// What is known of the saw of a scene over the speeds of the search. The speeds of edges have at least the error of the critical
    /// speeds.
    pub(crate) fn evidence(&self, scene: &Scene, range_rad_per_s: SpeedRange) -> Evidence<'_> {
        let threshold_per_s = scene.flutter_threshold_per_s();
        let error = Some(self.estimated_relative_error);
        let bands = self.instabilities.iter();
        Evidence {
            bands: bands
                .map(|band| ListedBand::new(band, threshold_per_s, error))
                .collect(),
            has_failed: self.certificate.has_failed(),
            critical_rad_per_s: &self.critical_rad_per_s,
            threshold_per_s,
            range_rad_per_s,
            not_covered: scene
                .file()
                .not_covered(self.critical_rad_per_s.first().copied()),
            floquet: None,
        }
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
    let strategy = if saw.plate.is_conservative() {
        Strategy::Bands
    } else {
        Strategy::Reduced
    };
    let model = SpectralModel::with_critical(saw, critical, range, strategy)?;
    sufficient_bands(&model, range)
}

/// The bands of a model, or of one with more waves, if counts contradict the first.
fn sufficient_bands(model: &SpectralModel, range: SpeedRange) -> Result<FoundBands, AnalysisError> {
    let found = bands_of(model, range)?;
    if !found.certificate.lacks_waves() {
        return Ok(found);
    }
    let mut found = bands_of(&model.with_more_waves()?, range)?;
    found.certificate.searched_again = true;
    Ok(found)
}

fn bands_of(model: &SpectralModel, range: SpeedRange) -> Result<FoundBands, AnalysisError> {
    Ok(if model.is_conservative() {
        undamped_bands(model, range, SEARCH_SPEEDS)?
    } else {
        damped::bands(model, range, Detail::Full)?
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plate::Plate;
    use crate::model::scene::{Accuracy, rad_per_s};

    /// A reduced model of the damped saw lacks a wave that flutters. Reference: the bands of the whole one.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
    fn a_damped_saw_is_searched_again_with_more_waves() {
        let scene = Scene::paper().edited(|saw| saw.guides[0].damping_n_s_per_m = 2.0);
        let range = SpeedRange::between_rpm(0.0, 2600.0);
        let plate = Plate::new(&scene.unwrap(), Resolution::of(Accuracy::Draft));
        let sound = SpectralModel::new(plate.clone(), range, Strategy::Reduced).unwrap();
        let expected = sufficient_bands(&sound, range).unwrap();
        assert!(!expected.certificate.searched_again);
        let mut faulty = SpectralModel::new(plate, range, Strategy::Reduced).unwrap();
        let growing = |speed: f64| {
            let modes = faulty.modes(speed).unwrap();
            let place = modes.iter().position(|mode| mode.lambda.re > 0.01)?;
            Some((speed, place))
        };
        let mut speeds = (0..40).map(|k| rad_per_s(1540.0 + 25.0 * f64::from(k)));
        let (speed, wave) = speeds.find_map(growing).expect("a growing mode");
        faulty.lose_wave(speed, wave);
        let found = sufficient_bands(&faulty, range).unwrap();
        assert!(found.certificate.searched_again, "{:?}", found.certificate);
        assert!(found.certificate.is_clean(), "{:?}", found.certificate);
        assert_eq!(found.instabilities.len(), expected.instabilities.len());
        for (found, expected) in found.instabilities.iter().zip(&expected.instabilities) {
            let off = found.from_rad_per_s / expected.from_rad_per_s - 1.0;
            assert!(off.abs() < 1e-5, "{found} {expected}");
        }
    }
}
