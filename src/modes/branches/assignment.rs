//! Pairs of two lists with the least total cost, each element in one pair.

/// Column of each row in the assignment of least total cost, for a square matrix of finite costs, by shortest
/// augmenting paths with dual prices.
///
/// References: Kuhn, Naval Research Logistics Quarterly 2, 1955; Jonker and Volgenant,
/// Computing 38, 1987.
pub fn cheapest(costs: &[Vec<f64>]) -> Vec<usize> {
    let size = costs.len();
    // Rows and columns are numbered from 1. Every path starts at the additional column 0, and a column whose
    // row is 0 is free.
    let (mut row_price, mut column_price) = (vec![0.0; size + 1], vec![0.0; size + 1]);
    let mut row_of = vec![0; size + 1];
    for row in 1..=size {
        row_of[0] = row;
        let (mut column, mut least) = (0, vec![f64::INFINITY; size + 1]);
        let (mut before, mut done) = (vec![0; size + 1], vec![false; size + 1]);
        while row_of[column] != 0 {
            done[column] = true;
            let (from, mut step, mut next) = (row_of[column], f64::INFINITY, column);
            for k in (1..=size).filter(|k| !done[*k]) {
                let reduced = costs[from - 1][k - 1] - row_price[from] - column_price[k];
                if reduced < least[k] {
                    (least[k], before[k]) = (reduced, column);
                }
                if least[k] < step {
                    (step, next) = (least[k], k);
                }
            }
            if next == column {
                // The path can reach no further column only if costs are not finite; the assignment is then
                // incomplete.
                break;
            }
            for k in 0..=size {
                if done[k] {
                    row_price[row_of[k]] += step;
                    column_price[k] -= step;
                } else {
                    least[k] -= step;
                }
            }
            column = next;
        }
        while column != 0 {
            row_of[column] = row_of[before[column]];
            column = before[column];
        }
    }
    let mut column_of = vec![0; size];
    for (column, row) in row_of[1..].iter().enumerate() {
        if let Some(row) = row.checked_sub(1) {
            column_of[row] = column;
        }
    }
    column_of
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn total(costs: &[Vec<f64>], columns: &[usize]) -> f64 {
        columns.iter().enumerate().map(|(i, k)| costs[i][*k]).sum()
    }

    /// Least total cost, from all permutations.
    fn least(costs: &[Vec<f64>], row: usize, free: &mut Vec<usize>) -> f64 {
        if row == costs.len() {
            return 0.0;
        }
        let mut best = f64::INFINITY;
        for place in 0..free.len() {
            let column = free.remove(place);
            best = best.min(costs[row][column] + least(costs, row + 1, free));
            free.insert(place, column);
        }
        best
    }

    proptest! {
        #[test]
        fn no_permutation_is_cheaper(
            costs in (1_usize..7).prop_flat_map(|n| {
                prop::collection::vec(prop::collection::vec(-3.0..9.0_f64, n), n)
            })
        ) {
            let columns = cheapest(&costs);
            let mut sorted = columns.clone();
            sorted.sort_unstable();
            prop_assert_eq!(sorted, (0..costs.len()).collect::<Vec<_>>());
            let best = least(&costs, 0, &mut (0..costs.len()).collect());
            prop_assert!((total(&costs, &columns) - best).abs() < 1e-9);
        }
    }
}
