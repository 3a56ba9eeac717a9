//! The two eigenvalues of a flutter band, followed through it in the complex plane.

use faer::c64;

use super::band::Instability;
use crate::model::scene::SpeedRange;
use crate::modes::{Mode, SpectralModel, SpectrumError, smallest};

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
    /// Follows the pair of a band from its peak to one width below and above the band, within a range, or
    /// until one of the two coalesces with another mode. `None` if the pair is not found.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn new(
        model: &SpectralModel,
        band: &Instability,
        range: SpeedRange,
    ) -> Result<Option<Self>, SpectrumError> {
        let width = band.range().width();
        let wide = SpeedRange::new(band.from_rad_per_s - width, band.to_rad_per_s + width);
        let [from, to] = wide.within(range).ends();
        let pairs = Pairs(model);
        let Some(peak) = pairs.at_peak(band) else {
            return Ok(None);
        };
        let outwards = |edge: f64, end: f64| {
            let inside = denser_at_ends(band.peak_rad_per_s, edge);
            // At the end of a range that cuts the band, growth is not zero, so the end itself belongs to the
            // path.
            let last = (end != band.peak_rad_per_s).then_some(end);
            inside.chain(denser_at_ends(edge, end)).chain(last)
        };
        let mut rows = pairs.followed(peak, band, outwards(band.from_rad_per_s, from))?;
        rows.reverse();
        rows.push(peak.row([0, 0]));
        rows.extend(pairs.followed(peak, band, outwards(band.to_rad_per_s, to))?);
        let path = |k: usize| rows.iter().map(|row| row.1[k]).collect();
        Ok(Some(RootLoci {
            speeds: rows.iter().map(|row| row.0).collect(),
            paths: [path(0), path(1)],
        }))
    }
}

/// A speed, and λ and Krein sign of both modes.
type Row = (f64, [(c64, i8); 2]);

/// Speeds strictly between two others, denser near both, where paths turn.
fn denser_at_ends(from: f64, to: f64) -> impl Iterator<Item = f64> {
    let count = if from == to { 0 } else { SPEEDS };
    (0..count).map(move |k| {
        let angle = std::f64::consts::PI * (k as f64 + 0.5) / SPEEDS as f64;
        from + 0.5 * (1.0 - angle.cos()) * (to - from)
    })
}

/// Two eigenvalues at a speed, each with its slope.
#[derive(Debug, Clone, Copy)]
struct Pair {
    speed: f64,
    sloped: [(c64, c64); 2],
}

/// Real part of λ, as a share of the distance of the two waves of a pair, that is rounding.
const ROUNDING: f64 = 1e-3;
/// Largest error of a predicted eigenvalue, as a share of this distance; one further away belongs to another pair.
const SAME: f64 = 0.5;

impl Pair {
    fn row(&self, signs: [i8; 2]) -> Row {
        (self.speed, [0, 1].map(|k| (self.sloped[k].0, signs[k])))
    }

    /// Mean and half the difference of the two at another speed: of growing and decaying mode, or of two waves. The mean and
    /// the square of the difference are smooth through the edge of the band and are continued by their slopes.
    fn predicted(&self, speed: f64, is_coalesced: bool) -> [c64; 2] {
        let [(first, first_slope), (second, second_slope)] = self.sloped;
        let step = speed - self.speed;
        let mean = 0.5 * (first + second + (first_slope + second_slope) * step);
        let known = 0.5 * (first - second);
        let square = known * known + known * (first_slope - second_slope) * step;
        let size = square.re.abs().sqrt();
        let half = if is_coalesced {
            c64::new(size, 0.0)
        } else {
            c64::new(0.0, size)
        };
        [c64::new(0.0, mean.im), half]
    }
}

/// Pairs of eigenvalues of a saw.
struct Pairs<'a>(&'a SpectralModel);

impl Pairs<'_> {
    /// The growing and the decaying mode of a band at its peak.
    fn at_peak(&self, band: &Instability) -> Option<Pair> {
        let growing = c64::new(band.peak_growth_per_s, 0.0);
        let mean = c64::new(0.0, band.frequency_rad_per_s);
        self.at(band.peak_rad_per_s, [mean, growing])
    }

    /// The pair at a speed from its expected mean and half difference. `None` if it is not there.
    fn at(&self, speed: f64, [mean, half]: [c64; 2]) -> Option<Pair> {
        let next_to = |expected: c64| {
            let found = self.0.next_to(speed, expected)?;
            ((found.0 - expected).norm() <= SAME * half.norm()).then_some(found)
        };
        let first = next_to(mean + half)?;
        if half.re > 0.0 {
            let (lambda, slope) = first;
            let sloped = [first, (-lambda.conj(), -slope.conj())];
            return (lambda.re > 0.0).then_some(Pair { speed, sloped });
        }
        let sloped = [first, next_to(mean - half)?];
        let are_waves = sloped
            .iter()
            .all(|(lambda, _)| lambda.re.abs() <= ROUNDING * half.norm());
        let imaginary = |z: c64| c64::new(0.0, z.im);
        are_waves.then_some(Pair {
            speed,
            sloped: sloped.map(|(lambda, slope)| (imaginary(lambda), imaginary(slope))),
        })
    }

    /// Rows of a pair at successive speeds, as long as its modes are coalesced within the band and waves of opposite
    /// sign beside it, the one of sign +1 first.
    fn followed(
        &self,
        peak: Pair,
        band: &Instability,
        speeds: impl Iterator<Item = f64>,
    ) -> Result<Vec<Row>, SpectrumError> {
        let (mut rows, mut beside): (Vec<Row>, Vec<Pair>) = Default::default();
        let mut last = peak;
        for speed in speeds {
            let is_inside = band.range().contains(speed);
            let Some(next) = self.at(speed, last.predicted(speed, is_inside)) else {
                break;
            };
            if is_inside {
                rows.push(next.row([0, 0]))
            } else {
                beside.push(next)
            }
            last = next;
        }
        // Next to a coalescence at either end signs are rounding.
        let Some(middle) = beside.get(beside.len() / 2) else {
            return Ok(rows);
        };
        let is_reversed = match self.signs(middle)? {
            [Some(1), Some(-1)] => false,
            [Some(-1), Some(1)] => true,
            _ => return Ok(rows),
        };
        rows.extend(beside.into_iter().map(|mut pair| {
            if is_reversed {
                pair.sloped.reverse();
            }
            pair.row([1, -1])
        }));
        Ok(rows)
    }

    /// Krein signs of a pair.
    fn signs(&self, pair: &Pair) -> Result<[Option<i8>; 2], SpectrumError> {
        let modes = self.0.all_modes(pair.speed)?;
        Ok(pair.sloped.map(|(lambda, _)| {
            let nearest = smallest(&modes, |mode| (mode.lambda - lambda).norm());
            nearest.map(Mode::krein_sign)
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plate::{Plate, Resolution};
    use crate::model::scene::{Accuracy, Scene};
    use crate::modes::{Strategy, companion_eigenpairs};
    use crate::stability::{InstabilityKind, chart};

    /// Reference: all eigenvalues of the whole matrix at the end of a range that cuts a band.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "dense solves: run it in release")]
    fn paths_continue_to_the_end_of_a_range_that_cuts_their_band() {
        let plate = Plate::new(&Scene::paper(), Resolution::of(Accuracy::Draft));
        let range = SpeedRange::between_rpm(0.0, 2300.0);
        let model = SpectralModel::new(plate, range, Strategy::Reduced).unwrap();
        let bands = chart(&model, range, 5, &|_, _| ()).unwrap().instabilities;
        let flutter = |band: &&Instability| band.kind == InstabilityKind::Flutter;
        let whole = bands.iter().rfind(flutter).unwrap();
        let end = 0.5 * (whole.peak_rad_per_s + whole.to_rad_per_s);
        let cut = Instability {
            to_rad_per_s: end,
            ..whole.clone()
        };
        let loci = RootLoci::new(&model, &cut, SpeedRange::new(0.0, end))
            .unwrap()
            .unwrap();
        assert_eq!(loci.speeds.last(), Some(&end));
        assert!(loci.speeds.windows(2).all(|pair| pair[0] < pair[1]));
        let dense = companion_eigenpairs(&model.components[0].full, end).unwrap();
        for (path, sign) in loci.paths.iter().zip([1.0, -1.0]) {
            let (lambda, _) = path[path.len() - 1];
            assert!(sign * lambda.re > 0.5 * whole.peak_growth_per_s, "{lambda}");
            let off = dense
                .iter()
                .map(|(exact, _)| (exact - lambda).norm())
                .fold(f64::INFINITY, f64::min);
            // A figure resolves a thousandth of the growth.
            assert!(off < 1e-3 * lambda.re.abs(), "{lambda}: {off:e}");
        }
    }
}
