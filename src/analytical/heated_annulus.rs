//! Thermal stress of a flat annulus with free edges, hotter at the rim than at the bore.
//!
//! With I(r) = ∫ T r dr from the bore to r,
//! σ_rr = αE/r² [(r² − a²)/(b² − a²) I(b) − I(r)] and
//! σ_θθ = αE/r² [(r² + a²)/(b² − a²) I(b) + I(r) − T r²].
//! `rim_load_pa` is αE ΔT, ΔT the rise of the rim over the bore. A uniform rise adds nothing.
//!
//! Source: S. P. Timoshenko & J. N. Goodier, *Theory of Elasticity*, 3rd ed. (1970), section 150.

use super::RadialAndHoop;

/// T = ΔT ((r − a)/(b − a))².
pub fn stress_of_square_rise(
    bore_radius_m: f64,
    rim_radius_m: f64,
    rim_load_pa: f64,
    radius_m: f64,
) -> RadialAndHoop {
    let (a, b, r) = (bore_radius_m, rim_radius_m, radius_m);
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

/// Heat conducted steadily between rim and bore, T = ΔT ln(r/a)/ln(b/a): equation (g) of the
/// section, there with the bore the hotter edge.
pub fn stress_of_conducted_heat(
    bore_radius_m: f64,
    rim_radius_m: f64,
    rim_load_pa: f64,
    radius_m: f64,
) -> RadialAndHoop {
    let (a, b, r) = (bore_radius_m, rim_radius_m, radius_m);
    let logarithm = (b / a).ln();
    let ring = a * a / (b * b - a * a) * logarithm;
    let factor = rim_load_pa / (2.0 * logarithm);
    let share = b * b / (r * r);
    RadialAndHoop {
        radial_pa: factor * ((b / r).ln() + ring * (1.0 - share)),
        hoop_pa: factor * ((b / r).ln() - 1.0 + ring * (1.0 + share)),
    }
}
