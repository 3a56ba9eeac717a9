//! Static deflection under a lateral force over the speed, up to the first critical speed.

use std::convert::Infallible;

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, Scale};

use super::report::RimStiffness;
use crate::model::plate::Plate;
use crate::model::scene::{Polar, rpm};
use crate::model::system::GyroscopicSystem;
use crate::modes::orthonormal;
use crate::motion::transient::at_point;
use crate::stability::{Look, bracketed};

/// Squared speeds, relative to the squared first critical speed, at which the response is solved on the full
/// model. The response is a rational function of the squared speed, which the reduced model on these responses
/// interpolates.
const SOLVED_AT: [f64; 6] = [0.0, 0.25, 0.5, 0.75, 0.9, 0.97];
/// Number of evenly spaced speeds of the curve.
const SPEEDS: usize = 41;
/// End of the curve relative to the first critical speed, at which the deflection is unbounded.
const LAST_SHARE: f64 = 0.99;
/// Directions of the responses that are shorter than this share of the longest are rounding errors.
const LEAST: f64 = 1e-12;
/// Relative error of the speed at which a gap closes.
const SPEED_TOLERANCE: f64 = 1e-12;

/// Static response of the blade to forces fixed in space.
pub struct StaticDeflection {
    /// Reduced model on the responses.
    system: GyroscopicSystem,
    basis: Mat<f64>,
    /// Load of one newton on the rim at the middle of the cut.
    rim: Col<f64>,
    /// Lateral forces of the teeth in the cut.
    cut: Option<Col<f64>>,
    to_rad_per_s: f64,
}

impl StaticDeflection {
    /// The response below a critical speed, at the rim at an angle, and under the lateral forces of a cut. `None` if rigid motions are free, so that nothing holds the blade.
    pub fn new(
        plate: &Plate,
        angle_rad: f64,
        cut: Option<Col<f64>>,
        critical_rad_per_s: f64,
    ) -> Option<Self> {
        let system = GyroscopicSystem::of_plate(plate);
        if !system.free_rigid.is_empty() {
            return None;
        }
        let rim_radius_m = plate.blade.outer_radius_m;
        let rim = at_point(plate, Polar::new(rim_radius_m, angle_rad));
        let mut responses: Vec<Col<f64>> = Vec::new();
        for share in SOLVED_AT {
            let stiffness = system.stiffness_at(share.sqrt() * critical_rad_per_s);
            let factor = stiffness.partial_piv_lu();
            for load in std::iter::once(&rim).chain(&cut) {
                let response = factor.solve(load);
                let length = response.norm_l2();
                responses.push(Scale(1.0 / length) * response);
            }
        }
        let basis = orthonormal(rim.nrows(), &responses, LEAST);
        let onto = |load: &Col<f64>| basis.transpose() * load;
        Some(StaticDeflection {
            system: system.project(basis.as_ref()),
            rim: onto(&rim),
            cut: cut.as_ref().map(onto),
            basis,
            to_rad_per_s: LAST_SHARE * critical_rad_per_s,
        })
    }

    fn answer(&self, load: &Col<f64>, speed_rad_per_s: f64) -> Col<f64> {
        let stiffness = self.system.stiffness_at(speed_rad_per_s);
        stiffness.partial_piv_lu().solve(load)
    }

    fn speeds(&self) -> impl Iterator<Item = f64> + '_ {
        let last = (SPEEDS - 1) as f64;
        (0..SPEEDS).map(move |k| self.to_rad_per_s * k as f64 / last)
    }

    /// Stiffness of the point of the rim.
    pub fn rim_stiffness(&self) -> RimStiffness {
        let stiffness = |speed: f64| 1.0 / (self.rim.transpose() * self.answer(&self.rim, speed));
        RimStiffness {
            rpm: self.speeds().map(rpm).collect(),
            n_per_m: self.speeds().map(stiffness).collect(),
        }
    }

    /// Deflection at a point under the lateral forces of the cut, in m; `None` without such forces.
    pub fn in_cut_m(&self, point: &Col<f64>, speed_rad_per_s: f64) -> Option<f64> {
        let load = self.cut.as_ref()?;
        let reading = self.basis.transpose() * point;
        Some(reading.transpose() * self.answer(load, speed_rad_per_s))
    }

    /// Lowest speed, in rad/s, at which the deflection at a point equals a gap; `None` if it remains smaller.
    pub fn fills_gap_at(&self, point: &Col<f64>, gap_m: f64) -> Option<f64> {
        let look = |speed: f64| Look {
            at: speed,
            value: self.in_cut_m(point, speed).unwrap_or(0.0).abs() - gap_m,
            point: speed,
        };
        let looks: Vec<Look<f64>> = self.speeds().map(look).collect();
        let first = looks.iter().position(|look| look.value >= 0.0)?;
        let Some(before) = first.checked_sub(1) else {
            return Some(0.0);
        };
        let ends = [looks[before], looks[first]];
        let found: Result<_, Infallible> = bracketed(ends, SPEED_TOLERANCE, |[from, to], share| {
            Ok(look(from + share * (to - from)))
        });
        match found {
            Ok(look) => Some(look.at),
        }
    }
}
