//! `sawflutter explore`: a live page on which a saw is changed by hand and its stability is shown at once.
//!
//! The program serves the page itself, to this computer only. The page sends the whole scene with every
//! request and computes nothing: all that it shows, and every file that it saves, comes from the same
//! functions as on the command line.

mod charts;
mod desk;
mod examples;
#[cfg(feature = "explore")]
mod guard;
#[cfg(feature = "explore")]
mod job;
mod mode;
#[cfg(feature = "explore")]
mod page;
#[cfg(feature = "explore")]
mod pages;
mod reply;
#[cfg(feature = "explore")]
mod server;
mod task;
mod told;
mod under_way;

pub use desk::{Answer, Clock, Desk, Question};
#[cfg(feature = "explore")]
pub use server::{ExploreError, Options, serve};
