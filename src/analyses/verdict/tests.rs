//! Verdicts on saws made of numbers, at the edges of every limit.

use super::{Answer, Judge, Verdict};
use crate::model::scene::{Accuracy, LimitsFile, SpeedRange, rad_per_s};
use crate::stability::{Evidence, FloquetGrowth, InstabilityKind, ListedBand, NearbyGrowth};

/// A band of flutter in rpm, with a growth rate in 1/s, that counts from 0.25 1/s on.
fn flutter(from: f64, to: f64, growth: f64, error: Option<f64>) -> ListedBand {
    let range = SpeedRange::new(rad_per_s(from), rad_per_s(to));
    ListedBand {
        kind: InstabilityKind::Flutter,
        range,
        counted: Vec::from_iter((growth >= 0.25).then_some(range)),
        felt: Vec::from_iter((growth >= 0.0025).then_some(range)),
        peak_growth_per_s: growth,
        edge_error: error,
    }
}

/// The saw of the tests: critical speeds of 2000 and 3000 rpm, searched up to 5000 rpm, a rim of 0.3 m.
struct Saw {
    bands: Vec<ListedBand>,
    critical_rpm: Vec<f64>,
    limits: LimitsFile,
    has_failed: bool,
    is_held: bool,
    covered_to_rpm: f64,
    floquet: Option<NearbyGrowth>,
}

impl Saw {
    fn new(bands: Vec<ListedBand>) -> Self {
        Saw {
            bands,
            critical_rpm: vec![2000.0, 3000.0],
            limits: LimitsFile::default(),
            has_failed: false,
            is_held: true,
            covered_to_rpm: f64::INFINITY,
            floquet: None,
        }
    }

    fn limited(limits: LimitsFile) -> Self {
        Saw {
            limits,
            ..Saw::new(Vec::new())
        }
    }

    fn at(&self, rpm: impl Into<Option<f64>>) -> Verdict {
        let critical: Vec<f64> = self.critical_rpm.iter().copied().map(rad_per_s).collect();
        let found = Evidence {
            bands: self.bands.clone(),
            has_failed: self.has_failed,
            critical_rad_per_s: &critical,
            threshold_per_s: 0.25,
            range_rad_per_s: SpeedRange::new(0.0, rad_per_s(5000.0)),
            not_covered: Vec::from_iter(
                self.covered_to_rpm
                    .is_finite()
                    .then(|| SpeedRange::new(rad_per_s(self.covered_to_rpm), f64::INFINITY)),
            ),
            floquet: self.floquet,
        };
        let judge = Judge {
            found: &found,
            limits: &self.limits,
            rim_radius_m: 0.3,
            is_held: self.is_held,
            accuracy: Accuracy::Design,
        };
        judge.verdict(rpm.into().map(rad_per_s), Vec::new())
    }
}

fn said(verdict: &Verdict) -> (Option<Answer>, &str) {
    (verdict.answer, verdict.cause.as_deref().unwrap_or("none"))
}

fn close(found: Option<f64>, expected: f64) -> bool {
    found.is_some_and(|found| (found / expected - 1.0).abs() < 1e-9)
}

/// 85 % of 2000 rpm are 1700 rpm, and 95 % are 1900 rpm.
#[test]
fn practice_puts_a_saw_at_risk_and_the_user_forbids_it() {
    let saw = Saw::new(Vec::new());
    for (rpm, expected) in [
        (0.0, (Some(Answer::Yes), "none")),
        (1699.9, (Some(Answer::Yes), "none")),
        (1700.1, (Some(Answer::AtRisk), "margin")),
        (1900.1, (Some(Answer::AtRisk), "critical")),
        (2500.0, (Some(Answer::AtRisk), "margin")),
        (5001.0, (Some(Answer::AtRisk), "outside_sweep")),
    ] {
        let verdict = saw.at(rpm);
        assert_eq!(said(&verdict), expected, "{rpm}");
        assert!(close(verdict.allowed_to_rpm, 1700.0), "{verdict:?}");
        assert_eq!(verdict.windows_rpm.len(), 1);
    }
    let own = Saw::limited(LimitsFile {
        margin: Some(0.85),
        ..LimitsFile::default()
    });
    assert_eq!(said(&own.at(1700.1)), (Some(Answer::No), "margin"));
    assert_eq!(said(&own.at(1699.9)), (Some(Answer::Yes), "none"));
}

/// Rim speeds of 100 m/s and 60 m/s at a radius of 0.3 m are 3183.1 and 1909.9 rpm.
#[test]
fn a_user_who_allows_speeds_above_critical_ones_has_several_windows() {
    let saw = Saw {
        bands: vec![flutter(2400.0, 2500.0, 1.0, Some(0.01))],
        ..Saw::limited(LimitsFile {
            margin: Some(2.0),
            ..LimitsFile::default()
        })
    };
    let verdict = saw.at(2300.0);
    assert_eq!(said(&verdict), (Some(Answer::Yes), "none"));
    let last = 100.0 / 0.3 * 60.0 / std::f64::consts::TAU;
    let expected = [
        [0.0, 1900.0],
        [2100.0, 2376.0],
        [2525.0, 2850.0],
        [3150.0, last],
    ];
    assert_eq!(verdict.windows_rpm.len(), expected.len(), "{verdict:?}");
    for (window, expected) in verdict.windows_rpm.iter().zip(expected) {
        for (end, expected) in window.iter().zip(expected) {
            assert!((end - expected).abs() < 1e-6, "{:?}", verdict.windows_rpm);
        }
    }
    assert_eq!(
        verdict.allowed_by.as_deref(),
        Some("5 % below a critical speed")
    );
    assert_eq!(said(&saw.at(2450.0)), (Some(Answer::No), "flutter"));
    assert_eq!(said(&saw.at(2380.0)), (Some(Answer::AtRisk), "too_close"));
}

/// Flutter of 0.1 1/s is felt, of 1e-3 1/s it is not.
#[test]
fn weak_flutter_puts_a_saw_at_risk_if_it_is_felt() {
    let weak = Saw::new(vec![flutter(1000.0, 1100.0, 0.1, Some(1e-6))]);
    let verdict = weak.at(1050.0);
    assert_eq!(said(&verdict), (Some(Answer::AtRisk), "weak_flutter"));
    assert!((verdict.allowed_to_rpm.unwrap() - 999.999).abs() < 1e-6);
    assert_eq!(
        verdict.allowed_by.as_deref(),
        Some("where weak flutter begins")
    );
    let faint = Saw::new(vec![flutter(1000.0, 1100.0, 1e-3, Some(1e-6))]);
    assert_eq!(said(&faint.at(1050.0)), (Some(Answer::Yes), "none"));
}

/// An edge of unknown error is open within 1 %.
#[test]
fn what_is_not_known_is_not_a_yes() {
    let unknown = Saw::new(vec![flutter(1000.0, 1100.0, 1.0, None)]);
    assert_eq!(
        said(&unknown.at(995.0)),
        (Some(Answer::AtRisk), "too_close")
    );
    assert_eq!(said(&unknown.at(985.0)), (Some(Answer::Yes), "none"));
    let failed = Saw {
        has_failed: true,
        ..Saw::new(Vec::new())
    };
    let verdict = failed.at(100.0);
    assert_eq!(said(&verdict), (Some(Answer::AtRisk), "not_determined"));
    assert!(verdict.allowed_to_rpm.is_none() && verdict.windows_rpm.is_empty());
    let passing = Saw {
        covered_to_rpm: 1200.0,
        ..Saw::new(Vec::new())
    };
    assert_eq!(
        said(&passing.at(1300.0)),
        (Some(Answer::AtRisk), "not_covered")
    );
    assert!(close(passing.at(1300.0).allowed_to_rpm, 1200.0));
    let free = Saw {
        is_held: false,
        critical_rpm: Vec::new(),
        ..Saw::new(Vec::new())
    };
    assert_eq!(said(&free.at(1000.0)), (Some(Answer::AtRisk), "held"));
}

#[test]
fn limits_that_no_speed_changes_allow_no_speed() {
    let saw = Saw::limited(LimitsFile {
        min_critical_rpm: Some(2100.0),
        ..LimitsFile::default()
    });
    let verdict = saw.at(1000.0);
    assert_eq!(said(&verdict), (Some(Answer::No), "min_critical"));
    assert_eq!(verdict.allowed_to_rpm, None);
    assert_eq!(
        verdict.headline(),
        "Can it run at 1000 rpm? NO: first critical speed of at least 2100 rpm: 2000 rpm"
    );
}

/// The speed of the headline can be typed: it is rounded down.
#[test]
fn the_headline_says_answer_reason_and_the_highest_speed() {
    let saw = Saw {
        critical_rpm: vec![2000.9],
        ..Saw::new(Vec::new())
    };
    let verdict = saw.at(1820.0);
    assert_eq!(
        verdict.headline(),
        "Can it run at 1820 rpm? AT RISK: 91 % of the first critical speed (2001 rpm); run it up to 1700 rpm (85 % of the first critical speed)"
    );
    assert_eq!(said(&saw.at(1700.0)), (Some(Answer::Yes), "none"));
    assert_eq!(verdict.in_table(), "at risk, margin");
    let unasked = saw.at(None);
    assert_eq!(said(&unasked), (None, "none"));
    assert_eq!(
        unasked.headline(),
        "It can run up to 1700 rpm (85 % of the first critical speed)"
    );
    let nothing = Saw {
        critical_rpm: Vec::new(),
        ..Saw::new(Vec::new())
    };
    assert!(nothing.at(3000.0).headline().starts_with("Can it run at 3000 rpm? YES: no motion grows; it can run up to 3183 rpm (rim speed of 100 m/s)"));
}

/// Growth of a slotted saw by Floquet multipliers at 1300 rpm and 1 % beside it, of which the second is the fastest.
fn by_floquet(growth_per_s: f64, error_per_s: f64) -> Saw {
    let at = |share: f64, growth_per_s: f64| FloquetGrowth {
        speed_rad_per_s: share * rad_per_s(1300.0),
        growth_per_s,
        error_per_s,
        coordinates: 48,
        steps: 600,
    };
    let beside = growth_per_s - 0.5;
    Saw {
        covered_to_rpm: 1200.0,
        floquet: Some(NearbyGrowth {
            at: [at(0.99, beside), at(1.0, growth_per_s), at(1.01, beside)],
        }),
        ..Saw::new(Vec::new())
    }
}

/// A slow growth with a large error beside a certain one of none leaves the answer open, and one that is certain decides.
#[test]
fn the_errors_of_all_multipliers_count() {
    let with = |growth: f64, error: f64| {
        let mut saw = by_floquet(0.0, 1e-3);
        let at = &mut saw.floquet.as_mut().unwrap().at[0];
        (at.growth_per_s, at.error_per_s) = (growth, error);
        saw.at(1300.0)
    };
    assert_eq!(said(&with(-0.1, 0.01)), (Some(Answer::Yes), "none"));
    assert_eq!(
        said(&with(-0.1, 0.5)),
        (Some(Answer::AtRisk), "not_covered")
    );
    let mut saw = by_floquet(0.5, 0.4);
    let at = &mut saw.floquet.as_mut().unwrap().at[0];
    (at.growth_per_s, at.error_per_s) = (0.4, 0.01);
    assert_eq!(said(&saw.at(1300.0)), (Some(Answer::No), "flutter"));
}

#[test]
fn multipliers_decide_where_slots_pass_guides() {
    for (growth, error, expected) in [
        (-1.0, 0.1, (Answer::Yes, "none")),
        (0.0, 0.1, (Answer::Yes, "none")),
        (0.1, 0.0, (Answer::AtRisk, "weak_flutter")),
        (0.2, 0.1, (Answer::AtRisk, "not_covered")),
        (0.3, 0.1, (Answer::AtRisk, "not_covered")),
        (0.4, 0.1, (Answer::No, "flutter")),
    ] {
        let saw = by_floquet(growth, error);
        let verdict = saw.at(1300.0);
        assert_eq!(said(&verdict), (Some(expected.0), expected.1), "{growth}");
        assert!(verdict.floquet.is_some());
        assert!(close(verdict.allowed_to_rpm, 1200.0));
        let is_window = verdict.windows_rpm.len() == 2;
        assert_eq!(is_window, expected.0 == Answer::Yes, "{growth}");
        // At other speeds nothing is known.
        let other = saw.at(1400.0);
        assert_eq!(said(&other), (Some(Answer::AtRisk), "not_covered"));
        assert!(other.floquet.is_none());
    }
    assert!(by_floquet(0.4, 0.1).at(1300.0).reason.starts_with(
        "a vibration grows by 0.4 ± 0.1 1/s at 1300 rpm while slots pass the guides, by Floquet multipliers"
    ));
}

/// A band of the axisymmetric blade from 1250 to 1350 rpm decides only where multipliers are too close to the threshold to call, and
/// their speeds are allowed inside it.
#[test]
fn multipliers_decide_inside_a_band() {
    for (growth, error, expected) in [
        (-1.0, 0.1, (Answer::Yes, "none")),
        (0.3, 0.1, (Answer::No, "flutter")),
        (0.4, 0.1, (Answer::No, "flutter")),
    ] {
        let saw = Saw {
            bands: vec![flutter(1250.0, 1350.0, 1.0, Some(1e-6))],
            ..by_floquet(growth, error)
        };
        let verdict = saw.at(1300.0);
        assert_eq!(said(&verdict), (Some(expected.0), expected.1), "{growth}");
        let windows = &verdict.windows_rpm;
        let is_inside = windows
            .iter()
            .any(|[from, to]| close(Some(*from), 1287.0) && close(Some(*to), 1313.0));
        assert_eq!(is_inside, expected.0 == Answer::Yes, "{windows:?}");
        assert_eq!(said(&saw.at(1345.0)), (Some(Answer::No), "flutter"));
    }
}
