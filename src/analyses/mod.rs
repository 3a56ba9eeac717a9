//! One folder for each command: what it is asked, what it computes, and its report, which is the result.
//!
//! A function named like the command returns the report: `deflect(&scene, &options)` gives a
//! [`DeflectReport`](deflect::DeflectReport), in the units of its JSON. States between (matrices, coordinates)
//! are private to the folder.

mod changed;
pub mod check;
pub mod compare;
pub mod cut;
pub mod deflect;
pub mod fit;
pub mod gap;
pub mod map;
pub mod place;
pub mod response;
pub mod runup;
pub mod study;
pub mod tradeoff;
pub mod washboard;
