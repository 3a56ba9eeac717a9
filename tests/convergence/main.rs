//! Goal: the results converge, and accuracy and cost are as promised.

#![allow(
    clippy::disallowed_methods,
    reason = "tests compare with the solvers themselves"
)]

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/promises.rs"]
mod promises;
#[path = "../common/true_errors.rs"]
mod true_errors;

mod estimates;
mod orders;
mod tolerance;
mod work;
