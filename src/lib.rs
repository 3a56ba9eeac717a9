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
//! [`Analysis`](stability::Analysis) charts a saw: critical speeds, bands of instability, branches. Each other question is one
//! function, named like the command of the program; its result is the report that the program writes, with text, figures
//! and page as methods of [`CommandReport`](commands::CommandReport):
//!
//! ```
//! use sawflutter::analyses::deflect::Options;
//! use sawflutter::prelude::*;
//!
//! let saw = Scene::paper().edited(|saw| saw.accuracy = Accuracy::Draft)?;
//! let options = Options { to_rpm: Some(1600.0) };
//! let found = sawflutter::deflect(&saw, &options)?;
//! println!("{}", found.summary());
//! assert!(found.up.jumps.is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | question | function |
//! |---|---|
//! | does the saw keep its limits | [`check()`] |
//! | is it stable before, during and after a cut | [`cut()`] |
//! | how far does it vibrate in steady state | [`response()`] |
//! | how far does it lean, and where does it jump | [`deflect()`] |
//! | how tight may its guides be | [`gap()`] |
//! | does the wave of a tooth grow with the next | [`washboard()`] |
//! | what happens in a run-up | [`runup()`] |
//! | which stiffness, density … has a measured saw | [`fit()`] |
//! | where do guides belong | [`place()`] |
//! | how many saws within tolerances keep their limits | [`study()`] |
//! | how does stability change over one or two numbers | [`map()`] |
//! | how do saws differ | [`compare()`] |
//! | what does accuracy cost | [`tradeoff()`] |
//!
//! Below, from the ground upwards: [`scene`] is the input, [`plate`] the blade and its contacts, [`system`] the equation of
//! motion, [`spectrum`] its eigenvalues at one speed, [`campbell`] branches over the speed, [`stability`] critical speeds, bands
//! and verdict, [`transient`] time histories, [`stretched`] the blade at large deflections, [`spline`] its motion on the
//! arbor. [`analyses`] asks them the questions above, [`figure`] draws and [`document`] writes what they find. [`analytical`]
//! contains closed forms with their sources, with which tests compare all of it.

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
mod outline;
pub mod plate;
pub mod report;
pub mod scene;
pub mod spectrum;
pub mod spline;
pub mod stability;
pub mod stretched;
pub mod system;
#[doc(hidden)]
pub mod text;
pub mod transient;
mod tuned;

pub use analyses::check::check;
pub use analyses::compare::compare;
pub use analyses::cut::cut;
pub use analyses::deflect::deflect;
pub use analyses::fit::fit;
pub use analyses::gap::gap;
pub use analyses::map::map;
pub use analyses::place::place;
pub use analyses::response::response;
pub use analyses::runup::runup;
pub use analyses::study::study;
pub use analyses::tradeoff::tradeoff;
pub use analyses::washboard::washboard;

/// Items that most programs need.
pub mod prelude {
    pub use crate::analyses::check::Limits;
    pub use crate::commands::CommandReport;
    pub use crate::report::Report;
    pub use crate::scene::{Accuracy, Scene, SceneError};
    pub use crate::stability::{
        Analysis, AnalysisError, AnalysisOptions, Instability, InstabilityKind, StabilityState,
    };
}
