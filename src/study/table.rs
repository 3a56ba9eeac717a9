//! Where the saws of a study are written to.

use std::io;

use super::saw::Saw;

/// A file that saws are written to, in the order of their numbers.
pub trait Table {
    /// Adds the next saws.
    ///
    /// # Errors
    /// What writing raises.
    fn add(&mut self, saws: &[Saw]) -> io::Result<()>;

    /// Ends the file.
    ///
    /// # Errors
    /// What writing raises.
    fn finish(self: Box<Self>) -> io::Result<()>;
}
