//! Frequency response between two points at one speed.

use std::f64::consts::TAU;

use faer::{Col, c64};

use super::family::{State, readings};
use super::report::FrequencyResponse;
use super::solver::Solver;
use crate::model::scene::rpm;
use crate::modes::SpectrumError;
use crate::modes::branches::even_speeds;
use crate::stability::{Analysis, StabilityState};

/// Number of evenly spaced frequencies.
const FREQUENCIES: usize = 401;
/// Distances of added frequencies from a natural frequency, relative to it.
const BESIDE: [f64; 9] = [1e-5, 1e-4, 3e-4, 1e-3, 2e-3, 4e-3, 8e-3, 1.5e-2, 3e-2];
/// Force in N at the resonance of an undamped mode: where the linear model is not valid even for this force, the deflection
/// grows without bound.
const UNBOUNDED_N: f64 = 1e-2;

impl FrequencyResponse {
    /// Computes the response at a speed in rad/s, up to a frequency in Hz, to a force at a radius and an angle.
    ///
    /// # Errors
    /// [`SpectrumError`].
    pub(super) fn new(
        analysis: &Analysis,
        solver: &Solver,
        (speed, to_hz): (f64, Option<f64>),
        (radius_m, angle_rad): (f64, f64),
    ) -> Result<Self, SpectrumError> {
        let model = &analysis.model;
        let end = to_hz.map_or(model.complete_to_rad_per_s, |hz| TAU * hz);
        let mut frequencies = even_speeds((0.0, end), FREQUENCIES);
        for mode in model.modes(speed)? {
            let natural = mode.frequency_rad_per_s();
            let beside = BESIDE.iter().flat_map(|off| [1.0 - off, 1.0 + off]);
            frequencies.extend(beside.chain([1.0]).map(|share| share * natural));
        }
        frequencies.retain(|frequency| (0.0..=end).contains(frequency));
        frequencies.sort_by(f64::total_cmp);
        frequencies.dedup();
        let is_stable = analysis.verdict(speed).state == StabilityState::Stable;
        let values = model.plate.functions_at(radius_m, angle_rad);
        let load = Col::from_fn(values.len(), |i| c64::new(values[i], 0.0));
        let states: Vec<State> = frequencies
            .iter()
            .map(|frequency| State {
                speed_rad_per_s: speed,
                frequency_rad_per_s: *frequency,
            })
            .collect();
        let beyond = solver.limit_m / UNBOUNDED_N;
        let receptance: Vec<Option<c64>> = match is_stable {
            true => readings(&solver.system, &load, &states, &solver.probes[..1], beyond)?
                .into_iter()
                .map(|read| Some(*read?.first()?).filter(|w| w.norm() <= beyond))
                .collect(),
            false => vec![None; states.len()],
        };
        let of = |value: fn(&c64) -> f64| receptance.iter().map(move |w| w.as_ref().map(value));
        Ok(FrequencyResponse {
            rpm: rpm(speed),
            force_radius_m: radius_m,
            force_angle_deg: angle_rad.to_degrees(),
            frequency_hz: frequencies.iter().map(|omega| omega / TAU).collect(),
            receptance_m_per_n: of(|w| w.norm()).collect(),
            phase_deg: of(|w| w.arg().to_degrees()).collect(),
        })
    }
}
