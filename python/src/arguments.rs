//! Arguments of methods, checked: the messages name them as Python does.

use std::collections::HashSet;

use sawflutter::check::Limits;
use sawflutter::fit;
use sawflutter::place::{Demands, Goal, Options};
use sawflutter::scene::{Freed, Scene, rad_per_s};

use crate::failure::Failure;

/// Faster than any saw, and far from overflow.
const MAX_RPM: f64 = 1e9;
/// More numbers than these at once are beyond what a search can tell.
const MAX_FREED: usize = 12;
const MAX_STARTS: usize = 1000;
const MAX_SAMPLES: usize = 100_000;
const MAX_MAP: usize = 400;

/// A path of the scene, and its bounds if they are not the usual ones.
pub type Bounds = (String, Option<(f64, f64)>);

/// The scene of a JSON text.
pub fn scene(text: &str) -> Result<Scene, Failure> {
    Ok(Scene::from_json(text)?)
}

/// A speed in rad/s.
pub fn speed(name: &str, rpm: f64) -> Result<f64, Failure> {
    if rpm > 0.0 && rpm <= MAX_RPM {
        return Ok(rad_per_s(rpm));
    }
    let allowed = format!("above 0 and at most {MAX_RPM:e}");
    let remedy = "give it in revolutions per minute";
    Err(Failure::argument(name, rpm, allowed, remedy))
}

fn some_speed(name: &str, rpm: Option<f64>) -> Result<Option<f64>, Failure> {
    rpm.map(|rpm| speed(name, rpm)).transpose()
}

/// A count between two others.
fn count(
    name: &str,
    value: usize,
    (least, most): (usize, usize),
    remedy: &str,
) -> Result<usize, Failure> {
    if (least..=most).contains(&value) {
        return Ok(value);
    }
    let allowed = format!("from {least} to {most}");
    Err(Failure::argument(name, value, allowed, remedy))
}

/// The limits of a check.
pub fn limits(
    scene: &Scene,
    operating_rpm: Option<f64>,
    margin: f64,
    min_flutter_rpm: Option<f64>,
    min_critical_rpm: Option<f64>,
    max_rim_m_per_s: f64,
) -> Result<Limits, Failure> {
    let operating = some_speed("operating_rpm", operating_rpm)?.or(scene.operating_rad_per_s());
    let operating = operating.ok_or_else(|| {
        let allowed = "the speed at which the saw is run".to_owned();
        let remedy = "give it, or operating_rpm in the scene";
        Failure::argument("operating_rpm", "missing", allowed, remedy)
    })?;
    if !(margin > 0.0 && margin <= 1.0) {
        let allowed = "above 0 and at most 1".to_owned();
        let remedy = "the usual rule is 0.85";
        return Err(Failure::argument("margin", margin, allowed, remedy));
    }
    if !(max_rim_m_per_s > 0.0 && max_rim_m_per_s <= 1e4) {
        let allowed = "above 0 and at most 10000".to_owned();
        let remedy = "saws for wood are run with at most 100";
        let name = "max_rim_m_per_s";
        return Err(Failure::argument(name, max_rim_m_per_s, allowed, remedy));
    }
    Ok(Limits {
        max_rim_m_per_s,
        margin,
        min_flutter_rad_per_s: some_speed("min_flutter_rpm", min_flutter_rpm)?,
        min_critical_rad_per_s: some_speed("min_critical_rpm", min_critical_rpm)?,
        ..Limits::at(operating)
    })
}

/// The numbers that may move; without any, the `usual` ones.
pub fn freed(scene: &Scene, asked: Vec<Bounds>, usual: Vec<String>) -> Result<Vec<Freed>, Failure> {
    let asked = match asked.is_empty() {
        true => usual.into_iter().map(|path| (path, None)).collect(),
        false => asked,
    };
    let remedy = "name those that matter";
    count(
        "the number of free paths",
        asked.len(),
        (1, MAX_FREED),
        remedy,
    )?;
    let mut seen = HashSet::new();
    let mut freed = Vec::new();
    for (path, bounds) in asked {
        let one = match bounds {
            Some((from, to)) => Freed::new(scene.file(), &path, from, to)?,
            None => Freed::with_usual_bounds(scene, &path)?,
        };
        if !seen.insert(path.clone()) {
            let allowed = "named once".to_owned();
            return Err(Failure::argument("free", path, allowed, "name it once"));
        }
        freed.push(one);
    }
    Ok(freed)
}

/// How to fit.
pub fn fit_options(confidence: f64, starts: usize, seed: u64) -> Result<fit::Options, Failure> {
    if !(confidence > 0.0 && confidence < 1.0) {
        let allowed = "between 0 and 1".to_owned();
        return Err(Failure::argument(
            "confidence",
            confidence,
            allowed,
            "0.95 is usual",
        ));
    }
    Ok(fit::Options {
        confidence,
        starts: count("starts", starts, (1, MAX_STARTS), "a dozen is usual")?,
        seed,
        ..fit::Options::default()
    })
}

/// What a place is looked for by.
pub fn demands(
    scene: &Scene,
    goal: &str,
    min_critical_rpm: Option<f64>,
) -> Result<Demands, Failure> {
    let goal = match (goal, scene.operating_rad_per_s()) {
        ("flutter", _) => Goal::FlutterSpeed,
        ("window", Some(around_rad_per_s)) => Goal::StableWindow { around_rad_per_s },
        ("window", None) => {
            let allowed = "the speed at which the saw is run".to_owned();
            let remedy = "write it into the scene";
            return Err(Failure::argument(
                "operating_rpm",
                "missing",
                allowed,
                remedy,
            ));
        }
        _ => {
            let allowed = "\"flutter\" or \"window\"".to_owned();
            let remedy = "name one of them";
            return Err(Failure::argument(
                "goal",
                format!("{goal:?}"),
                allowed,
                remedy,
            ));
        }
    };
    Ok(Demands {
        goal,
        min_critical_rad_per_s: some_speed("min_critical_rpm", min_critical_rpm)?,
    })
}

/// How hard to look for a place.
pub fn place_options(samples: usize, refine: u64, map: usize) -> Result<Options, Failure> {
    if map != 0 {
        count("map", map, (2, MAX_MAP), "17 is usual, 0 draws none")?;
    }
    Ok(Options {
        samples: count("samples", samples, (1, MAX_SAMPLES), "a hundred is usual")?,
        refine: refine.max(1),
        map,
        ..Options::default()
    })
}
