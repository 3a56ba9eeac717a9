//! Symmetric block tridiagonal matrices: elements between circles couple only neighbouring circles.

use std::ops::Range;

use faer::linalg::solvers::{Llt, Solve};
use faer::{Mat, Side};

/// A symmetric matrix of blocks on and below the diagonal; block i + 1 is coupled with block i alone.
pub struct Chain {
    diagonal: Vec<Mat<f64>>,
    /// Rows of block i + 1, columns of block i.
    below: Vec<Mat<f64>>,
    /// Index of the first unknown of each block, and the number of all.
    first: Vec<usize>,
}

/// Place of an unknown: the block, and the index in it.
pub type Place = (usize, usize);

/// A factorized matrix, block LDLᵀ.
pub struct Factors {
    /// Factors of the Schur complements Sᵢ.
    complements: Vec<Llt<f64>>,
    /// Xᵢ = Sᵢ⁻¹Bᵢᵀ with the blocks Bᵢ below the diagonal.
    passed: Vec<Mat<f64>>,
    first: Vec<usize>,
}

impl Chain {
    /// A matrix of zeros with blocks of these orders.
    pub fn zeros(orders: &[usize]) -> Self {
        let mut first = vec![0];
        for order in orders {
            first.push(first[first.len() - 1] + order);
        }
        Chain {
            diagonal: orders.iter().map(|n| Mat::zeros(*n, *n)).collect(),
            below: orders.windows(2).map(|n| Mat::zeros(n[1], n[0])).collect(),
            first,
        }
    }

    /// Number of unknowns.
    pub fn order(&self) -> usize {
        self.first[self.first.len() - 1]
    }

    /// Index of an unknown.
    pub fn index(&self, (block, index): Place) -> usize {
        self.first[block] + index
    }

    /// Adds to an entry of a diagonal block or of a block below the diagonal; one above it is that of its mirror image.
    pub fn add(&mut self, (i, row): Place, (k, column): Place, value: f64) {
        if i == k {
            self.diagonal[i][(row, column)] += value;
        } else if i == k + 1 {
            self.below[k][(row, column)] += value;
        }
    }

    /// The matrix plus a multiple of another one with the same blocks.
    pub fn plus(&self, factor: f64, other: &Chain) -> Chain {
        let sum = |one: &[Mat<f64>], other: &[Mat<f64>]| {
            let pairs = one.iter().zip(other);
            pairs.map(|(x, y)| x + faer::Scale(factor) * y).collect()
        };
        Chain {
            diagonal: sum(&self.diagonal, &other.diagonal),
            below: sum(&self.below, &other.below),
            first: self.first.clone(),
        }
    }

    /// The product with the columns of a matrix.
    pub fn times(&self, columns: &Mat<f64>) -> Mat<f64> {
        let mut product = Mat::zeros(columns.nrows(), columns.ncols());
        for (i, diagonal) in self.diagonal.iter().enumerate() {
            let own = rows(&self.first, i);
            let mut sum = diagonal * columns.subrows(own.start, own.len());
            if i > 0 {
                let inner = rows(&self.first, i - 1);
                sum += &self.below[i - 1] * columns.subrows(inner.start, inner.len());
            }
            if let Some(below) = self.below.get(i) {
                let outer = rows(&self.first, i + 1);
                sum += below.transpose() * columns.subrows(outer.start, outer.len());
            }
            product.subrows_mut(own.start, own.len()).copy_from(&sum);
        }
        product
    }

    /// The factorized matrix; `None` if it is not positive definite.
    pub fn factorized(&self) -> Option<Factors> {
        let mut complements: Vec<Llt<f64>> = Vec::with_capacity(self.diagonal.len());
        let mut passed: Vec<Mat<f64>> = Vec::with_capacity(self.below.len());
        for (i, diagonal) in self.diagonal.iter().enumerate() {
            let complement = match i.checked_sub(1) {
                Some(inner) => diagonal - &self.below[inner] * &passed[inner],
                None => diagonal.clone(),
            };
            let factors = complement.llt(Side::Lower).ok()?;
            if let Some(below) = self.below.get(i) {
                passed.push(factors.solve(below.transpose()));
            }
            complements.push(factors);
        }
        Some(Factors {
            complements,
            passed,
            first: self.first.clone(),
        })
    }
}

impl Factors {
    /// The solutions for the right sides in the columns of a matrix.
    pub fn solved(&self, right: &Mat<f64>) -> Mat<f64> {
        let mut solution = right.clone();
        let last = self.complements.len() - 1;
        for (i, passed) in self.passed.iter().enumerate() {
            let [own, outer] = [i, i + 1].map(|i| rows(&self.first, i));
            let carried = passed.transpose() * solution.subrows(own.start, own.len());
            let mut rest = solution.subrows_mut(outer.start, outer.len());
            rest -= carried;
        }
        for i in (0..=last).rev() {
            let own = rows(&self.first, i);
            let mut found = self.complements[i].solve(solution.subrows(own.start, own.len()));
            if i < last {
                let outer = rows(&self.first, i + 1);
                found -= &self.passed[i] * solution.subrows(outer.start, outer.len());
            }
            solution.subrows_mut(own.start, own.len()).copy_from(&found);
        }
        solution
    }
}

fn rows(first: &[usize], block: usize) -> Range<usize> {
    first[block]..first[block + 1]
}
