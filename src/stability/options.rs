//! Options of an analysis, and the results that it reports before it is complete.

use super::band::Instability;
use super::detail::Detail;
use super::expected::ExpectedWork;
use crate::campbell::Progress;
use crate::spectrum::NamedCriticalSpeed;

/// Options of an analysis.
#[derive(Clone, Copy)]
pub struct AnalysisOptions<'a> {
    /// Detail of the chart.
    pub detail: Detail,
    /// Progress callback: number of speeds done and number of speeds in total.
    pub progress: Progress<'a>,
    /// Callback that receives the expected work of a long sweep before the analysis begins; none by default.
    pub expected: Option<&'a (dyn Fn(ExpectedWork) + Sync)>,
    /// Callback that receives the critical speeds, and later the bands, before the diagram is complete; none
    /// by default.
    pub interim: Option<&'a (dyn Fn(Interim<'_>) + Sync)>,
}

/// Results that are known before the diagram.
#[derive(Debug, Clone, Copy)]
pub struct Interim<'a> {
    /// Critical speeds up to a little above the range, and the lowest; ascending.
    pub critical: &'a [NamedCriticalSpeed],
    /// Range of speeds, in rad/s.
    pub range_rad_per_s: (f64, f64),
    /// Every band within the range; `None` before they are computed.
    pub bands: Option<&'a [Instability]>,
}

impl AnalysisOptions<'_> {
    pub(super) fn report(&self, interim: Interim<'_>) {
        if let Some(receive) = self.interim {
            receive(interim);
        }
    }
}

impl Default for AnalysisOptions<'_> {
    fn default() -> Self {
        AnalysisOptions {
            detail: Detail::Full,
            progress: &|_, _| (),
            expected: None,
            interim: None,
        }
    }
}
