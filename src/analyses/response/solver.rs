//! The deflections under a load, and the line of the report that they make.

use std::f64::consts::TAU;

use faer::{Col, c64};

use super::report::{Resonance, ResponseLine, SteadyState};
use crate::model::plate::Plate;
use crate::model::scene::{Polar, Scene, SpeedRange, rpm};
use crate::model::system::GyroscopicSystem;
use crate::modes::SpectrumError;
use crate::motion::steady::{Cause, Family, Load, State};
use crate::motion::transient::{at_point, linear_limit_m};
use crate::stability::Analysis;

/// Whether motions of a saw grow, and whether anything dissipates their energy.
pub(super) struct Motion<'a>(pub &'a Analysis);

impl Motion<'_> {
    /// Whether a pole is real: nothing dissipates the energy of its motion. A damper that is fixed in space, for example, does not act on a
    /// motion that stands still.
    pub fn is_undamped(&self, (place, off): (f64, f64)) -> bool {
        self.0.model.is_conservative() || off <= REAL * place
    }

    /// Whether the saw is unstable at a speed by its verdict: then no state is steady. At the ends of a band nothing grows.
    pub fn is_unstable(&self, speed: f64) -> bool {
        let mut bands = self.0.chart.instabilities.iter();
        let is_inside = bands.any(|band| {
            band.from_rad_per_s * (1.0 + END) < speed && speed < band.to_rad_per_s * (1.0 - END)
        });
        is_inside && self.0.verdict(speed).band.is_some()
    }
}

/// Complex amplitudes w of deflections w e^{ikΩt}.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Deflection {
    /// Amplitude at the probe, in m.
    at_probe: c64,
    /// Amplitude of the rim at the cut, in m.
    at_cut: c64,
}

/// Relative error of the ends of bands and of resonances.
const END: f64 = 1e-6;
/// Relative distance of a pole from a real place below which it is real: rounding errors of the basis are smaller.
const REAL: f64 = 1e-9;
/// Speed of slow rotation, as a share of the last speed.
const LEAST: f64 = 1e-6;
/// Places around the rim at which the deflection is compared with the linear limit.
const AROUND: usize = 48;

/// Matrices of a saw, and the places at which its deflection is read.
pub(super) struct Solver {
    pub system: GyroscopicSystem,
    /// Probe, rim at the cut, and places around the rim.
    pub probes: Vec<Col<f64>>,
    pub limit_m: f64,
}

impl Solver {
    pub fn new(plate: &Plate, scene: &Scene) -> Self {
        let (probe, rim) = (scene.probe(), plate.blade.outer_radius_m);
        let angle = |k: usize| TAU * k as f64 / AROUND as f64;
        let mut probes = vec![
            at_point(plate, probe.polar()),
            at_point(plate, Polar::new(rim, scene.cut_angle_rad())),
        ];
        probes.extend((0..AROUND).map(|k| at_point(plate, Polar::new(rim, angle(k)))));
        Solver {
            system: GyroscopicSystem::of_plate(plate),
            probes,
            limit_m: linear_limit_m(&plate.blade),
        }
    }

    /// The deflections of a family of states under a load at some speeds, in stable motion or not; `None` where the linear model is
    /// not valid.
    pub fn deflections(
        &self,
        family: &mut Family<'_>,
        load: &Load,
        speeds: &[f64],
    ) -> Result<Vec<Option<Deflection>>, SpectrumError> {
        let last = speeds.last().copied().unwrap_or_default();
        let states = speeds.iter().map(|speed| {
            // A load of any order turns slowly with a blade at rest, so that free rigid motions do not follow it.
            let speed = speed.max(LEAST * last);
            State {
                speed_rad_per_s: speed,
                frequency_rad_per_s: f64::from(load.order) * speed,
            }
        });
        let states: Vec<State> = states.collect();
        let largest = speeds.iter().map(|speed| load.factor(*speed));
        let beyond = self.limit_m / largest.fold(f64::MIN_POSITIVE, f64::max);
        let read = family.readings(&states, &self.probes, beyond)?;
        let pairs = read.into_iter().zip(speeds);
        let found = pairs.map(|(read, speed)| self.within(&read?, load.factor(*speed)));
        Ok(found.collect())
    }

    /// Resonances of a load between two speeds, ascending, each with its distance from real speeds.
    pub fn resonances(
        family: &Family<'_>,
        load: &Load,
        range: SpeedRange,
    ) -> Result<Vec<(f64, f64)>, SpectrumError> {
        let order = c64::new(0.0, f64::from(load.order));
        family.poles(range.ends(), |speed| (speed, order * speed))
    }

    /// The response to a load at some speeds, of which `resonances` are some.
    pub fn line(
        &self,
        load: &Load,
        family: &mut Family<'_>,
        speeds: &[f64],
        resonances: &[(f64, f64)],
        motion: &Motion<'_>,
    ) -> Result<ResponseLine, SpectrumError> {
        let mut deflections = self.deflections(family, load, speeds)?;
        let order = load.order;
        let resonances = resonances
            .iter()
            .map(|(speed, off)| {
                let place = speeds.partition_point(|other| other < speed);
                let steady_state = match deflections[place] {
                    _ if motion.is_unstable(*speed) => SteadyState::None,
                    _ if motion.is_undamped((*speed, *off)) => SteadyState::Unbounded,
                    Some(_) => SteadyState::Bounded,
                    None => SteadyState::BeyondModel,
                };
                if steady_state != SteadyState::Bounded {
                    deflections[place] = None;
                }
                Resonance {
                    rpm: rpm(*speed),
                    frequency_hz: f64::from(order) * speed / TAU,
                    amplitude_m: deflections[place].map(|found| found.at_probe.norm()),
                    steady_state,
                }
            })
            .collect();
        for (found, speed) in deflections.iter_mut().zip(speeds) {
            found.take_if(|_| motion.is_unstable(*speed));
        }
        let of = |value: fn(&Deflection) -> f64| -> Vec<Option<f64>> {
            let all = deflections.iter();
            all.map(|found| found.as_ref().map(value)).collect()
        };
        Ok(ResponseLine {
            cause: load.cause,
            order,
            name: match load.cause {
                Cause::SideForce => "side force, static".to_owned(),
                Cause::RunOut => format!("run-out, {order}×"),
                Cause::Flatness => format!("flatness, {order}×"),
                Cause::Imbalance => format!("imbalance, {order}×"),
                Cause::OscillatingForce => format!("side force, {order}×"),
            },
            resonances,
            resonance_error: None,
            phase_deg: of(|w| w.at_probe.arg().to_degrees()),
            at_cut_m: of(|w| w.at_cut.norm()),
            amplitude_m: of(|w| w.at_probe.norm()),
        })
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
