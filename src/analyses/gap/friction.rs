//! Heat of friction at the pads, and its effect on the deflection of the blade.
//!
//! A pad that presses with N on the blade at a radius r, with a coefficient of friction μ, has the power μ N Ω r. A share of
//! the power enters the blade and heats it along a circle. The temperature over the radius changes the stress in the plane, thus
//! the deflection under the side force and the forces of the pads: the loop is repeated until the temperature no longer
//! changes. The effect of the force of friction on the motion is neglected.

use crate::model::scene::{
    self, FrictionFile, Guide, Scene, TemperatureFile, TemperatureRow, rad_per_s, typical_value,
};
use crate::modes::{SpectrumError, Work};
use crate::motion::stretched::StretchedError;
use crate::stability::Analysis;

use super::GapError;
use super::deviation::MODES;
use super::heated_disk::{Cooling, radii_m, rises_k};
use super::numbers::first_critical_of_linear;
use super::pressed::{Deviation, PressedBlade};
use super::report::{FrictionHeat, FrictionPad};

/// Coefficient of linear thermal expansion of steel.
const STEEL_EXPANSION_PER_K: f64 = typical_value("membrane.temperature.expansion_per_k");
/// Relative change of the temperature at which the loop ends.
const CONVERGED: f64 = 1e-4;
/// Number of repetitions after which the loop ends without convergence.
const MOST: usize = 25;
/// Temperature rise beyond which the loop ends, because no blade survives it.
const RUNAWAY_K: f64 = 1000.0;

/// The heat of friction.
pub(super) struct Heated {
    pub heat: FrictionHeat,
    /// Whether the heat of friction buckles the blade at rest with its guides in contact.
    pub buckles: bool,
}

impl Heated {
    /// Repeats the loop of friction and deflection.
    ///
    /// # Errors
    /// [`GapError`].
    pub fn new(analysis: &Analysis, friction: FrictionFile, rpm: f64) -> Result<Self, GapError> {
        let scene = &analysis.scene;
        let resolution = analysis.model.plate.resolution;
        let radii_m = radii_m(scene.blade());
        let own = scene
            .membrane()
            .and_then(|membrane| membrane.temperature.as_ref());
        let expansion_per_k = own.map_or(STEEL_EXPANSION_PER_K, |own| own.expansion_per_k);
        let own_k = |r: f64| own.map_or(0.0, |own| own.rise_k(scene.blade(), r));
        let cooling = Cooling {
            conductivity_w_per_m_k: friction.conductivity_w_per_m_k,
            convection_w_per_m2_k: friction.convection_w_per_m2_k,
        };
        let mut heat = FrictionHeat {
            coefficient: friction.coefficient,
            heat_share: friction.heat_share,
            convection_w_per_m2_k: friction.convection_w_per_m2_k,
            conductivity_w_per_m_k: friction.conductivity_w_per_m_k,
            expansion_per_k,
            power_w: 0.0,
            rise_k: vec![0.0; radii_m.len()],
            radii_m,
            cold_deflection_m: None,
            deflection_m: None,
            pad_forces_n: Vec::new(),
            pads: Vec::new(),
            cold_critical_rpm: first_critical_of_linear(scene, resolution)?.map(scene::rpm),
            critical_rpm: None,
            settled: false,
            change: f64::INFINITY,
            repetitions: 0,
        };
        let work = Work::of("friction", MOST);
        let mut warm = scene.clone();
        let mut hot = None;
        while !heat.settled && heat.repetitions < MOST {
            let pressed = PressedBlade::new(&warm, resolution, rpm, MODES);
            let Some(blade) = unless_buckled(pressed)? else {
                break;
            };
            let (deviation, contacts) = blade.with_contacts(scene.file().side_force_n(), rpm)?;
            hot = deviation;
            heat.deflection_m = hot.as_ref().map(|at| at.deviation_m);
            if heat.repetitions == 0 {
                heat.cold_deflection_m = heat.deflection_m;
            }
            let powers = contacts.into_iter().map(|(radius_m, force_n)| {
                (
                    radius_m,
                    friction.coefficient * force_n * rad_per_s(rpm) * radius_m,
                )
            });
            let powers: Vec<(f64, f64)> = powers.collect();
            heat.power_w = powers.iter().map(|(_, power_w)| power_w).sum();
            let into_blade = powers
                .iter()
                .map(|(r, power_w)| (*r, friction.heat_share * power_w));
            let rise_k = rises_k(scene.blade(), &cooling, &into_blade.collect::<Vec<_>>());
            let pairs = rise_k.iter().zip(&heat.rise_k);
            let change_k = pairs
                .map(|(new, old)| (new - old).abs())
                .fold(0.0, f64::max);
            let peak_k = rise_k.iter().copied().fold(0.0, f64::max);
            heat.change = if peak_k > 0.0 { change_k / peak_k } else { 0.0 };
            heat.settled = heat.change <= CONVERGED;
            heat.rise_k = rise_k;
            heat.repetitions += 1;
            work.advance();
            if hot.is_none() || peak_k > RUNAWAY_K {
                break;
            }
            let rows = heat.radii_m.iter().zip(&heat.rise_k);
            let table = rows.map(|(radius_m, rise_k)| TemperatureRow {
                radius_m: *radius_m,
                rise_k: rise_k + own_k(*radius_m),
            });
            warm = heated(scene, expansion_per_k, table.collect())?;
        }
        let critical = unless_buckled(first_critical_of_linear(&warm, resolution))?;
        heat.pads = pads(scene, hot.as_ref());
        heat.pad_forces_n = hot.map_or_else(Vec::new, |at| at.pad_forces_n);
        heat.critical_rpm = critical.flatten().map(scene::rpm);
        Ok(Heated {
            heat,
            buckles: critical.is_none(),
        })
    }

    /// Remark on the validity of the numbers.
    pub fn warning(&self) -> Option<&'static str> {
        if self.buckles {
            return Some(
                "the heat of friction buckles the blade at rest: the deflection is that of the last repetition before, and there is no critical speed",
            );
        }
        (!self.heat.settled).then_some(
            "the temperature of friction does not settle: heat, deflection and pad forces raise each other, and the numbers of friction are those of the last repetition",
        )
    }
}

/// The one-sided pads beside the heated blade.
fn pads(scene: &Scene, hot: Option<&Deviation>) -> Vec<FrictionPad> {
    let blade = scene.blade();
    let lifting = scene.guides().iter().filter(|pad| pad.lifting.is_some());
    let entry = |(place, pad): (usize, &Guide)| {
        let (from_m, to_m) = pad.typed.reach_m();
        FrictionPad {
            guide: pad.index,
            from_radius_m: from_m.max(blade.inner_radius_m),
            to_radius_m: to_m.min(blade.outer_radius_m),
            gap_left_m: hot.and_then(|at| at.distances_left_m.get(place).copied()),
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
