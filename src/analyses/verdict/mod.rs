//! The verdict on a saw: one answer, the same for every command, text, figure, table and report.
//!
//! A saw can run at its operating speed ([`Answer::Yes`]) if no motion grows there and every limit is kept. It cannot ([`Answer::No`]) if a
//! motion grows as fast as the threshold, or a limit that the scene sets is not kept. Between both it is [`Answer::AtRisk`]: a limit of
//! practice that nobody set is not kept (85 % of the first critical speed, 5 % beside any critical speed, 100 m/s at the rim), flutter
//! grows more slowly than the threshold, or it is open whether a motion grows.

mod allowed;
mod answer;
mod criterion;
mod critical;
mod decision;
mod floquet;
mod judge;
mod report;
#[cfg(test)]
mod tests;
mod words;

pub use answer::Answer;
pub(crate) use criterion::{CRITICAL, MARGIN, STABILITY};
pub use criterion::{Criterion, LimitSource};
pub(crate) use critical::{of_critical, of_margin};
pub use floquet::FloquetEntry;
pub(crate) use judge::{Judge, OPEN_CAUSES};
pub use report::Verdict;
pub(crate) use words::near_critical;
