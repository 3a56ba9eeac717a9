//! Steady-state response of a saw, idling or in its cut: to a constant side force, to a blade that is not flat or not
//! balanced, and to the teeth.
//!
//! An excitation f e^{ikΩt} with the order k of the rotation speed gives the steady state q e^{ikΩt} with
//! L(ikΩ; Ω) q = f. [`response`](response()) gives its amplitude and phase at the probe and at the cut, over the speed, and
//! the deflection at the probe for a force of one newton over the frequency at one speed ([`FrequencyResponse`]).
//!
//! No steady state exists where the saw is unstable, and without damping none exists at a resonance: amplitudes beyond the
//! linear model are not reported.

pub(crate) mod chart;
mod family;
mod load;
mod options;
mod outline;
mod points;
mod report;
mod solver;
mod speeds;
#[cfg(test)]
mod tests;
mod warnings;

pub(crate) use family::{State, solution};
pub(crate) use load::{Load, loads};
pub use options::Options;
pub(crate) use outline::outline;
pub use report::{
    Cause, FrequencyResponse, OperatingResponse, Resonance, ResponseLine, ResponseReport,
};

use crate::model::scene::{RefusedValue, Scene, SceneError, USUAL_SIDE_FORCE_N, rpm};
use crate::modes::SpectrumError;
use crate::stability::{Analysis, AnalysisError};
use solver::Solver;
use speeds::{resonances, speeds};
use warnings::warnings;

/// Reason for which the response of a saw could not be computed.
#[derive(Debug, thiserror::Error)]
pub enum ResponseError {
    /// An option or a key of the scene was refused.
    #[error(transparent)]
    Refused(#[from] RefusedValue),
    /// The scene was refused.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The saw could not be analysed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// An eigenproblem failed.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
}

/// Computes the response of a saw.
///
/// # Errors
/// [`ResponseError`].
pub fn response(scene: &Scene, options: &Options) -> Result<ResponseReport, ResponseError> {
    options.checked()?;
    let (force_n, is_assumed) = constant_force_n(scene);
    let analysis = Analysis::new(scene)?;
    let plate = &analysis.model.plate;
    let loads = loads(plate, scene, force_n).map_err(|waves| rigid(waves, scene))?;
    let resonances: Vec<Vec<f64>> = loads
        .iter()
        .map(|load| resonances(&analysis, load.order))
        .collect::<Result<_, _>>()?;
    let range = analysis.range_rad_per_s;
    let within = |speed: &f64| (range.0..=range.1).contains(speed);
    let operating = scene.operating_rad_per_s().filter(within);
    let asked = options.speed_rad_per_s(range)?;
    let events = resonances.iter().flatten().copied();
    let speeds = speeds(range, events, operating);
    let solver = Solver::new(plate, scene);
    let lines = loads.iter().zip(&resonances);
    let lines: Vec<ResponseLine> = lines
        .map(|(load, resonances)| solver.line(&analysis, load, &speeds, resonances))
        .collect::<Result<_, _>>()?;
    let points = asked.or(operating).map(|speed| {
        let place = scene.side_force().at.polar();
        FrequencyResponse::new(&analysis, &solver, (speed, options.to_hz), place)
    });
    let points = points.transpose()?;
    let rpm: Vec<f64> = speeds.iter().map(|speed| rpm(*speed)).collect();
    let deviation_m = |k: usize| lines.iter().map(|line| line.at_cut_m[k]).sum();
    let board_deviation_m: Vec<Option<f64>> = (0..rpm.len()).map(deviation_m).collect();
    let (probe, chart) = (scene.probe(), analysis.report());
    let assumed = is_assumed.then_some(force_n);
    Ok(ResponseReport {
        sawflutter: chart.sawflutter,
        scene: scene.file().clone(),
        condition: chart.condition,
        unusual_numbers: chart.unusual_numbers,
        degrees_of_freedom: chart.accuracy.degrees_of_freedom,
        from_rpm: chart.campbell.from_rpm,
        to_rpm: chart.campbell.to_rpm,
        probe_radius_m: probe.radius_m,
        probe_angle_deg: probe.angle_deg,
        cut_angle_deg: scene.file().cut_angle_deg(),
        damped: !analysis.model.is_conservative(),
        linear_limit_m: solver.limit_m,
        warnings: warnings(&analysis, assumed, &lines, chart.warnings),
        instabilities: chart.instabilities,
        operating: OperatingResponse::new(scene, &rpm, &lines, &board_deviation_m),
        rpm,
        lines,
        board_deviation_m,
        points,
    })
}

impl OperatingResponse {
    /// The deflections at the operating speed; `None` if it is not one of the speeds.
    fn new(
        scene: &Scene,
        rpm: &[f64],
        lines: &[ResponseLine],
        board_deviation_m: &[Option<f64>],
    ) -> Option<Self> {
        let asked = scene.file().operating_rpm?;
        // The speeds were converted to rad/s and back, so that they agree with the operating speed only
        // up to rounding.
        let place = rpm
            .iter()
            .position(|rpm| (rpm / asked - 1.0).abs() < 1e-9)?;
        Some(OperatingResponse {
            rpm: asked,
            amplitude_m: lines.iter().map(|line| line.amplitude_m[place]).collect(),
            board_deviation_m: board_deviation_m[place],
        })
    }
}

/// Constant side force in N that excites the blade of a scene, 0 for none, and whether it is assumed because nothing else does.
fn constant_force_n(scene: &Scene) -> (f64, bool) {
    let file = scene.file();
    let typed = file.side_force.and_then(|typed| typed.force_n);
    let turning = file.response.is_some_and(|response| response.excites());
    match typed.unwrap_or(0.0) {
        0.0 if !turning && scene.oscillating_force().is_none() => (USUAL_SIDE_FORCE_N, true),
        given => (given, false),
    }
}

/// The refusal of a run-out or of a lack of flatness that is a rigid motion of the blade.
pub(crate) fn rigid(waves: usize, scene: &Scene) -> RefusedValue {
    let excitation = scene.file().response.unwrap_or_default();
    let (key, value) = match waves {
        1 => ("response.runout_m", excitation.runout_m),
        _ => ("response.flatness_m", excitation.flatness_m),
    };
    let allowed = "0 for a blade that tilts freely on its arbor";
    let remedy =
        "such a blade has no run-out of its own; give flatness_m, or a mount with a collar";
    RefusedValue::new(key, value, allowed, remedy)
}
