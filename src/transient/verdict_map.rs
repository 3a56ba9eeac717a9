//! The growth rate in a cut over the angle of the guides and the level of the load.

use std::sync::atomic::{AtomicUsize, Ordering};

use faer::{Mat, Scale};
use rayon::prelude::*;

use crate::campbell::Progress;
use crate::spectrum::{Growing, SpectrumError};
use crate::system::GyroscopicSystem;

use super::reduced::{ReducedBlade, Snapshot};
use super::saw_in_cut::{SawInCut, lateral_load};
use super::{Growth, TransientError};

/// Growth rates at one speed on a grid.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct VerdictMap {
    /// Angles by which all guides are moved around the axis.
    pub turns_rad: Vec<f64>,
    /// Factors of the radial and tangential forces.
    pub load_levels: Vec<f64>,
    /// Growth, with one row for each load level and one column for each angle.
    pub growth: Vec<Vec<Growth>>,
}

/// Number of angles at which the modes in the cut are added to the basis.
const SNAPSHOTS: usize = 3;
/// Number of modes at each of these angles; flutter in the cut has low frequencies.
const MODES: usize = 8;

/// Computes the map at one speed.
///
/// Rotating the guides by α is equivalent, except for a rotation of the whole, to rotating the cut by −α, so
/// that one basis serves the whole map.
///
/// # Errors
/// [`TransientError::Spectrum`].
pub fn verdict_map(
    saw: &SawInCut<'_>,
    (turns_rad, load_levels): (&[f64], &[f64]),
    progress: Progress<'_>,
) -> Result<VerdictMap, TransientError> {
    let speed = saw.run.speed_rad_per_s;
    let blade = map_basis(saw, turns_rad, load_levels)?;
    let reduced = saw.idle_on(&blade);
    let edges: Vec<Mat<f64>> = turns_rad
        .par_iter()
        .map(|turn| blade.turned(saw.plate, *turn).matrix(&saw.edge_stiffness))
        .collect();
    let done = AtomicUsize::new(0);
    let of = turns_rad.len() * load_levels.len();
    let growth = load_levels
        .par_iter()
        .map(|level| {
            edges
                .iter()
                .map(|edge| {
                    let mut system = reduced.clone();
                    system.stiffness += Scale(*level) * edge;
                    let found = Growing::at(&system, speed)?;
                    progress(done.fetch_add(1, Ordering::Relaxed) + 1, of);
                    Ok(Growth::from(found))
                })
                .collect::<Result<Vec<Growth>, TransientError>>()
        })
        .collect::<Result<Vec<_>, _>>()?;
    Ok(VerdictMap {
        turns_rad: turns_rad.to_vec(),
        load_levels: load_levels.to_vec(),
        growth,
    })
}

/// The basis of the idle saw and of the saw with its cut rotated to a few angles.
fn map_basis(
    saw: &SawInCut<'_>,
    turns_rad: &[f64],
    load_levels: &[f64],
) -> Result<ReducedBlade, SpectrumError> {
    let whole = ReducedBlade::whole(saw.plate);
    let mut systems = vec![saw.idle_system.clone()];
    for k in 0..SNAPSHOTS {
        let place = k * turns_rad.len().saturating_sub(1) / (SNAPSHOTS - 1);
        if let Some(turn) = turns_rad.get(place) {
            let mut system = saw.idle_system.clone();
            system.stiffness += whole.turned(saw.plate, *turn).matrix(&saw.edge_stiffness);
            systems.push(system);
        }
    }
    let snapshots: Vec<Snapshot<'_>> = systems
        .iter()
        .map(|system| Snapshot {
            system,
            speed_rad_per_s: saw.run.speed_rad_per_s,
        })
        .collect();
    let load = lateral_load(saw.plate, &saw.cut.teeth.standing());
    let mut blade = ReducedBlade::new(saw.plate, &snapshots, MODES, &[load]);
    let highest = load_levels.iter().copied().fold(1.0, f64::max);
    let place = |system: &GyroscopicSystem| &system.stiffness - &saw.idle_system.stiffness;
    for system in systems.iter().skip(1) {
        let mut heaviest = system.clone();
        heaviest.stiffness += Scale(highest - 1.0) * place(system);
        blade = blade.with_buckled_shapes(&heaviest)?;
    }
    Ok(blade)
}
