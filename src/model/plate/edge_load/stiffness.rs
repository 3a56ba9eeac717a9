//! Geometric stiffness K_e of the edge stress.

use faer::Mat;
use nalgebra::{DMatrix, DVector};

use crate::model::plate::{Plate, quadrature};

use super::EdgeStress;
use super::angular::{Phase, Wave, triple_product};

const PHASES: [Phase; 2] = [Phase::Cosine, Phase::Sine];

/// K_e in the mass-normalised basis of the plate, in 1/s², symmetric:
///
/// K_e,ij = ∫∫ h [σ_rr φᵢ,r φⱼ,r + σ_θθ φᵢ,θ φⱼ,θ / r² + σ_rθ S_ij / r] r dr dθ,
/// S_ij = φᵢ,r φⱼ,θ + φᵢ,θ φⱼ,r.
///
/// Tension adds to K_e, compression reduces it. On the rigid tilts K_e is the moment of dead forces on a tilted
/// blade; on heave it vanishes.
pub fn edge_stiffness(plate: &Plate, stress: &EdgeStress) -> Mat<f64> {
    let size = plate.basis.count();
    let max_order = stress.max_order().min(2 * plate.max_diameters());
    let samples = Sample::on_blade(plate, sufficient_points(size, max_order));
    let integrals = RadialIntegrals::of_orders(&samples, stress, max_order);
    let mut stiffness = Mat::zeros(plate.degrees_of_freedom(), plate.degrees_of_freedom());
    let waves: Vec<Wave> = (0..=plate.max_diameters())
        .flat_map(|n| PHASES.map(|phase| Wave::new(n, phase)))
        .filter(|wave| wave.order > 0 || wave.phase == Phase::Cosine)
        .collect();
    for (index, &left) in waves.iter().enumerate() {
        for &right in &waves[..=index] {
            let block = plate.basis.turned(
                left.order,
                right.order,
                between(&integrals, size, left, right),
            );
            let norm = plate.angular_norm(left.order) * plate.angular_norm(right.order);
            let factor = plate.blade.thickness_m / norm;
            let (row, column) = (offset(plate, left), offset(plate, right));
            for j in 0..size {
                for k in 0..size {
                    let value = factor * block[(j, k)];
                    stiffness[(row + j, column + k)] = value;
                    stiffness[(column + k, row + j)] = value;
                }
            }
        }
    }
    if plate.basis.has_rigid_motions() {
        // Heave does no work against a dead force. A stiffness from rounding errors could be negative and
        // would then appear as an instability.
        stiffness.row_mut(0).fill(0.0);
        stiffness.col_mut(0).fill(0.0);
    }
    stiffness
}

fn offset(plate: &Plate, wave: Wave) -> usize {
    let cosine = plate.offset(wave.order);
    match wave.phase {
        Phase::Cosine => cosine,
        Phase::Sine => cosine + plate.basis.count(),
    }
}

/// The J × J block of two waves; only the orders |n₁ ± n₂| of the stress contribute.
fn between(
    integrals: &[[RadialIntegrals; 2]],
    size: usize,
    left: Wave,
    right: Wave,
) -> DMatrix<f64> {
    let mut block = DMatrix::zeros(size, size);
    let (turned_left, turned_right) = (left.derivative(), right.derivative());
    let mut orders = vec![left.order.abs_diff(right.order), left.order + right.order];
    orders.dedup();
    for order in orders {
        let Some(parts) = integrals.get(order) else {
            continue;
        };
        for (part, phase) in parts.iter().zip(PHASES) {
            let stress = Wave::new(order, phase);
            let mut add = |factor: f64, matrix: &DMatrix<f64>| {
                if factor != 0.0 {
                    block += matrix * factor;
                }
            };
            add(triple_product(stress, left, right), &part.radial);
            add(
                triple_product(stress, turned_left, turned_right),
                &part.hoop,
            );
            add(triple_product(stress, left, turned_right), &part.shear);
            add(
                triple_product(stress, turned_left, right),
                &part.shear_transposed,
            );
        }
    }
    block
}

/// Radial integrals of the cosine or the sine of one order of the stress, in Pa/m².
struct RadialIntegrals {
    /// ∫ σ_rr R_j′ R_k′ r dr.
    radial: DMatrix<f64>,
    /// ∫ σ_θθ R_j R_k / r dr.
    hoop: DMatrix<f64>,
    /// ∫ σ_rθ R_j′ R_k dr.
    shear: DMatrix<f64>,
    /// ∫ σ_rθ R_j R_k′ dr.
    shear_transposed: DMatrix<f64>,
}

impl RadialIntegrals {
    /// Integrals [cosine, sine] of the orders 0 … `max_order`.
    fn of_orders(samples: &[Sample], stress: &EdgeStress, max_order: usize) -> Vec<[Self; 2]> {
        (0..=max_order)
            .map(|order| [0, 1].map(|part| Self::new(samples, stress, order, part)))
            .collect()
    }

    fn new(samples: &[Sample], stress: &EdgeStress, order: usize, part: usize) -> Self {
        let size = samples.first().map_or(0, |sample| sample.value.len());
        let mut radial = DMatrix::zeros(size, size);
        let mut hoop = DMatrix::zeros(size, size);
        let mut shear = DMatrix::zeros(size, size);
        for sample in samples {
            let Sample {
                radius_m: r,
                weight_m: w,
                value,
                slope,
            } = sample;
            let at = stress.harmonic(order, *r);
            radial.ger(w * r * at.radial_pa[part], slope, slope, 1.0);
            hoop.ger(w / r * at.hoop_pa[part], value, value, 1.0);
            shear.ger(w * at.shear_pa[part], slope, value, 1.0);
        }
        RadialIntegrals {
            shear_transposed: shear.transpose(),
            radial,
            hoop,
            shear,
        }
    }
}

/// Number of points per panel for J functions and stresses that vary as r^m to r^−(m+2). The polynomials of degree
/// m + 2J in the integrand need J + m/2 + 1 points. Within a panel r changes by at most a factor of two, so that
/// the negative powers need few more.
fn sufficient_points(functions: usize, max_order: usize) -> usize {
    functions + max_order / 2 + 12
}

/// The radial functions common to all n ≠ 1 at a quadrature point.
struct Sample {
    radius_m: f64,
    /// Weight of the rule times the thickness relative to `thickness_m` of the blade.
    weight_m: f64,
    value: DVector<f64>,
    slope: DVector<f64>,
}

impl Sample {
    fn on_blade(plate: &Plate, points: usize) -> Vec<Sample> {
        quadrature::piecewise(&plate.blade.edges_m(), points)
            .iter()
            .map(|(r, w)| {
                let functions = plate.basis.evaluate(0, r);
                Sample {
                    radius_m: r,
                    weight_m: w * plate.blade.thickness_ratio(r),
                    value: DVector::from_vec(functions.value),
                    slope: DVector::from_vec(functions.slope),
                }
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plate::{BoreForce, Resolution, RimForce};
    use crate::model::scene::{Bore, InPlane, Mount, Scene};

    /// Twice the points change no integral of the basis of the accuracy `reference`.
    #[test]
    fn the_quadrature_is_exact_to_rounding() {
        for (ratio, bore) in [
            (0.28, Bore::Free),
            (0.1, Bore::Clamped(InPlane::Free)),
            (0.01, Bore::Free),
            (0.52, Bore::Clamped(InPlane::Fixed)),
        ] {
            let scene = Scene::paper()
                .edited(|saw| {
                    let diameter_m = ratio * saw.blade.outer_diameter_m;
                    saw.blade.inner_diameter_m = diameter_m;
                    saw.mount = match bore {
                        Bore::Free => Mount::Spline {},
                        Bore::Clamped(in_plane) => Mount::Collar {
                            diameter_m,
                            in_plane,
                            clamp_stiffness_n_m_per_rad_per_m: None,
                        },
                    };
                    saw.guides.clear();
                })
                .unwrap();
            let resolution = Resolution {
                max_diameters: 24,
                radial_functions: 12,
            };
            let plate = Plate::new(&scene, resolution);
            let load = RimForce {
                angle_rad: 0.4,
                radial_n: 90.0,
                tangential_n: 1000.0,
            };
            let reaction = BoreForce {
                angle_rad: 1.9,
                radial_n: -300.0,
                tangential_n: 2000.0,
            };
            let stress = EdgeStress::with_reaction(&plate.blade, &[load], &[reaction], 48);
            let points = sufficient_points(12, 48);
            let [usual, dense] = [points, 2 * points].map(|points| {
                RadialIntegrals::of_orders(&Sample::on_blade(&plate, points), &stress, 48)
            });
            for (order, (usual, dense)) in usual.iter().zip(&dense).enumerate() {
                for (usual, dense) in usual.iter().zip(dense) {
                    let scale = dense.radial.norm() + dense.hoop.norm() + dense.shear.norm();
                    let error = (&usual.radial - &dense.radial).norm()
                        + (&usual.hoop - &dense.hoop).norm()
                        + (&usual.shear - &dense.shear).norm();
                    assert!(
                        error <= 1e-12 * scale,
                        "a/b = {ratio}, m = {order}: {error:e}"
                    );
                }
            }
        }
    }
}
