//! The two eigenvalues of a flutter band over the speed, read off the search for the band.

use faer::c64;
use rayon::prelude::*;

use crate::model::scene::SpeedRange;
use crate::modes::branches::{self, Branch, CampbellError};
use crate::modes::{Mode, ModeKind, SpectralModel, smallest};
use crate::stability::band::Instability;
use crate::stability::between::Between;
use crate::stability::search_result::StabilityChart;

/// Paths of two eigenvalues over speed.
#[derive(Debug, Clone, PartialEq)]
pub struct RootLoci {
    /// Index of the band.
    pub band: usize,
    /// Speeds, ascending, in rad/s.
    pub speeds: Vec<f64>,
    /// λ and Krein sign at each speed, of the mode with sign +1 beside the band, and of that with sign −1. In
    /// the band the first grows, the second decays, and both signs are 0.
    pub paths: [Vec<(c64, i8)>; 2],
}

/// Speeds of the loci on each side of the band and within each half of it.
const SPEEDS: usize = 16;

impl RootLoci {
    /// The pair of the band with an index from its peak to one width below and above the band, within a range, as far as its chart
    /// shows it. `None` if it does not show the pair at the peak.
    ///
    /// # Errors
    /// [`CampbellError`] when an eigenproblem fails.
    pub fn new(
        between: &Between<'_>,
        chart: &StabilityChart,
        index: usize,
        range: SpeedRange,
    ) -> Result<Option<Self>, CampbellError> {
        let (campbell, band) = (&chart.campbell, &chart.instabilities[index]);
        let charted = campbell.samples.iter().map(|at| {
            let modes = at.modes.iter().map(|named| &named.mode);
            (at.speed_rad_per_s, modes.collect())
        });
        let charted = pair(&charted.collect::<Vec<_>>(), &campbell.branches, band);
        let Some([from, .., to]) = charted.as_deref() else {
            return Ok(None);
        };
        let shown = SpeedRange::new(from.speed_rad_per_s, to.speed_rad_per_s).within(range);
        let samples = between.at_all(&speeds(band, shown))?;
        let branches = branches::followed(&samples, between.model.complete_to_rad_per_s);
        let all = samples
            .iter()
            .map(|at| (at.speed_rad_per_s, at.modes.iter().collect()));
        let points = pair(&all.collect::<Vec<_>>(), &branches, band);
        let points = points.map(|points| refined(between.model, points));
        Ok(points.map(|points| RootLoci {
            band: index,
            speeds: points.iter().map(|point| point.speed_rad_per_s).collect(),
            paths: [0, 1].map(|k| points.iter().map(|point| point.pair[k]).collect()),
        }))
    }
}

/// Ascending speeds of the loci of a band that are known over a range.
fn speeds(band: &Instability, known: SpeedRange) -> Vec<f64> {
    let width = band.range().width();
    let wide = SpeedRange::new(band.from_rad_per_s - width, band.to_rad_per_s + width);
    let [first, last] = wide.within(known).ends();
    let [from, to] = band.range().within(known).ends();
    let peak = band.peak_rad_per_s;
    let parts = [(first, from), (from, peak), (peak, to), (to, last)];
    let inner = parts
        .into_iter()
        .flat_map(|(from, to)| denser_at_ends(from, to));
    let mut speeds: Vec<f64> = inner.chain([first, peak, last]).collect();
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    speeds
}

/// Speeds strictly between two others, denser near both, where paths turn; none if the second is not the larger one.
fn denser_at_ends(from: f64, to: f64) -> impl Iterator<Item = f64> {
    let count = if from < to { SPEEDS } else { 0 };
    (0..count).map(move |k| {
        let angle = std::f64::consts::PI * (k as f64 + 0.5) / SPEEDS as f64;
        from + 0.5 * (1.0 - angle.cos()) * (to - from)
    })
}

/// λ and Krein sign of both modes at a speed.
struct Point {
    speed_rad_per_s: f64,
    pair: [(c64, i8); 2],
}

/// The two branches of a band from its peak on as far as they are waves of opposite sign beside it and grow and decay within
/// it. `samples` are speeds and modes.
fn pair(
    samples: &[(f64, Vec<&Mode>)],
    branches: &[Branch],
    band: &Instability,
) -> Option<Vec<Point>> {
    let peak = smallest(0..samples.len(), |at| {
        (samples[*at].0 - band.peak_rad_per_s).abs()
    })?;
    let growing = c64::new(band.peak_growth_per_s, band.frequency_rad_per_s);
    let branch = |kind: ModeKind, lambda: c64| {
        let modes = samples[peak].1.iter().enumerate();
        let of_kind = modes.filter(|(_, mode)| mode.kind == kind);
        let (place, _) = smallest(of_kind, |(_, mode)| (mode.lambda - lambda).norm())?;
        let passes = |branch: &&Branch| branch.points.contains(&(peak, place));
        branches.iter().find(passes)
    };
    let both = [
        branch(ModeKind::Flutter, growing)?,
        branch(ModeKind::Decaying, -growing.conj())?,
    ];
    let point = |sample: usize| {
        let (speed_rad_per_s, modes) = &samples[sample];
        let mode = |branch: &Branch| {
            let points = &branch.points;
            let point = points.binary_search_by_key(&sample, |point| point.0).ok()?;
            Some(modes[points[point].1])
        };
        Some(Point {
            speed_rad_per_s: *speed_rad_per_s,
            pair: signed([mode(both[0])?, mode(both[1])?])?,
        })
    };
    let (below, beyond) = (0..peak, peak..samples.len());
    let mut points: Vec<Point> = below.rev().map_while(point).collect();
    points.reverse();
    points.extend(beyond.map_while(point));
    // The pieces of the search and Newton's method differ slightly in the edges of the band.
    points.retain(|point| {
        let is_coalesced = point.pair[0].1 == 0;
        band.range().contains(point.speed_rad_per_s) == is_coalesced
    });
    Some(points)
}

/// λ and Krein sign of two modes that have coalesced, or of two waves of opposite sign, that of sign + first.
fn signed(modes: [&Mode; 2]) -> Option<[(c64, i8); 2]> {
    use ModeKind::{Decaying, Flutter, Negative, Positive};
    let signs = match modes.map(|mode| mode.kind) {
        [Flutter, Decaying] => [0, 0],
        [Positive, Negative] => [1, -1],
        _ => return None,
    };
    Some([(modes[0].lambda, signs[0]), (modes[1].lambda, signs[1])])
}

/// Newton's method may leave an interpolated λ by this share of the distance of the two, so that it finds the same one.
const SAME_PATH: f64 = 0.25;

/// Points with eigenvalues of the model next to the interpolated ones.
fn refined(model: &SpectralModel, points: Vec<Point>) -> Vec<Point> {
    let refine = |mut point: Point| {
        let [(first, sign), (second, _)] = point.pair;
        let reach = SAME_PATH * (first - second).norm();
        let refined = |lambda: c64| {
            let found = model.next_to(point.speed_rad_per_s, lambda);
            let found = found.map(|(found, _)| found);
            found.filter(|found| (found - lambda).norm() < reach)
        };
        if sign == 0 {
            let growing = refined(first).unwrap_or(first);
            point.pair = [(growing, 0), (-growing.conj(), 0)];
        } else {
            let wave = |wave: c64| refined(wave).map_or(wave, |found| c64::new(0.0, found.im));
            point.pair = [(wave(first), 1), (wave(second), -1)];
        }
        point
    };
    points.into_par_iter().map(refine).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plate::{Plate, Resolution};
    use crate::model::scene::{Accuracy, Scene};
    use crate::modes::{SpectralModel, Strategy, companion_eigenpairs};
    use crate::stability::InstabilityKind;
    use crate::stability::options::AnalysisOptions;
    use crate::stability::undamped::{Depth, charted};

    /// Reference: all eigenvalues of the whole matrix along the paths of a band that the range cuts.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "dense solves: run it in release")]
    fn paths_are_eigenvalues_up_to_the_end_of_a_range_that_cuts_their_band() {
        // The band lasts from 2255.9 to 2266.1 rpm.
        let range = SpeedRange::between_rpm(0.0, 2264.0);
        let plate = Plate::new(&Scene::paper(), Resolution::of(Accuracy::Draft));
        let model = SpectralModel::new(plate, range, Strategy::Reduced).unwrap();
        let (chart, between) =
            charted(&model, range, 5, Depth::Counts, AnalysisOptions::default()).unwrap();
        let flutter = |band: &&Instability| band.kind == InstabilityKind::Flutter;
        let index = chart.instabilities.iter().rposition(|band| flutter(&band));
        let index = index.unwrap();
        let band = &chart.instabilities[index];
        assert!(!band.closed);
        let loci = RootLoci::new(&between, &chart, index, range)
            .unwrap()
            .unwrap();
        assert_eq!(loci.speeds.last(), Some(&range.to_rad_per_s));
        assert!(loci.speeds.windows(2).all(|pair| pair[0] < pair[1]));
        let (mut beside, mut within) = (0, 0);
        for (k, &speed) in loci.speeds.iter().enumerate().rev().step_by(4) {
            let dense = companion_eigenpairs(&model.components[0].full, speed).unwrap();
            for (path, sign) in loci.paths.iter().zip([1.0, -1.0]) {
                let (lambda, krein) = path[k];
                match krein {
                    0 => within += usize::from(sign * lambda.re > 0.0),
                    _ => beside += usize::from(f64::from(krein) == sign),
                }
                let off = dense
                    .iter()
                    .map(|(exact, _)| (exact - lambda).norm())
                    .fold(f64::INFINITY, f64::min);
                assert!(
                    off < 1e-4 * band.peak_growth_per_s,
                    "{speed} {lambda}: {off:e}"
                );
            }
        }
        assert!(beside >= 8 && within >= 8, "{beside} {within}");
    }
}
