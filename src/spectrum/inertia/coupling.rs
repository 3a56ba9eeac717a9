//! What couples the harmonics, as few columns: K_g = PPᵀ + R with 0 ≤ R ≤ ε (B(0) + σ).

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par, c64};
use nalgebra::DMatrix;

use super::Harmonic;

/// What couples the harmonics.
#[derive(Debug)]
pub enum Coupling {
    /// PPᵀ and a rest that is too small to matter.
    Columns(Columns),
    /// In the basis of waves, N × N: edge loads couple every wave with every other.
    Dense(Mat<c64>),
}

/// P in the basis of waves. The wave e^{inθ} has the rows `cosine` − i `sine`, e^{−inθ} their conjugates.
#[derive(Debug)]
pub struct Columns {
    /// Rows of cos nθ, over √2 for n > 0; J rows of every n.
    pub cosine: Mat<f64>,
    /// Rows of sin nθ, the same way; zero for n = 0.
    pub sine: Mat<f64>,
    /// Both in the waves of the blade at rest, those of cosines above those of sines.
    pub resting: Mat<f64>,
    /// Numbers of columns to begin with, each with the ε of those left out.
    pub rests: [(usize, f64); 2],
}

/// Trace of the rest, relative to the blade's own stiffness, at which no more columns are taken.
const ENOUGH: f64 = 1e-7;
/// The same for a first look, which costs a third.
const FIRST_LOOK: f64 = 1e-3;
/// Columns beyond this share of the unknowns cost more than the matrix as a whole.
const MOST_COLUMNS: f64 = 0.4;

impl Columns {
    /// Cholesky with complete pivoting of K_g relative to the blade, T⁻¹ᐟ² K_g T⁻¹ᐟ²: what is left
    /// is positive and no larger than its trace. `None` where there are too many columns, and where
    /// K_g has a negative direction.
    pub fn new(coupling: &Mat<f64>, harmonics: &[Harmonic]) -> Option<Self> {
        let order = coupling.nrows();
        let factors: Vec<DMatrix<f64>> = harmonics
            .iter()
            .map(|h| h.scale.clone().cholesky().map(|factor| factor.l()))
            .collect::<Option<_>>()?;
        let scaled = relative(coupling, harmonics, &factors)?;
        let mut diagonal: Vec<f64> = (0..order).map(|i| scaled[(i, i)]).collect();
        let mut columns: Vec<Vec<f64>> = Vec::new();
        let mut first_look = None;
        let most = (MOST_COLUMNS * order as f64) as usize;
        loop {
            let trace: f64 = diagonal.iter().map(|d| d.max(0.0)).sum();
            let negative = diagonal.iter().copied().fold(0.0, f64::min);
            if negative < -ENOUGH || !trace.is_finite() {
                return None;
            }
            if trace <= FIRST_LOOK && first_look.is_none() {
                first_look = Some((columns.len(), trace));
            }
            if trace <= ENOUGH {
                let all = (columns.len(), trace);
                let rests = [first_look.unwrap_or(all), all];
                return Some(Self::unscaled(&columns, rests, harmonics, &factors));
            }
            if columns.len() == most {
                return None;
            }
            let largest = |x: &usize, y: &usize| diagonal[*x].total_cmp(&diagonal[*y]);
            let pivot = (0..order).max_by(largest)?;
            let root = diagonal[pivot].sqrt();
            let column: Vec<f64> = (0..order)
                .map(|i| {
                    let known: f64 = columns.iter().map(|c| c[i] * c[pivot]).sum();
                    (scaled[(i, pivot)] - known) / root
                })
                .collect();
            for (d, x) in diagonal.iter_mut().zip(&column) {
                *d -= x * x;
            }
            diagonal[pivot] = 0.0;
            columns.push(column);
        }
    }

    /// P in the unknowns of the plate, N × columns.
    pub fn in_unknowns(&self, harmonics: &[Harmonic]) -> Mat<f64> {
        let count = self.cosine.ncols();
        let order = harmonics.iter().map(|h| h.radial() * h.firsts().count());
        let mut unknowns = Mat::zeros(order.sum(), count);
        let mut row = 0;
        for harmonic in harmonics {
            let norm = match harmonic.diameters {
                0 => 1.0,
                _ => std::f64::consts::SQRT_2,
            };
            for (first, rows) in harmonic.firsts().zip([&self.cosine, &self.sine]) {
                for k in 0..count {
                    for j in 0..harmonic.radial() {
                        unknowns[(first + j, k)] = norm * rows[(row + j, k)];
                    }
                }
            }
            row += harmonic.radial();
        }
        unknowns
    }

    /// T¹ᐟ² times the columns, sorted by waves.
    fn unscaled(
        columns: &[Vec<f64>],
        rests: [(usize, f64); 2],
        harmonics: &[Harmonic],
        factors: &[DMatrix<f64>],
    ) -> Self {
        let rows: usize = harmonics.iter().map(Harmonic::radial).sum();
        let mut cosine = Mat::zeros(rows, columns.len());
        let mut sine = Mat::zeros(rows, columns.len());
        let mut row = 0;
        for (harmonic, factor) in harmonics.iter().zip(factors) {
            let radial = harmonic.radial();
            for (k, column) in columns.iter().enumerate() {
                for j in 0..radial {
                    let at = |first: usize| -> f64 {
                        (0..=j).map(|i| factor[(j, i)] * column[first + i]).sum()
                    };
                    match harmonic.diameters {
                        0 => cosine[(row + j, k)] = at(harmonic.first),
                        _ => {
                            let half = std::f64::consts::FRAC_1_SQRT_2;
                            cosine[(row + j, k)] = half * at(harmonic.first);
                            sine[(row + j, k)] = half * at(harmonic.first + radial);
                        }
                    }
                }
            }
            row += radial;
        }
        let mut resting = Mat::zeros(2 * rows, columns.len());
        let mut row = 0;
        for harmonic in harmonics {
            let (radial, vectors) = (harmonic.radial(), &harmonic.resting.eigenvectors);
            let turn = Mat::from_fn(radial, radial, |i, j| vectors[(j, i)]);
            for (first, own) in [(row, &cosine), (rows + row, &sine)] {
                let turned = resting.subrows_mut(first, radial);
                let own = own.subrows(row, radial);
                matmul(turned, Accum::Replace, &turn, own, 1.0, Par::Seq);
            }
            row += radial;
        }
        Columns {
            cosine,
            sine,
            resting,
            rests,
        }
    }
}

/// C⁻¹ K C⁻ᵀ, T = CCᵀ block by block.
fn relative(
    coupling: &Mat<f64>,
    harmonics: &[Harmonic],
    factors: &[DMatrix<f64>],
) -> Option<DMatrix<f64>> {
    let order = coupling.nrows();
    let mut scaled = DMatrix::from_fn(order, order, |i, k| coupling[(i, k)]);
    for _ in 0..2 {
        for (harmonic, factor) in harmonics.iter().zip(factors) {
            for first in harmonic.firsts() {
                let mut rows = scaled.rows_mut(first, harmonic.radial());
                if !factor.solve_lower_triangular_mut(&mut rows) {
                    return None;
                }
            }
        }
        scaled.transpose_mut();
    }
    Some(scaled)
}

/// A symmetric matrix in the basis of waves (cos nθ ± i sin nθ)/√2, e^{inθ} before e^{−inθ}.
pub fn in_waves(matrix: &Mat<f64>, harmonics: &[Harmonic]) -> Mat<c64> {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    // Every wave is a cosine and ±i sines: (index of the cosine, of the sine, sign, share).
    let waves: Vec<(usize, usize, f64, f64)> = harmonics
        .iter()
        .flat_map(|h| {
            let radial = h.radial();
            let signs: &[f64] = if h.diameters == 0 {
                &[0.0]
            } else {
                &[1.0, -1.0]
            };
            let share = if h.diameters == 0 { 1.0 } else { half };
            signs.iter().flat_map(move |sign| {
                (0..radial).map(move |j| {
                    let cosine = h.first + j;
                    let sine = if *sign == 0.0 {
                        cosine
                    } else {
                        cosine + radial
                    };
                    (cosine, sine, *sign, share)
                })
            })
        })
        .collect();
    Mat::from_fn(waves.len(), waves.len(), |i, k| {
        let (ci, si, sign_i, share_i) = waves[i];
        let (ck, sk, sign_k, share_k) = waves[k];
        let share = share_i * share_k;
        let real = matrix[(ci, ck)] + sign_i * sign_k * matrix[(si, sk)];
        let imaginary = sign_k * matrix[(ci, sk)] - sign_i * matrix[(si, ck)];
        c64::new(share * real, share * imaginary)
    })
}
