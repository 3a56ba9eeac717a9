//! Number of negative eigenvalues of L(iω) of the undamped blade, computed without its modes.
//!
//! L(iω) = K(Ω) − ω² + iω 2ΩG is block diagonal with the real symmetric blocks B_n(Ω) − (ω ± nΩ)² without
//! guides, B_n = K_b + K_m + Ω²K_σ. The guides add K_g = PPᵀ with few columns, and Haynsworth's additivity of
//! inertia (Linear Algebra Appl. 1, 1968) gives
//!
//! n₋(A + PPᵀ) = n₋(A) + n₋(−1 − PᴴA⁻¹P) − columns.
//!
//! **Boxes.** If L_low ≤ L ≤ L_high, in the sense of quadratic forms, all along a line ω(Ω), and both have
//! the same number of negative eigenvalues, then L is nonsingular on the whole line, and no mode crosses it.
//! B_n(Ω) grows with Ω because K_σ ≥ 0, and (ω ± nΩ)² is largest and smallest at the ends of the line or
//! zero, so two counts suffice for a line. The neglected part of PPᵀ and rounding are included in the same
//! way: L_high contains them in full.

mod bound;
mod free_waves;
mod jacobi;
mod waves;

use std::ops::Range;
use std::sync::OnceLock;

use faer::{Mat, c64};

use self::bound::{Bound, BoundedBlock};
use self::free_waves::FreeWaves;
use self::jacobi::LEFT;
use self::waves::Waves;
use super::coupling::{Coupling, LOOKS, Part};
use super::{FullModel, Harmonic};
use crate::modes::hermitian_inertia::negative_eigenvalues;

/// Share of T = B(0) + σ by which rounding may change L.
const ROUNDING: f64 = 1e-11;
/// A wave is stiff, and treated as if it were at rest, if its stiffness is this multiple of (ω + nΩ)² of a
/// line at high frequency, for each stage.
const STIFF: [f64; LOOKS] = [1e2, 1e4];
/// Length of a line in speed, relative to the speed, above which more columns do not help.
const LONG: f64 = 1e-3;

impl FullModel {
    /// Number of modes of the undamped blade at rest below a frequency, if it is certain.
    pub fn modes_at_rest_below(&self, frequency_rad_per_s: f64) -> Option<usize> {
        let rest = self.at(0.0);
        self.count_along([&rest, &rest], [frequency_rad_per_s; 2])
    }

    /// Number of critical speeds below a speed, if it is certain, for positive definite K₀.
    pub fn critical_speeds_below(&self, speed_rad_per_s: f64) -> Option<usize> {
        let at = self.at(speed_rad_per_s);
        self.count_along([&at, &at], [0.0; 2])
    }

    /// Data common to the counts at a speed.
    pub fn at(&self, speed_rad_per_s: f64) -> AtSpeed {
        AtSpeed {
            speed_rad_per_s,
            free: OnceLock::new(),
            waves: Default::default(),
        }
    }

    /// Number of negative eigenvalues of L(iω) along a line between two speeds, given by its frequencies at
    /// both. `None` if it is not certain that no mode crosses the line.
    pub fn count_along(&self, ends: [&AtSpeed; 2], line: [f64; 2]) -> Option<usize> {
        self.looks(ends).find_map(|look| {
            let low = self.bound(ends, line, Bound::Low, look)?;
            let high = self.bound(ends, line, Bound::High, look)?;
            (low == high).then_some(low)
        })
    }

    /// Whether the number of negative eigenvalues is proven to be `count` all along a line.
    pub fn is_count_along(&self, ends: [&AtSpeed; 2], line: [f64; 2], count: usize) -> bool {
        let is_count = |look, bound| self.bound(ends, line, bound, look) == Some(count);
        self.looks(ends)
            .any(|look| is_count(look, Bound::Low) && is_count(look, Bound::High))
    }

    /// Stages in which a line is examined: one for a long line, for which more columns do not help.
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
        let at = if bound == Bound::Low { a } else { b };
        let blocks = self.bounded_blocks([a, b], line, bound);
        match &self.coupling {
            Coupling::Columns(columns) => {
                let (_, rest) = columns.rests[look];
                let waves = at.waves[look].get_or_init(|| {
                    let free = at.free.get_or_init(|| self.free_waves(at.speed_rad_per_s));
                    let is_stiff = |harmonic: usize, stiffness: f64| {
                        let turning = self.harmonics[harmonic].fast_turning(at.speed_rad_per_s);
                        stiffness > STIFF[look] * turning
                    };
                    let of = |part: &Part| {
                        let own = part.resting.subcols(0, part.counts[look]);
                        Waves::new(free, own, &part.harmonics, is_stiff)
                    };
                    columns.parts.iter().map(of).collect()
                });
                let counts = waves
                    .iter()
                    .map(|waves| waves.count(&self.harmonics, &blocks, bound, rest));
                counts.sum()
            }
            Coupling::Dense(coupling) => {
                let mut matrix = coupling.clone();
                self.add_blocks(&mut matrix, at.speed_rad_per_s, &blocks);
                negative_eigenvalues(&matrix)
            }
        }
    }

    fn bounded_blocks(
        &self,
        ends: [&AtSpeed; 2],
        line: [f64; 2],
        bound: Bound,
    ) -> Vec<BoundedBlock> {
        let speeds = ends.map(|at| at.speed_rad_per_s);
        let blocks = self.harmonics.iter().map(|h| {
            let n = h.diameters as f64;
            let of = |n: f64| bound.of_square([0, 1].map(|end| line[end] + n * speeds[end]));
            let more = h.shortfall * (speeds[1].powi(2) - speeds[0].powi(2));
            let shift = h.shift + h.shortfall * speeds[1].powi(2);
            let share = bound.sign() * (ROUNDING + h.radial() as f64 * LEFT);
            BoundedBlock {
                share,
                more: share * shift + bound.sign() * more,
                turning: [of(n), of(-n)],
            }
        });
        blocks.collect()
    }

    fn free_waves(&self, speed_rad_per_s: f64) -> Vec<FreeWaves> {
        let of = |h: &Harmonic| FreeWaves::new(h, speed_rad_per_s);
        self.harmonics.iter().map(of).collect()
    }

    fn add_blocks(&self, matrix: &mut Mat<c64>, speed_rad_per_s: f64, bounds: &[BoundedBlock]) {
        let mut first = 0;
        for (harmonic, bound) in self.harmonics.iter().zip(bounds) {
            let stiffness = harmonic.stiffness(speed_rad_per_s);
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

/// A speed with the data common to its counts, which are computed when first needed.
#[derive(Debug)]
pub struct AtSpeed {
    speed_rad_per_s: f64,
    /// Waves of the free blade, for every harmonic.
    free: OnceLock<Vec<FreeWaves>>,
    /// Waves of each part of the coupling with the columns of each stage.
    waves: [OnceLock<Vec<Waves>>; LOOKS],
}

#[cfg(test)]
mod tests;
