//! Guides with a gap: the Campbell diagram at an amplitude, and the deflection at the cut over the gap.
//!
//! A one-sided guide has no stiffness inside its gap, so that the linear chart of a scene is valid for large amplitudes only.
//! These results describe smaller amplitudes and stationary deflections:
//!
//! * [`AtAmplitude`]: critical speeds, bands and flutter speed with the stiffness that the guides have on average
//!   over an oscillation of a given amplitude.
//! * [`DeviationMap`]: the stationary deflection at the cut, and the forces of the pads, over gap, side force and speed,
//!   from the equilibria of [`stretched_blade`](crate::motion::stretched_blade).
//! * [`Oscillation`], only if something makes the blade oscillate: its periodic motion, at a speed and over the speed.
//! * [`FrictionHeat`], only for a scene with `friction`: the heat of the pads, and the blade that it deforms.
//!
//! ```no_run
//! use sawflutter::analyses::gap::{Options, gap};
//! use sawflutter::model::scene::Scene;
//!
//! let report = gap(&Scene::from_path("saw.json")?, &Options::default())?;
//! println!("{:?}", report.half_way_amplitude_m);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod amplitude;
pub(crate) mod chart;
mod command;
mod critical_speed;
mod deviation;
mod error;
mod friction;
pub(crate) mod friction_chart;
pub(crate) mod map_chart;
mod numbers;
mod options;
mod oscillation;
pub(crate) mod oscillation_chart;
mod oscillation_outline;
mod oscillation_reading;
mod oscillation_report;
mod outline;
mod report;
mod settling;

pub use amplitude::equivalent_share;
pub use error::GapError;
pub(crate) use numbers::{GapCase, GapNumbers};
pub use options::Options;
pub use oscillation_report::{
    Oscillation, OscillationAt, OscillationLine, OscillationPad, OscillationPlace,
};
pub(crate) use outline::{answer, outline, wear};
pub use report::{AtAmplitude, BasisError, DeviationMap, FrictionHeat, FrictionPad, GapReport};

use amplitude::{AmplitudeChart, pushes};
use deviation::deviation_map;
use oscillation::oscillation;

use crate::analyses::campbell::caution;
use crate::model::scene::{RefusedValue, Scene, rad_per_s, rpm};
use crate::motion::steady::Oscillators;
use crate::page::text::{rounded_down, shown};
use crate::stability::Analysis;

/// Computes the chart over the amplitude, the deflection over gap, force and speed, and, if they are asked for, oscillation
/// and heat of friction.
///
/// # Errors
/// [`GapError`].
pub fn gap(scene: &Scene, options: &Options) -> Result<GapReport, GapError> {
    let tried = options.gap_m.map(|gap_m| scene.with_gap(gap_m));
    let tried = tried.transpose()?;
    let scene = tried.as_ref().map_or(scene, |tried| &tried.scene);
    options.checked(scene)?;
    let analysis = Analysis::new(scene)?;
    let first = analysis.model.critical.first();
    let speed = options
        .rpm
        .map(rad_per_s)
        .or(scene.operating_rad_per_s())
        .or(first.map(|critical| 0.5 * critical.speed_rad_per_s))
        .unwrap_or(analysis.range_rad_per_s.to_rad_per_s);
    check_complete(&analysis, options, speed)?;
    let amplitude = AmplitudeChart::new(&analysis)?;
    let speed_rpm = rpm(speed);
    let deviation = deviation_map(&analysis, speed_rpm, scene.limits().max_deviation_m)?;
    let oscillators = Oscillators::of(scene);
    let oscillation = oscillators
        .map(|all| oscillation(&analysis, &all, speed))
        .transpose()?;
    let heated = scene
        .file()
        .friction
        .map(|friction| FrictionHeat::new(&analysis, friction, speed_rpm))
        .transpose()?;
    let chart = analysis.report();
    let mut warnings: Vec<String> = caution(&chart).into_iter().chain(chart.warnings).collect();
    warnings.extend(shifting(scene));
    warnings.extend(heated.as_ref().and_then(FrictionHeat::unsettled));
    warnings.extend(oscillation.iter().flat_map(Oscillation::warnings));
    warnings.extend(deviation.basis_error.and_then(BasisError::warning));
    Ok(GapReport {
        sawflutter: chart.sawflutter,
        scene: chart.scene,
        condition: chart.condition,
        unusual_numbers: chart.unusual_numbers,
        degrees_of_freedom: chart.accuracy.degrees_of_freedom,
        from_rpm: chart.campbell.from_rpm,
        to_rpm: chart.campbell.to_rpm,
        smallest_gap_m: amplitude.smallest_gap_m,
        free: amplitude.free,
        amplitudes: amplitude.amplitudes,
        linear: amplitude.linear,
        half_way_amplitude_m: amplitude.half_way_m,
        deviation,
        oscillation,
        friction: heated,
        warnings,
    })
}

/// Refuses a speed above the one up to which the basis of an analysis has all waves that stand still, and with them the shapes that
/// deflect most.
fn check_complete(
    analysis: &Analysis,
    options: &Options,
    speed_rad_per_s: f64,
) -> Result<(), RefusedValue> {
    if speed_rad_per_s <= analysis.complete_to_rad_per_s {
        return Ok(());
    }
    let (key, given_rpm) = match options.rpm {
        Some(given_rpm) => ("rpm", given_rpm),
        None => ("operating_rpm", rpm(speed_rad_per_s)),
    };
    let most = rounded_down(5, rpm(analysis.complete_to_rad_per_s));
    let allowed = format!("at most {} with the sweep of this scene", shown(most));
    let remedy = "the functions for this sweep lack waves that stand still at higher speeds; give a lower speed, or a sweep.to_rpm that is as high";
    Err(RefusedValue::new(key, given_rpm, allowed, remedy))
}

/// Remark on guides whose force has a mean over an oscillation, which moves the blade.
fn shifting(scene: &Scene) -> Option<String> {
    let guides = scene.guides().iter().filter(|guide| pushes(guide));
    let names: Vec<String> = guides
        .map(|guide| format!("guides[{}]", guide.index))
        .collect();
    (!names.is_empty()).then(|| {
        format!(
            "over an oscillation {} also push the blade aside on average, because of an offset or a missing side: the chart over the \
             amplitude holds for oscillations about the position of the blade at rest in which the mean forces of its guides balance",
            names.join(", ")
        )
    })
}

#[cfg(test)]
mod linear_tests;
#[cfg(test)]
mod mean_tests;
#[cfg(test)]
mod tests;
