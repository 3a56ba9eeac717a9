//! L(λ) with its blocks eliminated: its solves, and the argument of its determinant.
//!
//! L = A + PWPᵀ with A block diagonal in the number of nodal diameters, and by the Sherman–Morrison–Woodbury
//! identity
//!
//! L⁻¹ = A⁻¹ − A⁻¹P S⁻¹ W PᵀA⁻¹,  det L = det A · det S,  S = 1 + W PᵀA⁻¹P.
//!
//! For a pair of cosines c and sines s, A has a block for c + is and one for c − is; with their inverses V₊
//! and V₋, that of the pair is [[X, −Y], [Y, X]], X = (V₊ + V₋)/2 and Y = (V₊ − V₋)/2i. All blocks are
//! symmetric, so that transposition changes the sign of Y. For a real λ V₋ is the conjugate of V₊, and X and
//! Y are real.

use std::ops::{Add, AddAssign, Mul, MulAssign};

use faer::linalg::matmul::matmul;
use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::traits::ComplexField;
use faer::traits::math_utils::from_f64;
use faer::{Accum, Mat, MatRef, Par, c64, unzip, zip};
use nalgebra::DMatrix;

use super::harmonic::Harmonic;

/// Number type of λ: real or complex.
pub trait Shift:
    ComplexField<Real = f64>
    + Copy
    + Into<c64>
    + Add<Output = Self>
    + AddAssign
    + Mul<Output = Self>
    + MulAssign
{
    /// Converts a complex number, which for a real type must be real.
    fn of(number: c64) -> Self;
}

impl Shift for f64 {
    fn of(number: c64) -> Self {
        number.re
    }
}

impl Shift for c64 {
    fn of(number: c64) -> Self {
        number
    }
}

/// The inverse of the blocks of one number of nodal diameters.
#[derive(Debug)]
pub(super) struct PairInverse<T> {
    /// Index of the first cosine, and of the first sine.
    firsts: Vec<usize>,
    /// X and Y; without sines only X is used.
    halves: [Mat<T>; 2],
    /// Argument of the determinant of both blocks, in rad.
    angle: f64,
}

impl<T: Shift> PairInverse<T> {
    /// Inverts the blocks that `wave` gives for n and for −n, the wave c + is. `None` if one is singular.
    pub fn new(harmonic: &Harmonic, wave: impl Fn(f64) -> DMatrix<c64>) -> Option<Self> {
        let inverted = |n: f64| {
            let factors = wave(n).lu();
            let angle = factors.determinant().arg();
            Some((factors.try_inverse()?, angle))
        };
        let n = harmonic.diameters as f64;
        let (plus, plus_angle) = inverted(-n)?;
        let (minus, minus_angle) = match harmonic.diameters {
            0 => (plus.clone(), 0.0),
            _ if T::IS_REAL => (plus.map(|x| x.conj()), -plus_angle),
            _ => inverted(n)?,
        };
        let half = |second: f64, factor: c64| {
            Mat::from_fn(plus.nrows(), plus.ncols(), |i, k| {
                T::of((plus[(i, k)] + second * minus[(i, k)]) * factor)
            })
        };
        Some(PairInverse {
            firsts: harmonic.firsts().collect(),
            halves: [
                half(1.0, c64::new(0.5, 0.0)),
                half(-1.0, c64::new(0.0, -0.5)),
            ],
            angle: plus_angle + minus_angle,
        })
    }

    /// sum += A⁻¹ loads or A⁻ᵀ loads.
    fn add_solved(&self, loads: MatRef<'_, T>, is_transposed: bool, sum: &mut Mat<T>) {
        let [x, y] = &self.halves;
        let radial = x.nrows();
        let mut add = |to: usize, half: &Mat<T>, from: usize, factor: f64| {
            let into = sum.subrows_mut(to, radial);
            let from = loads.subrows(from, radial);
            matmul(into, Accum::Add, half, from, from_f64(factor), Par::Seq);
        };
        let sign = if is_transposed { -1.0 } else { 1.0 };
        let cosine = self.firsts[0];
        add(cosine, x, cosine, 1.0);
        if let Some(&sine) = self.firsts.get(1) {
            add(cosine, y, sine, -sign);
            add(sine, y, cosine, sign);
            add(sine, x, sine, 1.0);
        }
    }
}

/// Factorization of L(λ) by its blocks and columns.
#[derive(Debug)]
pub struct Elimination<T: ComplexField> {
    blocks: Vec<PairInverse<T>>,
    /// P, N × r.
    columns: Mat<T>,
    /// W, r × r.
    weights: Mat<T>,
    /// A⁻¹P.
    solved: Mat<T>,
    /// Factors of S.
    core: PartialPivLu<T>,
}

impl<T: Shift> Elimination<T> {
    /// Factorizes L(λ) from its inverted blocks, and its columns with the part of W that belongs to them. `None` if a
    /// value is not finite.
    pub(super) fn new(
        blocks: Vec<PairInverse<T>>,
        parts: &[(MatRef<'_, f64>, Mat<T>)],
    ) -> Option<Self> {
        let (first, _) = parts.first()?;
        let count = parts.iter().map(|(columns, _)| columns.ncols()).sum();
        let mut columns = Mat::zeros(first.nrows(), count);
        let mut weights = Mat::zeros(count, count);
        let mut at = 0;
        for (own, weight) in parts {
            let size = own.ncols();
            let into = columns.subcols_mut(at, size);
            zip!(into, own).for_each(|unzip!(into, own)| *into = from_f64(*own));
            weights.submatrix_mut(at, at, size, size).copy_from(weight);
            at += size;
        }
        let mut solved = Mat::zeros(columns.nrows(), count);
        for block in &blocks {
            block.add_solved(columns.as_ref(), false, &mut solved);
        }
        let mut core = &weights * (columns.transpose() * &solved);
        (0..count).for_each(|i| core[(i, i)] += from_f64::<T>(1.0));
        core.is_all_finite().then(|| Elimination {
            core: core.partial_piv_lu(),
            blocks,
            columns,
            weights,
            solved,
        })
    }

    /// Order N of the matrix.
    pub fn order(&self) -> usize {
        self.columns.nrows()
    }

    /// L⁻¹ times loads.
    pub fn solve(&self, loads: MatRef<'_, T>) -> Mat<T> {
        let mut found = self.blocks_solved(loads, false);
        let shares = &self.weights * (self.columns.transpose() * &found);
        found -= &self.solved * self.core.solve(shares);
        found
    }

    /// L⁻ᵀ times loads.
    pub fn solve_transposed(&self, loads: MatRef<'_, T>) -> Mat<T> {
        let found = self.blocks_solved(loads, true);
        let shares = self.core.solve_transpose(self.columns.transpose() * &found);
        let carried = &self.columns * (self.weights.transpose() * shares);
        found - self.blocks_solved(carried.as_ref(), true)
    }

    fn blocks_solved(&self, loads: MatRef<'_, T>, is_transposed: bool) -> Mat<T> {
        let mut found = Mat::zeros(loads.nrows(), loads.ncols());
        for block in &self.blocks {
            block.add_solved(loads, is_transposed, &mut found);
        }
        found
    }

    /// Argument of det L, in rad, up to whole turns. `None` if it is not finite.
    pub fn determinant_angle(&self) -> Option<f64> {
        let blocks: f64 = self.blocks.iter().map(|block| block.angle).sum();
        let swaps = if is_odd(self.core.P().arrays().0) {
            std::f64::consts::PI
        } else {
            0.0
        };
        let upper = self.core.U();
        let pivots = (0..upper.nrows()).map(|i| upper[(i, i)].into().arg());
        let angle = blocks + swaps + pivots.sum::<f64>();
        angle.is_finite().then_some(angle)
    }
}

/// Whether a permutation is odd.
fn is_odd(permutation: &[usize]) -> bool {
    let mut seen = vec![false; permutation.len()];
    let mut odd = false;
    for start in 0..permutation.len() {
        let mut at = start;
        let mut length = 0;
        while !seen[at] {
            seen[at] = true;
            at = permutation[at];
            length += 1;
        }
        odd ^= length > 0 && length % 2 == 0;
    }
    odd
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plate::{Plate, Resolution};
    use crate::model::scene::{DampingFile, GuideControllerFile, GuideFilmFile, Scene, rad_per_s};
    use crate::model::system::{GyroscopicSystem, dynamic_stiffness};
    use crate::modes::FullModel;

    const RESOLUTION: Resolution = Resolution {
        max_diameters: 18,
        radial_functions: 8,
    };

    /// Plates with one point guide and with two, for which columns are exact, without damping and with
    /// dampers proportional to the springs or not, in air and with material damping, and with a film and a
    /// controller.
    fn plates() -> Vec<Plate> {
        let points = |count: usize, damping: f64, has_laws: bool| {
            let scene = Scene::paper().edited(|saw| {
                saw.guides = vec![saw.guides[0].clone(); count];
                for (k, guide) in saw.guides.iter_mut().enumerate() {
                    guide.angle_deg += 70.0 * k as f64;
                    (guide.radial_length_m, guide.tangential_length_m) = (0.0, 0.0);
                }
                saw.guides[0].damping_n_s_per_m = damping;
                saw.guides[0].film = has_laws.then_some(GuideFilmFile { lag_s: 1e-3 });
                saw.guides[1 % count].controller = has_laws.then(|| GuideControllerFile {
                    numerator: vec![2e3, 3e6],
                    denominator: vec![1.0, 40.0, 9e4],
                });
                saw.damping = (damping > 0.0).then_some(DampingFile {
                    material_retardation_time_s: 1e-6,
                    air_n_s_per_m3: 0.5,
                    air_rotation_share: 0.3,
                    ..DampingFile::default()
                });
            });
            Plate::new(&scene.unwrap(), RESOLUTION)
        };
        [
            (1, 0.0, false),
            (2, 0.0, false),
            (1, 3.0, false),
            (2, 3.0, false),
            (2, 3.0, true),
        ]
        .map(|(n, c, has_laws)| points(n, c, has_laws))
        .into()
    }

    /// The whole matrix L(λ).
    fn whole(plate: &Plate, speed: f64, lambda: c64) -> Mat<c64> {
        let system = GyroscopicSystem::of_plate(plate);
        let (stiffness, velocity) = (system.stiffness_at(speed), system.velocity_at(speed));
        dynamic_stiffness(&stiffness, &velocity, lambda)
    }

    fn distance(found: &Mat<c64>, exact: &Mat<c64>) -> f64 {
        (found - exact).norm_l2() / exact.norm_l2()
    }

    /// Reference: a factorization of the whole matrix, at a complex and at a real λ.
    #[test]
    fn solves_are_those_of_the_whole_matrix() {
        let speed = rad_per_s(2000.0);
        for plate in plates() {
            let full = FullModel::new(&plate);
            let order = plate.degrees_of_freedom();
            let load = Mat::from_fn(order, 2, |i, k| {
                let x = i as f64 + 0.3 * k as f64;
                c64::new((0.7 * x + 0.3).sin(), (1.3 * x).cos())
            });
            let lambda = c64::new(3.0, 200.0);
            let factors = whole(&plate, speed, lambda).partial_piv_lu();
            let found = full.eliminated(speed, lambda).unwrap();
            let solved = distance(&found.solve(load.as_ref()), &factors.solve(&load));
            let transposed = found.solve_transposed(load.as_ref());
            let turned = distance(&transposed, &factors.solve_transpose(&load));
            assert!(solved < 1e-9 && turned < 1e-9, "{solved:e} {turned:e}");

            let at_real = whole(&plate, speed, c64::new(120.0, 0.0)).partial_piv_lu();
            let real_found = full.eliminated(speed, 120.0).unwrap();
            let real = Mat::from_fn(order, 2, |i, k| load[(i, k)].re);
            let complex =
                |matrix: &Mat<f64>| Mat::from_fn(order, 2, |i, k| c64::new(matrix[(i, k)], 0.0));
            let same = complex(&real);
            let of_solve = complex(&real_found.solve(real.as_ref()));
            let of_turned = complex(&real_found.solve_transposed(real.as_ref()));
            let distances = [
                distance(&of_solve, &at_real.solve(&same)),
                distance(&of_turned, &at_real.solve_transpose(&same)),
            ];
            assert!(distances.iter().all(|d| *d < 1e-9), "{distances:?}");
        }
    }

    /// The part of a pad that its columns neglect changes solves by less than a millionth.
    #[test]
    fn few_columns_of_a_pad_are_enough_for_solves() {
        let speed = rad_per_s(2000.0);
        let plate = Plate::new(&Scene::paper(), RESOLUTION);
        let load = Mat::from_fn(plate.degrees_of_freedom(), 1, |i, _| {
            c64::new((0.7 * i as f64 + 0.3).sin(), 0.0)
        });
        let lambda = c64::new(120.0, 0.0);
        let factors = whole(&plate, speed, lambda).partial_piv_lu();
        let found = FullModel::new(&plate).eliminated(speed, lambda).unwrap();
        let distance = distance(&found.solve(load.as_ref()), &factors.solve(&load));
        assert!(distance < 5e-7, "{distance:e}");
    }

    /// Reference: the determinant of the whole matrix, from its eigenvalues.
    #[test]
    fn the_angle_is_that_of_the_whole_determinant() {
        let speed = rad_per_s(2000.0);
        for plate in plates() {
            let full = FullModel::new(&plate);
            for lambda in [
                c64::new(3.0, 70.0),
                c64::new(0.0, 200.0),
                c64::new(50.0, 0.0),
                c64::new(-1.0, 900.0),
            ] {
                let values = whole(&plate, speed, lambda).eigenvalues().unwrap();
                let exact: f64 = values.iter().map(|value| value.arg()).sum();
                let found = full.eliminated(speed, lambda).unwrap();
                let turns = (exact - found.determinant_angle().unwrap()) / std::f64::consts::TAU;
                assert!((turns - turns.round()).abs() < 1e-8, "{lambda}: {turns}");
            }
        }
    }

    #[test]
    fn the_parity_of_a_permutation() {
        assert!(!is_odd(&[0, 1, 2]) && is_odd(&[1, 0, 2]) && !is_odd(&[1, 2, 0]));
    }
}
