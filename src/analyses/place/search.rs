//! Search for the shares of the free numbers that are best in the worst case of their tolerances.
//!
//! The flutter speed jumps where the growth of a band passes the threshold and is smooth elsewhere. A saw is
//! rated by the worst of itself and its neighbours within the tolerances, because no number is produced
//! exactly and a saw next to a jump may have the value of its other side. This rating never exceeds the nominal
//! value, so a few neighbours suffice to exclude a saw. The box of bounds is sampled evenly, and the best samples are refined
//! by mesh adaptive direct search, which needs no derivative and whose theory allows jumps (Audet and Dennis,
//! SIAM J. Optim. 17, 2006). Both are deterministic.

use std::cmp::Ordering;
use std::collections::HashMap;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::{Mutex, MutexGuard, PoisonError};

use rayon::prelude::*;
use serde_json::{Value, json};

use crate::analyses::door::Step;
use crate::model::plate::Resolution;
use crate::model::scene::{Freed, SceneFile, rpm, scene_at, spread};
use crate::modes::Cancellation;

use super::memory::Memory;
use super::outcome::{Computed, Known, Question, REFUSED};

/// The saws of a search. Each is computed once.
pub struct Search<'a> {
    pub scene: &'a SceneFile,
    pub freed: &'a [Freed],
    question: Question,
    /// What an earlier run has computed, and where this one is kept.
    memory: &'a Memory,
    /// Results by the bits of the shares.
    known: Mutex<HashMap<Vec<u64>, Known>>,
    /// Smallest cost in the worst case of the tolerances among the saws whose neighbours are all computed.
    least_worst: Mutex<f64>,
}

/// Shares and their cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Tried {
    pub shares: Vec<f64>,
    pub cost: f64,
}

/// Called with the number of finished saws of a batch after each of them, on the thread that has computed it.
pub type See<'a> = &'a (dyn Fn(usize) + Sync);

/// Number of saws computed, number of failures, and the message of the first failure in alphabetical order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tally {
    pub saws: usize,
    pub failed: usize,
    pub why: Option<String>,
}

impl Tally {
    /// Adds the counts of another search.
    pub fn and(self, other: Tally) -> Tally {
        Tally {
            saws: self.saws + other.saws,
            failed: self.failed + other.failed,
            why: self.why.or(other.why),
        }
    }
}

impl Tried {
    pub fn new(shares: Vec<f64>, saw: Option<&Computed>) -> Self {
        let cost = saw.map_or(REFUSED, Computed::cost);
        Tried { shares, cost }
    }

    /// Order by cost. Ties are decided by the shares, since the order of a hash map is random.
    fn cheaper(&self, other: &Self) -> Ordering {
        let by_shares = || {
            let pair = self.shares.partial_cmp(&other.shares);
            pair.unwrap_or(Ordering::Equal)
        };
        self.cost.total_cmp(&other.cost).then_with(by_shares)
    }

    /// Whether the shares are at a distance from those of some others.
    pub fn is_apart(&self, others: &[Tried], distance: f64) -> bool {
        others.iter().all(|other| {
            let pairs = self.shares.iter().zip(&other.shares);
            pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) > distance
        })
    }
}

impl<'a> Search<'a> {
    pub fn new(
        scene: &'a SceneFile,
        freed: &'a [Freed],
        question: Question,
        memory: &'a Memory,
    ) -> Self {
        Search {
            scene,
            freed,
            question,
            memory,
            known: Mutex::default(),
            least_worst: Mutex::new(REFUSED),
        }
    }

    /// Counts a saw all of whose neighbours are computed. The best so far is on the disk at once.
    pub fn rated(&self, shares: &[f64], worst_cost: f64) {
        let mut least = self.least_worst();
        if worst_cost < *least {
            *least = worst_cost;
            if worst_cost <= 0.0
                && let Ok(scene) = scene_at(self.scene, self.freed, shares)
            {
                self.memory.show(scene.file());
            }
        }
    }

    fn least_worst(&self) -> MutexGuard<'_, f64> {
        self.least_worst
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }

    /// Progress of a step, with the best saw so far.
    pub fn step(&self, what: &'static str, done: usize, of: usize) -> Step {
        let least = *self.least_worst();
        Step {
            what,
            done,
            of,
            best_rpm: (least <= 0.0).then(|| rpm(-least)),
        }
    }

    fn known(&self) -> MutexGuard<'_, HashMap<Vec<u64>, Known>> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Result of the saw with the given shares; `None` if it is refused or cannot be analysed, and if the search is cancelled.
    pub fn computed(&self, shares: &[f64]) -> Option<Computed> {
        let key: Vec<u64> = shares.iter().map(|share| share.to_bits()).collect();
        let known = self.known().get(&key).cloned();
        let found = known.unwrap_or_else(|| {
            let saw = self.named(shares);
            let recalled = self.memory.recall(&saw);
            let found = recalled.clone().unwrap_or_else(|| self.asked(shares));
            // A saw whose computation was cancelled has no result, and did not fail.
            if !Cancellation::current().is_cancelled() {
                self.known().insert(key, found.clone());
                if recalled.is_none() {
                    self.memory.keep(saw, &found);
                }
            }
            found
        });
        found.ok()
    }

    fn asked(&self, shares: &[f64]) -> Known {
        match scene_at(self.scene, self.freed, shares) {
            Ok(scene) => self.question.ask(&scene).map_err(|e| Some(e.to_string())),
            Err(_) => Err(None),
        }
    }

    /// What distinguishes a saw from others of the same placement.
    fn named(&self, shares: &[f64]) -> Value {
        let paths: Vec<&str> = self.freed.iter().map(|of| of.parameter.path()).collect();
        let Resolution {
            max_diameters,
            radial_functions,
        } = self.question.resolution;
        json!([[max_diameters, radial_functions], paths, shares])
    }

    /// Tolerance of a number with this value.
    pub fn tolerance(&self, freed: &Freed, value: f64) -> f64 {
        self.question.tolerances.of(&freed.parameter, value)
    }

    /// Cost of the saw with the given shares.
    pub fn cost(&self, shares: &[f64]) -> f64 {
        let saw = self.computed(shares);
        saw.as_ref().map_or(REFUSED, Computed::cost)
    }

    /// Values of the freed numbers.
    pub fn values(&self, shares: &[f64]) -> Vec<f64> {
        let numbers = self.freed.iter().zip(shares);
        numbers.map(|(freed, share)| freed.value(*share)).collect()
    }

    /// Counts of the saws computed so far.
    pub fn tally(&self) -> Tally {
        let known = self.known();
        let failed = known.values().filter_map(|found| found.as_ref().err());
        let mut why: Vec<&String> = failed.flatten().collect();
        why.sort();
        Tally {
            saws: known.len(),
            failed: why.len(),
            why: why.first().map(|why| (*why).clone()),
        }
    }

    /// The saw within the bounds whose nominal cost is smallest, among those computed so far.
    pub fn cheapest(&self) -> Option<Tried> {
        let all = self.inside(|saw| Some(saw.cost()));
        let tried = all.into_iter().map(|(tried, _)| tried);
        tried.min_by(Tried::cheaper)
    }

    /// The saws within the bounds that keep the limits and whose deflection at the cut is known, with it, sorted by nominal cost.
    pub fn deviating(&self) -> Vec<(Tried, f64)> {
        let deviation_m = |saw: &Computed| saw.deviation_m.filter(|_| saw.outcome.kept);
        let mut all = self.inside(deviation_m);
        all.sort_by(|(x, _), (y, _)| x.cheaper(y));
        all
    }

    /// The saws within the bounds among those computed so far, each with a number of it; those without the number are omitted.
    fn inside(&self, number: impl Fn(&Computed) -> Option<f64>) -> Vec<(Tried, f64)> {
        let known = self.known();
        let all = known.iter().filter_map(|(key, found)| {
            let shares: Vec<f64> = key.iter().map(|bits| f64::from_bits(*bits)).collect();
            let is_inside = shares.iter().all(|share| (0.0..=1.0).contains(share));
            let saw = found.as_ref().ok().filter(|_| is_inside)?;
            let cost = saw.cost();
            Some((Tried { shares, cost }, number(saw)?))
        });
        all.collect()
    }

    /// Computes `count` saws on all threads and returns, in their order, the values that `kept` makes of shares and
    /// result.
    pub fn each<T: Send>(
        &self,
        count: usize,
        shares_of: impl Fn(usize) -> Vec<f64> + Sync,
        see: See<'_>,
        kept: impl Fn(Vec<f64>, Option<Computed>) -> T + Sync,
    ) -> Vec<T> {
        let done = AtomicUsize::new(0);
        let one = |index: usize| {
            let shares = shares_of(index);
            let saw = self.computed(&shares);
            see(done.fetch_add(1, Relaxed) + 1);
            kept(shares, saw)
        };
        (0..count).into_par_iter().map(one).collect()
    }

    /// The original scene and `count - 1` samples of the box, sorted by nominal cost.
    pub fn sample(&self, own: &[f64], count: usize, see: See<'_>) -> Vec<Tried> {
        let shares_of = |index: usize| match index.checked_sub(1) {
            None => own.to_vec(),
            Some(index) => spread(self.freed.len(), 0, index),
        };
        let mut tried = self.each(count, shares_of, see, |shares, saw| {
            Tried::new(shares, saw.as_ref())
        });
        // The sort is stable, so that the order of equal saws does not depend on the threads.
        tried.sort_by(|x, y| x.cost.total_cmp(&y.cost));
        tried
    }
}

/// The one with the smallest cost.
pub fn cheapest(tried: &[Tried]) -> Option<Tried> {
    let cheapest = tried.iter().min_by(|x, y| x.cost.total_cmp(&y.cost));
    cheapest.cloned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analyses::place::{Demands, Tolerances};
    use crate::model::scene::{Accuracy, Scene, SceneError, SpeedRange};
    use crate::stability::InstabilityKind;

    fn question() -> Question {
        Question {
            demands: Demands::default(),
            range: SpeedRange::between_rpm(0.0, 2500.0),
            resolution: Resolution::of(Accuracy::Draft),
            tolerances: Tolerances::USUAL,
        }
    }

    /// A cancelled saw has no result and did not fail; one that the analysis refuses failed, with the reason.
    #[test]
    fn a_cancelled_saw_is_not_counted_as_failed() {
        let scene = Scene::paper();
        let freed = [Freed::with_usual_bounds(&scene, "guides[0].radius_m").unwrap()];
        let memory = Memory::none();
        let search = Search::new(scene.file(), &freed, question(), &memory);
        let cancellation = Cancellation::default();
        cancellation.cancel();
        let found = cancellation.watched(|| search.computed(&[0.5]).is_some());
        assert!(!found.unwrap());
        let Tally { saws, failed, .. } = search.tally();
        assert_eq!((saws, failed), (0, 0));
        assert!(search.computed(&[0.5]).is_some());
        assert_eq!((search.tally().saws, search.tally().failed), (1, 0));
        let too_fast = Question {
            range: SpeedRange::between_rpm(0.0, 1e6),
            ..question()
        };
        // The saws of another range of speeds are others.
        let memory = Memory::none();
        let search = Search::new(scene.file(), &freed, too_fast, &memory);
        assert!(search.computed(&[0.5]).is_none());
        assert_eq!((search.tally().saws, search.tally().failed), (1, 1));
    }

    /// The deviation at an operating speed within a band of flutter: a band counts if it grows as fast as the threshold.
    #[test]
    fn a_band_below_the_threshold_makes_no_saw_unstable() {
        let at = |rpm: f64, threshold_per_s: f64| -> Result<Computed, SceneError> {
            let scene = Scene::paper().edited(|saw| {
                saw.operating_rpm = Some(rpm);
                saw.flutter_threshold_per_s = threshold_per_s;
            })?;
            Ok(question().ask(&scene).unwrap())
        };
        let bands = at(1000.0, 0.25).unwrap().bands;
        let diverges = |speed: f64| {
            let mut bands = bands.iter();
            bands.any(|b| b.kind == InstabilityKind::Divergence && b.range().contains(speed))
        };
        let mut flutter = bands
            .iter()
            .filter(|band| band.kind == InstabilityKind::Flutter && !diverges(band.peak_rad_per_s));
        let band = flutter.next().expect("flutter without divergence");
        let peak_rpm = rpm(band.peak_rad_per_s);
        let [weak, strong] = [2.0, 0.5].map(|share| share * band.peak_growth_per_s);
        assert!(at(peak_rpm, weak).unwrap().deviation_m.is_some());
        assert!(at(peak_rpm, strong).unwrap().deviation_m.is_none());
    }
}
