//! Search for the smallest cost in the worst case of the tolerances of production.

use std::convert::Infallible;
use std::sync::{Mutex, PoisonError};

use basin::{
    BoxBounds, ConstraintDescription, ConstraintSet, Constraints, CostFunction, Executor, Mads,
    PointState,
};
use rayon::prelude::*;

use super::search::{Search, Tried};
use crate::model::scene::scene_at;

/// Largest number of free numbers for which the corners of the tolerances are computed; with more they are too many.
const MAX_CORNERS: usize = 4;
/// Number of neighbours that are computed before the worst of them is determined.
const AT_A_TIME: usize = 4;

/// Directions of the neighbours: first the corners of the tolerances, which usually contain the worst, then
/// each number alone.
pub fn directions(numbers: usize) -> Vec<Vec<f64>> {
    let mut all: Vec<Vec<f64>> = Vec::new();
    if (2..=MAX_CORNERS).contains(&numbers) {
        all.extend((0..1_usize << numbers).map(|corner| {
            let sign = |k: usize| if corner >> k & 1 == 0 { -1.0 } else { 1.0 };
            (0..numbers).map(sign).collect()
        }));
    }
    for k in 0..numbers {
        for sign in [-1.0, 1.0] {
            let mut alone = vec![0.0; numbers];
            alone[k] = sign;
            all.push(alone);
        }
    }
    all
}

/// A saw beside another one. It may lie outside the bounds of the search.
pub struct Moved {
    pub values: Vec<f64>,
    pub shares: Vec<f64>,
}

impl Search<'_> {
    /// The neighbour in a direction; `None` if it is not a valid saw: a pad cannot be beyond the rim.
    pub fn moved(&self, shares: &[f64], direction: &[f64]) -> Option<Moved> {
        let numbers = self.freed.iter().zip(shares).zip(direction);
        let values: Vec<f64> = numbers
            .map(|((freed, share), direction)| {
                let value = freed.value(*share);
                value + direction * self.tolerance(freed, value)
            })
            .collect();
        let pairs = self.freed.iter().zip(&values);
        let shares: Vec<f64> = pairs.map(|(freed, value)| freed.share(*value)).collect();
        let exists = scene_at(self.scene, self.freed, &shares).is_ok();
        exists.then_some(Moved { values, shares })
    }

    /// Cost of a saw in the worst case of its tolerances; if it exceeds a limit, that of the worst neighbour
    /// computed so far. `hardest` is the direction of the worst neighbour of the preceding saw, which is usually that of a saw close to
    /// it, too, and excludes most saws.
    pub fn worst_cost(&self, shares: &[f64], limit: f64, hardest: &mut usize) -> f64 {
        let mut worst = self.cost(shares);
        let all = directions(shares.len());
        let mut order: Vec<usize> = (0..all.len()).collect();
        order.swap(0, *hardest);
        let (first, others) = order.split_at(1);
        for some in std::iter::once(first).chain(others.chunks(AT_A_TIME)) {
            if worst > limit {
                return worst;
            }
            let cost_of = |place: &usize| {
                let cost = self.cost(&self.moved(shares, &all[*place])?.shares);
                Some((*place, cost))
            };
            let costs: Vec<Option<(usize, f64)>> = some.par_iter().map(cost_of).collect();
            for (place, cost) in costs.into_iter().flatten() {
                if cost > worst {
                    (worst, *hardest) = (cost, place);
                }
            }
        }
        self.rated(shares, worst);
        worst
    }

    /// The `count` saws of smallest cost in the worst case of their tolerances that are at a distance, in shares,
    /// from each other. `tried` is sorted by nominal cost.
    pub fn most_robust(&self, tried: &[Tried], count: usize, distance: f64) -> Vec<Tried> {
        let mut chosen: Vec<Tried> = Vec::new();
        let mut hardest = 0;
        while chosen.len() < count {
            let mut best: Option<Tried> = None;
            for one in tried.iter().filter(|one| one.is_apart(&chosen, distance)) {
                let limit = best.as_ref().map_or(f64::INFINITY, |best| best.cost);
                if one.cost >= limit {
                    break;
                }
                let cost = self.worst_cost(&one.shares, limit, &mut hardest);
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
        [from, to]: [f64; 2],
        budget: u64,
        see: &(dyn Fn() + Sync),
    ) -> Tried {
        let problem = Boxed {
            search: self,
            least: Mutex::new((start.cost, 0)),
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
    /// Smallest cost so far, and the direction of the worst neighbour of the last saw.
    least: Mutex<(f64, usize)>,
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
        let (limit, mut hardest) = *least();
        let cost = self.search.worst_cost(shares, limit, &mut hardest);
        *least() = (limit.min(cost), hardest);
        (self.see)();
        Ok(cost)
    }
}
