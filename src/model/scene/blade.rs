//! The blade: dimensions, material, mount, and the mass of teeth and tips.

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::SceneError;
use super::rule::{needed_teeth, refuse};
use super::slots::{Slots, SlotsFile, SplitBranch};
use super::thickness::{ThicknessProfile, ThicknessRow};
use super::wave_factors::{WaveFactorRow, WaveFactors};
use crate::page::text::shown;

/// An annular blade.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BladeFile {
    /// Diameter of the rim.
    pub outer_diameter_m: f64,
    /// Diameter of the bore.
    pub inner_diameter_m: f64,
    /// Thickness of the plate, not the width of its kerf; with a profile, from the bore to its first row.
    pub thickness_m: f64,
    /// Thickness at ascending radii, linear between the rows and constant beyond the last. Two rows at one
    /// radius are a step, and so is a first row of another thickness. By default the thickness is uniform.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub profile: Vec<ThicknessRow>,
    /// Number of teeth, required for `cut`, `rim` and `excitation.tooth_passing`. They have no
    /// stiffness in the model, and no mass unless `rim` gives it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub teeth: Option<u32>,
    /// Mass of teeth or carbide tips. None by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rim: Option<RimFile>,
    /// Slots from the rim inwards, such as expansion slots. None by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slots: Option<SlotsFile>,
    /// Stiffness of waves against a plain blade, as measured or as another program computes it; an alternative to `slots`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub wave_factors: Vec<WaveFactorRow>,
    /// Linear elastic, isotropic material.
    pub material: Material,
}

/// Isotropic elastic material.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Young's modulus E.
    pub youngs_modulus_pa: f64,
    /// Poisson's ratio ν, −1 < ν < 0.5.
    pub poisson_ratio: f64,
    /// Density ρ.
    pub density_kg_per_m3: f64,
}

/// Support of the bore.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
pub enum Mount {
    /// Loose on a splined arbor: the bore is free in bending and in plane.
    Spline {},
    /// Clamped between collars or flanges: no deflection at their edge, and no slope unless the clamp yields.
    Collar {
        /// Diameter of the collar; the blade inside it does not move.
        diameter_m: f64,
        /// Condition in the plane of the blade at the edge of the collar.
        in_plane: InPlane,
        /// Moment per angle and per length of the edge with which the collar resists a slope of the blade at its edge, where
        /// the deflection stays zero; 0 lets the blade turn freely. By default the clamp is rigid.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        clamp_stiffness_n_m_per_rad_per_m: Option<f64>,
    },
}

/// In-plane condition at the edge of a collar. It changes critical speeds by 15 % for a blade of 400 mm, so
/// there is no default.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum InPlane {
    /// No radial displacement at the collar.
    Fixed,
    /// No radial stress at the collar.
    Free,
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

/// The annulus a < r < b of the blade that deflects.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blade {
    /// Inner radius a: the bore of a spline blade, the edge of a collar.
    pub inner_radius_m: f64,
    /// Outer radius b.
    pub outer_radius_m: f64,
    /// Thickness h; for a profile, the hub's thickness, to which mass and stiffness are referred.
    pub thickness_m: f64,
    /// Thickness over the radius if it is not uniform.
    pub(crate) profile: Option<ThicknessProfile>,
    /// Mass of teeth and tips.
    pub(crate) rim: Option<RimMass>,
    /// Slots from the rim inwards.
    pub slots: Option<Slots>,
    /// Factors of the waves against a plain blade.
    pub wave_factors: Option<WaveFactors>,
    /// Branch of the pairs that slots split.
    pub(crate) split_branch: SplitBranch,
    /// Material of the blade.
    pub material: Material,
    /// Boundary condition at r = a.
    pub bore: Bore,
    /// Moment per angle and length, in N·m/(rad·m), with which a collar resists a slope at r = a; `None` if there is no slope.
    pub(crate) clamp_n_m_per_rad_per_m: Option<f64>,
}

/// Condition at the inner radius, in bending and in plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bore {
    /// Spline: free in bending and in plane.
    Free,
    /// Collar: no deflection, and no slope unless the clamp yields; the condition in plane is that of the scene.
    Clamped(InPlane),
}

/// Validated mass on a circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RimMass {
    /// Mass of all teeth together.
    pub mass_kg: f64,
    /// Distance from the axis.
    pub radius_m: f64,
}

/// Largest ratio of the mass of all teeth to that of the blade. With heavier teeth the blade itself no longer
/// influences the result.
const MOST_BLADES: f64 = 10.0;

impl BladeFile {
    /// Smallest and largest thickness as typed.
    pub fn thickness_range_m(&self) -> [f64; 2] {
        let rows = self.profile.iter().map(|row| row.thickness_m);
        rows.fold([self.thickness_m; 2], |[low, high], own| {
            [low.min(own), high.max(own)]
        })
    }
}

impl RimMass {
    /// Validates the mass of the teeth; `None` if there is none.
    pub(super) fn new(typed: &BladeFile, blade: &Blade) -> Result<Option<Self>, SceneError> {
        let Some(rim) = typed.rim else {
            return Ok(None);
        };
        let key = "blade.rim.mass_per_tooth_kg";
        let each = rim.mass_per_tooth_kg;
        let reason = "where blade.rim gives a mass for each";
        let teeth = needed_teeth(typed.teeth, reason, "give the number of teeth")?;
        let (inner, outer) = (blade.inner_radius_m, blade.outer_radius_m);
        let radius_m = rim.radius_m.unwrap_or(outer);
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

impl Blade {
    /// Bending stiffness D = E h³ / 12(1 − ν²) of the thickness `thickness_m`, in N·m.
    pub fn flexural_rigidity_n_m(&self) -> f64 {
        let Material {
            youngs_modulus_pa: e,
            poisson_ratio: nu,
            ..
        } = self.material;
        e * self.thickness_m.powi(3) / (12.0 * (1.0 - nu * nu))
    }

    /// Mass per area ρh of the thickness `thickness_m`, in kg/m².
    pub fn mass_per_area_kg_per_m2(&self) -> f64 {
        self.material.density_kg_per_m3 * self.thickness_m
    }

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

    /// Checks that a radius, which `key` names, is on the moving part.
    pub(super) fn check_on(
        &self,
        key: &str,
        radius_m: f64,
        remedy: &'static str,
    ) -> Result<(), SceneError> {
        let (inner, outer) = (self.inner_radius_m, self.outer_radius_m);
        if (inner..=outer).contains(&radius_m) {
            return Ok(());
        }
        let allowed = format!("on the blade, from {} to {}", shown(inner), shown(outer));
        Err(refuse(key, radius_m, allowed, remedy))
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
    pub fn thickness_range_m(&self) -> [f64; 2] {
        let (inner, outer) = (self.inner_radius_m, self.outer_radius_m);
        let mut range = [self.thickness_at_bore_m(); 2];
        for radius in self.knots_m().into_iter().chain([inner, outer]) {
            let outside = (radius < outer).then(|| self.profile.map(|p| p.outside_m(radius)));
            let inside = (radius > inner).then(|| self.thickness_at_m(radius));
            for thickness in inside.into_iter().chain(outside.flatten()) {
                range = [range[0].min(thickness), range[1].max(thickness)];
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
