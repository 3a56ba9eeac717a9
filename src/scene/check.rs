//! Ranges of the numbers of a scene, and the errors of those outside.

use super::quantity::Quantity;
use super::{Blade, RefusedValue, SceneError};
use crate::text::shown;

/// Widest range of a positive quantity: far beyond any saw, and narrow enough
/// that no product of them overflows.
pub const SPAN: (f64, f64) = (1e-12, 1e15);
/// Bounds that are further apart only keep numbers from overflowing.
const FAR: f64 = 1e9;
/// A pad stiffer than this is, to all digits of a double, a rigid one.
pub const MAX_GUIDE: f64 = 1e18;
/// Each pad costs an integral over every function of the basis; no saw has a hundredth of these.
pub const MAX_GUIDES: usize = 256;
/// A rim at this speed would long have burst.
pub const MAX_RPM: f64 = 1e9;

/// The error of a number out of its range.
pub fn refuse(
    key: &str,
    value: f64,
    allowed: impl Into<String>,
    remedy: &'static str,
) -> SceneError {
    RefusedValue::new(key, value, allowed, remedy).into()
}

/// A quantity that must not be zero.
pub fn positive(key: &str, value: f64) -> Result<f64, SceneError> {
    ranged(
        key,
        value,
        SPAN,
        "give it in the SI unit that ends the key's name",
    )
}

/// A number of a range, its ends included.
pub fn within(key: &str, value: f64, range: (f64, f64)) -> Result<f64, SceneError> {
    ranged(
        key,
        value,
        range,
        "give it in the unit that ends the key's name",
    )
}

fn ranged(
    key: &str,
    value: f64,
    (low, high): (f64, f64),
    remedy: &'static str,
) -> Result<f64, SceneError> {
    if (low..=high).contains(&value) {
        return Ok(value);
    }
    let is_far = match low > 0.0 {
        true => high / low >= FAR,
        false => high - low >= FAR,
    };
    let allowed = match is_far {
        true => beside_usual(key, value, (low, high)),
        false => format!("between {} and {}", shown(low), shown(high)),
    };
    Err(refuse(key, value, allowed, remedy))
}

/// The one of two bounds far beyond any saw that a value is past, and what saws have.
fn beside_usual(key: &str, value: f64, (low, high): (f64, f64)) -> String {
    let bound = if value > high {
        format!("at most {}", shown(high))
    } else if low > 0.0 && value <= 0.0 {
        "above 0".to_owned()
    } else {
        format!("at least {}", shown(low))
    };
    bound + &usual(key)
}

/// What saws have, to stand behind what is allowed.
fn usual(key: &str) -> String {
    Quantity::of(key).map_or(String::new(), |quantity| {
        let ((from, to), unit) = (quantity.usual, quantity.unit);
        let text = format!("; saws have {} to {} {unit}", shown(from), shown(to));
        text.trim_end().to_owned()
    })
}

/// Whether a profile has no more rows than are sensible.
pub fn few(key: &str, count: usize) -> Result<(), SceneError> {
    if count <= MAX_GUIDES {
        return Ok(());
    }
    let allowed = format!("at most {MAX_GUIDES} rows");
    let remedy = "a smooth profile needs a dozen rows";
    Err(refuse(key, count as f64, allowed, remedy))
}

/// Whether radii ascend from the bore to the rim.
pub fn ascending(key: &str, radii: &[f64], blade: &Blade) -> Result<(), SceneError> {
    let mut least = 0.0;
    for (index, radius) in radii.iter().enumerate() {
        if !(*radius > least && *radius <= blade.outer_radius_m) {
            let allowed = format!(
                "more than {} and at most the radius of the rim ({})",
                shown(least),
                shown(blade.outer_radius_m)
            );
            let remedy = "list the rows from the bore to the rim, each radius once";
            let key = format!("{key}[{index}].radius_m");
            return Err(refuse(&key, *radius, allowed, remedy));
        }
        least = *radius;
    }
    Ok(())
}
