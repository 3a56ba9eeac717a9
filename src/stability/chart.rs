//! Stability chart of a saw: samples, branches and bands over a range of speeds.

use super::between::Between;
use super::certificate::{GROWTH_FLOOR, contradictions};
use super::damped;
use super::error::AnalysisError;
use super::options::AnalysisOptions;
use super::sample::Sample;
use super::search_result::StabilityChart;
use super::undamped;
use super::undamped::Depth;
use crate::model::scene::SpeedRange;
use crate::modes::branches::Progress;
use crate::modes::{Mode, SpectralModel};

/// Number of even speeds of a chart, without those added at events.
pub(super) const CHART_SPEEDS: usize = 51;

impl StabilityChart {
    /// Compares the bands with the modes at one more speed, and adds contradictions to the certificate.
    pub(super) fn compare_with_modes(
        &mut self,
        model: &SpectralModel,
        speed_rad_per_s: f64,
        modes: &[Mode],
    ) {
        let (bands, certificate) = (&self.instabilities, &mut self.certificate);
        if model.is_conservative() {
            let sample = Sample::of_modes(speed_rad_per_s, modes.iter());
            let wrong = contradictions(bands, &[sample], GROWTH_FLOOR);
            certificate.mismatches.extend(wrong);
        } else {
            let wrong = damped::contradicted(model, bands, speed_rad_per_s, modes);
            certificate.violations_rad_per_s.extend(wrong);
        }
    }
}

/// Charts a range of speeds in full detail, sampled at `count` even speeds and near events, with a proof for the speeds between.
///
/// # Errors
/// [`AnalysisError`] when an eigenproblem fails.
pub fn chart(
    model: &SpectralModel,
    range: SpeedRange,
    count: usize,
    progress: Progress<'_>,
) -> Result<StabilityChart, AnalysisError> {
    chart_to_depth(model, range, count, Depth::Proof, progress)
}

/// The [`chart`] with checks of its bands to some depth.
///
/// # Errors
/// The errors of [`chart`].
pub(crate) fn chart_to_depth(
    model: &SpectralModel,
    range: SpeedRange,
    count: usize,
    depth: Depth,
    progress: Progress<'_>,
) -> Result<StabilityChart, AnalysisError> {
    let options = AnalysisOptions {
        progress,
        ..AnalysisOptions::default()
    };
    Ok(drawn(model, range, count, depth, options)?.0)
}

/// Charts a range of speeds with the detail and the callbacks of options, and returns the modes between, too.
pub(super) fn drawn<'a>(
    model: &'a SpectralModel,
    range: SpeedRange,
    count: usize,
    depth: Depth,
    options: AnalysisOptions<'_>,
) -> Result<(StabilityChart, Between<'a>), AnalysisError> {
    if model.is_conservative() {
        undamped::charted(model, range, count, depth, options)
    } else {
        damped::charted(model, range, count, options)
    }
}
