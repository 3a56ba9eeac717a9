//! `sawflutter explore`: a live page on which a saw is changed by hand and its stability is shown at once.
//!
//! The program serves the page itself, to this computer only. The page sends the whole scene with every
//! request and computes nothing: all that it shows, and every file that it saves, comes from the same
//! functions as on the command line.

mod answer;
mod backend;
mod charts;
#[cfg(feature = "explore")]
mod connections;
mod early_answer;
mod entry;
mod examples;
mod fields;
mod glossary;
#[cfg(feature = "explore")]
mod guard;
mod influence;
mod initial_part;
#[cfg(feature = "explore")]
mod job;
mod meter;
mod mode;
mod needs;
#[cfg(feature = "explore")]
mod opened_file;
#[cfg(feature = "explore")]
mod page;
#[cfg(feature = "explore")]
mod pages;
mod parts;
mod progress;
mod refusal;
mod reply;
#[cfg(feature = "explore")]
mod server;
mod task;
mod tolerances;
mod wording;

pub use backend::{Answer, Backend, Question};
pub use meter::Clock;
#[cfg(feature = "explore")]
pub use server::{ExploreError, Options, serve};
