//! Membrane stress from manufacture and from operation: heat, roll tension, measured residual stress.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::profile::Profile;
use super::residual::{ResidualStress, ResidualStressRow};
use super::roll_band::{RollBand, RollBandFile};
use super::rule::{ascending, few, refuse};
use super::straight_edge::{StraightEdge, StraightEdgeFile};
use super::{Blade, RefusedValue, SceneError};
use crate::page::text::shown;

/// Axisymmetric stress in the plane of the blade. Missing parts are zero.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MembraneFile {
    /// Heat of the cut and of guides.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub temperature: Option<TemperatureFile>,
    /// Rolled bands.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub roll_tension: Vec<RollBandFile>,
    /// Measured residual stress at ascending radii: linear between the rows, constant beyond them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub residual_stress: Vec<ResidualStressRow>,
    /// Straight edge across the blade off its machine, under which the rolled bands cause a light gap. None by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub straight_edge: Option<StraightEdgeFile>,
}

/// Temperature over the radius, relative to that of the unstressed blade (for a fixed collar, that of the
/// collar): either a rise at the rim with its shape, or a table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TemperatureFile {
    /// Coefficient of linear thermal expansion; steel: 1.2e-5.
    pub expansion_per_k: f64,
    /// Rise at the rim, required unless `table` is given: T(r) = rise · ((r − r₀)/(b − r₀))^p for r > r₀, zero inside.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rim_rise_k: Option<f64>,
    /// Radius r₀ at which the rise begins; by default the bore, or the edge of the collar.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from_radius_m: Option<f64>,
    /// Exponent p of the rise; 1 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub exponent: Option<f64>,
    /// Rises at ascending radii, linear between the rows and constant beyond them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub table: Vec<TemperatureRow>,
}

/// Temperature at one radius.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TemperatureRow {
    /// Distance from the axis.
    pub radius_m: f64,
    /// Temperature above that of the unstressed blade.
    pub rise_k: f64,
}

/// Validated membrane stress.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Membrane {
    /// Temperature rise over the radius.
    pub temperature: Option<Temperature>,
    /// Rolled bands.
    pub roll_tension: Vec<RollBand>,
    /// Measured residual stress.
    pub residual_stress: Option<ResidualStress>,
    /// Straight edge across the blade.
    pub straight_edge: Option<StraightEdge>,
}

/// Validated temperature, T(r) = peak · shape(r).
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Temperature {
    /// Coefficient of linear thermal expansion α.
    pub expansion_per_k: f64,
    /// Temperature rise of largest magnitude on the blade; for [`TemperatureShape::Rim`], that of the rim.
    pub peak_rise_k: f64,
    /// Ratio of the rise to its peak, over the radius.
    pub shape: TemperatureShape,
}

/// Ratio of the temperature rise to its peak.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum TemperatureShape {
    /// Ratio ((r − r₀)/(b − r₀))^p beyond r₀, zero inside it.
    Rim {
        /// Radius r₀ at which the rise begins.
        from_radius_m: f64,
        /// Exponent p.
        exponent: f64,
    },
    /// Ratio by a table, divided by its peak.
    Table(Profile),
}

/// Smallest peak of a table other than zero. No thermometer resolves a smaller rise.
const MIN_RISE_K: f64 = 1e-9;

impl Membrane {
    /// The stress of rolled bands alone.
    pub fn of_bands(bands: &[RollBand]) -> Self {
        Membrane {
            temperature: None,
            roll_tension: bands.to_vec(),
            residual_stress: None,
            straight_edge: None,
        }
    }

    pub(super) fn new(
        typed: &MembraneFile,
        blade: &Blade,
        bore_radius_m: f64,
    ) -> Result<Self, SceneError> {
        let bands = typed.roll_tension.iter().enumerate();
        few("membrane.roll_tension", typed.roll_tension.len())?;
        let roll_tension = bands
            .map(|(index, band)| RollBand::new(index, band, blade))
            .collect::<Result<Vec<_>, _>>()?;
        let straight_edge = typed
            .straight_edge
            .as_ref()
            .map(|edge| StraightEdge::new(edge, blade, bore_radius_m, &roll_tension))
            .transpose()?;
        Ok(Membrane {
            temperature: typed
                .temperature
                .as_ref()
                .map(|temperature| Temperature::new(temperature, blade))
                .transpose()?,
            roll_tension,
            residual_stress: ResidualStress::new(&typed.residual_stress, blade)?,
            straight_edge,
        })
    }
}

impl Temperature {
    fn new(typed: &TemperatureFile, blade: &Blade) -> Result<Self, SceneError> {
        let has_table = !typed.table.is_empty();
        if typed.rim_rise_k.is_some() == has_table {
            let given = if has_table {
                "given by rim_rise_k and by table"
            } else {
                "without rim_rise_k and table"
            };
            let remedy = "give rim_rise_k (with from_radius_m and exponent) or a table";
            let allowed = "given by one of the two";
            return Err(RefusedValue::new("membrane.temperature", given, allowed, remedy).into());
        }
        match typed.rim_rise_k {
            Some(peak_rise_k) => Ok(Temperature {
                expansion_per_k: typed.expansion_per_k,
                peak_rise_k,
                shape: rim_shape(typed, blade)?,
            }),
            None => table(typed, blade),
        }
    }

    /// Temperature rise at a radius, in K.
    pub fn rise_k(&self, blade: &Blade, radius_m: f64) -> f64 {
        match &self.shape {
            TemperatureShape::Table(profile) => self.peak_rise_k * profile.at(radius_m),
            TemperatureShape::Rim {
                from_radius_m,
                exponent,
            } => {
                let width = blade.outer_radius_m - from_radius_m;
                let share = (radius_m - from_radius_m) / width;
                if share < 0.0 {
                    0.0
                } else {
                    self.peak_rise_k * share.powf(*exponent)
                }
            }
        }
    }
}

fn rim_shape(typed: &TemperatureFile, blade: &Blade) -> Result<TemperatureShape, SceneError> {
    let from_radius_m = typed.from_radius_m.unwrap_or(blade.inner_radius_m);
    let outer = blade.outer_radius_m;
    // A rise that begins beyond 0.999 of the radius of the rim would be nearly a jump.
    if from_radius_m > 0.999 * outer {
        let allowed = format!(
            "from 0 to 0.999 of the radius of the rim ({})",
            shown(outer)
        );
        let remedy = "the rise begins there and ends at the rim";
        let key = "membrane.temperature.from_radius_m";
        return Err(refuse(key, from_radius_m, allowed, remedy));
    }
    Ok(TemperatureShape::Rim {
        from_radius_m,
        exponent: typed.exponent.unwrap_or(1.0),
    })
}

fn table(typed: &TemperatureFile, blade: &Blade) -> Result<Temperature, SceneError> {
    let key = "membrane.temperature.table";
    for (name, given) in [
        ("from_radius_m", typed.from_radius_m),
        ("exponent", typed.exponent),
    ] {
        if let Some(value) = given {
            let key = format!("membrane.temperature.{name}");
            let remedy = "it shapes rim_rise_k; leave it out beside a table";
            return Err(refuse(&key, value, "left out", remedy));
        }
    }
    few(key, typed.table.len())?;
    let radii: Vec<f64> = typed.table.iter().map(|row| row.radius_m).collect();
    ascending(key, &radii, blade.outer_radius_m)?;
    let mut rows: Vec<[f64; 2]> = typed
        .table
        .iter()
        .map(|row| [row.radius_m, row.rise_k])
        .collect();
    let typed_peak = Profile::new(&rows).map_or(0.0, |profile| {
        profile.peak(blade.inner_radius_m, blade.outer_radius_m)
    });
    // Division by a peak far below `MIN_RISE_K` could overflow, so a peak below this limit is taken as zero.
    let peak = if typed_peak.abs() < MIN_RISE_K {
        0.0
    } else {
        typed_peak
    };
    let share = if peak == 0.0 { 0.0 } else { 1.0 / peak };
    rows.iter_mut().for_each(|[_, rise]| *rise *= share);
    let profile = Profile::new(&rows).expect("a table that is not empty has rows");
    Ok(Temperature {
        expansion_per_k: typed.expansion_per_k,
        peak_rise_k: peak,
        shape: TemperatureShape::Table(profile),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::{Scene, SceneFile};

    fn scene(membrane: &str) -> Result<Scene, SceneError> {
        Scene::try_from(SceneFile {
            membrane: Some(serde_json::from_str(membrane).unwrap()),
            ..Scene::paper().file
        })
    }

    fn temperature(text: &str) -> Temperature {
        let scene = scene(&format!("{{\"temperature\": {text}}}")).unwrap();
        scene.membrane.unwrap().temperature.unwrap()
    }

    #[test]
    fn a_rim_rise_is_straight_from_the_bore_unless_said_otherwise() {
        let blade = Scene::paper().blade;
        let plain = temperature(r#"{"expansion_per_k": 1.2e-5, "rim_rise_k": 20}"#);
        let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
        let rises = [a, 0.5 * (a + b), b].map(|r| plain.rise_k(&blade, r));
        assert!((rises[0]).abs() < 1e-12 && (rises[1] - 10.0).abs() < 1e-12);
        assert!((rises[2] - 20.0).abs() < 1e-12);
        let shaped = temperature(
            r#"{"expansion_per_k": 1.2e-5, "rim_rise_k": 20, "from_radius_m": 0.3, "exponent": 2}"#,
        );
        assert_eq!(shaped.rise_k(&blade, 0.29), 0.0);
        let share = (0.33 - 0.3) / (b - 0.3);
        assert!((shaped.rise_k(&blade, 0.33) - 20.0 * share * share).abs() < 1e-12);
    }

    #[test]
    fn a_table_is_its_peak_times_a_shape() {
        let blade = Scene::paper().blade;
        let table = temperature(
            r#"{"expansion_per_k": 1.2e-5, "table": [{"radius_m": 0.1, "rise_k": 8},
                {"radius_m": 0.3, "rise_k": -24}]}"#,
        );
        assert_eq!(table.peak_rise_k, -24.0);
        for (r, expected) in [(0.05, 8.0), (0.2, -8.0), (0.35, -24.0)] {
            assert!((table.rise_k(&blade, r) - expected).abs() < 1e-12);
        }
    }

    /// Values that are nearly zero must not give an infinite shape.
    #[test]
    fn a_table_of_nothing_is_no_temperature() {
        for rise in ["0", "1e-310"] {
            let text = format!(
                r#"{{"expansion_per_k": 1.2e-5, "table": [{{"radius_m": 0.1, "rise_k": {rise}}}]}}"#
            );
            let nothing = temperature(&text);
            assert_eq!(nothing.peak_rise_k, 0.0);
            assert_eq!(nothing.rise_k(&Scene::paper().blade, 0.2), 0.0);
        }
    }
}
