//! `sawflutter explore`: a live page on which a saw is changed by hand and its stability is shown at once.
//!
//! The program serves the page itself, to this computer only. The page sends the whole scene with every
//! request and computes nothing: all that it shows, and every file that it saves, comes from the same
//! functions as on the command line.

mod ahead;
mod backend;
mod charts;
mod examples;
mod fields;
#[cfg(feature = "explore")]
mod guard;
mod influence;
#[cfg(feature = "explore")]
mod job;
mod meter;
mod mode;
mod needs;
#[cfg(feature = "explore")]
mod opened;
#[cfg(feature = "explore")]
mod page;
#[cfg(feature = "explore")]
mod pages;
mod parts;
mod refusal;
mod reply;
#[cfg(feature = "explore")]
mod server;
mod task;
mod told;
mod tolerances;
mod under_way;
mod usual;
mod wording;

pub use backend::{Answer, Backend, Question};
pub use meter::Clock;
#[cfg(feature = "explore")]
pub use server::{ExploreError, Options, serve};
