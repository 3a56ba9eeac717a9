//! `sawflutter explore`: a page on which the saw can be changed by hand, and what becomes of
//! its stability is seen at once.
//!
//! The page is served from the program itself, to this computer alone. It sends the whole
//! scene with every request and holds no numbers of its own: what it shows, and every file it
//! saves, comes from the same calls as on the command line.

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
