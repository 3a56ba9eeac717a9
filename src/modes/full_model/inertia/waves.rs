//! L in the waves of the free blade, in which B_n is diagonal.

use std::sync::OnceLock;

use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::{Accum, Mat, MatRef, Par, Scale, c64};

use super::bound::{Bound, BoundedBlock};
use super::free_waves::FreeWaves;
use crate::modes::full_model::Harmonic;
use crate::modes::hermitian_inertia::negative_eigenvalues;

/// A wave with |p|²/|d| above this value is not eliminated, because its term would conceal the others.
const RESONANT: f64 = 1e5;

/// The waves of all harmonics at a speed.
#[derive(Debug)]
pub struct Waves {
    /// Waves that every count treats individually.
    soft: Rows,
    /// Waves that every count treats together.
    stiff: Rows,
    /// PᴴB⁻¹P of the stiff waves, real, lower triangle, for both bounds: their D is nearly their stiffness B.
    stiff_compliance: [OnceLock<Mat<f64>>; 2],
    /// Smallest stiffness of the stiff waves of each harmonic.
    least: Vec<f64>,
}

/// Some waves, and the columns P in their coordinates.
#[derive(Debug)]
struct Rows {
    waves: Vec<Row>,
    /// The rows of P for cosines, and below them those for sines.
    both: Mat<f64>,
}

/// e^{inθ} and e^{−inθ} of one eigenvalue of a block.
#[derive(Debug, Clone, Copy)]
struct Row {
    /// Index of the harmonic.
    harmonic: usize,
    /// Eigenvalue of the block, in 1/s².
    stiffness: f64,
    /// Weight, a share of which is added to the stiffness for the part that the columns neglect.
    weight: f64,
    /// |p|², the sum of squares of the wave's two rows of the columns.
    size: f64,
}

impl Row {
    /// Stiffness in a bound of L, if the columns neglect a share `rest` of the weight.
    fn bounded(&self, bound: Bound, rest: f64) -> f64 {
        match bound {
            Bound::Low => self.stiffness,
            Bound::High => self.stiffness + rest * self.weight,
        }
    }
}

impl Rows {
    /// The waves of some harmonics, with columns that are given in the waves at rest.
    fn of(free: &[FreeWaves], columns: MatRef<'_, f64>, harmonics: &[usize]) -> Self {
        let total = columns.nrows() / 2;
        let mut both = Mat::zeros(2 * total, columns.ncols());
        let mut waves = Vec::with_capacity(total);
        for &harmonic in harmonics {
            let FreeWaves { of, weights } = &free[harmonic];
            let (row, radial) = (waves.len(), weights.len());
            let turn = MatRef::from_column_major_slice(of.vectors.as_slice(), radial, radial);
            for first in [row, total + row] {
                let turned = both.subrows_mut(first, radial);
                let own = columns.subrows(first, radial);
                matmul(turned, Accum::Replace, turn.transpose(), own, 1.0, Par::Seq);
            }
            waves.extend(
                of.values
                    .iter()
                    .zip(weights)
                    .map(|(&stiffness, &weight)| Row {
                        harmonic,
                        stiffness,
                        weight,
                        size: 0.0,
                    }),
            );
        }
        for k in 0..both.ncols() {
            let (cosine, sine) = both.col_as_slice(k).split_at(total);
            for (row, (x, y)) in waves.iter_mut().zip(cosine.iter().zip(sine)) {
                row.size += x * x + y * y;
            }
        }
        Rows { waves, both }
    }

    /// The waves at some places.
    fn picked(&self, places: &[usize]) -> Self {
        let (total, count) = (self.waves.len(), places.len());
        let mut both = Mat::zeros(2 * count, self.both.ncols());
        for k in 0..both.ncols() {
            let (cosine, sine) = self.both.col_as_slice(k).split_at(total);
            let (own_cosine, own_sine) = both.col_as_slice_mut(k).split_at_mut(count);
            for (i, &place) in places.iter().enumerate() {
                own_cosine[i] = cosine[place];
                own_sine[i] = sine[place];
            }
        }
        Rows {
            waves: places.iter().map(|&place| self.waves[place]).collect(),
            both,
        }
    }

    /// Each row of the columns times its weight, for cosines and for sines.
    fn scaled(&self, weights: [&[f64]; 2]) -> Mat<f64> {
        let (rows, count) = (self.waves.len(), self.both.ncols());
        let mut scaled = Mat::zeros(2 * rows, count);
        for k in 0..count {
            let own = self.both.col_as_slice(k);
            let scaled = scaled.col_as_slice_mut(k);
            for (half, weight) in weights.into_iter().enumerate() {
                let range = half * rows..(half + 1) * rows;
                let pairs = scaled[range.clone()].iter_mut().zip(&own[range]);
                for ((scaled, x), w) in pairs.zip(weight) {
                    *scaled = x * w;
                }
            }
        }
        scaled
    }
}

impl Waves {
    /// Divides the columns of some harmonics, given in the waves at rest, into those of soft and of stiff waves, by
    /// harmonic and stiffness.
    pub fn new(
        free: &[FreeWaves],
        columns: MatRef<'_, f64>,
        harmonics: &[usize],
        is_stiff: impl Fn(usize, f64) -> bool,
    ) -> Self {
        let all = Rows::of(free, columns, harmonics);
        let is_stiff = |place: &usize| {
            let row = &all.waves[*place];
            is_stiff(row.harmonic, row.stiffness) && row.size < 0.5 * RESONANT * row.stiffness
        };
        let (stiff, soft): (Vec<usize>, Vec<usize>) =
            (0..all.waves.len()).partition(|place| is_stiff(place));
        let mut least = vec![f64::INFINITY; free.len()];
        for &place in &stiff {
            let row = &all.waves[place];
            least[row.harmonic] = least[row.harmonic].min(row.stiffness);
        }
        Waves {
            soft: all.picked(&soft),
            stiff: all.picked(&stiff),
            stiff_compliance: Default::default(),
            least,
        }
    }

    /// n₋(A + PPᴴ) of a bound, from −1 − PᴴA⁻¹P over the eliminated waves, bordered by the resonant ones.
    /// `None` if the number is not certain.
    pub fn count(
        &self,
        harmonics: &[Harmonic],
        bounds: &[BoundedBlock],
        bound: Bound,
        rest: f64,
    ) -> Option<usize> {
        let count = self.soft.waves.len();
        // For each row, `sum` is the sum of 1/d over the waves e^{inθ} and e^{−inθ} that are not resonant,
        // and `difference` is the difference of the two 1/d, where d is the diagonal element of A.
        let (mut sum, mut difference) = (vec![0.0; count], vec![0.0; count]);
        let mut resonant: Vec<Resonant> = Vec::new();
        let mut negative = 0;
        for (place, row) in self.soft.waves.iter().enumerate() {
            let block = &bounds[row.harmonic];
            let stiffness = (1.0 + block.share) * row.bounded(bound, rest) + block.more;
            for sign in harmonics[row.harmonic].signs() {
                let turned = [1.0, -1.0][sign];
                let d = stiffness - block.turning[sign];
                if row.size > RESONANT * d.abs() {
                    resonant.push(Resonant {
                        row: place,
                        turned,
                        d,
                    });
                    continue;
                }
                negative += usize::from(d < 0.0);
                sum[place] += 1.0 / d;
                difference[place] += turned / d;
            }
        }
        let compliance = self.stiff_compliance[bound as usize]
            .get_or_init(|| self.stiff_compliance(harmonics, bound, rest));
        let stiff = Scale(1.0 / self.stiff_share(bounds, bound)?) * compliance;
        let columns = stiff.ncols();
        if columns == 0 {
            return Some(negative);
        }
        let core = self.core([&sum, &difference], &resonant, stiff);
        (negative + negative_eigenvalues(&core)?).checked_sub(columns)
    }

    fn stiff_compliance(&self, harmonics: &[Harmonic], bound: Bound, rest: f64) -> Mat<f64> {
        let root = |row: &Row| {
            let waves = harmonics[row.harmonic].signs().count() as f64;
            (waves / row.bounded(bound, rest)).sqrt()
        };
        let roots: Vec<f64> = self.stiff.waves.iter().map(root).collect();
        let scaled = self.stiff.scaled([&roots, &roots]);
        let mut compliance = Mat::zeros(scaled.ncols(), scaled.ncols());
        add_lower_product(&mut compliance, &scaled, &scaled);
        compliance
    }

    /// The smallest D/B for a lower bound, the largest for an upper one. `None` if a wave is not stiff.
    fn stiff_share(&self, bounds: &[BoundedBlock], bound: Bound) -> Option<f64> {
        let of = |(block, least): (&BoundedBlock, &f64)| {
            let [x, y] = block.turning;
            let added = match bound {
                Bound::Low => (block.more - x.max(y)).min(0.0),
                Bound::High => (block.more - x.min(y)).max(0.0),
            };
            1.0 + block.share + added / least
        };
        let shares = bounds.iter().zip(&self.least).map(of);
        let share = match bound {
            Bound::Low => shares.fold(f64::INFINITY, f64::min),
            Bound::High => shares.fold(0.0, f64::max),
        };
        (share > 0.5).then_some(share)
    }

    /// [[D, P], [Pᴴ, −1 − PᴴA⁻¹P]], D and P of the resonant waves, each scaled to the length of its row;
    /// its lower triangle. `real` is the share of the stiff waves in PᴴA⁻¹P.
    fn core(
        &self,
        [sum, difference]: [&[f64]; 2],
        resonant: &[Resonant],
        mut real: Mat<f64>,
    ) -> Mat<c64> {
        let Rows { waves, both } = &self.soft;
        let (rows, count) = (waves.len(), both.ncols());
        let (cosine, sine) = both.split_at_row(rows);
        // With C = `cosine`, S = `sine`, Σ = diag(`sum`) and Δ = diag(`difference`), the lower triangle of
        // CᵀΣC + SᵀΣS is added to `real`, and `mixed` is SᵀΔC.
        let mut scaled = self.soft.scaled([sum, sum]);
        add_lower_product(&mut real, both, &scaled);
        for k in 0..count {
            let own = &both.col_as_slice(k)[..rows];
            let scaled = scaled.col_as_slice_mut(k)[..rows].iter_mut();
            for ((scaled, x), w) in scaled.zip(own).zip(difference) {
                *scaled = x * w;
            }
        }
        let mixed = sine.transpose() * scaled.subrows(0, rows);
        let near = resonant.len();
        let mut core = Mat::zeros(near + count, near + count);
        for (i, wave) in resonant.iter().enumerate() {
            let size = waves[wave.row].size.sqrt();
            let factor = if size > 0.0 { 1.0 / size } else { 1.0 };
            core[(i, i)] = c64::new(factor * factor * wave.d, 0.0);
            for k in 0..count {
                let (cosine, sine) = (cosine[(wave.row, k)], sine[(wave.row, k)]);
                core[(near + k, i)] = c64::new(factor * cosine, factor * wave.turned * sine);
            }
        }
        for k in 0..count {
            for i in k..count {
                let unit = if i == k { 1.0 } else { 0.0 };
                let imaginary = mixed[(i, k)] - mixed[(k, i)];
                core[(near + i, near + k)] = c64::new(-unit - real[(i, k)], -imaginary);
            }
        }
        core
    }
}

/// sum += LᵀR, lower triangle.
fn add_lower_product(sum: &mut Mat<f64>, left: &Mat<f64>, right: &Mat<f64>) {
    triangular::matmul(
        sum.as_mut(),
        BlockStructure::TriangularLower,
        Accum::Add,
        left.transpose(),
        BlockStructure::Rectangular,
        right.as_ref(),
        BlockStructure::Rectangular,
        1.0,
        Par::Seq,
    );
}

/// A wave that is not eliminated, because d is small.
struct Resonant {
    /// Index of its row among the soft waves.
    row: usize,
    /// 1 for e^{inθ}, −1 for e^{−inθ}.
    turned: f64,
    /// Diagonal element of A.
    d: f64,
}
