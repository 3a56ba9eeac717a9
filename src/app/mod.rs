//! The program and the live page: arguments and requests become calls of the library.

#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "page")]
pub mod explore;
