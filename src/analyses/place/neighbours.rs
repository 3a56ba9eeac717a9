//! Neighbours of a saw: saws whose numbers deviate by the tolerances of production.

use rayon::prelude::*;

use crate::model::scene::rpm;
use crate::stability::{Instability, InstabilityKind};

use super::Neighbour;
use super::outcome::{Computed, REFUSED};
use super::search::Search;
use super::worst_case::directions;

/// The neighbours of a saw and the worst of them.
#[derive(Debug, Clone)]
pub struct Neighbours {
    /// Tolerance of each number, in its unit.
    pub offsets: Vec<f64>,
    /// For each number, the goal of the saws in which it alone is smaller and larger; `None` if there is no such saw
    /// or it could not be computed.
    pub along_rpm: Vec<[Option<f64>; 2]>,
    /// The worst of the saw itself, these neighbours and the corners of the tolerances.
    pub worst: Neighbour,
    pub worst_cost: f64,
    /// Ratio of the goal of the worst to that of the saw itself; 1 if the latter is 0.
    pub worst_share: f64,
    /// Bands of the saw that lie slightly below the threshold and before the flutter speed. If their growth
    /// rose above it, the flutter speed would fall to their onset.
    pub almost: Vec<Instability>,
}

/// A neighbour with its cost and its goal.
struct Rated {
    saw: Neighbour,
    cost: f64,
    value_rad_per_s: f64,
}

impl Rated {
    fn new(values: Vec<f64>, saw: Option<&Computed>) -> Self {
        Rated {
            cost: saw.map_or(REFUSED, Computed::cost),
            value_rad_per_s: saw.map_or(0.0, |saw| saw.value_rad_per_s),
            saw: Neighbour {
                values,
                outcome: saw.map(|saw| saw.outcome),
            },
        }
    }
}

/// A saw that loses more than this share of its goal within its tolerances is fragile.
const FRAGILE: f64 = 0.05;
/// Share of the threshold above which the growth of a band is close to it.
const NEAR: f64 = 0.5;
impl Neighbours {
    pub fn new(search: &Search<'_>, shares: &[f64], own: &Computed) -> Self {
        let numbers = shares.len();
        let of = |direction: &Vec<f64>| {
            let moved = search.moved(shares, direction)?;
            let computed = search.computed(&moved.shares);
            Some(Rated::new(moved.values, computed.as_ref()))
        };
        let directions = directions(numbers);
        let mut around: Vec<Option<Rated>> = directions.par_iter().map(of).collect();
        let alone = around.split_off(directions.len() - 2 * numbers);
        let values = search.values(shares);
        let offsets = search
            .freed
            .iter()
            .zip(&values)
            .map(|(f, v)| search.tolerance(f, *v))
            .collect();
        let goal_rpm = |saw: &Option<Rated>| Some(saw.as_ref()?.saw.outcome?.goal_rpm);
        let pairs = alone.chunks(2);
        let along_rpm = pairs
            .map(|pair| [goal_rpm(&pair[0]), goal_rpm(&pair[1])])
            .collect();
        let all = around.into_iter().chain(alone).flatten();
        let nominal = Rated::new(values, Some(own));
        let worst = all.fold(nominal, |worst, other| {
            if other.cost > worst.cost {
                other
            } else {
                worst
            }
        });
        Neighbours {
            offsets,
            along_rpm,
            worst_share: if own.value_rad_per_s > 0.0 {
                worst.value_rad_per_s / own.value_rad_per_s
            } else {
                1.0
            },
            worst_cost: worst.cost,
            worst: worst.saw,
            almost: almost(own, search.scene.flutter_threshold_per_s),
        }
    }

    /// Whether every neighbour keeps the limits.
    pub fn keep_limit(&self) -> bool {
        self.worst.outcome.is_some_and(|outcome| outcome.kept)
    }

    /// Whether the worst neighbour loses a considerable share of the goal.
    pub fn are_fragile(&self) -> bool {
        self.worst_share < 1.0 - FRAGILE
    }
}

/// Flutter bands before the flutter speed whose growth is close to the threshold.
fn almost(best: &Computed, threshold_per_s: f64) -> Vec<Instability> {
    let before = best.outcome.flutter_rpm.unwrap_or(f64::INFINITY);
    let near = |b: &&Instability| {
        b.kind == InstabilityKind::Flutter
            && rpm(b.from_rad_per_s) < before
            && b.peak_growth_per_s >= NEAR * threshold_per_s
    };
    best.bands.iter().filter(near).cloned().collect()
}
