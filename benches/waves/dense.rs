//! Stage one for loads at the rim, which couple all waves: a dense elimination.
//!
//! In the waves of the middle of the sweep L₀ = K₀ + ΩN + Ω²S and L₁ = C + 2ΩG, exactly. Strong dampers are bordered as
//! in [`super::reduced`]; everything else fixed in space is part of the dense matrices.

use faer::{Mat, Scale};
use sawflutter::system::GyroscopicSystem;

use super::near::Near;
use super::series::Series;
use super::stages::{Unknown, split};
use super::waves::Saw;

/// The whole saw in waves, those needed most first, followed by the forces of strong dampers.
pub struct Whole {
    /// Powers of the speed of each coefficient of λ, in units of the window.
    stiffness: [Mat<f64>; 3],
    velocity: [Mat<f64>; 2],
    /// Waves by their least distance ω − nΩ over the sweep, in 1/s; zero for reflected ones.
    waves: Vec<(f64, Unknown)>,
    /// Number of strong dampers, whose displacements come first.
    strong: usize,
}

impl Whole {
    /// A saw over a sweep.
    pub fn new(
        saw: &Saw,
        system: &GyroscopicSystem,
        near: &Near,
        sweep: (f64, f64),
        window: f64,
    ) -> Self {
        let order = saw.order;
        let mut found: Vec<(f64, usize, Unknown)> = Vec::new();
        let mut parts: Vec<(usize, &Mat<f64>)> = Vec::new();
        for (block, part) in saw.blocks.iter().zip(&near.blocks) {
            let n = block.diameters as f64;
            for copy in 0..block.copies() {
                let first = block.first + copy * block.radial;
                parts.push((first, &part.vectors));
                for (k, squares) in part.squares.iter().enumerate() {
                    let distance = |square: f64, speed: f64| {
                        (square.signum() * square.abs().sqrt() - n * speed).max(0.0)
                    };
                    let distance = distance(squares[0], sweep.0).min(distance(squares[1], sweep.1));
                    found.push((distance, first + k, Unknown::Wave(*squares, n)));
                }
            }
        }
        found.sort_by(|x, y| x.0.total_cmp(&y.0));
        let places: Vec<usize> = found.iter().map(|f| f.1).collect();
        let strong = near.strong();
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
            waves: found.iter().map(|f| (f.0, f.2)).collect(),
            strong,
        }
    }

    /// Unknowns of [`Whole::equations`]: strong dampers, and waves up to `wide` away at some speed.
    pub fn unknowns(&self, wide: f64) -> Vec<Unknown> {
        let waves = self.waves.iter().filter(|(distance, _)| *distance < wide);
        let strong = vec![Unknown::Strong; self.strong].into_iter();
        strong.chain(waves.map(|(_, wave)| *wave)).collect()
    }

    /// The equations of the first `count` unknowns at a speed, all others eliminated.
    pub fn equations(&self, speed: f64, terms: usize, count: usize) -> Series {
        let [a, b, c] = &self.stiffness;
        let [d, e] = &self.velocity;
        let mut inertia = Mat::zeros(a.nrows(), a.nrows());
        (self.strong..self.strong + self.waves.len()).for_each(|i| inertia[(i, i)] = 1.0);
        let all = Series([
            Some(a + Scale(speed) * b + Scale(speed * speed) * c),
            Some(d + Scale(speed) * e),
            Some(inertia),
            None,
            None,
        ]);
        split(&all, &(0..count).collect::<Vec<_>>(), terms)
    }
}

/// Vᵀ X with V block by block.
fn turned(parts: &[(usize, &Mat<f64>)], matrix: &Mat<f64>) -> Mat<f64> {
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
