//! Placement of guides: radius, angle and stiffness of a pad within bounds, for the highest flutter speed or
//! the widest window without instability around the operating speed, under a lower limit of the first
//! critical speed.
//!
//! The flutter speed is a discontinuous function: it jumps where the peak of a band passes the threshold. A
//! saw next to such a jump is of little use, because production deviates from every number. A saw is
//! therefore rated by the worst of its neighbours, whose numbers deviate by the tolerances of production,
//! [`Tolerances`]: by default 2 mm of a radius, 1° of an angle, 10 % of a stiffness, damping or gap, 1 % of other
//! numbers. The saw that is best without tolerances is reported in addition. Bands are searched without the
//! forces of a cut. If all guides may turn, one angle is held fixed, because a common rotation changes
//! nothing.
//!
//! ```
//! use sawflutter::place::{Demands, Options, Placement};
//! use sawflutter::plate::Resolution;
//! use sawflutter::scene::{Freed, Scene};
//!
//! let scene = Scene::paper();
//! let radius = Freed::new(scene.file(), "guides[0].radius_m", 0.18, 0.28)?;
//! let resolution = Some(Resolution { max_diameters: 7, radial_functions: 3 });
//! let options = Options { resolution, samples: 4, places: 1, refine: 6, map: 0, ..Options::default() };
//! let found = Placement::new(&scene, &[radius], &Demands::default(), &options, &|_, _, _| ())?;
//! assert!(found.worst_rad_per_s() >= found.worst_before_rad_per_s());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod demands;
mod map;
mod neighbours;
mod outcome;
mod search;
mod settle;

use std::convert::Infallible;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use crate::analyses::gap::GapError;
use crate::plate::Resolution;
use crate::scene::{Freed, Scene, SceneError, effective};
use crate::spectrum::{Cancellation, SpectrumError};
use crate::stability::{AnalysisError, ChosenBasis};

pub use demands::{Demands, GapDemands, Goal, Options, Tolerances};
pub(crate) use map::Map;
pub(crate) use neighbours::{Neighbour, Neighbours};
pub use outcome::Outcome;
use outcome::{Question, REFUSED};
use search::{Search, Tally, Tried};
use settle::{Choice, Weighed, basis_of_all, settle};

/// Reason for which a placement failed.
#[derive(Debug, thiserror::Error)]
pub enum PlaceError {
    /// No free number has an effect.
    #[error(
        "no free number changes a critical speed or a band; free another one, like guides[0].radius_m"
    )]
    NothingFree,
    /// The scene itself, or every saw tried, cannot be analysed.
    #[error("none of the {tried} saws tried can be analysed; narrow the bounds")]
    NoSaw {
        /// Number of saws tried.
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
    /// The deflection of a saw with guides with a gap was not found.
    #[error(transparent)]
    Gap(#[from] GapError),
}

/// A free number and its best value.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedParameter {
    /// The number and its bounds.
    pub freed: Freed,
    /// Value in the scene.
    pub start: f64,
    /// Best value.
    pub value: f64,
    /// Whether the best value is a bound.
    pub at_bound: bool,
}

/// The saw that is best in the worst case of its tolerances.
#[derive(Debug, Clone)]
pub struct Placement {
    /// The best saw, or the original scene if no saw within the bounds is better.
    pub scene: Scene,
    /// Whether the saw is better than the original scene, both in the worst case of their tolerances. The saw may
    /// be worse if the original scene lies outside the bounds.
    pub improved: bool,
    /// The free numbers and their best values.
    pub parameters: Vec<PlacedParameter>,
    /// Numbers without effect, or whose effect other free numbers have as well.
    pub without_effect: Vec<Freed>,
    /// Result of the original scene.
    pub before: Outcome,
    /// Result of the best saw.
    pub best: Outcome,
    /// Neighbours of the best saw within its tolerances.
    pub(crate) neighbours: Neighbours,
    /// Worst neighbour of the original scene.
    pub(crate) worst_before: Neighbour,
    /// A saw that is better than the best one at its nominal numbers and worse within its tolerances.
    pub(crate) fragile_optimum: Option<FragileOptimum>,
    /// The goal over two of the numbers.
    pub(crate) map: Option<Map>,
    /// Range of speeds in rad/s, the same for every saw.
    pub range: (f64, f64),
    /// Whether the blade is undamped, so that its modes have Krein signs.
    pub(crate) is_undamped: bool,
    /// Basis of the best saw.
    pub resolution: Resolution,
    /// Numbers of saws analysed and of failures.
    pub(crate) tally: Tally,
}

/// A saw next to a jump of the goal.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FragileOptimum {
    /// The saw at its nominal numbers.
    pub saw: Neighbour,
    /// Worst neighbour of this saw within the tolerances.
    pub worst: Neighbour,
}

/// Progress callback: name of the step, number of its finished saws, number of all its saws.
pub type Progress<'a> = &'a (dyn Fn(&'static str, usize, usize) + Sync);

/// Tolerance that determines the basis of the coarse search. The best saws are compared and refined with the
/// tolerance of the scene.
const COARSE_TOLERANCE: f64 = 5e-2;
/// Smallest distance between samples that are refined, as a share of the bounds.
const APART: f64 = 0.08;
/// First and last step of a refinement, as shares of the bounds.
const COARSE_STEPS: (f64, f64) = (0.08, 5e-3);
/// Factor by which the refinement on the fine basis has fewer steps: it moves an optimum only a little, and each
/// saw takes ten times as long.
const SETTLED: u64 = 3;
/// Number of samples, and of cells of the map, best at their nominal numbers, that are compared on the finer
/// basis too.
const MOST_PROMISING: usize = 3;
/// A share nearer to a bound than this is taken for the bound.
const AT_BOUND: f64 = 1e-3;
/// Shares at which the effect of a number is examined.
const LOOKED_AT: [f64; 2] = [0.23, 0.71];
/// Smaller relative changes of speeds are no effect.
const IDLE: f64 = 1e-7;

impl Placement {
    /// Searches for the saw that is best in the worst case of its tolerances: it computes even samples of the
    /// bounds, refines the best of them by direct search (MADS), draws a map through the result, and refines the
    /// best saws on the basis that the tolerance of the scene requires.
    ///
    /// # Errors
    /// [`PlaceError`] if no free number has an effect, or no saw can be analysed.
    pub fn new(
        scene: &Scene,
        freed: &[Freed],
        demands: &Demands,
        options: &Options,
        progress: Progress<'_>,
    ) -> Result<Self, PlaceError> {
        let basis = ChosenBasis::new(scene, scene.tolerance().max(COARSE_TOLERANCE))?;
        let mut question = Question {
            goal: demands.goal,
            min_critical_rad_per_s: demands.min_critical_rad_per_s,
            gap: demands.gap,
            range: basis.range_rad_per_s,
            resolution: options.resolution.unwrap_or(basis.saw.plate.resolution),
            tolerances: options.tolerances,
        };
        let all = Search::new(scene.file(), freed, question.clone());
        let (freed, without_effect) = moving(scene, &all);
        if freed.is_empty() {
            return Err(PlaceError::NothingFree);
        }
        let own: Vec<f64> = freed.iter().map(|f| f.share_of(scene.file())).collect();
        let coarse = Search::new(scene.file(), &freed, question.clone());
        let (candidates, map) = look_everywhere(&coarse, &own, options, progress)?;
        if options.resolution.is_none() {
            question.resolution = basis_of_all(scene, &freed, &candidates, question.range)?;
        }
        let fine = Search::new(scene.file(), &freed, question.clone());
        let settled = settle(&fine, &candidates, options.refine / SETTLED, progress);
        let before = question.ask(scene)?;
        let own = exact_shares(scene, &freed)?;
        let before = Weighed::new(&fine, own, before);
        let chosen = Choice::between(&fine, scene, settled, &before)?;
        let fragile_optimum = fragile_optimum(&fine, &chosen.saw);
        Cancellation::current().check()?;
        Ok(Placement {
            parameters: parameters(scene, &freed, &chosen)?,
            scene: chosen.scene,
            improved: chosen.improved,
            without_effect,
            before: before.outcome,
            worst_before: before.neighbours.worst,
            best: chosen.saw.outcome,
            neighbours: chosen.saw.neighbours,
            fragile_optimum,
            map,
            range: question.range,
            is_undamped: basis.saw.plate.is_conservative(),
            resolution: question.resolution,
            tally: all.tally().and(coarse.tally()).and(fine.tally()),
        })
    }

    /// Goal of the best saw in the worst case of its tolerances.
    pub fn worst_rad_per_s(&self) -> f64 {
        value(&self.neighbours.worst)
    }

    /// Goal of the original scene in the worst case of its tolerances.
    pub fn worst_before_rad_per_s(&self) -> f64 {
        value(&self.worst_before)
    }

    /// Number of saws analysed.
    pub fn evaluations(&self) -> usize {
        self.tally.saws
    }
}

/// Goal of a saw, in rad/s; zero for a saw that could not be computed.
fn value(saw: &Neighbour) -> f64 {
    saw.outcome.as_ref().map_or(0.0, |o| o.value_rad_per_s)
}

/// Shares of the original numbers, which may lie outside the bounds.
fn exact_shares(scene: &Scene, freed: &[Freed]) -> Result<Vec<f64>, SceneError> {
    let shares = freed.iter();
    let shares = shares.map(|f| Ok(f.share(f.parameter.get(scene.file())?)));
    shares.collect()
}

/// The saw with the best nominal goal among those computed on the final basis, if it is better than the
/// answer and loses this advantage within its tolerances.
fn fragile_optimum(search: &Search<'_>, answer: &Weighed) -> Option<FragileOptimum> {
    let cheapest = search.cheapest()?;
    if cheapest.cost >= answer.outcome.cost() {
        return None;
    }
    let outcome = search.outcome(&cheapest.shares)?;
    let neighbours = Neighbours::new(search, &cheapest.shares, &outcome);
    let numbers = search.freed.iter().zip(&cheapest.shares);
    neighbours.are_fragile().then(|| FragileOptimum {
        worst: neighbours.worst,
        saw: Neighbour {
            values: numbers.map(|(freed, share)| freed.value(*share)).collect(),
            outcome: Some(outcome),
        },
    })
}

/// The free numbers with their best values.
fn parameters(
    scene: &Scene,
    freed: &[Freed],
    chosen: &Choice,
) -> Result<Vec<PlacedParameter>, SceneError> {
    let numbers = freed.iter().zip(&chosen.saw.shares).map(|(freed, share)| {
        Ok(PlacedParameter {
            freed: freed.clone(),
            start: freed.parameter.get(scene.file())?,
            value: freed.parameter.get(chosen.scene.file())?,
            at_bound: !(AT_BOUND..=1.0 - AT_BOUND).contains(share),
        })
    });
    numbers.collect()
}

/// Samples the bounds, refines the best samples and draws the map through the best saw; a better cell of the
/// map is refined too. Returns the candidates for the finer basis: the results of the refinements, the
/// original scene, the samples that are best within their tolerances, and the samples and cells that are best at
/// their nominal numbers, because the finer basis may move a jump past a saw, or away from it.
fn look_everywhere(
    search: &Search<'_>,
    own: &[f64],
    options: &Options,
    progress: Progress<'_>,
) -> Result<(Vec<Tried>, Option<Map>), PlaceError> {
    let samples = options.samples.max(1);
    let tried = search.sample(own, samples, &|done| progress("samples", done, samples));
    Cancellation::current().check()?;
    if tried.first().is_none_or(|best| best.cost >= REFUSED) {
        return Err(PlaceError::NoSaw { tried: samples });
    }
    let places = options.places.max(1);
    let starts = search.most_robust(&tried, places, APART);
    let (done, budget) = (AtomicUsize::new(0), options.refine as usize * starts.len());
    let see = || {
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        progress("refinement", done.min(budget), budget);
    };
    let refined = |start: &Tried| search.refine(start, COARSE_STEPS, options.refine, &see);
    let mut candidates: Vec<Tried> = starts.par_iter().map(refined).collect();
    let best = cheapest(&candidates).ok_or(PlaceError::NoSaw { tried: samples })?;
    let map = (options.map > 1).then(|| Map::through(search, &best.shares, options.map, progress));
    let cells = map.as_ref().map_or(Vec::new(), Map::cells);
    let of_map = search.most_robust(&cells, 1, 0.0).pop();
    let better = of_map.filter(|cell| cell.cost < best.cost);
    candidates.extend(better.map(|cell| refined(&cell)));
    candidates.extend(starts);
    candidates.extend(search.cheapest());
    candidates.extend(tried.iter().find(|one| one.shares == own).cloned());
    candidates.extend(tried.into_iter().take(MOST_PROMISING));
    candidates.extend(cells.into_iter().take(MOST_PROMISING));
    candidates.retain(|one| one.cost < REFUSED);
    candidates.sort_by(|x, y| x.cost.total_cmp(&y.cost));
    candidates.dedup_by(|x, y| x.shares == y.shares);
    Ok((candidates, map))
}

fn cheapest(tried: &[Tried]) -> Option<Tried> {
    let cheapest = tried.iter().min_by(|x, y| x.cost.total_cmp(&y.cost));
    cheapest.cloned()
}

/// Divides the free numbers into those that move a critical speed or a band, and the others.
fn moving(scene: &Scene, search: &Search<'_>) -> (Vec<Freed>, Vec<Freed>) {
    let speeds = |shares: &[f64]| {
        let of = |outcome: Outcome| {
            let first = outcome.bands.first();
            [
                outcome.value_rad_per_s,
                outcome.deflection_m.unwrap_or(0.0),
                outcome.critical_rad_per_s.unwrap_or(0.0),
                first.map_or(0.0, |band| band.from_rad_per_s),
            ]
        };
        Ok::<_, Infallible>(search.outcome(shares).map(of))
    };
    let differ = |x: &[f64; 4], y: &[f64; 4]| {
        let mut pairs = x.iter().zip(y);
        pairs.any(|(x, y)| (x - y).abs() > IDLE * x.abs().max(y.abs()))
    };
    let Ok(parted) = effective(scene, search.freed, &LOOKED_AT, speeds, differ);
    parted
}
