//! Goal: the designer's tools find what is known beforehand.

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/measurements.rs"]
mod measurements;

mod fit;
mod numbers;
mod place;
mod study;
