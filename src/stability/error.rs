//! Errors of an analysis.

use crate::model::plate::MOST_DIAMETERS;
use crate::model::scene::SceneError;
use crate::modes::SpectrumError;
use crate::modes::branches::CampbellError;
use crate::page::text::{rounded_down, shown, time_in_words};

/// Reason why a saw could not be analysed: a failed eigenproblem, or a sweep beyond the validity of the
/// model.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AnalysisError {
    /// An eigenproblem failed.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// A scene derived from the given one, such as that without cutting forces, is refused.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The chart exceeds the allowed memory.
    #[error(transparent)]
    Campbell(CampbellError),
    /// The bands that the search found decide nothing.
    #[error(
        "the search for bands failed: its bands contradict the eigenvalues at {contradicted} of {speeds} speeds, so that flutter speed and state are unknown"
    )]
    SearchFailed {
        /// Number of speeds at which the bands contradict the eigenvalues.
        contradicted: usize,
        /// Number of speeds compared.
        speeds: usize,
    },
    /// The blade would yield long before the end of the sweep.
    #[error(
        "{key} must be at most {limit_rpm:.0} (you gave {}): {TORN}", shown(*.to_rpm)
    )]
    Overstretched {
        /// Key or argument that requires a speed.
        key: &'static str,
        /// Its value.
        to_rpm: f64,
        /// Largest value allowed.
        limit_rpm: f64,
    },
    /// Waves missing from the basis become critical within the sweep.
    #[error(
        "{key} must be below {} (you gave {}): waves of {diameters} and more nodal diameters, which the largest basis lacks, are critical there; give a lower speed, or check thickness, diameter and modulus", shown(rounded_down(5, *.limit_rpm)), shown(*.to_rpm)
    )]
    Unresolved {
        /// Key or argument that requires a speed.
        key: &'static str,
        /// Its value.
        to_rpm: f64,
        /// Its value for the first critical speed of the waves that the largest basis lacks.
        limit_rpm: f64,
        /// Smallest number of their nodal diameters.
        diameters: usize,
    },
    /// The search for bands would take too long.
    #[error(
        "{key} must be at most {} (you gave {}): the search for bands over {critical_speeds} critical speeds would take about {} of processor time, more than {}; end the sweep there, and chart the speeds above in a sweep of their own, by sweep.from_rpm", shown(*.limit_rpm), shown(*.to_rpm), time_in_words(*.needed_s), time_in_words(*.allowed_s)
    )]
    TooLong {
        /// Key or argument that requires a speed.
        key: &'static str,
        /// Its value.
        to_rpm: f64,
        /// Largest value allowed.
        limit_rpm: f64,
        /// Number of critical speeds within the sweep.
        critical_speeds: usize,
        /// Estimated processor time, in seconds.
        needed_s: f64,
        /// Processor time allowed, in seconds.
        allowed_s: f64,
    },
    /// The first critical speed belongs to a wave missing from the largest basis.
    #[error(
        "the waves that stand still at the first critical speed have up to {diameters} nodal diameters, more than the {MOST_DIAMETERS} of the largest basis: the blade is too narrow outside its flange; lower mount.diameter_m"
    )]
    TooNarrow {
        /// Their largest number of nodal diameters.
        diameters: usize,
    },
}

/// Reason for which a speed is refused that stretches the rim too far, and the remedy.
pub(super) const TORN: &str = "beyond that the rim would be stretched by more than 10 %, which exceeds the elastic limit of any blade; give a lower speed, or check diameter, modulus and density";
/// Key of the end of a sweep.
pub(super) const END_OF_SWEEP: &str = "sweep.to_rpm";

impl AnalysisError {
    /// Names the key or argument from which the end of the sweep follows, as `factor` times its value, instead of the end itself.
    pub(crate) fn due_to(mut self, cause: &'static str, factor: f64) -> Self {
        if let AnalysisError::Overstretched {
            key,
            to_rpm,
            limit_rpm,
        }
        | AnalysisError::Unresolved {
            key,
            to_rpm,
            limit_rpm,
            ..
        }
        | AnalysisError::TooLong {
            key,
            to_rpm,
            limit_rpm,
            ..
        } = &mut self
        {
            *key = cause;
            *to_rpm /= factor;
            *limit_rpm /= factor;
        }
        self
    }
}

impl From<CampbellError> for AnalysisError {
    fn from(error: CampbellError) -> Self {
        match error {
            CampbellError::Spectrum(error) => AnalysisError::Spectrum(error),
            error => AnalysisError::Campbell(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The end of a sweep may be converted from rad/s, and the limit of a blade as thin as paper is far below 1 rpm.
    #[test]
    fn numbers_of_a_refusal_are_rounded_and_its_limit_is_not_zero() {
        let refused = AnalysisError::Unresolved {
            key: END_OF_SWEEP,
            to_rpm: 4000.0 - 5e-13,
            limit_rpm: 0.012_345_678,
            diameters: 73,
        };
        let text = refused.to_string();
        assert!(
            text.starts_with("sweep.to_rpm must be below 0.012345 (you gave 4000)"),
            "{text}"
        );
    }
}
