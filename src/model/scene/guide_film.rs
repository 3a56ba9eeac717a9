//! The film between a guide pad and the blade.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The film of water, oil or air between a pad and the blade. What it presses out and draws in damps the blade, and its
/// compressibility delays this force: τ df/dt + f = c dw/dt with the damping c of the pad, for the heave and for the two tilts w of the
/// blade over the pad, so that a film damps slow motions and is a spring of c/τ for fast ones. Within the pad the blade is taken as
/// rigid.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GuideFilmFile {
    /// Lag τ of the force of the film, the inverse of its cut-off frequency in rad/s: 12 η b²/(π² h² p) of a film of thickness h,
    /// viscosity η and absolute pressure p, the bulk modulus in place of p for a liquid, under a long pad of width b.
    pub lag_s: f64,
}
