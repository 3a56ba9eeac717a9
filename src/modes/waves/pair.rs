//! All eigenvalues of the reduced model within the reach at once, as an invariant pair.
//!
//! The quadratic problem K̃ + λC̃ + λ²M̃ has the companion matrix A of the states (x, λx). With all its vectors,
//! A [V V′] = [V V′] diag(B₀, B′), where V are the p states with eigenvalues within the reach, [W; W′] = [V V′]⁻¹, and X, X′
//! the upper halves of V, V′. The pair (X + X′Z, B) with
//!
//! B = B₀ − Y R,  B′Z − ZB = Y′R,  R = Σ_{k≥3} s_k (X + X′Z) Bᵏ,  W = [·, Y M̃],  W′ = [·, Y′M̃]
//!
//! then solves Σ L_k X Bᵏ = 0 with all terms (T. Betcke and D. Kressner, *Perturbation, extraction and refinement of invariant
//! pairs for matrix polynomials*, Linear Algebra Appl. 435, 2011). In contrast to a correction of one eigenvalue after the
//! other this also holds where two of them coalesce.

use faer::linalg::solvers::Solve;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Mat, MatRef, Par, Scale, Side, c64};

use crate::model::linalg::{LinalgError, RealEigen};
use crate::modes::half_order::{hamiltonian_eigenpairs, hamiltonian_matrix};
use crate::modes::vectors::{product, smallest};

/// |λ| in windows between which the widest gap ends the pair: beyond it the series in λ is inaccurate, and an eigenvalue next to
/// the end slows the iteration.
pub(super) const END: [f64; 2] = [1.2, 1.8];
/// Change of B in the last step, in windows; each step leaves a tenth of the error.
const SETTLED: f64 = 1e-12;
/// Number of terms of the quadratic problem.
const QUADRATIC: usize = 3;
/// Largest number of steps.
const STEPS: usize = 16;
/// Largest residual of a pair whose B has not settled within these steps, relative to its terms. That of rigid motions that nothing
/// holds, whose zeros are defective, is the root of rounding, 6e-7; that of a pair that is no solution is near one.
const LARGEST_RESIDUAL: f64 = 1e-4;

/// The pair with its left vectors.
pub(super) struct Pair {
    /// Displacements X, m × p.
    pub x: Mat<f64>,
    /// Left vectors Y of the quadratic problem, p × m.
    pub y: Mat<f64>,
    /// B, p × p.
    pub b: Mat<f64>,
}

/// States of the quadratic problem.
struct States {
    /// X, m × p, real and imaginary parts of conjugates as two columns.
    x: Mat<f64>,
    /// Y, p × m.
    y: Mat<f64>,
    /// Eigenvalues, conjugates side by side, the one with Im λ > 0 first.
    values: Vec<c64>,
}

impl Pair {
    /// The pair of the matrices L₀, L₁, … side by side; `None` without eigenvalues within the reach.
    ///
    /// # Errors
    /// [`LinalgError`] if a decomposition fails, or if the iteration ends before its equation is solved.
    pub fn new(terms: MatRef<'_, f64>, is_conservative: bool) -> Result<Option<Self>, LinalgError> {
        let size = terms.nrows();
        let quadratic = [0, 1, 2].map(|power| terms.subcols(power * size, size));
        let symmetric = is_conservative
            .then(|| symmetric_states(quadratic))
            .transpose()?
            .flatten();
        let states = match symmetric {
            Some(states) => states,
            None => States::of(quadratic)?,
        };
        let (kept, others) = states.parted();
        if kept.values.is_empty() {
            return Ok(None);
        }
        let first = diagonal(&kept.values);
        let (mut x, mut b) = (kept.x.clone(), first.clone());
        let mut z = Mat::zeros(others.values.len(), b.ncols());
        let higher = terms.subcols(QUADRATIC * size, terms.ncols() - QUADRATIC * size);
        let mut powers = Mat::zeros(higher.ncols(), b.ncols());
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let mut power = &x * &b * &b * &b;
            for row in (0..higher.ncols()).step_by(size) {
                powers.subrows_mut(row, size).copy_from(&power);
                power = power * &b;
            }
            let rest = higher * &powers;
            let next = &first - &kept.y * &rest;
            let change = (&next - &b).norm_max();
            // Z B = Z B₀ + Z (B − B₀), whose last part is small.
            let right = &others.y * &rest + &z * (&next - &first);
            z = divided(&right, &others.values, &kept.values);
            x = &kept.x + &others.x * &z;
            b = next;
            last = change;
            if change <= SETTLED {
                break;
            }
        }
        // The rounding of A, where it is not normal, may be larger than the last change.
        if last > SETTLED {
            let error = residual(terms, &x, &b);
            if error.is_nan() || error > LARGEST_RESIDUAL {
                return Err(LinalgError::Inaccurate {
                    values: "eigenvalues of the reduced model",
                    order: size,
                    error,
                });
            }
        }
        Ok(Some(Pair { x, y: kept.y, b }))
    }
}

/// ‖Σ L_k X Bᵏ‖ relative to the largest of its terms.
fn residual(terms: MatRef<'_, f64>, x: &Mat<f64>, b: &Mat<f64>) -> f64 {
    let size = x.nrows();
    let mut power = x.clone();
    let (mut sum, mut largest) = (Mat::<f64>::zeros(size, x.ncols()), 0.0_f64);
    for first in (0..terms.ncols()).step_by(size) {
        let term = terms.subcols(first, size) * &power;
        largest = largest.max(term.norm_l2());
        sum += term;
        power = &power * b;
    }
    sum.norm_l2() / largest
}

impl States {
    /// All states.
    fn of(
        [stiffness, velocity, inertia]: [MatRef<'_, f64>; QUADRATIC],
    ) -> Result<Self, LinalgError> {
        let size = stiffness.nrows();
        let inertia = inertia.partial_piv_lu();
        let [stiffness, velocity] = [stiffness, velocity].map(|term| inertia.solve(term));
        let companion = Mat::from_fn(2 * size, 2 * size, |i, k| match (i < size, k < size) {
            (true, true) => 0.0,
            (true, false) => f64::from(u8::from(i + size == k)),
            (false, true) => -stiffness[(i - size, k)],
            (false, false) => -velocity[(i - size, k - size)],
        });
        let eigen = RealEigen::new(companion.as_ref())?;
        let (right, left) = (columns(&eigen), inverse(&eigen));
        let lower = left.subcols(size, size).transpose().to_owned();
        Ok(States {
            x: right.subrows(0, size).to_owned(),
            y: inertia.solve_transpose(lower).transpose().to_owned(),
            values: eigen.values,
        })
    }

    /// The states within the reach and all others.
    fn parted(&self) -> (Self, Self) {
        let reach = reach(&self.values);
        let of = |places: &[usize]| States {
            x: Mat::from_fn(self.x.nrows(), places.len(), |i, k| self.x[(i, places[k])]),
            y: Mat::from_fn(places.len(), self.y.ncols(), |i, k| self.y[(places[i], k)]),
            values: places.iter().map(|i| self.values[*i]).collect(),
        };
        let is_kept = |i: &usize| self.values[*i].norm() < reach;
        let (kept, others): (Vec<usize>, Vec<usize>) = (0..self.values.len()).partition(is_kept);
        (of(&kept), of(&others))
    }
}

/// All states of a problem without damping, by an eigenproblem of half the order: K̃ and M̃ are symmetric and C̃ is skew, so that
/// L(λ)ᴴ = L(−λ̄), and the left vector of λ is the right one of −λ̄. `None` if M̃ is not positive definite, or if two λ² are close to
/// one another or to zero.
fn symmetric_states(terms: [MatRef<'_, f64>; QUADRATIC]) -> Result<Option<States>, LinalgError> {
    let size = terms[0].nrows();
    let even = |matrix: MatRef<'_, f64>| Scale(0.5) * (matrix + matrix.transpose());
    let Ok(factors) = even(terms[2]).llt(Side::Lower) else {
        return Ok(None);
    };
    let root = factors.L();
    let reduced = |matrix: MatRef<'_, f64>| {
        let mut half = matrix.to_owned();
        solve_lower_triangular_in_place(root, half.as_mut(), Par::Seq);
        let mut half = half.transpose().to_owned();
        solve_lower_triangular_in_place(root, half.as_mut(), Par::Seq);
        half.transpose().to_owned()
    };
    let stiffness = even(reduced(terms[0]).as_ref());
    let velocity = reduced(terms[1]);
    let velocity = Scale(0.5) * (&velocity - velocity.transpose());
    let (matrix, scale) = hamiltonian_matrix(&stiffness, &velocity);
    let Some(found) = hamiltonian_eigenpairs(matrix.as_ref())? else {
        return Ok(None);
    };
    let mut shapes = found.halves.subrows(0, size).to_owned();
    solve_upper_triangular_in_place(root.transpose(), shapes.as_mut(), Par::Seq);
    let lambdas: Vec<c64> = found.lambdas.iter().map(|lambda| lambda * scale).collect();
    let [by_velocity, by_inertia] = [1, 2].map(|power| terms[power] * &shapes);
    let mut states = States {
        x: Mat::zeros(size, 2 * size),
        y: Mat::zeros(2 * size, size),
        values: Vec::new(),
    };
    for (k, lambda) in lambdas.iter().enumerate() {
        let mirrored =
            smallest(0..lambdas.len(), |i| (lambdas[*i] + lambda.conj()).norm()).unwrap_or(k);
        let form = |all: &Mat<f64>| product(&shapes, mirrored, all, k);
        let by_root = form(&by_velocity) + 2.0 * lambda * form(&by_inertia);
        let is_real = lambda.im == 0.0;
        let at = states.values.len();
        for i in 0..size {
            let left =
                c64::new(shapes[(i, 2 * mirrored)], -shapes[(i, 2 * mirrored + 1)]) / by_root;
            states.x[(i, at)] = shapes[(i, 2 * k)];
            if is_real {
                states.y[(at, i)] = left.re;
            } else {
                states.x[(i, at + 1)] = shapes[(i, 2 * k + 1)];
                states.y[(at, i)] = 2.0 * left.re;
                states.y[(at + 1, i)] = -2.0 * left.im;
            }
        }
        states.values.push(*lambda);
        if !is_real {
            states.values.push(lambda.conj());
        }
    }
    Ok((states.values.len() == 2 * size).then_some(states))
}

/// Middle of the widest gap between magnitudes within [`END`].
fn reach(values: &[c64]) -> f64 {
    let mut sizes: Vec<f64> = values.iter().map(|value| value.norm()).collect();
    sizes.retain(|size| (END[0]..END[1]).contains(size));
    sizes.extend(END);
    sizes.sort_by(f64::total_cmp);
    let gaps = sizes.windows(2).map(|ends| [ends[1] - ends[0], ends[0]]);
    let widest = gaps.max_by(|x, y| x[0].total_cmp(&y[0]));
    widest.map_or(END[0], |[gap, from]| from + 0.5 * gap)
}

/// A (r, s) = (r, s) [a b; −b a] for the real and the imaginary part of the vector of a + ib.
fn diagonal(values: &[c64]) -> Mat<f64> {
    let mut b = Mat::zeros(values.len(), values.len());
    for (k, value) in values.iter().enumerate() {
        b[(k, k)] = value.re;
        if value.im > 0.0 {
            b[(k, k + 1)] = value.im;
        } else if value.im < 0.0 {
            b[(k, k - 1)] = value.im;
        }
    }
    b
}

/// Z with B′Z − ZB = F, where B′ and B are [`diagonal`] of these values.
fn divided(f: &Mat<f64>, rows: &[c64], columns: &[c64]) -> Mat<f64> {
    let mut z = Mat::zeros(rows.len(), columns.len());
    let width = |value: c64| if value.im == 0.0 { 1 } else { 2 };
    for (k, mu) in columns.iter().enumerate().filter(|(_, mu)| mu.im >= 0.0) {
        for (i, nu) in rows.iter().enumerate().filter(|(_, nu)| nu.im >= 0.0) {
            let size = (width(*nu), width(*mu));
            let at = |row: usize, column: usize| {
                if row < size.0 && column < size.1 {
                    f[(i + row, k + column)]
                } else {
                    0.0
                }
            };
            // (r − is) F (u + iv) and its mirror image are divided by ν − μ and ν̄ − μ.
            let (even, odd) = (at(0, 0) + at(1, 1), at(0, 1) - at(1, 0));
            let turned = c64::new(even, odd) / (nu - mu);
            let (even, odd) = (at(0, 0) - at(1, 1), at(0, 1) + at(1, 0));
            let mirrored = c64::new(even, odd) / (nu.conj() - mu);
            let (sum, difference) = (0.5 * (turned + mirrored), 0.5 * (mirrored - turned));
            let block = [[sum.re, sum.im], [difference.im, -difference.re]];
            for row in 0..size.0 {
                for column in 0..size.1 {
                    z[(i + row, k + column)] = block[row][column];
                }
            }
        }
    }
    z
}

/// Columns of all vectors: that of a real λ, the real and the imaginary part for a pair.
fn columns(eigen: &RealEigen) -> Mat<f64> {
    let halves = eigen.halves_of(&eigen.upper());
    let mut place = Vec::new();
    for (k, i) in eigen.upper().into_iter().enumerate() {
        place.push(2 * k);
        if eigen.values[i].im > 0.0 {
            place.push(2 * k + 1);
        }
    }
    Mat::from_fn(halves.nrows(), place.len(), |i, k| halves[(i, place[k])])
}

/// Inverse of the columns of all vectors.
pub(super) fn inverse(eigen: &RealEigen) -> Mat<f64> {
    let columns = columns(eigen);
    let size = columns.nrows();
    columns
        .partial_piv_lu()
        .solve(Mat::<f64>::identity(size, size))
}
