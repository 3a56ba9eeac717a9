//! Where to put the guides: pad radius, angle and stiffness within bounds for the highest
//! flutter speed, or the widest stable window around the operating speed, under a limit on the
//! lowest critical speed.
//!
//! The flutter speed is not continuous in the numbers: it jumps where the peak of a band passes the
//! threshold. The best saw may stand right beside such a jump, so the answer includes what saws
//! with slightly different numbers are worth. Bands are searched without
//! the forces of a cut. One angle of guides that may all turn is held, since nothing else
//! stands in space: a single pad may be anywhere around the blade.
//!
//! ```
//! use sawflutter::place::{Demands, Options, Placement};
//! use sawflutter::plate::Resolution;
//! use sawflutter::scene::{Freed, Scene};
//!
//! let scene = Scene::paper();
//! let radius = Freed::new(scene.file(), "guides[0].radius_m", 0.18, 0.28)?;
//! let resolution = Some(Resolution { max_diameters: 7, radial_functions: 3 });
//! let options = Options { resolution, samples: 4, places: 1, refine: 6, map: 0 };
//! let found = Placement::new(&scene, &[radius], &Demands::default(), &options, &|_, _, _| ())?;
//! assert!(found.best.value_rad_per_s >= found.before.value_rad_per_s);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod demands;
mod growing;
mod map;
mod neighbours;
mod outcome;
mod search;
mod settle;

use std::convert::Infallible;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use crate::plate::Resolution;
use crate::scene::{Freed, Scene, SceneError, effective};
use crate::spectrum::SpectrumError;
use crate::stability::AnalysisError;
use crate::stability::ChosenBasis;

pub use demands::{Demands, Goal, Options};
use growing::Grower;
#[cfg(feature = "explore")]
pub(crate) use growing::GrowingMap;
pub(crate) use growing::Watch;
pub(crate) use map::Map;
pub(crate) use neighbours::Neighbours;
pub use outcome::Outcome;
use outcome::{Question, REFUSED};
use search::{Search, Tried};
use settle::{Choice, basis_of_all, settle};

/// Why no place could be looked for.
#[derive(Debug, thiserror::Error)]
pub enum PlaceError {
    /// Nothing to move.
    #[error(
        "no number is free that moves a critical speed or a band; free another one, like guides[0].radius_m"
    )]
    NothingFree,
    /// The scene itself, or every saw tried, cannot be analysed.
    #[error("none of the {tried} saws tried can be analysed; narrow the bounds")]
    NoSaw {
        /// How many.
        tried: usize,
    },
    /// A scene was refused.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// An eigenproblem failed.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// The saw could not be analysed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
}

/// A number and what was found for it.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedParameter {
    /// Which, and between which bounds.
    pub freed: Freed,
    /// What the scene had.
    pub start: f64,
    /// What is best.
    pub value: f64,
    /// Whether it rests on a bound.
    pub at_bound: bool,
}

/// The best saw found.
#[derive(Debug, Clone)]
pub struct Placement {
    /// The saw: the best that was found, or the scene as it was where none between the bounds is
    /// better.
    pub scene: Scene,
    /// Whether it is better than the scene as it was. It can be worse where that one does not
    /// lie within the bounds.
    pub improved: bool,
    /// Numbers found.
    pub parameters: Vec<PlacedParameter>,
    /// Freed numbers that move nothing, or nothing that the others do not move as well.
    pub without_effect: Vec<Freed>,
    /// The scene as it was.
    pub before: Outcome,
    /// The best saw.
    pub best: Outcome,
    /// Saws a little off the best one.
    pub(crate) neighbours: Neighbours,
    /// The goal over two of the numbers.
    pub(crate) map: Option<Map>,
    /// Sweep in rad/s, the same for every saw.
    pub range: (f64, f64),
    /// The basis of the best saw.
    pub resolution: Resolution,
    /// Saws analysed.
    pub evaluations: usize,
}

/// Progress callback: which step, how many of its saws are done, and of how many.
pub type Progress<'a> = &'a (dyn Fn(&'static str, usize, usize) + Sync);

/// The search may be this far off; the best that it finds are held against each other, and
/// refined, on the basis asked for.
const COARSE_TOLERANCE: f64 = 5e-2;
/// How far apart places to refine are at least, as a share of the bounds.
const APART: f64 = 0.08;
/// First and last steps of the refinement as shares of the bounds.
const COARSE_STEPS: (f64, f64) = (0.08, 2e-3);
/// The fine basis moves an optimum, and the cliffs next to it, by little: so many times fewer saws
/// are enough there, and each costs ten times as much.
const SETTLED: u64 = 3;
/// A map that still finds better saws is not drawn again for ever.
const MAP_ROUNDS: usize = 3;
/// So many samples more than were refined are candidates for the finer basis.
const MORE_SAMPLES: usize = 2;
/// Nearer to a bound than this a share rests on it.
const AT_BOUND: f64 = 1e-3;
/// Shares of the bounds at which a number is looked at for whether it moves anything.
const LOOKED_AT: [f64; 2] = [0.23, 0.71];
/// Speeds that move by less than this share of themselves do not move.
const IDLE: f64 = 1e-7;

impl Placement {
    /// Looks for the best saw: even samples of the bounds, direct search (MADS) from the best of
    /// them, a map through the result, and refinement on the basis that the tolerance asks for.
    ///
    /// # Errors
    /// [`PlaceError`] where no freed number has an effect, or no saw tried can be analysed.
    pub fn new(
        scene: &Scene,
        freed: &[Freed],
        demands: &Demands,
        options: &Options,
        progress: Progress<'_>,
    ) -> Result<Self, PlaceError> {
        Self::watched(scene, freed, demands, options, progress, &|_| ())
    }

    /// The same, with the map shown while it is computed.
    ///
    /// # Errors
    /// Those of [`Placement::new`].
    pub(crate) fn watched(
        scene: &Scene,
        freed: &[Freed],
        demands: &Demands,
        options: &Options,
        progress: Progress<'_>,
        watch: Watch<'_>,
    ) -> Result<Self, PlaceError> {
        let chosen = ChosenBasis::new(scene, scene.tolerance().max(COARSE_TOLERANCE))?;
        let evaluations = AtomicUsize::new(0);
        let mut question = Question {
            goal: demands.goal,
            min_critical_rad_per_s: demands.min_critical_rad_per_s,
            range: chosen.range_rad_per_s,
            resolution: options.resolution.unwrap_or(chosen.saw.plate.resolution),
        };
        let (freed, without_effect) = moving(scene, freed, &question, &evaluations);
        if freed.is_empty() {
            return Err(PlaceError::NothingFree);
        }
        let own: Vec<f64> = freed.iter().map(|f| f.share_of(scene.file())).collect();
        let coarse = Search {
            scene: scene.file(),
            freed: &freed,
            question: &question,
            evaluations: &evaluations,
        };
        let (candidates, map) = look_everywhere(&coarse, &own, options, (progress, watch))?;
        if options.resolution.is_none() {
            question.resolution = basis_of_all(scene, &freed, &candidates, question.range)?;
        }
        let fine = Search {
            scene: scene.file(),
            freed: &freed,
            question: &question,
            evaluations: &evaluations,
        };
        let cells = map.as_ref().map_or(Vec::new(), Map::cells);
        let budget = options.refine / SETTLED;
        let settled = settle(&fine, &candidates, &cells, budget, progress);
        let before = fine.question.ask(scene)?;
        let tried = evaluations.load(Ordering::Relaxed);
        let chosen = Choice::between(scene, &freed, settled, before.clone(), tried)?;
        let neighbours = Neighbours::new(&fine, &chosen.shares, &chosen.outcome, progress);
        Ok(Placement {
            parameters: parameters(scene, &freed, &chosen)?,
            scene: chosen.scene,
            improved: chosen.improved,
            without_effect,
            before,
            best: chosen.outcome,
            neighbours,
            map,
            range: question.range,
            resolution: question.resolution,
            evaluations: evaluations.load(Ordering::Relaxed),
        })
    }
}

/// Every number with what was found for it.
fn parameters(
    scene: &Scene,
    freed: &[Freed],
    chosen: &Choice,
) -> Result<Vec<PlacedParameter>, SceneError> {
    let numbers = freed.iter().zip(&chosen.shares).map(|(freed, share)| {
        Ok(PlacedParameter {
            freed: freed.clone(),
            start: freed.parameter.get(scene.file())?,
            value: freed.parameter.get(chosen.scene.file())?,
            at_bound: !(AT_BOUND..=1.0 - AT_BOUND).contains(share),
        })
    });
    numbers.collect()
}

/// Samples, refines the best of them, and draws the map through the best; a map that shows a
/// better saw is where the search goes on. The candidates for the finer basis, best first: what
/// the refinements led to, the start, and the best samples, for a saw next to a cliff on this
/// basis may be over it on the other.
fn look_everywhere(
    search: &Search<'_>,
    own: &[f64],
    options: &Options,
    (progress, watch): (Progress<'_>, Watch<'_>),
) -> Result<(Vec<Tried>, Option<Map>), PlaceError> {
    let samples = options.samples.max(1);
    let grower = Grower::new(search, options.map, watch);
    let tried = search.sample(own, samples, &|seen| {
        progress("samples", seen.done, samples);
        grower.sampled(search, &seen);
    });
    let places = options.places.max(1);
    let starts = Search::apart(&tried, places, APART);
    let mut candidates: Vec<Tried> = starts
        .par_iter()
        .map(|start| search.refine(start, COARSE_STEPS, options.refine))
        .collect();
    let mut best = cheapest(&candidates).ok_or(PlaceError::NoSaw { tried: samples })?;
    if best.cost >= REFUSED {
        return Err(PlaceError::NoSaw { tried: samples });
    }
    let mut map = None;
    for _ in 0..if options.map < 2 { 0 } else { MAP_ROUNDS } {
        let through_best = Map::unknown(search, options.map).through(&best.shares);
        let drawn = grower.drawn(through_best, search, progress);
        let on_map = cheapest(&drawn.cells());
        map = Some(drawn);
        match on_map {
            Some(better) if better.cost < best.cost => {
                best = search.refine(&better, COARSE_STEPS, options.refine);
                candidates.push(best.clone());
            }
            _ => break,
        }
    }
    let own = tried.iter().find(|one| one.shares == own);
    candidates.extend(own.cloned());
    candidates.extend(Search::apart(&tried, places + MORE_SAMPLES, APART));
    candidates.retain(|one| one.cost < REFUSED);
    candidates.sort_by(|x, y| x.cost.total_cmp(&y.cost));
    candidates.dedup_by(|x, y| x.shares == y.shares);
    Ok((candidates, map))
}

fn cheapest(tried: &[Tried]) -> Option<Tried> {
    let least = tried.iter().min_by(|x, y| x.cost.total_cmp(&y.cost));
    least.cloned()
}

/// Parts the freed numbers into those that move a critical speed or a band, and the others.
fn moving(
    scene: &Scene,
    freed: &[Freed],
    question: &Question,
    evaluations: &AtomicUsize,
) -> (Vec<Freed>, Vec<Freed>) {
    let search = Search {
        scene: scene.file(),
        freed,
        question,
        evaluations,
    };
    let speeds = |shares: &[f64]| {
        let of = |outcome: Outcome| {
            let first = outcome.bands.first();
            [
                outcome.value_rad_per_s,
                outcome.critical_rad_per_s.unwrap_or(0.0),
                first.map_or(0.0, |band| band.from_rad_per_s),
            ]
        };
        Ok::<_, Infallible>(search.outcome(shares).map(of))
    };
    let differ = |x: &[f64; 3], y: &[f64; 3]| {
        let mut pairs = x.iter().zip(y);
        pairs.any(|(x, y)| (x - y).abs() > IDLE * x.abs().max(y.abs()))
    };
    let Ok(parted) = effective(scene, freed, &LOOKED_AT, speeds, differ);
    parted
}
