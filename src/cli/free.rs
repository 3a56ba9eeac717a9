//! Numbers of a scene that a command may move: `--free guides[0].radius_m=0.15..0.3`.

use crate::scene::{Freed, Scene};
use anyhow::{Context, bail};

/// More numbers than these at once are beyond what a search can tell.
const MAX_FREED: usize = 12;

/// The numbers asked for; without any, those of `usual` that the scene has.
pub fn freed(scene: &Scene, asked: &[String], usual: &[String]) -> anyhow::Result<Vec<Freed>> {
    let texts = if asked.is_empty() { usual } else { asked };
    let mut freed: Vec<Freed> = Vec::new();
    for text in texts {
        let one = parse(scene, text).with_context(|| format!("--free {text} was refused"))?;
        if freed.iter().any(|other| other.parameter == one.parameter) {
            bail!("--free names {} twice; name it once", one.parameter.path());
        }
        freed.push(one);
    }
    if freed.len() > MAX_FREED {
        bail!(
            "{} numbers are free, but at most {MAX_FREED} may be; name those that matter with --free",
            freed.len()
        );
    }
    Ok(freed)
}

fn parse(scene: &Scene, text: &str) -> anyhow::Result<Freed> {
    let Some((path, range)) = text.split_once('=') else {
        return Ok(Freed::with_usual_bounds(scene, text.trim())?);
    };
    let bounds = range
        .split_once("..")
        .map(|(from, to)| (from.trim().parse(), to.trim().parse()));
    let Some((Ok(from), Ok(to))) = bounds else {
        bail!("the range is {range:?}, but must be two numbers; write it like 0.15..0.3");
    };
    Ok(Freed::new(scene.file(), path.trim(), from, to)?)
}

/// A number of a range, its ends included.
pub fn number(name: &str, value: f64, (low, high): (f64, f64)) -> anyhow::Result<f64> {
    if (low..=high).contains(&value) {
        return Ok(value);
    }
    bail!("{name} is {value}, but must be between {low} and {high:e}; give a number in that range")
}
