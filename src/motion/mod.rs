//! Motion in time, and states of large deflection.
//!
//! [`stretched_blade`] contains the blade whose deflection stretches its middle plane: equilibria over the speed, and the amplitude
//! at which flutter stops to grow. [`transient`] integrates the equation of motion in time, with the forces that depend on the
//! deflection. `steady` contains the motions with the period of their loads.

#[cfg(test)]
pub(crate) mod history;
pub(crate) mod steady;
pub mod stretched_blade;
pub mod transient;
