//! `gap.json`: the chart over the amplitude at the guides, and the deflection at the cut over their gap.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::gap_oscillation::{self, OscillationEntry};
use super::instability::InstabilityEntry;
use crate::gap::{AtAmplitude, BasisError, Deviation, DeviationMap, FrictionHeat, GuideGaps};
use crate::scene::{Guide, Scene, SceneFile, rpm};
use crate::text::shown_to;

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
    pub free: AtAmplitudeEntry,
    /// The charts at amplitudes beyond the smallest gap, ascending.
    pub amplitudes: Vec<AtAmplitudeEntry>,
    /// The linear chart of the scene, with guides of their full stiffness.
    pub linear: AtAmplitudeEntry,
    /// Amplitude at which the first critical speed lies half way between that of the free blade and that of the linear
    /// chart: at smaller amplitudes the chart is that of the free blade. Null if the two differ by less than 0.1 %.
    pub half_way_amplitude_m: Option<f64>,
    /// The deflection at the cut.
    pub deviation: DeviationEntry,
    /// The oscillation of the blade; null without a cause of one.
    #[serde(default)]
    pub oscillation: Option<OscillationEntry>,
    /// The heat of friction at the pads with the gaps of the scene; null without a coefficient of friction.
    #[serde(default)]
    pub friction: Option<FrictionEntry>,
    /// Remarks on the validity of the result.
    pub warnings: Vec<String>,
}

/// The heat of friction at the pads, at the speed and under the side force of the map.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrictionEntry {
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
    /// Power of friction at all pads.
    pub power_w: f64,
    /// Radii of the temperatures.
    pub radii_m: Vec<f64>,
    /// Temperature rise at these radii by friction alone, to be added to that of the scene.
    pub rise_k: Vec<f64>,
    /// Deflection at the cut without this heat; null where the model is not valid.
    pub cold_deflection_m: Option<f64>,
    /// Deflection at the cut with this heat.
    pub deflection_m: Option<f64>,
    /// Force of each one-sided pad on the blade beyond its gap, without that of its film, with this heat.
    pub pad_forces_n: Vec<f64>,
    /// Each one-sided pad, in the order of the scene.
    pub pads: Vec<FrictionPadEntry>,
    /// First critical speed of the linear chart without this heat.
    pub cold_critical_rpm: Option<f64>,
    /// First critical speed of the linear chart with this heat; null also if the heat buckles the blade.
    pub critical_rpm: Option<f64>,
    /// Whether the temperature has settled; otherwise the numbers are those of the last repetition.
    pub settled: bool,
    /// Last change of the temperature, relative to its largest value.
    pub change: f64,
    /// Number of repetitions of the loop of temperature and deflection.
    pub repetitions: usize,
}

/// A one-sided pad beside the heated blade.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrictionPadEntry {
    /// Index among the guides of the scene.
    pub guide: usize,
    /// Smallest distance from the axis at which the pad lies on the blade.
    pub from_radius_m: f64,
    /// Largest such distance.
    pub to_radius_m: f64,
    /// Smallest distance left between the blade and the faces of the pad with this heat; negative where a face is pressed in,
    /// null where the model is not valid.
    pub gap_left_m: Option<f64>,
}

/// A saw whose blade oscillates at its guides with one amplitude.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AtAmplitudeEntry {
    /// Amplitude at the guides; null for the free blade and for the linear chart.
    pub amplitude_m: Option<f64>,
    /// Mean stiffness of each one-sided guide over the oscillation (describing function), relative to its full stiffness.
    pub stiffness_shares: Vec<f64>,
    /// Critical speeds within the sweep.
    pub critical_rpm: Vec<f64>,
    /// Bands of instability within the sweep.
    pub instabilities: Vec<InstabilityEntry>,
    /// Flutter speed; null if no flutter counts within the sweep.
    pub flutter_speed_rpm: Option<f64>,
}

/// Stationary deflection of the rim at the cut under a side force there.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DeviationEntry {
    /// Angle of the force and of the deflection.
    pub angle_deg: f64,
    /// Speed of the map over gap and force.
    pub rpm: f64,
    /// Gaps of the map relative to those of the scene, one row each; 0 stands for linear guides.
    pub gap_factors: Vec<f64>,
    /// Side forces of the map.
    pub forces_n: Vec<f64>,
    /// Deflection at the cut, one row a gap; null where slopes exceed 0.1 and the model is not valid.
    pub deflection_m: Vec<Vec<Option<f64>>>,
    /// Largest deflection of the blade, as an absolute value.
    pub largest_deflection_m: Vec<Vec<Option<f64>>>,
    /// Force of each one-sided pad on the blade beyond its gap, without that of its film: for each pad one row a gap; null for
    /// linear guides.
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
    /// Largest speed up to which the deflection at the cut keeps the limit under this force, for each gap; null where it
    /// exceeds the limit at rest. Empty without a limit.
    pub speed_within_rpm: Vec<Option<f64>>,
    /// Deflection at the cut at these speeds, with the gaps of the scene; null where the blade deflects by more than its
    /// thickness.
    pub deflection_over_speed_m: Vec<Option<f64>>,
    /// Forces of the pads at these speeds, one row a pad; null where the blade deflects by more than its thickness.
    pub pad_forces_over_speed_n: Vec<Vec<Option<f64>>>,
    /// Estimated error of the deflections over gap and force; null if none could be compared.
    pub basis_error: Option<BasisErrorEntry>,
}

/// Largest relative change of the deflections at the cut over gap and force, every third of each, in a larger basis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BasisErrorEntry {
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

impl GapReport {
    /// The report of charts and deflections.
    pub fn new(found: &GuideGaps) -> Self {
        let chart = found.analysis.report();
        let threshold = found.scene.flutter_threshold_per_s();
        let entry = |at: &AtAmplitude| AtAmplitudeEntry {
            amplitude_m: at.amplitude_m,
            stiffness_shares: at.shares.clone(),
            critical_rpm: at
                .critical_rad_per_s
                .iter()
                .map(|speed| rpm(*speed))
                .collect(),
            instabilities: at
                .instabilities
                .iter()
                .map(|band| InstabilityEntry::new(band, threshold))
                .collect(),
            flutter_speed_rpm: at.flutter_speed_rad_per_s.map(rpm),
        };
        let amplitude = &found.amplitude;
        GapReport {
            sawflutter: chart.sawflutter,
            scene: found.scene.file().clone(),
            condition: found.scene.condition(),
            unusual_numbers: chart.unusual_numbers,
            degrees_of_freedom: chart.accuracy.degrees_of_freedom,
            from_rpm: chart.campbell.from_rpm,
            to_rpm: chart.campbell.to_rpm,
            smallest_gap_m: amplitude.smallest_gap_m,
            free: entry(&amplitude.free),
            amplitudes: amplitude.amplitudes.iter().map(entry).collect(),
            linear: entry(&amplitude.linear),
            half_way_amplitude_m: amplitude.half_way_m,
            deviation: DeviationEntry::new(&found.deviation, found.max_deviation_m),
            oscillation: found
                .oscillation
                .as_ref()
                .map(|found_at| OscillationEntry::new(found_at, found.deviation.force_n)),
            friction: found
                .friction
                .as_ref()
                .map(|heat| FrictionEntry::new(heat, &found.scene)),
            warnings: warnings(chart.warnings, found),
        }
    }
}

impl FrictionEntry {
    fn new(found: &FrictionHeat, scene: &Scene) -> Self {
        let friction = &found.friction;
        let [cold_critical_rpm, critical_rpm] =
            found.critical_rad_per_s.map(|speed| speed.map(rpm));
        let hot = found.hot.as_ref();
        FrictionEntry {
            coefficient: friction.coefficient,
            heat_share: friction.heat_share,
            convection_w_per_m2_k: friction.convection_w_per_m2_k,
            conductivity_w_per_m_k: friction.conductivity_w_per_m_k,
            expansion_per_k: found.expansion_per_k,
            power_w: found.power_w,
            radii_m: found.radii_m.clone(),
            rise_k: found.rise_k.clone(),
            cold_deflection_m: found.cold.as_ref().map(|at| at.deviation_m),
            deflection_m: hot.map(|at| at.deviation_m),
            pad_forces_n: hot.map_or_else(Vec::new, |at| at.pad_forces_n.clone()),
            pads: pads(scene, hot),
            cold_critical_rpm,
            critical_rpm,
            settled: found.has_settled(),
            change: found.change,
            repetitions: found.repetitions,
        }
    }
}

fn pads(scene: &Scene, hot: Option<&Deviation>) -> Vec<FrictionPadEntry> {
    let blade = scene.blade();
    let lifting = scene.guides().iter().filter(|pad| pad.lifting.is_some());
    let entry = |(place, pad): (usize, &Guide)| {
        let (from_m, to_m) = pad.reach_m();
        FrictionPadEntry {
            guide: pad.index,
            from_radius_m: from_m.max(blade.inner_radius_m),
            to_radius_m: to_m.min(blade.outer_radius_m),
            gap_left_m: hot.and_then(|at| at.distances_left_m.get(place).copied()),
        }
    };
    lifting.enumerate().map(entry).collect()
}

impl DeviationEntry {
    fn new(map: &DeviationMap, limit_m: Option<f64>) -> Self {
        let all = map.over_gap.iter().flatten().flatten();
        let pads = 0..all
            .map(|at| at.pad_forces_n.len())
            .max()
            .unwrap_or_default();
        let of_pad = |pad: usize, row: &[Option<Deviation>]| -> Vec<Option<f64>> {
            let force = |at: &Deviation| at.pad_forces_n.get(pad).copied();
            row.iter().map(|at| at.as_ref().and_then(force)).collect()
        };
        let over_gap = |pad: usize| map.over_gap.iter().map(|row| of_pad(pad, row)).collect();
        let own = map
            .gap_factors
            .iter()
            .position(|factor| (factor - 1.0).abs() < 1e-9);
        let over_speed = own.map_or(&[][..], |own| &map.over_speed[own]);
        DeviationEntry {
            angle_deg: map.angle_rad.to_degrees(),
            rpm: map.rpm,
            gap_factors: map.gap_factors.clone(),
            forces_n: map.forces_n.clone(),
            deflection_m: table(&map.over_gap, |at| at.deviation_m),
            largest_deflection_m: table(&map.over_gap, |at| at.largest_m),
            pad_forces_n: pads.clone().map(over_gap).collect(),
            max_deflection_m: limit_m,
            force_within_n: limit_m.map_or_else(Vec::new, |limit| map.force_within_n(limit)),
            force_n: map.force_n,
            speeds_rpm: map.speeds_rpm.clone(),
            deflection_over_gap_and_speed_m: table(&map.over_speed, |at| at.deviation_m),
            speed_within_rpm: limit_m.map_or_else(Vec::new, |limit| map.speed_within_rpm(limit)),
            deflection_over_speed_m: values(over_speed, |at| at.deviation_m),
            pad_forces_over_speed_n: pads.map(|pad| of_pad(pad, over_speed)).collect(),
            basis_error: map.basis_error.map(BasisErrorEntry::from),
        }
    }
}

impl From<BasisError> for BasisErrorEntry {
    fn from(found: BasisError) -> Self {
        BasisErrorEntry {
            share: found.share,
            gap_factor: found.gap_factor,
            force_n: found.force_n,
            modes: found.modes[0],
            more_modes: found.modes[1],
        }
    }
}

/// Estimated relative error of the deflections above which the report contains a warning.
const LARGE_ERROR: f64 = 0.02;

fn warnings(mut warnings: Vec<String>, found: &GuideGaps) -> Vec<String> {
    let heat = found.friction.as_ref();
    if heat.is_some_and(|heat| heat.buckles) {
        warnings.push(
            "the heat of friction buckles the blade at rest: the deflection is that of the last repetition before, and there is no critical speed".to_owned(),
        );
    } else if heat.is_some_and(|heat| !heat.has_settled()) {
        warnings.push(
            "the temperature of friction does not settle: heat, deflection and pad forces raise each other, and the numbers of friction are those of the last repetition".to_owned(),
        );
    }
    if let Some(oscillation) = &found.oscillation {
        warnings.extend(gap_oscillation::warnings(oscillation));
    }
    if let Some(error) = found.deviation.basis_error
        && error.share > LARGE_ERROR
    {
        warnings.push(format!(
            "the deflections at the cut are not converged: with {} modes at rest in the place of {}, that at {} of the gap under {} N changes by {} %",
            error.modes[1],
            error.modes[0],
            shown_to(3, error.gap_factor),
            shown_to(3, error.force_n),
            shown_to(2, 1e2 * error.share)
        ));
    }
    warnings
}

fn table(rows: &[Vec<Option<Deviation>>], of: fn(&Deviation) -> f64) -> Vec<Vec<Option<f64>>> {
    rows.iter().map(|row| values(row, of)).collect()
}

fn values(found: &[Option<Deviation>], of: fn(&Deviation) -> f64) -> Vec<Option<f64>> {
    found.iter().map(|at| at.as_ref().map(of)).collect()
}
