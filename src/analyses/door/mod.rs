//! The one entrance to a command of one saw, for the command line, the Python package and the live page.
//!
//! The struct of a command's options is their only declaration: its fields have names that end in their units, doc comments and
//! defaults, from which help texts, signatures and readers of texts are made ([`Argument`]). A face collects what it was given as
//! JSON by name; [`entered`] makes a scene and the options of it.

mod argument;
mod command;
mod entry;
mod error;
mod scene_number;
mod text;

pub(crate) use argument::described;
pub use argument::{Argument, ArgumentKind};
pub use command::{CommandOptions, Progress, Step};
pub use entry::{Entered, entered};
pub use error::CommandError;
pub use scene_number::SceneNumber;
pub use text::named_bounds;
