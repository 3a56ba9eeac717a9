//! Constants without a theoretical value, chosen by trials.
//!
//! `cargo test --release --lib -- --ignored --nocapture tuned_tests` analyses saws with each constant at half
//! and at double its value, and prints the changes of the results and of the computing time.

/// A constant that was chosen by trial.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tuned {
    #[cfg_attr(not(test), allow(dead_code, reason = "only the trial prints it"))]
    name: &'static str,
    value: f64,
}

impl Tuned {
    /// A constant with its path, which names it in the output of the trial.
    pub(crate) const fn new(name: &'static str, value: f64) -> Self {
        Tuned { name, value }
    }

    /// Value of the constant.
    #[cfg(not(test))]
    pub(crate) const fn get(&self) -> f64 {
        self.value
    }

    /// Value of the constant, halved or doubled while it is on trial.
    #[cfg(test)]
    pub(crate) fn get(&self) -> f64 {
        self.value * trial::factor(self.name)
    }
}

#[cfg(test)]
pub(crate) mod trial;
