//! The deflections under a load, and the line of the report that they make.

use std::f64::consts::TAU;

use faer::{Col, c64};

use super::family::{State, readings};
use super::load::Load;
use super::report::{Cause, Resonance, ResponseLine};
use crate::model::plate::Plate;
use crate::model::scene::{Scene, rpm};
use crate::model::system::GyroscopicSystem;
use crate::modes::SpectrumError;
use crate::motion::transient::{at_point, linear_limit_m};
use crate::stability::{Analysis, StabilityState};

/// Complex amplitudes w of deflections w e^{ikΩt}.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Deflection {
    /// Amplitude at the probe, in m.
    at_probe: c64,
    /// Amplitude of the rim at the cut, in m.
    at_cut: c64,
}

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
            at_point(plate, (rim, scene.cut_angle_rad())),
        ];
        probes.extend((0..AROUND).map(|k| at_point(plate, (rim, angle(k)))));
        Solver {
            system: GyroscopicSystem::of_plate(plate),
            probes,
            limit_m: linear_limit_m(&plate.blade),
        }
    }

    /// The response to a load at some speeds, of which `resonances` are some.
    pub fn line(
        &self,
        analysis: &Analysis,
        load: &Load,
        speeds: &[f64],
        resonances: &[f64],
    ) -> Result<ResponseLine, SpectrumError> {
        let deflections = self.deflections(analysis, load, speeds)?;
        let of = |value: fn(&Deflection) -> f64| -> Vec<Option<f64>> {
            let all = deflections.iter();
            all.map(|found| found.as_ref().map(value)).collect()
        };
        let (order, amplitude_m) = (load.order, of(|w| w.at_probe.norm()));
        let resonances = resonances.iter().map(|speed| {
            let place = speeds.partition_point(|other| other < speed);
            Resonance {
                rpm: rpm(*speed),
                frequency_hz: f64::from(order) * speed / TAU,
                amplitude_m: amplitude_m.get(place).copied().flatten(),
            }
        });
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
            resonances: resonances.collect(),
            phase_deg: of(|w| w.at_probe.arg().to_degrees()),
            at_cut_m: of(|w| w.at_cut.norm()),
            amplitude_m,
        })
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
