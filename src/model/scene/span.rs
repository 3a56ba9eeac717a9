//! The range that a number of a scene may have.

use serde::Serialize;

use crate::page::text::shown;

/// Range of numbers between two ends, each of which belongs to the range unless it is open.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Span {
    /// Lower end.
    pub from: f64,
    /// Upper end.
    pub to: f64,
    /// Whether the lower end is excluded.
    pub is_open_below: bool,
    /// Whether the upper end is excluded.
    pub is_open_above: bool,
}

/// Ends tell a user nothing if their ratio exceeds this.
const FAR_RATIO: f64 = 1e5;
/// The same for the difference of ends if the lower one is not positive.
const FAR: f64 = 1e9;

impl Span {
    /// The range with both ends.
    pub(super) const fn closed(from: f64, to: f64) -> Self {
        Span {
            from,
            to,
            is_open_below: false,
            is_open_above: false,
        }
    }

    /// The range without its lower end.
    pub(super) const fn above(from: f64, to: f64) -> Self {
        Span {
            is_open_below: true,
            ..Span::closed(from, to)
        }
    }

    /// The range without its ends.
    pub(super) const fn open(from: f64, to: f64) -> Self {
        Span {
            is_open_above: true,
            ..Span::above(from, to)
        }
    }

    /// Whether a number lies in the range.
    pub fn contains(&self, value: f64) -> bool {
        let above = value > self.from || value == self.from && !self.is_open_below;
        above && (value < self.to || value == self.to && !self.is_open_above)
    }

    /// The number of the range that is nearest to a number.
    pub(super) fn nearest(&self, value: f64) -> f64 {
        let near = value.clamp(self.from, self.to);
        match self.contains(near) {
            true => near,
            false if near == self.from => near.next_up(),
            false => near.next_down(),
        }
    }

    /// Whether the ends are so far from each other that the usual range tells more.
    pub(crate) fn is_far(&self) -> bool {
        if self.from > 0.0 {
            self.to / self.from >= FAR_RATIO
        } else {
            self.to - self.from >= FAR
        }
    }

    /// The range for a reader: "between 0 and 1", "above -1 and below 0.5".
    pub fn in_words(&self) -> String {
        let (from, to) = (shown(self.from), shown(self.to));
        let below = if self.is_open_below {
            "above"
        } else {
            "at least"
        };
        let above = if self.is_open_above {
            "below"
        } else {
            "at most"
        };
        if self.is_open_below || self.is_open_above {
            format!("{below} {from} and {above} {to}")
        } else {
            format!("between {from} and {to}")
        }
    }

    /// The end that a number exceeds, for a reader.
    pub(super) fn end_in_words(&self, value: f64) -> String {
        if value > self.to {
            format!("at most {}", shown(self.to))
        } else if self.from >= 0.0 && value <= 0.0 && !self.contains(0.0) {
            "above 0".to_owned()
        } else {
            format!("at least {}", shown(self.from))
        }
    }
}
