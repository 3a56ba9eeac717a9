//! The signature of an undamped blade at any speed, held against its Krein index.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use faer::c64;

use super::certificate::Certificate;
use super::signature::Signature;
use crate::spectrum::{KnownStates, ModePair, ReflectedModel, SpectralModel, SpectrumError};
use crate::tuned::Tuned;

/// Relative distance kept from a critical speed: λ² passes through zero there, and is
/// known to 1e-15 of the stiffness only.
pub const CRITICAL_GAP: Tuned = Tuned::new("stability/evaluator::CRITICAL_GAP", 5e-6);
/// Critical speeds closer than this are passed in one step. The divergence between them
/// grows by less than a hundredth of 1/s; that it is there follows from the inertia.
pub const CRITICAL_GROUP: f64 = 2e-5;
/// Speeds that a search may look at: twenty times what a saw needs. It bounds the time
/// where modes cannot be told apart.
const MOST_SPEEDS: usize = 20_000;

/// Speeds that may be solved on a whole basis of at most [`USUAL_ORDER`] functions, each in the time of a whole sweep on
/// a reduced model: more than any saw of the tests needs by ten times.
const MOST_FULL_SOLVES: f64 = 200.0;
/// The time of one grows with the cube of the order: beyond this fewer may be solved, and none of the largest basis, where one
/// would take minutes.
const USUAL_ORDER: f64 = 300.0;

/// Speeds that may be solved on the whole basis of a model.
fn most_full_solves(model: &SpectralModel) -> usize {
    let smaller = (USUAL_ORDER / model.plate.degrees_of_freedom() as f64).min(1.0);
    (MOST_FULL_SOLVES * smaller.powi(3)) as usize
}

/// A search on the whole basis begins with so many.
const LEAST_FOR_A_SEARCH: usize = 25;
/// Speeds at which the search solves the whole projected system; between two of them it goes
/// by their modes.
const ANCHORS: Tuned = Tuned::new("stability/evaluator::ANCHORS", 13.0);
/// Speeds of which the modes are known may be so many times further apart.
const LARGEST_GAP: f64 = 1.7;

/// Relative distance from a speed at which the Krein index contradicts the modes, to the speeds at which it is asked again.
/// At a coalescence the Krein signs of the two modes are rounding: squares of frequencies that are known to 1e-15 of the
/// highest differ by so little within 1e-9 of it (a pad of 100 N/m, bands of 2e-6 of the speed).
const BESIDE_COALESCENCE: f64 = 1e-7;

/// A refined growth further than this from what it was refined from is another mode's.
const SAME_GROWTH: f64 = 0.05;

/// Where the Krein index was compared, and where it did not match.
#[derive(Debug, Default)]
struct Tally {
    checked: AtomicUsize,
    solved_in_full: AtomicUsize,
    violations: Mutex<Vec<f64>>,
}

/// Evaluates signatures, checks the Krein index of each, and counts.
pub struct SignatureEvaluator<'a> {
    model: &'a SpectralModel,
    low: Option<ReflectedModel<'a>>,
    /// The same between neighbouring anchors, with the upper of both.
    pieces: Vec<(f64, ReflectedModel<'a>)>,
    tally: Tally,
    /// Whether `low` is the whole basis.
    is_whole: bool,
}

impl<'a> SignatureEvaluator<'a> {
    /// An evaluator on an undamped blade, for the speeds between the first and the last given.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn new(model: &'a SpectralModel, speeds: &[f64]) -> Result<Self, SpectrumError> {
        Self::of(model, model.reflected_model(), speeds, false)
    }

    /// Whether the whole basis of a model is small enough to be solved at every speed of a search.
    pub fn has_whole_basis_within_reach(model: &SpectralModel) -> bool {
        most_full_solves(model) > LEAST_FOR_A_SEARCH
    }

    /// The same by modes of the whole basis, whatever the projections of the model lack: slow.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn on_whole_basis(model: &'a SpectralModel, speeds: &[f64]) -> Result<Self, SpectrumError> {
        Self::of(model, model.whole_reflected_model(), speeds, true)
    }

    fn of(
        model: &'a SpectralModel,
        low: Option<ReflectedModel<'a>>,
        speeds: &[f64],
        is_whole: bool,
    ) -> Result<Self, SpectrumError> {
        let mut pieces = Vec::new();
        if let Some(low) = &low {
            pieces = anchor_states(low, speeds)?
                .par_windows(2)
                .map(|ends| (ends[1].0, low.between([&ends[0], &ends[1]])))
                .collect();
        }
        Ok(SignatureEvaluator {
            model,
            low,
            pieces,
            tally: Tally::default(),
            is_whole,
        })
    }

    /// The speeds checked so far.
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

    /// Whether it has looked at as many speeds as it may.
    pub fn is_exhausted(&self) -> bool {
        self.tally.checked.load(Ordering::Relaxed) >= MOST_SPEEDS
            || self.tally.solved_in_full.load(Ordering::Relaxed) > most_full_solves(self.model)
    }

    /// The signature at a speed. Where it contradicts the Krein index it is read
    /// again off the whole basis, and the index is asked beside it; what contradicts even then is a violation.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn at(&self, speed_rad_per_s: f64) -> Result<Signature, SpectrumError> {
        self.tally.checked.fetch_add(1, Ordering::Relaxed);
        if let Some(low) = self.near(speed_rad_per_s) {
            let modes = low.modes(speed_rad_per_s)?;
            let signature = Signature::new(speed_rad_per_s, modes.iter());
            if self.matches(&signature) {
                return Ok(signature);
            }
        }
        self.reduced_at(speed_rad_per_s)
    }

    /// The same from the smallest model, counted and checked nowhere: for a guess that is proven
    /// or refuted by other means.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn guess_at(&self, speed_rad_per_s: f64) -> Result<Signature, SpectrumError> {
        let modes = match self.near(speed_rad_per_s).or(self.low.as_ref()) {
            Some(low) => low.modes(speed_rad_per_s)?,
            None => self.model.all_modes(speed_rad_per_s)?,
        };
        Ok(Signature::new(speed_rad_per_s, modes.iter()))
    }

    /// The same from the whole reduced model, without the coarser models between anchors.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn exactly_at(&self, speed_rad_per_s: f64) -> Result<Signature, SpectrumError> {
        self.tally.checked.fetch_add(1, Ordering::Relaxed);
        self.reduced_at(speed_rad_per_s)
    }

    fn reduced_at(&self, speed_rad_per_s: f64) -> Result<Signature, SpectrumError> {
        if self.is_whole {
            self.tally.solved_in_full.fetch_add(1, Ordering::Relaxed);
        }
        let signature = self.reduced_signature(speed_rad_per_s)?;
        if self.matches(&signature) {
            return Ok(signature);
        }
        let before = self.tally.solved_in_full.fetch_add(1, Ordering::Relaxed);
        let signature = match before < most_full_solves(self.model) {
            true => {
                let modes = self.model.full_modes(speed_rad_per_s)?;
                Signature::new(speed_rad_per_s, modes.iter())
            }
            false => signature,
        };
        if self.matches(&signature) {
            return Ok(signature);
        }
        // Eigenvalues next to zero drown in the rounding of a large matrix before they do in
        // that of a small one.
        if let Some(low) = self.near(speed_rad_per_s) {
            let modes = low.modes(speed_rad_per_s)?;
            let coarse = Signature::new(speed_rad_per_s, modes.iter());
            if self.matches(&coarse) {
                return Ok(coarse);
            }
        }
        for share in [1.0 - BESIDE_COALESCENCE, 1.0 + BESIDE_COALESCENCE] {
            let beside = self.reduced_signature(share * speed_rad_per_s)?;
            if self.matches(&beside) {
                return Ok(signature);
            }
        }
        if let Ok(mut violations) = self.tally.violations.lock() {
            violations.push(speed_rad_per_s);
        }
        Ok(signature)
    }

    /// The signature by the reduced model of the whole range.
    fn reduced_signature(&self, speed_rad_per_s: f64) -> Result<Signature, SpectrumError> {
        let modes = match &self.low {
            Some(low) => low.modes(speed_rad_per_s)?,
            None => self.model.all_modes(speed_rad_per_s)?,
        };
        Ok(Signature::new(speed_rad_per_s, modes.iter()))
    }

    /// Frequency up to which signatures are complete.
    pub fn height_rad_per_s(&self) -> f64 {
        self.low.as_ref().map_or(
            self.model.complete_to_rad_per_s,
            ReflectedModel::height_rad_per_s,
        )
    }

    /// The smallest model for a speed.
    fn near(&self, speed_rad_per_s: f64) -> Option<&ReflectedModel<'a>> {
        let place = self.pieces.partition_point(|(to, _)| *to < speed_rad_per_s);
        self.pieces.get(place).map(|(_, low)| low)
    }

    /// The two modes of a speed next to two eigenvalues, to rounding.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn pair(
        &self,
        speed_rad_per_s: f64,
        lambdas: [c64; 2],
    ) -> Result<Option<ModePair>, SpectrumError> {
        match self.near(speed_rad_per_s).or(self.low.as_ref()) {
            Some(low) => low.pair(speed_rad_per_s, lambdas),
            None => Ok(None),
        }
    }

    /// A pair followed to another speed.
    pub fn moved(&self, pair: &ModePair, speed_rad_per_s: f64) -> Option<ModePair> {
        self.low.as_ref()?.moved(pair, speed_rad_per_s)
    }

    /// Growth of a divergent mode that is known nearly: it and its mirror image refined, in a tenth of the time of an
    /// eigenproblem. `None` where they are lost.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn refined_divergence(
        &self,
        speed_rad_per_s: f64,
        growth_per_s: f64,
    ) -> Result<Option<f64>, SpectrumError> {
        let lambdas = [growth_per_s, -growth_per_s].map(|real| c64::new(real, 0.0));
        let pair = self.pair(speed_rad_per_s, lambdas)?;
        let square = pair.map(|pair| -pair.squares(speed_rad_per_s)[1]);
        let refined = square.filter(|square| *square > 0.0).map(f64::sqrt);
        Ok(refined.filter(|refined| (refined / growth_per_s - 1.0).abs() < SAME_GROWTH))
    }

    /// Largest growth of a divergent mode next to a critical speed, where the Krein index
    /// cannot be read off rounded eigenvalues.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn divergence(&self, speed_rad_per_s: f64) -> Result<f64, SpectrumError> {
        let modes = match &self.low {
            Some(low) => low.modes(speed_rad_per_s)?,
            None => return Ok(0.0),
        };
        Ok(Signature::new(speed_rad_per_s, modes.iter())
            .divergence()
            .map_or(0.0, |mode| mode.lambda.re))
    }

    /// Whether a critical speed lies between two speeds.
    pub fn spans_critical(&self, from_rad_per_s: f64, to_rad_per_s: f64) -> bool {
        let below = |speed| self.model.negative_stiffness_directions(speed);
        below(from_rad_per_s) != below(to_rad_per_s)
    }

    /// Holds the spectrum against the inertia of the stiffness, which comes from
    /// another, symmetric eigenproblem on the whole basis.
    fn matches(&self, signature: &Signature) -> bool {
        signature.krein_index()
            == self
                .model
                .negative_stiffness_directions(signature.speed_rad_per_s)
    }

    /// The signatures of many speeds, in parallel.
    ///
    /// # Errors
    /// [`SpectrumError`] of the lowest speed that fails.
    pub fn at_all(&self, speeds: &[f64]) -> Result<Vec<Signature>, SpectrumError> {
        let signatures: Vec<_> = speeds.par_iter().map(|&speed| self.at(speed)).collect();
        signatures.into_iter().collect()
    }
}

/// States at ascending speeds from the first to the last of some: those that come with the
/// projection, and more where these are far apart.
fn anchor_states(
    low: &ReflectedModel<'_>,
    speeds: &[f64],
) -> Result<Vec<KnownStates>, SpectrumError> {
    let known = low.known();
    let (missing, mut states) = match (known, speeds) {
        ([(from, _), .., (to, _)], [first, .., last]) if from <= first && last <= to => {
            let apart = LARGEST_GAP * (last - first) / ANCHORS.count() as f64;
            let above = known.partition_point(|(speed, _)| speed <= first);
            let known = &known[above.saturating_sub(1)..];
            (between(known, apart), known.to_vec())
        }
        _ => (anchors(speeds), Vec::new()),
    };
    let computed: Vec<_> = missing
        .into_par_iter()
        .map(|speed| low.states(speed))
        .collect();
    let computed: Vec<KnownStates> = computed.into_iter().collect::<Result<_, _>>()?;
    states.extend(computed);
    states.sort_by(|x, y| x.0.total_cmp(&y.0));
    Ok(states)
}

/// Evenly spread speeds between those that are known, so that none are further apart than said.
fn between(known: &[KnownStates], apart: f64) -> Vec<f64> {
    let within = |ends: &[KnownStates]| {
        let (from, to) = (ends[0].0, ends[1].0);
        let parts = ((to - from) / apart).ceil().max(1.0) as usize;
        (1..parts).map(move |k| from + (to - from) * k as f64 / parts as f64)
    };
    known.windows(2).flat_map(within).collect()
}

/// Of ascending speeds the first, the last, and some about evenly spread between.
fn anchors(speeds: &[f64]) -> Vec<f64> {
    let (Some(&first), Some(&last)) = (speeds.first(), speeds.last()) else {
        return Vec::new();
    };
    let spacing = (last - first) / ANCHORS.count() as f64;
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
