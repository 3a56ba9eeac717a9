//! Mean around of the stress of a slotted, rotating ring.
//!
//! With means over the angle of the stress of a plane with cuts (`plane`), ε_θθ of the mean is (ū + v_face/θ_face)/r, since
//! ∫ ∂v/∂θ dθ is the displacement of the face: the stress
//!
//! σ̂_rr = ū′ + ν(ū + v̄)/r, σ̂_θθ = (ū + v̄)/r + νū′, v̄ = v_face/θ_face,
//!
//! follows from two functions of the radius, quadratic on every element, with the displacements in units of ρΩ²(1 − ν²)/E.

use super::super::quadrature::{Rule, smooth};
use super::elements::lagrange;
use super::plane::PlaneStress;

/// Points of the rule on an element, for products of polynomials with this stress.
const POINTS: usize = 6;

/// Mean stress σ/ρΩ² of a slotted ring.
#[derive(Debug, Clone, PartialEq)]
pub struct MeanStress {
    /// Edges of the elements.
    radii_m: Vec<f64>,
    /// ū and v̄ at the edges and, between two of them, in the middle of each element.
    displacement_m3: Vec<[f64; 2]>,
    poisson_ratio: f64,
}

impl MeanStress {
    /// The mean of the stress of a plane; not a number if the numbers of the blade differ too much in size.
    pub fn new(plane: &PlaneStress<'_>) -> Self {
        MeanStress {
            radii_m: plane.mesh.radii_m.clone(),
            displacement_m3: plane.means(),
            poisson_ratio: plane.poisson_ratio,
        }
    }

    /// Radial and hoop stress σ/ρΩ² at a radius, in m².
    pub fn at_m2(&self, radius_m: f64) -> [f64; 2] {
        let edges = &self.radii_m;
        let element = edges
            .partition_point(|edge| *edge <= radius_m)
            .clamp(1, edges.len() - 1)
            - 1;
        let (from, to) = (edges[element], edges[element + 1]);
        let [f, d, _] = lagrange(radius_m - from, to - from);
        let (mut slope, mut hoop) = (0.0, 0.0);
        for k in 0..3 {
            let [u, v] = self.displacement_m3[2 * element + k];
            slope += d[k] * u;
            hoop += f[k] * (u + v) / radius_m;
        }
        let nu = self.poisson_ratio;
        [slope + nu * hoop, hoop + nu * slope]
    }

    /// Rule over the radius for products with this stress, which is steep at the slot's end; the weights do not contain r.
    pub fn rule(&self) -> Rule {
        let mut whole = Rule::default();
        for pair in self.radii_m.windows(2) {
            let own = smooth(pair[0], pair[1], POINTS);
            whole.points.extend(own.points);
            whole.weights.extend(own.weights);
        }
        whole
    }
}
