//! Conditions of parts and tasks of the page, which a scene may lack.

use serde::Serialize;

/// A condition for a part or a task.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Need {
    /// Path of the part, or name of the task.
    pub(super) of: &'static str,
    /// Of these values of the scene it needs one.
    pub(super) any: &'static [Condition],
    /// Message otherwise.
    otherwise: &'static str,
}

#[derive(Debug, Clone, Copy, Serialize)]
pub(super) struct Condition {
    pub(super) path: &'static str,
    /// The value; null if any is sufficient.
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

/// Conditions that a scene of the page may lack.
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
