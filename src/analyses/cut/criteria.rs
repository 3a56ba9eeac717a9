//! Criteria that decide whether a cut is stable.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::history::CutHistory;
use super::record::Growth;
use super::spline::SplineOrbit;
use crate::analyses::campbell::Verdict;
use crate::model::scene::Scene;

/// Whether a cut is stable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CutStability {
    /// No vibration grows as fast as the threshold, and the deflection stays within the model.
    Stable,
    /// The same, but the speed is within 5 % of a critical speed of the saw, in the cut or out of it.
    AtCritical,
    /// No vibration grows as fast, but the forces alone deflect the blade beyond the linear model and any kerf,
    /// or with stretching to slopes beyond 0.1.
    LeavesModel,
    /// Some vibration grows.
    Unstable,
}

/// Criterion of a verdict.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CutCriterion {
    /// Eigenvalues in the cut, with stationary tooth loads.
    Eigenvalues,
    /// Growth fitted to the deflection in the cut.
    TimeHistory,
    /// Floquet multipliers with tooth loads that move with the teeth.
    MovingToothLoads,
    /// Eigenvalues in the cut, with the simulated reaction of the spline.
    SplineReaction,
    /// Eigenvalues before and after the cut.
    OutOfCut,
}

/// A criterion and its result.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "CutCriterionEntry")]
pub struct CutFinding {
    /// The criterion.
    pub criterion: CutCriterion,
    /// Its verdict.
    pub verdict: Verdict,
    /// Its largest growth.
    pub growth_per_s: f64,
    /// Frequency of that motion, if it is known and the vibration grows.
    pub frequency_hz: Option<f64>,
}

/// Relative difference that is allowed between the growth rates of two methods.
const AGREEMENT: f64 = 0.02;

/// The result of each criterion at one speed, of which `moving` is the growth under moving tooth loads.
pub(super) fn criteria(
    scene: &Scene,
    history: &CutHistory,
    moving: Growth,
    spline: Option<&SplineOrbit>,
) -> Vec<CutFinding> {
    let entry = |criterion: CutCriterion, growth: Growth| CutFinding {
        criterion,
        verdict: Verdict::of(scene, growth),
        growth_per_s: growth.growth_per_s,
        frequency_hz: growth.growing_hz(),
    };
    let fitted = history.fitted.map(|fitted| CutFinding {
        // The frequency is given only if the growth rate reaches the threshold, because a smaller one may be
        // rounding.
        frequency_hz: fitted
            .growing_hz()
            .filter(|_| Verdict::of(scene, fitted) == Verdict::Unstable),
        ..entry(CutCriterion::TimeHistory, fitted)
    });
    let moving = CutFinding {
        frequency_hz: None,
        ..entry(CutCriterion::MovingToothLoads, moving)
    };
    let on_spline = spline.map(|found| CutFinding {
        criterion: CutCriterion::SplineReaction,
        verdict: found.verdict,
        growth_per_s: found.growth_per_s,
        frequency_hz: found.frequency_hz,
    });
    [
        Some(entry(CutCriterion::Eigenvalues, history.in_cut())),
        fitted,
        Some(moving),
        on_spline,
        Some(entry(CutCriterion::OutOfCut, history.idle())),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// The worst verdict.
#[derive(Debug, PartialEq)]
pub(super) struct Decision {
    pub verdict: Verdict,
    /// The criterion of fastest growth that gives the verdict, the first of equals.
    pub by: CutCriterion,
}

pub(super) fn worst(criteria: &[CutFinding]) -> Decision {
    let unstable = |entry: &CutFinding| entry.verdict == Verdict::Unstable;
    let verdict = if criteria.iter().any(unstable) {
        Verdict::Unstable
    } else {
        Verdict::Stable
    };
    let mut fastest: Option<&CutFinding> = None;
    for entry in criteria.iter().filter(|entry| entry.verdict == verdict) {
        let faster = |than: &CutFinding| {
            let apart = AGREEMENT * than.growth_per_s.abs();
            entry.growth_per_s > than.growth_per_s + apart
        };
        if fastest.is_none_or(faster) {
            fastest = Some(entry);
        }
    }
    let by = fastest.map_or(CutCriterion::Eigenvalues, |entry| entry.criterion);
    Decision { verdict, by }
}

/// Whether a time history agrees with the eigenvalues.
pub(super) fn agree(scene: &Scene, fitted: Growth, eigenvalue: Growth) -> bool {
    let of = |growth: Growth| Verdict::of(scene, growth);
    let apart = (fitted.growth_per_s / eigenvalue.growth_per_s - 1.0).abs();
    of(fitted) == of(eigenvalue) && (of(fitted) == Verdict::Stable || apart <= AGREEMENT)
}

impl Verdict {
    /// The threshold is one of flutter: divergence always counts, as in a band.
    pub(super) fn of(scene: &Scene, growth: Growth) -> Self {
        let rate = growth.growth_per_s;
        let is_slow = rate < scene.flutter_threshold_per_s() || rate <= 0.0;
        if is_slow && !growth.diverges {
            Verdict::Stable
        } else {
            Verdict::Unstable
        }
    }
}

impl CutStability {
    pub(super) fn new(growth: Verdict, leaves_model: bool, is_critical: bool) -> Self {
        match growth {
            Verdict::Unstable => CutStability::Unstable,
            Verdict::Stable if leaves_model => CutStability::LeavesModel,
            Verdict::Stable if is_critical => CutStability::AtCritical,
            Verdict::Stable => CutStability::Stable,
        }
    }
}

impl std::fmt::Display for CutStability {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(match self {
            CutStability::Stable => "stable",
            CutStability::AtCritical => "stable, but at a critical speed",
            CutStability::LeavesModel => "no growth, but the deflection leaves the model",
            CutStability::Unstable => "unstable",
        })
    }
}

impl std::fmt::Display for CutCriterion {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(match self {
            CutCriterion::Eigenvalues => "eigenvalues",
            CutCriterion::TimeHistory => "time history",
            CutCriterion::MovingToothLoads => "moving tooth loads",
            CutCriterion::SplineReaction => "simulated spline reaction",
            CutCriterion::OutOfCut => "out of the cut",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A growing oscillation.
    fn flutter(growth_per_s: f64) -> Growth {
        Growth {
            growth_per_s,
            frequency_rad_per_s: 30.0,
            diverges: false,
        }
    }

    fn entry(criterion: CutCriterion, growth_per_s: f64) -> CutFinding {
        CutFinding {
            criterion,
            verdict: Verdict::of(&Scene::paper(), flutter(growth_per_s)),
            growth_per_s,
            frequency_hz: None,
        }
    }

    /// The threshold is 0.25 1/s. One criterion above it suffices and is named.
    #[test]
    fn the_worst_criterion_decides() {
        use CutCriterion::{Eigenvalues, MovingToothLoads, OutOfCut, TimeHistory};
        let cases = [
            ([0.0, 1e-9, 0.379, 0.0], Verdict::Unstable, MovingToothLoads),
            ([0.0, 0.0, 0.0, 0.3], Verdict::Unstable, OutOfCut),
            ([6.0, 6.0001, 5.9, 0.0], Verdict::Unstable, Eigenvalues),
            ([0.249, 0.2501, 0.2, 0.0], Verdict::Unstable, TimeHistory),
            ([0.0, 0.0, 0.1, 0.0], Verdict::Stable, MovingToothLoads),
            ([-3.0, -3.0001, -2.0, -1.0], Verdict::Stable, OutOfCut),
        ];
        for (growths, verdict, by) in cases {
            let criteria = [Eigenvalues, TimeHistory, MovingToothLoads, OutOfCut];
            let entries = [0, 1, 2, 3].map(|k| entry(criteria[k], growths[k]));
            assert_eq!(worst(&entries), Decision { verdict, by }, "{growths:?}");
        }
    }

    /// A growth rate that is not a number is not called stable.
    #[test]
    fn a_growth_rate_that_is_not_a_number_is_not_stable() {
        let scene = Scene::paper();
        for growth in [f64::NAN, f64::INFINITY] {
            assert_eq!(Verdict::of(&scene, flutter(growth)), Verdict::Unstable);
        }
    }
}
