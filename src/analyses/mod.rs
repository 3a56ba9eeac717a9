//! One folder for each command: what it is asked, what it computes, and its report, which is the result.
//!
//! A function named like the command returns the report: `deflect(&scene, &options)` gives a
//! [`DeflectReport`](deflect::DeflectReport), in the units of its JSON. States between (matrices, coordinates)
//! are private to the folder.

pub mod board_deviation;
pub mod campbell;
mod changed;
pub mod check;
pub mod commands;
pub mod compare;
pub mod cut;
pub mod deflect;
pub(crate) mod document;
pub mod door;
pub mod fit;
pub mod gap;
pub mod map;
pub mod place;
pub mod report;
pub mod response;
pub mod runup;
mod scene_axis;
pub(crate) mod scene_number;
pub mod size;
pub mod study;
pub mod tradeoff;
pub mod verdict;
pub mod washboard;
