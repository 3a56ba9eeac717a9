//! Rules that several keys share.

use super::{RefusedValue, SceneError};
use crate::page::text::shown;

/// Largest number of pads, and of rows of a table. Each pad requires an integral over every basis function; no saw
/// has a hundredth of this number.
pub const MAX_GUIDES: usize = 256;

/// Whether a written scene omits a value, because it is the default of its type.
pub fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
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
pub fn ascending(key: &str, radii: &[f64], outer_radius_m: f64) -> Result<(), SceneError> {
    let mut previous = 0.0;
    for (index, radius) in radii.iter().enumerate() {
        if !(*radius > previous && *radius <= outer_radius_m) {
            let allowed = format!(
                "more than {} and at most the radius of the rim ({})",
                shown(previous),
                shown(outer_radius_m)
            );
            let remedy = "list the rows from the bore to the rim, each radius once";
            let key = format!("{key}[{index}].radius_m");
            return Err(refuse(&key, *radius, allowed, remedy));
        }
        previous = *radius;
    }
    Ok(())
}
