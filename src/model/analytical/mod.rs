//! Closed forms of plate, membrane and rotor theory, each with its source.
//!
//! The closed forms are independent references for the tests and serve for estimates by hand. The module imports nothing
//! from the crate: arguments and results are numbers in SI units, and no function panics. Without a solution,
//! or outside the stated validity, a function returns `None`, an empty list or NaN.
//!
//! | question | module |
//! |---|---|
//! | natural frequencies of an annular plate at rest | [`annular_plate`] |
//! | frequencies of a disk so fast that it is a membrane | [`spinning_membrane`] |
//! | waves of an unguided blade: frequencies in space, critical speed, onset under damping | [`free_wave`] |
//! | tilt of a blade under single forces in its plane | [`tilt`] |
//! | stress of an annulus that rotates, is heated, pulled at its rim or twisted; its tilt | [`annulus`] |
//! | deflection of a plate that lies on two points of its rim | [`two_points`] |
//! | stress of a disk between two forces | [`pressed_disk`] |
//! | temperature of a disk that is heated along a ring | [`ring_source`] |
//! | critical speeds and eigenvalues of a blade on equal, evenly spaced point springs | [`point_springs`] |
//! | which waves such springs couple, and how fast they then grow | [`wave_coupling`] |
//! | one degree of freedom in time | [`oscillator`] |
//! | one mode under a force that depends on the surface left by the preceding tooth | [`regenerative`] |
//!
//! Signs and symbols are those of the whole crate: a bore radius, b rim radius, r radius, θ angle in the
//! direction of rotation, n nodal diameters, ν Poisson's ratio, ρ density, Ω rotation speed. Tension is
//! positive.

pub mod annular_plate;
pub mod annulus;
mod bessel;
pub mod free_wave;
pub mod oscillator;
pub mod point_springs;
pub mod pressed_disk;
pub mod regenerative;
pub mod ring_source;
pub mod spinning_membrane;
pub mod tilt;
pub mod two_points;
pub mod wave_coupling;

/// Root of a function that is negative near `low` and positive near `high`, by bisection to machine
/// precision. The function is not evaluated at the ends, which may be poles.
fn bisected(mut low: f64, mut high: f64, function: impl Fn(f64) -> f64) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high || middle.is_nan() {
            return middle;
        }
        if function(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
}
