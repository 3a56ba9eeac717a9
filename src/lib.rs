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
//! # assert!((1400.0..1600.0).contains(&analysis.first_critical_rpm().unwrap()));
//! # std::fs::remove_dir_all(&folder)?;
//! # Ok(())
//! # }
//! ```
//!
//! [`Analysis`](stability::Analysis) charts a saw: critical speeds, bands of instability, branches. Each other question is one
//! function, named like the command of the program; its result is the report that the program writes, with text, figures
//! and page as methods of [`CommandReport`](analyses::commands::CommandReport):
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
//! | how thick, stiff or fast may the saw be | [`size()`](analyses::size::size) |
//! | how many saws within tolerances keep their limits | [`study()`] |
//! | how does stability change over one or two numbers | [`map()`] |
//! | how do saws differ | [`compare()`] |
//! | what does accuracy cost | [`tradeoff()`] |
//!
//! The library has seven rooms, each of which imports only from those before it: [`page`] is what every face needs (texts,
//! outlines, figures) and knows no physics; [`model`] leads from the scene to the equation of motion; [`modes`] solves it at one
//! speed and follows its modes over the speed; [`stability`] finds critical speeds, bands and the verdict; [`motion`] contains
//! time histories and large deflections; [`analyses`] has one folder for each question above, with computation, report,
//! text and figures; `app` is the program and the live page.

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
#[doc(hidden)]
pub mod app;
pub mod model;
pub mod modes;
pub mod motion;
pub mod page;
pub mod stability;

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
    pub use crate::analyses::campbell::Report;
    pub use crate::analyses::check::Limits;
    pub use crate::analyses::commands::CommandReport;
    pub use crate::model::scene::{Accuracy, Scene, SceneError};
    pub use crate::stability::{
        Analysis, AnalysisError, AnalysisOptions, Instability, InstabilityKind, StabilityState,
    };
}
