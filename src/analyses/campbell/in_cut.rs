//! The Campbell diagram under the forces of a cut, beside that of the idling saw.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::speeds::InstabilityBand;
use crate::model::scene::rpm;
use crate::stability::{Analysis, Onsets};

/// The forces of the cut that a Campbell diagram includes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "InCutEntry")]
pub struct InCut {
    /// Speed of the cut at which these forces occur; in the diagram they are the same at every speed.
    pub rpm: f64,
    /// Mean number of teeth in the cut.
    pub teeth: f64,
    /// Force against the rotation on each tooth.
    pub tangential_n_per_tooth: f64,
    /// Force towards the axis on each tooth.
    pub radial_n_per_tooth: f64,
    /// The idling saw; null in a diagram with few speeds.
    pub idling: Option<Idling>,
}

/// The saw without the forces of the cut.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "IdlingEntry")]
pub struct Idling {
    /// Critical speeds within the sweep, ascending.
    pub critical_rpm: Vec<f64>,
    /// Bands of instability within the sweep, by onset; their branches are not named.
    pub instabilities: Vec<InstabilityBand>,
    /// Flutter speed.
    pub flutter_rpm: Option<f64>,
    /// Onset of the first flutter band, including weak ones.
    pub first_merge_rpm: Option<f64>,
}

impl InCut {
    /// The forces in the diagram of an analysis; `None` if the diagram is that of the idling saw.
    pub(super) fn new(analysis: &Analysis) -> Option<Self> {
        let cut = analysis.scene.cut()?;
        let run = cut.chart?;
        let threshold = analysis.scene.flutter_threshold_per_s();
        Some(InCut {
            rpm: run.rpm,
            teeth: run.teeth,
            tangential_n_per_tooth: run.tangential_n,
            radial_n_per_tooth: run.radial_n,
            idling: analysis.idling.as_ref().map(|onsets| {
                Idling::new(onsets, analysis.range_rad_per_s.to_rad_per_s, threshold)
            }),
        })
    }
}

impl Idling {
    fn new(onsets: &Onsets, to_rad_per_s: f64, threshold_per_s: f64) -> Self {
        let bands = onsets.instabilities.iter();
        let critical = onsets
            .critical_rad_per_s
            .iter()
            .take_while(|speed| **speed <= to_rad_per_s);
        Idling {
            critical_rpm: critical.map(|speed| rpm(*speed)).collect(),
            instabilities: bands
                .map(|band| InstabilityBand::new(band, threshold_per_s))
                .collect(),
            flutter_rpm: onsets.flutter_speed_rad_per_s.map(rpm),
            first_merge_rpm: onsets.first_merge_rad_per_s.map(rpm),
        }
    }
}
