//! `gap.json`: the chart over the amplitude at the guides, and the deflection at the cut over their gap.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::oscillation_report::Oscillation;

use crate::analyses::campbell::InstabilityBand;
use crate::model::scene::SceneFile;
use crate::page::text::shown_to;

/// Report of a saw whose guides have a gap (`gap.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GapReport {
    /// Version of the program that wrote the report.
    pub sawflutter: String,
    /// The scene, as typed.
    pub scene: SceneFile,
    /// Whether the saw idles or is in its cut: "idling", or "in the cut at 2800 rpm (4 teeth)".
    #[serde(default)]
    pub condition: String,
    /// Numbers that no saw has, each with its key, the usual range, and the remedy. The results hold for the
    /// numbers as typed.
    #[serde(default)]
    pub unusual_numbers: Vec<String>,
    /// Size of the basis.
    pub degrees_of_freedom: usize,
    /// First speed.
    pub from_rpm: f64,
    /// Last speed.
    pub to_rpm: f64,
    /// Smallest gap of a one-sided guide.
    pub smallest_gap_m: f64,
    /// The chart of a blade that moves within all gaps, where only the films of the pads act.
    pub free: AtAmplitude,
    /// The charts at amplitudes beyond the smallest gap, ascending.
    pub amplitudes: Vec<AtAmplitude>,
    /// The linear chart of the scene, with guides of their full stiffness.
    pub linear: AtAmplitude,
    /// Amplitude at which the first critical speed lies half way between that of the free blade and that of the linear
    /// chart: at smaller amplitudes the chart is that of the free blade. Null if the two differ by less than 0.1 %,
    /// and if no amplitude changes it as far, because guides on one side push the blade out of their reach.
    pub half_way_amplitude_m: Option<f64>,
    /// The deflection at the cut.
    pub deviation: DeviationMap,
    /// The oscillation of the blade; null without a cause of one.
    #[serde(default)]
    pub oscillation: Option<Oscillation>,
    /// The heat of friction at the pads with the gaps of the scene; null without a coefficient of friction.
    #[serde(default)]
    pub friction: Option<FrictionHeat>,
    /// Remarks on the validity of the result.
    pub warnings: Vec<String>,
}

/// The heat of friction at the pads, at the speed and under the side force of the map.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "FrictionEntry")]
pub struct FrictionHeat {
    /// Coefficient of friction.
    pub coefficient: f64,
    /// Share of the power that enters the blade.
    pub heat_share: f64,
    /// Heat transfer coefficient of each face of the blade.
    pub convection_w_per_m2_k: f64,
    /// Heat conductivity of the blade.
    pub conductivity_w_per_m_k: f64,
    /// Coefficient of linear thermal expansion: that of the scene's temperature, or that of steel.
    pub expansion_per_k: f64,
    /// Power of friction at all faces of all pads, coefficient × force on a face × speed of the blade there; null unless the
    /// temperature settles.
    pub power_w: Option<f64>,
    /// Radii of the temperatures.
    pub radii_m: Vec<f64>,
    /// Temperature rise at these radii by friction alone, to be added to that of the scene; empty unless it settles.
    pub rise_k: Vec<f64>,
    /// Deflection at the cut without this heat; null where the model is not valid.
    pub cold_deflection_m: Option<f64>,
    /// Deflection at the cut with this heat; null unless the temperature settles.
    pub deflection_m: Option<f64>,
    /// Force of each one-sided pad on the blade, by contact and film, with this heat: the sum over both of its faces. Empty unless the
    /// temperature settles.
    pub pad_forces_n: Vec<f64>,
    /// Each one-sided pad, in the order of the scene.
    pub pads: Vec<FrictionPad>,
    /// First critical speed of the linear chart without this heat.
    pub cold_first_critical_rpm: Option<f64>,
    /// First critical speed of the linear chart with this heat; null also if the temperature does not settle.
    pub first_critical_rpm: Option<f64>,
    /// Whether the temperature settles; otherwise the blade has no steady state, and its numbers are left out.
    pub settled: bool,
    /// Whether the temperature swings between two states, because power and deflection have a jump between them.
    #[serde(default)]
    pub swings: bool,
    /// Speed from which the heat runs away or buckles the blade, to 1 %; null if it does not at the speed of the map.
    #[serde(default)]
    pub runaway_rpm: Option<f64>,
    /// Difference of the temperature of the power from this one, relative to its largest value.
    pub change: f64,
    /// Number of temperatures for which the loop computed deflection and power.
    pub repetitions: usize,
}

/// A one-sided pad beside the heated blade.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "FrictionPadEntry")]
pub struct FrictionPad {
    /// Index among the guides of the scene.
    pub guide: usize,
    /// Smallest distance from the axis at which the pad lies on the blade.
    pub from_radius_m: f64,
    /// Largest such distance.
    pub to_radius_m: f64,
    /// Smallest distance left between the blade and the faces of the pad with this heat; negative where a face is pressed in,
    /// null unless the temperature settles.
    pub gap_left_m: Option<f64>,
    /// Force of the blade on the face at positive deflections and on the other face, by contact. A tilted pad is pressed on both, and
    /// both rub; their difference is the force of the pad. Null unless the temperature settles.
    #[serde(default)]
    pub face_forces_n: Option<[f64; 2]>,
}

/// A saw whose blade oscillates at its guides with one amplitude.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "AtAmplitudeEntry")]
pub struct AtAmplitude {
    /// Amplitude at the guides; null for the free blade and for the linear chart.
    pub amplitude_m: Option<f64>,
    /// Mean stiffness of each one-sided guide over the oscillation (describing function), relative to its full stiffness.
    pub stiffness_shares: Vec<f64>,
    /// Critical speeds within the sweep.
    pub critical_rpm: Vec<f64>,
    /// Bands of instability within the sweep.
    pub instabilities: Vec<InstabilityBand>,
    /// Flutter speed; null if no flutter counts within the sweep.
    pub flutter_rpm: Option<f64>,
}

/// Stationary deflection of the rim at the cut under the side force of the scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "DeviationEntry")]
pub struct DeviationMap {
    /// Angle of the deflection, that of the cut.
    pub angle_deg: f64,
    /// Speed of the map over gap and force.
    pub rpm: f64,
    /// Gaps of the map relative to those of the scene, one row each; 0 stands for the same guides without a gap, with their offsets
    /// and sides.
    pub gap_factors: Vec<f64>,
    /// Side forces of the map.
    pub forces_n: Vec<f64>,
    /// Deflection at the cut, one row a gap; null where slopes exceed 0.1 and the model is not valid.
    pub deflection_m: Vec<Vec<Option<f64>>>,
    /// Largest deflection of the blade, as an absolute value.
    pub largest_deflection_m: Vec<Vec<Option<f64>>>,
    /// Force of each one-sided pad on the blade, by contact and film: for each pad one row a gap. With the forces of other guides
    /// and that of the side force, the sum is zero on a blade that slides along its arbor.
    pub pad_forces_n: Vec<Vec<Vec<Option<f64>>>>,
    /// Largest deflection at the cut that is allowed; null if none was given.
    pub max_deflection_m: Option<f64>,
    /// Largest side force under which the deflection keeps this limit, for each gap; null where it exceeds the limit under
    /// the smallest force of the map. Empty without a limit.
    pub force_within_n: Vec<Option<f64>>,
    /// Side force of the map over gap and speed, and of the series over the speed with the gaps of the scene.
    pub force_n: f64,
    /// Speeds of the map over gap and speed and of the series.
    pub speeds_rpm: Vec<f64>,
    /// Deflection at the cut over gap and speed, one row a gap; null where the blade deflects by more than its thickness.
    pub deflection_over_gap_and_speed_m: Vec<Vec<Option<f64>>>,
    /// Largest speed up to which the deflection at the cut keeps the limit under this force, for each gap, at most the first critical
    /// speed of the linear chart; null where it exceeds the limit at rest. Empty without a limit.
    pub speed_within_rpm: Vec<Option<f64>>,
    /// Deflection at the cut at these speeds, with the gaps of the scene; null where the blade deflects by more than its
    /// thickness.
    pub deflection_over_speed_m: Vec<Option<f64>>,
    /// Forces of the pads at these speeds, one row a pad; null where the blade deflects by more than its thickness.
    pub pad_forces_over_speed_n: Vec<Vec<Option<f64>>>,
    /// Estimated error of the deflections over gap and force; null if none could be compared.
    pub basis_error: Option<BasisError>,
}

/// Largest relative change of the deflections at the cut over gap and force, every third of each, in a larger basis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "BasisErrorEntry")]
pub struct BasisError {
    /// Relative change.
    pub share: f64,
    /// Factor of the gaps at which it occurs.
    pub gap_factor: f64,
    /// Side force at which it occurs.
    pub force_n: f64,
    /// Number of modes at rest in the basis.
    pub modes: usize,
    /// Number of modes at rest in the larger basis.
    pub more_modes: usize,
}

/// Estimated relative error of the deflections above which the report contains a warning.
const LARGE_ERROR: f64 = 0.02;

impl BasisError {
    /// Remark on deflections that are not converged.
    pub(super) fn warning(self) -> Option<String> {
        (self.share > LARGE_ERROR).then(|| {
            format!(
                "the deflections at the cut are not converged: with {} modes at rest in place of {}, that at {} of the gap under {} N changes by {} %",
                self.more_modes,
                self.modes,
                shown_to(3, self.gap_factor),
                shown_to(3, self.force_n),
                shown_to(2, 1e2 * self.share)
            )
        })
    }
}
