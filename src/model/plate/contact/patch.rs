//! Integrals of products of two functions over a patch fixed in space.
//!
//! A circle intersects a patch in a few arcs, symmetric about the centre line. The integrals of cos kψ over these
//! arcs are elementary, so that only the radius needs quadrature.

use faer::Col;
use nalgebra::DMatrix;

use super::super::Plate;
use super::super::radial::RadialBasis;

/// Intersection of a patch with a circle.
pub struct Circle {
    /// Radius of the circle.
    pub radius_m: f64,
    /// Quadrature weight of the circle for each radian of its arcs, as a share of the whole patch.
    pub weight: f64,
    /// Arcs with 0 ≤ ψ ≤ π, each of which has a mirror image at −ψ; `None` for the point ψ = 0.
    pub arcs: Option<Vec<[f64; 2]>>,
}

impl Circle {
    /// Weight times ∫ cos nψ dψ, ∫ x cos nψ dψ and ∫ y sin nψ dψ over the arcs, with x = r cos ψ and y = r sin ψ.
    pub fn moments(&self, n: usize) -> [f64; 3] {
        let (weight, r) = (self.weight, self.radius_m);
        let Some(arcs) = &self.arcs else {
            return [weight, weight * r, 0.0];
        };
        let [below, own, above] =
            [n.abs_diff(1), n, n + 1].map(|k| weight * cosine_integral(arcs, k));
        [own, 0.5 * r * (below + above), 0.5 * r * (below - above)]
    }
}

/// Mean of φᵢφⱼ over a patch as one J × J matrix for each k = |n ± m|: Q_k = Σ weight R_j R_l ∫ cos kψ dψ, where ψ
/// is the angle from the centre line.
struct PatchHarmonics {
    angle_rad: f64,
    by_order: Vec<DMatrix<f64>>,
}

/// Mean of φᵢφⱼ over a patch whose centre line is at an angle: Σ weight ∫ φᵢφⱼ dψ over its circles, in 1/kg, N × N,
/// symmetric, positive semidefinite.
pub fn coupling(
    plate: &Plate,
    angle_rad: f64,
    circles: impl Iterator<Item = Circle>,
) -> faer::Mat<f64> {
    let (basis, max_diameters) = (&plate.basis, plate.max_diameters());
    let harmonics = PatchHarmonics::new(basis, angle_rad, circles, 2 * max_diameters);
    let size = basis.count();
    let mut coupling = faer::Mat::zeros(plate.degrees_of_freedom(), plate.degrees_of_freedom());
    for n in 0..=max_diameters {
        for m in 0..=n {
            let [cos_cos, cos_sin, sin_cos, sin_sin] = harmonics
                .between(n, m)
                .map(|block| basis.turned(n, m, block));
            let norm = plate.angular_norm(n) * plate.angular_norm(m);
            let mut put = |row: usize, column: usize, block: &DMatrix<f64>| {
                for j in 0..size {
                    for k in 0..size {
                        let value = block[(j, k)] / norm;
                        coupling[(row + j, column + k)] = value;
                        coupling[(column + k, row + j)] = value;
                    }
                }
            };
            let (cos_n, cos_m) = (plate.offset(n), plate.offset(m));
            put(cos_n, cos_m, &cos_cos);
            if m > 0 {
                put(cos_n, cos_m + size, &cos_sin);
                put(cos_n + size, cos_m + size, &sin_sin);
            }
            if n > 0 {
                put(cos_n + size, cos_m, &sin_cos);
            }
        }
    }
    coupling
}

/// Means over a patch whose centre line is at an angle, Σ weight ∫ … dψ over its circles: of φᵢ, in 1/√kg, and of xφᵢ and yφᵢ, in
/// m/√kg, with x along the centre line from the axis of the blade and y across it. Of a point the mean of yφᵢ is zero.
pub fn means<'a>(
    plate: &Plate,
    angle_rad: f64,
    circles: impl Iterator<Item = &'a Circle>,
) -> [Col<f64>; 3] {
    let size = plate.basis.count();
    let mut means = [(); 3].map(|()| Col::zeros(plate.degrees_of_freedom()));
    for circle in circles {
        // The radial functions of one nodal diameter differ from those of all others.
        let functions = [0, 1].map(|n| plate.basis.evaluate(n, circle.radius_m).value);
        for n in 0..=plate.max_diameters() {
            let (sin, cos) = (n as f64 * angle_rad).sin_cos();
            let [one, along, across] = circle.moments(n);
            // The parts of cos n(α + ψ) and sin n(α + ψ) that are even in ψ, and those that are odd.
            let factors = [
                (one, [cos, sin]),
                (along, [cos, sin]),
                (across, [-sin, cos]),
            ];
            for (mean, (moment, [of_cosine, of_sine])) in means.iter_mut().zip(factors) {
                let weight = moment / plate.angular_norm(n);
                for (j, value) in functions[usize::from(n == 1)].iter().enumerate() {
                    let cosine = plate.offset(n) + j;
                    mean[cosine] += weight * value * of_cosine;
                    if n > 0 {
                        mean[cosine + size] += weight * value * of_sine;
                    }
                }
            }
        }
    }
    means
}

/// Number of points of a radial rule that integrates the product of two radial functions and of the integral over
/// the arcs, up to the order 2 n_max.
pub fn sufficient_points(plate: &Plate) -> usize {
    plate.basis.count() + plate.max_diameters() + 12
}

impl PatchHarmonics {
    fn new(
        basis: &RadialBasis,
        angle_rad: f64,
        circles: impl Iterator<Item = Circle>,
        max_order: usize,
    ) -> Self {
        let size = basis.count();
        let mut by_order = vec![DMatrix::zeros(size, size); max_order + 1];
        for circle in circles {
            let values = nalgebra::DVector::from_vec(basis.evaluate(0, circle.radius_m).value);
            let outer = &values * values.transpose();
            for (k, matrix) in by_order.iter_mut().enumerate() {
                let angular = circle
                    .arcs
                    .as_ref()
                    .map_or(1.0, |arcs| cosine_integral(arcs, k));
                *matrix += &outer * (circle.weight * angular);
            }
        }
        PatchHarmonics {
            angle_rad,
            by_order,
        }
    }

    /// Blocks [cos n·cos m, cos n·sin m, sin n·cos m, sin n·sin m] of the coupling for n ≥ m, by the
    /// product-to-sum identities and a rotation by the angle of the centre line.
    fn between(&self, n: usize, m: usize) -> [DMatrix<f64>; 4] {
        let (difference, sum) = (n - m, n + m);
        let (sin_d, cos_d) = (difference as f64 * self.angle_rad).sin_cos();
        let (sin_s, cos_s) = (sum as f64 * self.angle_rad).sin_cos();
        let (q_d, q_s) = (&self.by_order[difference], &self.by_order[sum]);
        [
            (q_d * cos_d + q_s * cos_s) * 0.5,
            (q_s * sin_s - q_d * sin_d) * 0.5,
            (q_s * sin_s + q_d * sin_d) * 0.5,
            (q_d * cos_d - q_s * cos_s) * 0.5,
        ]
    }
}

/// ∫ cos kψ dψ over the arcs and their mirror images.
fn cosine_integral(arcs: &[[f64; 2]], k: usize) -> f64 {
    let k = k as f64;
    arcs.iter()
        .map(|[low, high]| {
            if k == 0.0 {
                2.0 * (high - low)
            } else {
                2.0 * ((k * high).sin() - (k * low).sin()) / k
            }
        })
        .sum()
}
