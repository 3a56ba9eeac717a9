//! Map of the goal over two of the freed numbers.

use crate::analyses::door::Progress;
use crate::model::evenly_spaced;
use crate::model::scene::Quantity;

use super::report::{GoalMap, Outcome};
use super::search::{Search, Tried};

/// Indices of the numbers along the axes: radius and angle of a pad if both are free, otherwise others.
#[derive(Debug, PartialEq)]
struct Axes {
    x: usize,
    y: Option<usize>,
}

fn axes(paths: &[&str]) -> Axes {
    let mut order: Vec<usize> = (0..paths.len()).collect();
    order.sort_by_key(|&i| (Quantity::kind_of(paths[i]), i));
    let (x, y) = (order[0], next(paths, &order));
    Axes { x, y }
}

/// Index of the number along the second axis: the next of the order that belongs to the pad of the first, or else the
/// next of all.
fn next(paths: &[&str], order: &[usize]) -> Option<usize> {
    let pad = |i: usize| paths[i].split('.').next();
    let (first, rest) = order.split_first()?;
    let same = rest.iter().find(|&&i| pad(i) == pad(*first));
    same.or(rest.first()).copied()
}

/// The map of a search, and the saws in its cells, best first.
pub struct Mapped {
    pub map: GoalMap,
    pub cells: Vec<Tried>,
}

/// Computes the map with `points` points along each axis, on the basis of the search; the other numbers have the
/// shares `at`.
pub fn through(search: &Search<'_>, at: &[f64], points: usize, progress: Progress<'_>) -> Mapped {
    let paths: Vec<&str> = search.freed.iter().map(|f| f.parameter.path()).collect();
    let Axes { x, y } = axes(&paths);
    let even = evenly_spaced([0.0, 1.0], points);
    let values = |k: usize| -> Vec<f64> {
        let shares = even.iter();
        shares.map(|s| search.freed[k].value(*s)).collect()
    };
    // Cells are counted row by row.
    let shares_of = |index: usize| {
        let mut shares = at.to_vec();
        shares[x] = even[index % points];
        if let Some(y) = y {
            shares[y] = even[index / points];
        }
        shares
    };
    let total = points * if y.is_some() { points } else { 1 };
    let see = |done| progress(search.step("map", done, total));
    let computed = search.each(total, shares_of, &see, |shares, saw| {
        let outcome = saw.as_ref().map(|saw| saw.outcome);
        (Tried::new(shares, saw.as_ref()), outcome)
    });
    let (mut cells, outcomes): (Vec<Tried>, Vec<Option<Outcome>>) = computed.into_iter().unzip();
    cells.sort_by(|x, y| x.cost.total_cmp(&y.cost));
    let goal = |saw: &Option<Outcome>| saw.map(|saw| saw.goal_rpm);
    let kept = |saw: &Option<Outcome>| saw.is_some_and(|saw| saw.kept);
    let rows = || outcomes.chunks(points);
    let map = GoalMap {
        x_path: paths[x].to_owned(),
        x: values(x),
        y_path: y.map(|y| paths[y].to_owned()),
        y: y.map_or(vec![0.0], values),
        goal_rpm: rows().map(|row| row.iter().map(goal).collect()).collect(),
        kept: rows().map(|row| row.iter().map(kept).collect()).collect(),
    };
    Mapped { map, cells }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radius_and_angle_of_one_pad_come_first() {
        let paths = [
            "guides[0].stiffness_n_per_m",
            "guides[0].radius_m",
            "guides[1].angle_deg",
            "guides[0].angle_deg",
        ];
        assert_eq!(axes(&paths), Axes { x: 1, y: Some(3) });
        assert_eq!(axes(&paths[..3]), Axes { x: 1, y: Some(0) });
        assert_eq!(axes(&["blade.thickness_m"]), Axes { x: 0, y: None });
    }
}
