//! How the matrices move with a number of the scene.
//!
//! They are smooth in every number, so they are differentiated by differences of their assembly;
//! eigenvalues are then differentiated exactly, with left and right vectors
//! ([`derivative`](super::derivative)).

use crate::plate::Plate;
use crate::system::GyroscopicSystem;

use super::component::Component;

/// On which sides of a number the matrices are assembled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Differences {
    /// On both: of fourth order.
    Central,
    /// Above it alone, where less is not allowed: of third order.
    Above,
    /// Below it alone, where more is not allowed: of third order.
    Below,
}

impl Differences {
    /// Places, in steps, and their weights.
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

/// Derivative of the matrices of every component of a plate by a number s at s = 0;
/// `plate_at(s)` is the plate there.
///
/// # Errors
/// Those of `plate_at`.
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
        // A step of the thickness that leaves the ring takes its functions with it: no slope.
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
