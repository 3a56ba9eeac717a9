//! Stress of a flat annulus that rotates steadily.
//!
//! Source: S. P. Timoshenko & J. N. Goodier, *Theory of Elasticity*, 3rd ed. (1970), section 32.

use super::RadialAndHoop;

/// Both edges free: σ_rr = (3+ν)/8 ρΩ² (a² + b² − a²b²/r² − r²),
/// σ_θθ = (3+ν)/8 ρΩ² (a² + b² + a²b²/r² − (1+3ν)/(3+ν) r²).
///
/// `load_pa_per_m2` is ρΩ².
pub fn stress_with_free_edges(
    bore_radius_m: f64,
    rim_radius_m: f64,
    poisson_ratio: f64,
    load_pa_per_m2: f64,
    radius_m: f64,
) -> RadialAndHoop {
    let [aa, bb, rr] = [bore_radius_m, rim_radius_m, radius_m].map(|r| r * r);
    let factor = (3.0 + poisson_ratio) / 8.0 * load_pa_per_m2;
    let share = (1.0 + 3.0 * poisson_ratio) / (3.0 + poisson_ratio);
    RadialAndHoop {
        radial_pa: factor * (aa + bb - aa * bb / rr - rr),
        hoop_pa: factor * (aa + bb + aa * bb / rr - share * rr),
    }
}

/// The bore held, u(a) = 0, the rim free. With v = u E/((1 − ν²)ρΩ²) = A r + B/r − r³/8,
/// σ_rr = ρΩ² (v′ + ν v/r) and σ_θθ = ρΩ² (v/r + ν v′); A and B from v(a) = 0, σ_rr(b) = 0.
///
/// `load_pa_per_m2` is ρΩ².
pub fn stress_with_held_bore(
    bore_radius_m: f64,
    rim_radius_m: f64,
    poisson_ratio: f64,
    load_pa_per_m2: f64,
    radius_m: f64,
) -> RadialAndHoop {
    let nu = poisson_ratio;
    let [aa, bb, rr] = [bore_radius_m, rim_radius_m, radius_m].map(|r| r * r);
    // A a² + B = a⁴/8; (1 + ν) A b² − (1 − ν) B = (3 + ν) b⁴/8.
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
