//! Saws beside similar ones, whose basis is kept between calls.

use std::sync::{Arc, Mutex};

use sawflutter::analyses::study::Study;
use sawflutter::model::scene::Scene;
use sawflutter::stability::ChosenBasis;

use crate::arguments;
use crate::failure::Failure;
use crate::watch::lock;

/// The last saw beside which others were analysed, with its basis.
static BESIDE: Mutex<Option<(String, Arc<Study>)>> = Mutex::new(None);

/// The study of a saw beside which others are analysed, which keeps its basis.
pub fn study_of(text: &str) -> Result<Arc<Study>, Failure> {
    let known = lock(&BESIDE)
        .as_ref()
        .filter(|known| known.0 == text)
        .map(|known| known.1.clone());
    if let Some(study) = known {
        return Ok(study);
    }
    let study = Arc::new(Study::of_one(arguments::scene(text)?)?);
    *lock(&BESIDE) = Some((text.to_owned(), study.clone()));
    Ok(study)
}

/// The basis of a scene, at least as large as that of another one if that is given.
pub fn chosen_basis(scene: &Scene, beside: Option<&str>) -> Result<ChosenBasis, Failure> {
    let least = match beside {
        Some(text) => study_of(text)?.basis(),
        None => None,
    };
    let tolerance = scene.tolerance();
    Ok(match least {
        Some(least) => ChosenBasis::at_least(scene, tolerance, least)?,
        None => ChosenBasis::new(scene, tolerance)?,
    })
}
