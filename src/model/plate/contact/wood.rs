//! The wood beside the blade in the kerf.

use faer::Scale;

use crate::model::scene::Wood;

use super::super::{Plate, quadrature};
use super::patch::{Circle, coupling, sufficient_points};
use super::{Contact, ContactTerms};

/// Stiffness k and damping c of the whole contact are uniform over a sector of an annulus at the rim, or over an
/// arc of the rim if the depth is zero: the terms are k/A ∫ φᵢφⱼ dA and c/A ∫ φᵢφⱼ dA.
impl Contact for Wood {
    fn add_to(&self, plate: &Plate, terms: &mut ContactTerms) {
        let circles = self.circles(plate);
        let coupling = coupling(
            plate,
            self.teeth.angle_deg.to_radians(),
            circles.into_iter(),
        );
        let typed = &self.typed;
        if typed.stiffness_n_per_m > 0.0 {
            terms.add_stiffness(&(Scale(typed.stiffness_n_per_m) * &coupling));
        }
        if typed.damping_n_s_per_m > 0.0 {
            terms.add_damping(&(Scale(typed.damping_n_s_per_m) * &coupling));
        }
    }
}

impl Wood {
    fn circles(&self, plate: &Plate) -> Vec<Circle> {
        let (outer, arc_rad) = (plate.blade.outer_radius_m, self.arc_rad());
        let half = 0.5 * arc_rad;
        let circle = |radius_m: f64, weight: f64| Circle {
            radius_m,
            weight,
            arcs: Some(vec![[0.0, half]]),
        };
        if self.typed.depth_m == 0.0 {
            return vec![circle(outer, 1.0 / arc_rad)];
        }
        let inner = outer - self.typed.depth_m;
        let mut edges = plate.blade.edges_m();
        edges.retain(|r| *r > inner);
        edges.insert(0, inner);
        let area = 0.5 * arc_rad * (outer - inner) * (outer + inner);
        quadrature::piecewise(&edges, sufficient_points(plate))
            .iter()
            .map(|(r, w)| circle(r, w * r / area))
            .collect()
    }
}
