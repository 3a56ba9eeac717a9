//! Conditions that a scene must satisfy for parts to be added and tasks to be computed.

use serde::Serialize;

/// A condition for a part or a task.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Need {
    /// Path of the part, or name of the task.
    pub(super) of: &'static str,
    /// Conditions of which the scene must satisfy at least one.
    pub(super) any: &'static [Condition],
    /// Message if the scene satisfies none of them.
    otherwise: &'static str,
}

#[derive(Debug, Clone, Copy, Serialize)]
pub(super) struct Condition {
    pub(super) path: &'static str,
    /// Required value; null if any value is sufficient.
    pub(super) is: Option<&'static str>,
    /// Whether the scene must have nothing there.
    pub(super) absent: bool,
}

impl Condition {
    /// The scene has something at a path.
    const fn at(path: &'static str) -> Self {
        Condition {
            path,
            is: None,
            absent: false,
        }
    }

    /// The scene has this value at a path.
    const fn with(path: &'static str, is: &'static str) -> Self {
        Condition {
            is: Some(is),
            ..Condition::at(path)
        }
    }

    /// The scene has nothing at a path.
    const fn without(path: &'static str) -> Self {
        Condition {
            absent: true,
            ..Condition::at(path)
        }
    }
}

const GUIDES: Condition = Condition::at("guides");
const HELD: &[Condition] = &[GUIDES, Condition::with("mount.kind", "collar")];
const NOT_HELD: &str = "This needs a guide or a collar that holds the blade.";

/// Conditions of all parts and tasks that have one; all entries of one name must be satisfied.
pub const NEEDS: &[Need] = &[
    Need {
        of: "spline",
        any: &[Condition::with("mount.kind", "spline")],
        otherwise: "A spline needs the mount of that name.",
    },
    Need {
        of: "runup",
        any: HELD,
        otherwise: NOT_HELD,
    },
    Need {
        of: "cut.washboarding",
        any: HELD,
        otherwise: NOT_HELD,
    },
    Need {
        of: "fit",
        any: &[Condition::at("measured")],
        otherwise: "The scene has no measured frequencies yet.",
    },
    Need {
        of: "gap",
        any: &[Condition::with("guides[].contact", "one_sided")],
        otherwise: "The scene has no guide with a gap.",
    },
    Need {
        of: "blade.slots",
        any: &[Condition::without("membrane")],
        otherwise: "Slots of a blade with heat or tension are not modelled yet.",
    },
    Need {
        of: "blade.slots",
        any: &[Condition::without("blade.wave_factors")],
        otherwise: "Factors of the waves stand in place of the slots.",
    },
    Need {
        of: "blade.wave_factors[]",
        any: &[Condition::without("blade.slots")],
        otherwise: "The factors of the waves are computed from the slots.",
    },
    Need {
        of: "blade.wave_factors[]",
        any: &[Condition::without("membrane")],
        otherwise: "Factors of waves of a blade with heat or tension are not modelled yet.",
    },
    Need {
        of: "membrane",
        any: &[Condition::without("blade.slots")],
        otherwise: "Heat and tension of a slotted blade are not modelled yet.",
    },
    Need {
        of: "membrane",
        any: &[Condition::without("blade.wave_factors")],
        otherwise: "Heat and tension of a blade with factors of its waves are not modelled yet.",
    },
    Need {
        of: "place",
        any: &[GUIDES],
        otherwise: "The scene has no guide to place yet.",
    },
];
