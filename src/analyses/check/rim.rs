//! Lateral stiffness of a point of the rim at the middle of the cut, while the saw turns below a force fixed in
//! space.

use crate::analyses::deflect::PointLoad;
use crate::model::plate::{Plate, Resolution};
use crate::model::scene::{Polar, Scene};
use crate::stability::{Analysis, StabilityState};

/// A point load deforms the rim in waves of all lengths; the contribution of n diameters falls only with n³.
/// The stiffness of a point therefore needs a larger basis than critical speeds do.
const POINT_LOAD_BASIS: Resolution = Resolution {
    max_diameters: 30,
    radial_functions: 12,
};

/// Largest relative error of the distance from a critical speed at which a factor of the deflection is given: near
/// the critical speed the factor has the same relative error.
const DISTANCE_ERROR: f64 = 0.1;

/// The plate of a scene on a basis for point loads, in which critical speeds are at least as accurate as in its analysis on
/// the basis `own`.
pub(crate) fn point_load_plate(scene: &Scene, own: Resolution) -> Plate {
    let resolution = Resolution {
        max_diameters: own.max_diameters.max(POINT_LOAD_BASIS.max_diameters),
        radial_functions: own.radial_functions.max(POINT_LOAD_BASIS.radial_functions),
    };
    Plate::new(scene, resolution)
}

/// The rim at the cut.
pub(crate) fn rim_at_cut(scene: &Scene) -> Polar {
    Polar::new(scene.blade().outer_radius_m, scene.cut_angle_rad())
}

/// A side force on the rim at the cut; `None` if rigid motions are free.
fn side_force(scene: &Scene, own: Resolution) -> Option<PointLoad> {
    PointLoad::new(&point_load_plate(scene, own), rim_at_cut(scene))
}

/// Lateral stiffness at rest, in N/m; `None` if rigid motions are free.
pub(crate) fn rim_stiffness_at_rest_n_per_m(analysis: &Analysis) -> Option<f64> {
    let force = side_force(&analysis.scene, analysis.model.plate.resolution)?;
    Some(1.0 / force.compliance_m_per_n(0.0)?)
}

/// Deflection of the rim at the cut under a constant side force there, relative to that at rest: φᵀK(Ω)⁻¹φ /
/// φᵀK(0)⁻¹φ, negative above a critical speed whose wave dominates, where the blade moves against the force.
///
/// Only for a stable saw; `None` elsewhere, if rigid motions are free, and if the estimated error of a critical speed within 5 % is
/// unknown, or is more than a tenth of the distance from it.
pub(crate) fn side_force_factor(analysis: &Analysis, speed_rad_per_s: f64) -> Option<f64> {
    let judged = Judged::of(analysis, speed_rad_per_s);
    judged.side_force_factor(&analysis.scene, analysis.model.plate.resolution)
}

/// A saw at a speed, judged.
pub(crate) struct Judged {
    pub speed_rad_per_s: f64,
    pub state: StabilityState,
    /// Critical speed within 5 %.
    pub critical_rad_per_s: Option<f64>,
    /// Estimated error of critical speeds.
    pub estimated_relative_error: Option<f64>,
}

impl Judged {
    /// The saw of an analysis at a speed.
    pub fn of(analysis: &Analysis, speed_rad_per_s: f64) -> Self {
        let verdict = analysis.verdict(speed_rad_per_s);
        let near = verdict
            .critical
            .map(|place| &analysis.model.critical[place]);
        Judged {
            speed_rad_per_s,
            state: verdict.state,
            critical_rad_per_s: near.map(|critical| critical.speed_rad_per_s),
            estimated_relative_error: analysis.estimated_relative_error,
        }
    }

    /// Reason for which the saw has no steady deflection; `None` if it is stable.
    pub fn not_stable(&self) -> Option<&'static str> {
        match self.state {
            StabilityState::Stable => None,
            StabilityState::Divergence | StabilityState::Flutter => Some("the saw is unstable"),
            StabilityState::TooClose => Some("it is too close to call whether the saw is stable"),
            StabilityState::OutsideSweep => Some("the sweep does not include the speed"),
            StabilityState::NotCovered => {
                Some("slots pass guides, which the model does not cover at this speed")
            }
            StabilityState::NotDetermined => Some("the search for bands failed"),
        }
    }

    /// Reason for which the saw has no steady deflection with linear guides, or none that is known accurately; `None` if it has.
    pub fn no_answer(&self) -> Option<&'static str> {
        if let Some(reason) = self.not_stable() {
            return Some(reason);
        }
        let critical = self.critical_rad_per_s?;
        let distance = (self.speed_rad_per_s / critical - 1.0).abs();
        let error = self.estimated_relative_error.unwrap_or(f64::INFINITY);
        (error > DISTANCE_ERROR * distance)
            .then_some("a critical speed is so close that its estimated error decides")
    }

    /// The number of [`side_force_factor`] for the saw of a scene that was analysed on a basis.
    pub fn side_force_factor(&self, scene: &Scene, analysed_on: Resolution) -> Option<f64> {
        if self.no_answer().is_some() {
            return None;
        }
        let force = side_force(scene, analysed_on)?;
        Some(force.compliance_m_per_n(self.speed_rad_per_s)? / force.compliance_m_per_n(0.0)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analyses::response::{Options, response};
    use crate::model::scene::{Accuracy, ProbeFile, SideForceFile, rpm};
    use crate::model::system::GyroscopicSystem;
    use crate::motion::transient::at_point;

    /// A clamped blade at an operating speed, and at a share of its first critical speed.
    fn clamped(operating_rpm: f64) -> Scene {
        let json = include_str!("../../../scenes/collar-400mm.json");
        let saw = Scene::from_json(json).unwrap().edited(|saw| {
            (saw.accuracy, saw.operating_rpm) = (Accuracy::Draft, Some(operating_rpm));
        });
        saw.unwrap()
    }

    /// Spectral expansion with the waves x of K₀x = Ω_c²(N − K_σ)x, φᵀK(Ω)⁻¹φ = Σ (φᵀx)²/xᵀK₀x · 1/(1 − (Ω/Ω_c)²):
    /// close to Ω_c the terms of that speed remain, and the other ones cancel in the difference of both sides.
    #[test]
    fn next_to_a_critical_speed_the_factor_is_that_of_its_wave() {
        let saw = clamped(3800.0);
        let analysis = Analysis::new(&saw).unwrap();
        let plate = point_load_plate(&saw, analysis.model.plate.resolution);
        let system = GyroscopicSystem::of_plate(&plate);
        let point = at_point(&plate, rim_at_cut(&saw));
        let force = PointLoad::new(&plate, rim_at_cut(&saw)).unwrap();
        let at_rest = force.compliance_m_per_n(0.0).unwrap();
        let waves = crate::modes::critical_speeds(&system).unwrap();
        let critical = waves[0].speed_rad_per_s;
        let lowest = waves
            .iter()
            .filter(|c| (c.speed_rad_per_s / critical - 1.0).abs() < 1e-3);
        let share: f64 = lowest
            .map(|c| {
                let reached: f64 = point.transpose() * &c.shape;
                reached * reached / (c.shape.transpose() * &system.stiffness * &c.shape)
            })
            .sum();
        let sides = [0.997, 1.003].map(|ratio| {
            let one_wave = 1.0 / (1.0 - ratio * ratio);
            let at = force.compliance_m_per_n(ratio * critical);
            (at.unwrap() / at_rest, one_wave * share / at_rest)
        });
        let [below, above] = sides;
        let error = (below.0 - above.0) / (below.1 - above.1) - 1.0;
        assert!(error.abs() < 0.01, "{sides:?}");
        assert!(below.0 > 0.0 && above.0 < 0.0, "{sides:?}");
        // A single wave would give 167.
        assert!(below.0 < 35.0, "{sides:?}");
    }

    /// The response at zero frequency, by its own basis of complex solutions.
    #[test]
    fn the_factor_is_that_of_the_response() {
        let analysis = Analysis::new(&clamped(3800.0)).unwrap();
        let critical = analysis.model.critical[0].speed_rad_per_s;
        for ratio in [0.5, 0.96, 1.045] {
            let saw = clamped(rpm(ratio * critical))
                .edited(|saw| {
                    let angle_deg = clamped(3800.0).cut_angle_rad().to_degrees();
                    saw.side_force = Some(SideForceFile::of(1e-3));
                    saw.probe = Some(ProbeFile {
                        radius_m: None,
                        angle_deg,
                    });
                })
                .unwrap();
            let report = response(&saw, &Options::default()).unwrap();
            let at = |speed: f64| {
                let limit = rpm(speed) * (1.0 - 1e-12);
                let place = report.rpm.partition_point(|rpm| *rpm < limit);
                let line = &report.lines[0];
                let phase = line.phase_deg[place].unwrap().to_radians();
                line.amplitude_m[place].unwrap() * phase.cos()
            };
            let expected = at(ratio * critical) / at(0.0);
            let own = Analysis::new(&saw).unwrap();
            let factor = side_force_factor(&own, ratio * critical).unwrap();
            assert!(
                (factor / expected - 1.0).abs() < 0.03,
                "{factor} {expected}"
            );
        }
    }
}
