//! Saws that trade the goal against the deviation of the board.
//!
//! Where flutter comes latest a pad need not hold the board best. For some limits of the deflection at the cut, these are the saws of
//! the search that are best in the worst case of their tolerances: none has a smaller worst case than another and deflects further.

use rayon::prelude::*;

use crate::analyses::board_deviation::sawing_plate;
use crate::model::plate::Resolution;
use crate::model::scene::scene_at;

use super::choice::Weighed;
use super::deviation::operating_deviation_m;
use super::report::FrontSaw;
use super::search::{Search, Tried};

/// Number of limits below the deflection of the best saw, from the smallest deflection of all saws on.
const LIMITS: usize = 5;

/// Saws of a search that are the best ones in the worst case of their tolerances within limits of the deflection, up to that of the
/// best saw; none if that is unknown.
pub fn within_limits(search: &Search<'_>, best: &Tried) -> Vec<Tried> {
    let own = search.computed(&best.shares);
    let Some(largest_m) = own.and_then(|saw| saw.deviation_m) else {
        return Vec::new();
    };
    let known = search.deviating();
    let smallest_m = known.iter().fold(largest_m, |m, (_, w)| m.min(*w));
    let limits = (0..LIMITS).map(|k| {
        let share = k as f64 / LIMITS as f64;
        smallest_m + share * (largest_m - smallest_m)
    });
    let found = limits.filter_map(|limit_m| {
        let within = known.iter().filter(|(_, w)| *w <= limit_m);
        let within: Vec<Tried> = within.map(|(tried, _)| tried.clone()).collect();
        search.most_robust(&within, 1, 0.0).pop()
    });
    let mut chosen: Vec<Tried> = found.collect();
    chosen.dedup_by(|x, y| x.shares == y.shares);
    chosen
}

/// The best saw, and those of some others than which none is better in both respects; those that deflect least first.
pub fn front(
    search: &Search<'_>,
    others: &[Tried],
    best: &Weighed,
    resolution: Resolution,
) -> Vec<FrontSaw> {
    let others = others.par_iter().filter_map(|tried| {
        let shares = tried.shares.clone();
        let computed = search.computed(&shares)?;
        weighed(search, &Weighed::new(search, shares, computed), resolution)
    });
    let mut saws: Vec<FrontSaw> = others.collect();
    saws.extend(weighed(search, best, resolution));
    undominated(saws)
}

/// A saw that keeps the limits within its tolerances.
fn weighed(search: &Search<'_>, saw: &Weighed, resolution: Resolution) -> Option<FrontSaw> {
    saw.computed.deviation_m?;
    let worst = saw.neighbours.worst.outcome;
    let worst_goal_rpm = worst.filter(|outcome| outcome.kept)?.goal_rpm;
    let own = saw.computed.outcome;
    let deflection_m = match own.deflection_m {
        Some(limited) => limited,
        None => {
            let scene = scene_at(search.scene, search.freed, &saw.shares).ok()?;
            let rpm = scene.file().operating_rpm?;
            let plate = sawing_plate(&scene, resolution, rpm);
            operating_deviation_m(&scene, resolution, &plate)?
        }
    };
    Some(FrontSaw {
        values: search.values(&saw.shares),
        flutter_rpm: own.flutter_rpm,
        first_critical_rpm: own.first_critical_rpm,
        worst_goal_rpm,
        deflection_m,
    })
}

/// The saws than which none is at least as good in both respects, and better in one.
fn undominated(mut saws: Vec<FrontSaw>) -> Vec<FrontSaw> {
    saws.sort_by(|x, y| {
        let by_worst = || y.worst_goal_rpm.total_cmp(&x.worst_goal_rpm);
        x.deflection_m
            .total_cmp(&y.deflection_m)
            .then_with(by_worst)
    });
    let mut highest_rpm = f64::NEG_INFINITY;
    saws.retain(|saw| {
        let is_higher = saw.worst_goal_rpm > highest_rpm;
        highest_rpm = highest_rpm.max(saw.worst_goal_rpm);
        is_higher
    });
    saws
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every pair is compared with every other one.
    #[test]
    fn no_saw_of_the_front_is_dominated_and_every_other_one_is() {
        let saw = |k: usize| FrontSaw {
            values: vec![k as f64],
            flutter_rpm: None,
            first_critical_rpm: None,
            deflection_m: ((37 * k) % 17) as f64,
            worst_goal_rpm: ((53 * k) % 23) as f64,
        };
        let all: Vec<FrontSaw> = (0..60).map(saw).collect();
        let dominates = |x: &FrontSaw, y: &FrontSaw| {
            let is_no_worse =
                x.deflection_m <= y.deflection_m && x.worst_goal_rpm >= y.worst_goal_rpm;
            is_no_worse && (x.deflection_m < y.deflection_m || x.worst_goal_rpm > y.worst_goal_rpm)
        };
        let front = undominated(all.clone());
        let mut expected: Vec<[f64; 2]> = all
            .iter()
            .filter(|one| !all.iter().any(|other| dominates(other, one)))
            .map(|one| [one.deflection_m, one.worst_goal_rpm])
            .collect();
        expected.sort_by(|x, y| x[0].total_cmp(&y[0]));
        expected.dedup();
        let found: Vec<[f64; 2]> = front
            .iter()
            .map(|s| [s.deflection_m, s.worst_goal_rpm])
            .collect();
        assert_eq!(found, expected);
    }
}
