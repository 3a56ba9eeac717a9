use super::super::sample::{busy_report, root_loci as sample_loci};
use super::*;
use crate::page::figure::layout::sheet;
use crate::page::figure::tidiness::texts;

fn report(loci: RootLoci) -> Report {
    let mut report = busy_report();
    report.root_loci = Some(loci);
    report
}

/// A band that extends to the end of the sweep, where the growth is far from zero.
fn cut_short() -> RootLoci {
    let mut entry = sample_loci(0.01);
    let kept = entry.rpm.iter().filter(|rpm| **rpm < 2264.0).count();
    entry.rpm.truncate(kept);
    for path in &mut entry.paths {
        path.growth_per_s.truncate(kept);
        path.frequency_hz.truncate(kept);
        path.krein_sign.truncate(kept);
    }
    entry.end_rpm = *entry.rpm.last().unwrap();
    entry
}

#[test]
fn nothing_but_computed_eigenvalues_is_drawn() {
    for entry in [sample_loci(-0.01), cut_short()] {
        let found = Paths::new(&entry).unwrap();
        let all = found.paths.iter().flatten();
        let known: Vec<[f64; 2]> = all
            .flat_map(|s| [found.in_plane(s), [s.rpm, s.hz]])
            .collect();
        let chart = chart(&report(entry)).unwrap();
        let items = chart.panels.iter().flat_map(|panel| &panel.items);
        let points: Vec<[f64; 2]> = items
            .filter_map(|item| match item {
                Item::Line(line) => Some(line.x.iter().zip(&line.y)),
                Item::Points(points) => Some(points.x.iter().zip(&points.y)),
                _ => None,
            })
            .flatten()
            .map(|(x, y)| [*x, *y])
            .filter(|[x, _]| !x.is_nan())
            .collect();
        assert!(points.iter().all(|point| known.contains(point)));
        assert!(known.iter().all(|point| points.contains(point)));
    }
}

#[test]
fn the_largest_growth_and_the_names_of_both_waves_are_written() {
    let drawn = sheet(&chart(&report(sample_loci(0.0))).unwrap());
    let written = texts(&drawn);
    for text in [
        "Root loci around the flutter onset at 2256 rpm",
        "(+) 4 diameters, backward",
        "(\u{2212}) 4 diameters, reflected",
        "Flutter from 2256 to 2267 rpm",
        "peak 2261 rpm, 0.53 1/s",
        "decaying (mirror image)",
    ] {
        assert!(written.contains(&text), "{text}");
    }
}

#[test]
fn labels_neither_overlap_nor_leave_the_sheet() {
    for drift in [0.0, -0.002, 0.002, -0.01, 0.01, -0.05, 0.05, 3.0] {
        let mut loci = sample_loci(drift);
        let _drawn = sheet(&chart(&report(loci.clone())).unwrap());
        for path in &mut loci.paths {
            path.name = "12 diameters, 3 circles, backward, or so ".repeat(4);
        }
        let mut report = report(loci);
        report.scene.name = "Sägeblatt <&> ".repeat(40);
        let _with_long_names = sheet(&chart(&report).unwrap());
    }
    let _drawn = sheet(&chart(&report(cut_short())).unwrap());
}

#[test]
fn numbers_that_are_not_finite_or_huge_are_not_drawn() {
    let mut odd = sample_loci(0.0);
    odd.paths[0].frequency_hz[3] = f64::NAN;
    odd.paths[1].growth_per_s[9] = f64::INFINITY;
    odd.rpm[5] = 1e200;
    let _drawn = sheet(&chart(&report(odd.clone())).unwrap());
    let without_end = RootLoci {
        end_rpm: f64::NAN,
        ..odd.clone()
    };
    assert!(chart(&report(without_end)).is_none());
    odd.paths.truncate(1);
    assert!(chart(&report(odd)).is_none());
}
