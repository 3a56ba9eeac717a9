//! Limits and results of a check, each in its own row over a common axis of speeds.

use super::axis::{Axis, SPEED, draw_named};
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::key::Key;
use super::style::{
    ALARM, BETWEEN_FACTS, CURVE, Colour, DIVERGENCE_SHADE, FINE_DASH, FLUTTER_SHADE, FORWARD, GRID,
    HAIRLINE, INK, LABEL_SIZE, MARGIN, QUIET, STRONG_CURVE, shorten_label, tint,
};
use super::{bands, heading};
use crate::analyses::check::{CheckReport, Criterion};

const WIDTH: u32 = 1200;
const LEFT: f64 = 372.0;
const RIGHT: f64 = 1160.0;
const TOP: f64 = 96.0;
const ROW: f64 = 66.0;
/// Height below the rows for the axis, its name and the key.
const BELOW: f64 = 92.0;
const PASS: Colour = FORWARD;

pub fn sheet(report: &CheckReport) -> Sheet {
    let rows = 2 + report.criteria.len();
    let bottom = TOP + ROW * rows as f64;
    let mut sheet = Sheet::new(WIDTH, (bottom + BELOW) as u32);
    let verdict = if report.passed { "passed" } else { "failed" };
    let title = format!("{}: check {verdict}", report.scene.name);
    heading::draw(&mut sheet, &title, &facts(report));
    let speed = Axis::linear([0.0, last_shown_rpm(report)], [LEFT, RIGHT]);
    draw_saw(&mut sheet, report, &speed);
    for (k, criterion) in report.criteria.iter().enumerate() {
        draw_criterion(&mut sheet, criterion, &speed, row(k + 1));
    }
    draw_stiffness(&mut sheet, report, &speed, row(rows - 1));
    draw_end_of_sweep(&mut sheet, report, &speed, bottom);
    draw_operating(&mut sheet, report, &speed, bottom);
    draw_named(&mut sheet, &speed, bottom, SPEED);
    draw_key(&mut sheet, bottom + BELOW - 22.0);
    sheet
}

/// End of the axis in rpm. The axis includes the sweep, every limit and every result; the lowest critical speed may
/// be beyond the sweep.
fn last_shown_rpm(report: &CheckReport) -> f64 {
    let of_criterion = |c: &Criterion| c.asked_rpm.max(c.found_rpm.unwrap_or(0.0));
    let criteria = report.criteria.iter().map(of_criterion);
    let marks = criteria.chain([report.operating_rpm]).fold(0.0, f64::max);
    report.to_rpm.max(1.03 * marks)
}

/// Draws the operating speed through all rows, with its name.
fn draw_operating(sheet: &mut Sheet, report: &CheckReport, speed: &Axis, bottom: f64) {
    let x = speed.at(report.operating_rpm);
    sheet.line([[x, TOP], [x, bottom]], Stroke::solid(INK, HAIRLINE));
    let letters = Lettering::regular(LABEL_SIZE, INK, Anchor::Middle);
    let text = format!("operating {:.0}", report.operating_rpm);
    sheet.text([x, TOP - 6.0], letters, &text);
}

/// Draws the end of the sweep, beyond which no band is searched for, if it is within the axis.
fn draw_end_of_sweep(sheet: &mut Sheet, report: &CheckReport, speed: &Axis, bottom: f64) {
    if report.to_rpm >= speed.values()[1] {
        return;
    }
    let x = speed.at(report.to_rpm);
    let dashed = Stroke::dashed(QUIET, HAIRLINE, FINE_DASH);
    sheet.line([[x, TOP - 16.0], [x, bottom]], dashed);
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::End);
    // The text is above the name of the operating speed.
    sheet.text(
        [x.max(LEFT + 90.0), TOP - 20.0],
        letters,
        "end of the sweep",
    );
}

/// Frame of the row with the number `k`, from 0 on.
fn row(k: usize) -> Frame {
    Frame {
        left: LEFT,
        top: TOP + ROW * k as f64,
        right: RIGHT,
        bottom: TOP + ROW * (k + 1) as f64,
    }
}

fn facts(report: &CheckReport) -> String {
    let unusual =
        (!report.unusual_numbers.is_empty()).then(|| "with numbers that no saw has".into());
    let facts = [
        report.condition.clone(),
        format!("operating speed {:.0} rpm", report.operating_rpm),
        format!("margin {:.0} %", 100.0 * report.margin),
        report.rim_stiffness_in_words(),
    ];
    let all: Vec<String> = unusual.into_iter().chain(facts).collect();
    all.join(BETWEEN_FACTS)
}

/// Draws all bands and critical speeds of the saw in the first row.
fn draw_saw(sheet: &mut Sheet, report: &CheckReport, speed: &Axis) {
    let frame = row(0);
    bands::shade(sheet, speed, report.instabilities.iter(), &[frame]);
    for x in report.critical_speeds_rpm.iter().map(|rpm| speed.at(*rpm)) {
        sheet.vertical(x, &frame, Stroke::solid(QUIET, HAIRLINE));
        sheet.disc([x, frame.centre()[1]], 3.5, INK);
    }
    let (critical, bands) = (report.critical_speeds_rpm.len(), report.instabilities.len());
    let found = match (critical, bands) {
        (0, 0) => format!("no critical speed, no band up to {:.0} rpm", report.to_rpm),
        (_, 0) => "critical speeds, no band".to_owned(),
        (0, _) => "bands, no critical speed".to_owned(),
        _ => "critical speeds and bands".to_owned(),
    };
    name(sheet, frame, "the saw", &found, QUIET);
}

/// Writes name and result of a row.
fn name(sheet: &mut Sheet, frame: Frame, above: &str, below: &str, colour: Colour) {
    let room = LEFT - 2.0 * MARGIN;
    let [_, middle] = frame.centre();
    for (text, baseline, colour) in [(above, middle - 4.0, INK), (below, middle + 14.0, colour)] {
        let letters = Lettering::regular(LABEL_SIZE, colour, Anchor::Start);
        sheet.text([MARGIN, baseline], letters, &shorten_label(text, room));
    }
    let line = [[MARGIN, frame.bottom], [RIGHT, frame.bottom]];
    sheet.line(line, Stroke::solid(GRID, HAIRLINE));
}

/// Draws the limit as a vertical line, the result as a disc, and the difference as a bar.
fn draw_criterion(sheet: &mut Sheet, criterion: &Criterion, speed: &Axis, frame: Frame) {
    let (colour, word) = match criterion.passed {
        true => (PASS, "PASS"),
        false => (ALARM, "FAIL"),
    };
    let found = criterion.found_rpm;
    // The criterion `operating`, on a band at the operating speed, has no limit from which a distance could
    // be drawn.
    let is_limit = criterion.key != "operating";
    let above = format!("{word} {}", criterion.name);
    name(sheet, frame, &above, &criterion.finding, colour);
    let [_, middle] = frame.centre();
    let asked = speed.at(criterion.asked_rpm);
    let unreached = if is_limit { RIGHT } else { asked };
    let end = found.map_or(unreached, |rpm| speed.at(rpm));
    let bar = Frame {
        left: asked.min(end),
        top: middle - 7.0,
        right: asked.max(end),
        bottom: middle + 7.0,
    };
    sheet.fill(bar, tint(colour, 0.35));
    let upright = [[asked, middle - 16.0], [asked, middle + 16.0]];
    sheet.line(upright, Stroke::solid(INK, STRONG_CURVE));
    if found.is_some() {
        sheet.disc([end, middle], 6.0, colour);
    } else if !is_limit {
        let letters = Lettering::regular(LABEL_SIZE, colour, Anchor::Start);
        sheet.text([asked + 9.0, middle + 4.0], letters, "none");
    }
}

/// Draws the stiffness of the rim over the speed, from zero at the foot of the row to its largest value.
fn draw_stiffness(sheet: &mut Sheet, report: &CheckReport, speed: &Axis, frame: Frame) {
    let curve = &report.rim_stiffness;
    let largest = curve.n_per_m.iter().fold(0.0_f64, |top, k| top.max(*k));
    let said = match largest > 0.0 {
        true => format!(
            "up to {:.1} N/mm, zero at the critical speed",
            1e-3 * largest
        ),
        false => "none: nothing holds the blade".to_owned(),
    };
    name(sheet, frame, "lateral stiffness of the rim", &said, QUIET);
    let height = frame.bottom - frame.top - 16.0;
    let points = curve.rpm.iter().zip(&curve.n_per_m);
    let places = points.map(|(rpm, k)| {
        let share = (k / largest).clamp(0.0, 1.0);
        [speed.at(*rpm), frame.bottom - height * share]
    });
    let places: Vec<[f64; 2]> = places.collect();
    if largest > 0.0 {
        sheet.line(places, Stroke::solid(INK, CURVE));
    }
}

fn draw_key(sheet: &mut Sheet, baseline: f64) {
    Key::new(sheet, MARGIN, baseline)
        .shade(DIVERGENCE_SHADE)
        .word("divergence")
        .shade(FLUTTER_SHADE)
        .word("flutter")
        .upright(4.0, 8.0, Stroke::solid(INK, STRONG_CURVE))
        .word("limit")
        .dot(12.0, 6.0, PASS)
        .word("result, with margin")
        .dot(12.0, 6.0, ALARM)
        .word("result, with shortfall");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analyses::check::{Limits, check};
    use crate::figure::canvas::Mark;
    use crate::figure::tidy::{assert_tidy, texts};
    use crate::scene::{Accuracy, Scene, SweepFile, rad_per_s};

    #[test]
    fn limits_that_are_kept_and_limits_that_are_broken_are_distinguished() {
        let paper = Scene::paper();
        let scene = paper.edited(|saw| saw.accuracy = Accuracy::Draft).unwrap();
        let limits = Limits {
            min_flutter_rad_per_s: Some(rad_per_s(2800.0)),
            min_critical_rad_per_s: Some(rad_per_s(1500.0)),
            ..Limits::at(rad_per_s(1250.0))
        };
        let sheet = sheet(&check(&scene, &limits).unwrap());
        assert_tidy(&sheet);
        let said: Vec<&str> = texts(&sheet).into_iter().map(|(_, text)| text).collect();
        let with = |start: &str| said.iter().filter(|text| text.starts_with(start)).count();
        assert_eq!((with("PASS "), with("FAIL ")), (4, 1), "{said:?}");
        assert_eq!(with("operating 1250"), 1, "{said:?}");
        assert!(said.contains(&"none"), "{said:?}");
    }

    /// The lowest critical speed of this saw lies beyond its sweep.
    #[test]
    fn a_speed_found_beyond_the_sweep_is_on_the_axis() {
        let scene = Scene::paper().edited(|file| {
            file.accuracy = Accuracy::Draft;
            file.sweep = Some(SweepFile {
                from_rpm: 0.0,
                to_rpm: 1400.0,
            });
        });
        let scene = scene.unwrap();
        let limits = Limits::at(rad_per_s(1250.0));
        let report = check(&scene, &limits).unwrap();
        let found = report.criteria.iter().filter_map(|c| c.found_rpm);
        let highest = found.fold(0.0, f64::max);
        assert!(highest > report.to_rpm, "{highest}");
        let sheet = sheet(&report);
        assert_tidy(&sheet);
        let discs = sheet.marks().iter().filter_map(|mark| match mark {
            Mark::Disc(centre, radius, _) if *radius == 6.0 => Some(centre[0]),
            _ => None,
        });
        let places: Vec<f64> = discs.filter(|x| *x > LEFT).collect();
        assert!(!places.is_empty());
        assert!(places.iter().all(|x| *x <= RIGHT), "{places:?}");
        let said = texts(&sheet);
        assert!(said.iter().any(|(_, text)| *text == "end of the sweep"));
    }
}
