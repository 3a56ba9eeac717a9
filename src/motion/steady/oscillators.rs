//! Causes of an oscillation: a side force, and a shape or an imbalance that turns with the blade.

use crate::model::scene::{OscillatingForce, RefusedValue, ResponseFile, Scene};

/// Causes of an oscillation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Oscillators {
    /// Oscillating side force, if there is one.
    pub force: Option<OscillatingForce>,
    /// Run-out, flatness and imbalance of the scene.
    pub turning: ResponseFile,
}

/// Largest ratio of the order of the force to the base order, so that the harmonics of the motion include multiples of the
/// force's frequency.
const LARGEST_RATIO: u32 = 3;

impl Oscillators {
    /// The causes of a scene; `None` if there are none.
    pub fn of(scene: &Scene) -> Option<Self> {
        let turning = scene.file().response.unwrap_or_default();
        let force = scene.oscillating_force();
        (force.is_some() || turning.excites()).then_some(Oscillators { force, turning })
    }

    /// Names of the causes, each with the ratio of its frequency to that of rotation.
    pub fn causes(&self) -> Vec<(&'static str, u32)> {
        let force = self
            .force
            .map(|force| ("oscillating side force", force.order));
        let turning = [
            ("run-out", 1, self.turning.runout_m),
            ("flatness", 2, self.turning.flatness_m),
            ("imbalance", 1, self.turning.imbalance_kg_m2),
            ("imbalance", 2, self.turning.imbalance_kg_m2),
        ]
        .into_iter()
        .filter(|(.., size)| *size != 0.0)
        .map(|(name, order, _)| (name, order));
        force.into_iter().chain(turning).collect()
    }

    /// Name of the part of the motion with an order: the causes with this order, or the contact, which adds other multiples
    /// of the base order.
    pub fn name_of(&self, order: u32) -> String {
        let causes = self.causes();
        let own = causes.iter().filter(|(_, other)| *other == order);
        let names: Vec<&str> = own.map(|(name, _)| *name).collect();
        if names.is_empty() {
            "contact".to_owned()
        } else {
            names.join(", ")
        }
    }

    /// The greatest common divisor of all orders, of which the orders of the motion are multiples.
    pub fn base_order(&self) -> u32 {
        let divisor = |mut a: u32, mut b: u32| {
            while b > 0 {
                (a, b) = (b, a % b);
            }
            a
        };
        let orders = self.causes().into_iter().map(|(_, order)| order);
        orders.fold(0, divisor).max(1)
    }

    /// Refuses a force whose frequency is too far above that of the turning shape or imbalance.
    ///
    /// # Errors
    /// [`RefusedValue`].
    pub fn checked(self) -> Result<(), RefusedValue> {
        let order = self.force.map_or(0, |force| force.order);
        if order <= LARGEST_RATIO * self.base_order() {
            return Ok(());
        }
        let allowed = format!(
            "1 to {LARGEST_RATIO} in a scene with response.runout_m, flatness_m or imbalance_kg_m2"
        );
        let remedy =
            "the motion would need too many harmonics; remove these keys to answer the force alone";
        Err(RefusedValue::new(
            "side_force.order",
            order,
            allowed,
            remedy,
        ))
    }
}
