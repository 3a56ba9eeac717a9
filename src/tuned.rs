//! Constants that no theory gives: chosen by trial, with the trial beside them.
//!
//! `cargo test --release --lib constants -- --ignored --nocapture` analyses saws with each of
//! them at half and at double its value, and prints what becomes of the answer and of the work.

/// A constant that was chosen by trial.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tuned {
    #[cfg_attr(not(test), allow(dead_code, reason = "names it in the trial"))]
    name: &'static str,
    value: f64,
}

impl Tuned {
    /// With the name that the trial prints.
    pub(crate) const fn new(name: &'static str, value: f64) -> Self {
        Tuned { name, value }
    }

    /// Its value.
    #[cfg(not(test))]
    pub(crate) const fn get(&self) -> f64 {
        self.value
    }

    /// Its value, scaled while it is on trial.
    #[cfg(test)]
    pub(crate) fn get(&self) -> f64 {
        self.value * trial::factor(self.name)
    }
}

#[cfg(test)]
mod trial;
