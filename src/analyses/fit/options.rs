//! Options of a fit.

use super::Measurement;
use crate::model::plate::Resolution;
use crate::model::scene::RefusedValue;

/// Confidence, starts and speeds of a fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Probability that an interval contains the true value.
    pub confidence: f64,
    /// Number of starts: the original values, and others spread over the bounds. Exchanged guides are not counted.
    pub starts: usize,
    /// Speed in rpm up to which rows are fitted.
    pub to_rpm: f64,
    /// A basis to use instead of the one that the tolerance of the scene requires.
    pub resolution: Option<Resolution>,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            confidence: 0.95,
            starts: 12,
            to_rpm: f64::INFINITY,
            resolution: None,
        }
    }
}

/// Largest number of starts, far more than are needed to find the lowest minimum.
const MAX_STARTS: usize = 1000;

impl Options {
    /// Checks the options for a fit to a measurement.
    ///
    /// # Errors
    /// [`RefusedValue`] that names the option, or the last speed if nothing is measured up to it.
    pub fn checked(self, measurement: &Measurement) -> Result<Self, RefusedValue> {
        if !(self.confidence > 0.0 && self.confidence < 1.0) {
            let (key, remedy) = ("confidence", "0.95 is usual");
            let allowed = "between 0 and 1";
            return Err(RefusedValue::new(key, self.confidence, allowed, remedy));
        }
        if !(1..=MAX_STARTS).contains(&self.starts) {
            let allowed = format!("from 1 to {MAX_STARTS}");
            let remedy = "a dozen is usual";
            return Err(RefusedValue::new("starts", self.starts, allowed, remedy));
        }
        if measurement.count() > 0 && measurement.up_to(self.to_rpm).count() == 0 {
            let source = &measurement.source;
            let allowed = format!("at least the lowest speed of {source} with a frequency");
            let remedy = "give a higher speed, or another table";
            return Err(RefusedValue::new("to_rpm", self.to_rpm, allowed, remedy));
        }
        Ok(self)
    }
}
