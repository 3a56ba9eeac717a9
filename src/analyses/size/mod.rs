//! The inverse question: with which values of a number does the saw keep its limits?
//!
//! [`size`](size()) judges saws between two bounds by their critical speeds and bands, closes in on every value at which a limit begins or
//! ceases to be kept, and checks a rounded value inside the nearest range at the accuracy of the scene. The limits are those of
//! [`check`](crate::analyses::check) at the operating speed of the scene. Ranges narrower than the distance of two saws can be missed.

pub(crate) mod chart;
mod each;
mod edge;
mod error;
mod options;
mod outline;
mod report;
mod rounding;
mod saw;

pub use error::SizeError;
pub use options::Options;
pub(crate) use outline::{headline, outline};
pub use report::{SizeAnswer, SizeReport, SizedEach, SizedFor, SizedLimit, SizedWindow};

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use crate::analyses::check::{CheckReport, Searched};
use crate::analyses::door::{Progress, Step};
use crate::analyses::scene_number;
use crate::analyses::verdict::Answer;
use crate::model::scene::{Freed, Quantity, Scene};

use edge::{Bracket, closed_in};
use rounding::rounded_inside;
use saw::{Judged, Question, SizedSaw};

/// Tolerance with which ranges are searched, before their ends are found with that of the scene.
const SEARCHED: f64 = 1e-2;
/// The number is made larger by this share for the changes beside the answer.
const PERCENT: f64 = 1e-2;
/// Number of steps towards the inside of a range in which a value is found that keeps all limits.
const INWARD: usize = 4;

/// Finds the ranges of a number in which a saw keeps its limits, and checks the saw with a value inside the nearest one. Several freed
/// numbers have the same value.
///
/// # Errors
/// [`SizeError`] if the scene has no operating speed, or the computation was cancelled.
pub fn size(
    scene: &Scene,
    freed: &[Freed],
    points: usize,
    progress: Progress<'_>,
) -> Result<SizeReport, SizeError> {
    let mut found = ranges(scene, freed, points, progress)?;
    let exact = Question {
        scene,
        freed,
        tolerance: None,
        swept: None,
    };
    if let Some((answer, checked)) = answer(&exact, &found.windows, found.of_scene)? {
        found.answer = Some(answer);
        found.warnings.splice(..0, checked.warnings);
    }
    Ok(found)
}

/// The ranges of a number in which a saw keeps its limits, without an answer.
///
/// # Errors
/// The errors of [`size`](size()).
fn ranges(
    scene: &Scene,
    freed: &[Freed],
    points: usize,
    progress: Progress<'_>,
) -> Result<SizeReport, SizeError> {
    let first = &freed[0];
    let path = first.parameter.path();
    let is_speed = path == "operating_rpm";
    let operating_rpm = if is_speed {
        None
    } else {
        Some(scene.needed_operating_rpm(None)?)
    };
    let of_scene = first.parameter.get(scene.file()).unwrap_or(first.from);
    let tolerance = scene.tolerance().max(SEARCHED);
    let exact = Question {
        scene,
        freed,
        tolerance: None,
        swept: None,
    };
    let quick = Question {
        tolerance: (tolerance > scene.tolerance()).then_some(tolerance),
        ..exact
    };
    let to = first.to.max(of_scene);
    let is_swept = is_speed && Searched::suffices(scene);
    let swept = |question: &Question<'_>| is_swept.then(|| question.swept_to(to)).transpose();
    let [of_exact, of_quick] = [swept(&exact)?, swept(&quick)?];
    let exact = Question {
        swept: of_exact.as_ref(),
        ..exact
    };
    let quick = Question {
        swept: of_quick.as_ref(),
        ..quick
    };
    let values = values(first, of_scene, points);
    let count = values.len();
    let done = AtomicUsize::new(0);
    let saws = values
        .par_iter()
        .map(|value| {
            let saw = quick.ask(*value);
            let done = 1 + done.fetch_add(1, Ordering::Relaxed);
            progress(Step::new("saws", done, count));
            saw
        })
        .collect::<Result<Vec<SizedSaw>, SizeError>>()?;
    let asked = AtomicUsize::new(count);
    let ends = edges(&saws);
    let closed = AtomicUsize::new(0);
    let found = ends
        .par_iter()
        .map(|bracket| {
            let found = closed_in(&quick, &exact, bracket, &asked);
            let closed = 1 + closed.fetch_add(1, Ordering::Relaxed);
            progress(Step::new("ends of ranges", closed, ends.len()));
            found
        })
        .collect::<Result<Vec<_>, SizeError>>()?;
    let windows = windows(&saws, &found);
    let mut warnings = Vec::new();
    let refused = saws.iter().filter_map(|saw| saw.found.as_ref().err());
    if let Some(reason) = refused.clone().next() {
        let count = refused.count();
        warnings.push(format!(
            "{count} of {} saws were refused: {reason}",
            saws.len()
        ));
    }
    Ok(SizeReport {
        sawflutter: env!("CARGO_PKG_VERSION").to_owned(),
        scene: scene.file().clone(),
        condition: scene.condition(),
        unusual_numbers: scene.file().unusual_numbers(),
        paths: freed
            .iter()
            .map(|freed| freed.parameter.path().to_owned())
            .collect(),
        name: scene_number::name(path),
        unit: Quantity::of(path).map_or("", |of| of.unit).to_owned(),
        of_scene,
        from: first.from,
        to: first.to,
        operating_rpm,
        answers: saws.iter().map(SizedSaw::answer).collect(),
        limits: limits(&saws),
        values,
        windows,
        answer: None,
        each: None,
        searched_tolerance: tolerance,
        saws: asked.into_inner(),
        warnings,
    })
}

/// Values between the bounds, and that of the scene if it is between them.
fn values(freed: &Freed, of_scene: f64, points: usize) -> Vec<f64> {
    let mut values = freed.values(points);
    if freed.from < of_scene && of_scene < freed.to && !values.contains(&of_scene) {
        values.push(of_scene);
        values.sort_by(f64::total_cmp);
    }
    values
}

/// Neighbours of which one keeps all limits and the other does not.
fn edges(saws: &[SizedSaw]) -> Vec<Bracket> {
    let pairs = saws.windows(2);
    pairs
        .filter_map(|pair| Bracket::between(pair[0].clone(), pair[1].clone()))
        .collect()
}

/// The ranges between the edges, which ascend.
fn windows(saws: &[SizedSaw], edges: &[Bracket]) -> Vec<SizedWindow> {
    let (Some(first), Some(last)) = (saws.first(), saws.last()) else {
        return Vec::new();
    };
    let mut windows = Vec::new();
    let mut begun = first.is_kept().then_some((first.value, None));
    for edge in edges {
        let broken = edge.broken.broken();
        match begun.take() {
            None => begun = Some((edge.kept.value, broken)),
            Some((from, below)) => windows.push(SizedWindow {
                from,
                to: edge.kept.value,
                below,
                above: broken,
            }),
        }
    }
    windows.extend(begun.map(|(from, below)| SizedWindow {
        from,
        to: last.value,
        below,
        above: None,
    }));
    windows
}

/// Every limit of any of the saws with its margins.
fn limits(saws: &[SizedSaw]) -> Vec<SizedLimit> {
    let mut limits: Vec<SizedLimit> = Vec::new();
    let judged = || saws.iter().map(|saw| saw.found.as_ref().ok());
    for criterion in judged().flatten().flat_map(|judged| &judged.verdict.limits) {
        if limits.iter().all(|limit| limit.key != criterion.key) {
            let of = |judged: &Judged| {
                let mut criteria = judged.verdict.limits.iter();
                let own = criteria.find(|own| own.key == criterion.key)?;
                judged.margin(own)
            };
            limits.push(SizedLimit {
                key: criterion.key.clone(),
                name: criterion.name.clone(),
                margins: judged().map(|judged| judged.and_then(of)).collect(),
            });
        }
    }
    limits
}

/// The value of the scene if it keeps all limits, otherwise a rounded one in the nearest range, with its check.
fn answer(
    question: &Question<'_>,
    windows: &[SizedWindow],
    of_scene: f64,
) -> Result<Option<(SizeAnswer, CheckReport)>, SizeError> {
    let distance = |window: &&SizedWindow| (window.from - of_scene).max(of_scene - window.to);
    let nearest = windows
        .iter()
        .min_by(|x, y| distance(x).total_cmp(&distance(y)));
    let Some(window) = nearest else {
        return Ok(None);
    };
    let path = question.freed[0].parameter.path();
    for inward in 0..INWARD {
        let value = if (window.from..=window.to).contains(&of_scene) && inward == 0 {
            of_scene
        } else {
            rounded_inside(path, window, of_scene, inward)
        };
        let Some(report) = question.check(value, true)? else {
            continue;
        };
        if report.verdict.answer != Some(Answer::Yes) {
            continue;
        }
        let Ok(scene) = question.scene_at(value) else {
            continue;
        };
        let more = question.check((1.0 + PERCENT) * value, false)?;
        let critical = |report: &CheckReport| {
            let mut criteria = report.verdict.limits.iter();
            criteria.find(|of| of.key == "margin")?.found_rpm
        };
        let deflection =
            |report: &CheckReport| report.deviation.as_ref().and_then(|of| of.deflection_m);
        let change =
            |of: &dyn Fn(&CheckReport) -> Option<f64>| Some(of(more.as_ref()?)? - of(&report)?);
        let found = SizeAnswer {
            value,
            is_of_scene: value == of_scene,
            scene: scene.file().clone(),
            verdict: report.verdict.clone(),
            first_critical_rpm: critical(&report),
            deflection_m: deflection(&report),
            critical_rpm_per_percent: change(&critical),
            deflection_m_per_percent: change(&deflection),
        };
        return Ok(Some((found, report)));
    }
    Ok(None)
}
