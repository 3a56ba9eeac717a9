//! Numbers of a scene that a command may move: `--free guides[0].radius_m=0.15..0.3`.

use crate::scene::NamedBounds;
use anyhow::bail;

/// The paths asked for, with their bounds where they are given.
pub fn named_bounds(asked: &[String]) -> anyhow::Result<Vec<NamedBounds>> {
    asked.iter().map(|text| parse(text)).collect()
}

fn parse(text: &str) -> anyhow::Result<NamedBounds> {
    let Some((path, range)) = text.split_once('=') else {
        return Ok((text.trim().to_owned(), None));
    };
    let bounds = range
        .split_once("..")
        .map(|(from, to)| (from.trim().parse(), to.trim().parse()));
    let Some((Ok(from), Ok(to))) = bounds else {
        bail!(
            "the range of --free {text} is {range:?}, but must be two numbers; write it like 0.15..0.3"
        );
    };
    Ok((path.trim().to_owned(), Some((from, to))))
}
