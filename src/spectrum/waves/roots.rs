//! Eigenvalues of the reduced model at a speed, with their slopes.
//!
//! The quadratic problem K̃ + λC̃ + λ²M̃ has the companion matrix A of the states u = (x, λx). On the p states V with
//! eigenvalues within the reach, A V = V B, W V = 1. The further terms s_k change B by
//!
//! δB = −Y Σ_{k≥3} s_k X Bᵏ,   V = [X; ·], W = [·, Y M̃],
//!
//! to first order in the s_k, with Bᵏ of the changed B after a second pass. In contrast to a correction of one eigenvalue
//! after the other this also holds where two of them coalesce. With the vectors u, w of B,
//!
//! dλ/dΩ = −(Σ λᵏ w Y (∂L_k/∂Ω) X u) / (Σ k λᵏ⁻¹ w Y L_k X u).

use faer::linalg::solvers::Solve;
use faer::{Mat, c64};

use super::over_speed::WaveModel;
use super::series::QUADRATIC;
use crate::linalg::{LinalgError, RealEigen};
use crate::spectrum::error::SpectrumError;

/// Eigenvalues beyond this multiple of the window are not listed: the series in λ is inaccurate there.
const REACH: f64 = 1.5;
/// |λ| of a free rigid motion in units of the window, which is zero except for the root of rounding.
const RIGID: f64 = 3e-6;
/// Number of corrections by the further terms, each with the powers of the matrix from the one before. Two more change
/// nothing beyond 1e-8 of the window.
const PASSES: usize = 2;

impl WaveModel {
    /// |λ| up to which eigenvalues are listed, in 1/s.
    pub fn reach_per_s(&self) -> f64 {
        REACH * self.window
    }

    /// All eigenvalues at a speed with Im λ ≥ 0 within the reach, in 1/s, without free rigid motions, and dλ/dΩ, which is not
    /// finite where two coalesce.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn eigenvalues(&self, speed_rad_per_s: f64) -> Result<Vec<(c64, c64)>, SpectrumError> {
        let (terms, slopes) = self.at(speed_rad_per_s);
        let mut found = sloped(&terms, &slopes).map_err(SpectrumError::at(speed_rad_per_s))?;
        found.sort_by(|x, y| x.0.norm().total_cmp(&y.0.norm()));
        let zeros = found.partition_point(|(mu, _)| mu.norm() < RIGID);
        found.drain(..zeros.min(2 * self.rigid));
        let scaled = found.into_iter();
        Ok(scaled
            .map(|(mu, slope)| (mu * self.window, slope * self.window))
            .collect())
    }
}

fn sloped(terms: &[Mat<f64>], slopes: &[Mat<f64>]) -> Result<Vec<(c64, c64)>, LinalgError> {
    let Some(Span { x, y, mut b }) = Span::new(terms)? else {
        return Ok(Vec::new());
    };
    let quadratic = b.clone();
    for _ in 0..PASSES {
        let mut power = &b * &b;
        let mut sum = Mat::zeros(x.nrows(), b.ncols());
        for term in &terms[QUADRATIC..] {
            power = power * &b;
            sum += term * (&x * &power);
        }
        b = &quadratic - &y * sum;
    }
    let eigen = RealEigen::new(b.as_ref())?;
    let (right, left) = (x * columns(&eigen), inverse(&eigen) * y);
    let inner = |all: &[Mat<f64>]| -> Vec<Mat<f64>> {
        let of = |matrix: &Mat<f64>| &left * (matrix * &right);
        all.iter().map(of).collect()
    };
    let (terms, slopes) = (inner(terms), inner(slopes));
    let of = |i: usize| {
        let mu = eigen.values[i];
        // Columns i and i + 1 of the right vectors are the real and the imaginary part of u. With the rows a and b of the
        // left vectors at the same indices, w = (a − ib)/2.
        let form = |matrix: &Mat<f64>| match mu.im > 0.0 {
            true => {
                let re = matrix[(i, i)] + matrix[(i + 1, i + 1)];
                c64::new(re, matrix[(i, i + 1)] - matrix[(i + 1, i)]) * 0.5
            }
            false => c64::from(matrix[(i, i)]),
        };
        let (mut moved, mut by_root) = (c64::new(0.0, 0.0), c64::new(0.0, 0.0));
        let mut power = c64::new(1.0, 0.0);
        for (k, slope) in slopes.iter().enumerate() {
            moved += power * form(slope);
            if let Some(next) = terms.get(k + 1) {
                by_root += power * form(next) * (k + 1) as f64;
            }
            power *= mu;
        }
        (mu, -moved / by_root)
    };
    Ok(eigen.upper().into_iter().map(of).collect())
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
fn inverse(eigen: &RealEigen) -> Mat<f64> {
    let columns = columns(eigen);
    let size = columns.nrows();
    columns
        .partial_piv_lu()
        .solve(Mat::<f64>::identity(size, size))
}

/// States with eigenvalues within the reach.
struct Span {
    /// Displacements X, m × p.
    x: Mat<f64>,
    /// Left vectors Y, p × m.
    y: Mat<f64>,
    /// B, p × p.
    b: Mat<f64>,
}

impl Span {
    /// The states of the quadratic problem; `None` without eigenvalues within the reach.
    fn new(terms: &[Mat<f64>]) -> Result<Option<Self>, LinalgError> {
        let size = terms[0].nrows();
        let inertia = terms[2].partial_piv_lu();
        let [stiffness, velocity] = [0, 1].map(|k| inertia.solve(&terms[k]));
        let companion = Mat::from_fn(2 * size, 2 * size, |i, k| match (i < size, k < size) {
            (true, true) => 0.0,
            (true, false) => f64::from(u8::from(i + size == k)),
            (false, true) => -stiffness[(i - size, k)],
            (false, false) => -velocity[(i - size, k - size)],
        });
        let eigen = RealEigen::new(companion.as_ref())?;
        let is_kept = |i: &usize| eigen.values[*i].norm() < REACH;
        let kept: Vec<usize> = (0..2 * size).filter(is_kept).collect();
        if kept.is_empty() {
            return Ok(None);
        }
        let (right, left) = (columns(&eigen), inverse(&eigen));
        let x = Mat::from_fn(size, kept.len(), |i, k| right[(i, kept[k])]);
        let lower = Mat::from_fn(size, kept.len(), |i, k| left[(kept[k], size + i)]);
        let y = inertia.solve_transpose(lower).transpose().to_owned();
        let mut b = Mat::zeros(kept.len(), kept.len());
        for (k, i) in kept.iter().enumerate() {
            let value = eigen.values[*i];
            b[(k, k)] = value.re;
            // Conjugates are neighbours, the one with Im λ > 0 first: A (r, s) = (r, s) [a b; −b a].
            if value.im > 0.0 {
                b[(k, k + 1)] = value.im;
            } else if value.im < 0.0 {
                b[(k, k - 1)] = value.im;
            }
        }
        Ok(Some(Span { x, y, b }))
    }
}
