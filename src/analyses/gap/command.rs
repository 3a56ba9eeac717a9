//! `sawflutter gap` for every face.

use super::{GapError, GapReport, Options, gap};
use crate::analyses::door::{CommandError, CommandOptions, Progress, SceneNumber};
use crate::model::scene::Scene;

impl CommandOptions for Options {
    type Report = GapReport;
    const COMMAND: &str = "gap";
    const METHOD: &str = "run_gap";
    const SETS: &[SceneNumber] = &[
        SceneNumber::MAX_DEVIATION,
        SceneNumber::FORCE,
        SceneNumber::new(
            "oscillating_force_n",
            "oscillating-force",
            "side_force.oscillating_n",
            "Amplitude of a side force that oscillates, in place of side_force.oscillating_n of the scene: the oscillation of the blade about its deflection is computed. Run-out, flatness and imbalance of response in the scene make it oscillate, too",
        ),
        SceneNumber::new(
            "oscillating_order",
            "oscillating-order",
            "side_force.order",
            "Ratio of the frequency of this force to that of rotation, in place of side_force.order of the scene; by default 1",
        ),
        SceneNumber::new(
            "friction",
            "friction",
            "friction.coefficient",
            "Coefficient of friction of the pads, in place of friction.coefficient of the scene: the heat of the pads is computed, and the deflection of the blade that it heats",
        ),
    ];

    fn compute(&self, scene: &Scene, _: Progress<'_>) -> Result<GapReport, CommandError> {
        Ok(gap(scene, self)?)
    }

    fn assumptions(&self, scene: &Scene) -> Option<String> {
        let tried = scene.with_gap(self.gap_m?).ok()?;
        (!tried.assumed.is_empty()).then(|| format!("assumed beside the gap: {}", tried.in_words()))
    }
}

impl From<GapError> for CommandError {
    fn from(error: GapError) -> Self {
        match error {
            GapError::Refused(source) => source.into(),
            GapError::Scene(source) => source.into(),
            GapError::Analysis(source) => source.into(),
            GapError::Spectrum(source) => source.into(),
            GapError::Stretched(source) => source.into(),
        }
    }
}
