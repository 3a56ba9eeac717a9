//! (A − σ)⁻¹ and (A² − σ²)⁻¹, from one factorization of L(σ) = σ² + σD + K.
//!
//! (A − σ)⁻¹(x, y): u = −L(σ)⁻¹((D + σ)x + y), v = x + σu. Without dampers D is skew and K symmetric, so
//! that L(−σ) = L(σ)ᵀ.

use faer::linalg::solvers::DenseSolveCore;
use faer::{Col, ColRef, Mat, MatRef, Scale, c64};

use crate::model::system::GyroscopicSystem;
use crate::modes::full_model::{Elimination, FullModel};
use crate::modes::vectors::Eigenpair;

/// Number of steps, beyond the number of requested eigenvalues, before the first check, which costs as much
/// as all steps before it: most saws need no second one.
const STEPS_BEYOND: usize = 44;
/// [`STEPS_BEYOND`] for the operator with two solves per step.
const SQUARED_STEPS_BEYOND: usize = 20;

/// The operator of Arnoldi's iteration, in units of σ, and the relation of its eigenvalues to those of A.
pub(super) trait Operator {
    /// Number of rows of the operator.
    fn order(&self) -> usize;

    /// Largest number of vectors of the iteration.
    fn most_vectors(order: usize) -> usize;

    /// Number of steps, beyond the number of requested eigenvalues, before the first check.
    fn steps_beyond() -> usize;

    /// Product of the operator and a vector.
    fn apply(&self, z: ColRef<'_, f64>) -> Col<f64>;

    /// Removes rounding errors from the next vector of a basis.
    fn clear(&self, span: MatRef<'_, f64>, next: &mut Col<f64>);

    /// Eigenpairs (λ, q) of A, λ in units of σ, that belong to an eigenvalue of the operator, from the real and
    /// the imaginary part of its vector. Pairs with Im λ < 0 may be included.
    fn pairs(&self, eigenvalue: c64, re: Col<f64>, im: Col<f64>) -> Vec<Eigenpair>;
}

/// (A − σ)⁻¹ on (q, q̇/σ) in units of σ: eigenvalues σ/(λ − σ).
pub(super) struct ShiftedInverse {
    inverse: Inverse,
    /// D/σ.
    velocity: Velocity,
}

/// (L(σ)/σ²)⁻¹ in one of two representations.
enum Inverse {
    /// Explicit inverse: a product takes half the time of two triangular solves, which pays off for a few dozen
    /// products.
    Dense(Mat<f64>),
    /// L(σ) eliminated by blocks and columns, and σ².
    Structured(Box<Elimination<f64>>, f64),
}

impl Inverse {
    fn order(&self) -> usize {
        match self {
            Inverse::Dense(inverse) => inverse.nrows(),
            Inverse::Structured(elimination, _) => elimination.order(),
        }
    }

    fn times(&self, load: &Col<f64>) -> Col<f64> {
        match self {
            Inverse::Dense(inverse) => inverse * load,
            Inverse::Structured(elimination, square) => {
                Scale(*square) * elimination.solve(load.as_mat()).col(0)
            }
        }
    }

    fn transposed_times(&self, load: &Col<f64>) -> Col<f64> {
        match self {
            Inverse::Dense(inverse) => inverse.transpose() * load,
            Inverse::Structured(elimination, square) => {
                Scale(*square) * elimination.solve_transposed(load.as_mat()).col(0)
            }
        }
    }
}

/// D/σ, sparse if possible.
enum Velocity {
    /// Non-zero entries of the matrix: (row, column, value). Without dampers there are at most two in a row.
    Sparse(Vec<(usize, usize, f64)>),
    /// All entries: a damper under the blade couples all unknowns.
    Dense(Mat<f64>),
}

impl Velocity {
    fn new(matrix: Mat<f64>) -> Self {
        let size = matrix.nrows();
        let entries = || {
            let places = (0..size).flat_map(|k| (0..size).map(move |i| (i, k)));
            let entries = places.map(|(i, k)| (i, k, matrix[(i, k)]));
            entries.filter(|(_, _, value)| *value != 0.0)
        };
        // The sparse form is only used for few entries, because each takes three times the memory of a number
        // and is accessed out of order.
        if entries().count() <= size * size / 8 {
            return Velocity::Sparse(entries().collect());
        }
        Velocity::Dense(matrix)
    }

    /// sum += factor · matrix · x.
    fn add_product(&self, factor: f64, x: ColRef<'_, f64>, sum: &mut Col<f64>) {
        match self {
            Velocity::Dense(matrix) => *sum += Scale(factor) * (matrix * x),
            Velocity::Sparse(entries) => {
                for &(i, k, value) in entries {
                    sum[i] += factor * value * x[k];
                }
            }
        }
    }
}

impl ShiftedInverse {
    pub fn new(system: &GyroscopicSystem, speed_rad_per_s: f64, shift_per_s: f64) -> Self {
        let size = system.order();
        let velocity = Scale(1.0 / shift_per_s) * system.velocity_at(speed_rad_per_s);
        let stiffness = system.stiffness_at(speed_rad_per_s);
        let mut dynamic = Scale(shift_per_s.powi(-2)) * stiffness + &velocity;
        (0..size).for_each(|i| dynamic[(i, i)] += 1.0);
        ShiftedInverse {
            inverse: Inverse::Dense(dynamic.partial_piv_lu().inverse()),
            velocity: Velocity::new(velocity),
        }
    }

    /// The operator of an undamped blade by the structure of its matrices, without the part of the guides
    /// that their columns neglect. `None` without such a structure.
    pub fn by_structure(full: &FullModel, speed_rad_per_s: f64, shift_per_s: f64) -> Option<Self> {
        let elimination = full.eliminated(speed_rad_per_s, shift_per_s)?;
        Some(ShiftedInverse {
            inverse: Inverse::Structured(Box::new(elimination), shift_per_s.powi(2)),
            velocity: Velocity::Sparse(full.turning(speed_rad_per_s / shift_per_s)),
        })
    }
}

impl Operator for ShiftedInverse {
    fn order(&self) -> usize {
        2 * self.inverse.order()
    }

    fn most_vectors(order: usize) -> usize {
        order
    }

    fn steps_beyond() -> usize {
        STEPS_BEYOND
    }

    fn apply(&self, z: ColRef<'_, f64>) -> Col<f64> {
        let size = self.inverse.order();
        let (x, y) = z.split_at_row(size);
        let mut load = x + y;
        self.velocity.add_product(1.0, x, &mut load);
        let u = self.inverse.times(&load);
        Col::from_fn(2 * size, |i| match i.checked_sub(size) {
            Some(i) => x[i] - u[i],
            None => -u[i],
        })
    }

    fn clear(&self, _: MatRef<'_, f64>, _: &mut Col<f64>) {}

    fn pairs(&self, eigenvalue: c64, re: Col<f64>, im: Col<f64>) -> Vec<Eigenpair> {
        let q = Col::from_fn(self.inverse.order(), |i| c64::new(re[i], im[i]));
        vec![(eigenvalue.inv() + 1.0, q)]
    }
}

/// (A² − σ²)⁻¹ of an undamped blade on (q, p/σ), p = q̇ + ΩGq, in units of σ: eigenvalues
/// σ²/(λ² − σ²), each double.
pub(super) struct SquaredInverse {
    shifted: ShiftedInverse,
}

/// An eigenvector of A that is smaller than this share of its summands is rounding.
const CANCELLED: f64 = 1e-6;

impl SquaredInverse {
    pub fn new(shifted: ShiftedInverse) -> Self {
        SquaredInverse { shifted }
    }

    /// q̇/σ of a state (q, p/σ).
    fn velocity_of(&self, z: ColRef<'_, f64>) -> Col<f64> {
        let (q, p) = z.split_at_row(z.nrows() / 2);
        let mut v = p.to_owned();
        self.shifted.velocity.add_product(-0.5, q, &mut v);
        v
    }
}

impl Operator for SquaredInverse {
    fn order(&self) -> usize {
        self.shifted.order()
    }

    fn most_vectors(order: usize) -> usize {
        order / 2
    }

    fn steps_beyond() -> usize {
        SQUARED_STEPS_BEYOND
    }

    fn apply(&self, z: ColRef<'_, f64>) -> Col<f64> {
        let ShiftedInverse { inverse, velocity } = &self.shifted;
        let x = z.subrows(0, inverse.order());
        // First (u, v) = (A − σ)⁻¹z is computed, then (A + σ)⁻¹(u, v), both in units of σ.
        let mut load = self.velocity_of(z) + x;
        velocity.add_product(1.0, x, &mut load);
        let u = Scale(-1.0) * inverse.times(&load);
        let v = x + &u;
        let mut second = &v - &u;
        velocity.add_product(1.0, u.as_ref(), &mut second);
        let w = Scale(-1.0) * inverse.transposed_times(&second);
        let mut p = u - &w;
        velocity.add_product(0.5, w.as_ref(), &mut p);
        stacked(&w, &p)
    }

    /// The symplectic form vanishes on the Krylov vectors except for rounding, which would cause each λ² to
    /// be found a second time.
    fn clear(&self, span: MatRef<'_, f64>, next: &mut Col<f64>) {
        let size = span.nrows() / 2;
        let (q, p) = span.split_at_row(size);
        let (x, y) = next.as_ref().split_at_row(size);
        let shares = p.transpose() * x - q.transpose() * y;
        let (in_q, in_p) = (p * &shares, q * &shares);
        for i in 0..size {
            next[i] -= in_q[i];
            next[size + i] += in_p[i];
        }
    }

    /// For an eigenvector z of A², (A + λ)z is one of A for λ, and (A − λ)z one for −λ.
    fn pairs(&self, eigenvalue: c64, re: Col<f64>, im: Col<f64>) -> Vec<Eigenpair> {
        let square = eigenvalue.inv() + 1.0;
        let root = match square.im == 0.0 {
            true if square.re <= 0.0 => c64::new(0.0, (-square.re).sqrt()),
            true => c64::new(square.re.sqrt(), 0.0),
            false => square.sqrt(),
        };
        let (v_re, v_im) = (self.velocity_of(re.as_ref()), self.velocity_of(im.as_ref()));
        let size = v_re.nrows();
        let pair = |lambda: c64| {
            let q = Col::from_fn(size, |i| {
                c64::new(v_re[i], v_im[i]) + lambda * c64::new(re[i], im[i])
            });
            (lambda, q)
        };
        let parts = v_re.norm_l2() + v_im.norm_l2() + root.norm() * (re.norm_l2() + im.norm_l2());
        let is_sound = |pair: &Eigenpair| pair.1.norm_l2() > CANCELLED * parts;
        let mut pairs: Vec<Eigenpair> = vec![pair(root)];
        if root.re != 0.0 {
            // The pair of −λ is replaced by its conjugate, whose eigenvalue has the same imaginary part as λ.
            let (lambda, q) = pair(-root);
            pairs.push((lambda.conj(), Col::from_fn(size, |i| q[i].conj())));
        }
        pairs.retain(is_sound);
        pairs
    }
}

fn stacked(top: &Col<f64>, bottom: &Col<f64>) -> Col<f64> {
    let size = top.nrows();
    Col::from_fn(2 * size, |i| match i.checked_sub(size) {
        Some(i) => bottom[i],
        None => top[i],
    })
}
