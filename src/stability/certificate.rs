//! Results of the checks of a list of bands.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::band::Instability;
use super::group::Sloped;
use super::instability_kind::InstabilityKind;
use super::mode_counts::MiscountedModes;
use super::sample::{Plane, Sample};
use crate::model::scene::{SpeedRange, rpm};

/// Results of the checks of a list of bands: comparisons of the Krein index with the spectra, mode counts on the
/// full model, and the part of the range that is proven to contain no unlisted band.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Certificate {
    /// Number of speeds at which the Krein index was compared.
    pub speeds_checked: usize,
    /// Speeds at which the Krein index contradicts the modes even on the full model, in rad/s.
    pub violations_rad_per_s: Vec<f64>,
    /// Speeds at which the bands contradict the eigenvalues.
    pub mismatches: Vec<ContradictedBands>,
    /// Whether the search used up its allowed number of speeds.
    pub gave_up: bool,
    /// Number of conclusive mode counts on the full model.
    pub full_basis_counts: usize,
    /// Number of inconclusive counts of a damped saw, because an eigenvalue is on their path.
    pub uncertain_counts: usize,
    /// Counts that contradict the spectra.
    pub miscounts: Vec<MiscountedModes>,
    /// Whether counts contradicted the spectra at first, so that the bands were searched again with more
    /// waves.
    pub searched_again: bool,
    /// Number of speeds at which bands end or growth was examined that are interpolated, because no eigenproblem gave an eigenvalue
    /// there.
    pub interpolated: usize,
    /// Intervals of speed, in rad/s, that are not proven to contain no unlisted band; `None` if no proof was
    /// tried.
    pub unproven_rad_per_s: Option<Vec<SpeedRange>>,
}

impl Certificate {
    /// Whether counts contradict the spectra, so that a model with more waves is to be searched.
    pub(super) fn lacks_waves(&self) -> bool {
        !self.miscounts.is_empty()
    }

    /// Whether the search failed, so that its bands decide nothing.
    pub fn has_failed(&self) -> bool {
        has_failed(self.contradicted(), self.speeds_checked)
    }

    /// Number of speeds at which eigenvalues contradict the modes or the bands.
    pub(crate) fn contradicted(&self) -> usize {
        self.violations_rad_per_s.len() + self.mismatches.len()
    }

    /// Whether no check found a contradiction and the search was completed.
    pub fn is_clean(&self) -> bool {
        self.violations_rad_per_s.is_empty()
            && self.mismatches.is_empty()
            && self.miscounts.is_empty()
            && !self.gave_up
    }
}

/// Share of the compared speeds with a contradiction from which on a search has failed: a band that is missing, or wrong at an edge,
/// contradicts the speeds within it alone.
const FAILED: f64 = 0.1;
/// Smallest number of contradictions of a failed search.
const FEWEST_FAILED: usize = 3;

/// Whether the bands of a search decide nothing, because they contradict the eigenvalues at a large share of the speeds compared.
pub(crate) fn has_failed(contradicted: usize, speeds: usize) -> bool {
    contradicted >= FEWEST_FAILED && contradicted as f64 >= FAILED * speeds as f64
}

/// A speed at which the list of bands contradicts the eigenvalues found there.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "MismatchEntry")]
pub struct ContradictedBands {
    /// The speed.
    pub rpm: f64,
    /// Kind of the modes and bands compared.
    pub kind: InstabilityKind,
    /// Number of unstable modes of that kind; for divergence 1 or 0.
    pub unstable_modes: usize,
    /// Number of bands of that kind that contain the speed.
    pub bands: usize,
    /// Growth of the fastest of these modes.
    pub growth_per_s: f64,
    /// Largest growth of these bands.
    pub peak_per_s: f64,
}

/// Relative distance from the edge of a band within which a speed may be on either side of it: the coarser
/// models of search and chart shift edges by 1e-5.
const EDGE_TOLERANCE: f64 = 5e-5;
/// Share by which a mode may grow faster than the peak of its band, because a mode of the chart is not
/// refined.
const PEAK_TOLERANCE: f64 = 0.03;

/// Share of |ω| + Ω below which growth is not compared with the bands: next to a coalescence eigenvalues are
/// accurate to √ε of the largest frequency of the reduced model.
pub const GROWTH_FLOOR: f64 = 1e-5;

/// Contradictions between bands and modes at some speeds.
pub fn contradictions(
    bands: &[Instability],
    samples: &[Sample],
    floor: f64,
) -> Vec<ContradictedBands> {
    let of = |sample: &Sample| {
        let highest = sample.highest_rad_per_s();
        let floor = floor * (sample.speed_rad_per_s + highest);
        mismatches(bands, sample, floor)
    };
    samples.iter().flat_map(of).collect()
}

/// Compares bands with the modes at a speed: each kind must have as many bands as unstable modes, and no mode
/// may grow faster than the peak of its band. `floor_per_s` is the growth below which a mode may be rounding.
fn mismatches(bands: &[Instability], sample: &Sample, floor_per_s: f64) -> Vec<ContradictedBands> {
    let speed = sample.speed_rad_per_s;
    let near = |edge: f64| (speed / edge - 1.0).abs() <= EDGE_TOLERANCE;
    if bands
        .iter()
        .any(|band| near(band.from_rad_per_s) || near(band.to_rad_per_s))
    {
        return Vec::new();
    }
    let growth = |(square, _): Sloped| Plane::Squares.growth_per_s(square);
    let flutter = sample.quadruples().map(growth);
    let divergence = sample.divergences().next().map(growth);
    let growth = [
        (InstabilityKind::Flutter, flutter.collect()),
        (
            InstabilityKind::Divergence,
            divergence.into_iter().collect::<Vec<f64>>(),
        ),
    ];
    growth
        .into_iter()
        .filter_map(|(kind, growth)| mismatch(bands, speed, kind, growth, floor_per_s))
        .collect()
}

fn mismatch(
    bands: &[Instability],
    speed: f64,
    kind: InstabilityKind,
    mut growth: Vec<f64>,
    floor_per_s: f64,
) -> Option<ContradictedBands> {
    let covers = |b: &&Instability| b.kind == kind && b.range().contains(speed);
    let mut peaks: Vec<f64> = bands
        .iter()
        .filter(covers)
        .map(|b| b.peak_growth_per_s)
        .collect();
    let descending = |x: &f64, y: &f64| y.total_cmp(x);
    growth.sort_by(descending);
    peaks.sort_by(descending);
    let certain = growth
        .iter()
        .filter(|growth| **growth > floor_per_s)
        .count();
    let above =
        |(growth, peak): (&f64, &f64)| *growth > peak * (1.0 + PEAK_TOLERANCE) + floor_per_s;
    let is_faster = growth.iter().zip(&peaks).any(above);
    let strong = peaks.iter().filter(|peak| **peak > floor_per_s).count();
    (certain > peaks.len() || strong > growth.len() || is_faster).then(|| ContradictedBands {
        rpm: rpm(speed),
        kind,
        unstable_modes: growth.len(),
        bands: peaks.len(),
        growth_per_s: growth.first().copied().unwrap_or(0.0),
        peak_per_s: peaks.first().copied().unwrap_or(0.0),
    })
}

#[cfg(test)]
mod tests {
    use faer::c64;

    use super::*;
    use crate::stability::band::BandEnd;

    fn band(kind: InstabilityKind, from: f64, to: f64, peak_growth_per_s: f64) -> Instability {
        Instability {
            kind,
            from_rad_per_s: from,
            to_rad_per_s: to,
            ends: [BandEnd::Range; 2],
            closed: true,
            peak_rad_per_s: 0.5 * (from + to),
            peak_growth_per_s,
            frequency_rad_per_s: 1.0,
            curve: Vec::new(),
        }
    }

    /// Two flutter modes of growth 2 and 1 at 100 rad/s.
    fn fluttering() -> Sample {
        let quadruple = |growth: f64| {
            let square = c64::new(growth, 10.0) * c64::new(growth, 10.0);
            [square, square.conj()].map(|square| ((square, c64::ZERO), 0))
        };
        let squares = [1.0, 2.0].into_iter().flat_map(quadruple);
        Sample::of_squares(100.0, squares.collect())
    }

    fn wrong(bands: &[Instability]) -> usize {
        mismatches(bands, &fluttering(), 1e-3).len()
    }

    #[test]
    fn a_band_that_is_missing_never_closed_too_low_or_of_the_wrong_kind_is_found() {
        use InstabilityKind::{Divergence, Flutter};
        let right = [
            band(Flutter, 90.0, 110.0, 2.5),
            band(Flutter, 95.0, 105.0, 1.0),
        ];
        assert_eq!(wrong(&right), 0);
        assert_eq!(wrong(&right[..1]), 1);
        let [first, second] = &right;
        let never_closed = band(Flutter, 50.0, 200.0, 3.0);
        assert_eq!(wrong(&[first.clone(), second.clone(), never_closed]), 1);
        assert_eq!(wrong(&[first.clone(), band(Flutter, 95.0, 105.0, 0.5)]), 1);
        assert_eq!(
            wrong(&[first.clone(), band(Divergence, 95.0, 105.0, 1.0)]),
            2
        );
    }
}
