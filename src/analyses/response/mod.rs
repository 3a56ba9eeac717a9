//! Steady-state response of a saw, idling or in its cut: to a constant side force, to a blade that is not flat or not
//! balanced, and to the teeth.
//!
//! An excitation f e^{ikΩt} with the order k of the rotation speed gives the steady state q e^{ikΩt} with
//! L(ikΩ; Ω) q = f. [`response`](response()) gives its amplitude and phase at the probe and at the cut, over the speed, and
//! the deflection at the probe for a force of one newton over the frequency at one speed ([`FrequencyResponse`]).
//!
//! A natural frequency that equals that of an excitation is a resonance only if the excitation works on its mode: a load that turns with
//! a symmetric blade excites none. Resonances are the poles of the states over the speed, of whatever frequency, and not those of the
//! diagram. No steady state exists where a motion of the saw grows, and without damping none exists at a resonance: amplitudes beyond
//! the linear model are not reported.

pub(crate) mod chart;
mod command;
mod options;
mod outline;
mod points;
mod report;
mod solver;
mod speeds;
#[cfg(test)]
mod symmetric_tests;
#[cfg(test)]
mod tests;
mod warnings;

pub use crate::motion::steady::Cause;
pub use options::Options;
pub(crate) use outline::{outline, verdict};
pub use report::{
    FrequencyResponse, OperatingResponse, Resonance, ResponseLine, ResponseReport, SteadyState,
};

use std::f64::consts::TAU;

use crate::analyses::board_deviation::BoardDeviation;
use crate::analyses::campbell::caution;
use crate::model::plate::Plate;
use crate::model::scene::{
    ConstantForce, ForceCause, RefusedValue, Scene, SceneError, rad_per_s, rpm,
};
use crate::modes::SpectrumError;
use crate::motion::steady::{Family, loads};
use crate::stability::{Analysis, AnalysisError, ahead, check_speed};
use solver::{Motion, Solver};
use speeds::{even, near};
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
    if let Some(rpm) = options.rpm {
        check_speed(scene.blade(), "rpm", rpm)?;
    }
    if let Some(sweep) = scene.sweep() {
        options.speed_rad_per_s(sweep)?;
    }
    of_analysis(&Analysis::new(scene)?, options)
}

/// The response of an analysed saw.
pub(crate) fn of_analysis(
    analysis: &Analysis,
    options: &Options,
) -> Result<ResponseReport, ResponseError> {
    let scene = &analysis.scene;
    let ConstantForce { force_n, cause, .. } = exciting_force(scene);
    let plate = &analysis.model.plate;
    let excitations = |plate| loads(plate, scene, force_n);
    let loads = excitations(plate)?;
    let of_cut = cause == ForceCause::Cut;
    let range = analysis.range_rad_per_s;
    let within = |speed: &f64| range.contains(*speed);
    let operating = scene.operating_rad_per_s().filter(within);
    let asked = options.speed_rad_per_s(range)?;
    let solver = Solver::new(plate, scene);
    let motion = Motion(analysis);
    let mut speeds = even(range, operating);
    let mut families = Vec::new();
    for load in &loads {
        let mut family = Family::new(&solver.system, &load.vector)?;
        solver.deflections(&mut family, load, &speeds)?;
        let resonances = Solver::resonances(&family, load, range)?;
        families.push((load, family, resonances));
    }
    for (.., resonances) in &families {
        let places: Vec<f64> = resonances.iter().map(|(speed, _)| *speed).collect();
        speeds.extend(near(range, &places));
    }
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    let mut lines: Vec<ResponseLine> = families
        .iter_mut()
        .map(|(load, family, resonances)| solver.line(load, family, &speeds, resonances, &motion))
        .collect::<Result<_, _>>()?;
    for line in lines
        .iter_mut()
        .filter(|line| of_cut && line.cause == Cause::SideForce)
    {
        line.name = "lateral force of the cut, static".to_owned();
    }
    let diagram = analysis.model.complete_to_rad_per_s;
    let is_beyond = |line: &ResponseLine| f64::from(line.order) * range.to_rad_per_s > diagram;
    if lines.iter().any(is_beyond) {
        let larger = Plate::new(scene, ahead(plate.resolution));
        let finer = Solver::new(&larger, scene);
        let loads = excitations(&larger)?;
        for ((line, load), (.., resonances)) in lines.iter_mut().zip(&loads).zip(&families) {
            if !is_beyond(line) || resonances.is_empty() {
                continue;
            }
            // The solutions beside the resonances contain the motions that the load excites.
            let places: Vec<f64> = resonances.iter().map(|(speed, _)| *speed).collect();
            let mut family = Family::new(&finer.system, &load.vector)?;
            finer.deflections(&mut family, load, &places)?;
            line.state_error(&Solver::resonances(&family, load, range)?);
        }
    }
    let points = asked
        .or(operating)
        .map(|speed| {
            let place = scene.side_force().at;
            let end = options
                .to_hz
                .map(|hz| TAU * hz)
                .unwrap_or(analysis.model.complete_to_rad_per_s);
            FrequencyResponse::new(plate, &solver, &motion, speed, end, place)
        })
        .transpose()?;
    let rpm: Vec<f64> = speeds.iter().map(|speed| rpm(*speed)).collect();
    let deviation_m = |k: usize| lines.iter().map(|line| line.at_cut_m[k]).sum();
    let board_deviation_m: Vec<Option<f64>> = (0..rpm.len()).map(deviation_m).collect();
    let (probe, chart) = (scene.probe(), analysis.report());
    let is_assumed = cause == ForceCause::Assumed && force_n != 0.0;
    let assumed = is_assumed.then_some(force_n);
    let constant = chart.operating.as_ref().and_then(|at| at.deviation.clone());
    let of_chart = caution(&chart).into_iter().chain(chart.warnings).collect();
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
        warnings: warnings(scene, assumed, &lines, of_chart),
        instabilities: chart.instabilities,
        operating: OperatingResponse::new(
            &motion,
            &rpm,
            &lines,
            &board_deviation_m,
            constant.filter(|_| force_n != 0.0),
        ),
        constant_force_n: force_n,
        constant_force_cause: (force_n != 0.0).then_some(cause),
        rpm,
        lines,
        board_deviation_m,
        points,
    })
}

impl ResponseLine {
    /// States the largest relative distance of the resonances from the nearest ones on a larger basis, in rad/s.
    fn state_error(&mut self, finer_rad_per_s: &[(f64, f64)]) {
        let nearest = |at: &Resonance| {
            let changes = finer_rad_per_s
                .iter()
                .map(|(other, _)| (rpm(*other) / at.rpm - 1.0).abs());
            changes.reduce(f64::min)
        };
        self.resonance_error = self.resonances.iter().filter_map(nearest).reduce(f64::max);
    }
}

impl OperatingResponse {
    /// The deflections at the operating speed, of which that under the constant force is `constant`; `None` if it is not one of the
    /// speeds.
    fn new(
        motion: &Motion<'_>,
        rpm: &[f64],
        lines: &[ResponseLine],
        board_deviation_m: &[Option<f64>],
        constant: Option<BoardDeviation>,
    ) -> Option<Self> {
        let asked = motion.0.scene.file().operating_rpm?;
        // The speeds were converted to rad/s and back, so that they agree with the operating speed only
        // up to rounding.
        let place = rpm
            .iter()
            .position(|rpm| (rpm / asked - 1.0).abs() < 1e-9)?;
        let here = |resonance: &&Resonance| resonance.rpm == rpm[place];
        let resonances = lines
            .iter()
            .flat_map(|line| line.resonances.iter().find(here));
        let steady_state = match board_deviation_m[place] {
            Some(_) => SteadyState::Bounded,
            None if motion.is_unstable(rad_per_s(asked)) => SteadyState::None,
            None => resonances
                .map(|resonance| resonance.steady_state)
                .find(|state| *state == SteadyState::Unbounded)
                .unwrap_or(SteadyState::BeyondModel),
        };
        Some(OperatingResponse {
            steady_state,
            rpm: asked,
            amplitude_m: lines.iter().map(|line| line.amplitude_m[place]).collect(),
            board_deviation_m: match &constant {
                None => board_deviation_m[place],
                Some(constant) => {
                    let moving = lines.iter().filter(|line| line.order > 0);
                    let amplitudes: Option<f64> = moving.map(|line| line.at_cut_m[place]).sum();
                    let known = constant.deflection_m.zip(amplitudes);
                    known.map(|(still_m, moving_m)| still_m + moving_m)
                }
            },
            constant,
        })
    }
}

/// The constant lateral force of a scene; an assumed one only if nothing else excites the blade, else zero.
fn exciting_force(scene: &Scene) -> ConstantForce {
    let turning = scene
        .file()
        .response
        .is_some_and(|response| response.excites());
    let others = turning || scene.oscillating_force().is_some();
    let force = scene.constant_force();
    let is_left_out = others && force.cause == ForceCause::Assumed;
    ConstantForce {
        force_n: if is_left_out { 0.0 } else { force.force_n },
        ..force
    }
}
