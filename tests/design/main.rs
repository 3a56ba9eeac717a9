//! Goal: `fit`, `place` and studies find results that are known in advance.

#![allow(
    clippy::disallowed_methods,
    reason = "tests compare with the solvers themselves"
)]

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/measurements.rs"]
mod measurements;

mod fit;
mod numbers;
mod place;
mod size;
mod study;
mod verdict;
