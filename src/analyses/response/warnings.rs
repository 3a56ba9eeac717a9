//! Remarks on the validity of the result.

use super::report::{Resonance, ResponseLine, SteadyState};
use crate::model::scene::Scene;
use crate::page::text::{counted, shown};

const NO_STIFFNESS: &str =
    "the static stiffness is zero there, so that any side force deflects the blade without bound";
const NO_DAMPING: &str =
    "nothing dissipates the energy of the motion there, so that amplitudes grow without bound";
const BEYOND_MODEL: &str = "amplitudes exceed five thicknesses of the blade there";
const UNSTABLE: &str = "the saw is unstable there";

/// Remarks of the chart, and on the lines; `assumed_force_n` is the side force of a scene without an excitation.
pub(super) fn warnings(
    scene: &Scene,
    assumed_force_n: Option<f64>,
    lines: &[ResponseLine],
    of_chart: Vec<String>,
) -> Vec<String> {
    let mut warnings = of_chart;
    if let Some(force_n) = assumed_force_n {
        warnings.push(format!(
            "the scene has no excitation; a constant side force of {} N was assumed, set side_force.force_n, response.runout_m or others",
            shown(force_n)
        ));
    }
    let thickness = scene.blade().thickness_m;
    let all = lines.iter().flat_map(|line| &line.amplitude_m).flatten();
    let largest = all.copied().fold(0.0, f64::max);
    if largest > thickness {
        warnings.push(format!(
            "amplitudes above the thickness of the blade, {} mm, are overestimates: the blade stretches, which the linear model neglects",
            shown(1e3 * thickness)
        ));
    }
    for why in [NO_STIFFNESS, NO_DAMPING, BEYOND_MODEL, UNSTABLE] {
        let all = lines.iter().flat_map(|line| &line.resonances);
        let count = all.filter(|at| why_unknown(at) == Some(why)).count();
        if count > 0 {
            warnings.push(format!(
                "at {} no amplitude is given: {why}",
                counted(count, ["resonance", "resonances"])
            ));
        }
    }
    warnings
}

/// The reason for which a resonance has no amplitude.
fn why_unknown(at: &Resonance) -> Option<&'static str> {
    match at.steady_state {
        SteadyState::Bounded => None,
        SteadyState::Unbounded if at.frequency_hz == 0.0 => Some(NO_STIFFNESS),
        SteadyState::Unbounded => Some(NO_DAMPING),
        SteadyState::BeyondModel => Some(BEYOND_MODEL),
        SteadyState::None => Some(UNSTABLE),
    }
}
