//! What every face needs, without physics: text, outlines, figures.
//!
//! Read `text` first (files, numbers and error messages), then `outline` (an answer with reasons, facts and tables, as 80
//! columns or as HTML) and [`figure`] (charts as data, as PNG or as SVG).

pub mod figure;
pub(crate) mod outline;
#[doc(hidden)]
pub mod text;
