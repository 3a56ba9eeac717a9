//! Goal: the designer's tools find what is known beforehand.

#[path = "../common/mod.rs"]
mod common;

mod fit;
mod numbers;
mod place;
mod study;
