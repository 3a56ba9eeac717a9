//! The matrices of a plate, and the basis in which they stand.

use std::ops::Range;

use faer::{Col, Mat};

use super::contact::{ContactTerms, LiftingPads};
use super::harmonic::HarmonicBlock;
use super::head::Head;
use super::membrane::MembraneStress;
use super::pad_state::PadState;
use super::radial::RadialBasis;
use super::resolution::Resolution;
use super::slots::SlottedBlade;
use super::stress::CentrifugalStress;
use crate::model::evenly_spaced;
use crate::model::scene::{Blade, DampingFile, Polar};

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
    pub(super) spinning: CentrifugalStress,
    /// Heads of guide arms, whose unknowns follow the radial functions of n = 0.
    pub(super) heads: Vec<Head>,
    /// Internal states of pads, whose unknowns follow those of the heads.
    pub(super) states: Vec<PadState>,
    /// Stiffness matrices K_b, K_m and K_σ − N of n = 0 … n_max nodal diameters; that of n = 0 has the heads and the states, too.
    pub harmonics: Vec<HarmonicBlock>,
    /// Terms of the guides and of the contacts that [`Plate::with_contact`] adds.
    pub contact: ContactTerms,
    /// Pads that lift off, if the scene has any; `contact` contains them as pads in permanent contact.
    pub(super) lifting: Option<LiftingPads>,
    /// K_e, in 1/s², N × N, symmetric, if [`Plate::with_edge_loads`] has applied forces to the rim.
    pub edge_stiffness: Option<Mat<f64>>,
    /// Material and air damping, if the scene has any.
    pub(crate) damping: Option<DampingFile>,
    /// Stress of heat, roll tension or manufacture, if the scene has any.
    pub membrane: Option<MembraneStress>,
    /// Radial functions of n ≠ 1 and of n = 1 at the sampled radii.
    pub(super) samples: [Vec<Vec<f64>>; 2],
}

/// Number of sampled radii, which resolves every nodal circle of a mode in a diagram.
const SAMPLED_RADII: usize = 41;

pub(super) fn sampled_radii(blade: &Blade) -> Vec<f64> {
    evenly_spaced([blade.inner_radius_m, blade.outer_radius_m], SAMPLED_RADII)
}

impl Plate {
    /// Bending stiffness and stress of a slotted blade; `None` without slots.
    pub fn slotted(&self) -> Option<&SlottedBlade> {
        self.spinning.slotted()
    }

    /// Number of nodal diameters from which on the ratios of stiffness to a plain blade are the same for all waves.
    pub fn even_from(&self) -> usize {
        let given = self.blade.wave_factors.as_ref();
        let given = given.map_or(0, |factors| factors.even_from());
        given.max(self.slotted().map_or(0, |slots| slots.even_from()))
    }

    /// Largest number n_max of nodal diameters.
    pub fn max_diameters(&self) -> usize {
        self.resolution.max_diameters
    }

    /// Number of unknowns N.
    pub fn degrees_of_freedom(&self) -> usize {
        self.basis.count() * (2 * self.max_diameters() + 1) + self.attached()
    }

    /// Number of radial functions for each number of nodal diameters: those of the resolution, and those that
    /// steps and kinks of the thickness add.
    pub fn radial_functions(&self) -> usize {
        self.basis.count()
    }

    /// Index of the first cosine of n nodal diameters.
    pub fn offset(&self, n: usize) -> usize {
        let size = self.basis.count();
        if n == 0 {
            0
        } else {
            size * (2 * n - 1) + self.attached()
        }
    }

    /// Number of unknowns beside the functions of the blade: heads of guide arms, and internal states of pads.
    pub(crate) fn attached(&self) -> usize {
        self.heads.len() + self.states.len()
    }

    /// Indices of the unknowns √m h of the heads of guide arms.
    pub(crate) fn heads(&self) -> Range<usize> {
        let radial = self.basis.count();
        radial..radial + self.heads.len()
    }

    /// Index of the unknown of the head of a guide; `None` if the guide has no head with mass.
    pub(super) fn head_of(&self, guide: usize) -> Option<usize> {
        let place = self.heads.iter().position(|head| head.guide == guide)?;
        self.heads().nth(place)
    }

    /// Indices of the internal states of pads.
    pub(crate) fn states(&self) -> Range<usize> {
        let first = self.heads().end;
        first..first + self.states.len()
    }

    /// The internal states of a guide, each with the index of its unknown.
    pub(super) fn states_of(&self, guide: usize) -> impl Iterator<Item = (usize, &PadState)> {
        let all = self.states().zip(&self.states);
        all.filter(move |(_, state)| state.guide == guide)
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
        sampled_radii(&self.blade).into_iter()
    }

    /// Load of one newton on several points, each with its share of the force.
    pub(crate) fn load_at(&self, places: &[(Polar, f64)]) -> Col<f64> {
        let mut load = Col::zeros(self.degrees_of_freedom());
        for (place, share) in places {
            let values = self.functions_at(place.radius_m, place.angle_rad);
            load += Col::from_fn(values.len(), |i| share * values[i]);
        }
        load
    }

    /// Every basis function φᵢ at a point of the blade, in 1/√kg: N values in the order of the
    /// unknowns, zero for heads of guide arms and for internal states of pads. A point force F there is F φ on the right
    /// side of the equation of motion.
    pub fn functions_at(&self, radius_m: f64, angle_rad: f64) -> Vec<f64> {
        let mut values = Vec::with_capacity(self.degrees_of_freedom());
        // The radial functions of one nodal diameter differ from those of all others.
        let functions = [0, 1].map(|n| self.basis.evaluate(n, radius_m).value);
        for n in 0..=self.max_diameters() {
            let radial = &functions[usize::from(n == 1)];
            let (sin, cos) = (n as f64 * angle_rad).sin_cos();
            let norm = self.angular_norm(n);
            values.extend(radial.iter().map(|r| r * cos / norm));
            if n > 0 {
                values.extend(radial.iter().map(|r| r * sin / norm));
            } else {
                values.resize(values.len() + self.attached(), 0.0);
            }
        }
        values
    }
}
