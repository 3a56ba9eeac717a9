//! Potential of stretching: the energy of in-plane strains that result from deflections comparable to the
//! thickness.
//!
//! [`Stretching`] defines it. The steady centrifugal stress is part of K_σ, and in-plane inertia is neglected.
//! Because the potential does not change when the deflection is rotated about the axis, it is one function in
//! space and on the turning blade.
//!
//! **Method.** With w = Σ wₙ(r) e^{inθ} the strains of harmonic m are sums of products of wₙ and w₍ₘ₋ₙ₎.
//! Times r² they are polynomials between the knots of the thickness, and values at a few nodes ([`Nodes`])
//! determine them. For each m ≤ 2 n_max the displacement u that minimizes the energy is computed by finite
//! elements over the radius, as many as the roughest strains of the basis need ([`Relaxed`]), so that no
//! number of in-plane functions has to be chosen. The result is a sum of squares, U₄ = Σₘ |Zₘ eₘ|², with the
//! strains eₘ at the nodes.
//!
//! Reference: C. Touzé, O. Thomas & A. Chaigne, *Asymmetric non-linear forced vibrations of free-edge circular
//! plates*, part 1, J. Sound Vib. 258 (2002), 649–676, for free edges.

mod error;
mod nodes;
mod reduced_potential;
mod relaxation;
mod strain;

pub use error::StretchingError;
pub use reduced_potential::ReducedStretching;

use faer::{Col, Mat};
use rayon::prelude::*;

use super::Plate;
use nodes::Nodes;
use relaxation::Relaxed;
use strain::{Slopes, Strain};

/// Potential of stretching U₄ of a plate, on its full model of N functions:
///
/// U₄(q) = min_u ½ ∫ h E : ℂ : E dA, E = ε(u) + ½ ∇w ⊗ ∇w, w = Σ qᵢ φᵢ, ℂ of plane stress.
///
/// With it the equation of motion becomes q̈ + (2ΩG + C) q̇ + K(Ω) q + ∂U₄/∂q = f. q is in √kg·m, N values in
/// the order of the unknowns of [`Plate`]. U₄ is homogeneous of degree four, never negative, and invariant
/// under rotation about the axis; the in-plane displacement u is free at the edges, or zero at a fixed
/// collar. It is valid for slopes up to about 0.1.
///
/// Source: T. von Kármán, *Festigkeitsprobleme im Maschinenbau*, Enzykl. Math. Wiss. IV/4 (1910), 348–352.
#[derive(Debug, Clone)]
pub struct Stretching {
    nodes: Nodes,
    /// Matrices Zₘ of m = 0 … 2 n_max.
    harmonics: Vec<Relaxed>,
}

impl Stretching {
    /// Computes Zₘ of every harmonic m ≤ 2 n_max.
    ///
    /// # Errors
    /// [`StretchingError::NotFinite`] if the numbers of the scene differ too much in size.
    pub fn new(plate: &Plate) -> Result<Self, StretchingError> {
        let nodes = Nodes::new(plate);
        let harmonics = (0..=2 * plate.max_diameters())
            .into_par_iter()
            .map(|m| Relaxed::new(&plate.blade, &nodes, m))
            .collect::<Result<_, _>>()?;
        Ok(Stretching { nodes, harmonics })
    }

    /// Number N of coordinates of a deflection, which is that of the plate's unknowns.
    pub fn order(&self) -> usize {
        self.nodes.degrees_of_freedom()
    }

    /// U₄(q), in J, never negative.
    ///
    /// # Errors
    /// [`StretchingError::Length`] if the deflection does not have N coordinates.
    pub fn energy_j(&self, deflection: &Col<f64>) -> Result<f64, StretchingError> {
        let w = self.slopes(deflection)?;
        let relaxed = self.relaxed(&Strain::of(&w, &w));
        Ok(relaxed.iter().map(|y| y * y).sum())
    }

    /// ∂U₄/∂q, in N/√kg.
    ///
    /// # Errors
    /// [`StretchingError::Length`] if the deflection does not have N coordinates.
    pub fn gradient(&self, deflection: &Col<f64>) -> Result<Col<f64>, StretchingError> {
        let w = self.slopes(deflection)?;
        let stress = self.stress(&self.relaxed(&Strain::of(&w, &w)));
        Ok(self.nodes.work(&stress.pulled_back(&w)))
    }

    /// ∂²U₄/∂q², in 1/s², symmetric: the stiffness that stretching adds to small motions about a
    /// deflection.
    ///
    /// # Errors
    /// [`StretchingError::Length`] if the deflection does not have N coordinates.
    pub fn hessian(&self, deflection: &Col<f64>) -> Result<Mat<f64>, StretchingError> {
        let w = self.slopes(deflection)?;
        let stress = self.stress(&self.relaxed(&Strain::of(&w, &w)));
        let order = self.order();
        let columns: Vec<Col<f64>> = (0..order)
            .into_par_iter()
            .map(|k| {
                let mut unit = Col::zeros(order);
                unit[k] = 1.0;
                let v = self.nodes.slopes(&unit);
                // The derivative of the gradient has two parts: the existing stress acts on the added slopes, and
                // the added stress on the existing slopes.
                let added = self.stress(&self.relaxed(&Strain::of(&w, &v)));
                let mut force = self.nodes.work(&stress.pulled_back(&v));
                force += faer::Scale(2.0) * self.nodes.work(&added.pulled_back(&w));
                force
            })
            .collect();
        Ok(Mat::from_fn(order, order, |i, k| {
            0.5 * (columns[k][i] + columns[i][k])
        }))
    }

    /// Slopes of a deflection at the nodes, if it has N coordinates.
    fn slopes(&self, deflection: &Col<f64>) -> Result<Slopes, StretchingError> {
        match (deflection.nrows(), self.order()) {
            (given, expected) if given == expected => Ok(self.nodes.slopes(deflection)),
            (given, expected) => Err(StretchingError::Length { given, expected }),
        }
    }

    /// Values Zₘ eₘ of all m in sequence, the real part of each before the imaginary one.
    fn relaxed(&self, strain: &Strain) -> Vec<f64> {
        let mut all = Vec::new();
        for (harmonic, parts) in self.harmonics.iter().zip(&strain.harmonics) {
            for part in parts {
                harmonic.apply(part, &mut all);
            }
        }
        all
    }

    /// Stresses Zₘᵀ yₘ of all m at the nodes, integrated over the area that each node represents.
    fn stress(&self, relaxed: &[f64]) -> Strain {
        let mut stress = self.nodes.no_strain();
        let mut rest = relaxed;
        for (harmonic, parts) in self.harmonics.iter().zip(&mut stress.harmonics) {
            for part in parts {
                let (own, others) = rest.split_at(harmonic.rank());
                harmonic.apply_transposed(own, part);
                rest = others;
            }
        }
        stress
    }
}

#[cfg(test)]
mod airy_tests;
#[cfg(test)]
mod exact_tests;
#[cfg(test)]
mod plate_tests;
#[cfg(test)]
mod test_blades;
