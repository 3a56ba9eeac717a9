//! The free blade by waves, and what couples them by columns.
//!
//! For each number n of nodal diameters the waves of the free blade at the speed Ω are the eigenvectors v_k of
//! B_n(Ω) = K_b + K_m + Ω²K_σ, J × J, symmetric, with ω_k² = v_kᵀ B_n v_k: a real pair cos nθ, sin nθ each. In a frame
//! fixed in space their frequencies are ω_k ± nΩ. Everything fixed in space is P κ(λ) Pᵀ with few columns P and
//! κ = κ₀ + λκ₁: springs have κ₀ = 1, dampers κ₁ = 1, the forces of a cut κ₀ = ±1.

use faer::{Mat, Scale, Side};
use sawflutter::plate::Plate;
use sawflutter::system::GyroscopicSystem;

/// Matrices of one number of nodal diameters, cosines before sines.
pub struct Block {
    /// Number of nodal diameters n.
    pub diameters: usize,
    /// Index of the first unknown in the basis of the plate.
    pub first: usize,
    /// Number J of radial functions.
    pub radial: usize,
    /// The equation of motion of the block, J × J for n = 0, else 2J × 2J.
    pub system: GyroscopicSystem,
}

impl Block {
    /// ω_k², ascending, and v_k at a speed; negative past buckling.
    pub fn waves(&self, speed: f64) -> (Vec<f64>, Mat<f64>) {
        let (radial, turned) = (self.radial, (self.diameters * self.diameters) as f64);
        let stiffness = &self.system.stiffness;
        let matrix = Mat::from_fn(radial, radial, |i, k| {
            let convective = if i == k { turned } else { 0.0 };
            stiffness[(i, k)] + speed * speed * (self.system.spin[(i, k)] + convective)
        });
        let eigen = matrix.self_adjoint_eigen(Side::Lower).expect("finite");
        let squares = eigen.S().column_vector().iter().copied().collect();
        (squares, eigen.U().to_owned())
    }

    /// Number of copies of each wave: the cosine, and for n > 0 the sine.
    pub fn copies(&self) -> usize {
        1 + usize::from(self.diameters > 0)
    }
}

/// Columns with the same κ = κ₀ + λκ₁.
pub struct Columns {
    /// P, N × r.
    pub vectors: Mat<f64>,
    /// κ₀, dimensionless.
    pub stiffness: f64,
    /// κ₁, in s.
    pub damping: f64,
}

/// A saw by waves and columns.
pub struct Saw {
    /// Blocks of n = 0 … n_max.
    pub blocks: Vec<Block>,
    /// Everything fixed in space.
    pub columns: Vec<Columns>,
    /// Number N of unknowns.
    pub order: usize,
    /// Whether nothing damps.
    pub is_conservative: bool,
}

impl Saw {
    /// Blocks and columns of a plate. The trace of what the columns leave out, relative to the stiffness of the free
    /// blade plus `floor`², is at most `tolerance`. Loads at the rim are among the columns if `with_loads` is set.
    pub fn new(plate: &Plate, floor: f64, tolerance: f64, with_loads: bool) -> Self {
        let block = |n: usize| Block {
            diameters: n,
            first: plate.offset(n),
            radial: plate.radial_functions(),
            system: GyroscopicSystem::of_harmonic(plate, n),
        };
        let blocks: Vec<Block> = (0..=plate.max_diameters()).map(block).collect();
        let weights = Weights::new(&blocks, floor);
        let mut columns = Vec::new();
        let springs = plate.contact.stiffness();
        let dampers = plate.contact.damping();
        let share = springs.zip(dampers).and_then(|(k, c)| proportion(k, c));
        if let Some(springs) = springs {
            columns.push(Columns {
                vectors: weights.columns(springs, tolerance),
                stiffness: 1.0,
                damping: share.unwrap_or(0.0),
            });
        }
        if let (Some(dampers), None) = (dampers, share) {
            // In units of the window a damper counts by hC.
            let vectors = weights.columns(&(Scale(floor) * dampers), tolerance);
            columns.push(Columns {
                vectors,
                stiffness: 0.0,
                damping: 1.0 / floor,
            });
        }
        if let Some(loads) = plate.edge_stiffness.as_ref().filter(|_| with_loads) {
            columns.extend(weights.signed_columns(loads, tolerance));
        }
        assert!(plate.contact.nonconservative_stiffness().is_none());
        Saw {
            blocks,
            columns,
            order: plate.degrees_of_freedom(),
            is_conservative: plate.is_conservative(),
        }
    }

    /// Number of columns.
    pub fn rank(&self) -> usize {
        self.columns.iter().map(|c| c.vectors.ncols()).sum()
    }
}

/// c/k, if the dampers are the springs times a number.
fn proportion(springs: &Mat<f64>, dampers: &Mat<f64>) -> Option<f64> {
    let share = dampers.norm_l2() / springs.norm_l2();
    let rest = dampers - Scale(share) * springs;
    (rest.norm_l2() < 1e-12 * dampers.norm_l2()).then_some(share)
}

/// Waves at rest over the root of their stiffness plus that of a floor: the unit in which a coupling is small.
struct Weights {
    /// First unknown of each block of functions, and V (Λ + floor²)^½.
    parts: Vec<(usize, Mat<f64>, Mat<f64>)>,
}

impl Weights {
    fn new(blocks: &[Block], floor: f64) -> Self {
        let mut parts = Vec::new();
        for block in blocks {
            let (squares, vectors) = block.waves(0.0);
            let root = |k: usize| (squares[k].abs() + floor * floor).sqrt();
            let radial = block.radial;
            let factor = Mat::from_fn(radial, radial, |i, k| vectors[(i, k)] * root(k));
            let inverse = Mat::from_fn(radial, radial, |i, k| vectors[(k, i)] / root(i));
            for copy in 0..block.copies() {
                let first = block.first + copy * radial;
                parts.push((first, factor.clone(), inverse.clone()));
            }
        }
        Weights { parts }
    }

    /// F⁻¹ X.
    fn scaled(&self, matrix: &Mat<f64>) -> Mat<f64> {
        let mut scaled = Mat::zeros(matrix.nrows(), matrix.ncols());
        for (first, _, inverse) in &self.parts {
            let size = inverse.nrows();
            let own = inverse * matrix.subrows(*first, size);
            scaled.subrows_mut(*first, size).copy_from(&own);
        }
        scaled
    }

    /// F X.
    fn unscaled(&self, matrix: &Mat<f64>) -> Mat<f64> {
        let mut unscaled = Mat::zeros(matrix.nrows(), matrix.ncols());
        for (first, factor, _) in &self.parts {
            let size = factor.nrows();
            let own = factor * matrix.subrows(*first, size);
            unscaled.subrows_mut(*first, size).copy_from(&own);
        }
        unscaled
    }

    /// Columns of a positive matrix of low rank, by Cholesky factorization with complete pivoting.
    fn columns(&self, matrix: &Mat<f64>, tolerance: f64) -> Mat<f64> {
        let order = matrix.nrows();
        let half = self.scaled(matrix);
        let scaled = self.scaled(&half.transpose().to_owned());
        let mut diagonal: Vec<f64> = (0..order).map(|i| scaled[(i, i)]).collect();
        let rounding = 1e-13 * diagonal.iter().fold(0.0, |a: f64, b| a.max(*b));
        let mut found: Mat<f64> = Mat::zeros(order, order.min(400));
        let mut count = 0;
        while count < found.ncols() {
            let left: f64 = diagonal.iter().map(|d| d.max(0.0)).sum();
            let pivot = (0..order).max_by(|x, y| diagonal[*x].total_cmp(&diagonal[*y]));
            let Some(pivot) = pivot.filter(|p| left > tolerance && diagonal[*p] > rounding) else {
                break;
            };
            let known = found.subcols(0, count);
            let column = scaled.col(pivot) - known * known.row(pivot).transpose();
            let column = Scale(diagonal[pivot].sqrt().recip()) * column;
            for (i, d) in diagonal.iter_mut().enumerate() {
                *d -= column[i] * column[i];
            }
            diagonal[pivot] = 0.0;
            found.col_mut(count).copy_from(&column);
            count += 1;
        }
        self.unscaled(&found.subcols(0, count).to_owned())
    }

    /// Columns of a symmetric matrix with κ₀ = 1 and with κ₀ = −1, by its eigenvalues.
    fn signed_columns(&self, matrix: &Mat<f64>, tolerance: f64) -> Vec<Columns> {
        let half = self.scaled(matrix);
        let scaled = self.scaled(&half.transpose().to_owned());
        let eigen = scaled.self_adjoint_eigen(Side::Lower).expect("finite");
        let values: Vec<f64> = eigen.S().column_vector().iter().copied().collect();
        let of_sign = |sign: f64| {
            let kept: Vec<usize> = (0..values.len())
                .filter(|k| sign * values[*k] > tolerance)
                .collect();
            let columns = Mat::from_fn(values.len(), kept.len(), |i, k| {
                eigen.U()[(i, kept[k])] * values[kept[k]].abs().sqrt()
            });
            Columns {
                vectors: self.unscaled(&columns),
                stiffness: sign,
                damping: 0.0,
            }
        };
        vec![of_sign(1.0), of_sign(-1.0)]
    }
}
