//! Stress of a flat annulus of uniform thickness under axisymmetric loads, and its tilt.
//!
//! Sources: S. P. Timoshenko & J. N. Goodier, *Theory of Elasticity*, 3rd ed. (1970), section 28 (Lamé
//! 1852) for the ring under tension, 32 for rotation, 43 for the torque, 150 for heat.

use std::f64::consts::{PI, TAU};

/// A flat annulus, a < r < b.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Annulus {
    /// Radius a of the bore.
    pub bore_radius_m: f64,
    /// Radius b of the rim.
    pub rim_radius_m: f64,
}

/// Axisymmetric stress at one radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RadialAndHoop {
    /// σ_rr, in Pa.
    pub radial_pa: f64,
    /// σ_θθ, in Pa.
    pub hoop_pa: f64,
}

impl Annulus {
    /// Stress at a radius under the tension p at the rim, with a free bore: A ∓ B/r² with A = p b²/(b² − a²)
    /// and B = A a². A pressure is a negative tension.
    pub fn stress_under_rim_tension(&self, tension_pa: f64, radius_m: f64) -> RadialAndHoop {
        let (aa, bb) = (self.bore_radius_m.powi(2), self.rim_radius_m.powi(2));
        let uniform = tension_pa * bb / (bb - aa);
        let share = aa / radius_m.powi(2);
        RadialAndHoop {
            radial_pa: uniform * (1.0 - share),
            hoop_pa: uniform * (1.0 + share),
        }
    }

    /// σ_rθ in Pa at a radius under a torque T at the rim that the bore reacts: T/(2πr²h), for any a and b;
    /// other stresses are zero.
    pub fn shear_under_torque_pa(torque_n_m: f64, thickness_m: f64, radius_m: f64) -> f64 {
        torque_n_m / (TAU * radius_m.powi(2) * thickness_m)
    }

    /// Stress of steady rotation, both edges free: σ_rr = (3+ν)/8 ρΩ² (a² + b² − a²b²/r² − r²),
    /// σ_θθ = (3+ν)/8 ρΩ² (a² + b² + a²b²/r² − (1+3ν)/(3+ν) r²).
    ///
    /// `load_pa_per_m2` is ρΩ².
    pub fn stress_of_rotation_with_free_edges(
        &self,
        poisson_ratio: f64,
        load_pa_per_m2: f64,
        radius_m: f64,
    ) -> RadialAndHoop {
        let [aa, bb, rr] = self.squares(radius_m);
        let factor = (3.0 + poisson_ratio) / 8.0 * load_pa_per_m2;
        let share = (1.0 + 3.0 * poisson_ratio) / (3.0 + poisson_ratio);
        RadialAndHoop {
            radial_pa: factor * (aa + bb - aa * bb / rr - rr),
            hoop_pa: factor * (aa + bb + aa * bb / rr - share * rr),
        }
    }

    /// Stress of steady rotation with a fixed bore, u(a) = 0, and a free rim. With v = u E/((1 − ν²)ρΩ²) = A
    /// r + B/r − r³/8, σ_rr = ρΩ² (v′ + ν v/r) and σ_θθ = ρΩ² (v/r + ν v′); A and B follow from v(a) = 0,
    /// σ_rr(b) = 0.
    ///
    /// `load_pa_per_m2` is ρΩ².
    pub fn stress_of_rotation_with_held_bore(
        &self,
        poisson_ratio: f64,
        load_pa_per_m2: f64,
        radius_m: f64,
    ) -> RadialAndHoop {
        let nu = poisson_ratio;
        let [aa, bb, rr] = self.squares(radius_m);
        // The conditions v(a) = 0 and σ_rr(b) = 0 are A a² + B = a⁴/8 and
        // (1 + ν) A b² − (1 − ν) B = (3 + ν) b⁴/8.
        let (bore, rim) = (aa * aa / 8.0, (3.0 + nu) * bb * bb / 8.0);
        let determinant = (1.0 - nu) * aa + (1.0 + nu) * bb;
        let linear = ((1.0 - nu) * bore + rim) / determinant;
        let inverse = ((1.0 + nu) * bb * bore - aa * rim) / determinant;
        let strain = linear + inverse / rr - rr / 8.0;
        let slope = linear - inverse / rr - 3.0 * rr / 8.0;
        RadialAndHoop {
            radial_pa: load_pa_per_m2 * (slope + nu * strain),
            hoop_pa: load_pa_per_m2 * (strain + nu * slope),
        }
    }

    /// Thermal stress of the rise T = ΔT ((r − a)/(b − a))², both edges free. With I(r) = ∫ T r dr from the
    /// bore to r, σ_rr = αE/r² [(r² − a²)/(b² − a²) I(b) − I(r)] and σ_θθ = αE/r² [(r² + a²)/(b² − a²) I(b) +
    /// I(r) − T r²]. A uniform rise causes no stress.
    ///
    /// `rim_load_pa` is αE ΔT with the temperature difference ΔT between rim and bore.
    pub fn stress_of_square_rise(&self, rim_load_pa: f64, radius_m: f64) -> RadialAndHoop {
        let (a, b, r) = (self.bore_radius_m, self.rim_radius_m, radius_m);
        let primitive = |r: f64| r.powi(4) / 4.0 - 2.0 * a * r.powi(3) / 3.0 + a * a * r * r / 2.0;
        let moment = |r: f64| (primitive(r) - primitive(a)) / (b - a).powi(2);
        let rise = ((r - a) / (b - a)).powi(2);
        let ring = b * b - a * a;
        let factor = rim_load_pa / (r * r);
        RadialAndHoop {
            radial_pa: factor * ((r * r - a * a) / ring * moment(b) - moment(r)),
            hoop_pa: factor * ((r * r + a * a) / ring * moment(b) + moment(r) - rise * r * r),
        }
    }

    /// Thermal stress of steady heat conduction between rim and bore, T = ΔT ln(r/a)/ln(b/a): equation (g) of
    /// section 150, where the bore is the hotter edge.
    pub fn stress_of_conducted_heat(&self, rim_load_pa: f64, radius_m: f64) -> RadialAndHoop {
        let (a, b, r) = (self.bore_radius_m, self.rim_radius_m, radius_m);
        let logarithm = (b / a).ln();
        let ring = a * a / (b * b - a * a) * logarithm;
        let factor = rim_load_pa / (2.0 * logarithm);
        let share = b * b / (r * r);
        RadialAndHoop {
            radial_pa: factor * ((b / r).ln() + ring * (1.0 - share)),
            hoop_pa: factor * ((b / r).ln() - 1.0 + ring * (1.0 + share)),
        }
    }

    /// ∫ ρh x² dA = ρh π (b⁴ − a⁴)/4, in kg·m²: the inertia of the tilt w = x.
    pub fn tilt_inertia_kg_m2(&self, mass_per_area_kg_per_m2: f64) -> f64 {
        let fourths = self.rim_radius_m.powi(4) - self.bore_radius_m.powi(4);
        0.25 * PI * mass_per_area_kg_per_m2 * fourths
    }

    /// ω² of the tilt at rest under the tension p at the rim, in 1/s²: 4 p b²/ρ(b⁴ − a⁴), if bending is
    /// negligible; see [`super::tilt`].
    pub fn tilt_frequency_squared_under_rim_tension(
        &self,
        density_kg_per_m3: f64,
        tension_pa: f64,
    ) -> f64 {
        let fourths = self.rim_radius_m.powi(4) - self.bore_radius_m.powi(4);
        4.0 * tension_pa * self.rim_radius_m.powi(2) / (density_kg_per_m3 * fourths)
    }

    fn squares(&self, radius_m: f64) -> [f64; 3] {
        [self.bore_radius_m, self.rim_radius_m, radius_m].map(|r| r * r)
    }
}
