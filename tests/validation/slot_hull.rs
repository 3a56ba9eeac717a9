//! Goal: above the first critical speed no motion of a slotted saw grows outside the hull of the bands with the lower branch, the mean
//! and the upper branch of split pairs.
//!
//! Source: Floquet multipliers of the blade of finite elements beside its guide, which share no equation of motion with the bands
//! (`slots_beside_guides.rs` compares them with another program).

use crate::common::table;
use crate::slots::{self, Row};
use sawflutter::analyses::verdict::Answer;
use sawflutter::model::plate::TurningBlade;
use sawflutter::model::scene::{Accuracy, GuideFile, Scene, SpeedRange, rad_per_s, rpm};
use sawflutter::stability::{Analysis, GuidedBlade, StabilityState};

const THRESHOLD_PER_S: f64 = 0.25;

/// The blade with slots beside a point, up to a speed.
fn saw(slots: (u32, f64), radius_m: f64, stiffness: f64, to_rpm: f64) -> Scene {
    let saw = slots::saw(Some(slots)).edited(|saw| {
        saw.guides = vec![GuideFile {
            radius_m,
            stiffness_n_per_m: stiffness,
            ..GuideFile::default()
        }];
        saw.accuracy = Accuracy::Draft;
        saw.operating_rpm = None;
        saw.flutter_threshold_per_s = THRESHOLD_PER_S;
    });
    let saw = saw.unwrap();
    saw.swept(SpeedRange::between_rpm(0.0, to_rpm)).unwrap()
}

/// Shares of the speeds above the first critical one that grow and that the hull contains, in so many steps.
fn shares(analysis: &Analysis, steps: u32) -> [f64; 2] {
    let saw = &analysis.scene;
    let plate = &analysis.model.plate;
    let blade = TurningBlade::of(&plate.blade).unwrap();
    let guided = GuidedBlade::new(&blade, saw, plate).unwrap();
    let hull = analysis.split_pairs.as_ref().unwrap().hull.clone().unwrap();
    let from = rad_per_s(analysis.first_critical_rpm().unwrap());
    let to = analysis.range_rad_per_s.to_rad_per_s;
    let [mut growing, mut open] = [0.0, 0.0];
    for step in 0..steps {
        let speed = from + (f64::from(step) + 0.5) / f64::from(steps) * (to - from);
        let found = guided.growth(speed).unwrap();
        let is_open = hull.iter().any(|range| range.contains(speed));
        let grows = found.growth_per_s - found.error_per_s >= THRESHOLD_PER_S;
        let guide = &saw.file().guides[0];
        assert!(
            is_open || !grows,
            "{} m, {} N/m, {} rpm: {found:?}",
            guide.radius_m,
            guide.stiffness_n_per_m,
            rpm(speed)
        );
        growing += f64::from(u8::from(grows));
        open += f64::from(u8::from(is_open));
    }
    [growing, open].map(|count| count / f64::from(steps))
}

/// The guides of the scans from which the hull was designed, beside four slots of 40 mm, and some beside deep ones.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn nothing_grows_outside_the_hull_above_the_first_critical_speed() {
    let four = [0.1, 0.13, 0.15, 0.185]
        .into_iter()
        .flat_map(|radius| [3e4, 2e5, 2e6].map(|stiffness| ((4, 0.04), radius, stiffness, 5400.0)));
    let deep = [(0.1, 2e5), (0.185, 3e4)];
    let deep = deep.map(|(radius, stiffness)| ((4, 0.07), radius, stiffness, 4600.0));
    let mut all = [0.0, 0.0];
    for (slots, radius, stiffness, to_rpm) in four.chain(deep) {
        let analysis = Analysis::new(&saw(slots, radius, stiffness, to_rpm)).unwrap();
        let [growing, open] = shares(&analysis, 24);
        println!("{slots:?} {radius} m, {stiffness} N/m: {growing:.2} grow, {open:.2} in the hull");
        all = [all[0] + growing, all[1] + open];
    }
    // A fifth of the speeds grow beside the guides of this list, and the hull leaves out some.
    println!("{all:?}");
    assert!(all[0] > 0.2 * 14.0 && all[1] < 14.0, "{all:?}");
}

/// Beside 200 N/mm at 130 mm motions grow from 4146 rpm on (`slots_floquet.csv`), and the hull begins at most 2 % before. Below it the saw
/// is stable; in it multipliers decide.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn the_hull_begins_before_the_onset() {
    let saw = saw((4, 0.04), 0.13, 2e5, 4600.0);
    let analysis = Analysis::new(&saw).unwrap();
    let hull = analysis.split_pairs.as_ref().unwrap().hull.clone().unwrap();
    let begins = rpm(hull[0].from_rad_per_s);
    assert!((4060.0..4146.0).contains(&begins), "{hull:?}");
    let state = |rpm: f64| analysis.verdict(rad_per_s(rpm)).state;
    assert_eq!(state(begins - 5.0), StabilityState::Stable);
    assert_ne!(state(begins + 5.0), StabilityState::Stable);
    for (rpm, grows) in [(4100.0, false), (4200.0, true)] {
        let asked = saw.edited(|saw| saw.operating_rpm = Some(rpm)).unwrap();
        let analysis = Analysis::new(&asked).unwrap();
        let report = analysis.report();
        let multipliers = report.verdict.floquet.as_ref().unwrap();
        let largest = multipliers.growth_per_s.iter().copied();
        let largest = largest.fold(f64::NEG_INFINITY, f64::max);
        assert_eq!(largest > THRESHOLD_PER_S, grows, "{rpm}: {multipliers:?}");
        let is_no = report.verdict.answer == Some(Answer::No);
        assert_eq!(is_no, grows, "{:?}", report.verdict);
    }
}

/// Both branches of a plate with cuts that turns (`slots_four_40mm.csv`), within the 1 % of the axisymmetric blade.
#[test]
fn critical_speeds_of_both_branches_are_listed() {
    let saw = slots::saw(Some((4, 0.04))).edited(|saw| {
        saw.accuracy = Accuracy::Draft;
        saw.operating_rpm = None;
    });
    let report = Analysis::new(&saw.unwrap()).unwrap().report();
    let pairs = report.split_pairs.as_ref().unwrap();
    assert_eq!(pairs.not_certain_rpm, None);
    let upper = |n: usize| {
        let name = format!("{n} diameters");
        let mut found = pairs.upper_critical_speeds.iter();
        found.find(|own| own.name == name).map(|own| own.rpm)
    };
    let lower = |n: usize| {
        let mut found = report.critical_speeds.iter();
        found
            .find(|own| own.nodal_diameters == n)
            .map(|own| own.rpm)
    };
    let end = report.campbell.to_rpm;
    let mut compared = 0;
    for row in table::<Row>("slots_four_40mm.csv") {
        let Some(expected) = row.critical_rpm.filter(|rpm| 1.01 * rpm < end) else {
            continue;
        };
        let listed = if row.branch == "high" {
            upper(row.n)
        } else {
            lower(row.n)
        };
        let found = listed.unwrap();
        assert!(
            (found / expected - 1.0).abs() < 0.01,
            "{} {}: {found}",
            row.n,
            row.branch
        );
        compared += 1;
    }
    assert!(compared >= 3, "{end}");
    // Only pairs with 2n a multiple of four are split.
    assert_eq!(upper(3), None);
}
