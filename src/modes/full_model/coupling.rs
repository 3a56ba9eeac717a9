//! The coupling of harmonics by few columns: K_g = PPᵀ + R with 0 ≤ R ≤ ε G.

use faer::linalg::matmul::matmul;
use faer::{Accum, Col, Mat, MatRef, Par, Scale, c64};

use super::harmonic::Harmonic;
use super::wave_scaling::{Block, WaveScaling};
use crate::modes::connected_parts::connected_parts;

/// Coupling matrix of the harmonics, of guides and edge loads.
#[derive(Debug)]
pub enum Coupling {
    /// PPᵀ with a negligible remainder.
    Columns(Box<Columns>),
    /// A dense matrix in the basis of waves, N × N: edge loads couple all waves.
    Dense(Mat<c64>),
}

/// The columns P of a coupling matrix.
#[derive(Debug)]
pub struct Columns {
    /// Number of columns in each stage and in solves, with the ε of the remainder.
    pub rests: [(usize, f64); LOOKS + 1],
    /// Parts that do not act on one another. Evenly spaced equal pads connect only waves whose numbers of nodal diameters
    /// add up to, or differ by, a multiple of the number of pads.
    pub parts: Vec<Part>,
    /// P in the unknowns of the plate, N × columns; more columns than in the parts.
    pub unknowns: Mat<f64>,
    /// Whether the remainder is rounding.
    pub is_exact: bool,
}

/// Harmonics that the coupling does not connect with others, and their columns.
#[derive(Debug)]
pub struct Part {
    /// Indices of the harmonics, ascending.
    pub harmonics: Vec<usize>,
    /// P in the waves of the blade at rest, J rows for every n of the part, those of cos nθ above those of sin nθ, which
    /// are zero for n = 0; both over √2 for n > 0. The wave e^{inθ} has the first − i times the second,
    /// e^{−inθ} their conjugates.
    pub resting: Mat<f64>,
    /// Number of its columns in each stage.
    pub counts: [usize; LOOKS],
}

/// Extent of the search for columns of K_g.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kept {
    /// The search ends when only rounding remains.
    All,
    /// The search ends when the remainder is negligible for solves.
    Few,
}

/// Number of stages in which a line is examined; the second is more accurate and takes longer.
pub const LOOKS: usize = 2;
/// Trace of the remainder, relative to the weights, at which a stage, and finally a solve, needs no more
/// columns.
const ENOUGH: [f64; LOOKS + 1] = [1e-3, 1e-5, 1e-7];
/// Trace of the remainder, relative to that of K_g, both relative to the stiffness at rest, that is rounding
/// of K_g.
const EXACT: f64 = 4.0 * f64::EPSILON;
/// If the columns exceed this share of the unknowns, a dense matrix costs less.
const MOST_COLUMNS: f64 = 0.4;

impl Columns {
    /// Cholesky factorization with complete pivoting of K_g relative to the weights G of the waves at rest,
    /// G⁻¹ᐟ² K_g G⁻¹ᐟ²: the remainder is positive and at most its trace. `None` if there are too many
    /// columns, or if K_g has a negative direction.
    pub fn new(coupling: &Mat<f64>, harmonics: &[Harmonic], kept: Kept) -> Option<Self> {
        let order = coupling.nrows();
        let relative = Relative::new(coupling, harmonics);
        let mut diagonal = relative.diagonal();
        let most = (MOST_COLUMNS * order as f64) as usize;
        let mut columns = Mat::zeros(order, most);
        let mut count = 0;
        let trace = |diagonal: &[f64]| -> f64 { diagonal.iter().map(|d| d.max(0.0)).sum() };
        let heavier = heavier(harmonics);
        let unweighted = |diagonal: &[f64]| -> f64 {
            let all = diagonal.iter().zip(&heavier);
            all.map(|(d, heavier)| d.max(0.0) * heavier).sum()
        };
        let rounding = EXACT * unweighted(&diagonal);
        let mut rests: Vec<(usize, f64)> = Vec::new();
        let is_exact = loop {
            let trace = trace(&diagonal);
            let negative = diagonal.iter().copied().fold(0.0, f64::min);
            if negative < -ENOUGH[LOOKS].max(rounding) || !trace.is_finite() {
                return None;
            }
            for enough in &ENOUGH[rests.len()..] {
                if trace <= *enough {
                    rests.push((count, trace));
                }
            }
            let is_exact = unweighted(&diagonal) <= rounding;
            let are_enough = kept == Kept::Few && rests.len() == ENOUGH.len();
            if is_exact || are_enough || count == most {
                break is_exact;
            }
            let largest = |x: &usize, y: &usize| diagonal[*x].total_cmp(&diagonal[*y]);
            let pivot = (0..order).max_by(largest)?;
            let known = columns.subcols(0, count);
            let rest = relative.column(pivot) - known * known.row(pivot).transpose();
            let column = Scale(diagonal[pivot].sqrt().recip()) * rest;
            for (i, d) in diagonal.iter_mut().enumerate() {
                *d -= column[i] * column[i];
            }
            diagonal[pivot] = 0.0;
            columns.col_mut(count).copy_from(column);
            count += 1;
        };
        let columns = columns.subcols(0, count);
        let unknowns = relative.scaling.unscaled(columns);
        let rests: [_; LOOKS + 1] = rests.try_into().ok()?;
        let parts = parts(columns, harmonics).into_iter();
        Some(Columns {
            parts: parts
                .map(|(own, places)| Part::new(&unknowns, harmonics, own, &places, &rests))
                .collect(),
            rests,
            unknowns,
            is_exact,
        })
    }

    /// The columns for solves, in the unknowns of the plate.
    pub fn few(&self) -> MatRef<'_, f64> {
        self.unknowns.subcols(0, self.rests[LOOKS].0)
    }
}

impl Part {
    /// The part of some harmonics and of the columns at some places, from all columns in the unknowns of the plate.
    fn new(
        unknowns: &Mat<f64>,
        all: &[Harmonic],
        harmonics: Vec<usize>,
        places: &[usize],
        rests: &[(usize, f64); LOOKS + 1],
    ) -> Self {
        let counts = std::array::from_fn(|look| places.partition_point(|k| *k < rests[look].0));
        let columns = counts[LOOKS - 1];
        let own = Mat::from_fn(unknowns.nrows(), columns, |i, k| unknowns[(i, places[k])]);
        let rows: usize = harmonics.iter().map(|n| all[*n].radial()).sum();
        let mut resting = Mat::zeros(2 * rows, columns);
        let mut row = 0;
        for harmonic in harmonics.iter().map(|n| &all[*n]) {
            let (radial, vectors) = (harmonic.radial(), &harmonic.resting.vectors);
            let turn = Mat::from_fn(radial, radial, |i, j| vectors[(j, i)]);
            let norm = match harmonic.diameters {
                0 => 1.0,
                _ => std::f64::consts::FRAC_1_SQRT_2,
            };
            for (first, row) in harmonic.firsts().zip([row, rows + row]) {
                let turned = resting.subrows_mut(row, radial);
                let given = own.subrows(first, radial);
                matmul(turned, Accum::Replace, &turn, given, norm, Par::Seq);
            }
            row += radial;
        }
        Part {
            harmonics,
            resting,
            counts,
        }
    }
}

/// Entries of P whose contribution to PPᵀ is below this share of its largest diagonal element are its rounding.
const UNCOUPLED: f64 = 16.0 * f64::EPSILON;

/// Indices of the harmonics and of the columns of parts that act on one another by rounding alone, ascending. The columns
/// are relative to the weights.
fn parts(columns: MatRef<'_, f64>, harmonics: &[Harmonic]) -> Vec<(Vec<usize>, Vec<usize>)> {
    let count = columns.ncols();
    let lengths: Vec<f64> = (0..count).map(|k| columns.col(k).norm_l2()).collect();
    let largest = lengths.iter().copied().fold(0.0, f64::max).powi(2);
    let members: Vec<Vec<usize>> = (0..count)
        .map(|k| {
            let size = |h: &Harmonic| {
                let own = h
                    .firsts()
                    .map(|first| columns.col(k).subrows(first, h.radial()));
                own.map(|rows| rows.norm_max()).fold(0.0, f64::max)
            };
            let sizes: Vec<f64> = harmonics.iter().map(size).collect();
            let top = sizes.iter().copied().fold(0.0, f64::max);
            // The largest entry of a short column may be rounding of the longest, too, but belongs to a part.
            let least = top.min(UNCOUPLED * largest / lengths[k]);
            (0..sizes.len()).filter(|n| sizes[*n] >= least).collect()
        })
        .collect();
    let links = members
        .iter()
        .flat_map(|members| members.windows(2).map(|pair| [pair[0], pair[1]]));
    let parts = connected_parts(harmonics.len(), links).into_iter();
    let with_columns = parts.map(|part| {
        let is_own = |k: &usize| members[*k].first().is_some_and(|n| part.contains(n));
        let own = (0..count).filter(is_own).collect();
        (part, own)
    });
    with_columns.collect()
}

/// Ratio of the weight of every wave to its stiffness at rest.
fn heavier(harmonics: &[Harmonic]) -> Vec<f64> {
    let of = |h: &Harmonic| -> Vec<f64> {
        let all = h.weights.iter().zip(&h.resting.values);
        all.map(|(weight, own)| weight / (own + h.shift)).collect()
    };
    let blocks = harmonics
        .iter()
        .flat_map(|h| h.firsts().map(move |_| of(h)));
    blocks.flatten().collect()
}

/// F⁻¹ K F⁻ᵀ; only few of its columns are computed.
struct Relative<'a> {
    coupling: &'a Mat<f64>,
    scaling: WaveScaling,
}

impl<'a> Relative<'a> {
    fn new(coupling: &'a Mat<f64>, harmonics: &[Harmonic]) -> Self {
        Relative {
            coupling,
            scaling: WaveScaling::new(harmonics),
        }
    }

    /// Diagonal of F⁻¹ K F⁻ᵀ.
    fn diagonal(&self) -> Vec<f64> {
        let mut diagonal = Vec::with_capacity(self.coupling.nrows());
        for Block { first, inverse, .. } in self.scaling.blocks() {
            let (first, size) = (*first, inverse.nrows());
            let own = self.coupling.get(first..first + size, first..first + size);
            let half = inverse * own;
            diagonal.extend((0..size).map(|i| half.row(i) * inverse.row(i).transpose()));
        }
        diagonal
    }

    /// Column `index` of F⁻¹ K F⁻ᵀ.
    fn column(&self, index: usize) -> Col<f64> {
        let Block { first, inverse, .. } = self.scaling.block_of(index);
        let unit = inverse.row(index - first).transpose();
        let column = self.coupling.subcols(*first, inverse.nrows()) * unit;
        self.scaling.scaled(column.as_mat()).col(0).to_owned()
    }
}

/// A symmetric matrix in the basis of waves (cos nθ ± i sin nθ)/√2, e^{inθ} before e^{−inθ}.
pub fn in_waves(matrix: &Mat<f64>, harmonics: &[Harmonic]) -> Mat<c64> {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    // Every wave is share · (cosine + i · sign · sine), stored as (index of the cosine, index of the sine,
    // sign, share). For n = 0 the sign is 0.
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
