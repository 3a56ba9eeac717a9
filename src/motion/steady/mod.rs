//! Steady states: motions with the period of their loads, and small motions about them.
//!
//! The loads of [`load`] turn with the blade or are fixed in space, with a multiple of the frequency of rotation. Under them
//!
//! * a linear saw has the states of [`Family`], solutions of the full model and of a basis of such solutions, and resonances at the poles
//!   of these states;
//! * a blade between guides with a gap ([`OscillatingBlade`]) has motions of many harmonics, the solutions of a `Balance`, with the
//!   growth of small motions along them (`Along`).

mod along;
mod balance;
#[cfg(test)]
mod diagram_tests;
mod family;
mod load;
mod oscillating_blade;
mod oscillators;
mod periodic;
mod reduced_model;
mod term;

pub use family::Family;
#[cfg(test)]
pub use family::{reading, solution};
pub use load::{Cause, Load, loads};
pub use oscillating_blade::{Found, HARMONICS, OscillatingBlade};
pub use oscillators::Oscillators;
pub use periodic::{Periodic, extremes};
pub use reduced_model::State;
