//! The growth rate in a cut over the angle of the guides and the level of the load.

use std::sync::atomic::{AtomicUsize, Ordering};

use faer::{Mat, Scale};
use rayon::prelude::*;

use crate::campbell::Progress;
use crate::plate::Plate;
use crate::scene::{Cut, CutRun};
use crate::spectrum::fastest_growing;
use crate::system::GyroscopicSystem;

use super::TransientError;
use super::cut::{in_cut_plate, lateral_load};
use super::reduced::{ReducedBlade, Snapshot};

/// Growth rates of one speed on a grid.
#[derive(Debug, Clone, PartialEq)]
pub struct VerdictMap {
    /// By how much all guides are moved around the axis.
    pub turns_rad: Vec<f64>,
    /// Multiples of the radial and tangential forces.
    pub load_levels: Vec<f64>,
    /// Growth: one row a load level, one column a turn.
    pub growth_per_s: Vec<Vec<f64>>,
}

/// Turns at which the modes in the cut join the basis.
const SNAPSHOTS: usize = 3;
/// Modes of each: flutter in the cut is slow.
const MODES: usize = 8;

/// Maps the growth rate of one speed.
///
/// Guides turned by α and the cut in its place are, but for a turn of the whole, guides in
/// their place and the cut turned by −α: one basis then serves the map.
///
/// # Errors
/// [`TransientError::Spectrum`].
pub fn verdict_map(
    plate: &Plate,
    cut: &Cut,
    run: &CutRun,
    (turns_rad, load_levels): (&[f64], &[f64]),
    progress: Progress<'_>,
) -> Result<VerdictMap, TransientError> {
    let speed = run.speed_rad_per_s;
    let cutting = in_cut_plate(plate, cut, run);
    let Some(edge) = &cutting.edge_stiffness else {
        return Ok(VerdictMap {
            turns_rad: Vec::new(),
            load_levels: Vec::new(),
            growth_per_s: Vec::new(),
        });
    };
    let whole = ReducedBlade::whole(plate);
    let idle = GyroscopicSystem::of_plate(plate);
    let mut systems = vec![idle.clone()];
    for k in 0..SNAPSHOTS {
        let place = k * turns_rad.len().saturating_sub(1) / (SNAPSHOTS - 1);
        if let Some(turn) = turns_rad.get(place) {
            let mut system = idle.clone();
            system.stiffness += whole.turned(plate, *turn).matrix(edge);
            systems.push(system);
        }
    }
    let snapshots: Vec<Snapshot<'_>> = systems
        .iter()
        .map(|system| Snapshot {
            system,
            speed_rad_per_s: speed,
        })
        .collect();
    let blade = ReducedBlade::new(plate, &snapshots, MODES, &[lateral_load(plate, cut, 0.0)]);
    // What nothing holds is what nothing holds in the cut.
    let mut reduced = blade.system(&GyroscopicSystem::of_plate(&cutting));
    reduced.stiffness -= blade.matrix(edge);
    let edges: Vec<Mat<f64>> = turns_rad
        .par_iter()
        .map(|turn| blade.turned(plate, *turn).matrix(edge))
        .collect();
    let done = AtomicUsize::new(0);
    let of = turns_rad.len() * load_levels.len();
    let growth_per_s = load_levels
        .par_iter()
        .map(|level| {
            edges
                .iter()
                .map(|edge| {
                    let mut system = reduced.clone();
                    system.stiffness += Scale(*level) * edge;
                    let fastest = fastest_growing(&system, speed)?;
                    progress(done.fetch_add(1, Ordering::Relaxed) + 1, of);
                    Ok(fastest.map_or(0.0, |lambda| lambda.re))
                })
                .collect::<Result<Vec<f64>, TransientError>>()
        })
        .collect::<Result<Vec<_>, _>>()?;
    Ok(VerdictMap {
        turns_rad: turns_rad.to_vec(),
        load_levels: load_levels.to_vec(),
        growth_per_s,
    })
}
