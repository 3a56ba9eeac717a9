//! Measured residual stress, and the check that it is in equilibrium.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::profile::Profile;
use super::rule::{ascending, few, refuse};
use super::{Blade, Bore, SceneError};

/// Residual stress at one radius.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ResidualStressRow {
    /// Distance from the axis.
    pub radius_m: f64,
    /// Stress along the circumference, positive in tension. The radial stress follows from it.
    pub hoop_pa: f64,
    /// Stress along the radius, if it was measured, too; refused if it contradicts the hoop stress.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radial_pa: Option<f64>,
}

/// Validated residual stress, in equilibrium.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ResidualStress {
    /// σ_θθ, in Pa.
    pub hoop_pa: Profile,
    /// Ratio of ∫h/h₀ σ_θθ dr to ∫|σ_θθ| dr as typed, if both edges are free: the mean was subtracted. Zero at a
    /// collar.
    pub imbalance: f64,
}

/// A larger imbalance is not a measurement error and is refused.
const MAX_IMBALANCE: f64 = 0.05;
/// Largest difference between the measured radial stress and the one that follows from the hoop stress,
/// relative to the largest stress of the table.
const MAX_CONTRADICTION: f64 = 0.1;

impl ResidualStress {
    /// Validates a table; `None` if it has no rows. The radial stress is the integral of the hoop stress from the
    /// free rim, r σ_rr = −∫_r^b σ_θθ dr, because a derivative of measured radial stress would be too inaccurate. A
    /// free bore requires ∫ σ_θθ dr = 0; at a collar, the blade inside it carries the remainder.
    pub(super) fn new(
        rows: &[ResidualStressRow],
        blade: &Blade,
    ) -> Result<Option<Self>, SceneError> {
        let key = "membrane.residual_stress";
        few(key, rows.len())?;
        let radii: Vec<f64> = rows.iter().map(|row| row.radius_m).collect();
        ascending(key, &radii, blade.outer_radius_m)?;
        let sizes = rows
            .iter()
            .flat_map(|row| [Some(row.hoop_pa), row.radial_pa])
            .flatten();
        let largest = sizes.map(f64::abs).fold(0.0, f64::max);
        let hoop: Vec<[f64; 2]> = rows.iter().map(|row| [row.radius_m, row.hoop_pa]).collect();
        let Some(hoop) = Profile::new(&hoop) else {
            return Ok(None);
        };
        let residual = Self::balanced(hoop, blade)?;
        residual.check_radial(rows, blade, largest)?;
        Ok(Some(residual))
    }

    fn balanced(hoop_pa: Profile, blade: &Blade) -> Result<Self, SceneError> {
        let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
        let (force, size) = (force(&hoop_pa, blade, a), hoop_pa.size(a, b));
        if matches!(blade.bore, Bore::Clamped(_)) || size == 0.0 {
            return Ok(ResidualStress {
                hoop_pa,
                imbalance: 0.0,
            });
        }
        let imbalance = force / size;
        if imbalance.abs() > MAX_IMBALANCE {
            let allowed = format!(
                "in balance: ∫hoop_pa dr (times the thickness, where it varies) over a blade with free edges is zero, and here it is \
                 {:.1} % of ∫|hoop_pa| dr, more than {:.0} %",
                100.0 * imbalance,
                100.0 * MAX_IMBALANCE
            );
            let remedy = "measure closer to the edges, where the stress is steepest";
            let mean = force / even_force(blade);
            return Err(refuse(
                "the mean of membrane.residual_stress",
                mean,
                allowed,
                remedy,
            ));
        }
        Ok(ResidualStress {
            hoop_pa: hoop_pa.raised(-force / even_force(blade)),
            imbalance,
        })
    }

    fn check_radial(
        &self,
        rows: &[ResidualStressRow],
        blade: &Blade,
        largest_pa: f64,
    ) -> Result<(), SceneError> {
        for (index, row) in rows.iter().enumerate() {
            let Some(measured) = row.radial_pa else {
                continue;
            };
            let derived = self.radial_pa(blade, row.radius_m);
            if (measured - derived).abs() > MAX_CONTRADICTION * largest_pa {
                let allowed = format!(
                    "within {:.3e} Pa of {derived:.3e} Pa, the radial stress that is in \
                     equilibrium with the hoop stresses further out, (1/r)∫hoop_pa dr",
                    MAX_CONTRADICTION * largest_pa
                );
                let key = format!("membrane.residual_stress[{index}].radial_pa");
                let remedy = "leave it out if the hoop stresses are the better measurement";
                return Err(refuse(&key, measured, allowed, remedy));
            }
        }
        Ok(())
    }

    /// σ_rr = −(1/rh) ∫_r^b h σ_θθ dr, in Pa.
    pub fn radial_pa(&self, blade: &Blade, radius_m: f64) -> f64 {
        let thickness = blade.thickness_ratio(radius_m);
        -force(&self.hoop_pa, blade, radius_m) / (radius_m * thickness)
    }
}

/// Integral ∫ h/h₀ σ dr from a radius to the rim, in N/m.
fn force(hoop_pa: &Profile, blade: &Blade, from: f64) -> f64 {
    let to = blade.outer_radius_m;
    if blade.profile.is_none() {
        return hoop_pa.integral(from, to);
    }
    // Thickness and stress are linear between the radii `ends`, so that two Gauss points are exact.
    let mut ends = [blade.edges_m(), hoop_pa.knots_m().to_vec()].concat();
    ends.retain(|r| from < *r && *r < to);
    ends.extend([from, to]);
    ends.sort_by(f64::total_cmp);
    let pieces = ends.windows(2).map(|pair| {
        let (middle, half) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
        let off_middle = half / 3.0_f64.sqrt();
        let points = [middle - off_middle, middle + off_middle];
        half * points
            .map(|r| blade.thickness_ratio(r) * hoop_pa.at(r))
            .iter()
            .sum::<f64>()
    });
    pieces.sum()
}

/// The value of [`force`] from the inner edge for a unit stress.
fn even_force(blade: &Blade) -> f64 {
    let unit = Profile::new(&[[blade.outer_radius_m, 1.0]]);
    unit.map_or(0.0, |unit| force(&unit, blade, blade.inner_radius_m))
}
