//! Remarks on the validity of the result.

use super::report::ResponseLine;
use crate::model::scene::rad_per_s;
use crate::page::text::shown;
use crate::stability::{Analysis, StabilityState};

/// Remarks of the chart, and on the lines; `assumed_force_n` is the side force of a scene without an excitation.
pub(super) fn warnings(
    analysis: &Analysis,
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
    let thickness = analysis.scene.blade().thickness_m;
    let all = lines.iter().flat_map(|line| &line.amplitude_m).flatten();
    let largest = all.copied().fold(0.0, f64::max);
    if largest > thickness {
        warnings.push(format!(
            "amplitudes above the thickness of the blade, {} mm, are overestimates: the blade stretches, which the linear model neglects",
            shown(1e3 * thickness)
        ));
    }
    let unbounded: usize = lines
        .iter()
        .flat_map(|line| &line.resonances)
        .filter(|resonance| {
            let speed = rad_per_s(resonance.rpm);
            let state = analysis.verdict(speed).state;
            resonance.amplitude_m.is_none() && state == StabilityState::Stable
        })
        .count();
    if unbounded > 0 {
        let why = match analysis.model.is_conservative() {
            true => "the scene has no damping, so that amplitudes grow without bound there",
            false => "amplitudes exceed five thicknesses of the blade there",
        };
        warnings.push(format!(
            "at {unbounded} resonances no amplitude is given: {why}"
        ));
    }
    warnings
}
