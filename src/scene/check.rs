//! Checks that the numbers of a scene are within their ranges, and the errors of those that are not.

use super::quantity::Quantity;
use super::{Blade, RefusedValue, SceneError, SpeedRange, rad_per_s};
use crate::text::shown;

/// Widest range of a positive quantity. It exceeds that of any saw, and products of such numbers do not
/// overflow.
pub const SPAN: (f64, f64) = (1e-12, 1e15);
/// Bounds only prevent overflow if their ratio, or their difference if the lower one is not positive, exceeds this.
const FAR: f64 = 1e9;
/// Largest stiffness and damping of a contact. In double precision a stiffer pad is rigid.
pub const MAX_GUIDE: f64 = 1e18;
/// Largest number of pads, and of rows of a table. Each pad requires an integral over every basis function; no saw
/// has a hundredth of this number.
pub const MAX_GUIDES: usize = 256;
/// Largest speed, in rpm. A rim bursts long before it.
pub const MAX_RPM: f64 = 1e9;

/// Returns the error of a number outside its range.
pub fn refuse(
    key: &str,
    value: f64,
    allowed: impl Into<String>,
    remedy: &'static str,
) -> SceneError {
    RefusedValue::new(key, value, allowed, remedy).into()
}

/// Checks that a quantity is positive and returns it.
pub fn positive(key: &str, value: f64) -> Result<f64, SceneError> {
    ranged(
        key,
        value,
        SPAN,
        "give it in the SI unit that ends the key's name",
    )
}

/// Checks that a number lies in a range, ends included, and returns it.
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

/// Describes the bound, far beyond any saw, that a value exceeds, with the usual range.
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

/// Returns the validated range between two speeds `from_rpm` and `to_rpm` of a block of the scene.
pub fn speeds(
    block: &str,
    from_rpm: f64,
    to_rpm: f64,
    remedy: &'static str,
) -> Result<SpeedRange, SceneError> {
    let from = within(&format!("{block}.from_rpm"), from_rpm, (0.0, MAX_RPM))?;
    let key = format!("{block}.to_rpm");
    let to = within(&key, to_rpm, (0.0, MAX_RPM))?;
    if to <= from {
        let allowed = format!("more than {block}.from_rpm ({})", shown(from));
        return Err(refuse(&key, to, allowed, remedy));
    }
    Ok((rad_per_s(from), rad_per_s(to)).into())
}

/// Returns the number of teeth of the blade, which is at least 1; `reason` completes the error message.
pub fn needed_teeth(
    teeth: Option<u32>,
    reason: &str,
    remedy: &'static str,
) -> Result<u32, SceneError> {
    teeth.filter(|teeth| *teeth > 0).ok_or_else(|| {
        let given = teeth.map_or("missing".to_owned(), |teeth| teeth.to_string());
        RefusedValue::new("blade.teeth", given, format!("at least 1 {reason}"), remedy).into()
    })
}

/// Checks that a table does not have too many rows.
pub fn few(key: &str, count: usize) -> Result<(), SceneError> {
    if count <= MAX_GUIDES {
        return Ok(());
    }
    let allowed = format!("at most {MAX_GUIDES} rows");
    let remedy = "a smooth profile needs a dozen rows";
    Err(refuse(key, count as f64, allowed, remedy))
}

/// Checks that the radii of the rows of a table are positive, ascend, and do not exceed that of the rim.
pub fn ascending(key: &str, radii: &[f64], blade: &Blade) -> Result<(), SceneError> {
    let mut previous = 0.0;
    for (index, radius) in radii.iter().enumerate() {
        if !(*radius > previous && *radius <= blade.outer_radius_m) {
            let allowed = format!(
                "more than {} and at most the radius of the rim ({})",
                shown(previous),
                shown(blade.outer_radius_m)
            );
            let remedy = "list the rows from the bore to the rim, each radius once";
            let key = format!("{key}[{index}].radius_m");
            return Err(refuse(&key, *radius, allowed, remedy));
        }
        previous = *radius;
    }
    Ok(())
}
