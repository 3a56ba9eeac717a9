//! Mean reaction of the arbor on the blade, in the space-fixed frame.

use std::f64::consts::TAU;

use nalgebra::Vector3;

use crate::model::plate::BoreForce;

use super::contact::Touch;

/// The reaction averaged over whole revolutions.
#[derive(Debug, Clone, PartialEq)]
pub struct MeanReaction {
    /// Mean force of all teeth on the blade at evenly spaced angles fixed in space. The values determine a Fourier
    /// series up to half the number of angles.
    pub stations: Vec<BoreForce>,
    /// Sum of the forces (F_x, F_y).
    pub force_n: [f64; 2],
    /// Torque of the forces at the pitch radius.
    pub torque_n_m: f64,
    /// Forces on the teeth.
    pub teeth: ToothForces,
    /// Mean reaction plus load, relative to the load (or to the contact forces, if these are larger): the
    /// change of momentum over the averaged revolutions.
    pub imbalance: f64,
    /// Change of the harmonics m = 0, 1, 2 of the reaction from the first half of the averaged revolutions to
    /// the second, relative to their magnitude: a measure of how far the motion is from being settled.
    pub unsteadiness: f64,
}

/// Normal forces on the spline teeth, summed over both flanks of a tooth.
#[derive(Debug, Clone, PartialEq)]
pub struct ToothForces {
    /// Mean force on each tooth.
    pub mean_n: Vec<f64>,
    /// Largest force on any tooth.
    pub peak_n: f64,
    /// Mean number of teeth in contact.
    pub in_contact: f64,
    /// Smallest number of teeth in contact at a time.
    pub fewest: usize,
    /// Largest number of teeth in contact at a time.
    pub most: usize,
    /// Largest approach of any flank. If it is a considerable part of the tooth, the contact stiffness is
    /// unrealistic.
    pub deepest_m: f64,
}

/// Sums over the samples of whole revolutions.
#[derive(Debug)]
pub struct Accumulator {
    /// Sums of [radial, tangential] at the stations, for each half of the time.
    halves: [Vec<[f64; 2]>; 2],
    samples: [usize; 2],
    /// Number of samples in the first half.
    first_half: usize,
    sum_n: Vec<f64>,
    now_n: Vec<f64>,
    touching: usize,
    fewest: usize,
    most: usize,
    peak_n: f64,
    deepest_m: f64,
}

impl Accumulator {
    /// Sums for `revolutions` of `per_revolution` samples each, a multiple of the number of teeth.
    pub fn new(teeth: usize, per_revolution: usize, revolutions: usize) -> Self {
        Accumulator {
            halves: [0, 1].map(|_| vec![[0.0; 2]; per_revolution]),
            samples: [0; 2],
            first_half: revolutions / 2 * per_revolution,
            sum_n: vec![0.0; teeth],
            now_n: vec![0.0; teeth],
            touching: 0,
            fewest: teeth,
            most: 0,
            peak_n: 0.0,
            deepest_m: 0.0,
        }
    }

    /// Adds a sample, in which the first tooth is at station `sample`.
    pub fn add(&mut self, sample: usize, touches: impl Iterator<Item = Touch>) {
        let half = usize::from(sample >= self.first_half);
        let stations = self.halves[half].len();
        let pitch = stations / self.sum_n.len();
        self.samples[half] += 1;
        self.now_n.fill(0.0);
        for touch in touches {
            let [radial, tangential] = touch.radial_and_tangential_n();
            let at = &mut self.halves[half][(sample + touch.tooth * pitch) % stations];
            at[0] += radial;
            at[1] += tangential;
            self.now_n[touch.tooth] += touch.force_n;
            self.deepest_m = self.deepest_m.max(touch.approach_m);
        }
        let loaded = self.now_n.iter().filter(|force| **force > 0.0).count();
        self.touching += loaded;
        self.fewest = self.fewest.min(loaded);
        self.most = self.most.max(loaded);
        for (sum, now) in self.sum_n.iter_mut().zip(&self.now_n) {
            *sum += now;
            self.peak_n = self.peak_n.max(*now);
        }
    }

    /// Means over all samples, with their imbalance relative to the load (F_x, F_y, T/r_p).
    pub fn mean(&self, pitch_radius_m: f64, load_n: Vector3<f64>) -> MeanReaction {
        let all = self.samples[0] + self.samples[1];
        let per_sample = 1.0 / all.max(1) as f64;
        let count = self.halves[0].len();
        let station = |k: usize, scales: [f64; 2]| {
            let parts = [0, 1].map(|part| {
                (0..2)
                    .map(|half| scales[half] * self.halves[half][k][part])
                    .sum::<f64>()
            });
            BoreForce {
                angle_rad: TAU * k as f64 / count as f64,
                radial_n: parts[0],
                tangential_n: parts[1],
            }
        };
        let series = |scales: [f64; 2]| (0..count).map(move |k| station(k, scales));
        let of_half = self.samples.map(|samples| 1.0 / samples.max(1) as f64);
        let stations: Vec<BoreForce> = series([per_sample; 2]).collect();
        let change = low_harmonics(series([of_half[0], -of_half[1]]));
        let mut sum = Vector3::zeros();
        for force in &stations {
            let (sin, cos) = force.angle_rad.sin_cos();
            sum.x += force.radial_n * cos - force.tangential_n * sin;
            sum.y += force.radial_n * sin + force.tangential_n * cos;
            sum.z += force.tangential_n;
        }
        let mean_n: Vec<f64> = self.sum_n.iter().map(|sum| sum * per_sample).collect();
        let carried: f64 = mean_n.iter().sum();
        MeanReaction {
            force_n: [sum.x, sum.y],
            torque_n_m: sum.z * pitch_radius_m,
            imbalance: share((sum + load_n).norm(), load_n.norm().max(carried)),
            unsteadiness: share(change, low_harmonics(stations.iter().copied())),
            stations,
            teeth: ToothForces {
                mean_n,
                peak_n: self.peak_n,
                in_contact: self.touching as f64 * per_sample,
                fewest: self.fewest,
                most: self.most,
                deepest_m: self.deepest_m,
            },
        }
    }
}

/// Norm of the Fourier coefficients of the orders 0, 1 and 2, the only ones that act on the tilts.
fn low_harmonics(stations: impl Iterator<Item = BoreForce>) -> f64 {
    let mut coefficients = [0.0; 12];
    for force in stations {
        for order in 0..3 {
            let (sin, cos) = (f64::from(order) * force.angle_rad).sin_cos();
            let products = [force.radial_n, force.tangential_n]
                .into_iter()
                .flat_map(|part| [part * cos, part * sin]);
            let place = 4 * order as usize;
            for (sum, product) in coefficients[place..].iter_mut().zip(products) {
                *sum += product;
            }
        }
    }
    coefficients.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// Ratio of a part to the whole; 0 if the whole is zero.
pub(super) fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}
