//! The two eigenvalues of a flutter band, followed through it in the complex plane.

use faer::c64;

use super::band::Instability;
use crate::campbell::{Sighted, match_modes};
use crate::spectrum::{Mode, ModeKind, ReflectedModel, SpectralModel, SpectrumError};

/// Two eigenvalues over speed.
#[derive(Debug, Clone, PartialEq)]
pub struct RootLoci {
    /// Speeds, ascending, in rad/s.
    pub speeds: Vec<f64>,
    /// For the mode of Krein sign +1 and that of −1: λ and Krein sign at each speed.
    pub paths: [Vec<(c64, i8)>; 2],
}

/// Stretches wider than this share of their end are not spanned by the modes at both ends.
const NARROW: f64 = 0.04;
/// Speeds of the loci on each side of the band and within each half of it.
const SPEEDS: usize = 20;

impl RootLoci {
    /// Follows the pair of a band from its peak to one width before it and one after it, inside
    /// a range, or to where one of the two meets another mode.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn new(
        model: &SpectralModel,
        band: &Instability,
        range: (f64, f64),
    ) -> Result<Option<Self>, SpectrumError> {
        let Some(low) = model.reflected_model() else {
            return Ok(None);
        };
        let width = band.to_rad_per_s - band.from_rad_per_s;
        let (from, to) = (
            (band.from_rad_per_s - width).max(range.0),
            (band.to_rad_per_s + width).min(range.1),
        );
        let low = if to - from <= NARROW * to {
            low.between([&low.states(from)?, &low.states(to)?])
        } else {
            low
        };
        let Some(peak) = Pair::at_peak(&low, band)? else {
            return Ok(None);
        };
        let outwards = |edge: f64, end: f64| {
            denser_at_ends(band.peak_rad_per_s, edge).chain(denser_at_ends(edge, end))
        };
        let mut rows = peak.followed(&low, band, outwards(band.from_rad_per_s, from))?;
        rows.reverse();
        rows.push(peak.row());
        rows.extend(peak.followed(&low, band, outwards(band.to_rad_per_s, to))?);
        let path = |k: usize| rows.iter().map(|row| row.1[k]).collect();
        Ok(Some(RootLoci {
            speeds: rows.iter().map(|row| row.0).collect(),
            paths: [path(0), path(1)],
        }))
    }
}

/// A speed, and λ and Krein sign of both modes.
type Row = (f64, [(c64, i8); 2]);

/// Speeds from one to another, neither of them, closer together at both, where paths turn.
fn denser_at_ends(from: f64, to: f64) -> impl Iterator<Item = f64> {
    let count = if from == to { 0 } else { SPEEDS };
    (0..count).map(move |k| {
        let angle = std::f64::consts::PI * (k as f64 + 0.5) / SPEEDS as f64;
        from + 0.5 * (1.0 - angle.cos()) * (to - from)
    })
}

/// Modes among which a pair is followed.
const NEIGHBOURS: usize = 32;

/// The lowest modes of a speed, ascending.
fn lowest_modes(low: &ReflectedModel<'_>, speed: f64) -> Result<Vec<Mode>, SpectrumError> {
    let mut modes = low.modes(speed)?;
    modes.sort_by(|x, y| x.frequency_rad_per_s().total_cmp(&y.frequency_rad_per_s()));
    modes.truncate(NEIGHBOURS);
    Ok(modes)
}

/// The two modes among those of a speed.
struct Pair {
    speed: f64,
    modes: Vec<Mode>,
    chosen: [usize; 2],
}

impl Pair {
    /// The growing and the decaying mode of a band where it grows fastest.
    fn at_peak(
        low: &ReflectedModel<'_>,
        band: &Instability,
    ) -> Result<Option<Self>, SpectrumError> {
        let modes = lowest_modes(low, band.peak_rad_per_s)?;
        let nearest = |kind: ModeKind, growth: f64| {
            let wanted = c64::new(growth, band.frequency_rad_per_s);
            let off = |i: &usize| (modes[*i].lambda - wanted).norm();
            let same = (0..modes.len()).filter(|i| modes[*i].kind == kind);
            same.min_by(|x, y| off(x).total_cmp(&off(y)))
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

    /// Rows of the pair at one speed after another, as far as it stays a pair: merged within
    /// the band, two waves beside it.
    fn followed(
        &self,
        low: &ReflectedModel<'_>,
        band: &Instability,
        speeds: impl Iterator<Item = f64>,
    ) -> Result<Vec<Row>, SpectrumError> {
        let mut rows = Vec::new();
        let mut known: Option<Pair> = None;
        for speed in speeds {
            let last = known.as_ref().unwrap_or(self);
            let Some(next) = last.to(low, speed)? else {
                break;
            };
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

    /// The same two modes at another speed.
    fn to(&self, low: &ReflectedModel<'_>, speed: f64) -> Result<Option<Self>, SpectrumError> {
        let modes = lowest_modes(low, speed)?;
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
