//! Goal: laws that hold for every saw hold for random ones, and no input breaks the program.

#![allow(
    clippy::disallowed_methods,
    reason = "tests compare with the solvers themselves"
)]

#[path = "../common/bands.rs"]
mod bands;
#[path = "../common/certified.rs"]
mod certified;
#[path = "../common/mod.rs"]
mod common;
#[path = "../common/damped.rs"]
mod damped_bands;
#[path = "../common/draw.rs"]
mod draw;
#[path = "../common/draws.rs"]
mod draws;
#[path = "../common/survivors.rs"]
mod survivors;

mod band_lists;
mod certified_bands;
mod charts;
mod cut_ranges;
mod damped;
mod fuzz;
mod guide_arms;
mod guide_states;
mod properties;
mod rooms;
mod searches;
