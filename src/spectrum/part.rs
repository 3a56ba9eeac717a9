//! Independent parts of the blade, their critical speeds and what holds them.

use faer::{Col, c64};

use crate::plate::Plate;
use crate::system::GyroscopicSystem;

use super::mode::{MatrixNorms, Mode, ModeKind, real_times};
use super::name::ModeName;
use super::projection::Projection;
use super::{SpectrumError, critical_speeds};

/// An independent part of the blade: one harmonic, or all of them coupled by guides.
#[derive(Debug)]
pub struct Part {
    /// Index of its first unknown in the basis of the plate.
    pub first: usize,
    /// The whole part.
    pub full: GyroscopicSystem,
    /// Projections for the chart, by speed.
    pub chart: Vec<Projection>,
    /// Projection on the reflected waves and what they can meet, and the frequency up
    /// to which it is complete.
    pub low: Option<(Projection, f64)>,
    /// Norms of its matrices.
    pub(super) norms: MatrixNorms,
}

/// A standing wave at its critical speed.
#[derive(Debug, Clone)]
pub struct NamedCriticalSpeed {
    /// Ω.
    pub speed_rad_per_s: f64,
    /// Nodal diameters of the dominant harmonic.
    pub diameters: usize,
    /// Nodal circles of the dominant harmonic.
    pub circles: usize,
    /// Index of the part it belongs to.
    pub part: usize,
    /// The standing wave in the unknowns of its part, ‖x‖ = 1.
    pub shape: Col<f64>,
}

impl Part {
    /// The independent parts of a plate.
    pub(crate) fn of(plate: &Plate) -> Vec<Part> {
        if !plate.is_axisymmetric() {
            return vec![Part::new(GyroscopicSystem::of_plate(plate), 0)];
        }
        (0..=plate.max_diameters())
            .map(|n| Part::new(GyroscopicSystem::of_harmonic(plate, n), plate.offset(n)))
            .collect()
    }

    fn new(full: GyroscopicSystem, first: usize) -> Self {
        Part {
            first,
            chart: vec![Projection::whole(&full)],
            low: None,
            norms: MatrixNorms::new(&full),
            full,
        }
    }

    /// Whether the chart is drawn from fewer unknowns than the part has.
    pub(super) fn is_projected(&self) -> bool {
        let order = self.full.order();
        self.chart.iter().any(|piece| piece.reduced.order() < order)
    }

    /// Coordinates in this part of a vector in the basis of the plate.
    pub fn coordinates(&self, shape: &Col<c64>) -> Col<c64> {
        Col::from_fn(self.full.order(), |i| shape[self.first + i])
    }

    /// Coordinates in this part of a mode of a speed.
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

pub(super) fn named_critical_speeds(
    plate: &Plate,
    parts: &[Part],
) -> Result<Vec<NamedCriticalSpeed>, SpectrumError> {
    let mut named = Vec::new();
    for (index, part) in parts.iter().enumerate() {
        for critical in critical_speeds(&part.full)? {
            let speed = critical.speed_rad_per_s;
            let name = standing_name(plate, part.first, &critical.shape, speed);
            named.push(NamedCriticalSpeed {
                speed_rad_per_s: speed,
                diameters: name.diameters,
                circles: name.circles,
                part: index,
                shape: critical.shape,
            });
        }
    }
    named.sort_by(|x, y| x.speed_rad_per_s.total_cmp(&y.speed_rad_per_s));
    Ok(named)
}

/// The name of a wave that stands still, from its unknowns in a part.
pub(crate) fn standing_name(
    plate: &Plate,
    first: usize,
    unknowns: &Col<f64>,
    speed_rad_per_s: f64,
) -> ModeName {
    let mut shape = Col::zeros(plate.degrees_of_freedom());
    for i in 0..unknowns.nrows() {
        shape[first + i] = c64::new(unknowns[i], 0.0);
    }
    // A shape at rest has no kinetic energy to be named by: it is named as an oscillation.
    let lambda = match speed_rad_per_s > 0.0 {
        true => c64::new(0.0, 0.0),
        false => c64::new(0.0, 1.0),
    };
    let standing = Mode {
        lambda,
        kind: ModeKind::Positive,
        frequency_slope: 0.0,
        growth_slope: c64::new(0.0, 0.0),
        action: 1,
        part: 0,
        coordinates: Col::zeros(0),
    };
    ModeName::new(plate, &standing, &shape, speed_rad_per_s)
}
