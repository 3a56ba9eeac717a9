//! The reduced model at one speed with forces that couple all waves, such as loads at the rim: a dense elimination.
//!
//! In the waves of the middle of the interval L₀ = K₀ + ΩN + Ω²S and L₁ = C + 2ΩG, exactly. Strong dampers are bordered
//! as in [`super::frame`]; everything else fixed in space is part of the dense matrices.

use faer::{Mat, Scale};

use super::blade::Saw;
use super::near::Near;
use super::series::Series;
use crate::model::system::GyroscopicSystem;

/// The whole saw: displacements of strong dampers, near waves, far waves, forces of strong dampers.
pub struct Whole {
    /// Powers of the speed of each coefficient of λ, in units of the window.
    stiffness: [Mat<f64>; 3],
    velocity: [Mat<f64>; 2],
    /// Number N of waves, and of strong dampers.
    order: usize,
    strong: usize,
    /// Number of displacements and waves that are kept.
    size: usize,
}

/// A block of the plate in its waves: the index of its first unknown, and the vectors of the waves.
type Turned<'a> = (usize, &'a Mat<f64>);

impl Whole {
    /// A saw for what is near.
    pub fn new(saw: &Saw, system: &GyroscopicSystem, near: &Near, window: f64) -> Self {
        let order = saw.order;
        let mut parts: Vec<Turned<'_>> = Vec::new();
        let (mut places, mut far) = (Vec::new(), Vec::new());
        for (block, part) in saw.blocks.iter().zip(&near.blocks) {
            for copy in 0..block.copies() {
                let first = block.first + copy * block.radial;
                parts.push((first, &part.vectors));
                places.extend(first..first + part.near);
                far.extend(first + part.near..first + block.radial);
            }
        }
        let strong = near.strong();
        let size = strong + places.len();
        places.extend(far);
        let (columns, weights) = strong_columns(saw, near, window);
        let in_waves = |matrix: Option<&Mat<f64>>, unit: f64| {
            let inner = matrix.map_or_else(
                || Mat::zeros(order, order),
                |matrix| {
                    let half = turned(&parts, &turned(&parts, matrix).transpose().to_owned());
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
        let columns = turned(&parts, &columns);
        let columns = Mat::from_fn(order, strong, |i, k| columns[(places[i], k)]);
        for (k, (spring, damper)) in weights.iter().enumerate() {
            let (z, g) = (k, strong + order + k);
            for i in 0..order {
                // The strong columns leave the waves and act through their displacement.
                for j in 0..order {
                    let product = columns[(i, k)] * columns[(j, k)];
                    stiffness[0][(strong + i, strong + j)] -= spring * product;
                    velocity[0][(strong + i, strong + j)] -= damper * product;
                }
                stiffness[0][(strong + i, g)] = columns[(i, k)];
                stiffness[0][(g, strong + i)] = columns[(i, k)];
            }
            stiffness[0][(g, z)] = -1.0;
            stiffness[0][(z, g)] = -1.0;
            stiffness[0][(z, z)] = *spring;
            velocity[0][(z, z)] = *damper;
        }
        Whole {
            stiffness,
            velocity,
            order,
            strong,
            size,
        }
    }

    /// K̃, C̃, M̃ and further terms at a speed, in units of the window, in the displacements of strong dampers and the near
    /// waves.
    pub fn reduced(&self, speed: f64) -> Series {
        let [a, b, c] = &self.stiffness;
        let [d, e] = &self.velocity;
        let mut inertia = Mat::zeros(a.nrows(), a.nrows());
        (self.strong..self.strong + self.order).for_each(|i| inertia[(i, i)] = 1.0);
        let mut all = Series::default();
        all.0[0] = Some(a + Scale(speed) * b + Scale(speed * speed) * c);
        all.0[1] = Some(d + Scale(speed) * e);
        all.0[2] = Some(inertia);
        all.onto_first(self.size)
    }
}

/// Vᵀ X with V block by block.
fn turned(parts: &[Turned<'_>], matrix: &Mat<f64>) -> Mat<f64> {
    let mut turned = Mat::zeros(matrix.nrows(), matrix.ncols());
    for (first, vectors) in parts {
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

/// Columns of the strong dampers in units of the window, and their κ₀ and κ₁.
fn strong_columns(saw: &Saw, near: &Near, window: f64) -> (Mat<f64>, Vec<(f64, f64)>) {
    let mut columns = Mat::zeros(saw.order, near.strong());
    let mut weights = Vec::new();
    for (set, rotation) in saw.columns.iter().zip(&near.rotations) {
        let Some(rotation) = rotation else { continue };
        let turned = &set.vectors * rotation.matrix.subcols(0, rotation.strong);
        for k in 0..rotation.strong {
            let column = Scale(window.recip()) * turned.col(k);
            columns.col_mut(weights.len()).copy_from(&column);
            let weight = rotation.weights[k];
            weights.push((weight * set.stiffness, weight * set.damping * window));
        }
    }
    (columns, weights)
}
