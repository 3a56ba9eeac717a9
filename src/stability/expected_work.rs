//! Estimate of the time for a chart before it begins.

use std::fmt;

use super::basis::ChosenBasis;
use crate::model::scene::{Scene, rpm};

/// Work above this number of seconds of processor time is announced to the user before it begins.
const LONG_S: f64 = 10.0;
/// Processor time for ten critical speeds, in seconds, and the power of their number with which it grows.
/// Each pair of waves reflected within the sweep may couple; the order of the reduced model for a pair grows
/// with the number of waves, and the time of the eigenproblem with the cube of the order. The guided saw of
/// the paper took 7 s for 22 critical speeds and 198 s for 42; these numbers give 8 s and 196 s.
const GUIDED: (f64, i32) = (0.15, 2 + 3);
/// As [`GUIDED`] for a damped saw, which took 67 s for 22 critical speeds.
const DAMPED: (f64, i32) = (1.3, 2 + 3);
/// As [`GUIDED`] for a free blade, whose waves are uncoupled: the blade of the paper took 0.5 s for 26 critical
/// speeds, 2.5 s for 46 and 6.9 s for 68.
const FREE: (f64, i32) = (0.022, 3);

/// Work expected for a chart before it begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExpectedWork {
    /// Critical speeds within the sweep.
    pub critical_speeds: usize,
    /// End of the sweep, in rpm.
    pub to_rpm: f64,
    /// Estimated processor time in seconds; wrong by a factor of three or more for saws unlike the paper's.
    pub seconds: f64,
}

impl ExpectedWork {
    /// Expected work for the sweep of a scene, from the number of critical speeds within it. `None` for a scene without a
    /// sweep.
    pub(super) fn of_sweep(scene: &Scene, chosen: &ChosenBasis) -> Option<Self> {
        let to_rad_per_s = scene.sweep()?.to_rad_per_s;
        let ChosenBasis { saw, critical, .. } = chosen;
        let critical_speeds = critical.partition_point(|c| c.speed_rad_per_s <= to_rad_per_s);
        let (seconds, power) = match (saw.plate.is_axisymmetric(), saw.plate.is_conservative()) {
            (true, _) => FREE,
            (false, true) => GUIDED,
            (false, false) => DAMPED,
        };
        Some(ExpectedWork {
            critical_speeds,
            to_rpm: rpm(to_rad_per_s),
            seconds: seconds * (critical_speeds as f64 / 10.0).powi(power),
        })
    }

    /// Whether the work takes so long that a program should announce it.
    pub fn is_long(&self) -> bool {
        self.seconds > LONG_S
    }
}

impl fmt::Display for ExpectedWork {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let time = match self.seconds {
            seconds if seconds < 90.0 => format!("{:.0} seconds", 10.0 * (seconds / 10.0).round()),
            seconds if seconds < 5400.0 => format!("{:.0} minutes", seconds / 60.0),
            seconds => format!("{:.0} hours", seconds / 3600.0),
        };
        write!(
            f,
            "{} critical speeds are below the end of the sweep at {:.0} rpm: the search for bands takes about {time} of processor time, a rough estimate; where that is too long, lower sweep.to_rpm",
            self.critical_speeds, self.to_rpm
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn expected(critical_speeds: usize, seconds: f64) -> ExpectedWork {
        ExpectedWork {
            critical_speeds,
            to_rpm: 10_000.0,
            seconds,
        }
    }

    #[test]
    fn the_message_names_the_work_its_cause_and_the_key_that_shortens_it() {
        let message = expected(42, 196.0).to_string();
        for part in [
            "42 critical speeds",
            "10000 rpm",
            "3 minutes",
            "estimate",
            "sweep.to_rpm",
        ] {
            assert!(message.contains(part), "{message}");
        }
        assert!(expected(23, 14.0).to_string().contains("10 seconds"));
        assert!(expected(90, 9000.0).to_string().contains("2 hours"));
        assert!(expected(23, 10.1).is_long() && !expected(22, 7.7).is_long());
    }
}
