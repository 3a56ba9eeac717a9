//! Response of the arc of the cut to forces on it, as a sum over the modes of the saw.

use faer::linalg::solvers::Solve;
use faer::{Mat, c64};
use nalgebra::DMatrix;

use crate::model::scene::rpm;
use crate::model::system::GyroscopicSystem;
use crate::modes::{SpectrumError, companion_eigenpairs, time_scale};

/// G(λ) = Bᵀ L(λ)⁻¹ B = F + Σ_k b_k c_k/(λ − λ_k) over all 2m eigenvalues of the saw without delay, with the
/// flexibility F of the omitted shapes; r × r, in m/N if P = BBᵀ is that of 1 N/m.
#[derive(Debug)]
pub struct Transfer {
    /// λ_k; each complex one is followed by its conjugate.
    pub poles: Vec<c64>,
    /// b_k c_k, r × r, column by column.
    residues: Vec<c64>,
    /// ‖b_k‖ ‖c_k‖.
    sizes: Vec<f64>,
    flexibility: DMatrix<c64>,
}

impl Transfer {
    /// Modal sum of a system at a speed; B has r columns, F is r × r.
    ///
    /// # Errors
    /// [`SpectrumError`] where the eigenproblem fails.
    pub fn new(
        system: &GyroscopicSystem,
        columns: &Mat<f64>,
        flexibility: DMatrix<f64>,
        speed_rad_per_s: f64,
    ) -> Result<Self, SpectrumError> {
        let (order, size) = (system.order(), columns.ncols());
        let scale = time_scale(&system.stiffness);
        let failed = || SpectrumError::NoConvergence {
            order: 2 * order,
            rpm: rpm(speed_rad_per_s),
        };
        let States { poles, states } =
            States::new(system, speed_rad_per_s, scale)?.ok_or_else(failed)?;
        let mut force = Mat::<c64>::zeros(2 * order, size);
        for k in 0..size {
            for i in 0..order {
                force[(order + i, k)] = c64::new(columns[(i, k)] / scale, 0.0);
            }
        }
        let excited = states.partial_piv_lu().solve(&force);
        if !excited.is_all_finite() {
            return Err(failed());
        }
        let seen = Mat::from_fn(size, 2 * order, |j, k| {
            (0..order)
                .map(|i| states[(i, k)] * columns[(i, j)])
                .sum::<c64>()
        });
        let mut residues = Vec::with_capacity(2 * order * size * size);
        for k in 0..2 * order {
            for column in 0..size {
                residues.extend((0..size).map(|row| seen[(row, k)] * excited[(k, column)]));
            }
        }
        let blocks = residues.chunks_exact((size * size).max(1));
        let sizes = blocks.map(|block| block.iter().map(|x| x.norm_sqr()).sum::<f64>().sqrt());
        Ok(Transfer {
            sizes: sizes.collect(),
            poles,
            residues,
            flexibility: flexibility.map(|f| c64::new(f, 0.0)),
        })
    }

    /// Transfer matrix G(λ).
    pub fn at(&self, lambda: c64) -> DMatrix<c64> {
        self.sum(|pole| (lambda - pole).inv()) + &self.flexibility
    }

    /// G and dG/dλ.
    pub fn with_slope(&self, lambda: c64) -> [DMatrix<c64>; 2] {
        let slope = |pole: c64| -(lambda - pole).inv().powi(2);
        [self.at(lambda), self.sum(slope)]
    }

    /// Trace of b_k c_k. To first order, the delayed force moves λ_k by −kh times this trace.
    pub fn mobility(&self, pole: usize) -> c64 {
        let size = self.flexibility.nrows();
        let block = &self.residues[pole * size * size..];
        (0..size).map(|i| block[i * (size + 1)]).sum()
    }

    /// An upper bound of ‖G(λ) − F‖, in m/N.
    pub fn modal_bound(&self, lambda: c64) -> f64 {
        let terms = self.poles.iter().zip(&self.sizes);
        terms
            .map(|(pole, size)| size / (lambda - pole).norm())
            .sum()
    }

    /// Σ b_k c_k times a factor of each pole.
    fn sum(&self, factor: impl Fn(c64) -> c64) -> DMatrix<c64> {
        let size = self.flexibility.nrows();
        let count = size * size;
        let mut total = vec![c64::new(0.0, 0.0); count];
        for (pole, block) in self.poles.iter().zip(self.residues.chunks_exact(count)) {
            let factor = factor(*pole);
            for (sum, residue) in total.iter_mut().zip(block) {
                *sum += residue * factor;
            }
        }
        DMatrix::from_vec(size, size, total)
    }
}

/// All eigenvalues of a system, with eigenvectors.
struct States {
    /// Each complex eigenvalue is followed by its conjugate.
    poles: Vec<c64>,
    /// (q, λq/s) of all eigenvalues by columns, with the time scale s.
    states: Mat<c64>,
}

impl States {
    /// The eigenvalues at a speed; `None` if the solver does not return twice as many as there are coordinates.
    fn new(
        system: &GyroscopicSystem,
        speed_rad_per_s: f64,
        scale: f64,
    ) -> Result<Option<Self>, SpectrumError> {
        let order = system.order();
        let mut poles = Vec::with_capacity(2 * order);
        let mut states = Mat::<c64>::zeros(2 * order, 2 * order);
        for (lambda, q) in companion_eigenpairs(system, speed_rad_per_s)? {
            let conjugate = (lambda.im != 0.0).then(|| (lambda.conj(), true));
            for (value, mirrored) in [Some((lambda, false)), conjugate].into_iter().flatten() {
                let k = poles.len();
                if k < 2 * order {
                    for i in 0..order {
                        let q = if mirrored { q[i].conj() } else { q[i] };
                        states[(i, k)] = q;
                        states[(order + i, k)] = q * value / scale;
                    }
                }
                poles.push(value);
            }
        }
        Ok((poles.len() == 2 * order).then_some(States { poles, states }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plate::{Plate, Resolution};
    use crate::model::scene::{DampingFile, Scene, rad_per_s};
    use crate::model::system::dynamic_stiffness;

    /// Reference: a factorization of L(λ) at each λ.
    #[test]
    fn the_sum_over_modes_is_the_inverse() {
        let scene = Scene::paper().edited(|saw| {
            saw.damping = Some(DampingFile {
                material_retardation_time_s: 1e-6,
                air_n_s_per_m3: 20.0,
                air_rotation_share: 0.0,
                ..DampingFile::default()
            });
        });
        let resolution = Resolution {
            max_diameters: 6,
            radial_functions: 5,
        };
        let system = GyroscopicSystem::of_plate(&Plate::new(&scene.unwrap(), resolution));
        let order = system.order();
        let columns = Mat::from_fn(order, 2, |i, k| ((i + 3 * k) as f64).sin());
        let speed = rad_per_s(2500.0);
        let transfer = Transfer::new(&system, &columns, DMatrix::zeros(2, 2), speed).unwrap();
        let (stiffness, velocity) = (system.stiffness_at(speed), system.velocity_at(speed));
        for lambda in [(0.0, 70.0), (3.0, 900.0), (-20.0, 5000.0), (50.0, 0.0)] {
            let lambda = c64::new(lambda.0, lambda.1);
            let dynamic = dynamic_stiffness(&stiffness, &velocity, lambda);
            let force = Mat::from_fn(order, 2, |i, k| c64::new(columns[(i, k)], 0.0));
            let exact = force.transpose() * dynamic.partial_piv_lu().solve(&force);
            let [found, slope] = transfer.with_slope(lambda);
            let step = c64::new(1e-6 * lambda.norm(), 0.0);
            let differences = transfer.at(lambda + step) - transfer.at(lambda - step);
            for (i, k) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let error = (found[(i, k)] - exact[(i, k)]).norm() / exact[(i, k)].norm();
                assert!(error < 1e-7, "{lambda}: {error}");
                let difference = differences[(i, k)] / (step * 2.0);
                let slope_error = (slope[(i, k)] - difference).norm() / slope[(i, k)].norm();
                assert!(slope_error < 1e-4, "slope at {lambda}: {slope_error}");
            }
        }
    }
}
