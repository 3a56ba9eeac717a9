//! Shape and imbalance of the blade that excite it while it turns.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::rule::is_default;

/// Shape and imbalance of the blade, which turn with it and excite it, for `sawflutter response` and `gap`; `side_force` excites it,
/// too. Causes that are 0 are absent.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ResponseFile {
    /// Run-out of the rim: amplitude of one wave around it, of the blade at rest without guides. It turns with the blade and
    /// excites at the rotation frequency.
    #[serde(default, skip_serializing_if = "is_default")]
    pub runout_m: f64,
    /// Lack of flatness at the rim: amplitude of two waves around it, of the blade at rest without guides. It excites at twice
    /// the rotation frequency.
    #[serde(default, skip_serializing_if = "is_default")]
    pub flatness_m: f64,
    /// Imbalance at the rim beside the middle plane: mass times rim radius times distance from the middle plane. It excites at
    /// the rotation frequency and its double; an imbalance in the middle plane does not bend the blade.
    #[serde(default, skip_serializing_if = "is_default")]
    pub imbalance_kg_m2: f64,
}

impl ResponseFile {
    /// Whether anything excites the blade.
    pub fn excites(&self) -> bool {
        let causes = [self.runout_m, self.flatness_m, self.imbalance_kg_m2];
        causes.iter().any(|cause| *cause != 0.0)
    }
}
