//! The check of every number of a scene by the table of quantities, and rules that several keys share.

use serde_json::Value;

use super::quantity::Quantity;
use super::{Blade, RefusedValue, SceneError, SceneFile, SpeedRange, rad_per_s};
use crate::text::shown;

/// Largest number of pads, and of rows of a table. Each pad requires an integral over every basis function; no saw
/// has a hundredth of this number.
pub const MAX_GUIDES: usize = 256;

/// Checks that every number of a scene is in its allowed range. Rules that join several keys remain to be checked.
pub fn numbers(file: &SceneFile) -> Result<(), RefusedValue> {
    for (path, value) in file.values() {
        let Some(quantity) = Quantity::of(&path) else {
            continue;
        };
        match value {
            // An entry of a list may be null, a key is left out.
            Value::Null if path.ends_with(']') => (),
            Value::Null => return Err(quantity.refused(&path, f64::NAN, "no finite number")),
            value => {
                let number = value.as_f64().unwrap_or(f64::NAN);
                quantity.checked(&path, number)?;
            }
        }
    }
    Ok(())
}

/// Returns the error of a number outside its range.
pub fn refuse(
    key: &str,
    value: f64,
    allowed: impl Into<String>,
    remedy: &'static str,
) -> SceneError {
    RefusedValue::new(key, value, allowed, remedy).into()
}

/// Returns the range between two speeds `from_rpm` and `to_rpm` of a block of the scene.
pub fn speeds(
    block: &str,
    from_rpm: f64,
    to_rpm: f64,
    remedy: &'static str,
) -> Result<SpeedRange, SceneError> {
    if to_rpm <= from_rpm {
        let allowed = format!("more than {block}.from_rpm ({})", shown(from_rpm));
        return Err(refuse(&format!("{block}.to_rpm"), to_rpm, allowed, remedy));
    }
    Ok((rad_per_s(from_rpm), rad_per_s(to_rpm)).into())
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
