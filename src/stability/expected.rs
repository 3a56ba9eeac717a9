//! How long a chart may take, estimated before its search for bands begins.

use std::fmt;

use crate::scene::rpm;
use crate::spectrum::{Assembled, NamedCriticalSpeed};

/// Work that a user should hear of before it begins, in seconds of processor time.
const LONG_S: f64 = 10.0;
/// Seconds for ten critical speeds. Each pair of waves that are reflected within the sweep may couple, and the order of the
/// reduced model that a pair is looked at in grows with their number, its eigenproblem with the cube of this order. The
/// guided saw of the paper took 7 s for 22 of them and 198 s for 42, by this constant 8 s and 196 s.
const SECONDS: f64 = 0.15;
/// The same with damping, which took 67 s for 22.
const DAMPED_SECONDS: f64 = 1.3;
/// Pairs, times the cube of the order of a reduced model.
const POWER: i32 = 2 + 3;

/// What a chart takes, as far as that is known before its search for bands.
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
    /// Of a saw with its critical speeds, up to a speed.
    pub(super) fn new(saw: &Assembled, critical: &[NamedCriticalSpeed], to_rad_per_s: f64) -> Self {
        let within = critical.partition_point(|c| c.speed_rad_per_s <= to_rad_per_s);
        let seconds = match (saw.plate.is_axisymmetric(), saw.plate.is_conservative()) {
            // Waves of a free blade do not couple.
            (true, _) => 0.0,
            (false, true) => SECONDS,
            (false, false) => DAMPED_SECONDS,
        };
        ExpectedWork {
            critical_speeds: within,
            to_rpm: rpm(to_rad_per_s),
            seconds: seconds * (within as f64 / 10.0).powi(POWER),
        }
    }

    /// Whether a user should hear of it before it begins.
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
    fn work_is_said_with_what_drives_it_and_the_key_that_shortens_it() {
        let said = expected(42, 196.0).to_string();
        for part in [
            "42 critical speeds",
            "10000 rpm",
            "3 minutes",
            "estimate",
            "sweep.to_rpm",
        ] {
            assert!(said.contains(part), "{said}");
        }
        assert!(expected(23, 14.0).to_string().contains("10 seconds"));
        assert!(expected(90, 9000.0).to_string().contains("2 hours"));
        assert!(expected(23, 10.1).is_long() && !expected(22, 7.7).is_long());
    }
}
