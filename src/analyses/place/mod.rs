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
//! use sawflutter::analyses::place::{Demands, Options, place};
//! use sawflutter::model::plate::Resolution;
//! use sawflutter::model::scene::{Freed, Scene};
//!
//! let scene = Scene::paper();
//! let radius = Freed::new(scene.file(), "guides[0].radius_m", 0.18, 0.28)?;
//! let resolution = Some(Resolution { max_diameters: 7, radial_functions: 3 });
//! let options = Options { resolution, samples: 4, places: 1, refine: 6, map: 0, ..Options::default() };
//! let found = place(&scene, &[radius], &Demands::default(), &options, &|_| ())?;
//! println!("{:.0} rpm", found.best.goal_rpm);
//! assert!(found.kept);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod across;
pub(crate) mod chart;
mod choice;
mod demands;
mod deviation;
mod error;
mod front;
mod map;
mod memory;
mod neighbours;
mod outcome;
mod outline;
mod report;
mod request;
mod search;
mod worst_case;

pub(crate) use outline::outline;
use std::convert::Infallible;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;
use serde_json::{Value, json};

use crate::analyses::campbell::{InstabilityBand, statement};
use crate::analyses::door::Progress;
use crate::model::scene::{Freed, Parted, Scene, SceneError, effective, rpm};
use crate::modes::Cancellation;
use crate::stability::{Analysis, ChosenBasis};

use choice::{Choice, Weighed, basis_of_all, settle};
pub use demands::{Demands, GapDemands, Options, Tolerances};
pub use error::PlaceError;
use memory::Memory;
use neighbours::Neighbours;
use outcome::{Computed, IDLE, Question, REFUSED};
pub use report::{
    FragileOptimum, FrontSaw, Goal, GoalMap, Neighbour, Outcome, PlaceCertificate, PlaceReport,
    PlacedParameter,
};
pub use request::{GoalName, Request};
use search::{Search, Tried, cheapest};

/// Tolerance that determines the basis of the coarse search. The best saws are compared and refined with the
/// tolerance of the scene.
const COARSE_TOLERANCE: f64 = 5e-2;
/// Smallest distance between samples that are refined, as a share of the bounds.
const APART: f64 = 0.08;
/// First and last step of a refinement, as shares of the bounds.
const COARSE_STEPS: [f64; 2] = [0.08, 5e-3];
/// Factor by which the refinement on the fine basis has fewer steps: it moves an optimum only a little, and each
/// saw takes ten times as long.
const SETTLED: u64 = 3;
/// Number of samples, best at their nominal numbers, that are compared on the finer basis too.
const MOST_PROMISING: usize = 3;
/// A share nearer to a bound than this is taken for the bound.
const AT_BOUND: f64 = 1e-3;
/// Shares at which the effect of a number is examined.
const LOOKED_AT: [f64; 2] = [0.23, 0.71];
/// Searches for the saw that is best in the worst case of its tolerances: it computes even samples of the
/// bounds, refines the best of them by direct search (MADS), refines the best saws on the basis that the tolerance of the scene
/// requires, and draws a map through the result on the same basis.
///
/// # Errors
/// [`PlaceError`] if no free number has an effect, or no saw can be analysed.
pub fn place(
    scene: &Scene,
    freed: &[Freed],
    demands: &Demands,
    options: &Options,
    progress: Progress<'_>,
) -> Result<PlaceReport, PlaceError> {
    let basis = ChosenBasis::new(scene, scene.tolerance().max(COARSE_TOLERANCE))?;
    let mut question = Question {
        demands: *demands,
        range: basis.range_rad_per_s,
        resolution: options.resolution.unwrap_or(basis.saw.plate.resolution),
        tolerances: options.tolerances,
    };
    let memory = match &options.folder {
        None => Memory::none(),
        Some(folder) => Memory::of(folder, &inputs(scene, freed, demands))?,
    };
    let all = Search::new(scene.file(), freed, question.clone(), &memory);
    let Parted {
        moving: freed,
        idle: without_effect,
    } = parted(scene, &all);
    // The saws of a cancelled search do not differ.
    Cancellation::current().check()?;
    if freed.is_empty() {
        return Err(PlaceError::NothingFree);
    }
    let typed: Vec<f64> = freed.iter().map(|f| f.share_of(scene.file())).collect();
    let coarse = Search::new(scene.file(), &freed, question.clone(), &memory);
    let Looked { candidates, traded } = look_everywhere(&coarse, &typed, options, progress)?;
    if options.resolution.is_none() {
        question.resolution = basis_of_all(scene, &freed, &candidates, question.range)?;
    }
    let fine = Search::new(scene.file(), &freed, question.clone(), &memory);
    let all_candidates = [&candidates[..], &traded].concat();
    let settled = settle(&fine, &all_candidates, options.refine / SETTLED, progress);
    let answer = question.ask(scene)?;
    let own = exact_shares(scene, &freed)?;
    let before = Weighed::new(&fine, own, answer);
    let Choice {
        scene: placed,
        saw: best,
        improved,
    } = Choice::between(&fine, scene, settled, &before)?;
    let fragile_optimum = fragile_optimum(&fine, &best);
    let front = front::front(&fine, &traded, &best, question.resolution);
    let across_rpm = across::goals_rpm(&fine, &best.shares);
    let map =
        (options.map > 1).then(|| map::through(&fine, &best.shares, options.map, progress).map);
    Cancellation::current().check()?;
    let tally = all.tally().and(coarse.tally()).and(fine.tally());
    let threshold_per_s = placed.flutter_threshold_per_s();
    let listed = |band| InstabilityBand::new(band, threshold_per_s);
    let certificate = &best.computed.certificate;
    let verdict = |scene: &Scene| Analysis::new(scene).map(|analysis| analysis.report().verdict);
    let judged = verdict(&placed);
    let mut report = PlaceReport {
        sawflutter: env!("CARGO_PKG_VERSION").to_owned(),
        scene: placed.file().clone(),
        condition: placed.condition(),
        unusual_numbers: placed.file().unusual_numbers(),
        verdict: judged.as_ref().ok().cloned(),
        verdict_before: verdict(scene).ok(),
        goal: demands.goal(),
        min_critical_rpm: demands.min_critical_rad_per_s.map(rpm),
        amplitude_m: demands.gap.and_then(|gap| gap.case.amplitude_m()),
        max_deflection_m: demands.gap.and_then(|gap| gap.max_deflection_m),
        force_n: demands
            .gap
            .and_then(|gap| gap.max_deflection_m)
            .or(front.first().map(|saw| saw.deflection_m))
            .map(|_| scene.constant_force().force_n),
        kept: best.neighbours.keep_limit(),
        improved,
        from_rpm: rpm(question.range.from_rad_per_s),
        to_rpm: rpm(question.range.to_rad_per_s),
        flutter_threshold_per_s: threshold_per_s,
        parameters: parameters(scene, &placed, &freed, &best, &across_rpm)?,
        without_effect: without_effect.iter().map(path).collect(),
        before: before.computed.outcome,
        worst_before: before.neighbours.worst,
        best: best.computed.outcome,
        bands: best.computed.bands.iter().map(listed).collect(),
        certificate: PlaceCertificate {
            statement: statement(certificate, basis.saw.plate.is_conservative(), None),
            is_clean: certificate.is_clean(),
            speeds_checked: certificate.speeds_checked,
            full_basis_counts: certificate.full_basis_counts,
        },
        fragile: best.neighbours.are_fragile(),
        worst_neighbour_share: best.neighbours.worst_share,
        almost: best.neighbours.almost.iter().map(listed).collect(),
        worst_neighbour: Some(best.neighbours.worst),
        fragile_optimum,
        front,
        map,
        saws: tally.saws,
        failed_saws: tally.failed,
        max_diameters: question.resolution.max_diameters,
        radial_functions: question.resolution.radial_functions_on(placed.blade()),
        warnings: Vec::new(),
    };
    report.warnings = report.remarks(tally.why.as_deref());
    if let Err(error) = judged {
        let word = format!("the best saw could not be judged: {error}");
        report.warnings.push(word);
    }
    Ok(report)
}

/// What a log of saws belongs to.
fn inputs(scene: &Scene, freed: &[Freed], demands: &Demands) -> Value {
    let bounds = freed.iter().map(|of| (path(of), of.from, of.to));
    json!({
        "sawflutter": env!("CARGO_PKG_VERSION"),
        "scene": scene.file(),
        "free": bounds.collect::<Vec<_>>(),
        "demands": format!("{demands:?}"),
    })
}

fn path(freed: &Freed) -> String {
    freed.parameter.path().to_owned()
}

/// Shares of the original numbers, which may lie outside the bounds.
fn exact_shares(scene: &Scene, freed: &[Freed]) -> Result<Vec<f64>, SceneError> {
    let shares = freed
        .iter()
        .map(|f| Ok(f.share(f.parameter.get(scene.file())?)));
    shares.collect()
}

/// The saw with the best nominal goal among those computed on the final basis, if it is better than the
/// answer and loses this advantage within its tolerances.
fn fragile_optimum(search: &Search<'_>, answer: &Weighed) -> Option<FragileOptimum> {
    let cheapest = search.cheapest()?;
    if cheapest.cost >= answer.computed.cost() {
        return None;
    }
    let computed = search.computed(&cheapest.shares)?;
    let neighbours = Neighbours::new(search, &cheapest.shares, &computed);
    neighbours.are_fragile().then(|| FragileOptimum {
        worst: neighbours.worst,
        saw: Neighbour {
            values: search.values(&cheapest.shares),
            outcome: Some(computed.outcome),
        },
    })
}

/// The free numbers with their best values.
fn parameters(
    scene: &Scene,
    placed: &Scene,
    freed: &[Freed],
    best: &Weighed,
    across_rpm: &[Option<[f64; 2]>],
) -> Result<Vec<PlacedParameter>, SceneError> {
    let numbers = freed.iter().enumerate().map(|(k, freed)| {
        let [less_rpm, more_rpm] = best.neighbours.along_rpm[k];
        Ok(PlacedParameter {
            path: path(freed),
            start: freed.parameter.get(scene.file())?,
            value: freed.parameter.get(placed.file())?,
            bound_from: freed.from,
            bound_to: freed.to,
            at_bound: !(AT_BOUND..=1.0 - AT_BOUND).contains(&best.shares[k]),
            across_rpm: across_rpm[k],
            offset: best.neighbours.offsets[k],
            less_rpm,
            more_rpm,
        })
    });
    numbers.collect()
}

/// Result of the search on the coarse basis.
struct Looked {
    /// Candidates for the finer basis: the results of the refinements, the original scene, the samples that are best
    /// within their tolerances, and the samples that are best at their nominal numbers, because the finer basis may move a jump
    /// past a saw, or away from it.
    candidates: Vec<Tried>,
    /// Saws that deflect less at the cut than the best one.
    traded: Vec<Tried>,
}

/// Samples the bounds and refines the best samples.
fn look_everywhere(
    search: &Search<'_>,
    own: &[f64],
    options: &Options,
    progress: Progress<'_>,
) -> Result<Looked, PlaceError> {
    let samples = options.samples.max(1);
    let tried = search.sample(own, samples, &|done| {
        progress(search.step("samples", done, samples));
    });
    Cancellation::current().check()?;
    if tried.first().is_none_or(|best| best.cost >= REFUSED) {
        return Err(PlaceError::NoSaw { tried: samples });
    }
    let places = options.places.max(1);
    let starts = search.most_robust(&tried, places, APART);
    let (done, budget) = (AtomicUsize::new(0), options.refine as usize * starts.len());
    let see = || {
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        progress(search.step("refinement", done.min(budget), budget));
    };
    let refined = |start: &Tried| search.refine(start, COARSE_STEPS, options.refine, &see);
    let mut candidates: Vec<Tried> = starts.par_iter().map(refined).collect();
    let best = cheapest(&candidates).ok_or(PlaceError::NoSaw { tried: samples })?;
    // The cells of a map, which is drawn on the final basis later, are starts too.
    let cells = if options.map > 1 {
        map::through(search, &best.shares, options.map, progress).cells
    } else {
        Vec::new()
    };
    let of_map = search.most_robust(&cells, 1, 0.0).pop();
    let better = of_map.filter(|cell| cell.cost < best.cost);
    candidates.extend(better.map(|cell| refined(&cell)));
    let traded = front::within_limits(search, &best);
    candidates.extend(starts);
    candidates.extend(search.cheapest());
    candidates.extend(tried.iter().find(|one| one.shares == own).cloned());
    candidates.extend(tried.into_iter().take(MOST_PROMISING));
    candidates.extend(cells.into_iter().take(MOST_PROMISING));
    candidates.retain(|one| one.cost < REFUSED);
    candidates.sort_by(|x, y| x.cost.total_cmp(&y.cost));
    candidates.dedup_by(|x, y| x.shares == y.shares);
    Ok(Looked { candidates, traded })
}

/// Divides the free numbers into those that move a critical speed or a band, and the others.
fn parted(scene: &Scene, search: &Search<'_>) -> Parted {
    let speeds = |shares: &[f64]| {
        let of = |saw: Computed| {
            let first = saw.bands.first();
            [
                saw.value_rad_per_s,
                saw.outcome.deflection_m.unwrap_or(0.0),
                saw.outcome.first_critical_rpm.unwrap_or(0.0),
                first.map_or(0.0, |band| band.from_rad_per_s),
            ]
        };
        Ok::<_, Infallible>(search.computed(shares).map(of))
    };
    let differ = |x: &[f64; 4], y: &[f64; 4]| {
        let mut pairs = x.iter().zip(y);
        pairs.any(|(x, y)| (x - y).abs() > IDLE * x.abs().max(y.abs()))
    };
    let Ok(parted) = effective(scene, search.freed, &LOOKED_AT, speeds, differ);
    parted
}
