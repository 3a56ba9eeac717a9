//! Reflected waves and what they can meet: the smallest system that has every
//! instability of an undamped guided blade.

use std::sync::atomic::Ordering;

use faer::{Col, c64};

use crate::system::GyroscopicSystem;

use super::error::SpectrumError;
use super::half_order;
use super::hamiltonian::{HamiltonianReduction, State};
use super::mode::{Mode, classify};
use super::mode_pair::{ModePair, standing_states};
use super::vectors::Eigenpair;
use super::work::WorkCounters;
use crate::tuned::Tuned;

/// A projected system with the frequency up to which its modes are complete.
#[derive(Debug, Clone)]
pub struct ReflectedModel<'a> {
    system: &'a GyroscopicSystem,
    /// The same between two speeds, on the states of the modes at both.
    local: Option<HamiltonianReduction>,
    /// Critical speeds and their standing waves.
    standing: Vec<(f64, Col<f64>)>,
    height_rad_per_s: f64,
    known: &'a [KnownStates],
    counters: &'a WorkCounters,
}

/// A speed, and the states of the low modes there.
pub type KnownStates = (f64, Vec<State>);

/// Modes up to this multiple of the height help to span those below it.
pub(super) const SPAN_MARGIN: Tuned = Tuned::new("spectrum/reflected::SPAN_MARGIN", 1.2);

impl<'a> ReflectedModel<'a> {
    pub(super) fn new(
        system: &'a GyroscopicSystem,
        standing: Vec<(f64, Col<f64>)>,
        height_rad_per_s: f64,
        known: &'a [KnownStates],
        counters: &'a WorkCounters,
    ) -> Self {
        ReflectedModel {
            system,
            local: None,
            standing,
            height_rad_per_s,
            known,
            counters,
        }
    }

    /// Ascending speeds of which the states of the low modes are known, as they come with the
    /// projection.
    pub fn known(&self) -> &'a [KnownStates] {
        self.known
    }

    /// Frequency up to which its modes are complete.
    pub fn height_rad_per_s(&self) -> f64 {
        self.height_rad_per_s
    }

    /// Its modes at a speed. Those above the height are there to tell what comes next, and not to
    /// be trusted to many digits.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn modes(&self, speed_rad_per_s: f64) -> Result<Vec<Mode>, SpectrumError> {
        let pairs = self.pairs(speed_rad_per_s)?;
        Ok(classify(self.system, speed_rad_per_s, 0, pairs))
    }

    fn pairs(&self, speed_rad_per_s: f64) -> Result<Vec<Eigenpair>, SpectrumError> {
        self.counters.cancellation.check()?;
        match &self.local {
            Some(local) => {
                self.counters.local_solves.fetch_add(1, Ordering::Relaxed);
                local.eigenpairs(speed_rad_per_s)
            }
            None => {
                self.counters.reduced_solves.fetch_add(1, Ordering::Relaxed);
                half_order::eigenpairs(self.system, speed_rad_per_s)
            }
        }
    }

    /// Those of its lowest modes, also those that are no modes of their own, the mirror images of
    /// growing ones: to span others with, and to be refined.
    fn low_pairs(&self, speed_rad_per_s: f64) -> Result<Vec<Eigenpair>, SpectrumError> {
        let mut pairs = self.pairs(speed_rad_per_s)?;
        pairs.retain(|(lambda, _)| lambda.im <= SPAN_MARGIN.get() * self.height_rad_per_s);
        Ok(pairs)
    }

    /// The states of its lowest modes at a speed.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn states(&self, speed_rad_per_s: f64) -> Result<KnownStates, SpectrumError> {
        let pairs = self.low_pairs(speed_rad_per_s)?.into_iter();
        let states = pairs.map(|pair| State::new(self.system, speed_rad_per_s, pair));
        Ok((speed_rad_per_s, states.collect()))
    }

    /// The same between two speeds, on the states of the modes at both and on the standing
    /// waves between them: few states, whose error falls with the fourth power of the
    /// distance and vanishes at both ends and where a wave stands.
    pub fn between(&self, ends: [&KnownStates; 2]) -> Self {
        // Without the momentum of free rigid motions, which depends on the speed, two ends
        // do not span what is between.
        if !self.system.free_rigid.is_empty() {
            return self.whole();
        }
        let [from, to] = ends.map(|(speed, _)| *speed);
        let mut states: Vec<State> = Vec::new();
        let inside = |(speed, _): &&(f64, Col<f64>)| (from..=to).contains(speed);
        for (speed, shape) in self.standing.iter().filter(inside) {
            states.extend(standing_states(
                self.system,
                *speed,
                shape,
                self.height_rad_per_s,
            ));
        }
        for (_, known) in ends {
            states.extend(known.iter().cloned());
        }
        ReflectedModel {
            local: HamiltonianReduction::new(self.system, self.height_rad_per_s, &states),
            ..self.clone()
        }
    }

    /// The projected system itself, where no speeds are near enough to be between.
    pub fn whole(&self) -> Self {
        ReflectedModel {
            local: None,
            ..self.clone()
        }
    }

    /// The two modes of one speed next to two eigenvalues, refined on the projected system.
    ///
    /// # Errors
    /// [`SpectrumError`] when the eigenproblem fails.
    pub fn pair(
        &self,
        speed_rad_per_s: f64,
        lambdas: [c64; 2],
    ) -> Result<Option<ModePair>, SpectrumError> {
        let mut pairs = self.low_pairs(speed_rad_per_s)?;
        let mut chosen = Vec::new();
        for lambda in lambdas {
            let distance = |pair: &Eigenpair| (pair.0 - lambda).norm();
            let nearest = (0..pairs.len())
                .min_by(|&i, &k| distance(&pairs[i]).total_cmp(&distance(&pairs[k])));
            let Some(nearest) = nearest else {
                return Ok(None);
            };
            chosen.push(pairs.swap_remove(nearest));
        }
        let [first, second] = chosen.as_slice() else {
            return Ok(None);
        };
        self.counters.refined_pairs.fetch_add(1, Ordering::Relaxed);
        Ok(ModePair::new(
            self.system,
            speed_rad_per_s,
            self.height_rad_per_s,
            [first, second],
        ))
    }

    /// Whether modes are given in the coordinates of the projected system.
    pub fn has(&self, modes: &[Mode]) -> bool {
        let mut sizes = modes.iter().map(|mode| mode.coordinates.nrows());
        sizes.all(|size| size == self.system.order())
    }

    /// Two modes of its own at a speed, refined on the projected system.
    pub fn pair_of(&self, speed_rad_per_s: f64, modes: &[Mode; 2]) -> Option<ModePair> {
        self.counters.refined_pairs.fetch_add(1, Ordering::Relaxed);
        let pairs = modes
            .each_ref()
            .map(|mode| (mode.lambda, mode.coordinates.clone()));
        ModePair::new(
            self.system,
            speed_rad_per_s,
            self.height_rad_per_s,
            pairs.each_ref(),
        )
    }

    /// A pair at another speed, by a factorization in place of an eigenproblem.
    pub fn moved(&self, pair: &ModePair, speed_rad_per_s: f64) -> Option<ModePair> {
        self.counters.refined_pairs.fetch_add(1, Ordering::Relaxed);
        pair.moved(self.system, speed_rad_per_s, self.height_rad_per_s)
    }
}
