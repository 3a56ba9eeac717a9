//! Goal: the program as users see it: output, files, exit codes, faults.

#![allow(
    clippy::disallowed_methods,
    reason = "tests compare with the solvers themselves"
)]

#[path = "../common/mod.rs"]
mod common;
#[cfg(target_os = "linux")]
#[path = "../common/memory.rs"]
mod memory_of_a_chart;
#[path = "../common/pressed.rs"]
mod pressed;

mod analyze;
mod changes;
mod compare;
mod cutting;
mod deflect;
mod design;
#[cfg(feature = "explore")]
mod explore;
mod faults;
mod gap;
mod growth;
mod input;
mod large_flange;
mod map;
mod matrices;
mod membrane;
#[cfg(target_os = "linux")]
mod memory;
mod program;
mod records;
mod refusals;
mod response;
mod scenes;
mod study;
mod summaries;
mod washboard;
