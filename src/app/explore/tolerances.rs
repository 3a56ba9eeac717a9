//! The study of the page: random saws within tolerances of production.

use serde::{Deserialize, Serialize};

use super::fields::{Field, Units};
use super::refusal::Refusal;
use crate::analyses::place::Tolerances;
use crate::analyses::study::StudyFile;
use crate::model::scene::SceneFile;

/// Usual tolerance of a number, to either side.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct UsualTolerance {
    /// Path of the number, with `[]` for any guide.
    path: &'static str,
    /// Tolerance in the unit of the key; zero if it is a share.
    plus_minus: f64,
    /// Tolerance as a share of the value; zero if it is in the unit of the key.
    share: f64,
}

/// The tolerances that a placement assumes, for numbers of every saw.
pub const USUAL: [UsualTolerance; 4] = [
    share("blade.thickness_m", Tolerances::USUAL.other_share),
    UsualTolerance {
        path: "guides[].radius_m",
        plus_minus: Tolerances::USUAL.radius_m,
        share: 0.0,
    },
    UsualTolerance {
        path: "guides[].angle_deg",
        plus_minus: Tolerances::USUAL.angle_deg,
        share: 0.0,
    },
    share("guides[].stiffness_n_per_m", Tolerances::USUAL.guide_share),
];

const fn share(path: &'static str, share: f64) -> UsualTolerance {
    UsualTolerance {
        path,
        plus_minus: 0.0,
        share,
    }
}

/// Number of random saws.
const SAWS: u32 = 200;

/// Tolerance of a number of the scene, as typed.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tolerance {
    path: String,
    plus_minus: String,
}

/// Returns the study of random saws within tolerances.
///
/// # Errors
/// [`Refusal`] if a tolerance is not a number or is negative, or all are zero.
pub fn study(
    scene: &SceneFile,
    tolerances: &[Tolerance],
    units: Units,
) -> Result<StudyFile, Refusal> {
    let mut parameters = Vec::new();
    for Tolerance { path, plus_minus } in tolerances {
        let plus_minus = Field::read(path, plus_minus, units)?;
        if plus_minus < 0.0 {
            let message = "A tolerance must be at least 0: it counts to both sides";
            return Err(Refusal::with_message(message));
        }
        if plus_minus > 0.0 {
            let distribution = serde_json::json!({ "kind": "tolerance", "plus_minus": plus_minus });
            parameters.push(serde_json::json!({ "path": path, "distribution": distribution }));
        }
    }
    if parameters.is_empty() {
        let message = "At least one tolerance must be above 0: without one all saws are the same";
        return Err(Refusal::with_message(message));
    }
    let limits = scene
        .operating_rpm
        .map(|rpm| serde_json::json!({ "operating_rpm": rpm }));
    let study = serde_json::json!({
        "name": "Tolerances", "parameters": parameters, "saws": SAWS, "limits": limits });
    StudyFile::from_json(&study.to_string()).map_err(|error| Refusal::of(&error))
}
