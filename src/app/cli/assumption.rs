//! Options of the commands `cut` and `runup` for numbers of these blocks, and the numbers that are assumed beside them.

use anyhow::Context;

use super::common::of_option;
use super::shorthand::Given;
use crate::model::scene::{AssumedBlock, Scene, Setting, number_of};

/// The scene with the numbers of options. If it lacks the block, typical numbers are assumed for the rest, and printed on
/// the error stream.
pub fn with_options(
    block: AssumedBlock,
    scene: Scene,
    options: &[Given<'_>],
) -> anyhow::Result<Scene> {
    let given = || options.iter().filter(|given| given.text.is_some());
    if given().next().is_none() {
        return Ok(scene);
    }
    let settings = given()
        .map(|given| Ok(Setting::new(given.path.to_owned(), number(given)?)))
        .collect::<anyhow::Result<Vec<_>>>()?;
    let names = given()
        .map(|given| format!("--{}", given.option))
        .collect::<Vec<_>>()
        .join(", ");
    let verb = if given().count() > 1 { "were" } else { "was" };
    let found = block
        .completed(&scene, &settings)
        .with_context(|| format!("{names} {verb} refused"))?;
    if !found.assumed.is_empty() {
        eprintln!(
            "The scene has no {}; assumed beside {names}: {}. These are typical values, whose sources `sawflutter schema` states.",
            block.key(),
            found.in_words()
        );
    }
    Ok(found.scene)
}

/// Parses the number of an option, in the unit of its key.
fn number(given: &Given) -> anyhow::Result<f64> {
    let text = given.text.map_or("", String::as_str);
    number_of(given.path, text).map_err(|mut refused| {
        refused.key = given.option.into();
        of_option(refused)
    })
}
