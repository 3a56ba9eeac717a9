//! Plane stress of a blade of varying thickness: finite elements over the radius, of high order.
//!
//! For the harmonic m the displacements are u_r = u(r) cos mθ and u_θ = v(r) sin mθ, with ε_rr = u′, ε_θθ =
//! (u + mv)/r, γ_rθ = v′ − (v + mu)/r. They minimize the energy of the blade with the thickness h(r). Each
//! element is a polynomial of degree 14, and elements end where thickness or load is not smooth, so that
//! stresses are exact to rounding, including their jumps.
//!
//! References: B. Szabó & I. Babuška, *Finite Element Analysis*, 1991, chapter 3, for elements of
//! high order; J.-P. Berrut & L. N. Trefethen, *Barycentric Lagrange interpolation*, SIAM Review 46
//! (2004), 501–517.

mod banded;
mod elements;

pub use banded::Banded;
pub use elements::{DEGREE, Elements, UnitStrains};

use crate::model::scene::{Blade, Material};

use super::quadrature;

/// Load of harmonic m on the blade in its plane: amplitudes of cos mθ, and of sin mθ for the shear stress.
pub struct InPlaneLoad<'a> {
    /// Radial force per volume, in N/m³.
    pub body_n_per_m3: &'a dyn Fn(f64) -> f64,
    /// Eigenstrain, isotropic in the plane.
    pub eigenstrain: &'a dyn Fn(f64) -> f64,
    /// Radius of each loaded circle, in m, with its outward force per radian, in N.
    pub circle_n: &'a [(f64, f64)],
    /// σ_rr and σ_rθ at the rim.
    pub rim_pa: [f64; 2],
    /// σ_rr and σ_rθ at the bore.
    pub bore_pa: [f64; 2],
    /// Radii at which the load is not smooth.
    pub knots_m: &'a [f64],
    /// Whether the bore has no radial displacement.
    pub bore_is_fixed: bool,
}

impl Default for InPlaneLoad<'_> {
    fn default() -> Self {
        InPlaneLoad {
            body_n_per_m3: &|_| 0.0,
            eigenstrain: &|_| 0.0,
            circle_n: &[],
            rim_pa: [0.0; 2],
            bore_pa: [0.0; 2],
            knots_m: &[],
            bore_is_fixed: false,
        }
    }
}

/// Displacements of one harmonic, from which strains and stresses follow.
#[derive(Debug, Clone, PartialEq)]
pub struct InPlaneField {
    elements: Elements,
    /// Displacements and slopes u, u′, v, v′ at the nodes of each element.
    nodes: Vec<[[f64; DEGREE + 1]; 4]>,
    material: Material,
}

/// Amplitudes of the stresses of harmonic m at one radius.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct InPlaneStress {
    /// Radial stress σ_rr, the factor of cos mθ.
    pub radial_pa: f64,
    /// Hoop stress σ_θθ, the factor of cos mθ.
    pub hoop_pa: f64,
    /// Shear stress σ_rθ, the factor of sin mθ.
    pub shear_pa: f64,
}

impl InPlaneField {
    /// Solves harmonic m. Loads of m = 1 must be balanced; for m = 0 only the radial part is solved.
    pub fn new(blade: &Blade, order: usize, load: &InPlaneLoad<'_>) -> Self {
        let elements = Elements::new(blade, order, load.knots_m);
        let components = elements.components();
        let unknowns = components * elements.nodes();
        let mut stiffness = Banded::new(unknowns, components * (DEGREE + 1));
        let mut right = vec![0.0; unknowns];
        for element in 0..elements.count() {
            assemble(blade, load, &elements, element, &mut stiffness, &mut right);
        }
        let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
        let (at_bore, at_rim) = (blade.thickness_at_bore_m(), blade.thickness_at_m(b));
        for part in 0..components {
            right[part] -= a * at_bore * load.bore_pa[part];
            right[unknowns - components + part] += b * at_rim * load.rim_pa[part];
        }
        for &(radius, force) in load.circle_n {
            right[components * elements.node_at_edge(radius)] += force;
        }
        // A translation, of order 1, causes no strain, so that one displacement is fixed; its reaction is
        // zero if the loads balance. A fixed bore has u(a) = 0.
        if order == 1 || load.bore_is_fixed {
            stiffness.fix(0);
            right[0] = 0.0;
        }
        stiffness.factored().solve(&mut right, 1);
        InPlaneField {
            nodes: at_nodes(&elements, &right),
            elements,
            material: blade.material,
        }
    }

    /// Stress at a radius, where `eigenstrain` is the inelastic part of the strain. Where the stress jumps, its
    /// value on the inner side is returned.
    pub fn at(&self, radius_m: f64, eigenstrain: f64) -> InPlaneStress {
        let element = self.elements.at(radius_m);
        let values = self.elements.values(element, radius_m);
        let [u, du, v, dv] = self.nodes[element]
            .map(|nodes| nodes.iter().zip(&values).map(|(x, n)| x * n).sum::<f64>());
        let (m, r) = (self.elements.order(), radius_m);
        let strain = [
            du - eigenstrain,
            (u + m * v) / r - eigenstrain,
            dv - (v + m * u) / r,
        ];
        let [radial_pa, hoop_pa, shear_pa] = stress_of(&self.material, strain);
        InPlaneStress {
            radial_pa,
            hoop_pa,
            shear_pa,
        }
    }
}

/// Displacements and slopes u, u′, v, v′ at the nodes of each element.
fn at_nodes(elements: &Elements, solution: &[f64]) -> Vec<[[f64; DEGREE + 1]; 4]> {
    let components = elements.components();
    (0..elements.count())
        .map(|element| {
            let first = elements.nodes_of(element).start;
            let mut all = [[0.0; DEGREE + 1]; 4];
            for part in 0..components {
                let value = |node: usize| solution[components * (first + node) + part];
                all[2 * part] = std::array::from_fn(value);
                all[2 * part + 1] = elements.slopes_at_nodes(element, all[2 * part]);
            }
            all
        })
        .collect()
}

/// Adds the stiffness of an element, and the forces of the load on it, to the system of equations.
fn assemble(
    blade: &Blade,
    load: &InPlaneLoad<'_>,
    elements: &Elements,
    element: usize,
    stiffness: &mut Banded,
    right: &mut [f64],
) {
    let components = elements.components();
    let [from, to] = elements.ends_m(element);
    let first = components * elements.nodes_of(element).start;
    let Material {
        youngs_modulus_pa: e,
        poisson_ratio: nu,
        ..
    } = blade.material;
    for (r, w) in quadrature::graded(from, to, DEGREE + 4).iter() {
        let unit = elements.unit_strains(element, r);
        let weight = w * r * blade.thickness_at_m(r);
        let free = (load.eigenstrain)(r);
        let body = (load.body_n_per_m3)(r);
        let strains: Vec<[f64; 3]> = (0..=DEGREE)
            .flat_map(|k| [unit.radial[k], unit.along[k]].into_iter().take(components))
            .collect();
        for (i, left) in strains.iter().enumerate() {
            let [rr, tt, rt] = stress_of(&blade.material, *left);
            let force = e / (1.0 - nu) * free * (left[0] + left[1]);
            let pushed = if i % components == 0 {
                unit.values[i / components]
            } else {
                0.0
            };
            right[first + i] += weight * (force + body * pushed);
            for (k, right) in strains[..=i].iter().enumerate() {
                let energy = rr * right[0] + tt * right[1] + rt * right[2];
                stiffness.add(first + i, first + k, weight * energy);
            }
        }
    }
}

/// Hooke's law of plane stress: [σ_rr, σ_θθ, σ_rθ] of [ε_rr, ε_θθ, γ_rθ].
pub fn stress_of(material: &Material, [rr, tt, rt]: [f64; 3]) -> [f64; 3] {
    let (e, nu) = (material.youngs_modulus_pa, material.poisson_ratio);
    let plane = e / (1.0 - nu * nu);
    [
        plane * (rr + nu * tt),
        plane * (tt + nu * rr),
        0.5 * e / (1.0 + nu) * rt,
    ]
}

#[cfg(test)]
mod tests;
