//! The multiple of a membrane stress at which a wave stands still or the blade buckles.

use nalgebra::DMatrix;

use crate::model::plate::Plate;
use crate::model::system::spread;

use super::component::Component;
use super::critical_speed::standing_name;
use super::error::SpectrumError;
use super::event_name::EventName;
use super::symmetric_pencil::singular_multiples;

/// Change of a stress under which K(Ω) becomes singular.
#[derive(Debug, Clone, PartialEq)]
pub struct SingularStress {
    /// Change of the multiple from [`AddedStress::from`] on, positive.
    pub multiple: f64,
    /// Waves of the null vector of K(Ω).
    pub name: EventName,
}

/// A stress added to that of a plate, starting from a multiple of it, in either direction.
#[derive(Debug, Clone, Copy)]
pub struct AddedStress<'a> {
    /// Geometric stiffness of the stress, of n = 0 … n_max, in 1/s².
    pub stiffness: &'a [DMatrix<f64>],
    /// Initial multiple of the stress.
    pub from: f64,
    /// +1 for rising multiples, −1 for falling ones.
    pub direction: f64,
}

/// The smallest m > 0 at which K(Ω) + (from + direction · m) K_m is singular; `None` if there is none. It
/// follows from a generalized symmetric eigenproblem, without a sweep.
///
/// # Errors
/// [`SpectrumError::UnstableAtRest`] when the matrix is not positive definite at m = 0.
pub fn first_singular(
    plate: &Plate,
    components: &[Component],
    speed_rad_per_s: f64,
    added: &AddedStress<'_>,
) -> Result<Option<SingularStress>, SpectrumError> {
    let blocks: Vec<&DMatrix<f64>> = added.stiffness.iter().collect();
    let mut first: Option<SingularStress> = None;
    for (index, component) in components.iter().enumerate() {
        let range = if plate.is_axisymmetric() {
            index..=index
        } else {
            0..=plate.max_diameters()
        };
        let term = spread(plate, range, &blocks);
        let stiffness = &component.full.stiffness
            + faer::Scale(speed_rad_per_s.powi(2)) * component.full.standing_spin()
            + faer::Scale(added.from) * &term;
        let softening = faer::Scale(-added.direction) * &term;
        let found = singular_multiples(&stiffness, &component.full.free_rigid, &softening)?;
        let Some((multiple, shape)) = found.into_iter().next() else {
            continue;
        };
        if first.as_ref().is_none_or(|other| multiple < other.multiple) {
            let name = standing_name(plate, component.first, &shape, speed_rad_per_s);
            first = Some(SingularStress { multiple, name });
        }
    }
    Ok(first)
}

/// Explains that a plate is unstable at rest: if its membrane stress is the cause, the error gives the share
/// of this stress at which the plate buckles. Other errors are returned unchanged.
pub fn explained(plate: &Plate, error: SpectrumError) -> SpectrumError {
    let SpectrumError::UnstableAtRest { .. } = error else {
        return error;
    };
    let blocks = plate.harmonics.iter().filter_map(|h| h.membrane.clone());
    let stiffness: Vec<DMatrix<f64>> = blocks.collect();
    if stiffness.is_empty() {
        return error;
    }
    let flat = plate.without_membrane();
    let added = AddedStress {
        stiffness: &stiffness,
        from: 0.0,
        direction: 1.0,
    };
    match first_singular(&flat, &Component::of(&flat), 0.0, &added) {
        Ok(Some(found)) => SpectrumError::Buckled {
            diameters: found.name.diameters(),
            share: found.multiple,
        },
        _ => error,
    }
}
