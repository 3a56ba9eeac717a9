//! Goal: the answers converge, the promised accuracy is kept, and at the promised cost.

#[path = "../common/mod.rs"]
mod common;

mod estimates;
mod orders;
mod tolerance;
mod work;
