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
mod balance;
pub(crate) mod chart;
mod deviation;
mod friction;
pub(crate) mod friction_chart;
pub(crate) mod map_chart;
mod numbers;
mod oscillating_blade;
mod oscillation;
pub(crate) mod oscillation_chart;
mod oscillation_report;
mod oscillators;
mod outline;
mod pressed;
mod report;
mod settling;

pub use amplitude::equivalent_share;
pub(crate) use numbers::{GapCase, GapNumbers};
pub use oscillation_report::{
    Oscillation, OscillationAt, OscillationLine, OscillationPad, OscillationPlace,
};
pub(crate) use outline::outline;
pub use report::{AtAmplitude, BasisError, DeviationMap, FrictionHeat, FrictionPad, GapReport};

use amplitude::AmplitudeChart;
use deviation::deviation_map;
use oscillation::oscillation;
use oscillators::Oscillators;

use crate::model::scene::{
    Blade, Bore, Guide, GuideSide, RefusedValue, Scene, SceneError, rad_per_s, rpm, speed_rad_per_s,
};
use crate::modes::SpectrumError;
use crate::motion::stretched_blade::{LARGEST_SLOPE, StretchedError};
use crate::page::text::shown_to;
use crate::stability::{Analysis, AnalysisError};

/// Reason for which the guides of a saw could not be evaluated.
#[derive(Debug, thiserror::Error)]
pub enum GapError {
    /// An option was refused, or the scene has no one-sided guide.
    #[error(transparent)]
    Refused(#[from] RefusedValue),
    /// A scene with another gap or stiffness was refused.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The saw could not be analysed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// An eigenproblem failed.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// No equilibrium was found.
    #[error(transparent)]
    Stretched(#[from] StretchedError),
}

/// Options of [`gap`].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Options {
    /// Speed of the map over gap and force; by default the operating speed, or half of the first critical speed.
    pub rpm: Option<f64>,
    /// Largest deflection at the cut that is allowed.
    pub max_deviation_mm: Option<f64>,
}

/// Largest limit of the deflection that is accepted; no blade deflects as far.
const MAX_DEVIATION_MM: f64 = 1e3;

impl Options {
    /// Refuses invalid numbers, and a scene without a one-sided guide.
    ///
    /// # Errors
    /// [`RefusedValue`].
    pub fn checked(&self, scene: &Scene) -> Result<(), RefusedValue> {
        self.checked_still(scene)?;
        Oscillators::of(scene).map_or(Ok(()), Oscillators::checked)
    }

    /// As [`Options::checked`], for deflections without oscillation.
    fn checked_still(&self, scene: &Scene) -> Result<(), RefusedValue> {
        if let Some(rpm) = self.rpm {
            speed_rad_per_s("rpm", rpm)?;
        }
        if let Some(limit) = self.max_deviation_mm
            && !(limit > 0.0 && limit <= MAX_DEVIATION_MM)
        {
            let allowed = "above 0 and at most 1000";
            let remedy =
                "give the largest deflection allowed at the cut in millimetres, such as 0.1";
            return Err(RefusedValue::new(
                "max_deviation_mm",
                limit,
                allowed,
                remedy,
            ));
        }
        let force_n = scene.file().side_force_n();
        if force_n == 0.0 {
            let (key, allowed) = ("side_force.force_n", "other than 0");
            let remedy = "a side force presses the blade on its guides; give it, such as 5";
            return Err(RefusedValue::new(key, force_n, allowed, remedy));
        }
        let mut guides = scene.guides().iter();
        guides.try_for_each(|guide| check_reached(scene.blade(), guide))?;
        if scene.guides().iter().any(|guide| guide.lifting.is_some()) {
            Ok(())
        } else {
            Err(RefusedValue::missing(
                "guides[].contact",
                "\"one_sided\" for at least one guide",
                "a linear guide acts at any deflection; give contact as \"one_sided\" and gap_m",
            ))
        }
    }
}

/// Refuses a gap that a clamped blade does not cross at any deflection for which the model is valid: with slopes up to
/// [`LARGEST_SLOPE`] the deflection at a distance from the collar is at most this share of the distance. A blade on a
/// spline crosses any gap, because it moves along its arbor.
fn check_reached(blade: &Blade, guide: &Guide) -> Result<(), RefusedValue> {
    let (Some(lifting), Bore::Clamped(_)) = (guide.lifting, blade.bore) else {
        return Ok(());
    };
    let (_, farthest_m) = guide.typed.reach_m();
    let free_m = farthest_m.min(blade.outer_radius_m) - blade.inner_radius_m;
    let most_m = LARGEST_SLOPE * free_m + lifting.offset_m.abs();
    if lifting.gap_m <= most_m {
        Ok(())
    } else {
        Err(RefusedValue::new(
            format!("guides[{}].gap_m", guide.index),
            lifting.gap_m,
            format!(
                "at most {} m, as far as a blade between collars deflects with slopes up to {LARGEST_SLOPE}, to which the model is valid",
                shown_to(3, most_m)
            ),
            "give the gap in metres, such as 5e-5, or leave this pad out",
        ))
    }
}

/// Computes the chart over the amplitude, the deflection over gap, force and speed, and, if they are asked for, oscillation
/// and heat of friction.
///
/// # Errors
/// [`GapError`].
pub fn gap(scene: &Scene, options: &Options) -> Result<GapReport, GapError> {
    options.checked(scene)?;
    let analysis = Analysis::new(scene)?;
    let amplitude = AmplitudeChart::new(&analysis)?;
    let first = analysis.model.critical.first();
    let speed = options
        .rpm
        .map(rad_per_s)
        .or(scene.operating_rad_per_s())
        .or(first.map(|critical| 0.5 * critical.speed_rad_per_s))
        .unwrap_or(analysis.range_rad_per_s.1);
    let speed_rpm = rpm(speed);
    let limit_m = options.max_deviation_mm.map(|mm| 1e-3 * mm);
    let deviation = deviation_map(&analysis, speed_rpm, limit_m)?;
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
    let mut warnings = chart.warnings;
    warnings.extend(shifting(scene));
    warnings.extend(heated.as_ref().and_then(FrictionHeat::warning));
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

/// Remark on guides whose force has a mean over an oscillation, which moves the blade.
fn shifting(scene: &Scene) -> Option<String> {
    let is_shifting = |guide: &&Guide| {
        let law = guide.lifting;
        law.is_some_and(|law| law.offset_m != 0.0 || law.side != GuideSide::Both)
    };
    let guides = scene.guides().iter().filter(is_shifting);
    let names: Vec<String> = guides
        .map(|guide| format!("guides[{}]", guide.index))
        .collect();
    (!names.is_empty()).then(|| {
        format!(
            "over an oscillation {} also push the blade aside on average, because of an offset or a missing side: the chart over the \
             amplitude neglects this shift, and holds for oscillations about the flat blade",
            names.join(", ")
        )
    })
}

#[cfg(test)]
mod tests;
