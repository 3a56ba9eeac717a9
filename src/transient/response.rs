//! The response at the probe to a force of any frequency, at any speed.

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, c64};
use rayon::prelude::*;

use crate::plate::Plate;
use crate::scene::{Probe, RunUp};
use crate::system::GyroscopicSystem;

use super::reduced::at_point;
use super::runup::reduced_blade;

/// |w/F| over speed and frequency.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ResponseMap {
    /// Speeds.
    pub speed_rad_per_s: Vec<f64>,
    /// Frequencies of the force.
    pub frequency_rad_per_s: Vec<f64>,
    /// Deflection per newton: one row a speed.
    pub receptance_m_per_n: Vec<Vec<f64>>,
}

/// Maps |cᵀ L(s)⁻¹ b| on s = iω + Δω/2.
///
/// An undamped saw answers its own frequencies without bound; half a pixel off the
/// imaginary axis, which is to look at it through a window of 2/Δω seconds, every mode
/// shows with a finite height and none falls between two pixels.
pub fn response_map(
    plate: &Plate,
    runup: &RunUp,
    probe: &Probe,
    (speeds, frequencies): (&[f64], &[f64]),
) -> ResponseMap {
    let blade = reduced_blade(plate, runup);
    let system = blade.system(&GyroscopicSystem::of_plate(plate));
    let force = blade.vector(&at_point(
        plate,
        plate.blade.outer_radius_m,
        runup.angle_rad,
    ));
    let read = blade.vector(&at_point(plate, probe.radius_m, probe.angle_rad));
    let apart = match frequencies {
        [first, second, ..] => second - first,
        _ => 1.0,
    };
    let right: Col<c64> = Col::from_fn(force.nrows(), |i| c64::new(force[i], 0.0));
    let receptance_m_per_n = speeds
        .par_iter()
        .map(|&speed| {
            let (stiffness, velocity) = (system.stiffness_at(speed), system.velocity_at(speed));
            frequencies
                .iter()
                .map(|&frequency| {
                    let s = c64::new(0.5 * apart, frequency);
                    let dynamic: Mat<c64> = Mat::from_fn(system.order(), system.order(), |i, k| {
                        let inertia = if i == k { s * s } else { c64::new(0.0, 0.0) };
                        inertia + s * velocity[(i, k)] + stiffness[(i, k)]
                    });
                    let q = dynamic.partial_piv_lu().solve(&right);
                    let deflection: c64 = (0..q.nrows()).map(|i| q[i] * read[i]).sum();
                    deflection.norm()
                })
                .collect()
        })
        .collect();
    ResponseMap {
        speed_rad_per_s: speeds.to_vec(),
        frequency_rad_per_s: frequencies.to_vec(),
        receptance_m_per_n,
    }
}
