//! How far the goal depends on each freed number, from one bound to the other.

use super::outcome::Computed;
use super::search::Search;

/// Number of values of each number, with both bounds.
const VALUES: usize = 5;

/// Smallest and largest goal in rpm over each number, while the others have the shares `at`; `None` where a saw keeps not all
/// limits, or could not be computed.
pub fn goals_rpm(search: &Search<'_>, at: &[f64]) -> Vec<Option<[f64; 2]>> {
    let over = |index: usize| {
        let goals = search.each(
            VALUES,
            |k| {
                let mut shares = at.to_vec();
                shares[index] = k as f64 / (VALUES - 1) as f64;
                shares
            },
            &|_| (),
            |_, saw: Option<Computed>| {
                Some(saw?.outcome)
                    .filter(|saw| saw.kept)
                    .map(|saw| saw.goal_rpm)
            },
        );
        let all: Option<Vec<f64>> = goals.into_iter().collect();
        let ends = all?
            .into_iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], rpm| {
                [low.min(rpm), high.max(rpm)]
            });
        Some(ends)
    };
    (0..at.len()).map(over).collect()
}
