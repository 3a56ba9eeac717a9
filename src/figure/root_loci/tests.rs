use super::super::render;
use super::super::sample::{busy_report, root_loci as sample_loci};
use super::super::tidy::{assert_tidy, texts};
use super::*;
use crate::report::Report;
use std::f64::consts::TAU;

fn root_loci_png(report: &Report) -> Option<Vec<u8>> {
    sheet(report).map(|sheet| render::png(&sheet).unwrap())
}

fn root_loci_svg(report: &Report) -> Option<String> {
    sheet(report).map(|sheet| render::svg(&sheet).unwrap())
}

fn report() -> Report {
    let mut report = busy_report();
    report.root_loci = Some(sample_loci(0.0));
    report
}

fn drawn(report: &Report) -> Sheet {
    sheet(report).unwrap()
}

#[test]
fn nothing_is_drawn_where_there_is_nothing() {
    let mut report = busy_report();
    assert!(root_loci_png(&report).is_none());
    assert!(root_loci_svg(&report).is_none());
    let full = sample_loci(0.0);
    for cut in 0..5 {
        let mut loci = full.clone();
        match cut {
            0 => loci.rpm.clear(),
            1 => loci.paths.truncate(1),
            2 => loci.paths[1].growth_per_s.clear(),
            3 => loci.onset_rpm = f64::NAN,
            _ => loci.rpm.truncate(1),
        }
        report.root_loci = Some(loci);
        assert!(root_loci_svg(&report).is_none(), "{cut}");
    }
}

#[test]
fn speeds_signs_and_modes_are_named() {
    let svg = root_loci_svg(&report()).unwrap();
    for text in [
        "Root loci around the flutter onset at 2256 rpm",
        "Guided blade, 864 mm",
        "(+) 4 diameters, backward",
        "(\u{2212}) 4 diameters, reflected",
        "onset 2256 rpm",
        "peak 2261 rpm",
        "end 2267 rpm",
        "2240 rpm",
        "2282 rpm",
        "growing",
        "0.53 1/s",
    ] {
        assert!(svg.contains(text), "{text}");
    }
}

#[test]
fn paths_meet_on_the_imaginary_axis_and_leave_it_at_right_angles() {
    let loci = Loci::new(&sample_loci(-0.01), false).unwrap();
    assert!(loci.merge);
    assert_eq!((loci.onset.growth, loci.end.growth), (0.0, 0.0));
    assert!((loci.peak.growth - 0.53).abs() < 0.005);
    for track in &loci.tracks {
        let in_band = matches!(track.look, Look::Growing | Look::Decaying);
        for s in &track.samples {
            assert!(in_band || s.growth == 0.0);
        }
        if in_band {
            let [a, b] = [track.samples[0], track.samples[1]];
            assert!(((b.hz - a.hz) * TAU).abs() < 0.05 * (b.growth - a.growth).abs());
        }
    }
}

#[test]
fn the_curve_goes_through_every_sample() {
    let entry = sample_loci(-0.01);
    let loci = Loci::new(&entry, false).unwrap();
    for (i, &rpm) in entry.rpm.iter().enumerate() {
        for path in &entry.paths {
            let [growth, hz] = [path.growth_per_s[i], path.frequency_hz[i]];
            let near = loci.samples().any(|s| {
                (s.rpm - rpm).abs() < 1.0 && (s.hz - hz).abs() < 0.02 && {
                    (s.growth - growth).abs() < 0.05
                }
            });
            assert!(near, "{rpm}: {growth} {hz}");
        }
    }
}

#[test]
fn labels_neither_overlap_nor_leave_the_sheet() {
    for drift in [0.0, -0.002, 0.002, -0.01, 0.01, -0.05, 0.05, 3.0] {
        let mut report = report();
        report.scene.name = "Sägeblatt <&> ".repeat(40);
        report.root_loci = Some(sample_loci(drift));
        assert_tidy(&drawn(&report));
        for path in &mut report.root_loci.as_mut().unwrap().paths {
            path.name = "12 diameters, 3 circles, backward, or so ".repeat(4);
            path.growth_per_s.iter_mut().for_each(|g| *g -= 0.1);
        }
        report.terms = vec!["guide damping C".to_owned()];
        assert_tidy(&drawn(&report));
    }
}

#[test]
fn damped_paths_are_drawn_as_they_are() {
    let mut report = report();
    for path in &mut report.root_loci.as_mut().unwrap().paths {
        path.growth_per_s.iter_mut().for_each(|g| *g -= 0.1);
        path.krein_sign.fill(0);
    }
    report.terms = vec!["guide damping C".to_owned()];
    let svg = root_loci_svg(&report).unwrap();
    assert!(svg.contains("without merging") && !svg.contains("mirror"));
}

#[test]
fn few_odd_and_huge_numbers_are_drawn_without_complaint() {
    let mut odd = report();
    let loci = odd.root_loci.as_mut().unwrap();
    loci.paths[0].frequency_hz[3] = f64::NAN;
    loci.paths[1].growth_per_s[9] = f64::INFINITY;
    loci.paths[1].krein_sign.truncate(2);
    loci.rpm[5] = 0.0;
    assert_tidy(&drawn(&odd));
    let loci = odd.root_loci.as_mut().unwrap();
    for list in [&mut loci.paths[0].frequency_hz, &mut loci.rpm] {
        list.iter_mut().for_each(|value| *value *= 1e200);
    }
    loci.onset_rpm *= 1e200;
    loci.end_rpm *= 1e200;
    if let Some(svg) = root_loci_svg(&odd) {
        assert!(!svg.contains("NaN"));
    }
    let mut inside = report();
    let loci = inside.root_loci.as_mut().unwrap();
    (loci.onset_rpm, loci.end_rpm) = (2000.0, 3000.0);
    assert_tidy(&drawn(&inside));
}

#[test]
fn pictures_are_the_same_each_time() {
    let report = report();
    assert_eq!(root_loci_svg(&report), root_loci_svg(&report));
    let bytes = root_loci_png(&report).unwrap();
    let decoder = png::Decoder::new(std::io::Cursor::new(&bytes));
    let info = decoder.read_info().unwrap();
    assert_eq!((info.info().width, info.info().height), (WIDTH, HEIGHT));
    assert_eq!(Some(bytes), root_loci_png(&report));
    assert!(!texts(&drawn(&report)).is_empty());
}

#[test]
fn a_band_that_is_off_a_little_does_not_look_damped() {
    let mut entry = sample_loci(-0.01);
    entry.onset_rpm += 0.5;
    entry.end_rpm -= 0.5;
    let loci = Loci::new(&entry, false).unwrap();
    assert!((loci.peak.growth - 0.53).abs() < 0.01);
}
