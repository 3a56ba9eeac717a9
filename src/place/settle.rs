//! From candidates of the coarse search to the saw that is answered: candidates and start are held
//! against each other on the basis asked for.

use rayon::prelude::*;

use crate::plate::Resolution;
use crate::scene::{Freed, Scene, SceneError, SpeedRange, scene_at};
use crate::stability::ChosenBasis;

use super::outcome::Outcome;
use super::search::{Search, Tried};
use super::{IDLE, PlaceError, Progress, cheapest};

/// First and last steps of the refinement on that basis, as shares of the bounds.
const FINE_STEPS: (f64, f64) = (0.01, 2e-4);

/// No more cells of a map are held against the candidates.
const MOST_CELLS: usize = 64;

/// The saw that is answered.
pub struct Choice {
    pub scene: Scene,
    pub shares: Vec<f64>,
    pub outcome: Outcome,
    pub improved: bool,
}

impl Choice {
    /// The best saw found, or the scene's own where that is within the bounds and none is better.
    pub fn between(
        scene: &Scene,
        freed: &[Freed],
        settled: Option<(Tried, Outcome)>,
        before: Outcome,
        tried: usize,
    ) -> Result<Self, PlaceError> {
        let better = |found: &Outcome| found.cost() < before.cost() - IDLE * before.cost().abs();
        let own_is_allowed = freed.iter().all(|f| {
            let own = f.parameter.get(scene.file());
            own.is_ok_and(|own| (f.from..=f.to).contains(&own))
        });
        match settled {
            Some((best, outcome)) if better(&outcome) || !own_is_allowed => Ok(Choice {
                scene: placed(scene, freed, &best)?,
                shares: best.shares,
                improved: better(&outcome),
                outcome,
            }),
            None if !own_is_allowed => Err(PlaceError::NoSaw { tried }),
            _ => Ok(Choice {
                scene: scene.clone(),
                shares: freed.iter().map(|f| f.share_of(scene.file())).collect(),
                outcome: before,
                improved: false,
            }),
        }
    }
}

/// The largest of the bases that the tolerance asks for of the start and of every candidate, so
/// that all are held against each other on the same.
pub fn basis_of_all(
    scene: &Scene,
    freed: &[Freed],
    candidates: &[Tried],
    range: (f64, f64),
) -> Result<Resolution, PlaceError> {
    let sweep = SpeedRange {
        from_rad_per_s: range.0,
        to_rad_per_s: range.1,
    };
    let basis_of = |saw: &Scene| -> Result<Resolution, PlaceError> {
        let chosen = ChosenBasis::new(&saw.swept(sweep)?, scene.tolerance())?;
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

/// Holds the candidates against each other on the basis asked for, and with them the cells of the map, best first, that the coarse
/// model holds for better than the best of these: next to a jump of the flutter speed all candidates may stand on the wrong
/// side. Refines the best until direct search finds nothing better.
pub fn settle(
    search: &Search<'_>,
    candidates: &[Tried],
    cells: &[Tried],
    budget: u64,
    progress: Progress<'_>,
) -> Option<(Tried, Outcome)> {
    progress("refinement", 0, 1);
    let on_this_basis = |some: &[Tried]| -> Vec<Tried> {
        let tried = some.par_iter();
        let tried = tried.map(|candidate| search.tried(candidate.shares.clone()));
        tried.collect()
    };
    let mut settled = on_this_basis(candidates);
    let best = cheapest(&settled)?;
    let better = cells.partition_point(|cell| cell.cost < best.cost);
    settled.extend(on_this_basis(&cells[..better.min(MOST_CELLS)]));
    let start = cheapest(&settled)?;
    let best = search.refine(&start, FINE_STEPS, budget);
    let outcome = search.outcome(&best.shares);
    progress("refinement", 1, 1);
    Some((best, outcome?))
}

/// The scene with what was found and a note of where it comes from.
fn placed(scene: &Scene, freed: &[Freed], best: &Tried) -> Result<Scene, SceneError> {
    let names: Vec<&str> = freed.iter().map(|f| f.parameter.path()).collect();
    let note = format!("{}: placed by optimization", names.join(", "));
    scene_at(scene.file(), freed, &best.shares)?.edited(|file| file.notes.push(note))
}
