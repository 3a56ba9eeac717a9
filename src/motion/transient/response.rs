//! Response at the probe to a harmonic force at the place of the side force, over frequency and speed.

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, c64};
use rayon::prelude::*;

use crate::model::plate::Plate;
use crate::model::scene::{Point, RunUpFile, SideForce};
use crate::model::system::GyroscopicSystem;

use super::reduced_blade::at_point;
use super::runup::reduced_blade;

/// Computes the receptance |w/F| = |cᵀ L(s)⁻¹ b| at the probe, in m/N, on s = iω + Δω/2: a row for each speed.
///
/// The response of an undamped saw at its natural frequencies is unbounded. At a distance of Δω/2 from the
/// imaginary axis, which corresponds to a window of 2/Δω seconds, every mode has a finite peak that is at least
/// one frequency step Δω wide.
pub fn response_map(
    plate: &Plate,
    (runup, force): (&RunUpFile, &SideForce),
    probe: Point,
    (speeds, frequencies): (&[f64], &[f64]),
) -> Vec<Vec<f64>> {
    let blade = reduced_blade(plate, runup, force);
    let system = blade.system(&GyroscopicSystem::of_plate(plate));
    let force = blade.vector(&at_point(plate, force.at.polar()));
    let read = blade.vector(&at_point(plate, probe.polar()));
    let apart = match frequencies {
        [first, second, ..] => second - first,
        _ => 1.0,
    };
    let right: Col<c64> = Col::from_fn(force.nrows(), |i| c64::new(force[i], 0.0));
    speeds
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
        .collect()
}
