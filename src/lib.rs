//! Stability of thin, fast, guided circular saws in the frequency domain.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod figure;
pub mod plate;
pub mod report;
pub mod scene;
