//! Words on the page, which influence no number.

use schemars::JsonSchema;
use serde::Deserialize;

/// Joins what decides on a saw in one report: the answer idling and in the cut, the deviation of the board over speed,
/// margins with usual tolerances of production, and the changes that help most. Saved to a name that ends in .html it is
/// a page to print.
#[derive(Debug, Clone, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Options {
    /// For whom the report is.
    pub customer: Option<String>,
    /// Date of the report, as it is to be written.
    pub date: Option<String>,
}
