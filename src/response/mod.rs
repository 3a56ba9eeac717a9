//! Steady-state response of a saw, idling or in its cut: to a constant side force, to a blade that is not flat or not
//! balanced, and to the teeth.
//!
//! An excitation f e^{ikΩt} with the order k of the rotation speed gives the steady state q e^{ikΩt} with
//! L(ikΩ; Ω) q = f. [`ForcedResponse`] has its amplitude and phase at the probe and at the cut, over the speed, and
//! [`FrequencyResponse`] the deflection at the probe for a force of one newton over the frequency at one speed.
//!
//! No steady state exists where the saw is unstable, and without damping none exists at a resonance: amplitudes beyond the
//! linear model are not reported.

mod family;
mod load;
mod points;

pub use load::Cause;
pub use points::FrequencyResponse;

use faer::{Col, c64};

use crate::campbell::even_speeds;
use crate::plate::Plate;
use crate::scene::typical_value;
use crate::scene::{
    ExcitationLine, RefusedValue, ResponseFile, Scene, SceneError, rad_per_s, rpm, speed_rad_per_s,
};
use crate::spectrum::SpectrumError;
use crate::stability::{Analysis, AnalysisError, StabilityState, crossings};
use crate::system::GyroscopicSystem;
use crate::text::shown;
use crate::transient::{at_point, linear_limit_m};
use family::readings;
use load::force_place;

pub(crate) use family::{State, solution};
pub(crate) use load::{Load, loads};

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

/// Options of [`ForcedResponse::new`].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Options {
    /// Speed of the frequency response; by default the operating speed. Without a speed within the sweep there is no
    /// frequency response.
    pub rpm: Option<f64>,
    /// Largest frequency of the frequency response; by default the frequency up to which the chart is complete.
    pub to_hz: Option<f64>,
}

/// Response of a saw over its speeds.
#[derive(Debug)]
pub struct ForcedResponse {
    /// Scene of the saw.
    pub scene: Scene,
    /// Analysis of the saw.
    pub analysis: Analysis,
    /// Excitation of the blade.
    pub excitation: ResponseFile,
    /// Whether the scene has no excitation, so that a force of one newton was assumed.
    pub is_assumed: bool,
    /// Rotation speeds, ascending, the same for every line.
    pub speeds_rad_per_s: Vec<f64>,
    /// Responses, one for each cause and order.
    pub lines: Vec<ResponseLine>,
    /// Frequency response at one speed; `None` if no speed is known, see [`Options::rpm`].
    pub points: Option<FrequencyResponse>,
}

/// Response to one cause with one order.
#[derive(Debug, Clone)]
pub struct ResponseLine {
    /// Cause of the excitation.
    pub cause: Cause,
    /// Ratio of the frequency of the excitation to the rotation speed.
    pub order: u32,
    /// Speeds at which a natural frequency equals that of the excitation, ascending.
    pub resonances_rad_per_s: Vec<f64>,
    /// Deflections at the speeds; `None` where no steady state exists, or its deflection exceeds the linear model.
    pub deflections: Vec<Option<Deflection>>,
}

/// Complex amplitudes w of deflections w e^{ikΩt}.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deflection {
    /// Amplitude at the probe, in m.
    pub at_probe: c64,
    /// Amplitude of the rim at the cut, in m.
    pub at_cut: c64,
}

/// Number of evenly spaced speeds.
const SPEEDS: usize = 481;
/// Smallest and largest distance of added speeds from a resonance, relative to it.
const NEAR: (f64, f64) = (1e-5, 3e-2);
/// Number of added speeds on either side of a resonance.
const BESIDE: usize = 10;
/// Places around the rim at which the deflection is compared with the linear limit.
const AROUND: usize = 48;
/// First speed of a diagram from rest, as a share of its last speed, so that no order is static.
const LEAST: f64 = 1e-6;

impl Options {
    /// Refuses invalid numbers.
    ///
    /// # Errors
    /// [`RefusedValue`].
    pub fn checked(&self) -> Result<(), RefusedValue> {
        // A speed of zero is allowed, because at rest the response is that of a tap test.
        if let Some(rpm) = self.rpm.filter(|rpm| *rpm != 0.0) {
            speed_rad_per_s("rpm", rpm)?;
        }
        match self.to_hz {
            Some(hz) if !(hz > 0.0 && hz <= 1e6) => {
                let remedy = "give the largest frequency in Hz, such as 500";
                Err(RefusedValue::new(
                    "to_hz",
                    hz,
                    "above 0 and at most 1e6",
                    remedy,
                ))
            }
            _ => Ok(()),
        }
    }

    /// The speed of the frequency response, which must be one of the sweep: beyond it the saw was not analysed.
    fn speed_rad_per_s(&self, (from, to): (f64, f64)) -> Result<Option<f64>, RefusedValue> {
        let Some(asked) = self.rpm else {
            return Ok(None);
        };
        let speed = rad_per_s(asked);
        if !(from..=to).contains(&speed) {
            let allowed = format!(
                "a speed of the sweep, {} to {} rpm",
                shown(rpm(from)),
                shown(rpm(to))
            );
            let remedy = "change sweep.from_rpm or sweep.to_rpm";
            return Err(RefusedValue::new("rpm", asked, allowed, remedy));
        }
        Ok(Some(speed))
    }
}

impl ForcedResponse {
    /// Computes the response of the saw.
    ///
    /// # Errors
    /// [`ResponseError`].
    pub fn new(scene: &Scene, options: &Options) -> Result<Self, ResponseError> {
        options.checked()?;
        let (excitation, is_assumed) = excitation(scene);
        let analysis = Analysis::new(scene)?;
        let plate = &analysis.model.plate;
        let loads = loads(plate, scene, &excitation).map_err(|waves| rigid(waves, &excitation))?;
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
        let lines = loads.iter().zip(resonances).map(|(load, resonances)| {
            Ok(ResponseLine {
                cause: load.cause,
                order: load.order,
                resonances_rad_per_s: resonances,
                deflections: solver.deflections(&analysis, load, &speeds)?,
            })
        });
        let lines = lines.collect::<Result<_, SpectrumError>>()?;
        let points = asked.or(operating).map(|speed| {
            let place = force_place(scene, &excitation);
            FrequencyResponse::new(&analysis, &solver, (speed, options.to_hz), place)
        });
        let points = points.transpose()?;
        Ok(ForcedResponse {
            scene: scene.clone(),
            excitation,
            is_assumed,
            speeds_rad_per_s: speeds,
            lines,
            points,
            analysis,
        })
    }

    /// Largest amplitude in m that is reported: five times the smallest thickness.
    pub fn linear_limit_m(&self) -> f64 {
        linear_limit_m(self.scene.blade())
    }

    /// Radius in m and angle in rad of the side force.
    pub fn force_place(&self) -> (f64, f64) {
        force_place(&self.scene, &self.excitation)
    }

    /// Radius in m and angle in rad of the probe.
    pub fn probe_place(&self) -> (f64, f64) {
        let probe = self.scene.probe();
        (probe.radius_m, probe.angle_rad)
    }

    /// Largest distance of the cut surface from the middle plane of the blade at rest, at each speed: the static deflection at
    /// the cut and the amplitudes of all lines there, as if their maxima coincided. `None` where one of them is unknown.
    pub fn board_deviation_m(&self) -> Vec<Option<f64>> {
        let total = |k: usize| {
            let at = |line: &ResponseLine| Some(line.deflections[k]?.at_cut.norm());
            self.lines.iter().map(at).sum()
        };
        (0..self.speeds_rad_per_s.len()).map(total).collect()
    }
}

/// The excitation of a scene, and whether it is assumed because the scene has none.
fn excitation(scene: &Scene) -> (ResponseFile, bool) {
    let typed = scene.file().response.unwrap_or_default();
    match typed.excites() {
        true => (typed, false),
        false => {
            let force_n = const { typical_value("response.force_n") };
            (ResponseFile { force_n, ..typed }, true)
        }
    }
}

/// The refusal of a run-out or of a lack of flatness that is a rigid motion of the blade.
pub(crate) fn rigid(waves: usize, excitation: &ResponseFile) -> RefusedValue {
    let (key, value) = match waves {
        1 => ("response.runout_m", excitation.runout_m),
        _ => ("response.flatness_m", excitation.flatness_m),
    };
    let allowed = "0 for a blade that tilts freely on its arbor";
    let remedy =
        "such a blade has no run-out of its own; give flatness_m, or a mount with a collar";
    RefusedValue::new(key, value, allowed, remedy)
}

/// Speeds within the sweep at which a natural frequency equals the order times the speed.
fn resonances(analysis: &Analysis, order: u32) -> Result<Vec<f64>, SpectrumError> {
    let (from, to) = analysis.range_rad_per_s;
    let mut speeds = match order {
        0 => analysis.critical_rad_per_s(),
        _ => {
            let line = ExcitationLine {
                order,
                tooth_passing: None,
            };
            let found = crossings(&analysis.model, &analysis.chart, &[line])?;
            found.iter().map(|found| found.speed_rad_per_s).collect()
        }
    };
    speeds.retain(|speed| (from..=to).contains(speed));
    speeds.sort_by(f64::total_cmp);
    // Two waves of a free blade, cos nθ and sin nθ, have the same critical speed, which is kept once.
    speeds.dedup_by(|a, b| (*a - *b).abs() <= 1e-9 * *b);
    Ok(speeds)
}

/// Evenly spaced speeds, others near the resonances, and the operating speed.
fn speeds(
    range: (f64, f64),
    resonances: impl Iterator<Item = f64>,
    operating: Option<f64>,
) -> Vec<f64> {
    let from = range.0.max(LEAST * range.1);
    let ratio = (NEAR.1 / NEAR.0).powf(1.0 / (BESIDE - 1) as f64);
    let offsets = (0..BESIDE).map(move |k| NEAR.0 * ratio.powi(k as i32));
    let near = resonances.flat_map(|speed| {
        let beside = offsets.clone();
        let beside = beside.flat_map(move |off| [speed * (1.0 - off), speed * (1.0 + off)]);
        beside.chain([speed])
    });
    let mut speeds = even_speeds((from, range.1), SPEEDS);
    let added = near.chain(operating);
    speeds.extend(added.filter(|speed| (from..=range.1).contains(speed)));
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    speeds
}

/// Matrices of a saw, and the places at which its deflection is read.
pub(crate) struct Solver {
    system: GyroscopicSystem,
    /// Probe, rim at the cut, and places around the rim.
    probes: Vec<Col<f64>>,
    limit_m: f64,
}

impl Solver {
    fn new(plate: &Plate, scene: &Scene) -> Self {
        let (probe, rim) = (scene.probe(), plate.blade.outer_radius_m);
        let angle = |k: usize| std::f64::consts::TAU * k as f64 / AROUND as f64;
        let mut probes = vec![
            at_point(plate, probe.radius_m, probe.angle_rad),
            at_point(plate, rim, scene.cut_angle_rad()),
        ];
        probes.extend((0..AROUND).map(|k| at_point(plate, rim, angle(k))));
        Solver {
            system: GyroscopicSystem::of_plate(plate),
            probes,
            limit_m: linear_limit_m(&plate.blade),
        }
    }

    /// The deflections under a load at some speeds; `None` where the saw is unstable or the linear model is not valid.
    fn deflections(
        &self,
        analysis: &Analysis,
        load: &Load,
        speeds: &[f64],
    ) -> Result<Vec<Option<Deflection>>, SpectrumError> {
        let stable = |speed: &f64| analysis.verdict(*speed).state == StabilityState::Stable;
        let at: Vec<usize> = (0..speeds.len()).filter(|k| stable(&speeds[*k])).collect();
        let states: Vec<State> = at
            .iter()
            .map(|k| State {
                speed_rad_per_s: speeds[*k],
                frequency_rad_per_s: f64::from(load.order) * speeds[*k],
            })
            .collect();
        let largest = speeds.iter().map(|speed| load.factor(*speed));
        let beyond = self.limit_m / largest.fold(f64::MIN_POSITIVE, f64::max);
        let read = readings(&self.system, &load.vector, &states, &self.probes, beyond)?;
        let mut found = vec![None; speeds.len()];
        for (k, read) in at.into_iter().zip(read) {
            found[k] = read.and_then(|read| self.within(&read, load.factor(speeds[k])));
        }
        Ok(found)
    }

    /// The deflection from the readings at the probes; `None` if it is not within the linear model all around the rim.
    fn within(&self, read: &[c64], factor: f64) -> Option<Deflection> {
        let largest = read.iter().map(|w| w.norm()).fold(0.0, f64::max);
        let is_known = read.iter().all(|w| w.re.is_finite() && w.im.is_finite());
        (is_known && factor * largest <= self.limit_m).then(|| Deflection {
            at_probe: factor * read[0],
            at_cut: factor * read[1],
        })
    }
}

#[cfg(test)]
mod tests;
