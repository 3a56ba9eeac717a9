//! Ranges of the numbers of a scene, and the errors of those outside.

use super::{Blade, RefusedValue, SceneError};

/// Widest range of a positive quantity: far beyond any saw, and narrow enough
/// that no product of them overflows.
pub const SPAN: (f64, f64) = (1e-12, 1e15);
/// A pad stiffer than this is, to all digits of a double, a rigid one.
pub const MAX_GUIDE: f64 = 1e18;
/// Each pad costs an integral over the whole basis; no saw has a hundredth of these.
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
    if (SPAN.0..=SPAN.1).contains(&value) {
        return Ok(value);
    }
    let allowed = format!("between {:e} and {:e}", SPAN.0, SPAN.1);
    let remedy = "give it in the SI unit that ends the key's name";
    Err(refuse(key, value, allowed, remedy))
}

/// A number of a range, its ends included.
pub fn within(key: &str, value: f64, (low, high): (f64, f64)) -> Result<f64, SceneError> {
    if (low..=high).contains(&value) {
        return Ok(value);
    }
    let allowed = format!("between {low} and {high:e}");
    let remedy = "give it in the unit that ends the key's name";
    Err(refuse(key, value, allowed, remedy))
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
                "more than {least} and at most the radius of the rim ({})",
                blade.outer_radius_m
            );
            let remedy = "list the rows from the bore to the rim, each radius once";
            let key = format!("{key}[{index}].radius_m");
            return Err(refuse(&key, *radius, allowed, remedy));
        }
        least = *radius;
    }
    Ok(())
}
