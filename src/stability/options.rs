//! Options of an analysis, and the results that it reports before it is complete.

use super::band::Instability;
use super::detail::Detail;
use super::expected_work::ExpectedWork;
use super::ladder::{LADDER, resolution};
use crate::model::plate::Resolution;
use crate::model::scene::SpeedRange;
use crate::modes::NamedCriticalSpeed;
use crate::modes::branches::Progress;

/// Options of an analysis.
#[derive(Clone, Copy)]
pub struct AnalysisOptions<'a> {
    /// Detail of the chart; full by default.
    pub detail: Detail,
    /// Progress callback, which receives the number of finished speeds and of all speeds; none by default.
    pub progress: Progress<'a>,
    /// Callback that receives the expected work of a sweep before the analysis begins; none by default.
    pub expected: Option<&'a (dyn Fn(ExpectedWork) + Sync)>,
    /// Size at which the search for the basis begins, from [`Analysis::size_for_similar`](super::Analysis::size_for_similar)
    /// of a similar saw; the smallest by default.
    pub least_size: Resolution,
    /// Callback that receives the critical speeds, and later the bands, before the diagram is complete; none
    /// by default.
    pub interim: Option<&'a (dyn Fn(Interim<'_>) + Sync)>,
}

/// Results that are known before the diagram.
#[derive(Debug, Clone, Copy)]
pub struct Interim<'a> {
    /// Critical speeds up to slightly above the range, and at least the lowest one; ascending.
    pub critical: &'a [NamedCriticalSpeed],
    /// Range of speeds, in rad/s.
    pub range_rad_per_s: SpeedRange,
    /// Every band within the range; `None` before they are computed.
    pub bands: Option<&'a [Instability]>,
    /// Whether something holds every rigid motion of the blade; meaningless before the bands are known.
    pub is_held: bool,
}

impl AnalysisOptions<'_> {
    /// Calls the callback for interim results, if there is one.
    pub(super) fn report(
        &self,
        critical: &[NamedCriticalSpeed],
        range_rad_per_s: SpeedRange,
        bands: Option<&[Instability]>,
        is_held: bool,
    ) {
        if let Some(receive) = self.interim {
            receive(Interim {
                critical,
                range_rad_per_s,
                bands,
                is_held,
            });
        }
    }
}

impl Default for AnalysisOptions<'_> {
    fn default() -> Self {
        AnalysisOptions {
            detail: Detail::Full,
            progress: &|_, _| (),
            expected: None,
            least_size: resolution(LADDER[0]),
            interim: None,
        }
    }
}
