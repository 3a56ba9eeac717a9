//! Deflection of a blade under a force at a point or on some points, and its error on a basis.

use faer::Col;
use faer::linalg::solvers::Solve;

use crate::model::plate::Plate;
use crate::model::scene::{Polar, Scene};
use crate::model::system::GyroscopicSystem;
use crate::modes::Assembled;
use crate::stability::ahead;

/// A force fixed in space while the saw turns, at a point or on some points.
pub(crate) struct PointLoad {
    system: GyroscopicSystem,
    /// φ, the load of one newton: the basis functions at the point, or their mean over the points.
    load: Col<f64>,
}

impl PointLoad {
    /// A force at a place, a radius in m and an angle in rad; `None` if rigid motions are free.
    pub fn new(plate: &Plate, place: Polar) -> Option<Self> {
        Self::on(plate, &[(place, 1.0)])
    }

    /// A force on some places, each with its share of the whole; `None` if rigid motions are free.
    pub fn on(plate: &Plate, places: &[(Polar, f64)]) -> Option<Self> {
        let system = GyroscopicSystem::of_plate(plate);
        let load = plate.load_at(places);
        let is_held = system.free_rigid.is_empty();
        is_held.then_some(PointLoad { system, load })
    }

    /// K(Ω)⁻¹ φ, coordinates of the deflection for a force of 1 N; `None` where K(Ω) is singular.
    pub fn deflected(&self, speed_rad_per_s: f64) -> Option<Col<f64>> {
        let factor = self.system.stiffness_at(speed_rad_per_s).partial_piv_lu();
        let deflected = factor.solve(&self.load);
        let is_finite = deflected.iter().all(|q| q.is_finite());
        is_finite.then_some(deflected)
    }

    /// φᵀ K(Ω)⁻¹ φ, deflection over force at the point, or the mean over the points; `None` where K(Ω) is singular.
    pub fn compliance_m_per_n(&self, speed_rad_per_s: f64) -> Option<f64> {
        Some(self.load.transpose() * self.deflected(speed_rad_per_s)?)
    }
}

/// Compliance at rest at a place.
fn at_rest_m_per_n(plate: &Plate, place: Polar) -> Option<f64> {
    let saw = Assembled::from(plate.clone());
    let mut parts = saw.components.iter();
    if !parts.all(|component| component.full.free_rigid.is_empty()) {
        return None;
    }
    let point = plate.load_at(&[(place, 1.0)]);
    let compliance = point.transpose() * saw.deflected(0.0, &point);
    compliance.is_finite().then_some(compliance)
}

/// Estimated relative error of the compliance at rest on the basis of a plate. `None` if the blade is not held, or
/// buckled.
///
/// A point load deforms the rim in waves of all lengths; the contribution of n diameters falls with n³, so that what N
/// diameters leave out falls with 1/N². The change on the larger basis that measures the error of critical speeds is a
/// known part of it.
pub(super) fn basis_error(scene: &Scene, plate: &Plate, place: Polar) -> Option<f64> {
    let larger = ahead(plate.resolution);
    let own = at_rest_m_per_n(plate, place)?;
    let more = at_rest_m_per_n(&Plate::new(scene, larger), place)?;
    let left_out = (plate.max_diameters() as f64 / larger.max_diameters as f64).powi(2);
    // The larger basis contains the smaller one: the compliance of a blade that is not buckled rises.
    let missing = (1.0 - own / more) / (1.0 - left_out);
    (missing >= 0.0).then_some(missing)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::model::plate::Resolution;
    use crate::motion::stretched_blade::basis_tests::saws;

    const fn basis(max_diameters: usize, radial_functions: usize) -> Resolution {
        Resolution {
            max_diameters,
            radial_functions,
        }
    }

    /// Saws with large and small, soft and stiff, single and mirrored pads, compared with a basis that lacks a tenth of
    /// what the smaller ones lack.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "dense solves: run it in release")]
    fn the_error_of_the_compliance_is_estimated_within_a_factor_of_two() {
        for (name, saw) in saws() {
            let place = Polar::new(saw.blade().outer_radius_m, PI);
            let of = |plate: &Plate| at_rest_m_per_n(plate, place).unwrap();
            let exact = of(&Plate::new(&saw, basis(40, 18)));
            for size in [basis(12, 7), basis(14, 9)] {
                let plate = Plate::new(&saw, size);
                let error = 1.0 - of(&plate) / exact;
                let estimate = basis_error(&saw, &plate, place).unwrap();
                let ratio = estimate / error;
                assert!(
                    (0.5..2.0).contains(&ratio),
                    "{name} {size:?}: {error:e} {estimate:e}"
                );
            }
        }
    }
}
