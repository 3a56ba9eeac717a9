//! Signature of an undamped blade at any speed, checked by its Krein index.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use faer::c64;

use super::certificate::Certificate;
use super::partition::{BESIDES, Sample};
use super::signature::{Signature, SignedMode};
use crate::model::tuning::Tuned;
use crate::modes::{
    DoubleEigenvalue, Mode, ModeKind, SearchModel, SpectralModel, SpectrumError, krein_index,
    smallest,
};

/// Relative distance of the search from critical speeds: λ² passes through zero there and is accurate only to
/// 1e-15 of the stiffness.
pub const CRITICAL_GAP: Tuned = Tuned::new("stability/evaluator::CRITICAL_GAP", 5e-6);
/// Critical speeds at a smaller relative distance are passed in one step of the search. The divergence
/// between them grows by less than 0.01 1/s; the inertia of the stiffness shows that it exists.
pub const CRITICAL_GROUP: f64 = 2e-5;
/// Largest number of speeds in a search, twenty times as many as usual saws need. It limits the time if modes
/// cannot be distinguished.
const MOST_SPEEDS: usize = 20_000;

/// Largest number of solves on a full model of at most [`USUAL_ORDER`] functions. Each takes as long as a whole
/// sweep on a reduced model; the saws of the tests need a tenth of this number.
const MOST_FULL_SOLVES: f64 = 200.0;
/// Order of the full model above which fewer solves are allowed, because the time of a solve grows with the
/// cube of the order. On the largest basis, where a solve takes minutes, none is allowed.
const USUAL_ORDER: f64 = 300.0;

/// Number of solves allowed on the full model.
fn most_full_solves(model: &SpectralModel) -> usize {
    let smaller = (USUAL_ORDER / model.plate.degrees_of_freedom() as f64).min(1.0);
    (MOST_FULL_SOLVES * smaller.powi(3)) as usize
}

/// A second search, on the full model, needs more allowed solves than this.
const LEAST_FOR_A_SEARCH: usize = 25;
/// If the Krein index contradicts the modes at a speed, it is compared again at this relative distance. At a
/// coalescence the Krein signs of the two modes are rounding: for a pad of 100 N/m, with bands of a width of
/// 2e-6 of the speed, this occurred within 1e-9 of the speed of the coalescence.
const BESIDE_COALESCENCE: f64 = 1e-7;

/// If the growth rates by the projection and by the states differ by more than this share, they belong to
/// different modes: the states are accurate to 1e-5 of the height.
const SAME_GROWTH: f64 = 0.01;
/// Number of speeds at which a search on the full model solves it; between two of them the search uses their
/// modes.
const ANCHORS: usize = 13;

/// Numbers of speeds and solves, and speeds at which the Krein index contradicts the modes.
#[derive(Debug, Default)]
struct Tally {
    checked: AtomicUsize,
    solved_in_full: AtomicUsize,
    violations: Mutex<Vec<f64>>,
}

/// Evaluates signatures, checks the Krein index of each, and counts them.
pub struct SignatureEvaluator<'a> {
    model: &'a SpectralModel,
    /// Projections of the search; without them every speed is solved by the model.
    low: Option<SearchModel<'a>>,
    tally: Tally,
    /// Signatures at the speeds of the search.
    seen: Mutex<Vec<Signature>>,
    /// Whether this search repeats one on an insufficient reduced model; the number of its solves is limited.
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
            seen: Mutex::default(),
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

    /// Results of the checks so far.
    pub fn certificate(&self) -> Certificate {
        let mut violations = self
            .tally
            .violations
            .lock()
            .map_or_else(|poisoned| poisoned.into_inner().clone(), |v| v.clone());
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

    /// Computes the signature at a speed. If it contradicts the Krein index, the modes are computed again on
    /// the projection and on the full model, and compared beside the speed; a remaining contradiction is a
    /// violation.
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
        let modes = if before < most_full_solves(self.model) {
            self.model.full_modes(speed_rad_per_s)?
        } else {
            reduced
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

    /// Signature by the smallest model, neither counted nor checked, for proposals that a proof checks.
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
        let modes = self.modes(speed_rad_per_s)?;
        if let Ok(mut seen) = self.seen.lock() {
            seen.push(Signature::new(speed_rad_per_s, modes.iter()));
        }
        let squares = self.squares(&modes);
        Ok(Some(Sample::of_squares(speed_rad_per_s, squares)))
    }

    /// λ² with slope and Krein sign, for the modes up to the height of the search and [`BESIDES`] above.
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
        let mut all = self
            .seen
            .lock()
            .map_or_else(|_| Vec::new(), |seen| seen.clone());
        all.sort_by(|x, y| x.speed_rad_per_s.total_cmp(&y.speed_rad_per_s));
        all
    }

    /// The signature at a sampled speed.
    fn seen_at(&self, speed_rad_per_s: f64) -> Option<Signature> {
        let seen = self.seen.lock().ok()?;
        seen.iter()
            .find(|signature| signature.speed_rad_per_s == speed_rad_per_s)
            .cloned()
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
        let signature = match self.seen_at(speed_rad_per_s) {
            Some(known) => known,
            None => self.at(speed_rad_per_s)?,
        };
        let away = |mode: &SignedMode| (mode.lambda - expected).norm();
        Ok(smallest(signature.quadruples, away))
    }

    /// Frequency up to which signatures are complete.
    pub fn height_rad_per_s(&self) -> f64 {
        self.low.as_ref().map_or(
            self.model.complete_to_rad_per_s,
            SearchModel::height_rad_per_s,
        )
    }

    /// The eigenvalue of the projection next to an expected one, and dλ/dΩ. `None` if it is another one or none.
    pub fn next_to(&self, speed_rad_per_s: f64, expected: c64) -> Option<(c64, c64)> {
        self.low.as_ref()?.next_to(speed_rad_per_s, expected)
    }

    /// The coalescence of two modes of the projection next to an expected one.
    pub fn double_eigenvalue(
        &self,
        speed_rad_per_s: f64,
        expected: c64,
    ) -> Option<DoubleEigenvalue> {
        self.low
            .as_ref()?
            .double_eigenvalue(speed_rad_per_s, expected)
    }

    /// Largest growth rate of a divergent mode, in 1/s, without a check by the Krein index, which rounding
    /// changes next to a critical speed; 0 without such a mode.
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

    /// Growth rate of a divergent mode, in 1/s, by the projection, from the approximate rate by the states.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn divergence_next_to(
        &self,
        speed_rad_per_s: f64,
        expected_per_s: f64,
    ) -> Result<f64, SpectrumError> {
        let found = self.next_to(speed_rad_per_s, c64::new(expected_per_s, 0.0));
        let growth = found
            .map(|(lambda, _)| lambda.re)
            .filter(|g| (g - expected_per_s).abs() <= SAME_GROWTH * expected_per_s);
        growth.map_or_else(|| self.divergence(speed_rad_per_s), Ok)
    }

    /// Whether a critical speed lies between two speeds.
    pub fn spans_critical(&self, from_rad_per_s: f64, to_rad_per_s: f64) -> bool {
        let below = |speed| self.model.negative_stiffness_directions(speed);
        below(from_rad_per_s) != below(to_rad_per_s)
    }

    /// Whether the Krein index of modes equals the number of negative eigenvalues of the stiffness, which a
    /// separate symmetric eigenproblem on the full model gives.
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
