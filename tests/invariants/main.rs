//! Goal: what holds for every saw holds for drawn ones, and no input breaks the program.

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/draw.rs"]
mod draw;

mod band_lists;
mod certified_bands;
mod charts;
mod damped;
mod draws;
mod fuzz;
mod properties;
