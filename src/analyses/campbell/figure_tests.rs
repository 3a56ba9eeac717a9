//! Curves, names and labels in the figures of random saws agree with the reports.
//!
//! The samples of a diagram have three digits: a curve may exceed the largest growth of its band by 2 %, and a branch
//! may end 2 % below the frequency up to which the diagram is complete.

use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

use super::diagram::{self, curve};
use super::draws::{any_saw, first_critical, scene};
use super::root_loci;
use super::{BranchCurve, Report, RootLoci};
use crate::model::scene::{Accuracy, SceneFile, SweepFile, rpm};
use crate::page::figure::layout;
use crate::stability::Analysis;

const PEAK: f64 = 1.02;
const TOP: f64 = 0.98;

fn report(file: &SceneFile, reach: f64) -> Report {
    let mut file = file.clone();
    file.sweep = Some(SweepFile {
        from_rpm: 0.0,
        to_rpm: reach * rpm(first_critical(&file)),
    });
    file.accuracy = Accuracy::Draft;
    let scene = scene(&file);
    let analysis = Analysis::new(&scene).unwrap();
    analysis.report()
}

/// Speeds inside the sweep at which a branch begins or ends below the frequency up to which the diagram is
/// complete.
fn loose_ends(report: &Report, branch: &BranchCurve) -> Vec<f64> {
    let chart = &report.campbell;
    let sweep = [chart.from_rpm, chart.to_rpm];
    let last = branch.rpm.len() - 1;
    let ends = [0, last].map(|i| (branch.rpm[i], branch.frequency_hz[i]));
    let is_loose = |(rpm, hz): &(f64, f64)| {
        let inside = sweep.iter().all(|end| (rpm - end).abs() > 1e-6 * sweep[1]);
        inside && *hz < TOP * chart.complete_to_hz
    };
    ends.into_iter().filter(is_loose).map(|end| end.0).collect()
}

/// Largest step of a path between neighbouring speeds, relative to the length of the path.
fn largest_step(loci: &RootLoci) -> f64 {
    let share = |values: &Vec<f64>| {
        let ends = values.iter().fold([f64::INFINITY, 0.0], |[low, high], v| {
            [f64::min(low, *v), f64::max(high, *v)]
        });
        let steps = values.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        steps.fold(0.0, f64::max) / (ends[1] - ends[0]).max(1e-3)
    };
    let paths = loci.paths.iter().map(|path| share(&path.frequency_hz));
    paths.fold(0.0, f64::max)
}

/// Checks that a branch has the same name everywhere and that names of events are unique.
fn assert_one_name(report: &Report) {
    let branches = &report.campbell.branches;
    for (at, branch) in branches.iter().enumerate() {
        assert_eq!(branch.branch, at + 1);
        let number = format!("{}: ", at + 1);
        assert!(branch.label.starts_with(&number));
    }
    let name = |number: usize| branches[number - 1].name.clone();
    for mode in &report.modes_at_rest {
        let number = mode.branch.expect("the sweep begins at rest");
        assert_eq!(name(number), mode.name.clone());
        assert!((branches[number - 1].frequency_hz[0] / mode.frequency_hz - 1.0).abs() < 1e-9);
    }
    for critical in &report.critical_speeds {
        assert!(critical.branch.is_some(), "a branch comes down to zero");
        let diameters = critical.nodal_diameters;
        assert!(diameters > 1, "{critical:?}");
        assert!(
            critical.name.starts_with(&diameters.to_string()),
            "{critical:?}"
        );
    }
    for band in &report.instabilities {
        assert!(!band.branches.is_empty(), "{:?}", band);
        assert!(band.name.is_some() && !band.modes.is_empty(), "{band:?}");
    }
}

/// Random saws, the same in every run, and ends of their sweeps relative to the first critical speed. Failing cases
/// are not minimized, because each takes a second.
fn drawn_saws(count: usize) -> impl Iterator<Item = (SceneFile, f64)> {
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    let saw = (any_saw(), 1.3..2.2_f64);
    (0..count).map(move |_| saw.new_tree(&mut runner).unwrap().current())
}

#[test]
fn figures_of_random_saws_agree_with_their_reports() {
    for (case, (file, reach)) in drawn_saws(6).enumerate() {
        let report = report(&file, reach);
        for branch in &report.campbell.branches {
            let loose = loose_ends(&report, branch);
            assert!(
                loose.is_empty(),
                "{case}: {} ends at {loose:?}",
                branch.label
            );
        }
        for band in &report.instabilities {
            let curve = curve(&report, band);
            let top = curve
                .iter()
                .fold(0.0_f64, |top, [_, growth]| top.max(*growth));
            let share = top / band.peak_growth_per_s;
            assert!((0.9..=PEAK).contains(&share), "{case}: {share} of {band:?}");
        }
        assert_one_name(&report);
        let _drawn = diagram::sheet(&report, diagram::CampbellView::default());
        if let Some(loci) = &report.root_loci {
            let mut all = loci.paths.iter().flat_map(|path| &path.frequency_hz);
            assert!(all.all(|hz| *hz >= 0.0), "{case}");
            assert!(largest_step(loci) < 0.3, "{case}: {}", largest_step(loci));
            let chart = root_loci::chart(&report);
            chart.iter().for_each(|chart| drop(layout::sheet(chart)));
        }
    }
}
