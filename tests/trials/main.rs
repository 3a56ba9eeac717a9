//! Goal: unknown errors are found: hundreds of random saws, reference solutions of thousands of functions.
//!
//! `cargo test --release --test trials -- --ignored --test-threads 1` takes hours on two cores, and prints a line for
//! each saw; SAWFLUTTER_SHARD=k/n takes every n-th saw of each trial. The daily tests check each claim on the saw that
//! is computed fastest.

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
mod damped;
#[path = "../common/draw.rs"]
mod draw;
#[allow(dead_code, reason = "helpers of other tests")]
#[path = "../common/draws.rs"]
mod draws;
#[path = "../common/measurements.rs"]
mod measurements;
#[cfg(target_os = "linux")]
#[path = "../common/memory.rs"]
mod memory;
#[path = "../design/numbers.rs"]
mod numbers;
#[path = "../common/pressed.rs"]
mod pressed;
#[allow(dead_code, reason = "helpers of other tests")]
#[path = "../command_line/program.rs"]
mod program;
#[path = "../common/promises.rs"]
mod promises;
#[path = "../common/survivors.rs"]
mod survivors;
#[path = "../common/true_errors.rs"]
mod true_errors;

mod accuracy;
mod drawn_bands;
mod ends_of_ranges;
#[cfg(target_os = "linux")]
mod fine_chart;
mod fuzz;
mod intervals;
mod trial;
mod violent_cuts;
