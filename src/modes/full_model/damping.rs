//! Forces that depend on the velocity of a blade, by the structure of its full model.

use faer::traits::math_utils::from_f64;
use faer::{Mat, MatRef, c64};
use nalgebra::DMatrix;

use super::coupling::{Columns, Kept};
use super::elimination::Shift;
use super::harmonic::Harmonic;
use crate::model::plate::Plate;

/// Inertia, gyroscopic forces and damping; without damping its coefficients are zero.
#[derive(Debug)]
pub struct Damping {
    /// C_i of the material and the area on which air acts, for every harmonic; empty without damping of the
    /// blade.
    blade: Vec<[DMatrix<f64>; 2]>,
    /// Resistance c of the air over the mass per area.
    air_per_s: f64,
    /// Share s of the rotation speed with which the air turns.
    air_rotation_share: f64,
    /// τ of dampers proportional to the springs, such as those of a single guide: K_g + λC = (1 + τλ) K_g.
    guide_retardation_s: f64,
    /// Dampers that are not proportional to the springs.
    dampers: Option<Columns>,
}

impl Damping {
    /// The forces of a plate; `None` if there are forces without a potential, or if dampers take too many
    /// columns.
    pub fn of(plate: &Plate, harmonics: &[Harmonic]) -> Option<Self> {
        if plate.contact.nonconservative_stiffness().is_some() {
            return None;
        }
        let of_contact = plate.contact.damping();
        let retardation = proportion(plate.contact.stiffness(), of_contact);
        let dampers = match (retardation, of_contact) {
            (None, Some(dampers)) => Some(Columns::new(dampers, harmonics, Kept::Few)?),
            _ => None,
        };
        let unit = |size: usize| DMatrix::identity(size, size);
        let blocks = plate.damping.iter().flat_map(|_| &plate.harmonics);
        let blade = blocks.map(|block| {
            let size = block.bending.nrows();
            let area = block.area.clone().unwrap_or_else(|| unit(size));
            let material = block.material_damping.clone();
            [material.unwrap_or_else(|| DMatrix::zeros(size, size)), area]
        });
        let mass = plate.blade.mass_per_area_kg_per_m2();
        let of_blade = plate.damping.as_ref();
        Some(Damping {
            blade: blade.collect(),
            air_per_s: of_blade.map_or(0.0, |d| d.air_n_s_per_m3 / mass),
            air_rotation_share: of_blade.map_or(0.0, |d| d.air_rotation_share),
            guide_retardation_s: retardation.unwrap_or(0.0),
            dampers,
        })
    }

    /// The block of a wave, B_n + μ² + C_i μ + c(λ + insΩ), μ = λ + inΩ, from B_n; n is negative for the wave
    /// c + is.
    pub fn dynamic(
        &self,
        harmonic: usize,
        stiffness: DMatrix<f64>,
        speed_rad_per_s: f64,
        lambda: c64,
        n: f64,
    ) -> DMatrix<c64> {
        let turned = lambda + c64::new(0.0, n * speed_rad_per_s);
        let mut block = stiffness.map(|x| c64::new(x, 0.0));
        (0..block.nrows()).for_each(|i| block[(i, i)] += turned * turned);
        if let Some([material, area]) = self.blade.get(harmonic) {
            let air_turns = c64::new(0.0, n * speed_rad_per_s * self.air_rotation_share);
            add_scaled(&mut block, turned, material);
            add_scaled(&mut block, (lambda + air_turns) * self.air_per_s, area);
        }
        block
    }

    /// The columns of springs and dampers for solves, each with its W(λ).
    pub fn weighted<'a, T: Shift>(
        &'a self,
        springs: &'a Columns,
        lambda: T,
    ) -> Vec<(MatRef<'a, f64>, T)> {
        let one = from_f64::<T>(1.0);
        let retarded = lambda * from_f64::<T>(self.guide_retardation_s);
        let springs = (springs.few(), one + retarded);
        let dampers = self.dampers.iter().map(|columns| (columns.few(), lambda));
        [springs].into_iter().chain(dampers).collect()
    }
}

/// Retardation τ, in s, if C = τK; `None` otherwise.
fn proportion(stiffness: Option<&Mat<f64>>, damping: Option<&Mat<f64>>) -> Option<f64> {
    const ROUNDING: f64 = 1e-12;
    let (stiffness, damping) = stiffness.zip(damping)?;
    let share = damping.norm_l2() / stiffness.norm_l2();
    let differs = (damping - faer::Scale(share) * stiffness).norm_l2();
    (differs <= ROUNDING * damping.norm_l2()).then_some(share)
}

/// Adds a real block times a number to a complex block.
fn add_scaled(sum: &mut DMatrix<c64>, factor: c64, block: &DMatrix<f64>) {
    if factor != c64::new(0.0, 0.0) {
        sum.zip_apply(block, |sum, own| *sum += factor * own);
    }
}
