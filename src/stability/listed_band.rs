//! A band as a verdict sees it.

use super::band::Instability;
use super::instability_kind::InstabilityKind;
use super::undecided::{Edge, edges};
use crate::model::scene::SpeedRange;

/// Where a band is, where it counts, and how well its ends are known, in rad/s.
#[derive(Debug, Clone, PartialEq)]
pub struct ListedBand {
    /// Divergence or flutter.
    pub kind: InstabilityKind,
    /// The band.
    pub range: SpeedRange,
    /// Intervals in which it counts as an instability, ascending.
    pub counted: Vec<SpeedRange>,
    /// Intervals in which its growth is felt, although it may be too slow to count, ascending.
    pub felt: Vec<SpeedRange>,
    /// Largest growth rate, in 1/s.
    pub peak_growth_per_s: f64,
    /// Estimated relative error of its ends; `None` if it is unknown, zero if it was not estimated.
    pub edge_error: Option<f64>,
}

impl ListedBand {
    /// A band of a search, of which flutter counts from a growth rate on.
    pub fn new(band: &Instability, threshold_per_s: f64, edge_error: Option<f64>) -> Self {
        ListedBand {
            kind: band.kind,
            range: band.range(),
            counted: band.counted(threshold_per_s),
            felt: band.felt(threshold_per_s),
            peak_growth_per_s: band.peak_growth_per_s,
            edge_error,
        }
    }

    /// The edges at which it begins or ceases to count, within a sweep.
    pub(super) fn counted_edges(&self, sweep: [f64; 2]) -> impl Iterator<Item = Edge> {
        let stretches = self.counted.iter().map(|stretch| stretch.ends());
        edges(self.range.ends(), stretches, self.edge_error, sweep)
    }

    /// The intervals in which its growth is felt, widened by the errors of its ends.
    pub(crate) fn to_avoid(&self, sweep: [f64; 2]) -> Vec<[f64; 2]> {
        let widened = self.felt.iter().map(|stretch| {
            let own = stretch.ends();
            let open = edges(self.range.ends(), [own], self.edge_error, sweep);
            open.map(|edge| edge.open())
                .fold(own, |[from, to], open| [from.min(open[0]), to.max(open[1])])
        });
        widened.collect()
    }
}

/// Share of the threshold from which growth is felt: with the usual threshold of 0.25 1/s a motion doubles in 280 s at this share, which
/// is longer than a cut.
pub(super) const FELT: f64 = 0.01;

impl Instability {
    /// Intervals of speed in which the growth of the band is felt, ascending, in rad/s; those in which it counts are among them.
    pub(crate) fn felt(&self, threshold_per_s: f64) -> Vec<SpeedRange> {
        self.counted(FELT * threshold_per_s)
    }
}
