//! Temperature of an annular disk that is heated along a ring and cooled by convection.
//!
//! The temperature T above the surroundings is uniform over the thickness h and around the axis. With a heat transfer
//! coefficient α on both faces and no heat through the edges at a and b, k h (T″ + T′/r) = 2α T beside the ring. With
//! m = √(2α/kh), u(r) = I₀(mr) K₁(ma) + K₀(mr) I₁(ma) satisfies the condition at a, and v(r), with b in the place of a,
//! the condition at b. The ring of radius c emits P = 2πc k h (T′(c−) − T′(c+)).
//!
//! Source: H. S. Carslaw & J. C. Jaeger, *Conduction of Heat in Solids*, 2nd ed., 1959, sections 4.5 to 4.7 and 7.4 (fins and
//! rings that lose heat from their faces).

use std::f64::consts::PI;

use super::bessel::four;

/// A disk that conducts and convects.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CooledDisk {
    /// Inner radius a.
    pub inner_radius_m: f64,
    /// Outer radius b.
    pub outer_radius_m: f64,
    /// Thickness h.
    pub thickness_m: f64,
    /// Conductivity k.
    pub conductivity_w_per_m_k: f64,
    /// Heat transfer coefficient α of each face.
    pub convection_w_per_m2_k: f64,
}

impl CooledDisk {
    /// Temperature above the surroundings at a radius under a power that is emitted along a ring of another radius.
    pub fn rise_k(&self, radius_m: f64, power_w: f64, ring_radius_m: f64) -> f64 {
        let (k, h) = (self.conductivity_w_per_m_k, self.thickness_m);
        let m = (2.0 * self.convection_w_per_m2_k / (k * h)).sqrt();
        let inner = [radius_m.min(ring_radius_m), self.inner_radius_m].map(|r| m * r);
        let outer = [radius_m.max(ring_radius_m), self.outer_radius_m].map(|r| m * r);
        let ring = m * ring_radius_m;
        let [u, v] = [along(inner[0], inner[1]), along(outer[0], outer[1])];
        let [at_u, at_v] = [along(ring, inner[1]), along(ring, outer[1])];
        let wronskian = m * (at_u[1] * at_v[0] - at_u[0] * at_v[1]);
        power_w * u[0] * v[0] / (2.0 * PI * ring_radius_m * k * h * wronskian)
    }
}

/// The function I₀(x) K₁(e) + K₀(x) I₁(e), and its derivative by x, which vanishes at x = e.
fn along(x: f64, edge: f64) -> [f64; 2] {
    let (at, end) = (four(0, x), four(1, edge));
    let apart = x - edge;
    let [rising, falling] = [apart.exp(), (-apart).exp()];
    [
        at.scaled_i.value * end.scaled_k.value * rising
            + at.scaled_k.value * end.scaled_i.value * falling,
        at.scaled_i.slope * end.scaled_k.value * rising
            + at.scaled_k.slope * end.scaled_i.value * falling,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    const DISK: CooledDisk = CooledDisk {
        inner_radius_m: 0.1,
        outer_radius_m: 0.355,
        thickness_m: 0.0028,
        conductivity_w_per_m_k: 45.0,
        convection_w_per_m2_k: 60.0,
    };

    /// The faces give off the power that the ring emits.
    #[test]
    fn the_power_is_that_of_convection() {
        let count = 20_000;
        let width = (DISK.outer_radius_m - DISK.inner_radius_m) / count as f64;
        for ring in [0.12, 0.25, 0.355] {
            let given = |k: usize| {
                let r = DISK.inner_radius_m + (k as f64 + 0.5) * width;
                2.0 * DISK.convection_w_per_m2_k * DISK.rise_k(r, 80.0, ring) * 2.0 * PI * r * width
            };
            let sum: f64 = (0..count).map(given).sum();
            assert!((sum - 80.0).abs() < 1e-5, "{ring}: {sum}");
        }
    }

    /// A disk that conducts well has one temperature: P over the area of both faces and α.
    #[test]
    fn a_good_conductor_has_one_temperature() {
        let disk = CooledDisk {
            conductivity_w_per_m_k: 1e7,
            ..DISK
        };
        let area = 2.0 * PI * (0.355_f64.powi(2) - 0.1_f64.powi(2));
        let even = 80.0 / (area * 60.0);
        for r in [0.1, 0.2, 0.355] {
            let found = disk.rise_k(r, 80.0, 0.25);
            assert!((found / even - 1.0).abs() < 1e-4, "{r}: {found} {even}");
        }
    }
}
