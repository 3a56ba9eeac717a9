//! The lowest m of a large symmetric pencil A − mB, with A = K₀ of a guided blade, by its structure.
//!
//! The method is Davidson's iteration in blocks, with Ritz pairs (m, x) of the pencil on a growing span, to
//! which A⁻¹ times their residuals Ax − mBx is added. By the structure of K₀ one A⁻¹b costs O(N) instead of
//! O(N²), and the part that its few columns neglect only slows the iteration: Ritz values follow from the
//! exact matrices, and their error is the square of that of their vectors. A count of the negative
//! eigenvalues of A − mB by Sylvester's law of inertia shows that none was missed.
//!
//! E. R. Davidson, J. Comput. Phys. 17 (1975), 87–94; Y. Saad, *Numerical Methods for Large Eigenvalue
//! Problems*, 2nd ed. (2011), section 8.4.

use faer::{Col, Mat, MatRef, Scale};

use super::structured_stiffness::{self, StructuredStiffness};
use super::symmetric_pencil::singular_multiples;
use super::vectors::independent;
use super::work::Cancellation;
use crate::model::system::{GyroscopicSystem, symmetric};

/// A pencil A − mB, A = K₀ positive definite.
pub struct Pencil<'a> {
    /// K₀ and K_σ − N.
    pub system: &'a GyroscopicSystem,
    /// The structure of K₀ and K_σ − N.
    pub structure: &'a StructuredStiffness,
    /// Choice of B.
    pub softening: Softening,
}

/// Matrix B of a pencil, which softens A.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Softening {
    /// N − K_σ: m is Ω² of a critical speed.
    Rotation,
    /// The mass matrix, which is the identity: m is ω² of a mode at rest.
    Mass,
}

/// Estimated relative error at which a Ritz value is accepted.
const TOLERANCE: f64 = 1e-14;
/// Error that is accepted if rounding prevents a further decrease.
const ROUNDING: f64 = 1e-11;
/// Largest number of iterations, after which the search fails.
const MOST_ROUNDS: usize = 20;
/// Number of initial vectors of the span, and of those added if some m are missing.
const BLOCK: usize = 25;
/// Number of pairs, beyond those requested, that are improved too.
const GUARD: usize = 4;
/// Multiples up to this factor of the limit are computed too, so that a count between two of them is
/// possible.
const BEYOND: f64 = 1.01;
/// Directions closer to the span than this are omitted.
const INDEPENDENT: f64 = 1e-10;

/// Ritz pairs (m, x) on a span, ascending.
struct Ritz {
    multiples: Vec<f64>,
    /// x in coordinates of the span.
    shapes: Vec<Col<f64>>,
}

impl Pencil<'_> {
    /// Every m > 0 up to a limit, which may depend on those found (`None` if more are needed to determine
    /// it), ascending, with x of (A − mB)x = 0, ‖x‖ = 1. `count` is the number of m below a value, if it is
    /// certain. `None` if the iteration or the count fails, or if the computation was cancelled.
    pub fn lowest(
        &self,
        limit: &dyn Fn(&[f64]) -> Option<f64>,
        count: &dyn Fn(f64) -> Option<usize>,
    ) -> Option<Vec<(f64, Col<f64>)>> {
        let cancellation = Cancellation::current();
        let mut span = Span::new(self.system.order());
        let start = self.structure.full.first_waves();
        let mut blocks = (0..start.ncols()).step_by(BLOCK).map(|first| {
            let width = BLOCK.min(start.ncols() - first);
            start.subcols(first, width)
        });
        span.add(self, blocks.next()?);
        let mut before = f64::INFINITY;
        for _ in 0..MOST_ROUNDS {
            cancellation.check().ok()?;
            let ritz = span.ritz()?;
            let limit = limit(&ritz.multiples);
            let sought = limit.map_or(ritz.multiples.len(), |limit| {
                ritz.multiples.partition_point(|m| *m <= BEYOND * limit)
            });
            if limit.is_some()
                && sought == ritz.multiples.len()
                && let Some(block) = blocks.next()
            {
                // If no multiple on the span exceeds the limit, further ones may be missing, so that waves
                // are added before the present multiples have converged.
                span.add(self, block);
                continue;
            }
            let improved = (sought + GUARD).min(ritz.multiples.len());
            let (corrections, errors) = self.corrections(&span, &ritz, improved);
            let error = errors[..sought].iter().copied().fold(0.0, f64::max);
            let stalls = error <= ROUNDING && error > 0.25 * before;
            let is_settled = error <= TOLERANCE || stalls;
            if let Some(limit) = limit.filter(|_| is_settled)
                && is_complete(&ritz.multiples[..sought], limit, count)
            {
                return Some(span.pairs(&ritz, limit));
            }
            before = if is_settled {
                span.add(self, blocks.next()?);
                f64::INFINITY
            } else {
                error
            };
            let places: Vec<usize> = (0..improved).filter(|&k| errors[k] > TOLERANCE).collect();
            let open = Mat::from_fn(corrections.nrows(), places.len(), |i, k| {
                corrections[(i, places[k])]
            });
            // A further step of the inverse iteration costs less than the Ritz pairs of another iteration.
            let softened = span.add(self, open.as_ref());
            span.add(
                self,
                unit_columns(self.structure.at_rest.solve(softened.as_ref())).as_ref(),
            );
        }
        None
    }

    /// A⁻¹(Ax − mBx) of the first pairs, and the estimated errors of their m.
    fn corrections(&self, span: &Span, ritz: &Ritz, count: usize) -> (Mat<f64>, Vec<f64>) {
        let [x, ax, bx] = span.lifted(ritz, count);
        let mut residuals = Mat::zeros(x.nrows(), count);
        for k in 0..count {
            let residual = ax.col(k) - Scale(ritz.multiples[k]) * bx.col(k);
            residuals.col_mut(k).copy_from(residual);
        }
        let corrections = self.structure.at_rest.solve(residuals.as_ref());
        let errors = (0..count)
            .map(|k| {
                let gain: f64 = corrections.col(k).transpose() * residuals.col(k);
                let energy: f64 = x.col(k).transpose() * ax.col(k);
                gain.abs() / energy
            })
            .collect();
        (unit_columns(corrections), errors)
    }
}

/// Whether the number of m below some value slightly above the limit equals the number found.
fn is_complete(found: &[f64], limit: f64, count: &dyn Fn(f64) -> Option<usize>) -> bool {
    let shares = [0.3, 0.7, 0.1, 0.5, 0.9];
    let places = shares.map(|share| limit * (1.0 + share * (BEYOND - 1.0)));
    let counted = places
        .into_iter()
        .find_map(|place| Some((place, count(place)?)));
    counted.is_some_and(|(place, count)| found.partition_point(|m| *m <= place) == count)
}

/// The columns with unit length; zeros remain zeros.
fn unit_columns(mut columns: Mat<f64>) -> Mat<f64> {
    for k in 0..columns.ncols() {
        let size = columns.col(k).norm_l2();
        if size > 0.0 {
            columns.col_mut(k).iter_mut().for_each(|x| *x /= size);
        }
    }
    columns
}

/// Orthonormal vectors, and A and B times them.
struct Span {
    vectors: [Mat<f64>; 3],
}

impl Span {
    fn new(order: usize) -> Self {
        Span {
            vectors: [0; 3].map(|_| Mat::zeros(order, 0)),
        }
    }

    /// Adds the new directions of some vectors, and returns B times them.
    fn add(&mut self, pencil: &Pencil<'_>, more: MatRef<'_, f64>) -> Mat<f64> {
        let span = &self.vectors[0];
        let mut new = more.to_owned();
        for _ in 0..2 {
            let shares = span.transpose() * &new;
            new -= span * shares;
        }
        let mut new = independent(&new, INDEPENDENT);
        let shares = span.transpose() * &new;
        new -= span * shares;
        let structure = Some(&pencil.structure.full);
        let product = structured_stiffness::times(pencil.system, structure, new.as_ref());
        let stiffened = product.stiffness;
        let softened = match pencil.softening {
            Softening::Rotation => Scale(-1.0) * product.spin,
            Softening::Mass => new.clone(),
        };
        for (all, more) in self.vectors.iter_mut().zip([&new, &stiffened, &softened]) {
            *all = faer::concat![[&*all, more]];
        }
        softened
    }

    fn ritz(&self) -> Option<Ritz> {
        let [v, av, bv] = &self.vectors;
        let small = |product: &Mat<f64>| symmetric(v.transpose() * product);
        let pairs = singular_multiples(&small(av), &[], &small(bv)).ok()?;
        let (multiples, shapes) = pairs.into_iter().unzip();
        Some(Ritz { multiples, shapes })
    }

    /// x, Ax and Bx of the first `count` pairs, in the unknowns of the system.
    fn lifted(&self, ritz: &Ritz, count: usize) -> [Mat<f64>; 3] {
        let [v, av, bv] = &self.vectors;
        let shapes = Mat::from_fn(v.ncols(), count, |i, k| ritz.shapes[k][i]);
        [v * &shapes, av * &shapes, bv * &shapes]
    }

    /// Pairs (m, x) up to a limit, ‖x‖ = 1.
    fn pairs(&self, ritz: &Ritz, limit: f64) -> Vec<(f64, Col<f64>)> {
        let count = ritz.multiples.partition_point(|m| *m <= limit);
        let [x, ..] = self.lifted(ritz, count);
        let pair = |k: usize| {
            let x = x.col(k);
            (ritz.multiples[k], Scale(1.0 / x.norm_l2()) * x)
        };
        (0..count).map(pair).collect()
    }
}
