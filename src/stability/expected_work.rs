//! Estimate of the time for a chart before it begins, and the refusal of one that would take too long.
//!
//! The time is that of the eigenproblems of the reduced model: their number times the time of one. Each pair of waves that are reflected
//! within the range may couple, and the time of an eigenproblem grows with the cube of the number of waves.

use std::fmt;

use super::basis::ChosenBasis;
use super::error::{AnalysisError, END_OF_SWEEP};
use crate::model::scene::{Scene, SpeedRange, rpm};
use crate::modes::{SpectrumError, kept_waves};
use crate::page::text::{rounded_between, time_in_words};

/// Work above this number of seconds of processor time is announced to the user before it begins.
const LONG_S: f64 = 10.0;
/// Work above this number of seconds of processor time is refused.
const MOST_S: f64 = 300.0;
/// Work of the sweep that a refusal proposes, and of one that the program ends earlier: a minute, because the estimate may be wrong by a
/// factor of two or three.
const PROPOSED_S: f64 = 60.0;

/// Eigenproblems of a search that finds nothing, of its counts, and of its diagram, for each wave, because waves cross below the first
/// critical speed, too: a ring of some 190 waves took 313 at `draft`.
const LEAST_SOLVES: f64 = 1.7;
/// Power of the number of critical speeds with which the number of eigenproblems grows.
const POWER: f64 = 1.5;

/// Work of the search of a kind of saw.
#[derive(Clone, Copy)]
struct Cost {
    /// Number of eigenproblems for n critical speeds, divided by n to the [`POWER`].
    solves: f64,
    /// Processor time of an eigenproblem, and of what is computed from its result, in seconds, for few waves.
    least_s: f64,
    /// The further time, divided by the cube of the number of waves.
    cubic_s: f64,
}

/// The saw of the paper took 177, 467, 740, 1116, 2094 and 3420 eigenproblems for 6, 12, 16, 22, 32 and 38 critical speeds, and with 39,
/// 45, 49, 51, 92 and 131 waves 2.9, 2.8, 3.1, 3.4, 14 and 35 ms for each.
const GUIDED: Cost = Cost {
    solves: 11.7,
    least_s: 1.5e-3,
    cubic_s: 1.6e-8,
};
/// With a pad of 2 N·s/m it took 1335, 2486 and 3608 for 12, 16 and 22, and with 45, 49 and 51 waves 4.8, 6.1 and 6.9 ms for each, with
/// the further Newton iterations of damped bands.
const DAMPED: Cost = Cost {
    solves: 35.0,
    least_s: 1.5e-3,
    cubic_s: 4e-8,
};
/// Processor time of a free blade for ten critical speeds, in seconds, whose waves are uncoupled, and the power of their number with which
/// it grows: the blade of the paper took 0.5 s for 26 critical speeds, 2.5 s for 46 and 6.9 s for 68.
const FREE: (f64, i32) = (0.022, 3);

/// Work expected for a chart before it begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExpectedWork {
    /// Critical speeds within the sweep.
    pub critical_speeds: usize,
    /// End of the sweep, in rpm.
    pub to_rpm: f64,
    /// Estimated processor time in seconds; wrong by a factor of two or three for some saws.
    pub seconds: f64,
}

impl ExpectedWork {
    /// Expected work for a chart over a range of speeds.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem of the free blade fails.
    pub(super) fn of_range(chosen: &ChosenBasis, range: SpeedRange) -> Result<Self, SpectrumError> {
        let ChosenBasis { saw, critical, .. } = chosen;
        let below = |speed: f64| critical.partition_point(|c| c.speed_rad_per_s <= speed);
        let [before, within] = range.ends().map(below);
        let is_free = saw.plate.is_axisymmetric();
        let seconds = if is_free {
            FREE.0 * (within as f64 / 10.0).powi(FREE.1)
        } else {
            let cost = if saw.plate.is_conservative() {
                GUIDED
            } else {
                DAMPED
            };
            let waves = kept_waves(&saw.plate, range)? as f64;
            let [before, within] = [before, within].map(|count| (count as f64).powf(POWER));
            let solves = LEAST_SOLVES * waves + cost.solves * (within - before);
            solves * (cost.least_s + cost.cubic_s * waves.powi(3))
        };
        Ok(ExpectedWork {
            critical_speeds: within - before,
            to_rpm: rpm(range.to_rad_per_s),
            seconds,
        })
    }

    /// Whether the work takes so long that a program should announce it.
    pub fn is_long(&self) -> bool {
        self.seconds > LONG_S
    }

    /// The expected work for the chart of a scene.
    ///
    /// # Errors
    /// [`AnalysisError::TooLong`] if it takes too long; failed eigenproblems.
    pub(super) fn allowed(scene: &Scene, chosen: &ChosenBasis) -> Result<Self, AnalysisError> {
        let range = chosen.range_rad_per_s;
        let expected = Self::of_range(chosen, range)?;
        if expected.seconds <= MOST_S {
            return Ok(expected);
        }
        let (critical_speeds, to_rpm) = (expected.critical_speeds, expected.to_rpm);
        Err(AnalysisError::TooLong {
            key: END_OF_SWEEP,
            to_rpm: scene
                .sweep()
                .map_or(to_rpm, |sweep| rpm(sweep.to_rad_per_s)),
            limit_rpm: longest_end(chosen, range)?,
            critical_speeds,
            needed_s: expected.seconds,
            allowed_s: MOST_S,
        })
    }
}

/// End of the longest sweep whose chart takes no more than [`PROPOSED_S`], in rpm, between two critical speeds.
fn longest_end(chosen: &ChosenBasis, range: SpeedRange) -> Result<f64, SpectrumError> {
    let [from, to] = range.ends();
    let critical = chosen.critical.iter().map(|c| c.speed_rad_per_s);
    let inside: Vec<f64> = critical.filter(|c| (from..to).contains(c)).collect();
    // The end before the critical speed with an index.
    let end = |index: usize| {
        let before = index.checked_sub(1).map_or(from, |before| inside[before]);
        rounded_between(rpm(before), rpm(inside[index]))
    };
    let (mut fits, mut exceeds) = (0, inside.len());
    while exceeds - fits > 1 {
        let middle = (fits + exceeds) / 2;
        let shorter = SpeedRange::between_rpm(rpm(from), end(middle));
        if ExpectedWork::of_range(chosen, shorter)?.seconds <= PROPOSED_S {
            fits = middle;
        } else {
            exceeds = middle;
        }
    }
    Ok(if inside.is_empty() {
        rpm(from)
    } else {
        end(fits)
    })
}

impl fmt::Display for ExpectedWork {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} critical speeds are within the sweep to {:.0} rpm: the search for bands takes about {} of processor time, a rough estimate; where that is too long, lower sweep.to_rpm",
            self.critical_speeds,
            self.to_rpm,
            time_in_words(self.seconds)
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::Accuracy;
    use crate::stability::{Analysis, AnalysisOptions};

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

    fn chosen(scene: &Scene) -> ChosenBasis {
        ChosenBasis::new(scene, Accuracy::Draft.tolerance()).unwrap()
    }

    fn seconds(scene: &Scene) -> f64 {
        let chosen = chosen(scene);
        let expected = ExpectedWork::of_range(&chosen, chosen.range_rad_per_s);
        expected.unwrap().seconds
    }

    /// A ring of 6 mm on a flange, with a point roller: 46 critical speeds within 1000 rpm.
    fn ring(from_rpm: f64, to_rpm: f64) -> Scene {
        let text = format!(
            r#"{{ "name": "ring", "accuracy": "draft", "blade": {{ "outer_diameter_m": 0.3, "inner_diameter_m": 0.03,
                "thickness_m": 0.0006, "material": {{ "youngs_modulus_pa": 2.1e11, "poisson_ratio": 0.3,
                "density_kg_per_m3": 7850 }} }},
                "mount": {{ "kind": "collar", "diameter_m": 0.288, "in_plane": "fixed" }},
                "guides": [{{ "radius_m": 0.1485, "angle_deg": -60, "radial_length_m": 0, "tangential_length_m": 0,
                    "stiffness_n_per_m": 1e5 }}],
                "sweep": {{ "from_rpm": {from_rpm}, "to_rpm": {to_rpm} }} }}"#
        );
        Scene::from_json(&text).unwrap()
    }

    /// Processor times of runs at `draft`, on 2.1 to 3 GHz. None of these saws but the first two and the last gave the constants.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "large bases: run it in release")]
    fn estimates_are_within_a_factor_of_two_and_a_half_of_measured_times() {
        let paper = |to_rpm: f64| {
            Scene::paper()
                .swept(SpeedRange::between_rpm(0.0, to_rpm))
                .unwrap()
        };
        let file = |name: &str| {
            let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes");
            Scene::from_path(format!("{folder}/{name}.json")).unwrap()
        };
        for (what, scene, measured_s) in [
            ("paper to 6000", paper(6000.0), 3.8),
            ("paper to 9500", paper(9500.0), 119.0),
            ("two pads", file("two-pads"), 0.72),
            ("damped material", file("gallery/damped-material"), 1.06),
            ("opposed pads", file("gallery/opposed-pads"), 0.96),
            ("ring from 35 400", ring(35_400.0, 36_500.0), 71.0),
            ("ring below its critical speeds", ring(0.0, 34_970.0), 40.8),
        ] {
            let ratio = seconds(&scene) / measured_s;
            assert!((0.4..2.5).contains(&ratio), "{what}: {ratio}");
        }
    }

    /// The sweep that the refusal proposes takes a minute, and the rest is charted in a few further ones.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "large bases: run it in release")]
    fn a_sweep_that_takes_too_long_is_refused_before_the_work_and_its_remedy_works() {
        let options = AnalysisOptions {
            progress: &|_, _| panic!("speeds were computed"),
            ..AnalysisOptions::default()
        };
        let refused = match Analysis::with_options(&ring(0.0, 36_500.0), options) {
            Err(error @ AnalysisError::TooLong { .. }) => error,
            other => panic!("{other:?}"),
        };
        let text = refused.to_string();
        assert!(text.starts_with("sweep.to_rpm must be at most "), "{text}");
        let AnalysisError::TooLong { limit_rpm, .. } = refused else {
            unreachable!()
        };
        assert!((35_507.0..36_500.0).contains(&limit_rpm), "{limit_rpm}");
        let part = ring(0.0, limit_rpm);
        let proposed = ExpectedWork::allowed(&part, &chosen(&part)).unwrap();
        assert!(proposed.seconds <= PROPOSED_S, "{proposed:?}");
        let (mut from, mut sweeps) = (limit_rpm, 1);
        loop {
            let rest = ring(from, 36_500.0);
            sweeps += 1;
            match ExpectedWork::allowed(&rest, &chosen(&rest)) {
                Ok(_) => break,
                Err(AnalysisError::TooLong { limit_rpm, .. }) if limit_rpm > from => {
                    from = limit_rpm
                }
                other => panic!("{from}: {other:?}"),
            }
        }
        assert!(sweeps <= 6, "{sweeps}");
    }
}
