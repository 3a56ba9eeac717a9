//! Functions of one variable on an element, and the integrals of bending and of stress in the plane.
//!
//! A function of radius and angle on an element is a sum of products f(r) g(θ), and every energy is a sum of products of one
//! integral over the radius and one over the angle.

use std::f64::consts::TAU;

use super::super::quadrature::smooth;
use crate::model::scene::Blade;

/// Points of the rule on an element: exact for products of two cubics, and negative powers of the radius to rounding.
const POINTS: usize = 6;

/// Values of some functions with their first and second derivatives.
pub type Functions<const N: usize> = [[f64; N]; 3];

/// A bilinear form of the functions of an element.
pub type Form<const N: usize> = [[f64; N]; N];

/// Cubics of Hermite at x on an element of length l that begins at 0: value and slope at its beginning, then at its end.
pub fn hermite(x: f64, l: f64) -> Functions<4> {
    let t = x / l;
    [
        [
            1.0 - t * t * (3.0 - 2.0 * t),
            l * t * (1.0 - t).powi(2),
            t * t * (3.0 - 2.0 * t),
            l * t * t * (t - 1.0),
        ],
        [
            6.0 * t * (t - 1.0) / l,
            (1.0 - t) * (1.0 - 3.0 * t),
            6.0 * t * (1.0 - t) / l,
            t * (3.0 * t - 2.0),
        ],
        [
            (12.0 * t - 6.0) / (l * l),
            (6.0 * t - 4.0) / l,
            (6.0 - 12.0 * t) / (l * l),
            (6.0 * t - 2.0) / l,
        ],
    ]
}

/// Quadratics of Lagrange at x on an element of length l that begins at 0: values at its beginning, middle and end.
pub fn lagrange(x: f64, l: f64) -> Functions<3> {
    let t = x / l;
    [
        [
            (1.0 - t) * (1.0 - 2.0 * t),
            4.0 * t * (1.0 - t),
            t * (2.0 * t - 1.0),
        ],
        [
            (4.0 * t - 3.0) / l,
            (4.0 - 8.0 * t) / l,
            (4.0 * t - 1.0) / l,
        ],
        [4.0 / (l * l), -8.0 / (l * l), 4.0 / (l * l)],
    ]
}

/// D/ρh of the reference thickness, in m⁴/s².
pub fn specific_rigidity(blade: &Blade) -> f64 {
    blade.flexural_rigidity_n_m() / blade.mass_per_area_kg_per_m2()
}

/// Radius of the circle of the mass of teeth, and this mass per ρh and radian, in m².
fn rim(blade: &Blade) -> Option<(f64, f64)> {
    let per_radian = TAU * blade.mass_per_area_kg_per_m2();
    blade
        .rim
        .map(|rim| (rim.radius_m, rim.mass_kg / per_radian))
}

/// Integrals over the angle on an element: of gg, g′g′, gg″ and g″g″.
pub struct Around<const N: usize> {
    pub values: Form<N>,
    pub slopes: Form<N>,
    pub value_slope: Form<N>,
    pub value_curvature: Form<N>,
    pub curvatures: Form<N>,
    /// Of g alone.
    pub mean: [f64; N],
}

impl<const N: usize> Around<N> {
    /// The integrals on an element of an angle.
    pub fn new(angle_rad: f64, functions: fn(f64, f64) -> Functions<N>) -> Self {
        let zero = [[0.0; N]; N];
        let mut all = Around {
            values: zero,
            slopes: zero,
            value_slope: zero,
            value_curvature: zero,
            curvatures: zero,
            mean: [0.0; N],
        };
        for (x, weight) in smooth(0.0, angle_rad, POINTS).iter() {
            let [g, d, dd] = functions(x, angle_rad);
            for q in 0..N {
                all.mean[q] += weight * g[q];
                for s in 0..N {
                    all.values[q][s] += weight * g[q] * g[s];
                    all.slopes[q][s] += weight * d[q] * d[s];
                    all.value_slope[q][s] += weight * g[q] * d[s];
                    all.value_curvature[q][s] += weight * g[q] * dd[s];
                    all.curvatures[q][s] += weight * dd[q] * dd[s];
                }
            }
        }
        all
    }
}

/// Integrals of bending over the radius on an element, in 1/s² with the mass ρh r dr dθ of the reference thickness:
///
/// ∫ D/ρh [κ_r² + κ_θ² + 2ν κ_rκ_θ + 2(1−ν) κ_rθ²] r dr with κ_r = f″g, κ_θ = f′g/r + fg″/r², κ_rθ = (f′/r − f/r²) g′.
#[derive(Clone, Copy, Default)]
pub struct Bending {
    /// Beside gg.
    even: Form<4>,
    /// Beside gg″, the second function with g″.
    mixed: Form<4>,
    /// Beside g″g″.
    hoop: Form<4>,
    /// Beside g′g′.
    twist: Form<4>,
    /// Mass, beside gg.
    mass: Form<4>,
}

impl Bending {
    /// The integrals on an element; `is_held` if it begins at a clamp.
    pub fn new(blade: &Blade, [from, to]: [f64; 2], is_held: bool) -> Self {
        let mut sum = Bending::default();
        let (l, nu) = (to - from, blade.material.poisson_ratio);
        for (r, weight) in smooth(from, to, POINTS).iter() {
            let [f, d, dd] = hermite(r - from, l);
            let thickness = blade.thickness_ratio(r);
            let rigid = specific_rigidity(blade) * thickness.powi(3) * weight * r;
            let hoop = |p: usize| f[p] / (r * r);
            let slope = |p: usize| d[p] / r;
            let twist = |p: usize| slope(p) - hoop(p);
            for p in 0..4 {
                for s in 0..4 {
                    let both = dd[p] * slope(s) + slope(p) * dd[s];
                    sum.even[p][s] += rigid * (dd[p] * dd[s] + slope(p) * slope(s) + nu * both);
                    sum.mixed[p][s] += rigid * (slope(p) + nu * dd[p]) * hoop(s);
                    sum.hoop[p][s] += rigid * hoop(p) * hoop(s);
                    sum.twist[p][s] += rigid * 2.0 * (1.0 - nu) * twist(p) * twist(s);
                    sum.mass[p][s] += weight * r * thickness * f[p] * f[s];
                }
            }
        }
        if let Some((radius_m, mass)) = rim(blade)
            && radius_m > from + 1e-9 * l
            && radius_m < to + 1e-9 * l
        {
            let [f, ..] = hermite(radius_m - from, l);
            (0..4).for_each(|p| (0..4).for_each(|s| sum.mass[p][s] += mass * f[p] * f[s]));
        }
        if let Some(clamp) = blade.clamp_n_m_per_rad_per_m.filter(|_| is_held) {
            sum.even[1][1] += clamp / blade.mass_per_area_kg_per_m2() * from;
        }
        sum
    }

    /// Stiffness of the functions (p, q) and (s, u) of an element.
    pub fn stiffness(&self, around: &Around<4>, [p, q]: [usize; 2], [s, u]: [usize; 2]) -> f64 {
        self.even[p][s] * around.values[q][u]
            + self.mixed[p][s] * around.value_curvature[q][u]
            + self.mixed[s][p] * around.value_curvature[u][q]
            + self.hoop[p][s] * around.curvatures[q][u]
            + self.twist[p][s] * around.slopes[q][u]
    }

    /// Mass of the functions (p, q) and (s, u) of an element.
    pub fn mass(&self, around: &Around<4>, [p, q]: [usize; 2], [s, u]: [usize; 2]) -> f64 {
        self.mass[p][s] * around.values[q][u]
    }

    /// Stiffness and mass of f(r) cos nθ, without the integral over the angle.
    pub fn of_wave(&self, n: usize) -> [Form<4>; 2] {
        let n2 = (n * n) as f64;
        let mut stiffness = Form::<4>::default();
        for (p, row) in stiffness.iter_mut().enumerate() {
            for (s, entry) in row.iter_mut().enumerate() {
                *entry = self.even[p][s] - n2 * (self.mixed[p][s] + self.mixed[s][p])
                    + n2 * n2 * self.hoop[p][s]
                    + n2 * self.twist[p][s];
            }
        }
        [stiffness, self.mass]
    }
}

/// Integrals of plane stress over the radius on an element, for displacements u and v of quadratics with Young's modulus
/// 1 − ν² and the thickness relative to that of the reference, and of the load r per volume.
#[derive(Clone, Copy, Default)]
pub struct InPlane {
    /// u and u, beside gg and g′g′.
    radial: [Form<3>; 2],
    /// v and v, beside gg and g′g′.
    hoop: [Form<3>; 2],
    /// u and v, beside gg′ and g′g.
    mixed: [Form<3>; 2],
    /// Load of u, beside g.
    pub load: [f64; 3],
}

impl InPlane {
    /// The integrals on an element.
    pub fn new(blade: &Blade, [from, to]: [f64; 2]) -> Self {
        let mut sum = InPlane::default();
        let (l, nu) = (to - from, blade.material.poisson_ratio);
        let shear = 0.5 * (1.0 - nu);
        for (r, weight) in smooth(from, to, POINTS).iter() {
            let [f, d, _] = lagrange(r - from, l);
            let area = weight * r * blade.thickness_ratio(r);
            for p in 0..3 {
                sum.load[p] += area * r * f[p];
                for s in 0..3 {
                    let [fp, fs] = [f[p] / r, f[s] / r];
                    let extension = d[p] * d[s] + fp * fs + nu * (d[p] * fs + fp * d[s]);
                    sum.radial[0][p][s] += area * extension;
                    sum.radial[1][p][s] += area * shear * fp * fs;
                    sum.hoop[0][p][s] += area * shear * (d[p] - fp) * (d[s] - fs);
                    sum.hoop[1][p][s] += area * fp * fs;
                    sum.mixed[0][p][s] += area * (fp + nu * d[p]) * fs;
                    sum.mixed[1][p][s] += area * shear * fp * (d[s] - fs);
                }
            }
        }
        if let Some((radius_m, mass)) = rim(blade)
            && radius_m > from + 1e-9 * l
            && radius_m < to + 1e-9 * l
        {
            let [f, ..] = lagrange(radius_m - from, l);
            (0..3).for_each(|p| sum.load[p] += mass * radius_m * f[p]);
        }
        sum
    }

    /// Stiffness of the functions (p, q) and (s, u) of an element, of the displacements 0, radial, or 1, along the circle.
    pub fn stiffness(
        &self,
        around: &Around<3>,
        [p, q, own]: [usize; 3],
        [s, u, other]: [usize; 3],
    ) -> f64 {
        let product = |[values, slopes]: &[Form<3>; 2]| {
            values[p][s] * around.values[q][u] + slopes[p][s] * around.slopes[q][u]
        };
        match [own, other] {
            [0, 0] => product(&self.radial),
            [1, 1] => product(&self.hoop),
            [0, _] => {
                self.mixed[0][p][s] * around.value_slope[q][u]
                    + self.mixed[1][p][s] * around.value_slope[u][q]
            }
            _ => self.stiffness(around, [s, u, other], [p, q, own]),
        }
    }
}
