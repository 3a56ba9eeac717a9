//! The decoupled components of a blade, with their reduced models.

use std::sync::OnceLock;

use faer::{Col, c64};

use crate::model::plate::Plate;
use crate::model::system::GyroscopicSystem;

use super::double_eigenvalue::DoubleEigenvalue;
use super::error::SpectrumError;
use super::free_wave;
use super::half_order;
use super::mode::{Mode, classify};
use super::residual::{Lifted, MatrixNorms, lifted};
use super::single_eigenvalue;
use super::vectors::{Eigenpair, halves};
use super::waves::WaveModes;

/// An independent component of the blade: one harmonic, or all of them coupled by guides.
#[derive(Debug)]
pub struct Component {
    /// Index of the first unknown of the component in the basis of the plate.
    pub first: usize,
    /// Equation of motion in all unknowns of the component.
    pub full: GyroscopicSystem,
    /// Method by which the modes are computed.
    pub(super) solution: Solution,
    norms: OnceLock<MatrixNorms>,
}

/// Method by which the modes of a component are computed.
#[derive(Debug)]
pub(super) enum Solution {
    /// All eigenpairs of the whole component.
    Whole,
    /// Modes of one harmonic of an undamped free blade, a symmetric problem.
    FreeWaves,
    /// Modes of a damped or guided blade by its waves.
    Waves(Box<WaveModes>),
}

impl Component {
    /// The independent components of a plate, without reduced models.
    pub(crate) fn of(plate: &Plate) -> Vec<Component> {
        if !plate.is_axisymmetric() {
            return vec![Component::new(GyroscopicSystem::of_plate(plate), 0)];
        }
        (0..=plate.max_diameters())
            .map(|n| Component::new(GyroscopicSystem::of_harmonic(plate, n), plate.offset(n)))
            .collect()
    }

    fn new(full: GyroscopicSystem, first: usize) -> Self {
        Component {
            first,
            solution: Solution::Whole,
            norms: OnceLock::new(),
            full,
        }
    }

    /// Norms of the matrices, for backward errors.
    pub(super) fn norms(&self) -> &MatrixNorms {
        self.norms.get_or_init(|| MatrixNorms::new(&self.full))
    }

    /// The unknowns of this component, from a vector in the basis of the plate.
    pub fn coordinates(&self, shape: &Col<c64>) -> Col<c64> {
        Col::from_fn(self.full.order(), |i| shape[self.first + i])
    }

    /// The matrices in the coordinates of modes.
    pub(super) fn system(&self) -> &GyroscopicSystem {
        match &self.solution {
            Solution::Whole | Solution::FreeWaves => &self.full,
            Solution::Waves(modes) => &modes.coordinates.system,
        }
    }

    /// Modes at a speed up to a frequency; `index` is that of the component, which for a free blade is the number of nodal
    /// diameters.
    pub(super) fn modes(
        &self,
        plate: &Plate,
        index: usize,
        speed: f64,
        highest: f64,
    ) -> Result<Vec<Mode>, SpectrumError> {
        let mut pairs = match &self.solution {
            Solution::Waves(modes) => return modes.at(speed, highest, index),
            Solution::FreeWaves => free_wave::eigenpairs(plate, index, &self.full, speed)?,
            Solution::Whole => half_order::eigenpairs(&self.full, speed)?,
        };
        pairs.retain(|(lambda, _)| lambda.im <= highest);
        Ok(classify(&self.full, speed, index, pairs))
    }

    /// Modes in the unknowns of this component, with their residuals.
    pub(super) fn lifted_modes(&self, speed_rad_per_s: f64, modes: &[Mode]) -> Vec<Lifted> {
        if let Solution::Waves(waves) = &self.solution {
            let whole = modes.iter().map(|mode| {
                let all = waves.whole_vector(speed_rad_per_s, mode.lambda, &mode.coordinates);
                (mode.lambda, all)
            });
            let pairs: Vec<Eigenpair> = whole.collect();
            return waves.coordinates.lifted(speed_rad_per_s, &pairs);
        }
        let shapes = halves(
            self.full.order(),
            modes.iter().map(|mode| &mode.coordinates),
        );
        let force = self.full.stiffness_at(speed_rad_per_s) * &shapes;
        let momentum = self.full.velocity_at(speed_rad_per_s) * &shapes;
        let lambdas = modes.iter().map(|mode| mode.lambda);
        lifted(lambdas, [&shapes, &momentum, &force])
    }

    /// A mode in the unknowns of this component, from its λ and coordinates.
    pub fn lifted(&self, speed_rad_per_s: f64, lambda: c64, coordinates: &Col<c64>) -> Col<c64> {
        match &self.solution {
            Solution::Whole | Solution::FreeWaves => coordinates.clone(),
            Solution::Waves(waves) => {
                let whole = waves.whole_vector(speed_rad_per_s, lambda, coordinates);
                waves.coordinates.shape(&whole)
            }
        }
    }

    /// The waves that name modes in the unknowns of this component: all but those far from them in frequency.
    pub(super) fn naming_waves(&self, modes: &[&Mode]) -> Vec<Col<c64>> {
        match &self.solution {
            Solution::Waves(waves) => waves.near_vectors(modes),
            Solution::Whole | Solution::FreeWaves => {
                modes.iter().map(|mode| mode.coordinates.clone()).collect()
            }
        }
    }

    /// The eigenvalue nearest to an expected one, in 1/s, and dλ/dΩ, by Newton's method. `None` if it does not converge.
    pub(super) fn next_to(&self, speed_rad_per_s: f64, expected: c64) -> Option<(c64, c64)> {
        match &self.solution {
            Solution::Waves(modes) => modes.next_to(speed_rad_per_s, expected),
            _ => single_eigenvalue::next_to(&self.full, speed_rad_per_s, expected),
        }
    }

    /// The coalescence next to an expected one, with vectors in the coordinates of a mode. `None` if the iteration does not converge.
    pub(super) fn double_eigenvalue(
        &self,
        speed_rad_per_s: f64,
        expected: c64,
    ) -> Option<DoubleEigenvalue> {
        match &self.solution {
            Solution::Waves(modes) => modes.double_eigenvalue(speed_rad_per_s, expected),
            _ => DoubleEigenvalue::next_to(&self.full, speed_rad_per_s, expected),
        }
    }
}
