//! A slotted blade with the lower and the upper branch of the pairs of waves that its slots split.
//!
//! The axisymmetric blade of the analysis has one factor on bending for both waves of a pair, that of the lower branch. With the upper
//! branch in its place the critical speeds are the upper ones. Where slots pass guides, the bands of neither are those of the slotted
//! blade. The *hull* is the union of the bands with the lower branch, the mean and the upper one, filled between bands that may
//! be the same one in two of these blades, and 1 % wider at both ends. Above the first critical speed Floquet multipliers found no growth
//! outside the hull (tests/validation/slot_hull.rs); it is wider than the growth, so that inside it a saw is unstable or not certain.

use super::band::Instability;
use super::basis::ChosenBasis;
use super::error::AnalysisError;
use super::instability_kind::InstabilityKind;
use super::onsets::Onsets;
use super::search_result::StabilityChart;
use crate::model::scene::{Scene, SpeedRange, SplitBranch};
use crate::modes::{NamedCriticalSpeed, SpectralModel};

/// Widening of the hull at both ends, relative to their speeds: an error of the axisymmetric blade is 0.7 %.
const WIDER: f64 = 0.01;

/// Results with other branches of the split pairs than the lower one.
#[derive(Debug)]
pub struct SplitPairs {
    /// Critical speeds within the sweep with the upper branch that are none with the lower one, ascending.
    pub upper_critical: Vec<NamedCriticalSpeed>,
    /// Speeds at which slots pass guides and the saw is unstable or not certain, ascending, without overlap; `None` if nothing is fixed
    /// in space, or if a search for bands failed.
    pub hull: Option<Vec<SpeedRange>>,
}

/// A band in one of the three blades.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Placed {
    branch: SplitBranch,
    kind: InstabilityKind,
    range: SpeedRange,
}

impl SplitPairs {
    /// The results for a saw whose lower branches were charted over a range; `None` without slots.
    ///
    /// # Errors
    /// [`AnalysisError`] when an eigenproblem fails.
    pub(super) fn of(
        scene: &Scene,
        model: &SpectralModel,
        chart: &StabilityChart,
        range: SpeedRange,
    ) -> Result<Option<Self>, AnalysisError> {
        let plate = &model.plate;
        let Some(slotted) = plate.slotted() else {
            return Ok(None);
        };
        let swept = scene.swept(range)?;
        let on = |branch| {
            let saw = swept.on_branch(branch);
            ChosenBasis::at_least(&saw, saw.tolerance(), plate.resolution)
        };
        let upper = on(SplitBranch::Upper)?;
        let tolerance = scene.tolerance();
        let is_known = |speed: f64| {
            let mut known = model.critical.iter();
            known.any(|own| (speed / own.speed_rad_per_s - 1.0).abs() <= tolerance)
        };
        let upper_critical = upper
            .critical
            .iter()
            .filter(|own| range.contains(own.speed_rad_per_s) && !is_known(own.speed_rad_per_s));
        let upper_critical = upper_critical.cloned().collect();
        let none = SplitPairs {
            upper_critical,
            hull: None,
        };
        if scene.file().slot_passing().is_none() || chart.certificate.has_failed() {
            return Ok(Some(none));
        }
        let threshold = scene.flutter_threshold_per_s();
        let mut placed = Vec::new();
        let mut place = |branch, bands: &[Instability]| {
            placed.extend(bands.iter().flat_map(|band| {
                let felt = band.felt(threshold).into_iter();
                felt.map(move |range| Placed {
                    branch,
                    kind: band.kind,
                    range,
                })
            }));
        };
        place(SplitBranch::Lower, &chart.instabilities);
        for (branch, chosen) in [
            (SplitBranch::Mean, on(SplitBranch::Mean)?),
            (SplitBranch::Upper, upper),
        ] {
            let onsets = Onsets::on(chosen, &swept.on_branch(branch))?;
            if onsets.certificate.has_failed() {
                return Ok(Some(none));
            }
            place(branch, &onsets.instabilities);
        }
        let ratio = slotted.widest_split(plate.resolution.max_diameters);
        Ok(Some(SplitPairs {
            hull: Some(filled(&placed, ratio, range)),
            ..none
        }))
    }
}

/// The filled hull of bands that rise by at most a ratio from one blade to another, within a range.
fn filled(placed: &[Placed], ratio: f64, within: SpeedRange) -> Vec<SpeedRange> {
    let mut ranges: Vec<SpeedRange> = placed.iter().map(|band| band.range).collect();
    for one in placed {
        let [from, _] = one.range.ends();
        let reach = SpeedRange::new((1.0 - WIDER) * from, (1.0 + WIDER) * ratio * from);
        let same = placed.iter().filter(|other| {
            let is_other = other.branch != one.branch && other.kind == one.kind;
            is_other && reach.contains(other.range.from_rad_per_s)
        });
        ranges.extend(same.map(|other| SpeedRange::new(from, other.range.to_rad_per_s)));
    }
    let wider = ranges.into_iter().map(|range| {
        let [from, to] = range.ends();
        SpeedRange::new((1.0 - WIDER) * from, (1.0 + WIDER) * to).within(within)
    });
    let mut wider: Vec<SpeedRange> = wider.filter(|range| range.width() > 0.0).collect();
    wider.sort_by(|x, y| x.from_rad_per_s.total_cmp(&y.from_rad_per_s));
    let mut merged: Vec<SpeedRange> = Vec::new();
    for range in wider {
        match merged.last_mut() {
            Some(last) if range.from_rad_per_s <= last.to_rad_per_s => {
                last.to_rad_per_s = last.to_rad_per_s.max(range.to_rad_per_s);
            }
            _ => merged.push(range),
        }
    }
    merged
}

#[cfg(test)]
mod tests {
    use super::*;

    fn band(branch: SplitBranch, kind: InstabilityKind, from: f64, to: f64) -> Placed {
        Placed {
            branch,
            kind,
            range: SpeedRange::new(from, to),
        }
    }

    /// Bands at 100, 104 and 108 with a ratio of 1.05 are filled from 99 to 110.09; one of another kind, and one that the ratio
    /// does not reach, stay apart.
    #[test]
    fn the_hull_is_filled_between_bands_that_may_be_the_same() {
        use InstabilityKind::{Divergence, Flutter};
        let within = SpeedRange::new(0.0, 152.0);
        let bands = [
            band(SplitBranch::Lower, Flutter, 100.0, 101.0),
            band(SplitBranch::Mean, Flutter, 104.0, 105.0),
            band(SplitBranch::Upper, Flutter, 108.0, 109.0),
            band(SplitBranch::Lower, Divergence, 120.0, 121.0),
            band(SplitBranch::Mean, Flutter, 125.0, 126.0),
            band(SplitBranch::Upper, Divergence, 140.0, 141.0),
            band(SplitBranch::Upper, Flutter, 150.0, 160.0),
        ];
        let hull = filled(&bands, 1.05, within);
        let expected = [
            [99.0, 110.09],
            [118.8, 122.21],
            [123.75, 127.26],
            [138.6, 142.41],
            [148.5, 152.0],
        ];
        assert_eq!(hull.len(), expected.len(), "{hull:?}");
        for (range, expected) in hull.iter().zip(expected) {
            for (found, expected) in range.ends().into_iter().zip(expected) {
                assert!((found - expected).abs() < 1e-9, "{hull:?}");
            }
        }
        assert!(filled(&[], 1.05, within).is_empty());
    }
}
