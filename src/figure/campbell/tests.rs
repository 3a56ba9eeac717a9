//! The data are made up: waves ω² = ω₀² + sΩ² on the blade, seen from space.

use super::super::canvas::{Frame, Mark, text_frame};
use super::*;
use crate::report::{
    AccuracyEntry, BranchEntry, CampbellEntry, CertificateEntry, CriticalSpeedEntry, Direction,
    InstabilityEntry,
};
use crate::scene::{
    Accuracy, BladeFile, GuideFile, Material, Measured, MeasuredRow, Mount, SceneFile,
};

/// Name and facts of a blade of 864 mm, nothing found out about it.
fn empty_report(name: &str) -> Report {
    let material = Material {
        youngs_modulus_pa: 210e9,
        poisson_ratio: 0.3,
        density_kg_per_m3: 7850.0,
    };
    let scene = SceneFile {
        name: name.to_owned(),
        notes: Vec::new(),
        blade: BladeFile {
            outer_diameter_m: 0.864,
            inner_diameter_m: 0.15,
            thickness_m: 0.0023,
            teeth: None,
            material,
        },
        mount: Mount::Spline {},
        guides: Vec::new(),
        damping: None,
        operating_rpm: None,
        sweep: None,
        accuracy: Accuracy::Draft,
        flutter_threshold_per_s: 0.25,
        measured: None,
    };
    Report {
        sawflutter: "0".to_owned(),
        scene,
        terms: Vec::new(),
        modes_at_rest: Vec::new(),
        critical_speeds: Vec::new(),
        instabilities: Vec::new(),
        flutter_speed_rpm: None,
        first_merge_rpm: None,
        flutter_threshold_per_s: 0.25,
        operating: None,
        accuracy: AccuracyEntry {
            name: Accuracy::Draft,
            max_diameters: 8,
            radial_functions: 4,
            degrees_of_freedom: 68,
            estimated_relative_error: None,
        },
        certificate: CertificateEntry {
            speeds_checked: 0,
            krein_violations: 0,
            max_backward_error: 0.0,
        },
        campbell: CampbellEntry {
            from_rpm: 0.0,
            to_rpm: 0.0,
            complete_to_hz: 0.0,
            branches: Vec::new(),
        },
        warnings: Vec::new(),
    }
}

/// A branch of `diameters`, at rest `rest_hz`, whose backward wave stands still
/// at `critical_rpm`.
fn branch(
    diameters: usize,
    direction: Direction,
    rest_hz: f64,
    critical_rpm: f64,
    rpm: &[f64],
) -> BranchEntry {
    let n = diameters as f64;
    let turns = critical_rpm / 60.0;
    let stiffening = n * n - (rest_hz / turns).powi(2);
    let body = |rpm: &f64| (rest_hz.powi(2) + stiffening * (rpm / 60.0).powi(2)).sqrt();
    let sign = match direction {
        Direction::Forward => 1.0,
        Direction::Standing => 0.0,
        _ => -1.0,
    };
    let seen: Vec<f64> = rpm.iter().map(|r| body(r) + sign * n * r / 60.0).collect();
    BranchEntry {
        name: String::new(),
        nodal_diameters: diameters,
        nodal_circles: 0,
        direction,
        rpm: rpm.to_vec(),
        frequency_hz: seen.iter().map(|hz| hz.abs()).collect(),
        body_frequency_hz: rpm.iter().map(body).collect(),
        growth_per_s: vec![0.0; rpm.len()],
        krein_sign: seen
            .iter()
            .map(|hz| if *hz < 0.0 { -1 } else { 1 })
            .collect(),
        dominant_harmonics: vec![[diameters, 0]; rpm.len()],
    }
}

fn band(kind: InstabilityKind, from: f64, to: f64, growth: f64, hz: f64) -> InstabilityEntry {
    InstabilityEntry {
        kind,
        from_rpm: from,
        to_rpm: to,
        closed: true,
        peak_rpm: (from + to) / 2.0,
        peak_growth_per_s: growth,
        frequency_hz: hz,
        modes: Vec::new(),
    }
}

/// A blade with everything that the figure knows to show.
fn busy_report() -> Report {
    use Direction::{Backward, Forward, Standing};
    use InstabilityKind::{Divergence, Flutter};
    let mut report = empty_report("Guided blade, 864 mm");
    let bands = [
        (Divergence, 1530.7, 1551.5, 15.0, 0.0),
        (Flutter, 1902.5, 1905.5, 0.1, 6.0),
        (Divergence, 2091.0, 2129.6, 22.0, 0.0),
        (Flutter, 2258.0, 2263.0, 0.5, 4.1),
        (Flutter, 2392.0, 2404.0, 0.6, 8.0),
        (Divergence, 2560.3, 2607.5, 30.0, 0.0),
        (Flutter, 2702.0, 2706.0, 0.4, 6.0),
        (Flutter, 2847.0, 2849.0, 0.2, 13.0),
        (Flutter, 2872.0, 2900.0, 2.7, 9.0),
    ];
    report.instabilities = bands
        .map(|(k, from, to, g, hz)| band(k, from, to, g, hz))
        .to_vec();
    let critical = [1530.7, 1551.5, 2091.0, 2129.6, 2560.3, 2607.5];
    let entry = |(i, &rpm): (usize, &f64)| CriticalSpeedEntry {
        rpm,
        nodal_diameters: 2 + i / 2,
        nodal_circles: 0,
    };
    report.critical_speeds = critical.iter().enumerate().map(entry).collect();
    report.flutter_speed_rpm = Some(2392.0);

    let rpm: Vec<f64> = (0..=1000).map(|i| 3.0 * f64::from(i)).collect();
    report.campbell = CampbellEntry {
        from_rpm: 0.0,
        to_rpm: 3000.0,
        complete_to_hz: 160.0,
        branches: vec![
            branch(1, Backward, 7.68, 9000.0, &rpm),
            branch(1, Forward, 7.9, 9000.0, &rpm),
            branch(0, Standing, 8.3, 9000.0, &rpm),
            branch(2, Backward, 13.14, 1541.0, &rpm),
            branch(2, Forward, 13.9, 1541.0, &rpm),
            branch(3, Backward, 25.56, 2110.0, &rpm),
            branch(3, Forward, 25.7, 2110.0, &rpm),
            branch(4, Backward, 42.83, 2584.0, &rpm),
            branch(4, Forward, 43.0, 2584.0, &rpm),
            branch(1, Standing, 46.0, 9000.0, &rpm),
            branch(5, Backward, 67.0, 3020.0, &rpm),
            branch(5, Forward, 68.0, 3020.0, &rpm),
            branch(6, Backward, 70.5, 3300.0, &rpm),
        ],
    };
    for entry in &mut report.campbell.branches[3..8] {
        let standstill = [0, 0, 1541, 2110, 2584][entry.nodal_diameters];
        for i in 0..entry.rpm.len() {
            let near = report.instabilities.iter().find(|band| {
                let half = (band.to_rpm - band.from_rpm) / 2.0;
                (entry.rpm[i] - band.peak_rpm).abs() < half
                    && (band.peak_rpm - f64::from(standstill)).abs() < 10.0
            });
            let Some(band) = near.filter(|_| entry.direction == Backward) else {
                continue;
            };
            let half = (band.to_rpm - band.from_rpm) / 2.0;
            let off = (entry.rpm[i] - band.peak_rpm) / half;
            entry.frequency_hz[i] = 0.0;
            entry.growth_per_s[i] = band.peak_growth_per_s * (1.0 - off * off).sqrt();
            entry.krein_sign[i] = 0;
        }
    }
    report.scene.operating_rpm = Some(1800.0);
    let guide = GuideFile {
        radius_m: 0.4,
        angle_deg: 10.0,
        radial_length_m: 0.1,
        tangential_length_m: 0.1,
        stiffness_n_per_m: 1e5,
        damping_n_s_per_m: 0.0,
    };
    report.scene.guides = vec![guide; 2];
    let rows = [
        (0.0, vec![9.0, 10.5, 26.0, 43.0]),
        (1000.0, vec![3.0, 13.5, 26.5, 40.5]),
        (1750.0, vec![0.0, 4.0, 13.5, 26.0]),
        (2500.0, vec![9.0, 5.0, 0.0, 5.0]),
    ];
    report.scene.measured = Some(Measured {
        source: "read off a published table".to_owned(),
        rows: rows
            .map(|(rpm, frequencies_hz)| MeasuredRow {
                rpm,
                frequencies_hz,
            })
            .to_vec(),
    });
    report
}

fn texts(sheet: &Sheet) -> Vec<(Frame, &str)> {
    let text = |mark| match mark {
        &Mark::Text(at, letters, ref text) => Some((text_frame(at, &letters, text), text.as_str())),
        _ => None,
    };
    sheet.marks().iter().filter_map(text).collect()
}

fn assert_tidy(sheet: &Sheet) {
    let texts = texts(sheet);
    for (i, (frame, text)) in texts.iter().enumerate() {
        let inside = frame.left >= 0.0
            && frame.top >= 0.0
            && frame.right <= f64::from(WIDTH)
            && frame.bottom <= f64::from(HEIGHT);
        assert!(inside, "'{text}' is cut off: {frame:?}");
        for (other, second) in &texts[..i] {
            assert!(!frame.overlaps(other), "'{text}' lies on '{second}'");
        }
    }
}

#[test]
fn every_critical_speed_is_labelled() {
    let svg = campbell_svg(&busy_report()).unwrap();
    for rpm in ["1531", "1552", "2091", "2130", "2560", "2608"] {
        assert!(svg.contains(rpm), "{rpm}");
    }
    assert!(svg.contains("flutter from 2392 rpm"));
    assert!(svg.contains("operating 1800"));
    assert!(svg.contains("read off a published table"));
}

#[test]
fn labels_neither_overlap_nor_leave_the_sheet() {
    assert_tidy(&campbell(&busy_report()));
    let mut crowded = busy_report();
    let extra = (0..60).map(|i| 1200.0 + 23.0 * f64::from(i));
    let entry = |rpm| CriticalSpeedEntry {
        rpm,
        nodal_diameters: 2,
        nodal_circles: 0,
    };
    crowded.critical_speeds.extend(extra.map(entry));
    let copies = crowded.campbell.branches.clone();
    crowded
        .campbell
        .branches
        .extend(copies.iter().cloned().chain(copies.clone()));
    crowded.scene.name = "Sägeblatt <&> ".repeat(40);
    crowded.scene.operating_rpm = Some(3000.0);
    assert_tidy(&campbell(&crowded));
}

#[test]
fn svg_is_the_same_each_time_and_well_formed() {
    let mut report = busy_report();
    report.scene.name = "Säge <&> \"β\"\u{1} 鋸".to_owned();
    let svg = campbell_svg(&report).unwrap();
    assert_eq!(svg, campbell_svg(&report).unwrap());
    assert!(svg.starts_with("<svg width=\"1200\" height=\"900\""));
    assert!(svg.contains("Säge &lt;&amp;&gt; &quot;β&quot; 鋸"));
    assert!(!svg.contains("NaN") && !svg.contains('\u{1}'));
    for tag in ["svg", "text"] {
        let opened = svg.matches(&format!("<{tag} ")).count();
        assert_eq!(opened, svg.matches(&format!("</{tag}>")).count());
    }
}

#[test]
fn png_has_the_promised_size_and_is_the_same_each_time() {
    let bytes = campbell_png(&busy_report()).unwrap();
    let decoder = png::Decoder::new(std::io::Cursor::new(&bytes));
    let info = decoder.read_info().unwrap();
    assert_eq!((info.info().width, info.info().height), (WIDTH, HEIGHT));
    assert_eq!(bytes, campbell_png(&busy_report()).unwrap());
}

#[test]
fn an_empty_report_says_that_nothing_grows() {
    let report = empty_report("");
    assert_tidy(&campbell(&report));
    let svg = campbell_svg(&report).unwrap();
    assert!(svg.contains("no growth: stable at every speed shown"));
    assert!(svg.contains("no critical speed"));
}

#[test]
fn odd_input_is_drawn_without_complaint() {
    let mut odd = busy_report();
    odd.campbell.branches[0].rpm.truncate(1);
    odd.campbell.branches[1].frequency_hz.clear();
    odd.campbell.branches[2].frequency_hz[7] = f64::NAN;
    odd.campbell.branches[3].growth_per_s[500] = f64::INFINITY;
    odd.instabilities[0].from_rpm = f64::NAN;
    odd.instabilities[1].peak_growth_per_s = f64::NAN;
    odd.critical_speeds[0].rpm = f64::NAN;
    odd.scene.operating_rpm = Some(f64::INFINITY);
    for (from, to, complete) in [
        (0.0, 3000.0, 100.0),
        (1500.0, 1500.0, 100.0),
        (3000.0, 0.0, 0.0),
        (f64::NAN, f64::INFINITY, f64::NAN),
        (-1e300, 1e300, 1e-300),
    ] {
        odd.campbell.from_rpm = from;
        odd.campbell.to_rpm = to;
        odd.campbell.complete_to_hz = complete;
        assert_tidy(&campbell(&odd));
        assert!(!campbell_svg(&odd).unwrap().contains("\"NaN"));
    }
}
