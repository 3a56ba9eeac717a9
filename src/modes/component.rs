//! The decoupled components of a blade, with their reduced models.

use std::sync::OnceLock;

use faer::{Col, c64};

use crate::model::plate::Plate;
use crate::model::system::GyroscopicSystem;

use super::error::SpectrumError;
use super::free_wave;
use super::half_order;
use super::interval::{Interval, interval_at};
use super::projection::Projection;
use super::residual::MatrixNorms;
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
    /// Modes of projections on the low modes at a few speeds, by ascending speed.
    Projected(Vec<Interval>),
    /// Modes of a damped blade by its waves.
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

    /// A mode in the unknowns of this component, from its coordinates in the projection for a speed.
    pub fn lifted(&self, speed_rad_per_s: f64, coordinates: &Col<c64>) -> Col<c64> {
        real_times(&self.at(speed_rad_per_s).basis, coordinates)
    }

    /// The projection for a speed; beyond the range, that of the last interval.
    pub(super) fn at(&self, speed_rad_per_s: f64) -> &Projection {
        match &self.solution {
            Solution::Whole(whole) => whole.get_or_init(|| Projection::whole(&self.full)),
            Solution::FreeWaves(whole) => whole,
            Solution::Projected(intervals) => &interval_at(intervals, speed_rad_per_s).projection,
            Solution::Waves(modes) => &modes.projection,
        }
    }

    /// Eigenpairs at a speed up to a frequency, in the coordinates of [`Component::at`]; `index` is that of the component, which
    /// for a free blade is the number of nodal diameters.
    pub(super) fn eigenpairs(
        &self,
        plate: &Plate,
        index: usize,
        speed: f64,
        highest: f64,
    ) -> Result<Vec<Eigenpair>, SpectrumError> {
        let system = &self.at(speed).reduced;
        let mut pairs = match &self.solution {
            Solution::Waves(modes) => return modes.eigenpairs(speed, highest),
            Solution::FreeWaves(_) => free_wave::eigenpairs(plate, index, system, speed)?,
            _ => half_order::eigenpairs(system, speed)?,
        };
        pairs.retain(|(lambda, _)| lambda.im <= highest);
        Ok(pairs)
    }
}
