//! Solves with L(λ) on the full model, by the structure that the determinant has.

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, c64};
use nalgebra::DMatrix;
use std::f64::consts::FRAC_1_SQRT_2;

use super::Harmonic;
use super::damped::{DampedFullModel, weigh};

/// One of the waves e^{±inθ} of a harmonic, (c ∓ is)/√2 of its unknowns.
struct Wave {
    /// Index of the first unknown of cosines, and of sines for n > 0.
    cosine: usize,
    sine: Option<usize>,
    /// 1 or −1.
    turned: f64,
    radial: usize,
}

impl Wave {
    fn of(harmonic: &Harmonic) -> impl Iterator<Item = Wave> + use<> {
        let cosine = harmonic.first;
        let sine = harmonic.firsts().nth(1);
        let radial = harmonic.radial();
        harmonic.signs().map(move |sign| Wave {
            cosine,
            sine,
            turned: [1.0, -1.0][sign],
            radial,
        })
    }

    /// Its coordinate j of a vector of unknowns.
    fn coordinate(&self, unknowns: &Col<c64>, j: usize) -> c64 {
        let c = unknowns[self.cosine + j];
        match self.sine {
            Some(sine) => (c - c64::new(0.0, self.turned) * unknowns[sine + j]) * FRAC_1_SQRT_2,
            None => c,
        }
    }

    /// Adds what the coordinate j is in unknowns.
    fn add(&self, coordinate: c64, j: usize, unknowns: &mut Col<c64>) {
        match self.sine {
            Some(sine) => {
                let part = coordinate * FRAC_1_SQRT_2;
                unknowns[self.cosine + j] += part;
                unknowns[sine + j] += c64::new(0.0, self.turned) * part;
            }
            None => unknowns[self.cosine + j] += coordinate,
        }
    }
}

impl DampedFullModel {
    /// L(λ)⁻¹ times vectors of the full model, but for what the columns of the guides leave out. `None` where L(λ) is
    /// singular.
    pub fn solved<const N: usize>(
        &self,
        speed_rad_per_s: f64,
        lambda: c64,
        loads: [&Col<c64>; N],
    ) -> Option<[Col<c64>; N]> {
        let eliminated = self.eliminated(speed_rad_per_s, lambda)?;
        let mut waves = Mat::<c64>::zeros(eliminated.adjoint.ncols(), N);
        let mut first = 0;
        for (wave, factors) in self.harmonics().flat_map(Wave::of).zip(&eliminated.blocks) {
            let load = DMatrix::from_fn(wave.radial, N, |j, k| wave.coordinate(loads[k], j));
            let solved = factors.solve(&load)?;
            for k in 0..N {
                (0..wave.radial).for_each(|j| waves[(first + j, k)] = solved[(j, k)]);
            }
            first += wave.radial;
        }
        let mut shares = &eliminated.adjoint * &waves;
        weigh(&self.parts(lambda), &mut shares);
        waves -= &eliminated.solved_columns * eliminated.core.partial_piv_lu().solve(shares);
        let unknowns = std::array::from_fn(|k| self.unknowns(&waves, k, loads[k].nrows()));
        waves.is_all_finite().then_some(unknowns)
    }

    /// Column k of vectors in waves, in unknowns.
    fn unknowns(&self, waves: &Mat<c64>, k: usize, order: usize) -> Col<c64> {
        let mut unknowns = Col::zeros(order);
        let mut first = 0;
        for wave in self.harmonics().flat_map(Wave::of) {
            for j in 0..wave.radial {
                wave.add(waves[(first + j, k)], j, &mut unknowns);
            }
            first += wave.radial;
        }
        unknowns
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plate::{Plate, Resolution};
    use crate::scene::{DampingFile, Scene, rad_per_s};
    use crate::system::{GyroscopicSystem, dynamic_stiffness};

    /// Against a factorization of the whole matrix, of an undamped and of a damped saw.
    #[test]
    fn a_solve_is_that_of_the_whole_matrix() {
        let damped = Scene::paper().edited(|saw| {
            saw.guides[0].damping_n_s_per_m = 3.0;
            saw.damping = Some(DampingFile {
                material_retardation_time_s: 1e-6,
                air_n_s_per_m3: 0.5,
                air_rotation_share: 0.3,
            });
        });
        for scene in [Scene::paper(), damped.unwrap()] {
            let resolution = Resolution {
                max_diameters: 8,
                radial_functions: 5,
            };
            let plate = Plate::new(&scene, resolution);
            let system = GyroscopicSystem::of_plate(&plate);
            let (speed, lambda) = (rad_per_s(2000.0), c64::new(3.0, 200.0));
            let (stiffness, velocity) = (system.stiffness_at(speed), system.velocity_at(speed));
            let order = system.order();
            let whole = dynamic_stiffness(&stiffness, &velocity, lambda);
            let load = Mat::from_fn(order, 1, |i, _| {
                c64::new((0.7 * i as f64 + 0.3).sin(), (1.3 * i as f64).cos())
            });
            let exact = whole.partial_piv_lu().solve(&load);
            let basis = DampedFullModel::new(&plate).unwrap();
            let [found] = basis
                .solved(speed, lambda, [&load.col(0).to_owned()])
                .unwrap();
            let distance = (&found - exact.col(0)).norm_l2() / exact.norm_l2();
            assert!(distance < 5e-7, "{distance}");
        }
    }
}
