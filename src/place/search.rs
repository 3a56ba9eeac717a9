//! Looking for the best shares of the freed numbers.
//!
//! The flutter speed jumps where a band passes the threshold and is smooth in between. So the
//! box is first sampled evenly, and the best samples are then refined by mesh adaptive direct
//! search, which needs no derivative and whose theory allows jumps (Audet and Dennis, SIAM J.
//! Optim. 17, 2006). Both are deterministic.

use basin::{
    BoxBounds, ConstraintDescription, ConstraintSet, Constraints, CostFunction, Executor, Mads,
    PointState,
};
use rayon::prelude::*;
use std::convert::Infallible;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::scene::{Freed, SceneFile, scene_at, spread};

use super::outcome::{Outcome, Question, REFUSED};

/// Saws with some numbers freed, and what is asked of them.
pub struct Search<'a> {
    pub scene: &'a SceneFile,
    pub freed: &'a [Freed],
    pub question: &'a Question,
    /// Saws analysed so far.
    pub evaluations: &'a AtomicUsize,
}

/// Shares and what they cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Tried {
    pub shares: Vec<f64>,
    pub cost: f64,
}

/// A saw of many that has just been computed.
pub struct Seen<'a> {
    /// How many are done with it.
    pub done: usize,
    /// Which one.
    pub index: usize,
    pub shares: &'a [f64],
    pub outcome: Option<&'a Outcome>,
}

/// Called for every saw of many, by the thread that has computed it.
pub type See<'a> = &'a (dyn Fn(Seen<'_>) + Sync);

impl Tried {
    pub fn new(shares: Vec<f64>, outcome: Option<&Outcome>) -> Self {
        let cost = outcome.map_or(REFUSED, Outcome::cost);
        Tried { shares, cost }
    }
}

impl Search<'_> {
    /// What the saw at given shares is worth; `None` where it is refused or cannot be analysed.
    pub fn outcome(&self, shares: &[f64]) -> Option<Outcome> {
        self.evaluations.fetch_add(1, Ordering::Relaxed);
        let scene = scene_at(self.scene, self.freed, shares).ok()?;
        self.question.ask(&scene).ok()
    }

    /// Shares with what they cost.
    pub fn tried(&self, shares: Vec<f64>) -> Tried {
        let outcome = self.outcome(&shares);
        Tried::new(shares, outcome.as_ref())
    }

    /// What `count` saws are worth, in their order, computed on all threads.
    pub fn outcomes<T: Send>(
        &self,
        count: usize,
        shares_of: impl Fn(usize) -> Vec<f64> + Sync,
        see: See<'_>,
        kept: impl Fn(Vec<f64>, Option<Outcome>) -> T + Sync,
    ) -> Vec<T> {
        let done = AtomicUsize::new(0);
        let one = |index: usize| {
            let shares = shares_of(index);
            let outcome = self.outcome(&shares);
            see(Seen {
                done: done.fetch_add(1, Ordering::Relaxed) + 1,
                index,
                shares: &shares,
                outcome: outcome.as_ref(),
            });
            kept(shares, outcome)
        };
        (0..count).into_par_iter().map(one).collect()
    }

    /// `count` samples of the box, the scene's own first, best first.
    pub fn sample(&self, own: &[f64], count: usize, see: See<'_>) -> Vec<Tried> {
        let shares_of = |index: usize| match index.checked_sub(1) {
            None => own.to_vec(),
            Some(index) => spread(self.freed.len(), 0, index),
        };
        let mut tried = self.outcomes(count, shares_of, see, |shares, outcome| {
            Tried::new(shares, outcome.as_ref())
        });
        // Stable, so that equals stay in their order whatever thread was first.
        tried.sort_by(|x, y| x.cost.total_cmp(&y.cost));
        tried
    }

    /// The best few that are apart from each other.
    pub fn apart(tried: &[Tried], count: usize, distance: f64) -> Vec<Tried> {
        let mut chosen: Vec<Tried> = Vec::new();
        for one in tried {
            let far = |other: &Tried| {
                let pairs = one.shares.iter().zip(&other.shares);
                pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) > distance
            };
            if chosen.len() < count && chosen.iter().all(far) {
                chosen.push(one.clone());
            }
        }
        chosen
    }

    /// Refines a try by direct search, from a step to a smaller one, both shares of the box.
    pub fn refine(&self, start: &Tried, (from, to): (f64, f64), budget: u64) -> Tried {
        let problem = Boxed {
            search: self,
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
        Ok(self.search.tried(shares.clone()).cost)
    }
}
