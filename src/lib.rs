//! Stability of thin, fast, guided circular saws in the frequency domain.
//!
//! The rooms of this crate stand in the order in which a saw goes through them, and
//! each imports only from those before it: [`scene`] → [`plate`] → [`system`] →
//! [`spectrum`] → [`campbell`] → [`stability`] → [`transient`] →
//! [`report`] → [`figure`] → `explore`. [`check`], [`fit`] and [`place`] stand after [`stability`],
//! [`study`] after [`check`]; [`spline`] stands beside [`system`]: it imports [`scene`] and
//! [`plate`] alone. [`analytical`] imports nothing: closed forms with their sources, which the
//! tests hold the rest against.
//!
//! ```
//! use sawflutter::{scene::{Accuracy, Scene, rpm}, stability::Analysis};
//!
//! let scene = Scene::paper().edited(|saw| saw.accuracy = Accuracy::Draft)?;
//! let analysis = Analysis::new(&scene)?;
//! let lowest = rpm(analysis.model.critical[0].speed_rad_per_s);
//! assert!(1500.0 < lowest && lowest < 1600.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]
#![warn(missing_docs)]

// The integration tests' draws of saws serve the unit tests too, by the crate's own name.
#[cfg(test)]
extern crate self as sawflutter;

pub mod analytical;
pub mod campbell;
pub mod check;
#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "explore")]
pub mod explore;
pub mod figure;
pub mod fit;
pub mod place;
pub mod plate;
pub mod report;
pub mod scene;
pub mod spectrum;
pub mod spline;
pub mod stability;
pub mod study;
pub mod system;
pub mod text;
pub mod transient;
