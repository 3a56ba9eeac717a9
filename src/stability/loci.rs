//! The two eigenvalues of a flutter band, followed through it in the complex plane.

use faer::c64;

use super::band::Instability;
use crate::modes::branches::{Sighted, match_modes};
use crate::modes::{Mode, ModeKind, SearchModel, SpectralModel, SpectrumError, smallest};

/// Paths of two eigenvalues over speed.
#[derive(Debug, Clone, PartialEq)]
pub struct RootLoci {
    /// Speeds, ascending, in rad/s.
    pub speeds: Vec<f64>,
    /// λ and Krein sign at each speed, of the mode with sign +1 beside the band, and of that with sign −1. In
    /// the band the first grows, the second decays, and both signs are 0.
    pub paths: [Vec<(c64, i8)>; 2],
}

/// Largest width of an interval, as a share of its end, over which the modes at both ends represent those
/// between.
const NARROW: f64 = 0.04;
/// Speeds of the loci on each side of the band and within each half of it.
const SPEEDS: usize = 20;

impl RootLoci {
    /// Follows the pair of a band from its peak to one width below and above the band, within a range, or
    /// until one of the two coalesces with another mode. `None` without a reduced model, and if the pair is
    /// not found.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn new(
        model: &SpectralModel,
        band: &Instability,
        range: (f64, f64),
    ) -> Result<Option<Self>, SpectrumError> {
        let Some(low) = SearchModel::new(model) else {
            return Ok(None);
        };
        let width = band.to_rad_per_s - band.from_rad_per_s;
        let (from, to) = (
            (band.from_rad_per_s - width).max(range.0),
            (band.to_rad_per_s + width).min(range.1),
        );
        let is_narrow = to - from <= NARROW * to;
        let low = match is_narrow {
            true => low.narrowed(from, to)?,
            false => low,
        };
        let modes = |speed: f64| match is_narrow {
            true => low.modes(speed),
            false => low.lifted_modes(speed),
        };
        let Some(peak) = Pair::at_peak(&modes, band)? else {
            return Ok(None);
        };
        let outwards = |edge: f64, end: f64| {
            let inside = denser_at_ends(band.peak_rad_per_s, edge);
            // At the end of a range that cuts the band, growth is not zero, so the end itself belongs to the
            // path.
            let last = (end != band.peak_rad_per_s).then_some(end);
            inside.chain(denser_at_ends(edge, end)).chain(last)
        };
        let mut rows = peak.followed(&modes, band, outwards(band.from_rad_per_s, from))?;
        rows.reverse();
        rows.push(peak.row());
        rows.extend(peak.followed(&modes, band, outwards(band.to_rad_per_s, to))?);
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

/// Function that gives the modes at a speed.
type ModesAt<'a> = &'a dyn Fn(f64) -> Result<Vec<Mode>, SpectrumError>;

/// Number of modes among which a pair is followed.
const NEIGHBOURS: usize = 32;

/// Lowest modes at a speed, ascending.
fn lowest_modes(modes_at: ModesAt<'_>, speed: f64) -> Result<Vec<Mode>, SpectrumError> {
    let mut modes = modes_at(speed)?;
    modes.sort_by(|x, y| x.frequency_rad_per_s().total_cmp(&y.frequency_rad_per_s()));
    modes.truncate(NEIGHBOURS);
    Ok(modes)
}

/// Two modes at a speed.
struct Pair {
    speed: f64,
    modes: Vec<Mode>,
    chosen: [usize; 2],
}

impl Pair {
    /// The growing and the decaying mode of a band at its peak.
    fn at_peak(modes_at: ModesAt<'_>, band: &Instability) -> Result<Option<Self>, SpectrumError> {
        let modes = lowest_modes(modes_at, band.peak_rad_per_s)?;
        let nearest = |kind: ModeKind, growth: f64| {
            let wanted = c64::new(growth, band.frequency_rad_per_s);
            let same = (0..modes.len()).filter(|i| modes[*i].kind == kind);
            smallest(same, |i| (modes[*i].lambda - wanted).norm())
        };
        let growth = band.peak_growth_per_s;
        let growing = nearest(ModeKind::Flutter, growth);
        let decaying = nearest(ModeKind::Decaying, -growth);
        Ok(growing.zip(decaying).map(|(growing, decaying)| Pair {
            speed: band.peak_rad_per_s,
            modes,
            chosen: [growing, decaying],
        }))
    }

    fn row(&self) -> Row {
        let of = |i: usize| (self.modes[i].lambda, self.modes[i].krein_sign());
        (self.speed, self.chosen.map(of))
    }

    /// Rows of the pair at successive speeds, as long as its modes are coalesced within the band and waves of
    /// opposite sign beside it, the one of sign +1 first.
    fn followed(
        &self,
        modes_at: ModesAt<'_>,
        band: &Instability,
        speeds: impl Iterator<Item = f64>,
    ) -> Result<Vec<Row>, SpectrumError> {
        let mut rows = Vec::new();
        let mut known: Option<Pair> = None;
        for speed in speeds {
            let last = known.as_ref().unwrap_or(self);
            let Some(mut next) = last.to(modes_at, speed)? else {
                break;
            };
            if next.row().1[0].1 < 0 {
                next.chosen.reverse();
            }
            let inside = (band.from_rad_per_s..=band.to_rad_per_s).contains(&speed);
            let signs = next.row().1.map(|(_, sign)| sign);
            if signs != if inside { [0, 0] } else { [1, -1] } {
                break;
            }
            rows.push(next.row());
            known = Some(next);
        }
        Ok(rows)
    }

    /// The two modes at another speed; `None` if one has no match.
    fn to(&self, modes_at: ModesAt<'_>, speed: f64) -> Result<Option<Self>, SpectrumError> {
        let modes = lowest_modes(modes_at, speed)?;
        let highest = |modes: &[Mode]| modes.last().map_or(0.0, Mode::frequency_rad_per_s);
        let height = highest(&self.modes).max(highest(&modes));
        let seen = [&self.modes, &modes].map(|modes| Sighted::of_modes(modes));
        let matches = match_modes([&seen[0], &seen[1]], speed - self.speed, height);
        let after = |before: usize| matches.iter().find(|m| m.before == before).map(|m| m.after);
        let chosen = after(self.chosen[0]).zip(after(self.chosen[1]));
        Ok(chosen.map(|(first, second)| Pair {
            speed,
            modes,
            chosen: [first, second],
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plate::{Plate, Resolution};
    use crate::model::scene::{Accuracy, Scene, rad_per_s};
    use crate::modes::{Strategy, companion_eigenpairs};
    use crate::stability::{InstabilityKind, chart};

    /// Reference: all eigenvalues of the whole matrix at the end of a range that cuts a band.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "dense solves: run it in release")]
    fn paths_continue_to_the_end_of_a_range_that_cuts_their_band() {
        let plate = Plate::new(&Scene::paper(), Resolution::of(Accuracy::Draft));
        let range = (0.0, rad_per_s(2300.0));
        let model = SpectralModel::new(plate, range, Strategy::Reduced).unwrap();
        let bands = chart(&model, range, 5, &|_, _| ()).unwrap().instabilities;
        let flutter = |band: &&Instability| band.kind == InstabilityKind::Flutter;
        let whole = bands.iter().rfind(flutter).unwrap();
        let end = 0.5 * (whole.peak_rad_per_s + whole.to_rad_per_s);
        let cut = Instability {
            to_rad_per_s: end,
            ..whole.clone()
        };
        let loci = RootLoci::new(&model, &cut, (0.0, end)).unwrap().unwrap();
        assert_eq!(loci.speeds.last(), Some(&end));
        assert!(loci.speeds.windows(2).all(|pair| pair[0] < pair[1]));
        let dense = companion_eigenpairs(&model.components[0].full, end).unwrap();
        for (path, sign) in loci.paths.iter().zip([1.0, -1.0]) {
            let (lambda, _) = path[path.len() - 1];
            assert!(sign * lambda.re > 0.5 * whole.peak_growth_per_s, "{lambda}");
            let off = dense.iter().map(|(exact, _)| (exact - lambda).norm());
            let off = off.fold(f64::INFINITY, f64::min);
            // A figure resolves a thousandth of the growth.
            assert!(off < 1e-3 * lambda.re.abs(), "{lambda}: {off:e}");
        }
    }
}
