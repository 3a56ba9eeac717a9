//! Goal: the answers converge, the promised accuracy is kept, and at the promised cost.

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
