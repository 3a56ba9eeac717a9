//! The equation of motion in waves, and the elimination of the far ones at one speed.
//!
//! In the waves of the middle of an interval L₀ = K₀ + ΩN + Ω²S and L₁ = C + 2ΩG, exactly. Forces g of strong dampers, whose
//! displacement z is kept, are unknowns, too: g = λcz and z = pᵀq. With z and the near waves first and the far waves and g last,
//! L(λ) = L₀ + λL₁ + λ²J = [A B; C F], where J is 1 for waves and 0 for z and g, the Schur complement is
//!
//! S(λ) = A − B G,  F G = C,  G_k = F₀⁻¹ (C_k − F₁G_{k−1} − J G_{k−2}),  S_k = A_k − B₀G_k − B₁G_{k−1}:
//!
//! one LU factorization of F₀ and products with as many columns as unknowns are kept. λ is in units of the window.

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, Scale};

use super::blade::Saw;
use super::far_velocity::{FarVelocity, subtract_product};
use super::near_block::Near;
use super::pair::Pair;
use crate::model::linalg::LinalgError;
use crate::model::system::GyroscopicSystem;
use crate::modes::vectors::orthonormal;

/// Number of coefficients of a series. With 8 the worst eigenvalue of the window is off by 2e-6 of it, with 12 by 3e-8, with
/// 16 by 6e-10; those of the lower half by 1e-11 with any of these.
const TERMS: usize = 16;

/// A component in displacements of strong dampers, near waves, far waves, forces of strong dampers.
pub struct Elimination {
    /// The vectors of the waves.
    blocks: Vec<Turned>,
    /// Index of each wave in these blocks, near ones first.
    places: Vec<usize>,
    /// Powers of the speed of each coefficient of λ, in units of the window.
    stiffness: [Mat<f64>; 3],
    velocity: [Mat<f64>; 2],
    /// Number of waves, and of strong dampers.
    waves: usize,
    strong: usize,
    /// Number of nodal diameters of each unknown that is kept; `None` for displacements of dampers.
    pub diameters: Vec<Option<usize>>,
}

/// A block of the component: the index of its first unknown, and the vectors of its waves.
type Turned = (usize, Mat<f64>);

/// The equation of motion at a speed without its far waves.
pub struct Reduced {
    /// S₀, S₁, … side by side.
    pub terms: Mat<f64>,
    /// G₀, G₁, … of the far waves.
    solved: Vec<Mat<f64>>,
}

impl Reduced {
    /// The far waves −Σ G_k X Bᵏ of all eigenvectors within the reach, the displacements X of an invariant pair.
    ///
    /// # Errors
    /// [`LinalgError`].
    pub fn far(&self, is_conservative: bool) -> Result<Mat<f64>, LinalgError> {
        let rows = self.solved.first().map_or(0, Mat::nrows);
        let far = Pair::new(self.terms.as_ref(), is_conservative)?.map(|Pair { x, b, .. }| {
            let terms = self.solved.iter().rev();
            terms.fold(Mat::zeros(rows, b.ncols()), |sum, term| {
                sum * &b - term * &x
            })
        });
        Ok(far.unwrap_or_else(|| Mat::zeros(rows, 0)))
    }
}

impl Elimination {
    /// A component of a saw with its equation of motion, for what is near.
    pub fn new(saw: &Saw, system: &GyroscopicSystem, near: &Near, window: f64) -> Self {
        let order = system.order();
        let mut blocks: Vec<Turned> = Vec::new();
        let (mut places, mut far) = (Vec::new(), Vec::new());
        let mut diameters = Vec::new();
        for (block, part) in saw.blocks.iter().zip(&near.blocks) {
            for copy in 0..block.copies() {
                let first = block.first + copy * block.radial;
                blocks.push((first, part.vectors.clone()));
                places.extend(first..first + part.near);
                diameters.extend(vec![Some(block.diameters); part.near]);
                far.extend(first + part.near..first + block.radial);
            }
        }
        places.extend(far);
        let strong = near.weights.len();
        let in_waves = |matrix: Option<&Mat<f64>>, unit: f64| {
            let inner = matrix.map_or_else(
                || Mat::zeros(order, order),
                |matrix| {
                    let half = turned(&blocks, &turned(&blocks, matrix).transpose().to_owned());
                    Mat::from_fn(order, order, |i, k| unit * half[(places[k], places[i])])
                },
            );
            bordered(&inner, strong)
        };
        let squared = window.powi(-2);
        let mut stiffness = [
            in_waves(Some(&system.stiffness), squared),
            in_waves(system.circulatory.as_ref(), squared),
            in_waves(Some(&system.spin), squared),
        ];
        if let Some(nonconservative) = &system.nonconservative {
            stiffness[0] += in_waves(Some(nonconservative), squared);
        }
        let mut velocity = [
            in_waves(system.damping.as_ref(), window.recip()),
            in_waves(Some(&system.gyroscopic), 2.0 / window),
        ];
        let dampers = turned(&blocks, &near.dampers);
        let columns = Mat::from_fn(order, strong, |i, k| dampers[(places[i], k)] / window);
        for (k, weight) in near.weights.iter().enumerate() {
            let (z, g) = (k, strong + order + k);
            for i in 0..order {
                // The strong columns leave the waves and act through their displacement.
                for j in 0..order {
                    let product = columns[(i, k)] * columns[(j, k)];
                    velocity[0][(strong + i, strong + j)] -= weight * product;
                }
                stiffness[0][(strong + i, g)] = columns[(i, k)];
                stiffness[0][(g, strong + i)] = columns[(i, k)];
            }
            stiffness[0][(g, z)] = -1.0;
            stiffness[0][(z, g)] = -1.0;
            velocity[0][(z, z)] = *weight;
        }
        let kept = vec![None; strong].into_iter().chain(diameters);
        Elimination {
            blocks,
            places,
            stiffness,
            velocity,
            waves: order,
            strong,
            diameters: kept.collect(),
        }
    }

    /// Number of near waves.
    pub fn near(&self) -> usize {
        self.diameters.len() - self.strong
    }

    /// The equation of motion at a speed without the far waves.
    pub fn reduced(&self, speed: f64) -> Reduced {
        let [a, b, c] = &self.stiffness;
        let [d, e] = &self.velocity;
        let stiffness = a + Scale(speed) * b + Scale(speed * speed) * c;
        let velocity = d + Scale(speed) * e;
        let size = self.diameters.len();
        let waves = self.strong..self.strong + self.waves;
        let inertia = Mat::from_fn(size, size, |i, k| {
            if i == k && waves.contains(&i) {
                1.0
            } else {
                0.0
            }
        });
        let kept = |matrix: &Mat<f64>| matrix.get(..size, ..size).to_owned();
        let mut terms = vec![kept(&stiffness), kept(&velocity), inertia];
        // Far waves without the forces of dampers.
        let far_waves = waves.end - size;
        let mut solved: Vec<Mat<f64>> = Vec::new();
        if far_waves == 0 {
            return Reduced {
                terms: side_by_side(&terms),
                solved,
            };
        }
        let of_far = |matrix: &Mat<f64>| matrix.get(size.., size..).to_owned();
        let by_far = |matrix: &Mat<f64>| matrix.get(..size, size..).to_owned();
        let by_kept = |matrix: &Mat<f64>| matrix.get(size.., ..size).to_owned();
        let factors = of_far(&stiffness).partial_piv_lu();
        let far = FarVelocity::new(of_far(&velocity));
        let [by_far, by_kept] = [
            [by_far(&stiffness), by_far(&velocity)],
            [by_kept(&stiffness), by_kept(&velocity)],
        ];
        terms.resize(TERMS, Mat::zeros(size, size));
        for (power, term) in terms.iter_mut().enumerate() {
            let coupling = by_kept.get(power).cloned();
            let mut right = coupling.unwrap_or_else(|| Mat::zeros(stiffness.nrows() - size, size));
            if let Some(last) = solved.last() {
                far.subtract_product(&mut right, last);
                subtract_product(term, by_far[1].as_ref(), last);
            }
            if let Some(before) = power.checked_sub(2) {
                let mut of_waves = right.subrows_mut(0, far_waves);
                of_waves -= solved[before].subrows(0, far_waves);
            }
            factors.solve_in_place(&mut right);
            subtract_product(term, by_far[0].as_ref(), &right);
            solved.push(right);
        }
        // The forces of dampers are no part of a shape.
        let of_waves = solved.iter().map(|g| g.subrows(0, far_waves).to_owned());
        Reduced {
            solved: of_waves.collect(),
            terms: side_by_side(&terms),
        }
    }

    /// Orthonormal vectors, first the near waves, then those that span some far ones; those closer than `tolerance` to the span of
    /// the others are omitted.
    pub fn basis(&self, far: &[Mat<f64>], tolerance: f64) -> Mat<f64> {
        let columns: Vec<Col<f64>> = far
            .iter()
            .flat_map(|all| all.col_iter())
            .map(|column| column.to_owned())
            .collect();
        let near = self.near();
        let far = orthonormal(self.waves - near, &columns, tolerance);
        let mut in_waves = Mat::zeros(self.waves, near + far.ncols());
        for (i, place) in self.places.iter().enumerate() {
            match i.checked_sub(near) {
                None => in_waves[(*place, i)] = 1.0,
                Some(row) => in_waves
                    .row_mut(*place)
                    .subcols_mut(near, far.ncols())
                    .copy_from(far.row(row)),
            }
        }
        let mut basis = Mat::zeros(self.waves, in_waves.ncols());
        for (first, vectors) in &self.blocks {
            let size = vectors.nrows();
            let own = vectors * in_waves.subrows(*first, size);
            basis.subrows_mut(*first, size).copy_from(&own);
        }
        basis
    }
}

/// Matrices of one size side by side.
pub fn side_by_side(terms: &[Mat<f64>]) -> Mat<f64> {
    let size = terms.first().map_or(0, Mat::ncols);
    let rows = terms.first().map_or(0, Mat::nrows);
    Mat::from_fn(rows, terms.len() * size, |i, k| {
        terms[k / size][(i, k % size)]
    })
}

/// Vᵀ X with V block by block.
fn turned(blocks: &[Turned], matrix: &Mat<f64>) -> Mat<f64> {
    let mut turned = Mat::zeros(matrix.nrows(), matrix.ncols());
    for (first, vectors) in blocks {
        let size = vectors.nrows();
        let own = vectors.transpose() * matrix.subrows(*first, size);
        turned.subrows_mut(*first, size).copy_from(&own);
    }
    turned
}

/// A matrix with rows and columns for displacements before it and for forces after it.
fn bordered(inner: &Mat<f64>, border: usize) -> Mat<f64> {
    let order = inner.nrows();
    let mut matrix = Mat::zeros(order + 2 * border, order + 2 * border);
    matrix
        .get_mut(border..border + order, border..border + order)
        .copy_from(inner);
    matrix
}
