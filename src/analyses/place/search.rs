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
use std::convert::Infallible;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::{Mutex, MutexGuard, PoisonError};

use basin::{
    BoxBounds, ConstraintDescription, ConstraintSet, Constraints, CostFunction, Executor, Mads,
    PointState,
};
use rayon::prelude::*;

use crate::model::scene::{Freed, SceneFile, scene_at, spread};

use super::computed::{Computed, Question, REFUSED};
use super::neighbours::worst_cost;

/// The result of a saw, or the reason why it could not be computed (`None` if there is no such saw).
type Known = Result<Computed, Option<String>>;

/// The saws of a search. Each is computed once.
pub struct Search<'a> {
    pub scene: &'a SceneFile,
    pub freed: &'a [Freed],
    question: Question,
    /// Results by the bits of the shares.
    known: Mutex<HashMap<Vec<u64>, Known>>,
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

    /// Whether the shares are at a distance from those of some others.
    fn is_apart(&self, others: &[Tried], distance: f64) -> bool {
        others.iter().all(|other| {
            let pairs = self.shares.iter().zip(&other.shares);
            pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) > distance
        })
    }
}

impl<'a> Search<'a> {
    pub fn new(scene: &'a SceneFile, freed: &'a [Freed], question: Question) -> Self {
        Search {
            scene,
            freed,
            question,
            known: Mutex::default(),
        }
    }

    fn known(&self) -> MutexGuard<'_, HashMap<Vec<u64>, Known>> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Result of the saw with the given shares; `None` if it is refused or cannot be analysed.
    pub fn computed(&self, shares: &[f64]) -> Option<Computed> {
        let key: Vec<u64> = shares.iter().map(|share| share.to_bits()).collect();
        let known = self.known().get(&key).cloned();
        let found = known.unwrap_or_else(|| {
            let found = match scene_at(self.scene, self.freed, shares) {
                Ok(scene) => self.question.ask(&scene).map_err(|e| Some(e.to_string())),
                Err(_) => Err(None),
            };
            self.known().insert(key, found.clone());
            found
        });
        found.ok()
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
        let known = self.known();
        let all = known.iter().filter_map(|(key, found)| {
            let shares: Vec<f64> = key.iter().map(|bits| f64::from_bits(*bits)).collect();
            let is_inside = shares.iter().all(|share| (0.0..=1.0).contains(share));
            let cost = found.as_ref().ok().filter(|_| is_inside)?.cost();
            Some(Tried { shares, cost })
        });
        // Ties are decided by the shares, since the order of the hash map is random.
        all.min_by(|x, y| {
            let by_shares = || x.shares.partial_cmp(&y.shares).unwrap_or(Ordering::Equal);
            x.cost.total_cmp(&y.cost).then_with(by_shares)
        })
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

    /// The `count` saws of smallest cost in the worst case of their tolerances that are at a distance, in shares,
    /// from each other. `tried` is sorted by nominal cost.
    pub fn most_robust(&self, tried: &[Tried], count: usize, distance: f64) -> Vec<Tried> {
        let mut chosen: Vec<Tried> = Vec::new();
        while chosen.len() < count {
            let mut best: Option<Tried> = None;
            for one in tried.iter().filter(|one| one.is_apart(&chosen, distance)) {
                let limit = best.as_ref().map_or(f64::INFINITY, |best| best.cost);
                if one.cost >= limit {
                    break;
                }
                let cost = worst_cost(self, &one.shares, limit);
                if cost < limit {
                    let shares = one.shares.clone();
                    best = Some(Tried { shares, cost });
                }
            }
            match best {
                Some(best) => chosen.push(best),
                None => break,
            }
        }
        chosen
    }

    /// Refines a saw by direct search for the smallest cost in the worst case of its tolerances, with steps between
    /// two sizes, which are shares of the box. `see` is called after each saw.
    pub fn refine(
        &self,
        start: &Tried,
        (from, to): (f64, f64),
        budget: u64,
        see: &(dyn Fn() + Sync),
    ) -> Tried {
        let problem = Boxed {
            search: self,
            least: Mutex::new(start.cost),
            see,
            lower: vec![0.0; self.freed.len()],
            upper: vec![1.0; self.freed.len()],
        };
        let solver = Mads::new()
            .bounded()
            .with_initial_poll_size(from)
            .with_minimum_poll_size(to);
        let run = Executor::new(problem, solver, PointState::new(start.shares.clone()))
            .max_cost_evals(budget)
            .run();
        match run {
            Ok(result) if result.best_cost() < start.cost => Tried {
                shares: result.best_param().clone(),
                cost: result.best_cost(),
            },
            _ => start.clone(),
        }
    }
}

struct Boxed<'a> {
    search: &'a Search<'a>,
    /// Smallest cost so far.
    least: Mutex<f64>,
    see: &'a (dyn Fn() + Sync),
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl Constraints for Boxed<'_> {
    type Set = ConstraintSet<BoxBounds<Vec<f64>>>;

    fn constraints(&self) -> <Self::Set as ConstraintDescription>::Borrowed<'_> {
        ConstraintSet::new().with_bounds(BoxBounds::new(Some(&self.lower), Some(&self.upper)))
    }
}

impl CostFunction for Boxed<'_> {
    type Param = Vec<f64>;
    type Output = f64;
    type Error = Infallible;

    fn cost(&self, shares: &Vec<f64>) -> Result<f64, Infallible> {
        let least = || self.least.lock().unwrap_or_else(PoisonError::into_inner);
        // A cost above `limit`, the smallest cost so far, may be inexact, because the direct search only
        // compares it with the smallest one.
        let limit = *least();
        let cost = worst_cost(self.search, shares, limit);
        *least() = limit.min(cost);
        (self.see)();
        Ok(cost)
    }
}
