//! Inertia, and all forces on a blade without a potential, by the structure of its full model.

use faer::traits::math_utils::from_f64;
use faer::{Mat, MatRef, c64};
use nalgebra::DMatrix;

use super::contact_forces::ContactForces;
use super::coupling::Columns;
use super::elimination::Shift;
use super::harmonic::Harmonic;
use crate::model::plate::Plate;

/// Inertia, gyroscopic forces, damping and forces without a potential; without them its coefficients are zero.
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
    /// Dampers that are not proportional to the springs, and forces without a potential, but for `states`.
    contact: Option<ContactForces>,
    /// The internal states of pads, whose unknowns belong to the block of no nodal diameters: index, and the elements of K_n
    /// and of C on the diagonal. Beside the stiffness of a state in K₀ both are exact, unlike columns.
    states: Vec<(usize, [f64; 2])>,
}

impl Damping {
    /// The forces of a plate; `None` if those of contacts take too many columns.
    pub fn of(plate: &Plate, harmonics: &[Harmonic]) -> Option<Self> {
        let terms = &plate.contact;
        let retardation = match terms.nonconservative_stiffness() {
            Some(_) => None,
            None => proportion(terms.stiffness(), terms.damping()),
        };
        let states = plate.states();
        let contact = match retardation {
            None if !terms.is_conservative() => {
                Some(ContactForces::new(terms, states.clone(), harmonics)?)
            }
            _ => None,
        };
        let on_diagonal = |state: usize| {
            let of =
                |matrix: Option<&Mat<f64>>| matrix.map_or(0.0, |matrix| matrix[(state, state)]);
            [of(terms.nonconservative_stiffness()), of(terms.damping())]
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
            contact,
            states: states.map(|state| (state, on_diagonal(state))).collect(),
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
        if harmonic == 0 {
            for &(state, [stiffness, damping]) in &self.states {
                block[(state, state)] += stiffness + lambda * damping;
            }
        }
        block
    }

    /// The columns of contacts for solves, each with its W(λ).
    pub fn weighted<'a, T: Shift>(
        &'a self,
        springs: &'a Columns,
        lambda: T,
    ) -> Vec<(MatRef<'a, f64>, Mat<T>)> {
        let retarded = from_f64::<T>(1.0) + lambda * from_f64::<T>(self.guide_retardation_s);
        let springs = springs.few();
        let springs = (springs, scaled_unit(springs.ncols(), retarded));
        let contact = self.contact.iter().map(|forces| forces.weighted(lambda));
        [springs].into_iter().chain(contact).collect()
    }
}

/// A number times the unit matrix.
pub fn scaled_unit<T: Shift>(order: usize, factor: T) -> Mat<T> {
    let mut unit = Mat::zeros(order, order);
    unit.diagonal_mut().fill(factor);
    unit
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
