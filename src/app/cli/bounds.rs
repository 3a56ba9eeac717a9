//! Numbers of a scene with bounds: `--free guides[0].radius_m=0.15..0.3`.

use crate::model::scene::{NamedBounds, number_of};
use anyhow::{Context, bail};

/// Parses the options `--free`, paths with or without bounds.
pub fn named_bounds(asked: &[String]) -> anyhow::Result<Vec<NamedBounds>> {
    asked.iter().map(|text| range("--free", text)).collect()
}

/// Parses the path of an option and, if there is one, its range.
pub fn range(option: &str, text: &str) -> anyhow::Result<NamedBounds> {
    let Some((name, range)) = text.split_once('=') else {
        return Ok((text.trim().to_owned(), None));
    };
    let Some((from, to)) = range.split_once("..") else {
        bail!(
            "the range of {option} {text} must be two numbers (you gave {range:?}); write it like 0.15..0.3"
        );
    };
    let path = name.trim();
    let bound =
        |bound| number_of(path, bound).with_context(|| format!("{option} {text} was refused"));
    Ok((path.to_owned(), Some((bound(from)?, bound(to)?))))
}
