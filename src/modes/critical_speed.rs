//! Critical speeds: K₀ x = Ω² (N − K_σ) x, without a sweep.

use faer::{Col, Scale, c64};

use crate::model::plate::Plate;
use crate::model::system::GyroscopicSystem;

use super::component::Component;
use super::error::SpectrumError;
use super::event_name::EventName;
use super::symmetric_pencil::singular_multiples;
use super::vectors::complex;
use crate::model::scene::SpeedRange;

/// A speed at which K(Ω) is singular: a wave stands still in space.
#[derive(Debug, Clone)]
pub struct CriticalSpeed {
    /// Rotation speed Ω.
    pub speed_rad_per_s: f64,
    /// The standing wave, ‖x‖ = 1.
    pub shape: Col<f64>,
}

/// Every critical speed of a component of the blade, ascending.
///
/// With A = K₀ = LLᵀ and B = N − K_σ (with free rigid motions see [`GyroscopicSystem::standing_spin`]) the
/// values 1/Ω² are the positive eigenvalues of L⁻¹BL⁻ᵀ: the inverse problem, so that the lowest speeds are
/// the most accurate. A and B both vanish on free rigid motions, so stiffening these makes A definite and
/// changes nothing else.
///
/// # Errors
/// [`SpectrumError::UnstableAtRest`] when A is not positive definite except on free rigid motions;
/// [`SpectrumError::Decomposition`].
pub fn critical_speeds(system: &GyroscopicSystem) -> Result<Vec<CriticalSpeed>, SpectrumError> {
    let softening = Scale(-1.0) * system.standing_spin();
    let found = singular_multiples(&system.stiffness, &system.free_rigid, &softening)?;
    let speeds = found.into_iter().map(|(square, shape)| CriticalSpeed {
        speed_rad_per_s: square.sqrt(),
        shape,
    });
    Ok(speeds.collect())
}

/// A standing wave at its critical speed.
#[derive(Debug, Clone)]
pub struct NamedCriticalSpeed {
    /// Rotation speed Ω.
    pub speed_rad_per_s: f64,
    /// Waves of its shape.
    pub name: EventName,
    /// Index of its component.
    pub component: usize,
    /// The standing wave in the unknowns of its component, ‖x‖ = 1.
    pub shape: Col<f64>,
}

/// Relative distance from a critical speed beyond which λ², which passes through zero there, is well above
/// rounding. Half of this distance would suffice, even where two waves of a free blade stand still at the same
/// speed.
const CLEAR: f64 = 2e-4;

/// Range of the search for the bands of a given range. It is slightly wider, so that no eigenvalue is near zero
/// at its ends and, except by chance, none is about to coalesce there if the given range ends at the edge of a
/// band.
pub(crate) fn searched_range(critical: &[NamedCriticalSpeed], range: SpeedRange) -> SpeedRange {
    let [from, to] = range.ends();
    SpeedRange::new(
        clear_below(critical, from * (1.0 - CLEAR)),
        clear_above(critical, to * (1.0 + CLEAR)),
    )
}

/// The part of a range between the first and the last speed at which no eigenvalue is near zero; the whole
/// range if there are no such speeds.
pub(crate) fn clear_range(critical: &[NamedCriticalSpeed], range: SpeedRange) -> SpeedRange {
    let [from, to] = range.ends();
    let clear = SpeedRange::new(clear_above(critical, from), clear_below(critical, to));
    if clear.width() > 0.0 { clear } else { range }
}

/// The lowest speed, from a given one on, that is not near a critical speed.
fn clear_above(critical: &[NamedCriticalSpeed], speed_rad_per_s: f64) -> f64 {
    let critical = critical.iter().map(|c| c.speed_rad_per_s);
    critical.fold(speed_rad_per_s, |speed, c| {
        if is_clear(speed, c) {
            speed
        } else {
            c * (1.0 + CLEAR)
        }
    })
}

/// The highest speed, up to a given one, that is not near a critical speed.
fn clear_below(critical: &[NamedCriticalSpeed], speed_rad_per_s: f64) -> f64 {
    let critical = critical.iter().rev().map(|c| c.speed_rad_per_s);
    critical.fold(speed_rad_per_s, |speed, c| {
        if is_clear(speed, c) {
            speed
        } else {
            c * (1.0 - CLEAR)
        }
    })
}

fn is_clear(speed_rad_per_s: f64, critical_rad_per_s: f64) -> bool {
    (speed_rad_per_s / critical_rad_per_s - 1.0).abs() >= CLEAR
}

/// Critical speeds of the components of a plate, all together ascending, with the names of their waves.
pub(crate) fn named(
    plate: &Plate,
    components: &[Component],
    found: Vec<Vec<CriticalSpeed>>,
) -> Vec<NamedCriticalSpeed> {
    let mut named = Vec::new();
    for (index, (component, found)) in components.iter().zip(found).enumerate() {
        for critical in found {
            let speed = critical.speed_rad_per_s;
            named.push(NamedCriticalSpeed {
                speed_rad_per_s: speed,
                name: standing_name(plate, component.first, &critical.shape, speed),
                component: index,
                shape: critical.shape,
            });
        }
    }
    named.sort_by(|x, y| x.speed_rad_per_s.total_cmp(&y.speed_rad_per_s));
    named
}

/// The name of a wave that stands still, from its unknowns in a component.
pub(super) fn standing_name(
    plate: &Plate,
    first: usize,
    unknowns: &Col<f64>,
    speed_rad_per_s: f64,
) -> EventName {
    let mut shape: Col<c64> = Col::zeros(plate.degrees_of_freedom());
    shape
        .subrows_mut(first, unknowns.nrows())
        .copy_from(complex(unknowns));
    EventName::standing(plate, &shape, speed_rad_per_s)
}
