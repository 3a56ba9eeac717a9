//! The three answers to whether a saw can run at a speed.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Whether a saw can run at a speed, from the best to the worst.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum Answer {
    /// No motion grows, and every limit is kept.
    Yes,
    /// No motion is known to grow, but a limit of practice is not kept, or it is open whether a motion grows.
    AtRisk,
    /// A motion grows, or a limit that the user set is not kept.
    No,
}

impl Answer {
    /// All answers, from the best to the worst.
    pub const ALL: [Answer; 3] = [Answer::Yes, Answer::AtRisk, Answer::No];

    /// The answer in the middle of a sentence and in tables.
    pub fn in_words(self) -> &'static str {
        match self {
            Answer::Yes => "yes",
            Answer::AtRisk => "at risk",
            Answer::No => "no",
        }
    }
}
