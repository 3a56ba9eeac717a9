//! Interface of the tables of a study.

use std::io;

use super::saw::Saw;

/// A file to which saws are written in the order of their numbers.
pub trait Table {
    /// Adds the next saws.
    ///
    /// # Errors
    /// The error of writing.
    fn add(&mut self, saws: &[Saw]) -> io::Result<()>;

    /// Completes the file.
    ///
    /// # Errors
    /// The error of writing.
    fn finish(self: Box<Self>) -> io::Result<()>;
}
