//! Membrane stress of heat, roll tension and manufacture, and its geometric stiffness.
//!
//! For an axisymmetric, isotropic eigenstrain ε(r) on a < r < b and I(r) = ∫_a^r ε ρ dρ the plane stress
//!
//! σ_rr = A − B/r² − E I/r², σ_θθ = A + B/r² + E I/r² − E ε
//!
//! satisfies equilibrium, d(r σ_rr)/dr = σ_θθ, and compatibility. The rim is free. The bore has the condition of
//! the centrifugal stress: free, or u(a) = 0 at a fixed collar, whose temperature is then the reference. The
//! stress of a real collar lies between these two limits, because the blade inside the collar is neither rigid
//! nor absent.
//!
//! A measured residual stress is used as given, with the radial stress that is in equilibrium with it, see
//! [`ResidualStress`].
//!
//! Reference: Timoshenko & Goodier, *Theory of Elasticity*, 3rd ed., section 150.

mod eigenstrain;
pub(crate) mod heated_disk;

pub use eigenstrain::Eigenstrain;

use std::ops::RangeInclusive;

use nalgebra::{DMatrix, DVector};

use super::in_plane::{InPlaneField, InPlaneLoad};
use super::quadrature;
use super::radial::RadialBasis;
use crate::model::scene::{Blade, Bore, InPlane, Membrane, ResidualStress, Temperature};

/// Cause of a membrane stress.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MembraneSource {
    /// Temperature that varies over the radius.
    Heat,
    /// Rolled bands.
    RollTension,
    /// Residual stress of a measured table.
    Residual,
}

/// Radial and hoop stress at one radius.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlaneStress {
    /// σ_rr, in Pa.
    pub radial_pa: f64,
    /// σ_θθ, in Pa.
    pub hoop_pa: f64,
}

/// Axisymmetric membrane stress of a blade, the sum of its parts.
#[derive(Debug, Clone, PartialEq)]
pub struct MembraneStress {
    blade: Blade,
    parts: Vec<(MembraneSource, Part)>,
}

#[derive(Debug, Clone, PartialEq)]
enum Part {
    Eigen(Eigenstrain, EigenStress),
    Residual(ResidualStress),
}

/// Stress of one eigenstrain.
#[derive(Debug, Clone, PartialEq)]
enum EigenStress {
    /// Closed form for a blade of uniform thickness.
    Uniform {
        /// The constant A.
        uniform_pa: f64,
        /// The constant B.
        inverse_n: f64,
    },
    /// Finite elements for a blade of varying thickness.
    Varying(InPlaneField),
}

impl EigenStress {
    fn new(blade: &Blade, eigenstrain: &Eigenstrain) -> Self {
        if blade.profile.is_some() {
            let load = InPlaneLoad {
                eigenstrain: &|r| eigenstrain.at(r),
                knots_m: &eigenstrain.knots_m(),
                bore_is_fixed: blade.bore == Bore::Clamped(InPlane::Fixed),
                ..InPlaneLoad::default()
            };
            return EigenStress::Varying(InPlaneField::new(blade, 0, &load));
        }
        let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
        let (aa, bb) = (a * a, b * b);
        let nu = blade.material.poisson_ratio;
        let whole = blade.material.youngs_modulus_pa * eigenstrain.moment_m2(a, b);
        let inverse_n = match blade.bore {
            Bore::Free | Bore::Clamped(InPlane::Free) => whole * aa / (bb - aa),
            // At the fixed bore E u/r = (1−ν) A + (1+ν)(B + E I)/r² vanishes, where I(a) = 0.
            Bore::Clamped(InPlane::Fixed) => {
                -(1.0 - nu) * whole / bb / ((1.0 - nu) / bb + (1.0 + nu) / aa)
            }
        };
        EigenStress::Uniform {
            // The constant A follows from σ_rr(b) = 0 at the free rim.
            uniform_pa: (inverse_n + whole) / bb,
            inverse_n,
        }
    }

    fn at(&self, blade: &Blade, eigenstrain: &Eigenstrain, r: f64) -> PlaneStress {
        match self {
            EigenStress::Uniform {
                uniform_pa,
                inverse_n,
            } => {
                let modulus = blade.material.youngs_modulus_pa;
                let moment = eigenstrain.moment_m2(blade.inner_radius_m, r);
                let inverse = (inverse_n + modulus * moment) / (r * r);
                PlaneStress {
                    radial_pa: uniform_pa - inverse,
                    hoop_pa: uniform_pa + inverse - modulus * eigenstrain.at(r),
                }
            }
            EigenStress::Varying(field) => {
                let stress = field.at(r, eigenstrain.at(r));
                PlaneStress {
                    radial_pa: stress.radial_pa,
                    hoop_pa: stress.hoop_pa,
                }
            }
        }
    }
}

impl Part {
    fn of_eigenstrain(blade: &Blade, strain: Eigenstrain) -> Self {
        let stress = EigenStress::new(blade, &strain);
        Part::Eigen(strain, stress)
    }
}

impl MembraneStress {
    /// The sum of all stresses of a scene that are not zero; `None` if there are none.
    pub(crate) fn new(blade: &Blade, membrane: &Membrane) -> Option<Self> {
        let heat = membrane.temperature.as_ref().map(|temperature| {
            let strain = Eigenstrain::of_heat(blade, temperature, temperature.peak_rise_k);
            (MembraneSource::Heat, strain)
        });
        let rolled = membrane
            .roll_tension
            .iter()
            .map(|band| (MembraneSource::RollTension, Eigenstrain::Band(*band)));
        let eigen = heat
            .into_iter()
            .chain(rolled)
            .filter(|(_, strain)| !strain.is_zero())
            .map(|(source, strain)| (source, Part::of_eigenstrain(blade, strain)));
        let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
        let residual = membrane
            .residual_stress
            .iter()
            .filter(|residual| residual.hoop_pa.peak(a, b) != 0.0)
            .map(|residual| (MembraneSource::Residual, Part::Residual(residual.clone())));
        let parts: Vec<_> = eigen.chain(residual).collect();
        (!parts.is_empty()).then_some(MembraneStress {
            blade: *blade,
            parts,
        })
    }

    /// The stress of the temperature alone, with another peak.
    pub(crate) fn of_heat(blade: &Blade, temperature: &Temperature, peak_rise_k: f64) -> Self {
        let strain = Eigenstrain::of_heat(blade, temperature, peak_rise_k);
        let part = Part::of_eigenstrain(blade, strain);
        MembraneStress {
            blade: *blade,
            parts: vec![(MembraneSource::Heat, part)],
        }
    }

    /// Whether a part of the stress has this cause.
    pub fn has(&self, source: MembraneSource) -> bool {
        self.parts.iter().any(|(own, _)| *own == source)
    }

    /// The stress at a radius.
    pub fn at(&self, radius_m: f64) -> PlaneStress {
        let mut sum = PlaneStress::default();
        for (_, part) in &self.parts {
            let stress = match part {
                Part::Eigen(strain, eigen) => eigen.at(&self.blade, strain, radius_m),
                Part::Residual(residual) => PlaneStress {
                    radial_pa: residual.radial_pa(&self.blade, radius_m),
                    hoop_pa: residual.hoop_pa.at(radius_m),
                },
            };
            sum.radial_pa += stress.radial_pa;
            sum.hoop_pa += stress.hoop_pa;
        }
        sum
    }

    /// The edges and the radii between them at which the stress is not smooth, ascending.
    pub fn knots_m(&self) -> Vec<f64> {
        let of_part = |(_, part): &(MembraneSource, Part)| match part {
            Part::Residual(residual) => residual.hoop_pa.knots_m().to_vec(),
            Part::Eigen(strain, _) => strain.knots_m(),
        };
        let knots: Vec<f64> = self.parts.iter().flat_map(of_part).collect();
        quadrature::panel_edges_m(&self.blade, &knots)
    }

    /// Number of Gauss points per panel that integrate the product of the stress and two of J functions.
    fn points(&self, functions: usize) -> usize {
        let degree_of = |(_, part): &(MembraneSource, Part)| match part {
            Part::Residual(_) => 1,
            Part::Eigen(strain, _) => strain.degree(),
        };
        let degree = self.parts.iter().map(degree_of).max().unwrap_or(0);
        functions + degree / 2 + 12
    }
}

/// Geometric stiffness K_m of a range of nodal diameters n in the mass-normalised basis, in 1/s²:
/// (1/ρ) ∫ h/h₀ [σ_rr R′R′ + n² σ_θθ RR/r²] r dr. Panels end where the stress is not smooth.
pub fn membrane_stiffness(
    basis: &RadialBasis,
    stress: &MembraneStress,
    diameters: RangeInclusive<usize>,
) -> Vec<DMatrix<f64>> {
    stiffness_with(basis, stress, diameters, stress.points(basis.count()))
}

fn stiffness_with(
    basis: &RadialBasis,
    stress: &MembraneStress,
    diameters: RangeInclusive<usize>,
    points: usize,
) -> Vec<DMatrix<f64>> {
    let size = basis.count();
    let density = stress.blade.material.density_kg_per_m3;
    let mut radial = DMatrix::zeros(size, size);
    let mut hoop = DMatrix::zeros(size, size);
    for panel in stress.knots_m().windows(2) {
        for (r, w) in quadrature::graded(panel[0], panel[1], points).iter() {
            // The functions of n = 0 are used for all n, because `turned` converts the block to the functions
            // of n = 1.
            let functions = basis.evaluate(0, r);
            let value = DVector::from_vec(functions.value);
            let slope = DVector::from_vec(functions.slope);
            let at = stress.at(r);
            let w = w * stress.blade.thickness_ratio(r);
            radial.ger(w * r * at.radial_pa / density, &slope, &slope, 1.0);
            hoop.ger(w / r * at.hoop_pa / density, &value, &value, 1.0);
        }
    }
    diameters
        .map(|n| {
            let n2 = (n * n) as f64;
            let mut block = basis.turned(n, n, &radial + &hoop * n2);
            if basis.has_rigid_motions() && n <= 1 {
                // A stress in equilibrium between free edges does no work on heave and tilt: for tilt and any
                // radial function R the work is ∫ d(r σ_rr R)/dr dr, which is zero. Rounding must not give
                // them a stiffness of either sign.
                block.row_mut(0).fill(0.0);
                block.column_mut(0).fill(0.0);
            }
            block
        })
        .collect()
}

#[cfg(test)]
mod tests;
