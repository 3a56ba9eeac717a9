//! An option that replaces a number of the scene.

/// An option that replaces a number of the scene.
#[derive(Debug, Clone, Copy)]
pub struct SceneNumber {
    /// Name in Python, which ends in the unit.
    pub name: &'static str,
    /// Name on the command line, without dashes; empty for a number that only `--set` sets there.
    pub option: &'static str,
    /// Path of the number in the scene.
    pub path: &'static str,
    /// Meaning.
    pub about: &'static str,
    /// Name of an argument without which this one has no effect.
    pub requires: Option<&'static str>,
}

impl SceneNumber {
    /// The constant side force.
    pub(crate) const FORCE: Self = SceneNumber::new(
        "force_n",
        "force",
        "side_force.force_n",
        "Constant side force, in place of side_force.force_n of the scene; 1 N in a scene without one",
    );
    /// The place of the side force around the axis.
    pub(crate) const ANGLE: Self = SceneNumber::new(
        "angle_deg",
        "",
        "side_force.angle_deg",
        "Angle of the side force, in place of that of the scene",
    );
    /// The power of the cut.
    pub(crate) const POWER: Self =
        SceneNumber::new("power_w", "power", "cut.power_w", "Power of the cut");
    /// The depth of the cut.
    pub(crate) const DEPTH: Self =
        SceneNumber::new("depth_m", "depth", "cut.depth_m", "Depth of cut");

    /// The limit of the first critical speed.
    pub(crate) const MIN_CRITICAL: Self = SceneNumber::new(
        "min_critical_rpm",
        "min-critical",
        "limits.min_critical_rpm",
        "Lowest allowed first critical speed",
    );
    /// The limit of the deflection at the cut.
    pub(crate) const MAX_DEVIATION: Self = SceneNumber::new(
        "max_deviation_m",
        "max-deviation",
        "limits.max_deviation_m",
        "Largest allowed deflection of the rim at the cut, at the operating speed",
    );

    /// A number that needs no other argument.
    pub(crate) const fn new(
        name: &'static str,
        option: &'static str,
        path: &'static str,
        about: &'static str,
    ) -> Self {
        SceneNumber {
            name,
            option,
            path,
            about,
            requires: None,
        }
    }

    /// Whether the blade stretches, in a block of the scene.
    pub(crate) const fn stretching(path: &'static str) -> Self {
        let about = "Let the blade stretch where it bends by more than a part of its thickness";
        SceneNumber::new("stretching", "stretching", path, about)
    }
}
