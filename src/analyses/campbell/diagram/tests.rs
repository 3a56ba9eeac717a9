use super::super::sample::{band, busy_report, empty_report};
use super::*;
use crate::analyses::campbell::InstabilityKind;
use crate::analyses::campbell::{CriticalSpeed, InstabilityBand};
use crate::page::figure::Hue;
use crate::page::figure::canvas::Mark;
use crate::page::figure::items::{Item, Line};
use crate::page::figure::tidiness::{assert_unstruck, texts};

#[test]
fn every_critical_speed_is_labelled() {
    let svg = busy_report().campbell_svg().unwrap();
    for rpm in ["1531", "1552", "2091", "2130", "2560", "2608"] {
        assert!(svg.contains(rpm), "{rpm}");
    }
    assert!(svg.contains("flutter from 2392 rpm"));
    assert!(svg.contains("operating 1800"));
    assert!(svg.contains("read off a published table"));
}

#[test]
fn labels_neither_overlap_nor_leave_the_sheet() {
    let _drawn = sheet(&busy_report(), CampbellView::default());
    let mut crowded = busy_report();
    let extra = (0..60).map(|i| 1200.0 + 23.0 * f64::from(i));
    let entry = |rpm| CriticalSpeed {
        rpm,
        branch: None,
        name: String::new(),
        nodal_diameters: 2,
        nodal_circles: 0,
        estimated_relative_error: None,
    };
    crowded.critical_speeds.extend(extra.map(entry));
    let copies = crowded.campbell.branches.clone();
    crowded
        .campbell
        .branches
        .extend(copies.iter().cloned().chain(copies.clone()));
    crowded.scene.name = "Sägeblatt <&> ".repeat(40);
    for operating in [1200.0, 2500.0, 3000.0] {
        crowded.scene.operating_rpm = Some(operating);
        let drawn = sheet(&crowded, CampbellView::default());
        assert_unstruck(&drawn);
    }
}

/// Texts of a figure that begin with a given word.
fn starting_with(drawn: &Sheet, word: &str) -> Vec<String> {
    let own = texts(drawn)
        .into_iter()
        .filter(|text| text.starts_with(word));
    own.map(str::to_owned).collect()
}

#[test]
fn a_band_that_is_not_shaded_is_mentioned_in_a_note() {
    let mut report = busy_report();
    let mut weak = band(InstabilityKind::Flutter, 1552.0, 3000.0, 0.1, 3.0);
    weak.counted_rpm.clear();
    report.instabilities = vec![weak];
    let drawn = sheet(&report, CampbellView::default());
    assert!(starting_with(&drawn, "flutter").is_empty());
    let notes = starting_with(&drawn, "at the lines").join("");
    assert!(notes.contains("1 wide band that grows by less than 0.25 1/s: not shaded"));
    assert!(!notes.contains("without a label"), "{notes}");
}

/// The synthetic saw has two critical speeds each of n = 2, 3 and 4.
#[test]
fn critical_speeds_have_the_waves_that_stand_still() {
    let drawn = sheet(&busy_report(), CampbellView::default());
    let waves = starting_with(&drawn, "n = ");
    assert_eq!(waves, ["n = 2", "n = 3", "n = 4"]);
    // Of two joined labels the lower one may have more diameters.
    let mut tensioned = busy_report();
    tensioned.critical_speeds[0].nodal_diameters = 3;
    let with_tension = sheet(&tensioned, CampbellView::default());
    assert_eq!(starting_with(&with_tension, "n = ")[0], "n = 3 · 2");
    tensioned.critical_speeds[1].name = "2 (66 %) + 3 (34 %)".to_owned();
    let with_mixed_name = sheet(&tensioned, CampbellView::default());
    assert_eq!(starting_with(&with_mixed_name, "n = ")[0], "n = 3 · 2+3");
    assert_eq!(starting_with(&with_mixed_name, "nodal diameters").len(), 1);
}

/// The sweep has 193 bands within ten thousand rpm.
#[test]
fn very_many_bands_are_drawn_as_far_as_they_can_be_distinguished() {
    let mut report = busy_report();
    report.campbell.to_rpm = 10_000.0;
    let from = |k: usize| 1500.0 + 44.0 * k as f64;
    let new = |k: usize| band(InstabilityKind::Flutter, from(k), from(k) + 9.0, 1.0, 20.0);
    report.instabilities = (0..193).map(new).collect();
    let shown = |report: &Report, view| planned(report, view).speed.values();
    let all = CampbellView::default();
    assert_eq!(shown(&report, all), [0.0, from(40)]);
    let drawn = sheet(&report, all);
    let notes = starting_with(&drawn, "at the lines").join("");
    assert!(
        notes.contains("shown: 0 to 3260 of 0 to 10000 rpm"),
        "{notes}"
    );
    report.scene.operating_rpm = Some(5000.0);
    assert_eq!(shown(&report, all), [0.0, 5500.0]);
    let asked = CampbellView {
        from_rpm: Some(2000.0),
        to_rpm: Some(12_000.0),
        to_hz: Some(33.0),
    };
    assert_eq!(shown(&report, asked), [2000.0, 10_000.0]);
    assert_eq!(planned(&report, asked).frequency.values(), [0.0, 33.0]);
    let _drawn = sheet(&report, asked);
}

#[test]
fn a_saw_with_critical_speeds_is_not_called_stable_at_every_speed() {
    let mut report = busy_report();
    report.instabilities.clear();
    for branch in &mut report.campbell.branches {
        branch.growth_per_s.fill(0.0);
    }
    let drawn = sheet(&report, CampbellView::default());
    assert!(starting_with(&drawn, "no growth").is_empty());
    assert_eq!(starting_with(&drawn, "no vibration grows;").len(), 1);
    assert_unstruck(&drawn);
}

#[test]
fn svg_is_the_same_each_time_and_well_formed() {
    let mut report = busy_report();
    report.scene.name = "Säge <&> \"β\"\u{1} 鋸".to_owned();
    let svg = report.campbell_svg().unwrap();
    assert_eq!(svg, report.campbell_svg().unwrap());
    assert!(svg.starts_with("<svg width=\"1200\" height=\"918\""));
    assert!(svg.contains("Säge &lt;&amp;&gt; &quot;β&quot;  鋸"));
    assert!(!svg.contains("NaN") && !svg.contains('\u{1}'));
    for tag in ["svg", "text"] {
        let opened = svg.matches(&format!("<{tag} ")).count();
        assert_eq!(opened, svg.matches(&format!("</{tag}>")).count());
    }
}

#[test]
fn png_has_the_promised_size_and_is_the_same_each_time() {
    let bytes = busy_report().campbell_png().unwrap();
    let decoder = png::Decoder::new(std::io::Cursor::new(&bytes));
    let info = decoder.read_info().unwrap();
    assert_eq!((info.info().width, info.info().height), (WIDTH, HEIGHT));
    assert_eq!(bytes, busy_report().campbell_png().unwrap());
}

#[test]
fn an_empty_report_says_that_nothing_grows() {
    let report = empty_report("");
    let _drawn = sheet(&report, CampbellView::default());
    let svg = report.campbell_svg().unwrap();
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
    odd.campbell.branches[4].rpm.truncate(1);
    odd.campbell.branches[4].frequency_hz.truncate(1);
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
        let _drawn = sheet(&odd, CampbellView::default());
        assert!(!odd.campbell_svg().unwrap().contains("\"NaN"));
    }
}

#[test]
fn growth_is_drawn_within_the_bands_and_never_below_zero() {
    let report = busy_report();
    let chart = planned(&report, CampbellView::default());
    let axis = growth::axis(&chart, 50.0).unwrap();
    assert_eq!(axis.values()[0], 0.0);
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    growth::draw(&mut sheet, &chart, &axis);
    let curves: Vec<_> = sheet
        .marks()
        .iter()
        .filter_map(|mark| match mark {
            Mark::Line(points, stroke) if stroke.width > 1.0 => Some(points),
            _ => None,
        })
        .collect();
    assert_eq!(curves.len(), report.instabilities.len());
    let zero = axis.at(0.0);
    for (curve, band) in curves.iter().zip(&report.instabilities) {
        let ends = [band.from_rpm, band.to_rpm].map(|rpm| [chart.speed.at(rpm), zero]);
        assert_eq!([curve[0], curve[curve.len() - 1]], ends);
        assert!(curve.iter().all(|[_, y]| *y <= zero));
    }
}

/// Branch 1 flutters from 10 to 30 rpm while branch 2 diverges from 20 to 40: each is drawn in the colour and
/// between the edges of its own band.
#[test]
fn growth_is_drawn_in_the_band_of_its_branch_where_bands_overlap() {
    let mut report = busy_report();
    report.campbell.branches.truncate(2);
    for (k, growth) in [[0.0, 1.0, 1.0, 0.0, 0.0], [0.0, 0.0, 2.0, 2.0, 0.0]]
        .iter()
        .enumerate()
    {
        let branch = &mut report.campbell.branches[k];
        branch.branch = k + 1;
        branch.rpm = vec![5.0, 15.0, 25.0, 35.0, 45.0];
        branch.growth_per_s = growth.to_vec();
    }
    let bands = [
        (InstabilityKind::Flutter, 10.0, 30.0, 1),
        (InstabilityKind::Divergence, 20.0, 40.0, 2),
    ];
    let new = |(kind, from, to, branch)| InstabilityBand {
        branches: vec![branch],
        ..band(kind, from, to, 1.0, 1.0)
    };
    report.instabilities = bands.map(new).into();
    let data = chart(&report, false);
    let drawn: Vec<_> = data.panels[1]
        .items
        .iter()
        .filter_map(|item| match item {
            Item::Line(line) => Some((line.colour, line.x[0], line.x[line.x.len() - 1])),
            _ => None,
        })
        .collect();
    let expected = [(Hue::Flutter, 10.0, 30.0), (Hue::Divergence, 20.0, 40.0)];
    assert_eq!(drawn, expected);
}

/// Every sample of a branch is a point of one of its lines, at the frequency of the report.
#[test]
fn the_numbers_of_the_diagram_are_those_of_the_report() {
    let mut report = busy_report();
    for (k, branch) in report.campbell.branches.iter_mut().enumerate() {
        branch.branch = k + 1;
    }
    let data = chart(&report, true);
    let lines: Vec<&Line> = data.panels[0]
        .items
        .iter()
        .filter_map(|item| match item {
            Item::Line(line) => Some(line),
            _ => None,
        })
        .collect();
    for branch in &report.campbell.branches {
        let own = lines
            .iter()
            .filter(|line| line.branch == Some(branch.branch));
        let mut drawn: Vec<[f64; 2]> = own
            .flat_map(|line| line.x.iter().zip(&line.y).map(|(x, y)| [*x, *y]))
            .filter(|[x, _]| x.is_finite())
            .collect();
        drawn.sort_by(|a, b| a[0].total_cmp(&b[0]));
        drawn.dedup();
        let samples: Vec<[f64; 2]> = branch
            .rpm
            .iter()
            .zip(&branch.frequency_hz)
            .map(|(rpm, hz)| [*rpm, *hz])
            .collect();
        assert_eq!(drawn, samples);
    }
    assert!(lines.iter().all(|line| line.said.len() == line.x.len()));
    let kept = chart(&report, false);
    assert!(
        serde_json::to_string(&kept).unwrap().len() < serde_json::to_string(&data).unwrap().len()
    );
}

#[test]
fn the_certificate_is_written_and_violations_are_red() {
    let mut report = busy_report();
    let svg = report.campbell_svg().unwrap();
    assert!(svg.contains("Krein index matches at 567 of 567 speeds"));
    assert!(svg.contains("backward error below 2·10⁻⁸"));
    assert!(svg.contains("68 functions, critical speeds within 0.14 %"));
    let wrong = "Krein index does not match at 2 of 567 speeds, 1200.0 to 1300.0 rpm";
    report.certificate.krein_violations = 2;
    report.certificate.statement = wrong.to_owned();
    let _drawn = sheet(&report, CampbellView::default());
    let warned = report.campbell_svg().unwrap();
    assert!(warned.contains(wrong));
    assert!(warned.contains("fill=\"#C8102E\""));
    report.certificate.speeds_checked = 0;
    assert!(!report.campbell_svg().unwrap().contains("Krein"));
}
