//! Power series in λ with matrices as coefficients, and their Schur complement.
//!
//! L(λ) = L₀ + λL₁ + λ²L₂ + …. With the unknowns that are kept first and those that are eliminated last,
//! L = [A B; C F], the Schur complement is
//!
//! S(λ) = A − B G,  F G = C,  G_k = F₀⁻¹ (C_k − Σ_{j≥1} F_j G_{k−j}),  S_k = A_k − Σ_i B_i G_{k−i}:
//!
//! one LU factorization of F₀ and products with as many columns as unknowns are kept. Series are truncated, so that
//! a complement of a complement has the same coefficients as one of both at once. λ is in units of the window.

use std::ops::Range;

use faer::linalg::matmul::matmul;
use faer::linalg::solvers::Solve;
use faer::{Accum, Mat, MatRef, Par};

/// Number of coefficients of a series. With 8 the worst eigenvalue of the window is off by 2e-6 of it, with 12 by 3e-8, with
/// 16 by 6e-10; those of the lower half by 1e-11 with any of these.
pub const TERMS: usize = 16;
/// Number of coefficients of a quadratic eigenproblem.
pub const QUADRATIC: usize = 3;

/// Coefficients by ascending power of λ; `None` for zero.
#[derive(Debug, Clone, Default)]
pub struct Series(pub [Option<Mat<f64>>; TERMS]);

impl Series {
    /// Coefficient of λᵏ.
    pub fn term(&self, power: usize) -> Option<MatRef<'_, f64>> {
        self.0[power].as_ref().map(Mat::as_ref)
    }

    /// Coefficient of λᵏ, set to zero if there is none yet.
    pub fn term_mut(&mut self, power: usize, rows: usize, columns: usize) -> &mut Mat<f64> {
        self.0[power].get_or_insert_with(|| Mat::zeros(rows, columns))
    }

    /// Coefficient of λᵏ, zero if there is none.
    pub fn dense(&self, power: usize, rows: usize, columns: usize) -> Mat<f64> {
        self.0[power]
            .clone()
            .unwrap_or_else(|| Mat::zeros(rows, columns))
    }
}

/// Adds `sign` times a product.
fn add_product(into: &mut Mat<f64>, left: MatRef<'_, f64>, right: MatRef<'_, f64>, sign: f64) {
    matmul(into.as_mut(), Accum::Add, left, right, sign, Par::Seq);
}

/// Coupling of the eliminated unknowns with those that are kept, and with one another.
pub struct Eliminated<'a> {
    /// Rows of the kept unknowns, columns of the eliminated ones.
    pub kept_by_far: &'a Series,
    /// Rows of the eliminated unknowns, columns of the kept ones.
    pub far_by_kept: &'a Series,
    /// The eliminated unknowns.
    pub far: &'a Series,
}

/// Subtracts B F⁻¹ C from A.
pub fn eliminate(kept: &mut Series, parts: &Eliminated<'_>) {
    let Eliminated {
        kept_by_far: b,
        far_by_kept: c,
        far,
    } = parts;
    let Some(leading) = far.term(0) else { return };
    let count = leading.nrows();
    let columns = c.0.iter().flatten().map(Mat::ncols).max().unwrap_or(0);
    let rows = b.0.iter().flatten().map(Mat::nrows).max().unwrap_or(0);
    if count == 0 || columns == 0 {
        return;
    }
    let factors = leading.partial_piv_lu();
    let mut solved: Vec<Mat<f64>> = Vec::with_capacity(TERMS);
    for power in 0..TERMS {
        let mut right = c.dense(power, count, columns);
        for j in 1..=power {
            if let Some(term) = far.term(j) {
                add_product(&mut right, term, solved[power - j].as_ref(), -1.0);
            }
        }
        factors.solve_in_place(&mut right);
        solved.push(right);
        for i in 0..=power {
            if let Some(term) = b.term(i) {
                let into = kept.term_mut(power, rows, columns);
                add_product(into, term, solved[power - i].as_ref(), -1.0);
            }
        }
    }
}

impl Series {
    /// The Schur complement on the first `count` unknowns.
    pub fn onto_first(&self, count: usize) -> Series {
        let part = |rows: Range<usize>, columns: Range<usize>| {
            let of = |m: &Mat<f64>| m.get(rows.clone(), columns.clone()).to_owned();
            Series(self.0.each_ref().map(|term| term.as_ref().map(of)))
        };
        let order = self.0.iter().flatten().map(Mat::nrows).max().unwrap_or(0);
        let (kept, far) = (0..count, count..order);
        let mut reduced = part(kept.clone(), kept.clone());
        let parts = Eliminated {
            kept_by_far: &part(kept.clone(), far.clone()),
            far_by_kept: &part(far.clone(), kept),
            far: &part(far.clone(), far),
        };
        eliminate(&mut reduced, &parts);
        reduced
    }
}
