//! Heat of friction at the pads, and its effect on the deflection of the blade.
//!
//! A pad that presses with N on the blade at a radius r, with a coefficient of friction μ, has the power μ N Ω r. A share of
//! the power enters the blade and heats it along a circle. The temperature over the radius changes the stress in the plane, thus
//! the deflection under the side force and the forces of the pads: the loop is repeated until the temperature no longer
//! changes, or it is known that it cannot settle. All numbers are those of the settled temperature. The effect of the force of friction on the
//! motion is neglected.

use std::sync::Arc;

use crate::model::plate::heated_disk::{Cooling, radii_m, rises_k};
use crate::model::plate::{Plate, Stretching};
use crate::model::scene;
use crate::model::scene::{
    FrictionFile, Guide, Scene, TemperatureFile, TemperatureRow, rad_per_s, typical_value,
};
use crate::modes::{SpectrumError, Work};
use crate::motion::stretched_blade::{Deviation, PressedBlade, StretchedError};
use crate::page::text::shown_to;
use crate::stability::Analysis;

use super::critical_speed::first_critical_of_linear;
use super::deviation::MODES;
use super::error::GapError;
use super::report::{FrictionHeat, FrictionPad};
use super::settling::{End, MOST, Settling, settled};

/// Coefficient of linear thermal expansion of steel.
const STEEL_EXPANSION_PER_K: f64 = typical_value("membrane.temperature.expansion_per_k");
/// Temperature rise beyond which the loop ends, because no blade survives it.
const RUNAWAY_K: f64 = 1000.0;
/// Number of times that the search for the speed from which heat runs away halves its interval.
const HALVINGS: usize = 7;

/// The loop of friction and deflection of a saw.
struct Loop<'a> {
    analysis: &'a Analysis,
    friction: FrictionFile,
    radii_m: Vec<f64>,
    expansion_per_k: f64,
    /// Potential of stretching, which the heat does not change.
    stretching: Arc<Stretching>,
}

/// A blade with a temperature.
struct State {
    deviation: Deviation,
    power_w: f64,
}

/// A heated blade, and the end of the loop.
struct Ended {
    settling: Settling,
    /// The states without heat, and with the temperature of the loop; `None` if the model is not valid.
    cold: Option<State>,
    hot: Option<State>,
}

impl Loop<'_> {
    /// Repeats the loop at a speed until the temperature settles or cannot.
    fn at(&self, rpm: f64) -> Result<Ended, GapError> {
        let scene = &self.analysis.scene;
        let (mut cold, mut hot) = (None, None);
        let work = Work::of("friction", MOST);
        let settling = settled(vec![0.0; self.radii_m.len()], RUNAWAY_K, |rise_k| {
            let warm = self.warm(rise_k)?;
            let plate = Plate::new(&warm, self.analysis.model.plate.resolution);
            let stretching = Arc::clone(&self.stretching);
            let pressed = PressedBlade::stretched(&warm, &plate, (rpm, MODES), stretching);
            // A blade that its heat buckles at rest is refused as a scene, too.
            let Some(blade) = unless_buckled(pressed.map_err(GapError::from))? else {
                return Ok(None);
            };
            let (deviation, contacts) =
                blade.with_contacts(scene.constant_force_at(rpm).force_n, rpm)?;
            work.advance();
            let Some(deviation) = deviation else {
                return Ok(None);
            };
            let friction = &self.friction;
            let powers: Vec<(f64, f64)> = contacts
                .into_iter()
                .map(|(radius_m, force_n)| {
                    let power_w = friction.coefficient * force_n * rad_per_s(rpm) * radius_m;
                    (radius_m, power_w)
                })
                .collect();
            let into_blade = powers
                .iter()
                .map(|(r, power_w)| (*r, friction.heat_share * power_w));
            let cooling = Cooling {
                conductivity_w_per_m_k: friction.conductivity_w_per_m_k,
                convection_w_per_m2_k: friction.convection_w_per_m2_k,
            };
            let rises_k = rises_k(scene.blade(), &cooling, &into_blade.collect::<Vec<_>>());
            let state = State {
                deviation,
                power_w: powers.iter().map(|(_, power_w)| power_w).sum(),
            };
            if rise_k.iter().all(|rise_k| *rise_k == 0.0) {
                cold = Some(state)
            } else {
                hot = Some(state)
            }
            Ok::<_, GapError>(Some(rises_k))
        })?;
        Ok(Ended {
            settling,
            cold,
            hot,
        })
    }

    /// The scene with temperature rises at the radii of the loop, in addition to its own.
    fn warm(&self, rise_k: &[f64]) -> Result<Scene, GapError> {
        let scene = &self.analysis.scene;
        let own = scene
            .membrane()
            .and_then(|membrane| membrane.temperature.as_ref());
        let own_k = |r: f64| own.map_or(0.0, |own| own.rise_k(scene.blade(), r));
        let rows = self
            .radii_m
            .iter()
            .zip(rise_k)
            .map(|(radius_m, rise_k)| TemperatureRow {
                radius_m: *radius_m,
                rise_k: rise_k + own_k(*radius_m),
            });
        heated(scene, self.expansion_per_k, rows.collect())
    }

    /// The speed in rpm from which the heat runs away, below one at which it does.
    fn runaway_rpm(&self, rpm: f64) -> Result<f64, GapError> {
        let (mut low, mut high) = (0.0, rpm);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            match self.at(middle)?.settling.end {
                End::RunsAway | End::NoAnswer => high = middle,
                End::Settled | End::Swings => low = middle,
            }
        }
        Ok(high)
    }
}

impl FrictionHeat {
    /// Repeats the loop of friction and deflection.
    ///
    /// # Errors
    /// [`GapError`].
    pub(super) fn new(
        analysis: &Analysis,
        friction: FrictionFile,
        rpm: f64,
    ) -> Result<Self, GapError> {
        let scene = &analysis.scene;
        let resolution = analysis.model.plate.resolution;
        let membrane = scene.membrane();
        let own = membrane.and_then(|membrane| membrane.temperature.as_ref());
        let plate = &analysis.model.plate;
        let cycle = Loop {
            stretching: Arc::new(Stretching::new(plate).map_err(StretchedError::from)?),
            analysis,
            friction,
            radii_m: radii_m(scene.blade()),
            expansion_per_k: own.map_or(STEEL_EXPANSION_PER_K, |own| own.expansion_per_k),
        };
        let Ended {
            settling,
            cold,
            hot,
        } = cycle.at(rpm)?;
        let end = settling.end;
        let critical = if end == End::Settled {
            let warm = cycle.warm(&settling.value)?;
            unless_buckled(first_critical_of_linear(&warm, resolution))?.flatten()
        } else {
            None
        };
        let runaway_rpm = match end {
            End::RunsAway | End::NoAnswer if cold.is_some() => Some(cycle.runaway_rpm(rpm)?),
            _ => None,
        };
        let cold_deflection_m = cold.as_ref().map(|state| state.deviation.deviation_m);
        let hot = hot.or(cold).filter(|_| end == End::Settled);
        let deviation = hot.as_ref().map(|state| &state.deviation);
        Ok(FrictionHeat {
            coefficient: friction.coefficient,
            heat_share: friction.heat_share,
            convection_w_per_m2_k: friction.convection_w_per_m2_k,
            conductivity_w_per_m_k: friction.conductivity_w_per_m_k,
            expansion_per_k: cycle.expansion_per_k,
            power_w: hot.as_ref().map(|state| state.power_w),
            radii_m: cycle.radii_m,
            rise_k: match end {
                End::Settled => settling.value,
                _ => Vec::new(),
            },
            cold_deflection_m,
            deflection_m: deviation.map(|at| at.deviation_m),
            pads: pads(scene, deviation),
            pad_forces_n: deviation.map_or_else(Vec::new, |at| at.pad_forces_n.clone()),
            cold_first_critical_rpm: first_critical_of_linear(scene, resolution)?.map(scene::rpm),
            first_critical_rpm: critical.map(scene::rpm),
            settled: end == End::Settled,
            swings: end == End::Swings,
            runaway_rpm,
            change: settling.change,
            repetitions: settling.repetitions,
        })
    }

    /// Reason for which the blade has no steady state under the heat of friction; `None` if it has one.
    pub(super) fn unsettled(&self) -> Option<String> {
        if self.settled {
            return None;
        }
        Some(match self.runaway_rpm {
            Some(rpm) => format!(
                "the heat of friction runs away from {} rpm on: heat, deflection and pad forces raise each other, or the heat buckles the \
                 blade",
                shown_to(3, rpm)
            ),
            None if self.swings => {
                "the temperature of friction swings between two states, because a pad touches the blade only while it is cold, or only while \
                 it is hot"
                    .to_owned()
            }
            None => {
                "the model of the blade between its pads is not valid under this force".to_owned()
            }
        })
    }
}

/// The one-sided pads beside the heated blade.
fn pads(scene: &Scene, hot: Option<&Deviation>) -> Vec<FrictionPad> {
    let blade = scene.blade();
    let lifting = scene.guides().iter().filter(|pad| pad.lifting.is_some());
    let entry = |(place, pad): (usize, &Guide)| {
        let [from_m, to_m] = pad.typed.reach_m();
        FrictionPad {
            guide: pad.index,
            from_radius_m: from_m.max(blade.inner_radius_m),
            to_radius_m: to_m.min(blade.outer_radius_m),
            gap_left_m: hot.and_then(|at| at.distances_left_m.get(place).copied()),
            face_forces_n: hot.and_then(|at| at.face_forces_n.get(place).copied()),
        }
    };
    lifting.enumerate().map(entry).collect()
}

/// Replaces the error that the blade is not stable at rest by `None`.
fn unless_buckled<T>(found: Result<T, GapError>) -> Result<Option<T>, GapError> {
    use SpectrumError::{Buckled, UnstableAtRest};
    match found {
        Err(
            GapError::Spectrum(Buckled { .. } | UnstableAtRest { .. })
            | GapError::Stretched(StretchedError::Spectrum(Buckled { .. } | UnstableAtRest { .. })),
        ) => Ok(None),
        found => found.map(Some),
    }
}

/// The scene with a table of temperature rises in place of its own temperature.
fn heated(
    scene: &Scene,
    expansion_per_k: f64,
    table: Vec<TemperatureRow>,
) -> Result<Scene, GapError> {
    Ok(scene.edited(|file| {
        let membrane = file.membrane.get_or_insert_default();
        membrane.temperature = Some(TemperatureFile {
            expansion_per_k,
            rim_rise_k: None,
            from_radius_m: None,
            exponent: None,
            table,
        });
    })?)
}
