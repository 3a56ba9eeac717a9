//! The decoupled components of a blade, with their reduced models.

use std::sync::OnceLock;

use faer::{Col, c64};

use crate::model::plate::Plate;
use crate::model::system::GyroscopicSystem;

use super::derivative;
use super::double_eigenvalue::DoubleEigenvalue;
use super::error::SpectrumError;
use super::free_wave;
use super::half_order;
use super::mode::{Mode, classify};
use super::projection::Projection;
use super::residual::{Lifted, MatrixNorms};
use super::vectors::{Eigenpair, real_times};
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
    Whole(OnceLock<Projection>),
    /// Modes of one harmonic of an undamped free blade, a symmetric problem.
    FreeWaves(Projection),
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
            solution: Solution::Whole(OnceLock::new()),
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

    /// The projection by which modes are lifted.
    pub(super) fn projection(&self) -> &Projection {
        match &self.solution {
            Solution::Whole(whole) => whole.get_or_init(|| Projection::whole(&self.full)),
            Solution::FreeWaves(whole) => whole,
            Solution::Waves(modes) => &modes.projection,
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
        let system = &self.projection().reduced;
        let mut pairs = match &self.solution {
            Solution::Waves(modes) => return modes.at(speed, highest, index),
            Solution::FreeWaves(_) => free_wave::eigenpairs(plate, index, system, speed)?,
            Solution::Whole(_) => half_order::eigenpairs(system, speed)?,
        };
        pairs.retain(|(lambda, _)| lambda.im <= highest);
        Ok(classify(system, speed, index, pairs))
    }

    /// Coordinates in the projection of a mode of this component.
    fn projected(&self, speed_rad_per_s: f64, lambda: c64, coordinates: &Col<c64>) -> Col<c64> {
        match &self.solution {
            Solution::Waves(modes) => modes.whole_vector(speed_rad_per_s, lambda, coordinates),
            Solution::Whole(_) | Solution::FreeWaves(_) => coordinates.clone(),
        }
    }

    /// Modes in the unknowns of this component, with their residuals.
    pub(super) fn lifted_modes(&self, speed_rad_per_s: f64, modes: &[Mode]) -> Vec<Lifted> {
        let projected: Vec<Eigenpair> = modes
            .iter()
            .map(|m| {
                (
                    m.lambda,
                    self.projected(speed_rad_per_s, m.lambda, &m.coordinates),
                )
            })
            .collect();
        self.projection().lifted(speed_rad_per_s, &projected)
    }

    /// A mode in the unknowns of this component, from its λ and coordinates.
    pub fn lifted(&self, speed_rad_per_s: f64, lambda: c64, coordinates: &Col<c64>) -> Col<c64> {
        let projected = self.projected(speed_rad_per_s, lambda, coordinates);
        real_times(&self.projection().basis, &projected)
    }

    /// The waves that name modes in the unknowns of this component: all but those far from them in frequency.
    pub(super) fn naming_waves(&self, modes: &[&Mode]) -> Vec<Col<c64>> {
        match &self.solution {
            Solution::Waves(waves) => waves.near_vectors(modes),
            Solution::Whole(_) | Solution::FreeWaves(_) => {
                modes.iter().map(|mode| mode.coordinates.clone()).collect()
            }
        }
    }

    /// The eigenvalue nearest to an expected one, in 1/s, and dλ/dΩ, by Newton's method. `None` if it does not converge.
    pub(super) fn next_to(&self, speed_rad_per_s: f64, expected: c64) -> Option<(c64, c64)> {
        match &self.solution {
            Solution::Waves(modes) => modes.next_to(speed_rad_per_s, expected),
            _ => derivative::next_to(&self.projection().reduced, speed_rad_per_s, expected),
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
            _ => DoubleEigenvalue::next_to(&self.projection().reduced, speed_rad_per_s, expected),
        }
    }
}
