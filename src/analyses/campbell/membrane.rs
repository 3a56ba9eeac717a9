//! The membrane stress of a scene and the effects of heat.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::model::plate::{MembraneStress, StraightEdgeReading};
use crate::model::scene::{Blade, Groove, RollBand, Scene, rpm};
use crate::stability::{Analysis, HeatLimit, HeatLimits};

/// Stress of heat, roll tension and manufacture over the radius.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "MembraneEntry")]
pub struct BladeStress {
    /// Radii, ascending; twice where the hoop stress jumps.
    pub radius_m: Vec<f64>,
    /// σ_rr at these radii.
    pub radial_pa: Vec<f64>,
    /// σ_θθ at these radii.
    pub hoop_pa: Vec<f64>,
    /// Rolled bands of the scene.
    pub roll_bands: Vec<RolledBand>,
    /// Light gap under the straight edge, if the scene has one.
    pub straight_edge: Option<StraightEdge>,
    /// Limits of temperature, if the scene has a temperature.
    pub heat: Option<ToleratedHeat>,
}

/// A rolled band, by its strain and by its groove.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "RollBandEntry")]
pub struct RolledBand {
    /// Radius of its middle.
    pub radius_m: f64,
    /// Width along the radius.
    pub width_m: f64,
    /// In-plane strain that it would have if it were free.
    pub eigenstrain: f64,
    /// Depth, on each face, of the groove whose displaced volume gives this strain; negative for a strain below zero.
    pub groove_depth_m: f64,
}

impl RolledBand {
    fn new(blade: &Blade, band: &RollBand) -> Self {
        let radius_m = band.middle_m();
        RolledBand {
            radius_m,
            width_m: band.to_radius_m - band.from_radius_m,
            eigenstrain: band.eigenstrain,
            groove_depth_m: Groove::at(blade, radius_m).depth_m(band.eigenstrain),
        }
    }
}

/// Light gap under a straight edge across the blade off its machine, which lies level on two points under its own weight.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "StraightEdgeEntry")]
pub struct StraightEdge {
    /// Distance of the ends of the straight edge, which touch the blade.
    pub length_m: f64,
    /// Distance of the two points from the axis.
    pub support_radius_m: f64,
    /// Distance from the axis at which the gap is read: the edge of the bore.
    pub read_radius_m: f64,
    /// Light gap in the middle; negative if the blade touches there and light is under the ends. Null if the blade buckles off its
    /// machine.
    pub gap_m: Option<f64>,
    /// Depth of the middle below the two points; null if the blade buckles off its machine.
    pub sag_m: Option<f64>,
    /// Light gap of the blade without its roll tension.
    pub gap_without_rolling_m: f64,
    /// Sag of the blade without its roll tension.
    pub sag_without_rolling_m: f64,
    /// Factor of the roll tension at which the blade buckles off its machine; null without roll tension.
    pub buckling_factor: Option<f64>,
    /// Roll tension that causes the measured gap; null if none was measured.
    pub measured: Option<MeasuredGap>,
}

/// Roll tension that follows from a measured light gap.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "MeasuredGapEntry")]
pub struct MeasuredGap {
    /// Light gap with this roll tension.
    pub gap_m: f64,
    /// Ratio of its roll tension to that of the scene.
    pub factor: f64,
    /// Depth of the middle below the points.
    pub sag_m: f64,
    /// The bands with this roll tension.
    pub roll_bands: Vec<RolledBand>,
}

/// The temperature profile of the scene, scaled to other peaks.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "HeatEntry")]
pub struct ToleratedHeat {
    /// Peak of the profile in the scene: the rise of largest magnitude, at the rim for a shape.
    pub rise_k: f64,
    /// Temperature rises at the radii of the stress.
    pub profile_k: Vec<f64>,
    /// Peak at which the first critical speed equals the operating speed; null without an operating speed,
    /// or if the blade buckles at a smaller one.
    pub operating_limit: Option<ToleratedRise>,
    /// Whether the operating speed exceeds a critical speed of the cold blade.
    pub past_critical_when_cold: bool,
    /// Peak at which the blade buckles at rest; null if no peak of this profile causes buckling.
    pub buckling: Option<ToleratedRise>,
    /// Peak above which the blade is flat, if roll tension buckles it when cold.
    pub flat_from: Option<ToleratedRise>,
    /// Whether the blade buckles at rest at a smaller peak than that at which its critical speed equals the
    /// operating speed.
    pub buckles_first: bool,
    /// First critical speeds over the peak, while the blade is flat at rest.
    pub critical_speeds: Vec<CriticalCurve>,
}

/// A temperature rise at which the blade buckles, or its first critical speed equals the operating speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "HeatLimitEntry")]
pub struct ToleratedRise {
    /// Peak of the profile.
    pub rise_k: f64,
    /// The shape that buckles, or the wave that stands still: "3 diameters", or the shares of waves if none
    /// dominates.
    #[serde(default)]
    pub name: String,
    /// Nodal diameters of that wave, or of the one with the largest share.
    pub nodal_diameters: usize,
    /// Nodal circles of that wave.
    pub nodal_circles: usize,
}

/// A critical speed over the peak of the temperature profile.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "HeatCurveEntry")]
pub struct CriticalCurve {
    /// The wave that stands still; for a guided blade, that at the last peak.
    #[serde(default)]
    pub name: String,
    /// Nodal diameters of that wave, or of the one with the largest share.
    pub nodal_diameters: usize,
    /// Nodal circles of that wave.
    pub nodal_circles: usize,
    /// Peaks of the profile.
    pub rise_k: Vec<f64>,
    /// Critical speeds.
    pub rpm: Vec<f64>,
}

/// Number of radii shown between two at which the stress is not smooth.
const SHOWN: usize = 40;
/// Relative distance of the radii at which the two sides of a jump are shown.
const ASIDE: f64 = 1e-9;

impl BladeStress {
    /// Stress and limits of an analysis; `None` for a scene without membrane stress, temperature and straight edge.
    pub(super) fn new(scene: &Scene, analysis: &Analysis) -> Option<Self> {
        let plate = &analysis.model.plate;
        let heat_limits = analysis.heat.as_ref();
        let straight_edge = analysis.straight_edge.as_ref();
        if plate.membrane.is_none() && heat_limits.is_none() && straight_edge.is_none() {
            return None;
        }
        let stress = plate.membrane.as_ref();
        let radius_m = shown_radii(
            stress,
            plate.blade.inner_radius_m,
            plate.blade.outer_radius_m,
        );
        let at = |r: &f64| stress.map(|stress| stress.at(*r)).unwrap_or_default();
        let temperature = scene.membrane().and_then(|m| m.temperature.as_ref());
        let heat = heat_limits
            .zip(temperature)
            .map(|(limits, temperature)| ToleratedHeat {
                rise_k: temperature.peak_rise_k,
                profile_k: radius_m
                    .iter()
                    .map(|r| temperature.rise_k(&plate.blade, *r))
                    .collect(),
                operating_limit: limits.operating.as_ref().map(ToleratedRise::from),
                past_critical_when_cold: limits.past_critical,
                buckling: limits.buckling.as_ref().map(ToleratedRise::from),
                flat_from: limits.flat_from.as_ref().map(ToleratedRise::from),
                buckles_first: limits.buckles_first,
                critical_speeds: curves(limits),
            });
        let bands = scene.membrane().into_iter().flat_map(|m| &m.roll_tension);
        Some(BladeStress {
            straight_edge: straight_edge.and_then(|reading| StraightEdge::new(scene, reading)),
            roll_bands: bands
                .map(|band| RolledBand::new(&plate.blade, band))
                .collect(),
            radial_pa: radius_m.iter().map(|r| at(r).radial_pa).collect(),
            hoop_pa: radius_m.iter().map(|r| at(r).hoop_pa).collect(),
            radius_m,
            heat,
        })
    }
}

impl StraightEdge {
    fn new(scene: &Scene, reading: &StraightEdgeReading) -> Option<Self> {
        let membrane = scene.membrane()?;
        let edge = membrane.straight_edge.as_ref()?;
        let bands = |factor: f64| {
            let scaled = move |band: &RollBand| RollBand {
                eigenstrain: factor * band.eigenstrain,
                ..*band
            };
            let bands = membrane.roll_tension.iter().map(scaled);
            bands
                .map(|band| RolledBand::new(&edge.blade, &band))
                .collect()
        };
        Some(StraightEdge {
            length_m: 2.0 * edge.end_radius_m,
            support_radius_m: edge.support_radius_m,
            read_radius_m: edge.blade.inner_radius_m,
            gap_m: reading.rolled.map(|found| found.gap_m),
            sag_m: reading.rolled.map(|found| found.sag_m),
            gap_without_rolling_m: reading.plain.gap_m,
            sag_without_rolling_m: reading.plain.sag_m,
            buckling_factor: reading.buckling_factor,
            measured: reading.measured.map(|(factor, found)| MeasuredGap {
                gap_m: found.gap_m,
                factor,
                sag_m: found.sag_m,
                roll_bands: bands(factor),
            }),
        })
    }
}

impl From<&HeatLimit> for ToleratedRise {
    fn from(limit: &HeatLimit) -> Self {
        ToleratedRise {
            rise_k: limit.rise_k,
            name: limit.name.in_words(),
            nodal_diameters: limit.name.diameters(),
            nodal_circles: limit.name.circles(),
        }
    }
}

fn curves(limits: &HeatLimits) -> Vec<CriticalCurve> {
    let curves = limits.curves.iter();
    curves
        .map(|curve| CriticalCurve {
            name: curve.name.in_words(),
            nodal_diameters: curve.name.diameters(),
            nodal_circles: curve.name.circles(),
            rise_k: curve.rise_k.clone(),
            rpm: curve.speed_rad_per_s.iter().map(|s| rpm(*s)).collect(),
        })
        .collect()
}

fn shown_radii(stress: Option<&MembraneStress>, a: f64, b: f64) -> Vec<f64> {
    let knots = stress.map_or(vec![a, b], MembraneStress::knots_m);
    let mut radii = Vec::new();
    for panel in knots.windows(2) {
        let (low, high) = (panel[0] * (1.0 + ASIDE), panel[1] * (1.0 - ASIDE));
        let shares = (0..SHOWN).map(|k| k as f64 / (SHOWN - 1) as f64);
        radii.extend(shares.map(|share| low + (high - low) * share));
    }
    radii
}
