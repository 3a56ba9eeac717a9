//! Search for the bands of an undamped blade, with their checks.

use rayon::prelude::*;

use super::checked_modes::CheckedModes;
use super::extent::Extent;
use super::growing::growing;
use super::proof::Proof;
use crate::model::scene::{Accuracy, SpeedRange};
use crate::modes::branches::ModesAt;
use crate::modes::{SpectralModel, SpectrumError};
use crate::stability::band::{BandEnd, Instability};
use crate::stability::certificate::{Certificate, GROWTH_FLOOR, contradictions};
use crate::stability::instability_kind::InstabilityKind;
use crate::stability::mode_counts::{MiscountedModes, ModeCounts};
use crate::stability::pieces::{Piece, Search};
use crate::stability::sample::{Plane, Sample};
use crate::stability::search_result::{Found, FoundBands};

/// Depth of the checks of a list of bands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Depth {
    /// Krein index and bands at every speed, and counts on the full model at a few: for studies of many saws, and for charts that
    /// are wanted soon.
    Counts,
    /// The checks of `Counts`, further counts beside and within every band, and a proof for the speeds between.
    Proof,
}

impl Depth {
    /// Depth for a chart of a named accuracy: `draft` does without the proof.
    pub fn of(accuracy: Accuracy) -> Self {
        match accuracy {
            Accuracy::Draft => Depth::Counts,
            Accuracy::Design | Accuracy::Reference => Depth::Proof,
        }
    }
}

/// Relative error allowed for the square of an eigenvalue that may coalesce, between two speeds of the search.
const SQUARE_TOLERANCE: f64 = 1e-3;

/// Relative error allowed for a growth rate between two speeds of the search.
const GROWTH_TOLERANCE: f64 = 0.05;
/// Share of |ω| + Ω below which a growth rate is rounding.
const GROWTH_NOISE: f64 = 1e-7;
/// Number of evenly spaced speeds of the search at which modes are counted on the full model.
const ANCHORS: usize = 12;
/// Number of further speeds of counts, drawn at random from a fixed seed, so that they do not depend on the
/// rules of the search.
const DRAWN: u64 = 8;
/// [`ANCHORS`] if a count needs a dense factorization, which takes a hundred times as long as one by blocks.
const DENSE_ANCHORS: usize = 3;
/// Distance from the edges of a band at which its modes are counted, as a share of the band's width.
const BESIDE: f64 = 0.02;
/// Smallest such distance, as a share of the speed of the edge.
const LEAST_BESIDE: f64 = 6e-5;
/// Relative distance from a critical speed below which eigenvalues next to zero are rounding.
const NEXT_TO_CRITICAL: f64 = 1e-4;

/// Result of a search.
pub struct Searched {
    /// Bands and certificate.
    pub found: FoundBands,
    /// Modes of the model at the speeds of the search.
    pub solved: Vec<ModesAt>,
    /// Pieces between these speeds; empty for a free blade, too.
    pub pieces: Vec<Piece>,
}

/// Finds every band within a range by a search between the first and the last of `speeds`, which should cover
/// the range from the first critical speed on.
pub fn searched(
    model: &SpectralModel,
    range: SpeedRange,
    speeds: &[f64],
    depth: Depth,
    extent: Extent,
) -> Result<Searched, SpectrumError> {
    let checked = CheckedModes::new(model, extent);
    let Some(full) = ModeCounts::new(model) else {
        checked.at_all(speeds)?;
        // A free blade has no counts. Its waves are uncoupled, so they cross and never coalesce.
        let certificate = Certificate {
            unproven_rad_per_s: Some(Vec::new()),
            ..checked.certificate()
        };
        let found = FoundBands {
            instabilities: Vec::new(),
            certificate,
        };
        return Ok(Searched {
            found,
            solved: checked.into_solved(),
            pieces: Vec::new(),
        });
    };
    let pieces = searched_pieces(&checked, speeds)?;
    let critical: Vec<f64> = model.critical.iter().map(|c| c.speed_rad_per_s).collect();
    let mut samples = checked.samples();
    samples.drain(..last_below(&critical, samples.iter().map(|at| at.speed_rad_per_s)));
    let found: Vec<Found> = growing(&checked, &pieces, &critical)?
        .par_iter()
        .map(|stretch| stretch.found(&checked, range))
        .collect::<Result<_, _>>()?;
    let (mut bands, mut within) = (Vec::new(), Vec::new());
    for Found {
        whole,
        within: part,
    } in found
    {
        bands.push(whole);
        within.extend(part);
    }
    let by_onset = |x: &Instability, y: &Instability| x.from_rad_per_s.total_cmp(&y.from_rad_per_s);
    bands.sort_by(by_onset);
    within.sort_by(by_onset);
    let checks = Checks {
        checked: &checked,
        full: &full,
        pieces: &pieces,
        bands: &bands,
        samples: &samples,
    };
    let mut certificate = checks.certificate(depth)?;
    let ends = bands.iter().flat_map(|band| &band.ends);
    let interpolated = ends.filter(|end| matches!(end, BandEnd::Interpolated));
    certificate.interpolated += interpolated.count();
    if let Some(unproven) = &mut certificate.unproven_rad_per_s {
        unproven.extend(unsearched(model, range, speeds));
        *unproven = clipped(unproven, range);
    }
    Ok(Searched {
        found: FoundBands {
            instabilities: within,
            certificate,
        },
        solved: checked.into_solved(),
        pieces,
    })
}

/// Index of the last of ascending speeds below the first critical one. Below it nothing can be unstable: K(Ω) is positive
/// definite, no wave is reflected, and the Krein index is zero.
pub fn last_below(critical: &[f64], speeds: impl Iterator<Item = f64>) -> usize {
    let lowest = critical.first().copied().unwrap_or(f64::INFINITY);
    let below = speeds.take_while(|speed| *speed < lowest).count();
    below.saturating_sub(1)
}

/// Pieces of a search between the first and the last of some speeds.
fn searched_pieces(
    checked: &CheckedModes<'_>,
    speeds: &[f64],
) -> Result<Vec<Piece>, SpectrumError> {
    let top_rad_per_s = checked.top_rad_per_s();
    let last = speeds.last().copied().unwrap_or(0.0);
    let search = Search {
        plane: Plane::Squares,
        top_rad_per_s,
        tolerance: SQUARE_TOLERANCE,
        definite_tolerance: checked.extent.definite_tolerance(),
        growth_tolerance: GROWTH_TOLERANCE,
        noise_per_s: GROWTH_NOISE * (top_rad_per_s + last),
        solve: &|speed| checked.sample(speed),
    };
    search.pieces(speeds)
}

/// Parts of a range outside the speeds of a search, except below the first critical speed, where nothing is
/// unstable. A part that ends before it begins is empty.
fn unsearched(
    model: &SpectralModel,
    range: SpeedRange,
    speeds: &[f64],
) -> impl Iterator<Item = SpeedRange> + use<> {
    let lowest = model
        .critical
        .first()
        .map_or(f64::INFINITY, |c| c.speed_rad_per_s);
    let (first, last) = match speeds {
        [first, .., last] => (*first, *last),
        [only] => (*only, *only),
        [] => (f64::INFINITY, f64::NEG_INFINITY),
    };
    [
        SpeedRange::new(lowest, first),
        SpeedRange::new(last, f64::INFINITY),
    ]
    .map(|outside| outside.within(range))
    .into_iter()
}

/// Intervals clipped to a range, ascending and merged where they touch.
fn clipped(stretches: &[SpeedRange], range: SpeedRange) -> Vec<SpeedRange> {
    let mut clipped: Vec<SpeedRange> = stretches
        .iter()
        .map(|stretch| stretch.within(range))
        .filter(|stretch| stretch.width() > 0.0)
        .collect();
    clipped.sort_by(|x, y| x.from_rad_per_s.total_cmp(&y.from_rad_per_s));
    clipped.dedup_by(|next, last| {
        let touches = next.from_rad_per_s <= last.to_rad_per_s;
        if touches {
            last.to_rad_per_s = last.to_rad_per_s.max(next.to_rad_per_s);
        }
        touches
    });
    clipped
}

/// A list of bands with the data for the checks of it.
pub struct Checks<'a> {
    pub checked: &'a CheckedModes<'a>,
    pub full: &'a ModeCounts<'a>,
    pub pieces: &'a [Piece],
    pub bands: &'a [Instability],
    pub samples: &'a [Sample],
}

impl Checks<'_> {
    /// Results of the checks.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn certificate(&self, depth: Depth) -> Result<Certificate, SpectrumError> {
        let mut contradicted = contradictions(self.bands, self.samples, GROWTH_FLOOR);
        let mut miscounts = self.at_anchors()?;
        let mut unproven = None;
        let gave_up = self.checked.is_exhausted();
        let height = self.checked.height_rad_per_s();
        if depth == Depth::Proof {
            let extra = self.checked.at_all(&self.chosen_speeds())?;
            contradicted.extend(contradictions(self.bands, &extra, GROWTH_FLOOR));
            if !self.full.is_dense() {
                miscounts.extend(
                    self.full
                        .miscounts(&extra.iter().collect::<Vec<_>>(), height)?,
                );
            }
            let proof = Proof {
                full: self.full,
                checked: self.checked,
                pieces: self.pieces,
                bands: self.bands,
            };
            unproven = Some(proof.unproven(self.samples)?);
        }
        Ok(Certificate {
            mismatches: contradicted,
            miscounts,
            full_basis_counts: self.full.counted(),
            unproven_rad_per_s: unproven,
            gave_up,
            ..self.checked.certificate()
        })
    }

    /// Contradictions of counts at some speeds of the search.
    fn at_anchors(&self) -> Result<Vec<MiscountedModes>, SpectrumError> {
        let samples = self.samples;
        let count = if self.full.is_dense() {
            DENSE_ANCHORS
        } else {
            ANCHORS
        };
        let (Some(first), Some(last)) = (samples.first(), samples.last()) else {
            return Ok(Vec::new());
        };
        let (from, to) = (first.speed_rad_per_s, last.speed_rad_per_s);
        let at = |k: usize| {
            let speed = from + (to - from) * (k as f64 + 1.0) / count as f64;
            let place = samples.partition_point(|s| s.speed_rad_per_s < speed);
            place.min(samples.len() - 1)
        };
        let mut places: Vec<usize> = (0..count).map(at).collect();
        places.dedup();
        let anchors: Vec<&Sample> = places.into_iter().map(|k| &samples[k]).collect();
        self.full
            .miscounts(&anchors, self.checked.height_rad_per_s())
    }

    /// Speeds on both sides and at the peak of every flutter band, and random speeds.
    fn chosen_speeds(&self) -> Vec<f64> {
        let samples = self.samples;
        let (Some(first), Some(last)) = (samples.first(), samples.last()) else {
            return Vec::new();
        };
        let (from, to) = (first.speed_rad_per_s, last.speed_rad_per_s);
        let drawn = (0..DRAWN).map(|k| from + drawn_share(k) * (to - from));
        let flutter = self
            .bands
            .iter()
            .filter(|b| b.kind == InstabilityKind::Flutter);
        let beside = flutter.flat_map(|band| {
            let (begin, end) = (band.from_rad_per_s, band.to_rad_per_s);
            let away = (BESIDE * (end - begin)).max(LEAST_BESIDE * end);
            [begin - away, band.peak_rad_per_s, end + away]
        });
        let mut speeds: Vec<f64> = beside.chain(drawn).collect();
        let is_reflected = |speed: f64| self.full.negative_stiffness(speed) > 0;
        let spans = |speed: f64| {
            let away = NEXT_TO_CRITICAL * speed;
            self.checked.spans_critical(speed - away, speed + away)
        };
        speeds
            .retain(|speed| (from..=to).contains(speed) && is_reflected(*speed) && !spans(*speed));
        speeds
    }
}

/// Number k of a pseudo-random sequence between 0 and 1 that is the same on every machine (Steele, Lea and
/// Flood, OOPSLA 2014).
pub fn drawn_share(k: u64) -> f64 {
    let mut z = (k + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

#[cfg(test)]
mod tests;
