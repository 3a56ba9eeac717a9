//! The growth rate in a cut over the angle of the guides and the level of the load.

use std::sync::atomic::{AtomicUsize, Ordering};

use faer::{Mat, Scale};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::analyses::campbell::Verdict;
use crate::model::scene::Scene;
use crate::modes::branches::Progress;
use crate::modes::{Growing, SpectrumError};
use crate::motion::transient::{ReducedBlade, Snapshot, TransientError, lateral_load};

use super::record::Growth;
use super::saw::SawInCut;

/// Growth rates over guide angle and load.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "VerdictMapEntry")]
pub struct VerdictMap {
    /// Angles of the first guide, with which all guides move; empty without guides.
    pub guide_angle_deg: Vec<f64>,
    /// Factors of the radial and tangential forces.
    pub load_level: Vec<f64>,
    /// Growth rates, one row for each load level, one column for each angle; one column without guides.
    pub growth_per_s: Vec<Vec<f64>>,
    /// Verdicts by these growth rates, in the same rows and columns.
    pub verdict: Vec<Vec<Verdict>>,
}

/// Number of angles at which the modes in the cut are added to the basis.
const SNAPSHOTS: usize = 3;
/// Number of modes at each of these angles; flutter in the cut has low frequencies.
const MODES: usize = 8;

/// Computes the map at one speed, over angles by which all guides are moved around the axis, and load levels.
///
/// Rotating the guides by α is equivalent, except for a rotation of the whole, to rotating the cut by −α, so
/// that one basis serves the whole map.
///
/// # Errors
/// [`TransientError::Spectrum`].
pub(super) fn verdict_map(
    saw: &SawInCut<'_>,
    scene: &Scene,
    turns_rad: &[f64],
    load_levels: &[f64],
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
    let angle_deg = |turn: &f64| {
        let guide = scene.guides().first()?;
        Some((guide.typed.angle_rad() + turn).to_degrees())
    };
    let verdict = |growth: &Growth| Verdict::of(scene, *growth);
    let rows = growth.iter();
    Ok(VerdictMap {
        guide_angle_deg: turns_rad.iter().filter_map(angle_deg).collect(),
        load_level: load_levels.to_vec(),
        verdict: rows.map(|row| row.iter().map(verdict).collect()).collect(),
        growth_per_s: growth
            .into_iter()
            .map(|row| row.into_iter().map(|growth| growth.growth_per_s).collect())
            .collect(),
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
    for system in systems.iter().skip(1) {
        let mut heaviest = system.clone();
        let of_cut = &system.stiffness - &saw.idle_system.stiffness;
        heaviest.stiffness += Scale(highest - 1.0) * of_cut;
        blade = blade.with_buckled_shapes(&heaviest)?;
    }
    Ok(blade)
}
