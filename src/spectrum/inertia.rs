//! How many eigenvalues of L(iω) are negative, on the whole basis and without its modes.
//!
//! Seen from the blade, a wave of n nodal diameters that turns at frequency ω in space has frequency
//! ω + nΩ, and −n for the opposite one. Without guides
//!
//! L(iω) = K(Ω) − ω² + iω 2ΩG
//!
//! is therefore block diagonal with the real symmetric blocks B_n(Ω) − (ω ± nΩ)², B_n = K_b + K_m +
//! Ω²K_σ. The guides add K_g = PPᵀ, few columns, and Haynsworth's additivity of inertia (Linear
//! Algebra Appl. 1, 1968) gives
//!
//! n₋(A + PPᵀ) = n₋(A) + n₋(−1 − PᴴA⁻¹P) − columns.
//!
//! **Boxes.** If L_low ≤ L ≤ L_high, in the sense of their quadratic forms, all along a line ω(Ω) and both
//! have the same number of negative eigenvalues, then L is nonsingular on the whole line: no
//! mode meets it. B_n(Ω) grows with Ω, for K_σ ≥ 0, and (ω ± nΩ)² is largest and smallest at the ends of
//! the line or zero, so that two counts settle a line. What is left out of PPᵀ, and rounding, are
//! on the same footing: L_high has them in full.

mod coupling;
mod damped;
mod jacobi;
mod solved;
mod waves;

use std::ops::Range;
use std::sync::OnceLock;

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par, Scale, c64};
use nalgebra::{DMatrix, Dyn, SymmetricEigen};

pub use self::damped::DampedBasis;

use self::coupling::{Columns, Coupling, LOOKS, in_waves};
use self::jacobi::Eigenvectors;
use self::waves::Waves;
use super::component::frequency_scale;
use super::hermitian::negative_eigenvalues;
use crate::plate::{HarmonicBlock, Plate};
use crate::system::GyroscopicSystem;

/// The blade and what couples its harmonics, without damping.
#[derive(Debug)]
pub struct WholeBasis {
    harmonics: Vec<Harmonic>,
    coupling: Coupling,
}

/// One harmonic in the frame of the blade.
#[derive(Debug)]
pub struct Harmonic {
    /// n.
    pub diameters: usize,
    /// Index of its first unknown in the basis of the plate.
    pub first: usize,
    /// K_b + K_m.
    rest: DMatrix<f64>,
    /// K_σ.
    tension: DMatrix<f64>,
    /// By how much K_σ falls short of being positive: rounding.
    shortfall: f64,
    /// Of the waves at rest, in 1/s²: what is small beside it may be left out. T = B(0) + σ, which is positive, and more
    /// for waves so stiff that a good share of their stiffness changes nothing.
    pub weights: Vec<f64>,
    /// σ.
    shift: f64,
    /// The waves at rest, near those of every speed: of K_b + K_m.
    pub resting: SymmetricEigen<f64, Dyn>,
    /// K_σ in these.
    resting_tension: DMatrix<f64>,
}

/// Share of T = B(0) + σ that rounding may change L by.
const ROUNDING: f64 = 1e-11;
/// Lines lie below this multiple of the blade's frequency scale, for the most part: those above are counted, with less
/// certainty.
const HIGH_LINE: f64 = 6.0;
/// A wave that is so many times as stiff as those that lines meet may be made stiffer by a thousand times the share that these
/// may: its flexibility hardly counts.
const MOST_WEIGHT: f64 = 100.0;
/// A wave with a stiffness of so many times (ω + nΩ)² is as good as at rest, in each look.
const STIFF: [Option<f64>; LOOKS] = [Some(1e2), Some(1e4)];
/// Share of the speed beyond which a line is so long that more columns do not help.
const LONG: f64 = 1e-3;

impl WholeBasis {
    /// Of a plate; its damping is left aside.
    pub fn new(plate: &Plate) -> Self {
        let harmonics = Self::harmonics(plate);
        let order = plate.degrees_of_freedom();
        let guides = plate.contact.stiffness();
        let columns = match (&plate.edge_stiffness, guides) {
            (None, Some(guides)) => Columns::new(guides, &harmonics),
            (None, None) => Columns::new(&Mat::zeros(order, order), &harmonics),
            (Some(_), _) => None,
        };
        let coupling = columns.map_or_else(
            || {
                let mut sum = Mat::zeros(order, order);
                for term in [guides, plate.edge_stiffness.as_ref()]
                    .into_iter()
                    .flatten()
                {
                    sum += term;
                }
                Coupling::Dense(in_waves(&sum, &harmonics))
            },
            |columns| Coupling::Columns(Box::new(columns)),
        );
        WholeBasis {
            harmonics,
            coupling,
        }
    }

    fn harmonics(plate: &Plate) -> Vec<Harmonic> {
        let scale = frequency_scale(plate);
        let harmonic =
            |block: &HarmonicBlock| Harmonic::new(block, plate.offset(block.diameters), scale);
        plate.harmonics.iter().map(harmonic).collect()
    }

    /// L(σ) = K(Ω) + σ² + σ 2ΩG at a real σ, in units of σ², with what is left out of PPᵀ left out.
    /// `None` where edge loads couple every wave with every other.
    pub fn shifted(&self, speed_rad_per_s: f64, shift_per_s: f64) -> Option<ShiftedBlocks> {
        let Coupling::Columns(columns) = &self.coupling else {
            return None;
        };
        let square = shift_per_s.powi(2);
        let blocks = self.harmonics.iter().map(|h| {
            let carried = h.diameters as f64 * speed_rad_per_s;
            let mut block = (&h.rest + &h.tension * speed_rad_per_s.powi(2)) / square;
            (0..h.radial()).for_each(|i| block[(i, i)] += 1.0 - carried.powi(2) / square);
            ShiftedBlock {
                firsts: h.firsts().collect(),
                block,
                turning: 2.0 * carried / shift_per_s,
            }
        });
        Some(ShiftedBlocks {
            blocks: blocks.collect(),
            columns: Scale(1.0 / shift_per_s) * columns.few(),
            taken_away: 0,
        })
    }

    /// K₀, with what is left out of PPᵀ left out. Heave and tilt may have no stiffness but that of the guides: the
    /// blocks hold them, and columns take away what they add. `None` as for [`Self::shifted`].
    pub fn at_rest(&self) -> Option<ShiftedBlocks> {
        let Coupling::Columns(columns) = &self.coupling else {
            return None;
        };
        let columns = columns.few().to_owned();
        let mut held: Vec<(usize, f64)> = Vec::new();
        let blocks = self.harmonics.iter().map(|h| {
            let mut block = h.rest.clone();
            if h.diameters <= 1 {
                block[(0, 0)] += h.shift;
                held.extend(h.firsts().map(|first| (first, h.shift.sqrt())));
            }
            ShiftedBlock {
                firsts: h.firsts().collect(),
                block,
                turning: 0.0,
            }
        });
        let blocks = blocks.collect();
        let holding = Mat::from_fn(columns.nrows(), held.len(), |i, k| match held[k] {
            (first, root) if first == i => root,
            _ => 0.0,
        });
        Some(ShiftedBlocks {
            blocks,
            columns: faer::concat![[columns, holding]],
            taken_away: held.len(),
        })
    }

    /// Whether the columns leave out no more than rounding.
    pub fn is_exact(&self) -> bool {
        matches!(&self.coupling, Coupling::Columns(columns) if columns.is_exact)
    }

    /// K₀X, (K_σ − N)X and GX with all columns that there are. `None` as for [`Self::shifted`].
    pub fn times(&self, x: MatRef<'_, f64>) -> Option<GyroscopicSystem> {
        let Coupling::Columns(columns) = &self.coupling else {
            return None;
        };
        let columns = &columns.unknowns;
        let mut stiffness = columns * (columns.transpose() * x);
        let [mut spin, mut gyroscopic] = [0, 1].map(|_| Mat::zeros(x.nrows(), x.ncols()));
        for h in &self.harmonics {
            let (n, radial) = (h.diameters as f64, h.radial());
            let whole = |block: &DMatrix<f64>| Mat::from_fn(radial, radial, |i, k| block[(i, k)]);
            let (rest, mut tension) = (whole(&h.rest), whole(&h.tension));
            (0..radial).for_each(|i| tension[(i, i)] -= n * n);
            for first in h.firsts() {
                let own = x.subrows(first, radial);
                for (block, sum) in [(&rest, &mut stiffness), (&tension, &mut spin)] {
                    let into = sum.subrows_mut(first, radial);
                    matmul(into, Accum::Add, block, own, 1.0, Par::Seq);
                }
            }
            if h.diameters > 0 {
                let (cosine, sine) = (h.first, h.first + radial);
                for (to, from, n) in [(cosine, sine, n), (sine, cosine, -n)] {
                    let turned = Scale(n) * x.subrows(from, radial);
                    gyroscopic.subrows_mut(to, radial).copy_from(turned);
                }
            }
        }
        Some(GyroscopicSystem::undamped(stiffness, spin, gyroscopic))
    }

    /// Where 2ΩG is not zero: (row, column, value).
    pub fn turning(&self, speed_rad_per_s: f64) -> Vec<(usize, usize, f64)> {
        let turned = self.harmonics.iter().filter(|h| h.diameters > 0);
        let entries = turned.flat_map(|h| {
            let value = 2.0 * speed_rad_per_s * h.diameters as f64;
            (0..h.radial()).flat_map(move |j| {
                let (cosine, sine) = (h.first + j, h.first + h.radial() + j);
                [(cosine, sine, value), (sine, cosine, -value)]
            })
        });
        entries.collect()
    }

    /// The lowest wave of every number of nodal diameters at rest, N × (2 n_max + 1), without guides.
    pub fn first_waves(&self) -> Mat<f64> {
        let places = self
            .harmonics
            .iter()
            .flat_map(|h| h.firsts().map(move |first| (h, first)));
        let places: Vec<(&Harmonic, usize)> = places.collect();
        let order = self
            .harmonics
            .iter()
            .map(|h| h.radial() * h.firsts().count());
        let mut waves = Mat::zeros(order.sum(), places.len());
        for (k, (h, first)) in places.into_iter().enumerate() {
            let lowest = h.resting.eigenvalues.imin();
            for j in 0..h.radial() {
                waves[(first + j, k)] = h.resting.eigenvectors[(j, lowest)];
            }
        }
        waves
    }

    /// Number of waves of the undamped blade at rest below a frequency, where that is certain.
    pub fn modes_at_rest_below(&self, frequency_rad_per_s: f64) -> Option<usize> {
        let rest = self.at(0.0);
        self.count_along([&rest, &rest], [frequency_rad_per_s; 2])
    }

    /// Number of critical speeds below a speed, where that is certain: K₀ is positive definite.
    pub fn critical_speeds_below(&self, speed_rad_per_s: f64) -> Option<usize> {
        let at = self.at(speed_rad_per_s);
        self.count_along([&at, &at], [0.0; 2])
    }

    /// Whether a count needs a factorization of the order of the basis.
    pub fn is_dense(&self) -> bool {
        matches!(self.coupling, Coupling::Dense(_))
    }

    /// What counts at a speed have in common.
    pub fn at(&self, speed_rad_per_s: f64) -> AtSpeed {
        let stiffness = |h: &Harmonic| &h.rest + &h.tension * speed_rad_per_s.powi(2);
        AtSpeed {
            speed_rad_per_s,
            blocks: self.harmonics.iter().map(stiffness).collect(),
            waves: Default::default(),
        }
    }

    /// Number of negative eigenvalues of L(iω) all along a line between two speeds, given by its
    /// frequencies at both. `None` where that is not certain: a mode may meet the line.
    pub fn count_along(&self, ends: [&AtSpeed; 2], line: [f64; 2]) -> Option<usize> {
        self.looks(ends).find_map(|look| {
            let low = self.bound(ends, line, Bound::Low, look)?;
            let high = self.bound(ends, line, Bound::High, look)?;
            (low == high).then_some(low)
        })
    }

    /// Whether the number is `count` all along a line.
    pub fn is_count_along(&self, ends: [&AtSpeed; 2], line: [f64; 2], count: usize) -> bool {
        let is_count = |look, bound| self.bound(ends, line, bound, look) == Some(count);
        self.looks(ends)
            .any(|look| is_count(look, Bound::Low) && is_count(look, Bound::High))
    }

    /// More columns help only a short line.
    fn looks(&self, [a, b]: [&AtSpeed; 2]) -> Range<usize> {
        let is_long = b.speed_rad_per_s - a.speed_rad_per_s > LONG * b.speed_rad_per_s;
        match &self.coupling {
            Coupling::Columns(columns)
                if !is_long && columns.rests[LOOKS - 1].0 > columns.rests[0].0 =>
            {
                0..LOOKS
            }
            _ => 0..1,
        }
    }

    /// Negative eigenvalues of L_low or L_high along a line.
    fn bound(
        &self,
        [a, b]: [&AtSpeed; 2],
        line: [f64; 2],
        bound: Bound,
        look: usize,
    ) -> Option<usize> {
        let speeds = [a, b].map(|at| at.speed_rad_per_s);
        let rest = match &self.coupling {
            Coupling::Columns(columns) => columns.rests[look].1,
            Coupling::Dense(_) => 0.0,
        };
        let blocks = self.harmonics.iter().map(|h| {
            let n = h.diameters as f64;
            let of = |n: f64| bound.of_square([0, 1].map(|end| line[end] + n * speeds[end]));
            let more = h.shortfall * (speeds[1].powi(2) - speeds[0].powi(2));
            let shift = h.shift + h.shortfall * speeds[1].powi(2);
            let share = bound.sign() * ROUNDING;
            BoundedBlock {
                share,
                more: share * shift + bound.sign() * more,
                turning: [of(n), of(-n)],
            }
        });
        let blocks: Vec<BoundedBlock> = blocks.collect();
        let at = if bound == Bound::Low { a } else { b };
        match &self.coupling {
            Coupling::Columns(columns) => {
                let waves = at.waves[look][bound as usize].get_or_init(|| {
                    let free = self.free_waves(at.speed_rad_per_s, bound.share(rest));
                    let waves = Waves::new(&free, columns, columns.rests[look].0);
                    match STIFF[look] {
                        Some(stiff) => {
                            waves.with_stiff_together(&self.harmonics, at.speed_rad_per_s, stiff)
                        }
                        None => waves,
                    }
                });
                waves.count(&self.harmonics, &blocks, bound)
            }
            Coupling::Dense(coupling) => {
                let mut matrix = coupling.clone();
                self.add_blocks(&mut matrix, &at.blocks, &blocks);
                negative_eigenvalues(&matrix)
            }
        }
    }

    /// The waves of every block at a speed, with a share of the weights added to it, in those at rest.
    fn free_waves(&self, speed_rad_per_s: f64, share: f64) -> Vec<Eigenvectors> {
        let square = speed_rad_per_s.powi(2);
        let turned = self.harmonics.iter().map(|h| {
            let mut turned = &h.resting_tension * square;
            for (i, own) in h.resting.eigenvalues.iter().enumerate() {
                turned[(i, i)] += own + share * h.weights[i];
            }
            turned
        });
        turned.map(Eigenvectors::of).collect()
    }

    fn add_blocks(
        &self,
        matrix: &mut Mat<c64>,
        stiffness: &[DMatrix<f64>],
        bounds: &[BoundedBlock],
    ) {
        let mut first = 0;
        let blocks = self.harmonics.iter().zip(stiffness).zip(bounds);
        for ((harmonic, stiffness), bound) in blocks {
            for sign in harmonic.signs() {
                for (k, column) in stiffness.column_iter().enumerate() {
                    for (j, value) in column.iter().enumerate() {
                        matrix[(first + j, first + k)] += value * (1.0 + bound.share);
                    }
                    let diagonal = bound.more - bound.turning[sign];
                    matrix[(first + k, first + k)] += c64::new(diagonal, 0.0);
                }
                first += harmonic.radial();
            }
        }
    }
}

/// Blocks and columns of a matrix, blocks + P diag(1 … 1, −1 … −1) Pᵀ.
pub struct ShiftedBlocks {
    pub blocks: Vec<ShiftedBlock>,
    /// P, N × columns.
    pub columns: Mat<f64>,
    /// Number of the last columns, that are taken away.
    pub taken_away: usize,
}

/// Of one harmonic: the same block for cosines and sines, and ±`turning` between them.
pub struct ShiftedBlock {
    /// Index of the first cosine, and of the first sine.
    pub firsts: Vec<usize>,
    pub block: DMatrix<f64>,
    /// 2Ωn, which sines add to the force on cosines.
    pub turning: f64,
}

/// B_n at a speed, and its waves once they are asked for.
#[derive(Debug)]
pub struct AtSpeed {
    speed_rad_per_s: f64,
    blocks: Vec<DMatrix<f64>>,
    /// Of each look, for both bounds.
    waves: [[OnceLock<Waves>; 2]; LOOKS],
}

/// Of a bound (1 + share) B_n + more − (ω ± nΩ)².
struct BoundedBlock {
    share: f64,
    more: f64,
    /// (ω + nΩ)² and (ω − nΩ)².
    turning: [f64; 2],
}

impl Harmonic {
    fn new(block: &HarmonicBlock, first: usize, frequency_scale: f64) -> Self {
        let radial = block.bending.nrows();
        let n2 = (block.diameters * block.diameters) as f64;
        let tension = &block.spin + DMatrix::from_diagonal_element(radial, radial, n2);
        let mut rest = block.bending.clone();
        if let Some(membrane) = &block.membrane {
            rest += membrane;
        }
        let least = |matrix: &DMatrix<f64>| matrix.symmetric_eigenvalues().min();
        let resting = rest.clone().symmetric_eigen();
        let shift = frequency_scale.powi(2) + 2.0 * (-resting.eigenvalues.min()).max(0.0);
        let resting_tension = resting.eigenvectors.tr_mul(&tension) * &resting.eigenvectors;
        Harmonic {
            diameters: block.diameters,
            first,
            shortfall: (-least(&tension)).max(0.0),
            weights: resting
                .eigenvalues
                .iter()
                .map(|own| weight(own + shift, shift))
                .collect(),
            rest,
            tension,
            shift,
            resting,
            resting_tension,
        }
    }

    /// J.
    pub fn radial(&self) -> usize {
        self.rest.nrows()
    }

    /// Index of the first cosine, and of the first sine.
    pub fn firsts(&self) -> impl Iterator<Item = usize> + use<> {
        let (first, radial) = (self.first, self.radial());
        let phases = if self.diameters == 0 { 1 } else { 2 };
        (0..phases).map(move |phase| first + phase * radial)
    }

    /// (ω + nΩ)² of a line high up.
    fn fast_turning(&self, speed_rad_per_s: f64) -> f64 {
        (HIGH_LINE * self.shift.sqrt() + self.diameters as f64 * speed_rad_per_s).powi(2)
    }

    /// Indices of its waves among e^{inθ} and e^{−inθ}: for n = 0 they are one.
    fn signs(&self) -> impl Iterator<Item = usize> + use<> {
        0..if self.diameters == 0 { 1 } else { 2 }
    }
}

/// Of a wave with T at rest.
fn weight(own: f64, shift: f64) -> f64 {
    let stiffer = own / (HIGH_LINE.powi(2) * shift);
    own * stiffer.clamp(1.0, MOST_WEIGHT)
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Bound {
    Low,
    High,
}

impl Bound {
    fn sign(self) -> f64 {
        match self {
            Bound::Low => -1.0,
            Bound::High => 1.0,
        }
    }

    /// Share of the weights to add for what the columns leave out.
    fn share(self, rest: f64) -> f64 {
        match self {
            Bound::Low => 0.0,
            Bound::High => rest,
        }
    }

    /// What to subtract for the square of a number between two.
    fn of_square(self, ends: [f64; 2]) -> f64 {
        let [x, y] = ends.map(|end| end * end);
        match self {
            Bound::Low => x.max(y),
            Bound::High if ends[0] * ends[1] <= 0.0 => 0.0,
            Bound::High => x.min(y),
        }
    }
}

#[cfg(test)]
mod tests;
