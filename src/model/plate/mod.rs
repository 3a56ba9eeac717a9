//! Matrices of the spinning plate and of its contacts and loads.
//!
//! A [`Scene`] and a [`Resolution`], the size of the basis, give a [`Plate`], the matrices of the scene in
//! this basis. This module solves no eigenvalue problem.
//!
//! The deflection of a Kirchhoff plate on a < r < b is w(r, θ, t) = Σ qᵢ(t) φᵢ(r, θ) in the frame fixed in
//! space, with φ = R_nj(r)·{cos nθ, sin nθ}/√(ρh₀ π(1+δ_n0)) in 1/√kg and the reference thickness h₀, so that
//! the mass matrix ∫ φᵢφⱼ dm is the identity; q is in √kg·m. The N = J(2 n_max + 1) unknowns are J cosines for
//! n = 0, then J cosines and J sines for each n ≥ 1. With M = 1 every stiffness is in 1/s² and every damping
//! in 1/s.
//!
//! References: Timoshenko & Woinowsky-Krieger, *Theory of Plates and Shells*, 2nd ed., chapters 3 and 9, for
//! the plate; C. D. Mote, *Free vibration of initially stressed circular disks*, J. Eng. Ind. 87 (1965),
//! 258–264, for stress in its plane; W. D. Iwan & T. L. Moeller, J. Appl. Mech. 43 (1976), 485–490, for loads
//! fixed in space.

mod contact;
mod edge_load;
mod harmonic;
mod in_plane;
mod light_gap;
mod membrane;
mod quadrature;
mod radial;
mod stress;
mod stretching;

pub(crate) use contact::GapPotential;
use contact::LiftingPads;
pub use contact::{Contact, ContactTerms};
#[doc(hidden)]
pub use edge_load::{BoreForce, EdgeStress, RimForce, edge_stiffness};
#[doc(hidden)]
pub use harmonic::HarmonicBlock;
pub use light_gap::{LightGap, StraightEdgeReading};
pub(crate) use membrane::{MembraneSource, MembraneStress, heated_disk, membrane_stiffness};
pub(crate) use radial::RadialBasis;
pub use stretching::{ReducedStretching, Stretching, StretchingError};

use std::ops::RangeInclusive;

use faer::Mat;

use stress::CentrifugalStress;

use crate::model::scene::{Accuracy, Blade, Cut, CutRun, DampingFile, RefusedValue, Scene};

/// Size of the basis of the deflection.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Resolution {
    /// Largest number of nodal diameters n_max.
    pub max_diameters: usize,
    /// Number J of polynomials over the radius for each n; steps and kinks of the thickness add further
    /// functions.
    pub radial_functions: usize,
}

/// Largest number of nodal diameters, that of the slowest standing wave of a blade whose flange has 0.994 of its
/// diameter.
pub(crate) const MOST_DIAMETERS: usize = 300;
/// Largest number of radial functions; polynomials of more lose digits.
const MOST_FUNCTIONS: usize = 30;
/// Largest number of unknowns, which memory limits: that of the finest basis that a tolerance selects.
pub(crate) const MOST_UNKNOWNS: usize = 4230;

impl Resolution {
    /// A basis with a given number of radial functions of a blade, as reports state it: see
    /// [`Resolution::radial_functions_on`].
    ///
    /// # Errors
    /// [`RefusedValue`] if the basis is too small to bend, or larger than memory allows.
    pub fn new(
        max_diameters: usize,
        radial_functions: usize,
        blade: &Blade,
    ) -> Result<Self, RefusedValue> {
        let knots = RadialBasis::functions_at_knots(blade);
        let most = |diameters: usize| MOST_FUNCTIONS.min(MOST_UNKNOWNS / (2 * diameters + 1));
        let diameters = max_diameters.clamp(2, MOST_DIAMETERS);
        let (least, most) = (2 + knots, most(diameters) + knots);
        if max_diameters == diameters && (least..=most).contains(&radial_functions) {
            return Ok(Resolution {
                max_diameters,
                radial_functions: radial_functions - knots,
            });
        }
        let given = format!("{max_diameters},{radial_functions}");
        let allowed = format!(
            "diameters 2 to {MOST_DIAMETERS} and, for {diameters} diameters of this blade, radial functions {least} to {most}"
        );
        let remedy = "16,8 is usual, and more functions for a thickness with steps";
        Err(RefusedValue::new("basis", given, allowed, remedy))
    }

    /// The basis of a named accuracy.
    pub fn of(accuracy: Accuracy) -> Self {
        let (max_diameters, radial_functions) = match accuracy {
            Accuracy::Draft => (8, 5),
            Accuracy::Design => (16, 8),
            Accuracy::Reference => (24, 12),
        };
        Resolution {
            max_diameters,
            radial_functions,
        }
    }

    /// Number of radial functions of a blade for each n: the polynomials, and the functions that steps and kinks of
    /// the thickness add.
    pub fn radial_functions_on(&self, blade: &Blade) -> usize {
        self.radial_functions + RadialBasis::functions_at_knots(blade)
    }

    /// Number of unknowns of a blade, with these functions.
    pub fn degrees_of_freedom_on(&self, blade: &Blade) -> usize {
        self.radial_functions_on(blade) * (2 * self.max_diameters + 1)
    }

    /// Number of unknowns of a blade of uniform thickness, J (2 n_max + 1).
    pub fn degrees_of_freedom(&self) -> usize {
        self.radial_functions * (2 * self.max_diameters + 1)
    }
}

/// The matrices of a scene in a basis, M = 1. Terms that the scene does not contain are not assembled.
#[derive(Debug, Clone)]
pub struct Plate {
    /// The part of the blade that deflects.
    pub blade: Blade,
    /// Size of the basis.
    pub resolution: Resolution,
    /// Radial functions R_nj.
    pub(crate) basis: RadialBasis,
    /// Centrifugal stress.
    spinning: CentrifugalStress,
    /// Stiffness matrices K_b, K_m and K_σ − N of n = 0 … n_max nodal diameters.
    pub harmonics: Vec<HarmonicBlock>,
    /// Terms of the guides and of the contacts that [`Plate::with_contact`] adds.
    pub contact: ContactTerms,
    /// Pads that lift off, if the scene has any; `contact` contains them as pads in permanent contact.
    lifting: Option<LiftingPads>,
    /// K_e, in 1/s², N × N, symmetric, if [`Plate::with_edge_loads`] has applied forces to the rim.
    pub edge_stiffness: Option<Mat<f64>>,
    /// Material and air damping, if the scene has any.
    pub(crate) damping: Option<DampingFile>,
    /// Stress of heat, roll tension or manufacture, if the scene has any.
    pub membrane: Option<MembraneStress>,
    /// Radial functions of n ≠ 1 and of n = 1 at the sampled radii.
    samples: [Vec<Vec<f64>>; 2],
}

/// Number of sampled radii, which resolves every nodal circle of a mode in a diagram.
const SAMPLED_RADII: usize = 41;

fn sampled_radii(blade: &Blade) -> impl Iterator<Item = f64> + use<> {
    let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
    (0..SAMPLED_RADII).map(move |k| a + (b - a) * k as f64 / (SAMPLED_RADII - 1) as f64)
}

/// Stiffness of the free blade in a range of nodal diameters, without damping.
fn harmonics(
    blade: &Blade,
    basis: &RadialBasis,
    spinning: &CentrifugalStress,
    membrane: Option<&MembraneStress>,
    diameters: RangeInclusive<usize>,
) -> Vec<HarmonicBlock> {
    let mut blocks: Vec<HarmonicBlock> = diameters
        .clone()
        .map(|n| HarmonicBlock::new(blade, spinning, basis, n))
        .collect();
    if let Some(stress) = membrane {
        let stiffness = membrane_stiffness(basis, stress, diameters);
        for (block, stiffness) in blocks.iter_mut().zip(stiffness) {
            block.membrane = Some(stiffness);
        }
    }
    blocks
}

impl Plate {
    /// Assembles the matrices of a scene in a basis of a size that [`Resolution::new`] accepts.
    pub fn new(scene: &Scene, resolution: Resolution) -> Self {
        let basis = RadialBasis::new(scene.blade(), resolution.radial_functions);
        let spinning = CentrifugalStress::new(scene.blade());
        let membrane = scene
            .membrane()
            .and_then(|named| MembraneStress::new(scene.blade(), named));
        let all = 0..=resolution.max_diameters;
        let mut harmonics = harmonics(scene.blade(), &basis, &spinning, membrane.as_ref(), all);
        let damping = scene.damping();
        if let Some(damping) = damping.filter(|damping| damping.is_material()) {
            for (n, block) in harmonics.iter_mut().enumerate() {
                block
                    .set_material_damping(damping.material_retardation_time_s, damping.ratio_of(n));
            }
        }
        let samples = [0, 1].map(|n| {
            sampled_radii(scene.blade())
                .map(|r| basis.evaluate(n, r).value)
                .collect()
        });
        let mut plate = Plate {
            blade: *scene.blade(),
            resolution,
            basis,
            spinning,
            harmonics,
            contact: ContactTerms::default(),
            lifting: None,
            edge_stiffness: None,
            damping: damping.cloned(),
            membrane,
            samples,
        };
        let mut contact = ContactTerms::default();
        for guide in scene.guides() {
            guide.typed.add_to(&plate, &mut contact);
        }
        plate.contact = contact;
        plate.lifting = LiftingPads::of(&plate, scene.guides());
        match scene.cut().and_then(|cut| cut.chart.map(|run| (cut, run))) {
            Some((cut, run)) => plate.in_cut(cut, &run),
            None => plate,
        }
    }

    /// The plate with one more contact.
    pub fn with_contact(&self, more: &impl Contact) -> Self {
        let mut plate = self.clone();
        more.add_to(self, &mut plate.contact);
        if let Some(lifting) = &mut plate.lifting {
            more.add_to(self, &mut lifting.released);
        }
        plate
    }

    /// The plate with the pads that lift off inside their gaps, where they have only the stiffness of their
    /// films; `None` if no pad lifts off.
    pub(crate) fn released(&self) -> Option<Self> {
        let lifting = self.lifting.as_ref()?;
        Some(Plate {
            contact: lifting.released.clone(),
            lifting: None,
            ..self.clone()
        })
    }

    /// The plate under dead forces at its rim, with reactions at the bore as in [`EdgeStress`].
    pub fn with_edge_loads(&self, loads: &[RimForce]) -> Self {
        self.with_edge_stiffness(self.edge_stiffness_of(loads))
    }

    /// K_e of dead forces at the rim, in 1/s², N × N.
    pub(crate) fn edge_stiffness_of(&self, loads: &[RimForce]) -> Mat<f64> {
        let stress = EdgeStress::new(&self.blade, loads, 2 * self.max_diameters());
        edge_stiffness(self, &stress)
    }

    /// The plate in a cut: under its mean forces, as dead loads, and in contact with the wood.
    pub fn in_cut(&self, cut: &Cut, run: &CutRun) -> Self {
        let loads = RimForce::of_teeth(&cut.teeth.standing(), run);
        let loaded = self.with_edge_loads(&loads);
        match &cut.wood {
            Some(wood) => loaded.with_contact(wood),
            None => loaded,
        }
    }

    /// The plate with a given K_e, in 1/s², N × N.
    pub(crate) fn with_edge_stiffness(&self, edge_stiffness: Mat<f64>) -> Self {
        Plate {
            edge_stiffness: Some(edge_stiffness),
            ..self.clone()
        }
    }

    /// The plate without stress of heat, roll tension or manufacture.
    pub(crate) fn without_membrane(&self) -> Self {
        let mut plate = Plate {
            membrane: None,
            ..self.clone()
        };
        plate.harmonics.iter_mut().for_each(|h| h.membrane = None);
        plate
    }

    /// The plate without damping and without contact forces that have no potential.
    pub fn conservative(&self) -> Self {
        Plate {
            contact: self.contact.conservative(),
            lifting: self.lifting.as_ref().map(LiftingPads::conservative),
            damping: None,
            ..self.clone()
        }
    }

    /// Stiffness of the free blade in a range of nodal diameters that the basis may lack, in the radial functions
    /// of the plate and without damping.
    pub(crate) fn harmonics_of(&self, diameters: RangeInclusive<usize>) -> Vec<HarmonicBlock> {
        let (blade, basis, membrane) = (&self.blade, &self.basis, self.membrane.as_ref());
        harmonics(blade, basis, &self.spinning, membrane, diameters)
    }

    /// Largest number n_max of nodal diameters.
    pub fn max_diameters(&self) -> usize {
        self.resolution.max_diameters
    }

    /// Number of unknowns N.
    pub fn degrees_of_freedom(&self) -> usize {
        self.basis.count() * (2 * self.max_diameters() + 1)
    }

    /// Number of radial functions for each number of nodal diameters: those of the resolution, and those that
    /// steps and kinks of the thickness add.
    pub fn radial_functions(&self) -> usize {
        self.basis.count()
    }

    /// Index of the first cosine of n nodal diameters.
    pub fn offset(&self, n: usize) -> usize {
        let size = self.basis.count();
        if n == 0 { 0 } else { size * (2 * n - 1) }
    }

    /// Norm of cos nθ (or sin nθ) in the mass inner product, √(ρh₀ π(1+δ_n0)), in √(kg/m²).
    pub fn angular_norm(&self, n: usize) -> f64 {
        let two = if n == 0 { 2.0 } else { 1.0 };
        (self.blade.mass_per_area_kg_per_m2() * std::f64::consts::PI * two).sqrt()
    }

    /// Whether no contact or load fixed in space couples the harmonics.
    pub fn is_axisymmetric(&self) -> bool {
        self.contact.is_empty() && self.edge_stiffness.is_none()
    }

    /// Whether all forces have a potential: then eigenvalues come in quadruples and modes have Krein signs.
    pub fn is_conservative(&self) -> bool {
        self.damping.is_none() && self.contact.is_conservative()
    }

    /// Values R_nj for n nodal diameters, in 1/m, at [`Plate::sampled_radii_m`]: one row of J values for each
    /// radius.
    pub fn sampled_functions(&self, n: usize) -> &[Vec<f64>] {
        &self.samples[usize::from(n == 1)]
    }

    /// 41 radii, evenly spaced from edge to edge, in m.
    pub fn sampled_radii_m(&self) -> impl Iterator<Item = f64> + '_ {
        sampled_radii(&self.blade)
    }

    /// Every basis function φᵢ at a point of the blade, in 1/√kg: N values in the order of the
    /// unknowns. A point force F there is F φ on the right side of the equation of motion.
    pub fn functions_at(&self, radius_m: f64, angle_rad: f64) -> Vec<f64> {
        let mut values = Vec::with_capacity(self.degrees_of_freedom());
        for n in 0..=self.max_diameters() {
            let radial = self.basis.evaluate(n, radius_m).value;
            let (sin, cos) = (n as f64 * angle_rad).sin_cos();
            let norm = self.angular_norm(n);
            values.extend(radial.iter().map(|r| r * cos / norm));
            if n > 0 {
                values.extend(radial.iter().map(|r| r * sin / norm));
            }
        }
        values
    }
}

#[cfg(test)]
mod tests;
