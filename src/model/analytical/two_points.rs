//! Deflection of an annular plate that lies on two opposite points of its rim under its own weight.
//!
//! In polar coordinates the plate equation has the solutions r^m cos nθ with m = ±n and 2 ± n. The edges are free, and the
//! two reactions are a line load at the rim, W/(2πb) + Σ W/(πb) cos nθ over even n > 0.
//!
//! Source: S. Timoshenko & S. Woinowsky-Krieger, *Theory of Plates and Shells*, 2nd ed. (1959): section 16 for n = 0, section 65
//! for plates on points of their rim, section 22 for the conditions of a free edge.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix2, Matrix4, Vector2, Vector4};

/// Highest number of nodal diameters of the series, whose terms fall with the third power of this number.
const TERMS: i32 = 400;

/// A plate of uniform thickness with free edges.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlateOnTwoPoints {
    /// Radius of the bore.
    pub inner_radius_m: f64,
    /// Radius of the rim.
    pub outer_radius_m: f64,
    /// Flexural rigidity D.
    pub rigidity_n_m: f64,
    /// Poisson's ratio.
    pub poisson_ratio: f64,
    /// Weight per area.
    pub weight_n_per_m2: f64,
}

impl PlateOnTwoPoints {
    /// Height in m of the middle plane at r, θ above the two supports at θ = 0 and π; negative where the plate sags.
    pub fn height_m(&self, radius_m: f64, angle_rad: f64) -> f64 {
        self.shape(radius_m, angle_rad) - self.shape(self.outer_radius_m, 0.0)
    }

    fn shape(&self, radius_m: f64, angle_rad: f64) -> f64 {
        let even = (1..=TERMS / 2).map(|k| 2 * k);
        let waves = even.map(|n| self.wave(n, radius_m) * (f64::from(n) * angle_rad).cos());
        self.round(radius_m) + waves.sum::<f64>()
    }

    fn weight_n(&self) -> f64 {
        let (a, b) = (self.inner_radius_m, self.outer_radius_m);
        self.weight_n_per_m2 * PI * (b - a) * (b + a)
    }

    /// Deflection of n = 0, under the weight and a uniform reaction along the rim, which balance each other.
    fn round(&self, r: f64) -> f64 {
        let (a, b, nu) = (self.inner_radius_m, self.outer_radius_m, self.poisson_ratio);
        let (fourth, logarithmic) = (
            -self.weight_n_per_m2 / (64.0 * self.rigidity_n_m),
            self.weight_n_per_m2 * a * a / (8.0 * self.rigidity_n_m),
        );
        // Each entry is w″ + ν w′/r, which is proportional to the radial bending moment, for w = r⁴, r² ln r,
        // r² and ln r.
        let moments = |r: f64| {
            [
                (12.0 + 4.0 * nu) * r * r,
                2.0 * (1.0 + nu) * r.ln() + 3.0 + nu,
                2.0 * (1.0 + nu),
                (nu - 1.0) / (r * r),
            ]
        };
        let [inner, outer] = [a, b].map(moments);
        let known = |m: [f64; 4]| -(fourth * m[0] + logarithmic * m[1]);
        let matrix = Matrix2::new(inner[2], inner[3], outer[2], outer[3]);
        let right = Vector2::new(known(inner), known(outer));
        let found = matrix.lu().solve(&right);
        found.map_or(f64::NAN, |found| {
            let square = r * r;
            fourth * square * square
                + (logarithmic * r.ln() + found[0]) * square
                + found[1] * r.ln()
        })
    }

    /// Factor of cos nθ at a radius.
    fn wave(&self, n: i32, r: f64) -> f64 {
        let (a, b, nu) = (self.inner_radius_m, self.outer_radius_m, self.poisson_ratio);
        let n2 = f64::from(n * n);
        // The first two powers are (r/b)^m and grow with r, the last two are (r/a)^m and do not, so that none
        // overflows.
        let powers = [(n, b), (n + 2, b), (-n, a), (2 - n, a)];
        let moment = |(m, scale): (i32, f64), r: f64| {
            let m_f = f64::from(m);
            (m_f * (m_f - 1.0) + nu * (m_f - n2)) * (r / scale).powi(m)
        };
        let shear = |(m, scale): (i32, f64), r: f64| {
            let m_f = f64::from(m);
            let own = (m_f * m_f - n2) * (m_f - 2.0) - (1.0 - nu) * n2 * (m_f - 1.0);
            own * (r / scale).powi(m)
        };
        let rows = [
            powers.map(|power| moment(power, a)),
            powers.map(|power| shear(power, a)),
            powers.map(|power| moment(power, b)),
            powers.map(|power| shear(power, b)),
        ];
        let matrix = Matrix4::from_fn(|row, column| rows[row][column]);
        // The shear force V = −D r⁻³ Σ cₖ own (r/scale)^m, with the amplitudes cₖ, equals the line load at
        // the rim.
        let load = 2.0 * self.weight_n() / (TAU * b);
        let right = Vector4::new(0.0, 0.0, 0.0, -load * b.powi(3) / self.rigidity_n_m);
        matrix.lu().solve(&right).map_or(f64::NAN, |found| {
            let of = |(k, (m, scale)): (usize, (i32, f64))| found[k] * (r / scale).powi(m);
            powers.into_iter().enumerate().map(of).sum()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Timoshenko & Woinowsky-Krieger, section 65, for a full plate with ν = 0.25: 0.269 q b⁴/D in the middle and 0.371 q b⁴/D at
    /// the rim between the supports. A bore of a hundredth of the radius changes the first by less than 0.1 %.
    #[test]
    fn a_full_plate_sags_as_the_textbook_says() {
        let plate = PlateOnTwoPoints {
            inner_radius_m: 0.002,
            outer_radius_m: 1.0,
            rigidity_n_m: 1.0,
            poisson_ratio: 0.25,
            weight_n_per_m2: 1.0,
        };
        let middle = plate.height_m(plate.inner_radius_m, 0.5 * PI);
        let rim = plate.height_m(1.0, 0.5 * PI);
        assert!((middle + 0.269).abs() < 1e-3, "{middle}");
        assert!((rim + 0.371).abs() < 1e-3, "{rim}");
    }
}
