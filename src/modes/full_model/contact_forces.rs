//! Dampers of contacts and their forces without a potential, by few columns: C = P W_c Pᵀ, K_n = P W_n Pᵀ.

use std::ops::Range;

use faer::traits::math_utils::from_f64;
use faer::{Mat, MatRef, Scale, unzip, zip};

use super::elimination::Shift;
use super::harmonic::Harmonic;
use super::wave_scaling::WaveScaling;
use crate::model::plate::ContactTerms;

/// Dampers, films, controllers and other forces without a potential of all contacts.
#[derive(Debug)]
pub struct ContactForces {
    /// P in the unknowns of the plate, N × r.
    columns: Mat<f64>,
    /// W_c, in 1/s, symmetric.
    damping: Mat<f64>,
    /// W_n, in 1/s², of any symmetry.
    stiffness: Mat<f64>,
}

/// Norm of the part of C and of K_n beside the columns, relative to the weights of the waves at rest, that solves do not
/// need.
const ENOUGH: f64 = 1e-7;
/// Share of the norm of a matrix that is its rounding.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// If the columns exceed this share of the unknowns, a dense matrix costs less.
const MOST_COLUMNS: f64 = 0.4;

impl ContactForces {
    /// The forces of contacts, without those of internal states of pads on themselves; `None` if they take too many columns, or
    /// are not finite.
    pub fn new(terms: &ContactTerms, states: Range<usize>, harmonics: &[Harmonic]) -> Option<Self> {
        let scaling = WaveScaling::new(harmonics);
        let relative = |matrix: &Mat<f64>| {
            let mut matrix = matrix.clone();
            states
                .clone()
                .for_each(|state| matrix[(state, state)] = 0.0);
            let half = scaling.scaled(matrix.as_ref());
            scaling.scaled(half.transpose()).transpose().to_owned()
        };
        let order = harmonics
            .iter()
            .map(|h| h.radial() * h.firsts().count())
            .sum();
        let most = (MOST_COLUMNS * order as f64) as usize;
        let frequency = harmonics.first()?.shift.sqrt();
        let damping = terms.damping().map(relative);
        let stiffness = terms.nonconservative_stiffness().map(relative);
        let mut basis = Basis::new(order, most);
        if let Some(damping) = &damping {
            basis.extend(Scale(frequency) * damping)?;
        }
        if let Some(stiffness) = &stiffness {
            basis.extend(stiffness.clone())?;
            basis.extend(stiffness.transpose().to_owned())?;
        }
        let columns = basis.vectors();
        let within = |matrix: Option<Mat<f64>>| match matrix {
            Some(matrix) => columns.transpose() * matrix * columns,
            None => Mat::zeros(columns.ncols(), columns.ncols()),
        };
        Some(ContactForces {
            damping: within(damping),
            stiffness: within(stiffness),
            columns: scaling.unscaled(columns),
        })
    }

    /// The columns with W(λ) = W_n + λW_c.
    pub fn weighted<T: Shift>(&self, lambda: T) -> (MatRef<'_, f64>, Mat<T>) {
        let mut weights = Mat::zeros(self.damping.nrows(), self.damping.ncols());
        zip!(&mut weights, &self.stiffness, &self.damping).for_each(
            |unzip!(sum, stiffness, damping)| {
                *sum = from_f64::<T>(*stiffness) + lambda * from_f64::<T>(*damping);
            },
        );
        (self.columns.as_ref(), weights)
    }
}

/// Orthonormal vectors that span the columns of matrices.
struct Basis {
    /// Space for the vectors.
    columns: Mat<f64>,
    count: usize,
}

impl Basis {
    fn new(order: usize, most: usize) -> Self {
        Basis {
            columns: Mat::zeros(order, most),
            count: 0,
        }
    }

    fn vectors(&self) -> MatRef<'_, f64> {
        self.columns.subcols(0, self.count)
    }

    /// Adds vectors until the rest of the columns of a matrix is negligible: the Gram–Schmidt process that takes the longest
    /// column next. `None` if there is no space for them, or if the matrix is not finite.
    fn extend(&mut self, matrix: Mat<f64>) -> Option<()> {
        let enough = ENOUGH.max(ROUNDING * matrix.norm_l2());
        let mut rest = matrix;
        for _ in 0..2 {
            let known = self.vectors().transpose() * &rest;
            rest -= self.vectors() * known;
        }
        loop {
            let lengths: Vec<f64> = rest.col_iter().map(|column| column.norm_l2()).collect();
            let total = lengths
                .iter()
                .map(|length| length * length)
                .sum::<f64>()
                .sqrt();
            if !total.is_finite() {
                return None;
            }
            if total <= enough {
                return Some(());
            }
            if self.count == self.columns.ncols() {
                return None;
            }
            let longest = (0..lengths.len()).max_by(|x, y| lengths[*x].total_cmp(&lengths[*y]))?;
            let mut vector = Scale(lengths[longest].recip()) * rest.col(longest);
            let known = self.vectors().transpose() * &vector;
            vector -= self.vectors() * known;
            vector *= Scale(vector.norm_l2().recip());
            let shares = vector.transpose() * &rest;
            rest -= &vector * shares;
            self.columns.col_mut(self.count).copy_from(vector);
            self.count += 1;
        }
    }
}
