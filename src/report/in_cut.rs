//! The Campbell diagram under the forces of a cut, beside that of the idling saw.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::InstabilityEntry;
use crate::scene::rpm;
use crate::stability::{Analysis, Onsets};

/// The forces of the cut that bear on the chart.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InCutEntry {
    /// Speed of the cut whose forces these are; they are the same at every speed of the chart.
    pub rpm: f64,
    /// Teeth in the cut.
    pub teeth: u32,
    /// Force against the rotation on each.
    pub tangential_n_per_tooth: f64,
    /// Force towards the axis on each.
    pub radial_n_per_tooth: f64,
    /// The saw without them; null in a sketch, a chart of few speeds.
    pub idling: Option<IdlingEntry>,
}

/// The same saw without the forces of the cut.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct IdlingEntry {
    /// Critical speeds within the sweep, ascending.
    pub critical_speeds_rpm: Vec<f64>,
    /// Bands of instability within the sweep, by onset; no chart names their branches.
    pub instabilities: Vec<InstabilityEntry>,
    /// Lowest speed at which flutter counts.
    pub flutter_speed_rpm: Option<f64>,
    /// Onset of the first flutter band of all.
    pub first_merge_rpm: Option<f64>,
}

impl InCutEntry {
    /// `None` for the idling saw.
    pub(super) fn new(analysis: &Analysis) -> Option<Self> {
        let cut = analysis.scene.cut()?;
        let run = cut.chart?;
        let threshold = analysis.scene.flutter_threshold_per_s();
        Some(InCutEntry {
            rpm: run.rpm,
            teeth: cut.teeth,
            tangential_n_per_tooth: run.tangential_n,
            radial_n_per_tooth: run.radial_n,
            idling: analysis
                .idling
                .as_ref()
                .map(|onsets| IdlingEntry::new(onsets, threshold)),
        })
    }
}

impl IdlingEntry {
    fn new(onsets: &Onsets, threshold_per_s: f64) -> Self {
        let bands = onsets.instabilities.iter();
        let critical = onsets.critical_rad_per_s.iter();
        IdlingEntry {
            critical_speeds_rpm: critical.map(|speed| rpm(*speed)).collect(),
            instabilities: bands
                .map(|band| InstabilityEntry::new(band, threshold_per_s))
                .collect(),
            flutter_speed_rpm: onsets.flutter_speed_rad_per_s.map(rpm),
            first_merge_rpm: onsets.first_merge_rad_per_s.map(rpm),
        }
    }
}
