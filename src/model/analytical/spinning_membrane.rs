//! Frequencies of a disk whose bending stiffness is negligible compared with centrifugal tension. In the body
//! frame they are proportional to the speed.
//!
//! Source: H. Lamb & R. V. Southwell, *The vibrations of a spinning disk*, Proc. R. Soc. Lond. A
//! 99 (1921), 272–280.

/// Ratio ω²/Ω² of a full disk with a free rim, n nodal diameters and s nodal circles:
/// [(3 + ν)(n + 2s)(n + 2s + 2) − (1 + 3ν) n²]/8, where ω is the frequency on the disk.
///
/// A bore of the ratio a/b changes ω²/Ω² by terms of order (a/b)².
pub fn disk_frequency_ratio_squared(
    poisson_ratio: f64,
    nodal_diameters: usize,
    nodal_circles: usize,
) -> f64 {
    let n = nodal_diameters as f64;
    let degree = n + 2.0 * nodal_circles as f64;
    ((3.0 + poisson_ratio) * degree * (degree + 2.0) - (1.0 + 3.0 * poisson_ratio) * n * n) / 8.0
}

/// Ratio ω²/Ω² of an annulus with free edges that vibrates without nodal diameters and with l ≥ 1 nodal circles:
/// (3 + ν) l (l + 1)/2, for any bore.
///
/// With σ_rr = (3 + ν)/8 ρΩ² (r² − a²)(b² − r²)/r² and x = (2r² − a² − b²)/(b² − a²) the equation
/// of the membrane is that of Legendre's polynomials, (1 − x²)w″ − 2x w′ + l(l + 1)w = 0.
pub fn annulus_umbrella_ratio_squared(poisson_ratio: f64, nodal_circles: usize) -> f64 {
    let l = nodal_circles as f64;
    0.5 * (3.0 + poisson_ratio) * l * (l + 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The two formulas agree for a full disk without nodal diameters. The tilt of a full disk turns with it
    /// for any ν.
    #[test]
    fn the_two_formulas_agree_for_a_full_disk() {
        for nu in [-0.5, 0.0, 0.3, 0.49] {
            for circles in 1..6 {
                let disk = disk_frequency_ratio_squared(nu, 0, circles);
                let annulus = annulus_umbrella_ratio_squared(nu, circles);
                assert!((disk / annulus - 1.0).abs() < 1e-14);
            }
            assert!((disk_frequency_ratio_squared(nu, 1, 0) - 1.0).abs() < 1e-14);
        }
    }
}
