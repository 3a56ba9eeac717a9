//! Map of the goal over two of the freed numbers.

use crate::campbell::even_speeds;
use crate::scene::Quantity;

use super::Progress;
use super::outcome::Outcome;
use super::search::{Search, Tried};

/// The goal over two freed numbers; the others have the values of the best saw of the coarse search. The saws are
/// computed on its basis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Map {
    /// JSON path of the number along the first axis.
    pub x_path: String,
    /// Values along the first axis, with equally spaced shares.
    pub x: Vec<f64>,
    /// JSON path of the number along the second axis; `None` if only one number is free.
    pub y_path: Option<String>,
    /// Values along the second axis; a single 0 without one.
    pub y: Vec<f64>,
    /// Results, one row for each value of y; `None` if there is no such saw.
    pub outcomes: Vec<Vec<Option<Outcome>>>,
    shares: [Vec<f64>; 2],
    axes: (usize, Option<usize>),
    /// Shares of all numbers; each cell replaces those of the axes.
    at: Vec<f64>,
}

/// Indices of the numbers along the axes: radius and angle of a pad if both are free, otherwise others.
fn axes(paths: &[&str]) -> (usize, Option<usize>) {
    let mut order: Vec<usize> = (0..paths.len()).collect();
    order.sort_by_key(|&i| (Quantity::kind_of(paths[i]), i));
    (order[0], next(paths, &order))
}

/// Index of the number along the second axis: the next of the order that belongs to the pad of the first, or else the
/// next of all.
fn next(paths: &[&str], order: &[usize]) -> Option<usize> {
    let pad = |i: usize| paths[i].split('.').next();
    let (first, rest) = order.split_first()?;
    let same = rest.iter().find(|&&i| pad(i) == pad(*first));
    same.or(rest.first()).copied()
}

impl Map {
    /// Computes the map with `points` points along each axis; the other numbers have the shares `at`.
    pub(super) fn through(
        search: &Search<'_>,
        at: &[f64],
        points: usize,
        progress: Progress<'_>,
    ) -> Self {
        let paths: Vec<&str> = search.freed.iter().map(|f| f.parameter.path()).collect();
        let (x, y) = axes(&paths);
        let even = even_speeds((0.0, 1.0), points);
        let y_shares = match y {
            Some(_) => even.clone(),
            None => vec![0.5],
        };
        let values = |k: usize, shares: &[f64]| -> Vec<f64> {
            shares.iter().map(|s| search.freed[k].value(*s)).collect()
        };
        let mut map = Map {
            x_path: paths[x].to_owned(),
            x: values(x, &even),
            y_path: y.map(|y| paths[y].to_owned()),
            y: y.map_or(vec![0.0], |y| values(y, &y_shares)),
            outcomes: Vec::new(),
            shares: [even, y_shares],
            axes: (x, y),
            at: at.to_vec(),
        };
        let (columns, total) = (map.x.len(), map.x.len() * map.y.len());
        let shares_of = |index| map.shares_of(index);
        let see = |done| progress("map", done, total);
        let flat = search.outcomes(total, shares_of, &see, |_, outcome| outcome);
        map.outcomes = flat.chunks(columns).map(<[_]>::to_vec).collect();
        map
    }

    /// Shares of the cell `index`, counted row by row.
    fn shares_of(&self, index: usize) -> Vec<f64> {
        let ((x, y), [x_shares, y_shares]) = (self.axes, &self.shares);
        let mut shares = self.at.clone();
        shares[x] = x_shares[index % x_shares.len()];
        if let Some(y) = y {
            shares[y] = y_shares[index / x_shares.len()];
        }
        shares
    }

    /// The computed saws of the map, best first.
    pub(super) fn cells(&self) -> Vec<Tried> {
        let cells = self.outcomes.iter().flatten().enumerate();
        let cells = cells.map(|(k, outcome)| Tried::new(self.shares_of(k), outcome.as_ref()));
        let mut cells: Vec<Tried> = cells.collect();
        cells.sort_by(|x, y| x.cost.total_cmp(&y.cost));
        cells
    }
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
        assert_eq!(axes(&paths), (1, Some(3)));
        assert_eq!(axes(&paths[..3]), (1, Some(0)));
        assert_eq!(axes(&["blade.thickness_m"]), (0, None));
    }
}
