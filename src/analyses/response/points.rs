//! Frequency response between two points at one speed.

use std::f64::consts::TAU;

use faer::{Col, c64};

use super::report::FrequencyResponse;
use super::solver::{Motion, Solver};
use crate::model::evenly_spaced;
use crate::model::plate::Plate;
use crate::model::scene::{Point, rpm};
use crate::modes::SpectrumError;
use crate::motion::steady::{Family, State};

/// Number of evenly spaced frequencies.
const FREQUENCIES: usize = 401;
/// Distances of added frequencies from a natural frequency, relative to it.
const BESIDE: [f64; 9] = [1e-5, 1e-4, 3e-4, 1e-3, 2e-3, 4e-3, 8e-3, 1.5e-2, 3e-2];
/// Force in N at the resonance of an undamped mode: where the linear model is not valid even for this force, the deflection
/// grows without bound.
const UNBOUNDED_N: f64 = 1e-2;

impl FrequencyResponse {
    /// Computes the response at a speed, up to a frequency, both in rad/s, to a force at a point.
    ///
    /// # Errors
    /// [`SpectrumError`].
    pub(super) fn new(
        plate: &Plate,
        solver: &Solver,
        motion: &Motion<'_>,
        speed: f64,
        end: f64,
        place: Point,
    ) -> Result<Self, SpectrumError> {
        let values = plate.functions_at(place.radius_m, place.polar().angle_rad);
        let load = Col::from_fn(values.len(), |i| c64::new(values[i], 0.0));
        let mut frequencies = evenly_spaced([0.0, end], FREQUENCIES);
        let (mut receptance, mut unbounded) = (Vec::new(), Vec::new());
        if !motion.is_unstable(speed) {
            let mut family = Family::new(&solver.system, &load)?;
            let read = |family: &mut Family<'_>, frequencies: &[f64]| {
                let states = frequencies.iter().map(|frequency| State {
                    speed_rad_per_s: speed,
                    frequency_rad_per_s: *frequency,
                });
                let beyond = solver.limit_m / UNBOUNDED_N;
                let read =
                    family.readings(&states.collect::<Vec<_>>(), &solver.probes[..1], beyond)?;
                let read = read.into_iter();
                let read = read.map(|read| Some(*read?.first()?).filter(|w| w.norm() <= beyond));
                Ok::<Vec<Option<c64>>, SpectrumError>(read.collect())
            };
            read(&mut family, &frequencies)?;
            let path = |frequency| (c64::new(speed, 0.0), c64::new(0.0, 1.0) * frequency);
            let poles = family.poles([0.0, end], path)?;
            for (natural, _) in &poles {
                let beside = BESIDE.iter().flat_map(|off| [1.0 - off, 1.0 + off]);
                frequencies.extend(beside.chain([1.0]).map(|share| share * natural));
            }
            frequencies.retain(|frequency| (0.0..=end).contains(frequency));
            frequencies.sort_by(f64::total_cmp);
            frequencies.dedup();
            receptance = read(&mut family, &frequencies)?;
            let real = poles.into_iter().filter(|pole| motion.is_undamped(*pole));
            unbounded = real.map(|(natural, _)| natural).collect();
        }
        receptance.resize(frequencies.len(), None);
        for natural in &unbounded {
            receptance[frequencies.partition_point(|other| other < natural)] = None;
        }
        let of = |value: fn(&c64) -> f64| receptance.iter().map(move |w| w.as_ref().map(value));
        Ok(FrequencyResponse {
            rpm: rpm(speed),
            force_radius_m: place.radius_m,
            force_angle_deg: place.angle_deg,
            frequency_hz: frequencies.iter().map(|omega| omega / TAU).collect(),
            receptance_m_per_n: of(|w| w.norm()).collect(),
            phase_deg: of(|w| w.arg().to_degrees()).collect(),
            unbounded_hz: unbounded.iter().map(|omega| omega / TAU).collect(),
        })
    }
}
