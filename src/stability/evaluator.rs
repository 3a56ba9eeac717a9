//! Signature of an undamped blade at any speed, checked by its Krein index.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use faer::c64;

use super::certificate::Certificate;
use super::partition::Sample;
use super::seen::Seen;
use super::signature::{Signature, SignedMode};
use crate::spectrum::{
    Mode, ModeKind, ModePair, SearchModel, SpectralModel, SpectrumError, krein_index,
};
use crate::tuned::Tuned;

/// Relative distance kept from a critical speed: λ² passes through zero there and is accurate only to 1e-15
/// of the stiffness.
pub const CRITICAL_GAP: Tuned = Tuned::new("stability/evaluator::CRITICAL_GAP", 5e-6);
/// Critical speeds closer than this are passed in one step. The divergence between them grows by less than
/// 0.01 1/s; the inertia shows that it exists.
pub const CRITICAL_GROUP: f64 = 2e-5;
/// Largest number of speeds in a search: twenty times what a saw needs. It limits the time if modes cannot be
/// distinguished.
const MOST_SPEEDS: usize = 20_000;

/// Largest number of solves on a full model of at most [`USUAL_ORDER`] functions. Each takes as long as a
/// whole sweep on a reduced model; the saws of the tests need a tenth of this.
const MOST_FULL_SOLVES: f64 = 200.0;
/// The time of a solve grows with the cube of the order. Above this order fewer solves are allowed, and none
/// on the largest basis, where one would take minutes.
const USUAL_ORDER: f64 = 300.0;

/// Number of solves allowed on the full model.
fn most_full_solves(model: &SpectralModel) -> usize {
    let smaller = (USUAL_ORDER / model.plate.degrees_of_freedom() as f64).min(1.0);
    (MOST_FULL_SOLVES * smaller.powi(3)) as usize
}

/// Least number of allowed solves for a search on the full model.
const LEAST_FOR_A_SEARCH: usize = 25;
/// Relative distance from a speed at which the Krein index contradicts the modes to the speeds at which it is
/// computed again. At a coalescence the Krein signs of the two modes are rounding: squares of frequencies
/// that are accurate to 1e-15 of the highest differ by this little within 1e-9 of it (a pad of 100 N/m, bands
/// of 2e-6 of the speed).
const BESIDE_COALESCENCE: f64 = 1e-7;

/// Speeds at which a search solves the full model; between two of them it uses their modes.
const ANCHORS: usize = 13;

/// Speeds at which the Krein index was compared and at which it did not match.
#[derive(Debug, Default)]
struct Tally {
    checked: AtomicUsize,
    solved_in_full: AtomicUsize,
    violations: Mutex<Vec<f64>>,
}

/// Number of modes above the highest accurate frequency among which a search finds a gap to end in.
const BESIDES: usize = 8;

/// Evaluates signatures, checks the Krein index of each, and counts them.
pub struct SignatureEvaluator<'a> {
    model: &'a SpectralModel,
    low: Option<SearchModel<'a>>,
    tally: Tally,
    seen: Seen,
    /// Whether its solves replace an insufficient reduced model and are limited in number.
    is_second_search: bool,
}

impl<'a> SignatureEvaluator<'a> {
    /// An evaluator for an undamped blade between the first and the last speed given.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn new(model: &'a SpectralModel, speeds: &[f64]) -> Result<Self, SpectrumError> {
        let low = match SearchModel::new(model) {
            Some(low) => Some(low),
            None => SearchModel::of_full_model(model, &anchors(speeds))?,
        };
        Ok(Self::of(model, low))
    }

    /// Whether the full model is small enough for a solve at every speed of a search.
    pub fn has_full_model_within_reach(model: &SpectralModel) -> bool {
        most_full_solves(model) > LEAST_FOR_A_SEARCH
    }

    /// An evaluator that uses the modes of the full model instead of the projections: slow.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn on_full_model(model: &'a SpectralModel, speeds: &[f64]) -> Result<Self, SpectrumError> {
        let low = SearchModel::of_full_model(model, &anchors(speeds))?;
        Ok(SignatureEvaluator {
            is_second_search: true,
            ..Self::of(model, low)
        })
    }

    fn of(model: &'a SpectralModel, low: Option<SearchModel<'a>>) -> Self {
        SignatureEvaluator {
            model,
            low,
            tally: Tally::default(),
            seen: Seen::default(),
            is_second_search: false,
        }
    }

    /// The given ascending speeds and the boundaries between intervals of the model.
    pub fn with_ends_of_intervals(&self, speeds: &[f64]) -> Vec<f64> {
        let mut all = speeds.to_vec();
        if let [first, .., last] = speeds {
            let ends = self.low.iter().flat_map(SearchModel::ends_rad_per_s);
            all.extend(ends.filter(|speed| first < speed && speed < last));
        }
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    }

    /// Checks of the speeds so far.
    pub fn certificate(&self) -> Certificate {
        let violations = self.tally.violations.lock();
        let mut violations =
            violations.map_or_else(|poisoned| poisoned.into_inner().clone(), |v| v.clone());
        violations.sort_by(f64::total_cmp);
        Certificate {
            speeds_checked: self.tally.checked.load(Ordering::Relaxed),
            violations_rad_per_s: violations,
            gave_up: self.is_exhausted(),
            ..Certificate::default()
        }
    }

    /// Whether the allowed number of speeds is used up.
    pub fn is_exhausted(&self) -> bool {
        self.tally.checked.load(Ordering::Relaxed) >= MOST_SPEEDS
            || self.tally.solved_in_full.load(Ordering::Relaxed) > most_full_solves(self.model)
    }

    /// Computes the signature at a speed. If it contradicts the Krein index, it is computed again on the full
    /// model and the index beside it; a remaining contradiction is a violation.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn at(&self, speed_rad_per_s: f64) -> Result<Signature, SpectrumError> {
        let modes = self.modes(speed_rad_per_s)?;
        Ok(Signature::new(speed_rad_per_s, modes.iter()))
    }

    /// Modes of the signature at a speed.
    fn modes(&self, speed_rad_per_s: f64) -> Result<Vec<Mode>, SpectrumError> {
        self.tally.checked.fetch_add(1, Ordering::Relaxed);
        if let Some(low) = &self.low {
            let modes = low.modes(speed_rad_per_s)?;
            if self.match_index(speed_rad_per_s, &modes) {
                return Ok(modes);
            }
        }
        if self.is_second_search {
            self.tally.solved_in_full.fetch_add(1, Ordering::Relaxed);
        }
        let reduced = self.projected_modes(speed_rad_per_s)?;
        if self.match_index(speed_rad_per_s, &reduced) {
            return Ok(reduced);
        }
        let before = self.tally.solved_in_full.fetch_add(1, Ordering::Relaxed);
        let modes = match before < most_full_solves(self.model) {
            true => self.model.full_modes(speed_rad_per_s)?,
            false => reduced,
        };
        if self.match_index(speed_rad_per_s, &modes) {
            return Ok(modes);
        }
        for share in [1.0 - BESIDE_COALESCENCE, 1.0 + BESIDE_COALESCENCE] {
            let beside = share * speed_rad_per_s;
            if self.match_index(beside, &self.projected_modes(beside)?) {
                return Ok(modes);
            }
        }
        if let Ok(mut violations) = self.tally.violations.lock() {
            violations.push(speed_rad_per_s);
        }
        Ok(modes)
    }

    /// Modes of the projections at a speed.
    fn projected_modes(&self, speed_rad_per_s: f64) -> Result<Vec<Mode>, SpectrumError> {
        match &self.low {
            Some(low) => low.projected_modes(speed_rad_per_s),
            None => self.model.all_modes(speed_rad_per_s),
        }
    }

    /// Signature of the smallest model, neither counted nor checked: a guess that other means prove or
    /// refute.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn guess_at(&self, speed_rad_per_s: f64) -> Result<Signature, SpectrumError> {
        let modes = match &self.low {
            Some(low) => low.modes(speed_rad_per_s)?,
            None => self.model.all_modes(speed_rad_per_s)?,
        };
        Ok(Signature::new(speed_rad_per_s, modes.iter()))
    }

    /// Squares of the eigenvalues at a speed, for a search by pieces. `None` next to a critical speed, where
    /// their signs are rounding, and once the allowed number of speeds is used up.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn sample(&self, speed_rad_per_s: f64) -> Result<Option<Sample>, SpectrumError> {
        let away = 0.999 * CRITICAL_GAP.get() * speed_rad_per_s;
        if self.is_exhausted()
            || self.spans_critical(speed_rad_per_s - away, speed_rad_per_s + away)
        {
            return Ok(None);
        }
        let mut modes = self.modes(speed_rad_per_s)?;
        let signature = Signature::new(speed_rad_per_s, modes.iter());
        let sample = Sample::of_squares(speed_rad_per_s, self.squares(&modes));
        modes.retain(|mode| matches!(mode.kind, ModeKind::Flutter | ModeKind::Decaying));
        self.seen.add(signature, modes);
        Ok(Some(sample))
    }

    /// λ² with slope and Krein sign for every mode up to a few above the highest frequency.
    fn squares(&self, modes: &[Mode]) -> Vec<((c64, c64), i8)> {
        let mut followed: Vec<&Mode> = modes.iter().collect();
        followed.sort_by(|x, y| x.lambda.im.total_cmp(&y.lambda.im));
        let height = self.height_rad_per_s();
        let below = followed.partition_point(|mode| mode.lambda.im <= height);
        followed.truncate(below + BESIDES);
        let mut squares = Vec::new();
        for mode in followed {
            let slope = match mode.kind {
                ModeKind::Positive | ModeKind::Negative => c64::new(0.0, mode.frequency_slope),
                ModeKind::Flutter | ModeKind::Divergent => mode.growth_slope,
                ModeKind::Decaying | ModeKind::Rigid | ModeKind::Damped => continue,
            };
            let (square, slope) = (mode.lambda * mode.lambda, 2.0 * mode.lambda * slope);
            if mode.kind == ModeKind::Flutter {
                squares.push(((square, slope), 0));
                squares.push(((square.conj(), slope.conj()), 0));
            } else {
                let real = |z: c64| c64::new(z.re, 0.0);
                squares.push(((real(square), real(slope)), mode.krein_sign()));
            }
        }
        squares
    }

    /// Signatures at the sampled speeds, ascending.
    pub fn signatures(&self) -> Vec<Signature> {
        self.seen.signatures()
    }

    /// Quadruple at a speed next to an expected eigenvalue.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn quadruple(
        &self,
        speed_rad_per_s: f64,
        expected: c64,
    ) -> Result<Option<SignedMode>, SpectrumError> {
        let signature = match self.seen.signature(speed_rad_per_s) {
            Some(known) => known,
            None => self.at(speed_rad_per_s)?,
        };
        let away = |mode: &&SignedMode| (mode.lambda - expected).norm();
        let quadruples = signature.quadruples.iter();
        let nearest = quadruples.min_by(|x, y| away(x).total_cmp(&away(y)));
        Ok(nearest.copied())
    }

    /// Frequency up to which signatures are complete.
    pub fn height_rad_per_s(&self) -> f64 {
        self.low.as_ref().map_or(
            self.model.complete_to_rad_per_s,
            SearchModel::height_rad_per_s,
        )
    }

    /// The growing and the decaying mode of a quadruple at a speed, accurate to rounding.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn pair(
        &self,
        speed_rad_per_s: f64,
        growing: c64,
    ) -> Result<Option<ModePair>, SpectrumError> {
        let Some(low) = &self.low else {
            return Ok(None);
        };
        let lambdas = [growing, -growing.conj()];
        let seen = self.seen.nearest(speed_rad_per_s, lambdas);
        match seen.filter(|modes| low.has(speed_rad_per_s, modes)) {
            Some(modes) => Ok(low.pair_of(speed_rad_per_s, &modes)),
            None => low.pair(speed_rad_per_s, lambdas),
        }
    }

    /// Follows a pair to another speed.
    pub fn moved(&self, pair: &ModePair, speed_rad_per_s: f64) -> Option<ModePair> {
        self.low.as_ref()?.moved(pair, speed_rad_per_s)
    }

    /// Largest growth of a divergent mode next to a critical speed, where rounded eigenvalues do not give the
    /// Krein index.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn divergence(&self, speed_rad_per_s: f64) -> Result<f64, SpectrumError> {
        let modes = match &self.low {
            Some(low) => low.projected_modes(speed_rad_per_s)?,
            None => return Ok(0.0),
        };
        Ok(Signature::new(speed_rad_per_s, modes.iter())
            .divergence()
            .map_or(0.0, |mode| mode.lambda.re))
    }

    /// The growth of a divergent mode that the states of an interval give approximately, without their error.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn divergence_next_to(
        &self,
        speed_rad_per_s: f64,
        expected_per_s: f64,
    ) -> Result<f64, SpectrumError> {
        let low = self.low.as_ref();
        let found = low.and_then(|low| low.growth_next_to(speed_rad_per_s, expected_per_s));
        found.map_or_else(|| self.divergence(speed_rad_per_s), Ok)
    }

    /// Whether a critical speed lies between two speeds.
    pub fn spans_critical(&self, from_rad_per_s: f64, to_rad_per_s: f64) -> bool {
        let below = |speed| self.model.negative_stiffness_directions(speed);
        below(from_rad_per_s) != below(to_rad_per_s)
    }

    /// Compares the spectrum with the inertia of the stiffness, which comes from a separate symmetric
    /// eigenproblem on the full model.
    fn match_index(&self, speed_rad_per_s: f64, modes: &[Mode]) -> bool {
        krein_index(modes) == self.model.negative_stiffness_directions(speed_rad_per_s)
    }

    /// Signatures at many speeds, in parallel.
    ///
    /// # Errors
    /// [`SpectrumError`] of the lowest speed that fails.
    pub fn at_all(&self, speeds: &[f64]) -> Result<Vec<Signature>, SpectrumError> {
        let signatures: Vec<_> = speeds.par_iter().map(|&speed| self.at(speed)).collect();
        signatures.into_iter().collect()
    }
}

/// The first and the last of ascending speeds and some about evenly spaced between.
fn anchors(speeds: &[f64]) -> Vec<f64> {
    let (Some(&first), Some(&last)) = (speeds.first(), speeds.last()) else {
        return Vec::new();
    };
    let spacing = (last - first) / ANCHORS as f64;
    let mut chosen = vec![first];
    for &speed in speeds {
        let latest = chosen[chosen.len() - 1];
        if speed - latest >= spacing && last - speed >= 0.5 * spacing {
            chosen.push(speed);
        }
    }
    if last > first {
        chosen.push(last);
    }
    chosen
}
