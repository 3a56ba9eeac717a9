//! The lowest m of a large symmetric pencil A − mB, A = K₀ of a guided blade, by its structure.
//!
//! Davidson's iteration in blocks: Ritz pairs (m, x) of the pencil on a growing span, which A⁻¹ of their
//! residuals Ax − mBx joins. By the structure of K₀ one A⁻¹b costs O(N) in place of O(N²), and what its few
//! columns leave out only slows the iteration: Ritz values come from the exact matrices, and their error
//! is the square of that of their vectors. That none was overlooked says a count of
//! the negative eigenvalues of A − mB by Sylvester's law of inertia.
//!
//! E. R. Davidson, J. Comput. Phys. 17 (1975), 87–94; Y. Saad, *Numerical Methods for Large Eigenvalue
//! Problems*, 2nd ed. (2011), section 8.4.

use faer::{Col, Mat, MatRef, Scale};

use super::generalized::singular_multiples;
use super::structured::{self, StructuredStiffness};
use crate::system::GyroscopicSystem;

/// A pencil A − mB, A = K₀ positive definite.
pub struct Pencil<'a> {
    /// K₀ and K_σ − N.
    pub system: &'a GyroscopicSystem,
    /// The same by its structure.
    pub structure: &'a StructuredStiffness,
    /// B.
    pub softening: Softening,
}

/// B of a pencil.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Softening {
    /// N − K_σ: m is Ω² of a critical speed.
    Rotation,
    /// The mass, one: m is ω² of a mode at rest.
    Mass,
}

/// Estimated relative error of a Ritz value that is good enough.
const TOLERANCE: f64 = 1e-14;
/// The same where rounding keeps it from falling on.
const ROUNDING: f64 = 1e-11;
const MOST_ROUNDS: usize = 20;
/// Vectors that the span begins with, and that join it where some m are missing.
const BLOCK: usize = 25;
/// Pairs beyond those sought that are improved with them.
const GUARD: usize = 4;
/// Multiples up to this one of the limit are found as well, so that there is a place to count at.
const BEYOND: f64 = 1.01;
/// Directions closer to the span than this are left out.
const INDEPENDENT: f64 = 1e-10;

/// Pairs on a span.
struct Ritz {
    multiples: Vec<f64>,
    /// x, Ax and Bx.
    vectors: [Mat<f64>; 3],
}

impl Pencil<'_> {
    /// Every m > 0 up to a limit, which may depend on those found (`None` where more are needed to tell),
    /// ascending, with x of (A − mB)x = 0, ‖x‖ = 1. `count` is the number of m below one, where that is certain.
    /// `None` where the iteration or the count fails.
    pub fn lowest(
        &self,
        limit: &dyn Fn(&[f64]) -> Option<f64>,
        count: &dyn Fn(f64) -> Option<usize>,
    ) -> Option<Vec<(f64, Col<f64>)>> {
        let mut span = Span::new(self.system.order());
        let start = self.structure.basis.first_waves();
        let mut blocks = (0..start.ncols()).step_by(BLOCK).map(|first| {
            let width = BLOCK.min(start.ncols() - first);
            start.subcols(first, width)
        });
        span.add(self, blocks.next()?);
        let mut before = f64::INFINITY;
        for _ in 0..MOST_ROUNDS {
            let ritz = span.ritz()?;
            let limit = limit(&ritz.multiples);
            let sought = limit.map_or(ritz.multiples.len(), |limit| {
                ritz.multiples.partition_point(|m| *m <= BEYOND * limit)
            });
            let improved = (sought + GUARD).min(ritz.multiples.len());
            let (corrections, errors) = self.corrections(&ritz, improved);
            let error = errors[..sought].iter().copied().fold(0.0, f64::max);
            let stalls = error <= ROUNDING && error > 0.25 * before;
            let is_settled = error <= TOLERANCE || stalls;
            if let Some(limit) = limit.filter(|_| is_settled)
                && is_complete(&ritz.multiples[..sought], limit, count)
            {
                return Some(ritz.pairs(limit));
            }
            before = match is_settled {
                true => {
                    span.add(self, blocks.next()?);
                    f64::INFINITY
                }
                false => error,
            };
            let places: Vec<usize> = (0..improved).filter(|&k| errors[k] > TOLERANCE).collect();
            let open = Mat::from_fn(corrections.nrows(), places.len(), |i, k| {
                corrections[(i, places[k])]
            });
            span.add(self, open.as_ref());
        }
        None
    }

    /// A⁻¹(Ax − mBx) of the first pairs, and how far their m are estimated to be off.
    fn corrections(&self, ritz: &Ritz, count: usize) -> (Mat<f64>, Vec<f64>) {
        let [x, ax, bx] = &ritz.vectors;
        let mut corrections = Mat::zeros(x.nrows(), count);
        let errors = (0..count).map(|k| {
            let residual = ax.col(k) - Scale(ritz.multiples[k]) * bx.col(k);
            let correction = self.structure.inverse.times(residual.as_ref());
            let gain: f64 = correction.transpose() * &residual;
            let energy: f64 = x.col(k).transpose() * ax.col(k);
            let size = correction.norm_l2();
            let unit = if size > 0.0 { 1.0 / size } else { 0.0 };
            corrections.col_mut(k).copy_from(Scale(unit) * correction);
            gain.abs() / energy
        });
        let errors = errors.collect();
        (corrections, errors)
    }
}

/// Whether there are as many m below some number a little above the limit as were found.
fn is_complete(found: &[f64], limit: f64, count: &dyn Fn(f64) -> Option<usize>) -> bool {
    let shares = [0.3, 0.7, 0.1, 0.5, 0.9];
    let places = shares.map(|share| limit * (1.0 + share * (BEYOND - 1.0)));
    let counted = places
        .into_iter()
        .find_map(|place| Some((place, count(place)?)));
    counted.is_some_and(|(place, count)| found.partition_point(|m| *m <= place) == count)
}

/// Orthonormal vectors with A and B times them.
struct Span {
    vectors: [Mat<f64>; 3],
}

impl Span {
    fn new(order: usize) -> Self {
        Span {
            vectors: [0; 3].map(|_| Mat::zeros(order, 0)),
        }
    }

    /// Adds what is new of some vectors.
    fn add(&mut self, pencil: &Pencil<'_>, more: MatRef<'_, f64>) {
        let span = &self.vectors[0];
        let mut new = more.to_owned();
        for _ in 0..2 {
            let shares = span.transpose() * &new;
            new -= span * shares;
        }
        let qr = new.col_piv_qr();
        let rank = (0..new.ncols().min(new.nrows()))
            .take_while(|&k| qr.thin_R()[(k, k)].abs() > INDEPENDENT)
            .count();
        let mut new = qr.compute_thin_Q().subcols(0, rank).to_owned();
        let shares = span.transpose() * &new;
        new -= span * shares;
        let structure = Some(&pencil.structure.basis);
        let product = structured::times(pencil.system, structure, new.as_ref());
        let stiffened = product.stiffness;
        let softened = match pencil.softening {
            Softening::Rotation => Scale(-1.0) * product.spin,
            Softening::Mass => new.clone(),
        };
        for (all, more) in self.vectors.iter_mut().zip([new, stiffened, softened]) {
            *all = faer::concat![[&*all, &more]];
        }
    }

    fn ritz(&self) -> Option<Ritz> {
        let [v, av, bv] = &self.vectors;
        let small = |product: &Mat<f64>| {
            let half = v.transpose() * product;
            Scale(0.5) * (&half + half.transpose())
        };
        let pairs = singular_multiples(&small(av), &[], &small(bv)).ok()?;
        let shapes = Mat::from_fn(v.ncols(), pairs.len(), |i, k| pairs[k].1[i]);
        let vectors = [v * &shapes, av * &shapes, bv * &shapes];
        Some(Ritz {
            multiples: pairs.into_iter().map(|(m, _)| m).collect(),
            vectors,
        })
    }
}

impl Ritz {
    fn pairs(&self, limit: f64) -> Vec<(f64, Col<f64>)> {
        let count = self.multiples.partition_point(|m| *m <= limit);
        let pair = |k: usize| {
            let x = self.vectors[0].col(k);
            (self.multiples[k], Scale(1.0 / x.norm_l2()) * x)
        };
        (0..count).map(pair).collect()
    }
}
