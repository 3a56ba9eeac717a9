//! Checks that the numbers of a scene are within their ranges, and the errors of those that are not.

use super::quantity::Quantity;
use super::{Blade, RefusedValue, SceneError};
use crate::text::shown;

/// Widest range of a positive quantity. It exceeds that of any saw, and products of such numbers do not
/// overflow.
pub const SPAN: (f64, f64) = (1e-12, 1e15);
/// Bounds whose ratio exceeds this only prevent overflow.
const FAR: f64 = 1e9;
/// In double precision a pad stiffer than this is rigid.
pub const MAX_GUIDE: f64 = 1e18;
/// Each pad costs an integral over every basis function; no saw has a hundredth of this number.
pub const MAX_GUIDES: usize = 256;
/// A rim bursts long before this speed.
pub const MAX_RPM: f64 = 1e9;

/// Makes the error of a number outside its range.
pub fn refuse(
    key: &str,
    value: f64,
    allowed: impl Into<String>,
    remedy: &'static str,
) -> SceneError {
    RefusedValue::new(key, value, allowed, remedy).into()
}

/// Checks that a quantity is positive.
pub fn positive(key: &str, value: f64) -> Result<f64, SceneError> {
    ranged(
        key,
        value,
        SPAN,
        "give it in the SI unit that ends the key's name",
    )
}

/// Checks that a number lies in a range, ends included.
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

/// If a value is past a bound that is far beyond any saw: this bound, with the usual range.
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

/// Describes the usual range, to be appended to the allowed range.
fn usual(key: &str) -> String {
    Quantity::of(key).map_or(String::new(), |quantity| {
        let ((from, to), unit) = (quantity.usual, quantity.unit);
        let text = format!("; saws have {} to {} {unit}", shown(from), shown(to));
        text.trim_end().to_owned()
    })
}

/// Checks that a profile does not have too many rows.
pub fn few(key: &str, count: usize) -> Result<(), SceneError> {
    if count <= MAX_GUIDES {
        return Ok(());
    }
    let allowed = format!("at most {MAX_GUIDES} rows");
    let remedy = "a smooth profile needs a dozen rows";
    Err(refuse(key, count as f64, allowed, remedy))
}

/// Checks that radii ascend from the bore to the rim.
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
