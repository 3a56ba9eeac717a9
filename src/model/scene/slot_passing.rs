//! How the slots of a turning blade pass what is fixed in space.
//!
//! Slots turn and guides do not. In a frame fixed in space the equations are periodic in NΩ, and only the axisymmetric blade that takes
//! the place of the slotted one has constant coefficients. Floquet multipliers of a slotted plate beside a point guide (400 mm, four
//! slots of 40 and 70 mm, guides at 100 to 185 mm) showed what it leaves out: below the first critical speed nothing that a loss factor of
//! 1e-3 does not hold, if the guide ends 30 mm inside the slots, and growth at most speeds if it lies beside them; above the
//! first critical speed growth at speeds that it calls stable.

use super::{SceneFile, SpeedRange};

/// Where slots pass guides or wood.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SlotPassing {
    /// All guides end well inside the slots.
    Inside,
    /// A guide or the wood lies beside the slots, or close to their ends.
    Beside,
    /// Factors of the waves stand in place of the slots, and do not say where these are.
    Unplaced,
}

/// Distance of a guide from the ends of the slots from which on it is well inside, in m and relative to the radius of the rim.
const WELL_INSIDE_M: f64 = 0.03;
const WELL_INSIDE: f64 = 0.15;

impl SlotPassing {
    /// The reason of a verdict at a speed that is not covered.
    pub fn in_words(self) -> &'static str {
        match self {
            SlotPassing::Inside => {
                "slots pass guides, which above the first critical speed may make grow what this model calls stable"
            }
            SlotPassing::Beside => {
                "slots pass a guide or wood beside them or close to their ends, which may make grow what this model calls stable"
            }
            SlotPassing::Unplaced => {
                "slots may make grow what this model calls stable where they pass guides, and blade.wave_factors do not say where they are; give blade.slots"
            }
        }
    }
}

impl SceneFile {
    /// Where slots pass guides or the wood; `None` if the blade is plain or nothing is fixed in space.
    pub(crate) fn slot_passing(&self) -> Option<SlotPassing> {
        let is_factored = self.blade.wave_factors.iter().any(|row| !row.is_plain());
        if self.blade.slots.is_none() && !is_factored {
            return None;
        }
        let in_cut = self.cut.as_ref().filter(|cut| cut.chart_rpm.is_some());
        let in_wood = in_cut.is_some_and(|cut| cut.wood.is_some());
        let mut acting = self.guides.iter().filter(|guide| guide.acts()).peekable();
        if acting.peek().is_none() && !in_wood {
            return None;
        }
        let Some(slots) = self.blade.slots else {
            return Some(SlotPassing::Unplaced);
        };
        let outer_m = 0.5 * self.blade.outer_diameter_m;
        let inside_m = outer_m - slots.depth_m - WELL_INSIDE_M.max(WELL_INSIDE * outer_m);
        let is_beside = in_wood || acting.any(|guide| guide.reach_m()[1] > inside_m);
        Some(if is_beside {
            SlotPassing::Beside
        } else {
            SlotPassing::Inside
        })
    }

    /// Speeds at which a saw of which no listed band counts may be unstable all the same, because slots pass guides.
    pub(crate) fn not_covered(&self, first_critical_rad_per_s: Option<f64>) -> Vec<SpeedRange> {
        let from = match self.slot_passing() {
            None => None,
            Some(SlotPassing::Inside) => first_critical_rad_per_s,
            Some(SlotPassing::Beside | SlotPassing::Unplaced) => Some(0.0),
        };
        Vec::from_iter(from.map(|from| SpeedRange::new(from, f64::INFINITY)))
    }
}
