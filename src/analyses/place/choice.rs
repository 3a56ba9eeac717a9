//! Selects the answer from the candidates of the coarse search: candidates and the original scene are
//! compared on the final basis.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use crate::analyses::door::Progress;
use crate::model::plate::Resolution;
use crate::model::scene::{Freed, Scene, SceneError, SpeedRange, scene_at};
use crate::stability::ChosenBasis;

use super::error::PlaceError;
use super::neighbours::Neighbours;
use super::outcome::{Computed, IDLE};
use super::search::{Search, Tried, cheapest};

/// First and last step of the refinement on the final basis, as shares of the bounds.
const FINE_STEPS: [f64; 2] = [0.02, 1e-3];

/// A saw with its result and its neighbours.
#[derive(Clone)]
pub struct Weighed {
    pub shares: Vec<f64>,
    pub computed: Computed,
    pub neighbours: Neighbours,
}

impl Weighed {
    pub fn new(search: &Search<'_>, shares: Vec<f64>, computed: Computed) -> Self {
        Weighed {
            neighbours: Neighbours::new(search, &shares, &computed),
            shares,
            computed,
        }
    }
}

/// The saw that becomes the answer.
pub struct Choice {
    pub scene: Scene,
    pub saw: Weighed,
    pub improved: bool,
}

impl Choice {
    /// The saw found, or the original scene if that lies within the bounds and the saw found is not better in the
    /// worst case of its tolerances.
    pub fn between(
        search: &Search<'_>,
        scene: &Scene,
        found: Option<Tried>,
        before: &Weighed,
    ) -> Result<Self, PlaceError> {
        let freed = search.freed;
        let own_is_allowed = freed.iter().all(|f| {
            let own = f.parameter.get(scene.file());
            own.is_ok_and(|own| (f.from..=f.to).contains(&own))
        });
        let found = found.and_then(|best| {
            let computed = search.computed(&best.shares)?;
            Some(Weighed::new(search, best.shares, computed))
        });
        let own = before.neighbours.worst_cost;
        let better = |found: &Weighed| found.neighbours.worst_cost < own - IDLE * own.abs();
        match found {
            Some(best) if better(&best) || !own_is_allowed => Ok(Choice {
                scene: placed(scene, freed, &best.shares)?,
                improved: better(&best),
                saw: best,
            }),
            None if !own_is_allowed => Err(PlaceError::NoSaw {
                tried: search.tally().saws,
            }),
            _ => Ok(Choice {
                scene: scene.clone(),
                saw: before.clone(),
                improved: false,
            }),
        }
    }
}

/// The largest of the bases that the tolerance requires for the original scene and the candidates, so that
/// all are compared on the same one.
pub fn basis_of_all(
    scene: &Scene,
    freed: &[Freed],
    candidates: &[Tried],
    range: SpeedRange,
) -> Result<Resolution, PlaceError> {
    let basis_of = |saw: &Scene| -> Result<Resolution, PlaceError> {
        let chosen = ChosenBasis::new(&saw.swept(range)?, scene.tolerance())?;
        Ok(chosen.saw.plate.resolution)
    };
    let own = basis_of(scene)?;
    let others: Vec<Option<Resolution>> = candidates
        .par_iter()
        .map(|tried| basis_of(&scene_at(scene.file(), freed, &tried.shares).ok()?).ok())
        .collect();
    let all = others.into_iter().flatten().chain([own]);
    Ok(all
        .max_by_key(Resolution::degrees_of_freedom)
        .unwrap_or(own))
}

/// Compares the candidates on the final basis in the worst case of their tolerances. Refines the best of them,
/// and also the one that is best at its nominal numbers, because a robust saw may lie next to it. `None` without
/// candidates.
pub fn settle(
    search: &Search<'_>,
    candidates: &[Tried],
    budget: u64,
    progress: Progress<'_>,
) -> Option<Tried> {
    let mut by_itself: Vec<Tried> = candidates
        .par_iter()
        .map(|candidate| Tried {
            shares: candidate.shares.clone(),
            cost: search.cost(&candidate.shares),
        })
        .collect();
    by_itself.sort_by(|x, y| x.cost.total_cmp(&y.cost));
    let mut starts = search.most_robust(&by_itself, 1, 0.0);
    let peak = by_itself.into_iter().next()?.shares;
    if starts.iter().all(|start| start.shares != peak) {
        let cost = search.worst_cost(&peak, f64::INFINITY, &mut 0);
        starts.push(Tried { shares: peak, cost });
    }
    let (done, of) = (AtomicUsize::new(0), budget as usize * starts.len());
    let see = || {
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        progress(search.step("refinement", done.min(of), of));
    };
    let refined: Vec<Tried> = starts
        .par_iter()
        .map(|start| search.refine(start, FINE_STEPS, budget, &see))
        .collect();
    cheapest(&refined)
}

/// The scene with the best numbers, and a note on their origin.
fn placed(scene: &Scene, freed: &[Freed], shares: &[f64]) -> Result<Scene, SceneError> {
    let names: Vec<&str> = freed.iter().map(|f| f.parameter.path()).collect();
    let note = format!("{}: placed by optimization", names.join(", "));
    scene_at(scene.file(), freed, shares)?.edited(|file| file.notes.push(note))
}
