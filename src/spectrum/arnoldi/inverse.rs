//! The inverse of L(σ) or K₀, whole or by its structure.
//!
//! Without edge loads L(σ) = A + PPᵀ with A block diagonal in the number of nodal diameters, for guides are of
//! low rank, and by the identity of Sherman, Morrison and Woodbury
//!
//! L⁻¹ = A⁻¹ − A⁻¹P (1 + PᵀA⁻¹P)⁻¹ PᵀA⁻¹,
//!
//! with −1 for 1 where a column is taken away.
//!
//! With J functions of each harmonic and r columns a factorization costs O(NJ² + Nr²) in place of O(N³), and a
//! solve O(NJ + Nr). Of a pair of cosine and sine A is [[B, γ], [−γ, B]], that is B − iγ on c + is.

use faer::linalg::matmul::matmul;
use faer::linalg::solvers::{DenseSolveCore, Solve};
use faer::{Accum, Col, ColRef, Mat, MatRef, Par};
use nalgebra::{Complex, DMatrix};

use crate::spectrum::inertia::{ShiftedBlock, ShiftedBlocks};

/// Of L(σ) in units of σ², or of K₀.
#[derive(Debug)]
pub enum Inverse {
    /// Applying it takes half the time of two triangular solves, and the few dozen applications repay it.
    Dense(Mat<f64>),
    Blocks(BlockInverse),
}

/// By blocks and columns.
#[derive(Debug)]
pub struct BlockInverse {
    order: usize,
    blocks: Vec<BlockSolve>,
    /// A⁻¹P (1 + PᵀA⁻¹P)⁻¹.
    left: Mat<f64>,
    /// A⁻ᵀP.
    right: Mat<f64>,
}

/// (B − iγ)⁻¹ of one harmonic.
#[derive(Debug)]
struct BlockSolve {
    firsts: Vec<usize>,
    re: DMatrix<f64>,
    im: DMatrix<f64>,
}

impl Inverse {
    pub fn dense(matrix: &Mat<f64>) -> Self {
        Inverse::Dense(matrix.partial_piv_lu().inverse())
    }

    /// `None` where a block is singular.
    pub fn by_blocks(structure: &ShiftedBlocks) -> Option<Self> {
        let blocks = structure.blocks.iter().map(BlockSolve::new);
        let blocks: Vec<BlockSolve> = blocks.collect::<Option<_>>()?;
        let columns = &structure.columns;
        let order = columns.nrows();
        let mut inverse = BlockInverse {
            order,
            blocks,
            left: Mat::zeros(order, 0),
            right: Mat::zeros(order, 0),
        };
        let solved = |transposed: bool| {
            let mut all = Mat::zeros(order, columns.ncols());
            for block in &inverse.blocks {
                block.add_all_solved(columns.as_ref(), transposed, &mut all);
            }
            all
        };
        let plain = solved(false);
        let is_symmetric = structure.blocks.iter().all(|block| block.turning == 0.0);
        let transposed = match is_symmetric {
            true => plain.clone(),
            false => solved(true),
        };
        let mut core = columns.transpose() * &plain;
        let added = columns.ncols() - structure.taken_away;
        (0..columns.ncols()).for_each(|i| core[(i, i)] += if i < added { 1.0 } else { -1.0 });
        let left = core.transpose().partial_piv_lu().solve(plain.transpose());
        inverse.left = left.transpose().to_owned();
        inverse.right = transposed;
        inverse
            .left
            .is_all_finite()
            .then_some(Inverse::Blocks(inverse))
    }

    pub fn order(&self) -> usize {
        match self {
            Inverse::Dense(inverse) => inverse.nrows(),
            Inverse::Blocks(inverse) => inverse.order,
        }
    }

    /// L⁻¹b.
    pub fn times(&self, load: ColRef<'_, f64>) -> Col<f64> {
        match self {
            Inverse::Dense(inverse) => inverse * load,
            Inverse::Blocks(inverse) => {
                inverse.applied(load, false, [inverse.left.as_ref(), inverse.right.as_ref()])
            }
        }
    }

    /// L⁻ᵀb.
    pub fn transposed_times(&self, load: ColRef<'_, f64>) -> Col<f64> {
        match self {
            Inverse::Dense(inverse) => inverse.transpose() * load,
            Inverse::Blocks(inverse) => {
                inverse.applied(load, true, [inverse.right.as_ref(), inverse.left.as_ref()])
            }
        }
    }
}

impl BlockInverse {
    /// A⁻¹b − left rightᵀ b, A transposed or not.
    fn applied(
        &self,
        load: ColRef<'_, f64>,
        transposed: bool,
        [left, right]: [MatRef<'_, f64>; 2],
    ) -> Col<f64> {
        let shares = right.transpose() * load;
        let mut solved = left * shares;
        for i in 0..self.order {
            solved[i] = -solved[i];
        }
        self.add_solved(load, transposed, &mut solved);
        solved
    }

    /// sum += A⁻¹b or A⁻ᵀb.
    fn add_solved(&self, load: ColRef<'_, f64>, transposed: bool, sum: &mut Col<f64>) {
        for block in &self.blocks {
            block.add_solved(load, transposed, sum);
        }
    }
}

impl BlockSolve {
    fn new(block: &ShiftedBlock) -> Option<Self> {
        let turning = match block.firsts.len() {
            1 => 0.0,
            _ => block.turning,
        };
        let mut complex = block.block.map(|x| Complex::new(x, 0.0));
        (0..complex.nrows()).for_each(|i| complex[(i, i)].im = -turning);
        let inverse = complex.try_inverse()?;
        Some(BlockSolve {
            firsts: block.firsts.clone(),
            re: inverse.map(|x| x.re),
            im: inverse.map(|x| x.im),
        })
    }

    /// The same of many loads.
    fn add_all_solved(&self, loads: MatRef<'_, f64>, transposed: bool, sum: &mut Mat<f64>) {
        let radial = self.re.nrows();
        let whole = |part: &DMatrix<f64>| Mat::from_fn(radial, radial, |i, k| part[(i, k)]);
        let (re, im) = (whole(&self.re), whole(&self.im));
        let mut add = |to: usize, part: &Mat<f64>, from: usize, factor: f64| {
            let (into, from) = (sum.subrows_mut(to, radial), loads.subrows(from, radial));
            matmul(into, Accum::Add, part, from, factor, Par::Seq);
        };
        let sign = if transposed { -1.0 } else { 1.0 };
        let cosine = self.firsts[0];
        add(cosine, &re, cosine, 1.0);
        if let Some(&sine) = self.firsts.get(1) {
            add(cosine, &im, sine, -sign);
            add(sine, &im, cosine, sign);
            add(sine, &re, sine, 1.0);
        }
    }

    fn add_solved(&self, load: ColRef<'_, f64>, transposed: bool, sum: &mut Col<f64>) {
        let radial = self.re.nrows();
        let sign = if transposed { -1.0 } else { 1.0 };
        let cosine = self.firsts[0];
        let sine = self.firsts.get(1).copied();
        for k in 0..radial {
            let c = load[cosine + k];
            let s = sine.map_or(0.0, |sine| load[sine + k]);
            let re = &self.re.as_slice()[k * radial..(k + 1) * radial];
            let im = &self.im.as_slice()[k * radial..(k + 1) * radial];
            for i in 0..radial {
                sum[cosine + i] += re[i] * c - sign * im[i] * s;
            }
            if let Some(sine) = sine {
                for i in 0..radial {
                    sum[sine + i] += sign * im[i] * c + re[i] * s;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use faer::linalg::solvers::Solve;
    use faer::{Mat, Scale};

    use super::*;
    use crate::plate::{Plate, Resolution};
    use crate::scene::{Scene, rad_per_s};
    use crate::spectrum::UndampedFullModel;
    use crate::system::GyroscopicSystem;

    /// Against a solve with the whole matrix of L(σ), of one pad and of two.
    #[test]
    fn a_solve_by_structure_is_that_of_the_whole_matrix() {
        let two = Scene::paper().edited(|saw| {
            let mut other = saw.guides[0];
            (other.angle_deg, other.radius_m) = (70.0, 0.25);
            (other.radial_length_m, other.tangential_length_m) = (0.05, 0.08);
            saw.guides.push(other);
        });
        for scene in [Scene::paper(), two.unwrap()] {
            let resolution = Resolution {
                max_diameters: 18,
                radial_functions: 8,
            };
            let plate = Plate::new(&scene, resolution);
            let system = GyroscopicSystem::of_plate(&plate);
            let (speed, shift) = (rad_per_s(2000.0), 120.0);
            let structure = UndampedFullModel::new(&plate)
                .shifted(speed, shift)
                .unwrap();
            let inverse = Inverse::by_blocks(&structure).unwrap();
            let mut whole = Scale(shift.powi(-2)) * system.stiffness_at(speed)
                + Scale(1.0 / shift) * system.velocity_at(speed);
            (0..system.order()).for_each(|i| whole[(i, i)] += 1.0);
            let factors = whole.partial_piv_lu();
            let load = Mat::from_fn(system.order(), 1, |i, _| (0.7 * i as f64 + 0.3).sin());
            let found = [
                inverse.times(load.col(0)),
                inverse.transposed_times(load.col(0)),
            ];
            let exact = [factors.solve(&load), factors.solve_transpose(&load)];
            for (found, exact) in found.iter().zip(&exact) {
                let distance = (found - exact.col(0)).norm_l2() / exact.norm_l2();
                assert!(distance < 5e-7, "{distance}");
            }
        }
    }
}
