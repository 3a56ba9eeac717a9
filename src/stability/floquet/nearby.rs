//! The growth of a saw at its operating speed and beside it.

use super::error::NotComputed;
use super::growth::FloquetGrowth;
use super::guided::GuidedBlade;
use crate::model::plate::{Plate, TurningBlade};
use crate::model::scene::Scene;
use crate::modes::smallest;

/// Distance of the speeds beside the operating speed, relative to it: drives and numbers of a blade are not known better.
const BESIDE: f64 = 0.01;

/// Growth at a speed, and at one lower and one higher by 1 %.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearbyGrowth {
    /// Ascending in speed.
    pub at: [FloquetGrowth; 3],
}

impl NearbyGrowth {
    /// The growth of a scene about a speed.
    ///
    /// # Errors
    /// [`NotComputed`], for a saw that the multipliers do not cover.
    pub fn new(scene: &Scene, plate: &Plate, speed_rad_per_s: f64) -> Result<Self, NotComputed> {
        if scene.file().blade.slots.is_none() {
            let is_plain = scene.blade().wave_factors.is_none();
            return Err(if is_plain {
                NotComputed::Plain
            } else {
                NotComputed::Unplaced
            });
        }
        let blade = TurningBlade::of(&plate.blade).ok_or(NotComputed::NotFinite)?;
        let guided = GuidedBlade::new(&blade, scene, plate)?;
        let growth = |share: f64| guided.growth(share * speed_rad_per_s);
        Ok(NearbyGrowth {
            at: [growth(1.0 - BESIDE)?, growth(1.0)?, growth(1.0 + BESIDE)?],
        })
    }

    /// Whether a speed is between those computed.
    pub fn contains(&self, speed_rad_per_s: f64) -> bool {
        let [from, to] = self.ends();
        (from..=to).contains(&speed_rad_per_s)
    }

    /// The lowest and the highest speed, in rad/s.
    pub fn ends(&self) -> [f64; 2] {
        [self.at[0], self.at[2]].map(|growth| growth.speed_rad_per_s)
    }

    /// The growth that decides: one that reaches a threshold whatever its error, else one that may reach it, else the fastest.
    pub fn deciding(&self, threshold_per_s: f64) -> FloquetGrowth {
        let largest = |of: fn(&FloquetGrowth) -> f64| {
            let found = smallest(self.at, |growth| -of(growth));
            found.unwrap_or(self.at[1])
        };
        let lower = |growth: &FloquetGrowth| growth.growth_per_s - growth.error_per_s;
        let upper = |growth: &FloquetGrowth| growth.growth_per_s + growth.error_per_s;
        let [surest, widest] = [largest(lower), largest(upper)];
        if lower(&surest) >= threshold_per_s {
            surest
        } else if upper(&widest) >= threshold_per_s {
            widest
        } else {
            largest(|growth| growth.growth_per_s)
        }
    }
}
