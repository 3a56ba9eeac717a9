//! A report as one page of HTML: its text, figures, inputs, version.
//!
//! The page is self-contained: it includes styles, figures and the scene, and can be printed. Its contents are
//! those of the text, the figures and the JSON of the report.

mod inputs;
mod layout;

pub use layout::Document;
