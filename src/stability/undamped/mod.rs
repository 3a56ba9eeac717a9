//! Bands of an undamped blade over a range of speeds, and the speeds of its chart.
//!
//! Modes have Krein signs, and λ² is followed over the speed. Its quadruples are bands of flutter, its real numbers above zero bands of
//! divergence. Both are intervals of the pieces of a search ([`stretches`]) with two ends ([`growing`]) and a largest growth
//! ([`growing_stretch`]). The bands are checked and proven by counts ([`certification`], [`proof`]).

mod certification;
mod checked_modes;
mod extent;
mod growing;
mod growing_stretch;
mod interpolated;
mod known;
mod loci;
mod proof;
mod stretches;

pub(crate) use self::certification::Depth;
pub(super) use self::certification::drawn_share;
pub(super) use self::loci::RootLoci;

use self::certification::{Searched, last_below, searched};
use self::extent::Extent;
use self::known::Known;
use crate::model::evenly_spaced;
use crate::model::scene::SpeedRange;
use crate::modes::branches::{self, ModesAt};
use crate::modes::{SpectralModel, SpectrumError, clear_range, searched_range};
use crate::stability::band::Instability;
use crate::stability::between::Between;
use crate::stability::critical_sides::with_critical_speeds;
use crate::stability::diagram::{DrawnSpeeds, drawn};
use crate::stability::error::AnalysisError;
use crate::stability::instability_kind::InstabilityKind;
use crate::stability::options::AnalysisOptions;
use crate::stability::search_result::{FoundBands, StabilityChart};

/// Number of even speeds at the start of the search for bands; the bands do not depend on it.
pub(super) const SEARCH_SPEEDS: usize = 9;

/// Finds the bands with their checks, and draws them with the modes between, which are returned, too.
pub(super) fn charted<'a>(
    model: &'a SpectralModel,
    range: SpeedRange,
    count: usize,
    depth: Depth,
    options: AnalysisOptions<'_>,
) -> Result<(StabilityChart, Between<'a>), AnalysisError> {
    let within = clear_range(&model.critical, range);
    let speeds = DrawnSpeeds::new(model, within, count);
    branches::check_room(model, &speeds.all)?;
    // A free blade has no bands to search for; only the Krein index is checked.
    let search = if model.plate.is_axisymmetric() {
        from_first_critical(model, speeds.all.clone())
    } else {
        speeds_of_search(model, range, SEARCH_SPEEDS)
    };
    let Searched {
        found,
        solved,
        pieces,
    } = searched(model, range, &search, depth, Extent::Diagram)?;
    let is_held = !model.has_free_motions();
    options.report(&model.critical, range, Some(&found.instabilities), is_held);
    let inside = solved
        .iter()
        .filter(|at| within.contains(at.speed_rad_per_s));
    let shown = |at: &ModesAt| ModesAt {
        modes: model.shown(at.modes.clone()),
        ..*at
    };
    let seen = inside.map(shown).collect();
    let beside = beside_edges(&found.instabilities, range);
    let known = Known {
        model,
        pieces,
        solved,
    };
    let between = Between {
        model,
        interpolated: Box::new(move |speed| known.modes_at(speed)),
    };
    let chart = drawn(&between, &speeds, seen, &beside, found, options)?;
    Ok((chart, between))
}

/// Finds every band of an undamped blade in a range of speeds, with the results of its checks. The search
/// begins with `count` even speeds and both sides of every critical speed. A band is cut at the ends of the
/// range.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub fn undamped_bands(
    model: &SpectralModel,
    range: SpeedRange,
    count: usize,
) -> Result<FoundBands, SpectrumError> {
    let speeds = search_speeds(model, range, count);
    Ok(searched(model, range, &speeds, Depth::Counts, Extent::Bands)?.found)
}

/// Start speeds of the search for bands from the last one below the first critical speed on, see [`speeds_of_search`].
pub(super) fn search_speeds(model: &SpectralModel, range: SpeedRange, count: usize) -> Vec<f64> {
    from_first_critical(model, speeds_of_search(model, range, count))
}

/// Start speeds of a search: `count` even ones and both sides of every critical speed. The first
/// and the last are slightly outside the range, away from every critical speed.
fn speeds_of_search(model: &SpectralModel, range: SpeedRange, count: usize) -> Vec<f64> {
    let searched = searched_range(&model.critical, range);
    let even = evenly_spaced(searched.ends(), count);
    with_critical_speeds(&model.plate, &model.critical, searched, even)
}

/// Ascending speeds from the last one below the first critical speed on.
fn from_first_critical(model: &SpectralModel, mut speeds: Vec<f64>) -> Vec<f64> {
    let critical: Vec<f64> = model.critical.iter().map(|c| c.speed_rad_per_s).collect();
    speeds.drain(..last_below(&critical, speeds.iter().copied()));
    speeds
}

/// Share of the width of a band within which a diagram has a speed on each side of its edges.
const BESIDE_EDGE: f64 = 0.03;

/// Speeds on both sides of the edges of flutter bands. Those beside every critical speed are drawn anyway.
fn beside_edges(instabilities: &[Instability], range: SpeedRange) -> Vec<f64> {
    let flutter = instabilities
        .iter()
        .filter(|band| band.kind == InstabilityKind::Flutter);
    let beside = flutter.flat_map(|band| {
        let away = BESIDE_EDGE * band.range().width();
        let sides = band.range().ends().map(|edge| [edge - away, edge + away]);
        sides.into_iter().flatten()
    });
    beside.filter(|speed| range.contains(*speed)).collect()
}
