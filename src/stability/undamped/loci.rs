//! The two eigenvalues of a flutter band over the speed, read off the branches of a chart.
//!
//! The mean M of both λ² and the square D of half their difference are smooth through the edges of the band,
//!
//! λ²₁,₂ = M ± √D,  D < 0 within the band,
//!
//! so that cubics by values and slopes at the speeds of the chart give both eigenvalues at any speed.

use faer::c64;

use crate::model::scene::SpeedRange;
use crate::modes::branches::{Branch, Campbell, SpeedSample};
use crate::modes::{Mode, ModeKind, NamedMode, smallest};
use crate::stability::band::Instability;
use crate::stability::interpolation::Cubic;
use crate::stability::sample::squared;

/// Paths of two eigenvalues over speed.
#[derive(Debug, Clone, PartialEq)]
pub struct RootLoci {
    /// Speeds, ascending, in rad/s.
    pub speeds: Vec<f64>,
    /// λ and Krein sign at each speed, of the mode with sign +1 beside the band, and of that with sign −1. In
    /// the band the first grows, the second decays, and both signs are 0.
    pub paths: [Vec<(c64, i8)>; 2],
}

/// Speeds of the loci on each side of the band and within each half of it.
const SPEEDS: usize = 20;

impl RootLoci {
    /// The pair of a band from its peak to one width below and above the band, within a range, or
    /// until one of the two coalesces with another mode. `None` if the chart has no such pair at the peak.
    pub fn new(campbell: &Campbell, band: &Instability, range: SpeedRange) -> Option<Self> {
        let width = band.range().width();
        let wide = SpeedRange::new(band.from_rad_per_s - width, band.to_rad_per_s + width);
        let wide = wide.within(range);
        let nodes = nodes(campbell, band, wide)?;
        let known = SpeedRange::new(nodes.first()?.speed, nodes.last()?.speed);
        let [first, last] = known.within(wide).ends();
        let peak = band.peak_rad_per_s;
        let [from, to] = band.range().within(known).ends();
        let mut speeds: Vec<f64> = [(first, from), (from, peak), (peak, to), (to, last)]
            .into_iter()
            .flat_map(|(from, to)| denser_at_ends(from, to))
            .chain([first, peak, last])
            .collect();
        speeds.sort_by(f64::total_cmp);
        speeds.dedup();
        let at = |speed: f64| value(&nodes, speed, band.range().contains(speed));
        let rows: Vec<[(c64, i8); 2]> = speeds.iter().map(|speed| at(*speed)).collect();
        Some(RootLoci {
            paths: [0, 1].map(|k| rows.iter().map(|row| row[k]).collect()),
            speeds,
        })
    }
}

/// Speeds strictly between two others, denser near both, where paths turn; none if the second is not the larger one.
fn denser_at_ends(from: f64, to: f64) -> impl Iterator<Item = f64> {
    let count = if from < to { SPEEDS } else { 0 };
    (0..count).map(move |k| {
        let angle = std::f64::consts::PI * (k as f64 + 0.5) / SPEEDS as f64;
        from + 0.5 * (1.0 - angle.cos()) * (to - from)
    })
}

/// A pair at a speed of the chart.
#[derive(Debug, Clone, Copy)]
struct Node {
    speed: f64,
    /// M and its slope.
    mean: [f64; 2],
    /// D and its slope.
    square: [f64; 2],
    /// Whether the two are waves, and the first has the larger λ².
    is_first_larger: bool,
}

impl Node {
    /// The pair of two modes that have coalesced, or of two waves of opposite sign, those of sign + first.
    fn new(speed: f64, modes: [&Mode; 2]) -> Option<Self> {
        use ModeKind::{Decaying, Flutter, Negative, Positive};
        let kinds = modes.map(|mode| mode.kind);
        if !matches!(kinds, [Flutter, Decaying] | [Positive, Negative]) {
            return None;
        }
        let [first, second] = modes.map(|mode| squared((mode.lambda, mode.slope)));
        let [mean, half] = [
            (first.0 + second.0, first.1 + second.1),
            (first.0 - second.0, first.1 - second.1),
        ]
        .map(|(number, slope)| (0.5 * number, 0.5 * slope));
        Some(Node {
            speed,
            mean: [mean.0.re, mean.1.re],
            square: [(half.0 * half.0).re, (2.0 * half.0 * half.1).re],
            is_first_larger: kinds[0] == Positive && half.0.re > 0.0,
        })
    }
}

/// The pair of a band at the speeds of a chart within a range and next to it, ascending.
fn nodes(campbell: &Campbell, band: &Instability, range: SpeedRange) -> Option<Vec<Node>> {
    let samples = &campbell.samples;
    let is_peak = |sample: &SpeedSample| sample.speed_rad_per_s == band.peak_rad_per_s;
    let peak = samples.iter().position(is_peak)?;
    let growing = c64::new(band.peak_growth_per_s, band.frequency_rad_per_s);
    let branch = |kind: ModeKind, lambda: c64| -> Option<&Branch> {
        let modes = samples[peak].modes.iter().enumerate();
        let of_kind = modes.filter(|(_, named)| named.mode.kind == kind);
        let off = |(_, named): &(usize, &NamedMode)| (named.mode.lambda - lambda).norm();
        let (place, _) = smallest(of_kind, off)?;
        let passes = |branch: &&Branch| branch.points.contains(&(peak, place));
        campbell.branches.iter().find(passes)
    };
    let both = [
        branch(ModeKind::Flutter, growing)?,
        branch(ModeKind::Decaying, -growing.conj())?,
    ];
    let node = |sample: usize| {
        let of = |branch: &Branch| {
            let place = branch.points.binary_search_by_key(&sample, |point| point.0);
            place
                .ok()
                .map(|place| &campbell.mode(branch.points[place]).mode)
        };
        let speed = samples[sample].speed_rad_per_s;
        let node = Node::new(speed, [of(both[0])?, of(both[1])?])?;
        let is_inside = band.range().contains(node.speed);
        (is_inside == (node.square[0] < 0.0)).then_some(node)
    };
    // Computed samples only; the cubics to the ends of the range need one at or beyond each.
    let solved: Vec<usize> = (0..samples.len())
        .filter(|at| samples[*at].is_solved())
        .collect();
    let above = |end: f64| solved.partition_point(|at| samples[*at].speed_rad_per_s < end);
    let first = above(range.from_rad_per_s).saturating_sub(1);
    let last = (above(range.to_rad_per_s) + 1).min(solved.len());
    let (below, beyond) =
        solved[first..last].split_at(solved[first..last].partition_point(|at| *at <= peak));
    let mut nodes: Vec<Node> = below.iter().rev().copied().map_while(node).collect();
    nodes.reverse();
    nodes.extend(beyond.iter().copied().map_while(node));
    (!nodes.is_empty()).then_some(nodes)
}

/// λ and Krein sign of both modes at a speed between two nodes.
fn value(nodes: &[Node], speed: f64, is_coalesced: bool) -> [(c64, i8); 2] {
    let after = nodes.partition_point(|node| node.speed < speed);
    let [last, next] = [after.saturating_sub(1), after.min(nodes.len() - 1)].map(|k| nodes[k]);
    let width = next.speed - last.speed;
    let share = if width > 0.0 {
        (speed - last.speed) / width
    } else {
        0.0
    };
    let at = |part: fn(&Node) -> [f64; 2]| {
        let ends = [part(&last), part(&next)];
        let cubic = Cubic {
            values: ends.map(|end| end[0]),
            slopes: ends.map(|end| end[1] * width),
        };
        cubic.at(share)
    };
    let mean = at(|node| node.mean);
    let half = at(|node| node.square).abs().sqrt();
    if is_coalesced {
        let growing = c64::new(mean, half).sqrt();
        return [(growing, 0), (-growing.conj(), 0)];
    }
    let is_first_larger = last.is_first_larger || next.is_first_larger;
    let half = if is_first_larger { half } else { -half };
    let wave = |square: f64| c64::new(0.0, (-square).max(0.0).sqrt());
    [(wave(mean + half), 1), (wave(mean - half), -1)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plate::{Plate, Resolution};
    use crate::model::scene::{Accuracy, Scene};
    use crate::modes::{SpectralModel, Strategy, companion_eigenpairs};
    use crate::stability::{InstabilityKind, chart};

    /// Reference: all eigenvalues of the whole matrix along the paths of a band that the range cuts.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "dense solves: run it in release")]
    fn paths_are_eigenvalues_up_to_the_end_of_a_range_that_cuts_their_band() {
        // The band lasts from 2255.9 to 2266.1 rpm.
        let range = SpeedRange::between_rpm(0.0, 2264.0);
        let plate = Plate::new(&Scene::paper(), Resolution::of(Accuracy::Draft));
        let model = SpectralModel::new(plate, range, Strategy::Reduced).unwrap();
        let chart = chart(&model, range, 5, &|_, _| ()).unwrap();
        let flutter = |band: &&Instability| band.kind == InstabilityKind::Flutter;
        let band = chart.instabilities.iter().rfind(flutter).unwrap();
        assert!(!band.closed);
        let loci = RootLoci::new(&chart.campbell, band, range).unwrap();
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
                // A figure resolves a few thousandths of the growth.
                assert!(
                    off < 2e-3 * band.peak_growth_per_s,
                    "{speed} {lambda}: {off:e}"
                );
            }
        }
        assert!(beside >= 8 && within >= 8, "{beside} {within}");
    }
}
