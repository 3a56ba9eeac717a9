//! Typical values of numbers that a user may not know. The schema and the form offer them; a command that assumes one
//! reports it.
//!
//! The page of typical values prints this table, with formulas for the numbers that follow from others.

use serde_json::{Value, json};

#[cfg(any(feature = "cli", feature = "page"))]
use super::SceneFile;
use crate::text::shown;
#[cfg(any(feature = "cli", feature = "page"))]
use crate::text::shown_to;

/// A typical value of a number of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Typical {
    /// JSON path, with `[]` for any index of a list.
    pub path: &'static str,
    /// The value, in the unit of the key, or with the unit or reference in `of`.
    pub value: f64,
    /// Unit or reference of the value, if the number of the key is computed from it; empty if the value is this
    /// number.
    pub of: &'static str,
    /// Smallest and largest value of common saws.
    pub common: (f64, f64),
    /// Source of value and range.
    pub basis: &'static str,
}

const fn t(
    path: &'static str,
    value: f64,
    of: &'static str,
    low: f64,
    high: f64,
    basis: &'static str,
) -> Typical {
    Typical {
        path,
        value,
        of,
        common: (low, high),
        basis,
    }
}

#[rustfmt::skip]
mod table {
    use super::{Typical, t};

    pub const TOOTH_PITCH: Typical = t("blade.teeth", 0.03, "m of pitch", 0.01, 0.06, "assumption of this program; the paper's saw has 0.053 m");
    pub const EXPANSION: Typical = t("membrane.temperature.expansion_per_k", 1.2e-5, "", 1.0e-5, 1.3e-5, "carbon steel; property tables of materials");
    pub const EIGENSTRAIN: Typical = t("membrane.roll_tension[].eigenstrain", 1e-4, "", 1e-4, 5e-3, "computed from grooves of 1 to 10 µm by d/h; the small end suits wide bands");
    pub const GUIDE_STIFFNESS: Typical = t("guides[].stiffness_n_per_m", 1e7, "", 1e6, 2e8, "2e7 was calibrated on the paper's Table 5 for a pad of 0.15 m by 0.15 m with 0.05 mm clearance; upper end computed from a pressurized film");
    pub const RETARDATION: Typical = t("damping.material_retardation_time_s", 1e-6, "", 1e-7, 1e-5, "assumption of this program; computed from damping ratios of 3e-5 to 3e-3 at 100 Hz");
    pub const MODE_DAMPING: Typical = t("damping.mode_ratios[].damping_ratio", 1e-3, "", 3e-4, 1e-2, "assumption of this program; measure it by the decay of a struck blade");
    pub const FLUTTER_THRESHOLD: Typical = t("flutter_threshold_per_s", 0.25, "", 0.1, 1.0, "assumption of this program; computed as the decay rate of 40 Hz at a damping ratio of 1e-3");
    pub const RIM_SPEED: Typical = t("operating_rpm", 60.0, "m/s at the rim", 40.0, 100.0, "the paper's saw runs at 67 m/s; makers of carbide-tipped blades allow 100");
    pub const CUT_DEPTH: Typical = t("cut.depth_m", 0.25, "of the outer diameter", 0.05, 0.35, "the paper's saw cuts 0.28 of its diameter");
    pub const CUT_POWER: Typical = t("cut.power_w", 2e5, "W per metre of depth", 5e4, 3e5, "the paper's Table 2: 2.2e5 and 3.0e5 in Douglas fir, at bites of 1.6 mm");
    pub const RADIAL_FORCE: Typical = t("cut.radial_n_per_tooth", 20.0, "", 0.0, 90.0, "assumption of this program; the paper's Table 3 has 75 and 88 in Douglas fir, at bites of 1.6 mm");
    pub const LATERAL_FORCE: Typical = t("cut.lateral_n_per_tooth", 1.0, "", 0.0, 5.0, "assumption of this program; the paper's Table 3 has 3 and 4.5 in Douglas fir");
    pub const FEED: Typical = t("cut.feed_m_per_s", 1.0, "", 0.1, 3.0, "assumption of this program; the paper's saw is fed at 2.0 and 3.0");
    pub const BOARD: Typical = t("cut.board_length_m", 2.0, "", 1.0, 6.0, "assumption of this program; the paper gives none");
    pub const IDLE: Typical = t("cut.idle_s", 0.5, "", 0.0, 2.0, "assumption of this program, to see the blade before and after the cut");
    pub const CUTTING_STIFFNESS: Typical = t("cut.washboarding.stiffness_n_per_m", 2e4, "", 5e3, 1e5, "no published value known; computed from the cutting force and the bite");
    pub const OVERLAP: Typical = t("cut.washboarding.overlap", 1.0, "", 0.0, 1.0, "all teeth in one groove, with the largest delayed force");
    pub const RUNUP_END: Typical = t("runup.to_rpm", 1.5, "times the operating speed", 1.2, 2.0, "assumption of this program");
    pub const RUNUP_TIME: Typical = t("runup.duration_s", 60.0, "", 5.0, 120.0, "assumption of this program");
    pub const RUNUP_FORCE: Typical = t("runup.force_n", 1.0, "", 0.1, 10.0, "assumption of this program: small deflections of a linear model");
    pub const RESPONSE_FORCE: Typical = t("response.force_n", 1.0, "", 0.1, 10.0, "assumption of this program: a response is proportional to it");

    pub const TYPICAL: [Typical; 21] = [
        TOOTH_PITCH, EXPANSION, EIGENSTRAIN, GUIDE_STIFFNESS, RETARDATION, MODE_DAMPING, FLUTTER_THRESHOLD, RIM_SPEED,
        CUT_DEPTH, CUT_POWER, RADIAL_FORCE, LATERAL_FORCE, FEED, BOARD, IDLE, CUTTING_STIFFNESS, OVERLAP, RUNUP_END,
        RUNUP_TIME, RUNUP_FORCE, RESPONSE_FORCE,
    ];
}
pub(crate) use table::*;

impl Typical {
    /// Whether the value is the number of the key.
    pub fn is_number(&self) -> bool {
        self.of.is_empty()
    }

    /// Typical value of a number, by its path with `[]` for indices.
    pub fn of(path: &str) -> Option<f64> {
        let mut numbers = TYPICAL.iter().filter(|typical| typical.is_number());
        let own = numbers.find(|typical| typical.path == path);
        own.map(|typical| typical.value)
    }

    /// Describes value and range: "Typically 20, from 0 to 90 (source)."
    fn sentence(&self) -> String {
        let [value, low, high] = [self.value, self.common.0, self.common.1].map(shown);
        let space = if self.is_number() { "" } else { " " };
        let (of, basis) = (self.of, self.basis);
        format!("Typically {value}{space}{of}, from {low} to {high} ({basis}).")
    }
}

/// Adds the typical values to the schema of a scene: to the descriptions of their keys, and as examples.
pub(super) fn add_to_schema(schema: &mut Value) {
    for typical in &TYPICAL {
        let found = pointer(schema, typical.path).and_then(|at| schema.pointer_mut(&at));
        let Some(key) = found else { continue };
        let known = key["description"].as_str().unwrap_or_default();
        key["description"] = json!(format!("{known} {}", typical.sentence()));
        if typical.is_number() {
            key["examples"] = json!([typical.value]);
        }
    }
}

/// JSON pointer to the schema of the key at a path.
fn pointer(schema: &Value, path: &str) -> Option<String> {
    let mut at = String::new();
    for key in path.split('.') {
        at = block(schema, at)?;
        at += &format!("/properties/{}", key.trim_end_matches("[]"));
    }
    schema.pointer(&at).map(|_| at)
}

/// JSON pointer to the block that a key refers to, through lists and optional keys.
fn block(schema: &Value, at: String) -> Option<String> {
    let node = schema.pointer(&at)?;
    if let Some(name) = node["$ref"].as_str() {
        return Some(name.trim_start_matches('#').to_owned());
    }
    if !node["items"].is_null() {
        return block(schema, at + "/items");
    }
    match node["anyOf"].as_array() {
        Some(choices) => {
            let own = choices.iter().position(|one| !one["$ref"].is_null())?;
            block(schema, format!("{at}/anyOf/{own}"))
        }
        None => Some(at),
    }
}

/// Operating speed of a scene, in rpm; if it has none, the typical one.
#[cfg(any(feature = "cli", feature = "page"))]
pub(crate) fn operating_rpm(scene: &SceneFile) -> f64 {
    let diameter_m = scene.blade.outer_diameter_m;
    let usual = 60.0 * RIM_SPEED.value / (std::f64::consts::PI * diameter_m);
    scene.operating_rpm.unwrap_or_else(|| rounded(usual, 2))
}

/// A typical cut for this blade.
#[cfg(any(feature = "cli", feature = "page"))]
pub(crate) fn cut(scene: &SceneFile) -> Value {
    let depth_m = rounded(CUT_DEPTH.value * scene.blade.outer_diameter_m, 2);
    let mut cut = json!({
        "depth_m": depth_m,
        "power_w": short(rounded(CUT_POWER.value * depth_m, 2)),
        "radial_n_per_tooth": short(RADIAL_FORCE.value),
        "lateral_n_per_tooth": short(LATERAL_FORCE.value),
        "feed_m_per_s": short(FEED.value),
        "board_length_m": short(BOARD.value)
    });
    if scene.operating_rpm.is_none() {
        cut["speeds"] = json!([{ "rpm": short(operating_rpm(scene)) }]);
    }
    cut
}

/// A typical dependence of the cutting force on the surface left by the preceding tooth.
#[cfg(any(feature = "cli", feature = "page"))]
pub(crate) fn washboarding() -> Value {
    json!({ "stiffness_n_per_m": short(CUTTING_STIFFNESS.value), "overlap": short(OVERLAP.value) })
}

/// A typical run-up past the operating speed.
#[cfg(any(feature = "cli", feature = "page"))]
pub(crate) fn runup(scene: &SceneFile) -> Value {
    json!({
        "from_rpm": 0,
        "to_rpm": short(rounded(RUNUP_END.value * operating_rpm(scene), 2)),
        "duration_s": short(RUNUP_TIME.value),
        "force_n": short(RUNUP_FORCE.value)
    })
}

/// JSON number, without decimals if it is whole.
#[cfg(any(feature = "cli", feature = "page"))]
fn short(value: f64) -> Value {
    match value.fract() == 0.0 {
        true => json!(value as i64),
        false => json!(value),
    }
}

/// Rounds a number to a number of significant digits.
#[cfg(any(feature = "cli", feature = "page"))]
pub(crate) fn rounded(value: f64, digits: usize) -> f64 {
    shown_to(digits, value).parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Quantity, json_schema};

    #[test]
    fn typical_values_are_of_numbers_that_scenes_have_and_lie_in_their_ranges() {
        for typical in TYPICAL {
            let quantity = Quantity::of(typical.path).expect(typical.path);
            let (low, high) = typical.common;
            assert!((low..=high).contains(&typical.value), "{}", typical.path);
            if typical.is_number() {
                for value in [typical.value, low, high] {
                    assert!(quantity.is_usual(value), "{}: {value}", typical.path);
                }
            }
        }
    }

    #[test]
    fn the_schema_has_them_in_descriptions_and_examples() {
        let schema = json_schema();
        for typical in TYPICAL {
            let at = pointer(&schema, typical.path).expect(typical.path);
            let key = schema.pointer(&at).expect(typical.path);
            let description = key["description"].as_str().unwrap();
            assert!(description.ends_with(&typical.sentence()), "{description}");
            if typical.is_number() {
                assert_eq!(key["examples"][0], typical.value, "{}", typical.path);
            }
        }
    }
}
