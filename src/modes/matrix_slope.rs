//! Derivatives of the matrices by a number of the scene.
//!
//! The matrices are smooth in every number, so their derivatives are differences of assembled matrices.
//! Eigenvalues are then differentiated exactly, with left and right vectors ([`derivative`](super::derivative)).

use crate::model::plate::Plate;
use crate::model::system::GyroscopicSystem;

use super::component::Component;

/// Sides of a number on which the matrices are assembled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Differences {
    /// Both sides: fourth order.
    Central,
    /// Only above the number, if smaller values are not allowed: third order.
    Above,
    /// Only below the number, if larger values are not allowed: third order.
    Below,
}

impl Differences {
    /// Points, in steps, and their weights in the derivative.
    fn stencil(self) -> [(f64, f64); 4] {
        let twelfth = 1.0 / 12.0;
        let above = [
            (0.0, -11.0 / 6.0),
            (1.0, 3.0),
            (2.0, -1.5),
            (3.0, 1.0 / 3.0),
        ];
        match self {
            Differences::Central => [
                (-2.0, twelfth),
                (-1.0, -8.0 * twelfth),
                (1.0, 8.0 * twelfth),
                (2.0, -twelfth),
            ],
            Differences::Above => above,
            Differences::Below => above.map(|(place, weight)| (-place, -weight)),
        }
    }
}

/// Derivative of the matrices of every component of a plate by a number s at s = 0; `plate_at(s)` is the plate
/// for a value of s.
///
/// # Errors
/// The errors of `plate_at`.
pub fn matrix_slopes<E>(
    step: f64,
    differences: Differences,
    plate_at: impl Fn(f64) -> Result<Plate, E>,
) -> Result<Vec<GyroscopicSystem>, E> {
    let mut terms: Vec<Vec<(f64, GyroscopicSystem)>> = Vec::new();
    for (place, weight) in differences.stencil() {
        let components = Component::of(&plate_at(place * step)?);
        terms.resize_with(components.len(), Vec::new);
        for (terms, component) in terms.iter_mut().zip(components) {
            terms.push((weight / step, component.full));
        }
    }
    let combined = terms.iter_mut().map(|terms| {
        // If a variation moves a step of the thickness out of the moving ring, the basis functions at this
        // step vanish and the matrices have another order. The derivative is then taken as zero.
        let order = terms.first().map(|(_, system)| system.order());
        if terms
            .iter()
            .any(|(_, system)| Some(system.order()) != order)
        {
            terms.truncate(1);
            terms[0].0 = 0.0;
        }
        GyroscopicSystem::combination(terms)
    });
    Ok(combined.flatten().collect())
}
