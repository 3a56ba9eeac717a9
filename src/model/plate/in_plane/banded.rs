//! Symmetric positive definite band matrices.
//!
//! The libraries in use have only dense and sparse factorizations. A harmonic of high order has twenty elements,
//! for which a dense factorization takes a hundred times the work.

/// A symmetric band matrix, of which the lower triangle is stored.
pub struct Banded {
    /// Columns i − width + 1 … i of each row i.
    rows: Vec<Vec<f64>>,
    width: usize,
}

impl Banded {
    /// The zero matrix with `width` diagonals at and below the main one.
    pub fn new(order: usize, width: usize) -> Self {
        Banded {
            rows: vec![vec![0.0; width]; order],
            width,
        }
    }

    /// Adds to an entry of the lower triangle.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        self.rows[row][column + self.width - 1 - row] += value;
    }

    /// Fixes an unknown at zero, if the caller sets its right side to zero.
    pub fn fix(&mut self, unknown: usize) {
        let end = self.rows.len().min(unknown + self.width);
        for row in unknown..end {
            self.rows[row][unknown + self.width - 1 - row] = 0.0;
        }
        self.rows[unknown].fill(0.0);
        self.rows[unknown][self.width - 1] = 1.0;
    }

    /// Cholesky factor, which has NaN entries if the matrix is not positive definite.
    pub fn factored(mut self) -> BandedFactor {
        let (order, width) = (self.rows.len(), self.width);
        for i in 0..order {
            for j in first(i, width)..=i {
                let start = first(i, width).max(first(j, width));
                let (low, high) = self.rows.split_at(i);
                let own = &high[0];
                let other = if j == i { own } else { &low[j] };
                let left = &own[start + width - 1 - i..j + width - 1 - i];
                let right = &other[start + width - 1 - j..width - 1];
                let sum: f64 = left.iter().zip(right).map(|(x, y)| x * y).sum();
                let rest = own[j + width - 1 - i] - sum;
                self.rows[i][j + width - 1 - i] = if i == j {
                    rest.sqrt()
                } else {
                    rest / other[width - 1]
                };
            }
        }
        BandedFactor(self)
    }
}

/// First column of a row within the band.
fn first(row: usize, width: usize) -> usize {
    (row + 1).saturating_sub(width)
}

/// Cholesky factor of a [`Banded`] matrix.
pub struct BandedFactor(Banded);

impl BandedFactor {
    /// Replaces `columns` right sides, stored row by row, by the solutions.
    pub fn solve(&self, x: &mut [f64], columns: usize) {
        let (rows, width) = (&self.0.rows, self.0.width);
        for i in 0..rows.len() {
            let (known, rest) = x.split_at_mut(columns * i);
            let own = &mut rest[..columns];
            for j in first(i, width)..i {
                let factor = rows[i][j + width - 1 - i];
                subtract(own, factor, &known[columns * j..columns * (j + 1)]);
            }
            own.iter_mut().for_each(|x| *x /= rows[i][width - 1]);
        }
        for i in (0..rows.len()).rev() {
            let (before, rest) = x.split_at_mut(columns * i);
            let own = &mut rest[..columns];
            own.iter_mut().for_each(|x| *x /= rows[i][width - 1]);
            for j in first(i, width)..i {
                let factor = rows[i][j + width - 1 - i];
                subtract(&mut before[columns * j..columns * (j + 1)], factor, own);
            }
        }
    }
}

fn subtract(from: &mut [f64], factor: f64, row: &[f64]) {
    for (x, y) in from.iter_mut().zip(row) {
        *x -= factor * y;
    }
}
