//! The components of a blade that nothing couples, each with its reduced models.

use faer::{Col, c64};

use crate::plate::Plate;
use crate::system::GyroscopicSystem;

use super::projection::Projection;
use super::residual::MatrixNorms;
use super::vectors::real_times;

/// An independent component of the blade: one harmonic, or all of them coupled by guides.
#[derive(Debug)]
pub struct Component {
    /// Index of its first unknown in the basis of the plate.
    pub first: usize,
    /// The whole component.
    pub full: GyroscopicSystem,
    /// Projections for the chart, by speed.
    pub chart: Vec<Projection>,
    /// Projection on the reflected waves and what they can meet, and the frequency up
    /// to which it is complete.
    pub low: Option<(Projection, f64)>,
    /// Norms of its matrices.
    pub(super) norms: MatrixNorms,
}

impl Component {
    /// The independent components of a plate.
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
            chart: vec![Projection::whole(&full)],
            low: None,
            norms: MatrixNorms::new(&full),
            full,
        }
    }

    /// Whether the chart is drawn from fewer unknowns than the component has.
    pub(super) fn is_projected(&self) -> bool {
        let order = self.full.order();
        self.chart.iter().any(|piece| piece.reduced.order() < order)
    }

    /// Coordinates in this component of a vector in the basis of the plate.
    pub fn coordinates(&self, shape: &Col<c64>) -> Col<c64> {
        Col::from_fn(self.full.order(), |i| shape[self.first + i])
    }

    /// Coordinates in this component of a mode of a speed.
    pub fn lifted(&self, speed_rad_per_s: f64, coordinates: &Col<c64>) -> Col<c64> {
        real_times(&self.at(speed_rad_per_s).basis, coordinates)
    }

    /// The projection for a speed; the last one also beyond the range.
    pub(super) fn at(&self, speed_rad_per_s: f64) -> &Projection {
        let place = self
            .chart
            .partition_point(|p| p.to_rad_per_s < speed_rad_per_s);
        &self.chart[place.min(self.chart.len() - 1)]
    }
}

/// √(D/ρh)/b² times five: near the lowest frequency of most blades.
pub(crate) fn frequency_scale(plate: &Plate) -> f64 {
    let blade = &plate.blade;
    let specific = blade.flexural_rigidity_n_m() / blade.mass_per_area_kg_per_m2();
    5.0 * specific.sqrt() / blade.outer_radius_m.powi(2)
}
