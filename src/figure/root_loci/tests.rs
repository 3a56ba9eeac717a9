use super::super::canvas::Mark;
use super::super::sample::{busy_report, root_loci as sample_loci};
use super::super::tidy::{assert_tidy, texts};
use super::*;

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
        let chart = Chart::new(&entry).unwrap();
        let drawn = sheet(&report(entry)).unwrap();
        let all = chart.paths.iter().flatten();
        let known: Vec<[f64; 2]> = all
            .flat_map(|s| [chart.in_plane(s), chart.over_speed(s)])
            .collect();
        let curves = drawn.marks().iter().filter_map(|mark| match mark {
            Mark::Line(points, stroke) if stroke.width == CURVE => Some(points),
            _ => None,
        });
        let curves: Vec<_> = curves.flatten().collect();
        assert_eq!(curves.len(), 2 * (known.len() - 4));
        assert!(curves.iter().all(|point| known.contains(point)));
    }
}

#[test]
fn the_largest_growth_and_the_speeds_of_all_ends_are_written() {
    let drawn = sheet(&report(sample_loci(0.0))).unwrap();
    let written = texts(&drawn);
    for text in [
        "Root loci around the flutter onset at 2256 rpm",
        &heading::of_saw("Guided blade, 864 mm", "idling"),
        "(+) 4 diameters, backward",
        "(\u{2212}) 4 diameters, reflected",
        "flutter 2256–2267",
        "peak 2261 rpm",
        "0.53 1/s",
        "2240 rpm",
        "2282 rpm",
    ] {
        assert!(written.iter().any(|(_, own)| *own == text), "{text}");
    }
}

#[test]
fn labels_neither_overlap_nor_leave_the_sheet() {
    for drift in [0.0, -0.002, 0.002, -0.01, 0.01, -0.05, 0.05, 3.0] {
        let mut loci = sample_loci(drift);
        assert_tidy(&sheet(&report(loci.clone())).unwrap());
        for path in &mut loci.paths {
            path.name = "12 diameters, 3 circles, backward, or so ".repeat(4);
        }
        let mut report = report(loci);
        report.scene.name = "Sägeblatt <&> ".repeat(40);
        assert_tidy(&sheet(&report).unwrap());
    }
    assert_tidy(&sheet(&report(cut_short())).unwrap());
}

#[test]
fn numbers_that_are_not_finite_or_huge_are_not_drawn() {
    let mut odd = sample_loci(0.0);
    odd.paths[0].frequency_hz[3] = f64::NAN;
    odd.paths[1].growth_per_s[9] = f64::INFINITY;
    odd.rpm[5] = 1e200;
    assert_tidy(&sheet(&report(odd.clone())).unwrap());
    let without_end = RootLoci {
        end_rpm: f64::NAN,
        ..odd.clone()
    };
    assert!(sheet(&report(without_end)).is_none());
    odd.paths.truncate(1);
    assert!(sheet(&report(odd)).is_none());
}
