//! Stability of thin, fast, guided circular saws in the frequency domain.
//!
//! ```
//! use sawflutter::prelude::*;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let folder = std::env::temp_dir().join(format!("sawflutter-{}", std::process::id()));
//! # std::fs::create_dir_all(&folder)?;
//! # let paper = Scene::paper().edited(|s| s.accuracy = Accuracy::Draft)?;
//! # std::fs::write(folder.join("saw.json"), serde_json::to_string(paper.file())?)?;
//! # std::env::set_current_dir(&folder)?;
//! let saw = Scene::from_path("saw.json")?.edited(|s| s.guides[0].radius_m = 0.22)?;
//! let analysis = Analysis::new(&saw)?;
//! for band in analysis.bands() {
//!     println!("{band}");
//! }
//! std::fs::write("campbell.svg", analysis.report().campbell_svg()?)?;
//! # assert!((1400.0..1600.0).contains(&analysis.lowest_critical_rpm().unwrap()));
//! # std::fs::remove_dir_all(&folder)?;
//! # Ok(())
//! # }
//! ```
//!
//! The modules are listed in the order in which a scene passes through them, and each imports only from those
//! before it; modules separated by commas are on one level: [`scene`] → [`plate`] → [`system`] → [`spectrum`] →
//! [`campbell`] → [`stability`] → [`transient`] → [`washboarding`], [`response`], [`deflect`] →
//! [`check`], [`gap`] → [`report`], [`analyses`] → [`figure`] → [`document`] → [`commands`]. [`spline`] is on
//! the level of [`system`] and imports [`scene`] and [`plate`] alone; [`stretched`] is on the level of
//! [`campbell`]. [`analytical`] imports nothing; it contains closed forms with their sources, with which tests
//! compare the other modules. `linalg` imports nothing either; the other modules call eigenvalue and singular value
//! solvers through it alone.

#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![cfg_attr(
    test,
    allow(
        clippy::disallowed_methods,
        reason = "tests compare with the solvers themselves"
    )
)]

// Unit tests use the random saws of the integration tests, which refer to the crate by its name.
#[cfg(test)]
extern crate self as sawflutter;

pub mod analyses;
pub mod analytical;
pub mod campbell;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
pub mod commands;
pub mod document;
#[cfg(feature = "page")]
#[doc(hidden)]
pub mod explore;
pub mod figure;

mod linalg;
pub mod plate;
pub mod report;
pub mod scene;
pub mod spectrum;
pub mod spline;
pub mod stability;
pub mod stretched;
mod summary;
pub mod system;
#[doc(hidden)]
pub mod text;
pub mod transient;
mod tuned;

/// Items that most programs need.
pub mod prelude {
    pub use crate::analyses::check::{CheckReport, Limits, check};
    pub use crate::report::Report;
    pub use crate::scene::{Accuracy, Scene, SceneError};
    pub use crate::stability::{
        Analysis, AnalysisError, AnalysisOptions, Instability, InstabilityKind, StabilityState,
    };
}
