//! What a command takes beside its scene: names, the numbers of the scene that they replace, and words.
//!
//! The methods of the Python package are made from this table, and the options of the command line have its words and paths.

use serde::Serialize;

use crate::analyses::check::RIM_LIMIT_M_PER_S;
use crate::analyses::place::Tolerances;
#[cfg(feature = "cli")]
use crate::model::scene::is_same;

/// The arguments of a command.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Call {
    /// Name on the command line, like `gap`.
    pub command: &'static str,
    /// Name of the method of a scene in Python, like `run_gap`.
    pub method: &'static str,
    /// What the method does.
    pub about: &'static str,
    /// Its arguments, in order.
    pub arguments: &'static [Argument],
}

/// An argument of a command.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Argument {
    /// Name in Python, which ends in the unit.
    pub name: &'static str,
    /// Name on the command line, without dashes; empty for a number that only `--set` sets there.
    pub option: &'static str,
    /// Kind of the value, and its default.
    pub kind: ArgumentKind,
    /// Path of the number of the scene that it replaces; empty if it replaces none.
    pub sets: &'static str,
    /// Meaning.
    pub about: &'static str,
}

/// Kind of an argument.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ArgumentKind {
    /// A number in the unit of its name, with a default if it has one.
    Number(Option<f64>),
    /// A whole number, with its default.
    Count(u64),
    /// Yes or no; no by default.
    Flag,
    /// One of several words, the first by default.
    Word(&'static [&'static str]),
    /// A speed, or several; those of the scene by default.
    Speeds,
    /// Paths of numbers of the scene, with or without bounds.
    Bounds,
    /// A table of measured frequencies.
    Table,
    /// Words.
    Text,
}

use ArgumentKind::{Bounds, Count, Flag, Number, Speeds, Table, Text, Word};

const fn a(
    name: &'static str,
    option: &'static str,
    kind: ArgumentKind,
    about: &'static str,
) -> Argument {
    Argument {
        name,
        option,
        kind,
        sets: "",
        about,
    }
}

impl Argument {
    /// The argument that replaces a number of the scene.
    const fn of_scene(self, sets: &'static str) -> Self {
        Argument { sets, ..self }
    }

    /// The argument of a command with this name.
    ///
    /// # Panics
    /// In a constant, so that it does not compile, if there is none.
    #[cfg(feature = "cli")]
    pub(crate) const fn of(command: &str, name: &str) -> Self {
        let mut k = 0;
        while k < CALLS.len() {
            if is_same(CALLS[k].command, command) {
                let arguments = CALLS[k].arguments;
                let mut at = 0;
                while at < arguments.len() {
                    if is_same(arguments[at].name, name) {
                        return arguments[at];
                    }
                    at += 1;
                }
            }
            k += 1;
        }
        panic!("no such argument")
    }
}

impl Call {
    /// The arguments of a command; `None` if it has none in this table.
    pub fn named(command: &str) -> Option<&'static Self> {
        CALLS.iter().find(|call| call.command == command)
    }
}

const FORCE: &str =
    "Constant side force, in place of side_force.force_n of the scene; 1 N in a scene without one";
const STRETCHING: &str =
    "Let the blade stretch where it bends by more than a part of its thickness";
const MIN_CRITICAL: &str = "Lowest allowed first critical speed";

/// Every command whose arguments are the same on the command line and in Python.
#[rustfmt::skip]
pub const CALLS: &[Call] = &[
    Call {
        command: "check",
        method: "check",
        about: "Checks the saw against limits. The result is true in a boolean context if every limit is kept: assert saw.check(...).",
        arguments: &[
            a("operating_rpm", "rpm", Number(None), "Operating speed; by default that of the scene"),
            a("margin", "margin", Number(Some(0.85)), "Largest allowed ratio of operating speed to first critical speed"),
            a("min_flutter_rpm", "min-flutter", Number(None), "Lowest allowed flutter speed"),
            a("min_critical_rpm", "min-critical", Number(None), MIN_CRITICAL),
            a("max_rim_m_per_s", "max-rim", Number(Some(RIM_LIMIT_M_PER_S)), "Largest allowed speed of the rim"),
            a("max_amplitude_m", "max-amplitude", Number(None),
                "Largest allowed amplitude of flutter in any band up to the operating speed, without damping"),
            a("accept_unusual", "accept-unusual", Flag, "Let a saw with implausible numbers pass"),
        ],
    },
    Call {
        command: "cut",
        method: "run_cut",
        about: "Computes eigenvalues and a time history under the cutting forces of cut in the scene. If the scene has no cut but the call a power or a depth, typical numbers are assumed for the others, and a ModelWarning names them.",
        arguments: &[
            a("rpm", "rpm", Speeds, "Speed of the cut, or several, in place of those of the scene"),
            a("power_w", "power", Number(None), "Power of the cut").of_scene("cut.power_w"),
            a("depth_m", "depth", Number(None), "Depth of cut").of_scene("cut.depth_m"),
            a("stretching", "stretching", Flag, STRETCHING).of_scene("cut.stretching"),
        ],
    },
    Call {
        command: "runup",
        method: "run_up",
        about: "Computes a run-up under the side force, from runup and side_force of the scene. If the scene has no runup but the call one of its numbers, typical numbers are assumed for the others, and a ModelWarning names them.",
        arguments: &[
            a("to_rpm", "to", Number(None), "Last speed").of_scene("runup.to_rpm"),
            a("duration_s", "seconds", Number(None), "Time that the run-up takes").of_scene("runup.duration_s"),
            a("force_n", "force", Number(None), FORCE).of_scene("side_force.force_n"),
            a("stretching", "stretching", Flag, STRETCHING).of_scene("runup.stretching"),
        ],
    },
    Call {
        command: "deflect",
        method: "run_deflect",
        about: "Computes the equilibrium deflection of the blade while its speed slowly rises and falls.",
        arguments: &[
            a("force_n", "force", Number(None), FORCE).of_scene("side_force.force_n"),
            a("angle_deg", "", Number(None), "Angle of the side force, in place of that of the scene").of_scene("side_force.angle_deg"),
            a("to_rpm", "to", Number(None), "Last speed; by default the end of the scene's sweep"),
        ],
    },
    Call {
        command: "report",
        method: "run_report",
        about: "Joins what decides on a saw in one report: the answer idling and in the cut, the deviation of the board over speed, margins with usual tolerances of production, and the changes that help most. Saved to a name that ends in .html it is a page to print.",
        arguments: &[
            a("customer", "customer", Text, "For whom the report is"),
            a("date", "date", Text, "Date of the report, as it is to be written"),
        ],
    },
    Call {
        command: "response",
        method: "run_response",
        about: "Computes the steady state over the speed for the excitation of the blocks side_force and response of the scene, or for a side force of 1 N. For the response between points of one's own at one speed see Matrices.response.",
        arguments: &[
            a("rpm", "rpm", Number(None),
                "Speed of the frequency response from the side force to the probe, within the sweep; by default the operating speed"),
            a("to_hz", "to-frequency", Number(None), "Largest frequency of that; by default that up to which the diagram is complete"),
        ],
    },
    Call {
        command: "gap",
        method: "run_gap",
        about: "Evaluates guides with a gap: the chart over the amplitude at them, and the deflection at the cut over the gap.",
        arguments: &[
            a("force_n", "force", Number(None), FORCE).of_scene("side_force.force_n"),
            a("gap_m", "gap", Number(None),
                "Gap of every guide, one-sided, in place of the contact of the guides of the scene"),
            a("rpm", "rpm", Number(None),
                "Speed of the map over gap and force; by default the operating speed, or half of the first critical speed"),
            a("max_deviation_m", "max-deviation", Number(None), "Largest deflection at the cut that is allowed"),
            a("oscillating_force_n", "oscillating-force", Number(None),
                "Amplitude of a side force that oscillates, in place of side_force.oscillating_n of the scene: the oscillation of the blade about its deflection is computed. Run-out, flatness and imbalance of response in the scene make it oscillate, too")
                .of_scene("side_force.oscillating_n"),
            a("oscillating_order", "oscillating-order", Number(None),
                "Ratio of the frequency of this force to that of rotation, in place of side_force.order of the scene; by default 1")
                .of_scene("side_force.order"),
            a("friction", "friction", Number(None),
                "Coefficient of friction of the pads, in place of friction.coefficient of the scene: the heat of the pads is computed, and the deflection of the blade that it heats")
                .of_scene("friction.coefficient"),
        ],
    },
    Call {
        command: "washboard",
        method: "run_washboard",
        about: "Determines whether washboarding occurs under the cutting force of cut.washboarding in the scene. If the scene has none but the call one of its numbers, typical numbers are assumed for the others, and a ModelWarning names them.",
        arguments: &[
            a("rpm", "rpm", Number(None), "Speed of the cut; by default the operating speed of the scene"),
            a("stiffness_n_per_m", "stiffness", Number(None),
                "Lateral cutting stiffness, in place of cut.washboarding.stiffness_n_per_m of the scene")
                .of_scene("cut.washboarding.stiffness_n_per_m"),
            a("overlap", "overlap", Number(None),
                "Share of a tooth's cut on the surface left by the preceding one, in place of cut.washboarding.overlap of the scene")
                .of_scene("cut.washboarding.overlap"),
            a("power_w", "power", Number(None), "Power of the cut").of_scene("cut.power_w"),
            a("depth_m", "depth", Number(None), "Depth of cut").of_scene("cut.depth_m"),
        ],
    },
    Call {
        command: "fit",
        method: "fit",
        about: "Fits guides, density or other numbers of the scene to measured frequencies.",
        arguments: &[
            a("measured", "measured", Table, "Table of measured frequencies; by default that of the scene"),
            a("free", "free", Bounds,
                "Number to fit, or several, by its path in the scene, with or without bounds; by default radius and stiffness of every guide, and the angles between several guides"),
            a("to_rpm", "to", Number(None), "Leave out measurements above this speed"),
            a("confidence", "confidence", Number(Some(0.95)), "Confidence level of the intervals"),
            a("starts", "starts", Count(12), "Starting points: the numbers of the scene, and others between the bounds"),
        ],
    },
    Call {
        command: "place",
        method: "place",
        about: "Finds the place of the guides with the highest flutter speed. This takes minutes.",
        arguments: &[
            a("free", "free", Bounds,
                "Number to vary, or several, by its path in the scene, with or without bounds; by default radius, angle and stiffness of the first guide"),
            a("goal", "goal", Word(&["flutter", "window"]),
                "Quantity to maximize: the flutter speed, or the stable window around the operating speed"),
            a("min_critical_rpm", "min-critical", Number(None), MIN_CRITICAL),
            a("amplitude_m", "amplitude", Number(None),
                "Amplitude at guides with a gap, with whose mean stiffness bands and critical speeds are computed; by default guides have their full stiffness"),
            a("max_deviation_m", "max-deviation", Number(None),
                "Largest allowed deflection at the cut at the operating speed, with guides with a gap"),
            a("force_n", "force", Number(None), FORCE).of_scene("side_force.force_n"),
            a("samples", "samples", Count(64), "Saws in the first sampling of the bounds"),
            a("refine", "refine", Count(60), "Steps of the refinement of each of the best places, each a saw and those around it"),
            a("map", "map", Count(17), "Points of the map along each axis; 0 for no map"),
            a("radius_tolerance_m", "radius-tolerance", Number(Some(Tolerances::USUAL.radius_m)),
                "Manufacturing tolerance of radii; a saw is rated by the worst of its neighbours within the tolerances"),
            a("angle_tolerance_deg", "angle-tolerance", Number(Some(Tolerances::USUAL.angle_deg)), "Tolerance of angles"),
            a("guide_tolerance_share", "guide-tolerance", Number(Some(Tolerances::USUAL.guide_share)),
                "Tolerance of the stiffness, damping or gap of a guide, as a share of it"),
            a("other_tolerance_share", "other-tolerance", Number(Some(Tolerances::USUAL.other_share)),
                "Tolerance of other numbers, as a share of each"),
        ],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::Quantity;

    /// A number that replaces one of the scene is given in the unit of its key.
    #[test]
    fn numbers_of_the_scene_have_the_units_of_their_names() {
        let arguments = || CALLS.iter().flat_map(|call| call.arguments);
        assert!(arguments().filter(|of| !of.sets.is_empty()).count() > 8);
        for argument in arguments().filter(|of| matches!(of.kind, Number(_))) {
            if let Some(quantity) = Quantity::of(argument.sets) {
                assert_eq!(
                    Quantity::unit_of(argument.name),
                    quantity.unit,
                    "{}",
                    argument.name
                );
            } else {
                assert_eq!(argument.sets, "", "{}", argument.name);
            }
        }
    }
}
