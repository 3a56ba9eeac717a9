//! Thickness over the radius.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::SceneError;
use super::rule::refuse;
use crate::page::text::shown;

/// Thickness at one radius.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ThicknessRow {
    /// Distance from the axis.
    pub radius_m: f64,
    /// Thickness of the plate at this radius.
    pub thickness_m: f64,
}

/// Largest number of rows of a profile; each row adds basis functions.
const MAX_ROWS: usize = 8;
/// Range of the ratio to the thickness of the hub. A tenth of the thickness has a thousandth of the bending stiffness.
const RATIOS: (f64, f64) = (0.1, 10.0);
/// Validated thickness: that of the hub up to the first row, linear between the rows, constant beyond the
/// last. Two rows at one radius are a step, and so is a first row whose thickness is not that of the hub.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ThicknessProfile {
    hub_m: f64,
    /// Rows (radius, thickness), of which the first `count` are in use.
    rows: [[f64; 2]; MAX_ROWS],
    count: usize,
}

impl ThicknessProfile {
    /// Validates a profile of a moving ring with a hub of a thickness; `None` without rows.
    pub(super) fn new(
        rows: &[ThicknessRow],
        hub_m: f64,
        inner_radius_m: f64,
        outer_radius_m: f64,
    ) -> Result<Option<Self>, SceneError> {
        let key = "blade.profile";
        if rows.is_empty() {
            return Ok(None);
        }
        if rows.len() > MAX_ROWS {
            let allowed = format!("at most {MAX_ROWS} rows");
            let remedy =
                "the thickness is linear between rows: a step needs one or two rows, a taper two";
            return Err(refuse(key, rows.len() as f64, allowed, remedy));
        }
        let mut profile = ThicknessProfile {
            hub_m,
            rows: [[0.0; 2]; MAX_ROWS],
            count: rows.len(),
        };
        for (index, row) in rows.iter().enumerate() {
            let key = |name: &str| format!("{key}[{index}].{name}");
            check_radius(&key("radius_m"), rows, index, outer_radius_m)?;
            let most_m = (RATIOS.1 * hub_m).min(outer_radius_m - inner_radius_m);
            if !(RATIOS.0 * hub_m..=most_m).contains(&row.thickness_m) {
                let allowed = format!(
                    "from {} to {}: a tenth to ten times blade.thickness_m, and not more than the \
                     width of the moving ring",
                    shown(RATIOS.0 * hub_m),
                    shown(most_m)
                );
                let remedy = "give the thickness of the plate at this radius in metres";
                return Err(refuse(
                    &key("thickness_m"),
                    row.thickness_m,
                    allowed,
                    remedy,
                ));
            }
            profile.rows[index] = [row.radius_m, row.thickness_m];
        }
        Ok(Some(profile))
    }

    fn rows(&self) -> &[[f64; 2]] {
        &self.rows[..self.count]
    }

    /// Thickness at a radius; at a step, that of the inner side.
    pub fn at_m(&self, radius_m: f64) -> f64 {
        self.between(
            self.rows().partition_point(|[r, _]| *r < radius_m),
            radius_m,
        )
    }

    /// Thickness at a radius; at a step, that of the outer side.
    pub(super) fn outside_m(&self, radius_m: f64) -> f64 {
        self.between(
            self.rows().partition_point(|[r, _]| *r <= radius_m),
            radius_m,
        )
    }

    /// Thickness at a radius between the rows `next` − 1 and `next`.
    fn between(&self, next: usize, radius_m: f64) -> f64 {
        let rows = self.rows();
        let Some(before) = next.checked_sub(1) else {
            return self.hub_m;
        };
        let [from, start] = rows[before];
        match rows.get(next) {
            Some([to, end]) => start + (end - start) * ((radius_m - from) / (to - from)),
            None => start,
        }
    }

    /// Radii at which the thickness is not smooth, ascending.
    pub(super) fn knots_m(&self) -> Vec<f64> {
        let mut knots: Vec<f64> = self.rows().iter().map(|[radius, _]| *radius).collect();
        knots.dedup();
        knots
    }
}

fn check_radius(
    key: &str,
    rows: &[ThicknessRow],
    index: usize,
    outer_radius_m: f64,
) -> Result<(), SceneError> {
    let radius = rows[index].radius_m;
    let radius_of = |place: Option<usize>| place.map_or(0.0, |place| rows[place].radius_m);
    let least = radius_of(index.checked_sub(1));
    let twice = index >= 2 && radius_of(index.checked_sub(2)) == radius;
    if radius > 0.0 && radius >= least && radius <= outer_radius_m && !twice {
        return Ok(());
    }
    let allowed = format!(
        "from {} to the radius of the rim ({}), and each radius at most twice",
        shown(least),
        shown(outer_radius_m)
    );
    let remedy = "list the rows from the bore to the rim; two rows of one radius make a step";
    Err(refuse(key, radius, allowed, remedy))
}

#[cfg(test)]
mod tests;
