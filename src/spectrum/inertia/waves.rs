//! L in the waves of the free blade, of which B_n is diagonal.

use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::{Accum, Mat, Par, Scale, c64};

use super::coupling::Columns;
use super::jacobi::Eigenvectors;
use super::{Bound, BoundedBlock, Harmonic};
use crate::spectrum::hermitian::negative_eigenvalues;

/// A wave of which |p|²/|d| is above this is not eliminated: what is added for it would drown the rest.
const RESONANT: f64 = 1e5;

/// The waves of a speed.
#[derive(Debug)]
pub struct Waves {
    rows: Vec<Row>,
    /// Rows of the columns for cosines, and below them for sines.
    both: Mat<f64>,
    /// The stiff ones, where they are taken together.
    stiff: Option<Stiff>,
}

/// e^{inθ} and e^{−inθ} of one eigenvalue of a block.
#[derive(Debug)]
struct Row {
    /// Index of its harmonic.
    harmonic: usize,
    /// The eigenvalue.
    stiffness: f64,
    /// |p|², its squares in both rows of the columns.
    size: f64,
}

/// Waves of which D is nearly their stiffness B: PᴴD⁻¹P is that of B, times a factor.
#[derive(Debug)]
struct Stiff {
    /// PᴴB⁻¹P, real; its lower triangle.
    compliance: Mat<f64>,
    /// Least stiffness of each harmonic.
    least: Vec<f64>,
}

impl Waves {
    /// With the first columns alone.
    pub fn new(free: &[Eigenvectors], columns: &Columns, count: usize) -> Self {
        let total = columns.resting.nrows() / 2;
        let mut both = Mat::zeros(2 * total, count);
        let mut rows = Vec::with_capacity(total);
        for (harmonic, block) in free.iter().enumerate() {
            let (row, radial) = (rows.len(), block.values.len());
            let turn = Mat::from_fn(radial, radial, |i, j| block.vectors[(j, i)]);
            for first in [row, total + row] {
                let own = columns.resting.get(first..first + radial, ..count);
                let turned = both.subrows_mut(first, radial);
                matmul(turned, Accum::Replace, &turn, own, 1.0, Par::Seq);
            }
            rows.extend(block.values.iter().map(|&stiffness| Row {
                harmonic,
                stiffness,
                size: 0.0,
            }));
        }
        for k in 0..count {
            let (cosine, sine) = both.col_as_slice(k).split_at(total);
            for (row, (x, y)) in rows.iter_mut().zip(cosine.iter().zip(sine)) {
                row.size += x * x + y * y;
            }
        }
        Waves {
            rows,
            both,
            stiff: None,
        }
    }

    /// The same with its stiff waves taken together, so that a count takes the others alone. They are those with a stiffness
    /// of so many times (ω + nΩ)².
    pub fn with_stiff_together(
        self,
        harmonics: &[Harmonic],
        speed_rad_per_s: f64,
        stiff: f64,
    ) -> Self {
        let total = self.rows.len();
        let is_stiff = |row: &Row| {
            let turning = harmonics[row.harmonic].fast_turning(speed_rad_per_s);
            row.stiffness > stiff * turning && row.size < 0.5 * RESONANT * row.stiffness
        };
        let (stiff, soft): (Vec<usize>, Vec<usize>) =
            (0..total).partition(|&row| is_stiff(&self.rows[row]));
        let mut least = vec![f64::INFINITY; harmonics.len()];
        let mut scaled = Mat::zeros(2 * stiff.len(), self.both.ncols());
        for (i, &place) in stiff.iter().enumerate() {
            let row = &self.rows[place];
            least[row.harmonic] = least[row.harmonic].min(row.stiffness);
            let waves = harmonics[row.harmonic].signs().count() as f64;
            let root = (waves / row.stiffness).sqrt();
            for (to, from) in [(i, place), (stiff.len() + i, total + place)] {
                let scaled = scaled.row_mut(to);
                faer::zip!(scaled, self.both.row(from))
                    .for_each(|faer::unzip!(to, from)| *to = root * from);
            }
        }
        let mut compliance = Mat::zeros(scaled.ncols(), scaled.ncols());
        add_lower_product(&mut compliance, &scaled, &scaled);
        let both = Mat::from_fn(2 * soft.len(), self.both.ncols(), |i, k| {
            match i.checked_sub(soft.len()) {
                Some(i) => self.both[(total + soft[i], k)],
                None => self.both[(soft[i], k)],
            }
        });
        let mut kept = soft.into_iter().peekable();
        let rows = self.rows.into_iter().enumerate();
        let rows = rows.filter(|(row, _)| kept.next_if_eq(row).is_some());
        Waves {
            rows: rows.map(|(_, row)| row).collect(),
            both,
            stiff: Some(Stiff { compliance, least }),
        }
    }

    /// n₋(A + PPᴴ) of a bound by way of −1 − PᴴA⁻¹P over the waves that are eliminated, bordered by those that
    /// are next to resonance. `None` where it is not certain.
    pub fn count(
        &self,
        harmonics: &[Harmonic],
        bounds: &[BoundedBlock],
        bound: Bound,
    ) -> Option<usize> {
        let count = self.rows.len();
        // Sum and difference of 1/d of the waves e^{inθ} and e^{−inθ}.
        let (mut sum, mut difference) = (vec![0.0; count], vec![0.0; count]);
        let mut resonant: Vec<Resonant> = Vec::new();
        let mut negative = 0;
        for (place, row) in self.rows.iter().enumerate() {
            let bound = &bounds[row.harmonic];
            let stiffness = (1.0 + bound.share) * row.stiffness + bound.more;
            for sign in harmonics[row.harmonic].signs() {
                let turned = [1.0, -1.0][sign];
                let d = stiffness - bound.turning[sign];
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
        let mut compliance = Mat::zeros(self.both.ncols(), self.both.ncols());
        if let Some(stiff) = &self.stiff {
            compliance = Scale(1.0 / stiff.share(bounds, bound)?) * &stiff.compliance;
        }
        let core = self.core([&sum, &difference], &resonant, compliance);
        (negative + negative_eigenvalues(&core)?).checked_sub(self.both.ncols())
    }

    /// Each row of the columns times its weight, of cosines and of sines.
    fn scaled(&self, weights: [&[f64]; 2]) -> Mat<f64> {
        let (rows, count) = (self.rows.len(), self.both.ncols());
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

    /// [[D, P], [Pᴴ, −1 − PᴴA⁻¹P]], D and P of the resonant waves, each scaled to the length of its row;
    /// its lower triangle. `real` is the share of the stiff waves in PᴴA⁻¹P.
    fn core(
        &self,
        [sum, difference]: [&[f64]; 2],
        resonant: &[Resonant],
        mut real: Mat<f64>,
    ) -> Mat<c64> {
        let (rows, count) = (self.rows.len(), self.both.ncols());
        let (cosine, sine) = self.both.split_at_row(rows);
        // CᵀΣC + SᵀΣS, of which the lower triangle, and SᵀΔC.
        let mut scaled = self.scaled([sum, sum]);
        add_lower_product(&mut real, &self.both, &scaled);
        for k in 0..count {
            let own = &self.both.col_as_slice(k)[..rows];
            let scaled = scaled.col_as_slice_mut(k)[..rows].iter_mut();
            for ((scaled, x), w) in scaled.zip(own).zip(difference) {
                *scaled = x * w;
            }
        }
        let scaled = scaled.subrows(0, rows);
        let mixed = sine.transpose() * scaled;
        let near = resonant.len();
        let mut core = Mat::zeros(near + count, near + count);
        for (i, wave) in resonant.iter().enumerate() {
            let size = self.rows[wave.row].size.sqrt();
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

impl Stiff {
    /// The least D/B of a lower bound, the largest of an upper one. `None` where a wave is not stiff at all.
    fn share(&self, bounds: &[BoundedBlock], bound: Bound) -> Option<f64> {
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
}

/// sum += LᵀR, of which the lower triangle.
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

/// A wave next to resonance.
struct Resonant {
    row: usize,
    /// Of e^{inθ} 1, of e^{−inθ} −1.
    turned: f64,
    d: f64,
}
