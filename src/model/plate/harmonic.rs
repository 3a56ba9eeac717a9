//! Bending and membrane stiffness of one circumferential harmonic.

use faer::Mat;
use nalgebra::{DMatrix, DVector};

use crate::model::linalg::{SymmetricEigen, view};
use crate::model::scene::Blade;

use super::radial::RadialBasis;
use super::stress::CentrifugalStress;

/// Stiffness matrices of n nodal diameters, J × J, in 1/s² or dimensionless: the basis is scaled so that the
/// mass matrix is the identity. They are the same for cos nθ and sin nθ. Those of n = 0 in a plate also have a row for each head of a
/// guide arm.
#[derive(Debug, Clone)]
pub struct HarmonicBlock {
    /// Number of nodal diameters n.
    pub diameters: usize,
    /// K_b: ∫ D/ρh₀ [κ_r² + κ_θ² + 2ν κ_r κ_θ + 2(1−ν) κ_rθ²] r dr, in 1/s², with the reference thickness h₀
    /// of the mass, times c_n of a slotted blade; and the clamp, k/ρh₀ a R′R′ at a, if it yields to a slope.
    pub bending: DMatrix<f64>,
    /// K_σ − N: ∫ h/h₀ [σ̂_rr R′R′ + n² σ̂_θθ RR/r²] r dr − n² δ, dimensionless (times Ω²).
    pub spin: DMatrix<f64>,
    /// K_m, in 1/s², of a membrane stress that is independent of the speed.
    pub membrane: Option<DMatrix<f64>>,
    /// C_i, in 1/s: material damping, which turns with the blade.
    pub material_damping: Option<DMatrix<f64>>,
    /// ∫ RR r dr, for the damping of the air; `None` if it is the identity.
    pub area: Option<DMatrix<f64>>,
}

impl HarmonicBlock {
    /// Assembles bending and rotation for n nodal diameters.
    pub(crate) fn new(
        blade: &Blade,
        stress: &CentrifugalStress,
        basis: &RadialBasis,
        diameters: usize,
    ) -> Self {
        let n2 = (diameters * diameters) as f64;
        let n = diameters as f64;
        let nu = blade.material.poisson_ratio;
        let specific_rigidity = blade.flexural_rigidity_n_m() / blade.mass_per_area_kg_per_m2();
        let size = basis.count();
        let mut bending = DMatrix::zeros(size, size);
        let mut spin = DMatrix::from_diagonal_element(size, size, -n2);
        let mut area = (!blade.is_plain()).then(|| DMatrix::zeros(size, size));
        let steep = stress.slotted().map(|slotted| slotted.stress.rule());
        for (r, w) in steep.as_ref().unwrap_or(basis.rule()).iter() {
            let f = basis.evaluate(diameters, r);
            let radial = &f.curvature;
            let hoop: Vec<f64> = (0..size)
                .map(|j| f.slope[j] / r - n2 * f.value[j] / (r * r))
                .collect();
            let twist: Vec<f64> = (0..size)
                .map(|j| n * (f.slope[j] / r - f.value[j] / (r * r)))
                .collect();
            let (tension_r, tension_t) = (stress.radial_m2(r), stress.hoop_m2(r));
            let thickness = blade.thickness_ratio(r);
            let specific_rigidity = specific_rigidity * thickness.powi(3);
            let tensioned = w * r * thickness;
            if let Some(area) = &mut area {
                let value = DVector::from_column_slice(&f.value);
                area.ger(w * r, &value, &value, 1.0);
            }
            for j in 0..size {
                for k in 0..=j {
                    let energy = radial[j] * radial[k]
                        + hoop[j] * hoop[k]
                        + nu * (radial[j] * hoop[k] + hoop[j] * radial[k])
                        + 2.0 * (1.0 - nu) * twist[j] * twist[k];
                    bending[(j, k)] += w * r * specific_rigidity * energy;
                    let tension = tension_r * f.slope[j] * f.slope[k]
                        + n2 * tension_t * f.value[j] * f.value[k] / (r * r);
                    spin[(j, k)] += tensioned * tension;
                }
            }
        }
        if let Some(clamp) = blade.clamp_n_m_per_rad_per_m {
            let edge = blade.inner_radius_m;
            let slope = DVector::from_vec(basis.evaluate(diameters, edge).slope);
            let specific = clamp * edge / blade.mass_per_area_kg_per_m2();
            bending.ger(specific, &slope, &slope, 1.0);
        }
        if let Some(slotted) = stress.slotted() {
            bending *= slotted.bending_on(diameters, blade.split_branch);
        }
        let mut block = HarmonicBlock {
            diameters,
            bending,
            spin,
            membrane: None,
            material_damping: None,
            area,
        };
        block.free_rigid_motion(basis);
        block.bending.fill_upper_triangle_with_lower_triangle();
        block.spin.fill_upper_triangle_with_lower_triangle();
        block
    }

    /// Stiffness K_b + K_m + Ω²(K_σ − N) in the frame fixed in space, in 1/s²: it is singular at the speeds at which
    /// a wave of the free blade stands still.
    pub(crate) fn stiffness_at(&self, speed_rad_per_s: f64) -> Mat<f64> {
        let speed2 = speed_rad_per_s.powi(2);
        Mat::from_fn(self.bending.nrows(), self.bending.ncols(), |j, k| {
            let membrane = self.membrane.as_ref().map_or(0.0, |m| m[(j, k)]);
            self.bending[(j, k)] + membrane + speed2 * self.spin[(j, k)]
        })
    }

    /// Stiffness K_b + K_m + Ω²K_σ in the body frame, in 1/s²: its eigenvalues are ω² of the undamped free
    /// blade. K_σ = (K_σ − N) + n².
    pub fn body_frame_stiffness(&self, speed_rad_per_s: f64) -> Mat<f64> {
        let turned2 = (self.diameters as f64 * speed_rad_per_s).powi(2);
        let mut stiffness = self.stiffness_at(speed_rad_per_s);
        (0..stiffness.nrows()).for_each(|j| stiffness[(j, j)] += turned2);
        stiffness
    }

    /// Sets the material damping η K_b + 2ζ(K_b + K_m)^½ of a retardation time η and a damping ratio ζ. By the
    /// second term every mode of n nodal diameters of the blade at rest without guides has the ratio ζ.
    pub(crate) fn set_material_damping(&mut self, retardation_s: f64, ratio: f64) {
        let mut damping = retardation_s * &self.bending;
        if ratio > 0.0 {
            let stiffness = match &self.membrane {
                Some(membrane) => &self.bending + membrane,
                None => self.bending.clone(),
            };
            // Numbers that are not finite are refused by every eigenproblem of the damped blade.
            let eigen = SymmetricEigen::or_nan(view(&stiffness));
            let order = stiffness.nrows();
            // A buckled shape has a negative eigenvalue and does not oscillate, so that it has no damping ratio.
            let scaled = Mat::from_fn(order, order, |i, k| {
                2.0 * ratio * eigen.values[k].max(0.0).sqrt() * eigen.vectors[(i, k)]
            });
            let own = scaled * eigen.vectors.transpose();
            damping += DMatrix::from_fn(order, order, |i, k| own[(i, k)]);
        }
        self.material_damping = Some(damping);
    }

    /// Sets K_b and K_σ − N to zero on heave and tilt, on which they vanish exactly, because neither bends the
    /// blade and rotation does not stiffen them. Rounding would leave 1e-16 of neighbouring entries, whose root
    /// is a spurious slow motion of 1e-8.
    fn free_rigid_motion(&mut self, basis: &RadialBasis) {
        if basis.has_rigid_motions() && self.diameters <= 1 {
            self.bending.column_mut(0).fill(0.0);
            self.spin.column_mut(0).fill(0.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::{Scene, ThicknessRow};

    /// K_σ − N vanishes on the tilt to rounding by quadrature alone, before exact zeros are set.
    #[test]
    fn rotation_does_not_stiffen_the_tilt() {
        let blade = *Scene::paper().blade();
        let basis = RadialBasis::new(&blade, 8);
        let stress = CentrifugalStress::new(&blade);
        for j in [0, 3] {
            let (mut tension, mut inertia) = (0.0, 0.0);
            for (r, w) in basis.rule().iter() {
                let f = basis.evaluate(1, r);
                tension += w
                    * r
                    * (stress.radial_m2(r) * f.slope[0] * f.slope[j]
                        + stress.hoop_m2(r) * f.value[0] * f.value[j] / (r * r));
                inertia += w * r * f.value[0] * f.value[j];
            }
            assert!(
                (tension - inertia).abs() < 1e-13,
                "{j}: {tension} {inertia}"
            );
        }
    }

    /// wᵀ(K_σ − N)w = 0 for w = f(x cos α + y sin α), for any bore and thickness: each chord is in
    /// equilibrium, ∫ hσ_xx dy = ρΩ² ∫ h y² dy, where N has (∂θw)² = y² f′². The tilt is the simplest case;
    /// here all powers up to the sixth are tested, which contain the harmonics n = p, p − 2, ….
    #[test]
    fn rotation_neither_stiffens_nor_softens_bending_about_a_chord() {
        let row = |radius_m, thickness_m| ThicknessRow {
            radius_m,
            thickness_m,
        };
        let profiles = [
            vec![],
            vec![row(0.2, 2.8e-3), row(0.2, 2.0e-3), row(0.3, 2.4e-3)],
        ];
        for (profile, bore_m) in profiles.into_iter().zip([0.05, 0.2]) {
            let scene = Scene::paper().edited(|saw| {
                saw.guides.clear();
                saw.cut = None;
                saw.blade.inner_diameter_m = bore_m;
                saw.blade.profile = profile;
            });
            let blade = *scene.unwrap().blade();
            let basis = RadialBasis::new(&blade, 8);
            let stress = CentrifugalStress::new(&blade);
            for power in 1..=6_usize {
                let (mut sum, mut inertia) = (0.0, 0.0);
                let mut factor = 2.0_f64.powi(1 - power as i32);
                for step in 0..=power / 2 {
                    let n = power - 2 * step;
                    let block = HarmonicBlock::new(&blade, &stress, &basis, n);
                    let mut q = DVector::zeros(basis.count());
                    for (r, w) in basis.rule().iter() {
                        let weight = w * r * blade.thickness_ratio(r) * r.powi(power as i32);
                        q += DVector::from_vec(basis.evaluate(n, r).value) * weight;
                    }
                    // xᵖ = Σ 2^(1−p) C(p, s) rᵖ cos nθ, with half of it for n = 0, whose ∫dθ is twice π.
                    let share = if n == 0 {
                        0.5 * factor * factor
                    } else {
                        factor * factor
                    };
                    sum += share * q.dot(&(&block.spin * &q));
                    inertia += share * (n * n) as f64 * q.dot(&q);
                    factor *= (power - step) as f64 / (step + 1) as f64;
                }
                assert!(sum.abs() < 1e-10 * inertia, "{power}: {sum:e} {inertia:e}");
            }
        }
    }
}
