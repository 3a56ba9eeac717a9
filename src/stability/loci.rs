//! The two eigenvalues of a flutter band, followed through it in the complex plane.

use faer::c64;

use super::bands::Instability;
use super::flutter::meeting_modes;
use crate::spectrum::{Mode, ModeKind, SpectralModel, SpectrumError};

/// Two eigenvalues over speed.
#[derive(Debug, Clone, PartialEq)]
pub struct RootLoci {
    /// Speeds, ascending, in rad/s.
    pub speeds: Vec<f64>,
    /// For the mode of Krein sign +1 and that of −1: its name before the onset.
    pub names: Vec<String>,
    /// λ and Krein sign of both at each speed.
    pub paths: [Vec<(c64, i8)>; 2],
}

/// Stretches wider than this share of their end are not spanned by the modes at both ends.
const NARROW: f64 = 0.04;
/// Speeds of the loci on each side of the band and within it.
const SPEEDS: usize = 20;

impl RootLoci {
    /// Follows the pair of a band from one width before it to one after it, inside a range.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn new(
        model: &SpectralModel,
        band: &Instability,
        range: (f64, f64),
    ) -> Result<Option<Self>, SpectrumError> {
        let Some(low) = model.low_model() else {
            return Ok(None);
        };
        let width = band.to - band.from;
        let (from, to) = (
            (band.from - width).max(range.0),
            (band.to + width).min(range.1),
        );
        let low = if to - from <= NARROW * to {
            low.between([&low.modes(from)?, &low.modes(to)?])
        } else {
            low
        };
        let mut loci = RootLoci {
            speeds: Vec::new(),
            names: meeting_modes(model, band.from, band.frequency)?,
            paths: [Vec::new(), Vec::new()],
        };
        for (start, end) in [(from, band.from), (band.from, band.to), (band.to, to)] {
            for k in 0..SPEEDS {
                // Denser towards the edges of the band, where the paths turn.
                let share =
                    0.5 * (1.0 - (std::f64::consts::PI * (k as f64 + 0.5) / SPEEDS as f64).cos());
                let speed = start + share * (end - start);
                if let Some(pair) = pair(&low.modes(speed)?.modes, band.frequency) {
                    loci.speeds.push(speed);
                    for (path, mode) in loci.paths.iter_mut().zip(pair) {
                        path.push((mode.lambda, mode.krein_sign()));
                    }
                }
            }
        }
        Ok(Some(loci))
    }
}

/// The growing and the decaying mode, or the + and the − mode, next to a frequency.
fn pair(modes: &[Mode], frequency: f64) -> Option<[&Mode; 2]> {
    let nearest = |kinds: [ModeKind; 2]| {
        kinds.map(|kind| {
            let distance = |m: &&Mode| (m.frequency_rad_per_s() - frequency).abs();
            let same = modes.iter().filter(|m| m.kind == kind);
            same.min_by(|x, y| distance(x).total_cmp(&distance(y)))
        })
    };
    let apart = nearest([ModeKind::Positive, ModeKind::Negative]);
    let merged = nearest([ModeKind::Flutter, ModeKind::Decaying]);
    let off = |pair: &[Option<&Mode>; 2]| match pair {
        [Some(x), Some(y)] => (0.5 * (x.lambda.im + y.lambda.im) - frequency).abs(),
        _ => f64::INFINITY,
    };
    let chosen = if off(&merged) <= off(&apart) {
        merged
    } else {
        apart
    };
    Some([chosen[0]?, chosen[1]?])
}
