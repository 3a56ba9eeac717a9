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
}

const GUIDES: Condition = Condition {
    path: "guides",
    is: None,
};
const HELD: &[Condition] = &[
    GUIDES,
    Condition {
        path: "mount.kind",
        is: Some("collar"),
    },
];
const NOT_HELD: &str = "This needs a guide or a collar that holds the blade.";

/// Conditions of all parts and tasks that have one.
pub const NEEDS: &[Need] = &[
    Need {
        of: "spline",
        any: &[Condition {
            path: "mount.kind",
            is: Some("spline"),
        }],
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
        any: &[Condition {
            path: "measured",
            is: None,
        }],
        otherwise: "The scene has no measured frequencies yet.",
    },
    Need {
        of: "gap",
        any: &[Condition {
            path: "guides[].contact",
            is: Some("one_sided"),
        }],
        otherwise: "The scene has no guide with a gap: give a guide the contact one_sided and its gap.",
    },
    Need {
        of: "place",
        any: &[GUIDES],
        otherwise: "The scene has no guide to place yet.",
    },
];
