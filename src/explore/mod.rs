//! `sawflutter explore`: a live page on which a saw is changed by hand and its stability is shown at once.
//!
//! The program serves the page itself, to this computer only. The page sends the whole scene with every
//! request and computes nothing: all that it shows, and every file that it saves, comes from the same
//! functions as on the command line.

mod charts;
mod examples;
mod guard;
mod job;
mod mode;
mod page;
mod pages;
mod reply;
mod server;
mod task;
mod told;
mod under_way;

pub use server::{Options, serve};
