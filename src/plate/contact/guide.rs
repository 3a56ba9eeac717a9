//! Guide pads: how a rectangle fixed in space couples the harmonics.
//!
//! On the circle of radius r a rectangle covers a few arcs. The integrals of
//! cos kθ over those arcs are elementary, so only the radius needs quadrature,
//! and a pad of any size, clipped to the blade, comes out to rounding.

use faer::Scale;
use nalgebra::DMatrix;

use crate::scene::{Blade, Guide};

use super::super::Plate;
use super::super::quadrature;
use super::super::radial::RadialBasis;
use super::{Contact, ContactTerms};

/// ∫ φᵢ φⱼ dA / (pad area) as one J × J matrix for each k = |n ± m|:
/// Q_k = ∫ R_j R_l (∫ cos kψ dψ) r dr, ψ from the pad's centre line.
struct PadHarmonics {
    angle_rad: f64,
    by_order: Vec<DMatrix<f64>>,
}

impl Contact for Guide {
    fn add_to(&self, plate: &Plate, terms: &mut ContactTerms) {
        let coupling = coupling(&plate.blade, &plate.basis, plate, self);
        if self.stiffness_n_per_m > 0.0 {
            terms.add_stiffness(&(Scale(self.stiffness_n_per_m) * &coupling));
        }
        if self.damping_n_s_per_m > 0.0 {
            terms.add_damping(&(Scale(self.damping_n_s_per_m) * &coupling));
        }
    }
}

/// Mean of φᵢφⱼ over a pad, in 1/kg: times the pad's stiffness it is K_g,
/// times its damping C. N × N, symmetric, positive semidefinite.
fn coupling(blade: &Blade, basis: &RadialBasis, plate: &Plate, pad: &Guide) -> faer::Mat<f64> {
    let max_diameters = plate.max_diameters();
    let harmonics = PadHarmonics::new(blade, basis, pad, 2 * max_diameters);
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

impl PadHarmonics {
    fn new(blade: &Blade, basis: &RadialBasis, pad: &Guide, max_order: usize) -> Self {
        let size = basis.count();
        let mut by_order = vec![DMatrix::zeros(size, size); max_order + 1];
        let mut add = |r: f64, arc_weights: &[f64]| {
            let values = nalgebra::DVector::from_vec(basis.evaluate(0, r).value);
            let outer = &values * values.transpose();
            for (matrix, &weight) in by_order.iter_mut().zip(arc_weights) {
                *matrix += &outer * weight;
            }
        };
        if pad.is_point() {
            add(pad.radius_m, &vec![1.0; max_order + 1]);
        } else {
            let area = pad.radial_length_m * pad.tangential_length_m;
            let points = basis.count() + max_order / 2 + 12;
            for (low, high) in smooth_radii(blade, pad) {
                for (r, w) in quadrature::root_ended(low, high, points).iter() {
                    let arcs = arcs(pad, r);
                    let weights: Vec<f64> = (0..=max_order)
                        .map(|k| w * r / area * cosine_integral(&arcs, k))
                        .collect();
                    add(r, &weights);
                }
            }
        }
        PadHarmonics {
            angle_rad: pad.angle_rad,
            by_order,
        }
    }

    /// Blocks [cos n·cos m, cos n·sin m, sin n·cos m, sin n·sin m] of the coupling,
    /// from the products-to-sums rules and the turn by the pad's angle.
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

/// Sides of the pad in its own frame: x from the axis along the radius of its
/// centre, y across; (x_near, x_far, y_half).
fn sides(pad: &Guide) -> (f64, f64, f64) {
    let half = 0.5 * pad.radial_length_m;
    (
        pad.radius_m - half,
        pad.radius_m + half,
        0.5 * pad.tangential_length_m,
    )
}

/// Intervals of r, clipped to the blade, on which the arcs are smooth inside:
/// they are cut where a circle touches a side or passes a corner.
fn smooth_radii(blade: &Blade, pad: &Guide) -> Vec<(f64, f64)> {
    let (near, far, half) = sides(pad);
    let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
    let mut cuts = vec![
        near.abs(),
        far.abs(),
        half,
        near.hypot(half),
        far.hypot(half),
    ];
    cuts.extend(blade.edges_m());
    cuts.retain(|r| (a..=b).contains(r));
    cuts.sort_by(f64::total_cmp);
    cuts.windows(2)
        .map(|pair| (pair[0], pair[1]))
        .filter(|(low, high)| high - low > 1e-12 * b)
        .filter(|(low, high)| !arcs(pad, 0.5 * (low + high)).is_empty())
        .collect()
}

/// Arcs 0 ≤ |ψ| ≤ π of the circle of radius r inside the pad, upper half only.
fn arcs(pad: &Guide, r: f64) -> Vec<(f64, f64)> {
    use std::f64::consts::PI;
    let (near, far, half) = sides(pad);
    if near >= r || far <= -r {
        return Vec::new();
    }
    let from = (far / r).min(1.0).acos();
    let to = (near / r).max(-1.0).acos();
    let rise = (half / r).min(1.0).asin();
    [(0.0, rise), (PI - rise, PI)]
        .into_iter()
        .map(|(low, high)| (low.max(from), high.min(to)))
        .filter(|(low, high)| high > low)
        .collect()
}

/// ∫ cos kψ dψ over the arcs and their mirror images.
fn cosine_integral(arcs: &[(f64, f64)], k: usize) -> f64 {
    let k = k as f64;
    arcs.iter()
        .map(|(low, high)| {
            if k == 0.0 {
                2.0 * (high - low)
            } else {
                2.0 * ((k * high).sin() - (k * low).sin()) / k
            }
        })
        .sum()
}
