//! Thickness over the radius, and the mass of teeth and tips.

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::check::{needed_teeth, refuse};
use super::{Blade, BladeFile, SceneError, SceneFile};
use crate::text::shown;

/// Thickness at one radius.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ThicknessRow {
    /// Distance from the axis.
    pub radius_m: f64,
    /// Thickness of the plate at this radius.
    pub thickness_m: f64,
}

/// Mass of teeth or of carbide tips, distributed evenly along a circle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RimFile {
    /// Mass of one tooth or of one tip; `blade.teeth` gives their number.
    pub mass_per_tooth_kg: f64,
    /// Distance of the circle from the axis; by default the radius of the rim.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius_m: Option<f64>,
}

/// Largest number of rows of a profile; each row adds basis functions.
const MAX_ROWS: usize = 8;
/// Range of the ratio to the thickness of the hub. A tenth of the thickness has a thousandth of the bending stiffness.
const RATIOS: (f64, f64) = (0.1, 10.0);
/// Largest ratio of the mass of all teeth to that of the blade. With heavier teeth the blade itself no longer
/// influences the result.
const MOST_BLADES: f64 = 10.0;

/// Validated thickness: that of the hub up to the first row, linear between the rows, constant beyond the
/// last. Two rows at one radius are a step, and so is a first row whose thickness is not that of the hub.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ThicknessProfile {
    hub_m: f64,
    /// Rows (radius, thickness), of which the first `count` are in use.
    rows: [(f64, f64); MAX_ROWS],
    count: usize,
}

/// Validated mass on a circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RimMass {
    /// Mass of all teeth together.
    pub mass_kg: f64,
    /// Distance from the axis.
    pub radius_m: f64,
}

impl ThicknessProfile {
    /// Validates a profile; `None` without rows. `blade` is the blade of uniform thickness.
    pub(super) fn new(rows: &[ThicknessRow], blade: &Blade) -> Result<Option<Self>, SceneError> {
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
            hub_m: blade.thickness_m,
            rows: [(0.0, 0.0); MAX_ROWS],
            count: rows.len(),
        };
        for (index, row) in rows.iter().enumerate() {
            let key = |name: &str| format!("{key}[{index}].{name}");
            check_radius(&key("radius_m"), rows, index, blade)?;
            check_thickness(&key("thickness_m"), row.thickness_m, blade)?;
            profile.rows[index] = (row.radius_m, row.thickness_m);
        }
        Ok(Some(profile))
    }

    fn rows(&self) -> &[(f64, f64)] {
        &self.rows[..self.count]
    }

    /// Thickness at a radius; at a step, that of the inner side.
    pub fn at_m(&self, radius_m: f64) -> f64 {
        self.between(
            self.rows().partition_point(|(r, _)| *r < radius_m),
            radius_m,
        )
    }

    /// Thickness at a radius; at a step, that of the outer side.
    fn outside_m(&self, radius_m: f64) -> f64 {
        self.between(
            self.rows().partition_point(|(r, _)| *r <= radius_m),
            radius_m,
        )
    }

    /// Thickness at a radius between the rows `next` − 1 and `next`.
    fn between(&self, next: usize, radius_m: f64) -> f64 {
        let rows = self.rows();
        let Some(before) = next.checked_sub(1) else {
            return self.hub_m;
        };
        let (from, start) = rows[before];
        match rows.get(next) {
            Some((to, end)) => start + (end - start) * ((radius_m - from) / (to - from)),
            None => start,
        }
    }

    /// Radii at which the thickness is not smooth, ascending.
    fn knots_m(&self) -> Vec<f64> {
        let mut knots: Vec<f64> = self.rows().iter().map(|(radius, _)| *radius).collect();
        knots.dedup();
        knots
    }
}

fn check_radius(
    key: &str,
    rows: &[ThicknessRow],
    index: usize,
    blade: &Blade,
) -> Result<(), SceneError> {
    let radius = rows[index].radius_m;
    let radius_of = |place: Option<usize>| place.map_or(0.0, |place| rows[place].radius_m);
    let least = radius_of(index.checked_sub(1));
    let twice = index >= 2 && radius_of(index.checked_sub(2)) == radius;
    if radius > 0.0 && radius >= least && radius <= blade.outer_radius_m && !twice {
        return Ok(());
    }
    let allowed = format!(
        "from {} to the radius of the rim ({}), and each radius at most twice",
        shown(least),
        shown(blade.outer_radius_m)
    );
    let remedy = "list the rows from the bore to the rim; two rows of one radius make a step";
    Err(refuse(key, radius, allowed, remedy))
}

fn check_thickness(key: &str, thickness_m: f64, blade: &Blade) -> Result<(), SceneError> {
    let width = blade.outer_radius_m - blade.inner_radius_m;
    let hub = blade.thickness_m;
    let (low, high) = (RATIOS.0 * hub, (RATIOS.1 * hub).min(width));
    if (low..=high).contains(&thickness_m) {
        return Ok(());
    }
    let allowed = format!(
        "from {} to {}: a tenth to ten times blade.thickness_m, and not more than the width of the \
         moving ring",
        shown(low),
        shown(high)
    );
    let remedy = "give the thickness of the plate at this radius in metres";
    Err(refuse(key, thickness_m, allowed, remedy))
}

impl RimMass {
    /// Validates the mass of the teeth; `None` if there is none.
    pub(super) fn new(file: &SceneFile, blade: &Blade) -> Result<Option<Self>, SceneError> {
        let Some(typed) = file.blade.rim else {
            return Ok(None);
        };
        let key = "blade.rim.mass_per_tooth_kg";
        let each = typed.mass_per_tooth_kg;
        let reason = "where blade.rim gives a mass for each";
        let teeth = needed_teeth(file.blade.teeth, reason, "give the number of teeth")?;
        let (inner, outer) = (blade.inner_radius_m, blade.outer_radius_m);
        let radius_m = typed.radius_m.unwrap_or(outer);
        if !(radius_m > inner && radius_m <= outer) {
            let allowed = format!(
                "on the moving blade, above {} and at most {}",
                shown(inner),
                shown(outer)
            );
            let remedy = "mass beyond the rim counts at the rim";
            return Err(refuse("blade.rim.radius_m", radius_m, allowed, remedy));
        }
        let mass_kg = each * f64::from(teeth);
        let blade_kg = blade.mass_per_area_kg_per_m2() * PI * (outer - inner) * (outer + inner);
        if mass_kg > MOST_BLADES * blade_kg {
            let most_kg = MOST_BLADES * blade_kg / f64::from(teeth);
            let allowed =
                format!("at most {most_kg:.2e}, all teeth {MOST_BLADES} times the blade's mass");
            let remedy = "give the mass of one tooth in kg; is it in grams?";
            return Err(refuse(key, each, allowed, remedy));
        }
        Ok((mass_kg > 0.0).then_some(RimMass { mass_kg, radius_m }))
    }
}

impl BladeFile {
    /// Smallest and largest thickness as typed.
    pub fn thickness_range_m(&self) -> (f64, f64) {
        let rows = self.profile.iter().map(|row| row.thickness_m);
        rows.fold((self.thickness_m, self.thickness_m), |(low, high), own| {
            (low.min(own), high.max(own))
        })
    }
}

impl Blade {
    /// Thickness at a radius; at a step, that of the inner side.
    pub fn thickness_at_m(&self, radius_m: f64) -> f64 {
        self.profile
            .map_or(self.thickness_m, |profile| profile.at_m(radius_m))
    }

    /// Ratio of the thickness to [`Blade::thickness_m`].
    pub fn thickness_ratio(&self, radius_m: f64) -> f64 {
        self.profile
            .map_or(1.0, |profile| profile.at_m(radius_m) / self.thickness_m)
    }

    /// Thickness at the inner edge of the moving ring.
    pub fn thickness_at_bore_m(&self) -> f64 {
        self.profile.map_or(self.thickness_m, |profile| {
            profile.outside_m(self.inner_radius_m)
        })
    }

    /// Whether the blade has uniform thickness and no mass of teeth.
    pub fn is_plain(&self) -> bool {
        self.profile.is_none() && self.rim.is_none()
    }

    /// Radii within the moving ring at which the thickness is not smooth, ascending.
    pub fn knots_m(&self) -> Vec<f64> {
        let mut knots = self.profile.map_or(Vec::new(), |profile| profile.knots_m());
        let (inner, outer) = (self.inner_radius_m, self.outer_radius_m);
        knots.retain(|radius| inner < *radius && *radius < outer);
        knots
    }

    /// The edges of the moving ring and the radii between them at which thickness or load jumps, ascending.
    pub fn edges_m(&self) -> Vec<f64> {
        let (inner, outer) = (self.inner_radius_m, self.outer_radius_m);
        let teeth = self.rim.map(|rim| rim.radius_m).filter(|r| *r < outer);
        let mut edges = self.knots_m();
        edges.extend(teeth.into_iter().chain([inner, outer]));
        edges.sort_by(f64::total_cmp);
        edges.dedup();
        edges
    }

    /// Smallest and largest thickness of the moving ring.
    pub fn thickness_range_m(&self) -> (f64, f64) {
        let (inner, outer) = (self.inner_radius_m, self.outer_radius_m);
        let mut range = (self.thickness_at_bore_m(), self.thickness_at_bore_m());
        for radius in self.knots_m().into_iter().chain([inner, outer]) {
            let outside = (radius < outer).then(|| self.profile.map(|p| p.outside_m(radius)));
            let inside = (radius > inner).then(|| self.thickness_at_m(radius));
            for thickness in inside.into_iter().chain(outside.flatten()) {
                range = (range.0.min(thickness), range.1.max(thickness));
            }
        }
        range
    }

    /// Mass of the moving ring with its teeth.
    pub fn mass_kg(&self) -> f64 {
        self.mass_moment(0) + self.rim.map_or(0.0, |rim| rim.mass_kg)
    }

    /// Moment of inertia about the axis.
    pub fn polar_inertia_kg_m2(&self) -> f64 {
        let of_teeth = |rim: RimMass| rim.mass_kg * rim.radius_m.powi(2);
        self.mass_moment(2) + self.rim.map_or(0.0, of_teeth)
    }

    /// Integral ∫ r^p dm over the plate, p = 0 or 2: three Gauss points are exact between edges.
    fn mass_moment(&self, power: i32) -> f64 {
        if self.profile.is_none() {
            // For constant thickness the closed form avoids the rounding errors of the quadrature.
            let (a, b) = (self.inner_radius_m, self.outer_radius_m);
            let mass = self.mass_per_area_kg_per_m2() * PI * (b - a) * (b + a);
            return if power == 0 {
                mass
            } else {
                0.5 * mass * (a * a + b * b)
            };
        }
        let off_middle = 0.6_f64.sqrt();
        let points = [(-off_middle, 5.0), (0.0, 8.0), (off_middle, 5.0)];
        let edges = self.edges_m();
        let panels = edges.windows(2).map(|pair| {
            let (middle, half) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
            let at = |(x, weight): (f64, f64)| {
                let r = middle + half * x;
                half * weight / 9.0 * self.thickness_at_m(r) * r.powi(power + 1)
            };
            points.map(at).iter().sum::<f64>()
        });
        std::f64::consts::TAU * self.material.density_kg_per_m3 * panels.sum::<f64>()
    }
}

#[cfg(test)]
mod tests;
