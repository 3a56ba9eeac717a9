//! The matrices of an undamped blade times columns, by their structure.

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par, Scale};
use nalgebra::DMatrix;

use super::coupling::Coupling;
use super::{FullModel, Harmonic};
use crate::model::system::GyroscopicSystem;

impl FullModel {
    /// K₀X, (K_σ − N)X and GX with all columns. `None` if loads at the rim couple all waves.
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

    /// Non-zero entries of 2ΩG, in 1/s: (row, column, value).
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
        let places: Vec<(&Harmonic, usize)> = self
            .harmonics
            .iter()
            .flat_map(|h| h.firsts().map(move |first| (h, first)))
            .collect();
        let order = self
            .harmonics
            .iter()
            .map(|h| h.radial() * h.firsts().count());
        let mut waves = Mat::zeros(order.sum(), places.len());
        for (k, (h, first)) in places.into_iter().enumerate() {
            for j in 0..h.radial() {
                waves[(first + j, k)] = h.resting.vectors[(j, 0)];
            }
        }
        waves
    }
}
