//! Distributions of the lowest critical speed and of the flutter speed of many saws.

use super::axis::{Axis, SPEED, draw_horizontal, draw_vertical, name_below};
use super::canvas::{Anchor, Frame, Lettering, Sheet, Stroke};
use super::declutter::{Extent, push_apart};
use super::heading;
use super::style::{
    ALARM, AXIS_SIZE, BETWEEN_FACTS, Colour, FINE_DASH, FLUTTER_STREAK, FORWARD, HAIRLINE, INK,
    LABEL_SIZE, QUIET, tint,
};
use crate::analyses::study::{Passing, SpeedStatistics, StudyReport};

const WIDTH: u32 = 1000;
const HEIGHT: u32 = 700;
const CRITICAL: Frame = Frame {
    left: 92.0,
    top: 144.0,
    right: 960.0,
    bottom: 324.0,
};
const FLUTTERING: Frame = Frame {
    left: 92.0,
    top: 430.0,
    right: 960.0,
    bottom: 610.0,
};
/// Shares of saws whose quantiles have labels if the report contains them, in order of importance.
const NAMED: [f64; 5] = [0.5, 0.05, 0.95, 0.01, 0.99];
/// Space beside the outermost bars and limits, relative to their distance.
const ASIDE: f64 = 0.04;

/// A limit of a speed.
struct Limit {
    rpm: f64,
    /// Origin of the limit, written before its speed.
    word: &'static str,
}

pub fn sheet(report: &StudyReport) -> Sheet {
    let mut sheet = Sheet::new(WIDTH, HEIGHT);
    let count = format!("{} × {}", report.all.saws, report.scene.name);
    let passing = report.all.passing.as_ref().map(verdict);
    let facts: Vec<String> = [report.condition.clone(), count]
        .into_iter()
        .chain(passing)
        .collect();
    heading::draw(&mut sheet, &report.study.name, &facts.join(BETWEEN_FACTS));
    let of = |keys: &[(&str, &'static str)]| limits(report, keys);
    let critical = of(&[("margin", "operating/margin"), ("min_critical", "asked")]);
    let flutter = of(&[("min_flutter", "asked")]);
    let all = &report.all;
    let bars = tint(FORWARD, 0.45);
    draw_panel(
        &mut sheet,
        &all.lowest_critical,
        (CRITICAL, bars),
        &critical,
    );
    let bars = FLUTTER_STREAK;
    draw_panel(&mut sheet, &all.flutter, (FLUTTERING, bars), &flutter);
    let names = [
        (CRITICAL, "Lowest critical speed", String::new()),
        (FLUTTERING, "Flutter speed", beyond(report)),
    ];
    for (panel, name, note) in names {
        let y = panel.top - 44.0;
        sheet.text([panel.left, y], Lettering::title(AXIS_SIZE, INK), name);
        let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::End);
        sheet.text([panel.right, y], letters, &note);
    }
    let baseline = FLUTTERING.bottom + 44.0;
    name_below(&mut sheet, FLUTTERING.across(), baseline, SPEED);
    let letters = Lettering::regular(LABEL_SIZE, QUIET, Anchor::Start);
    let key = "dashed: share of the saws below, and the speed; red: limits";
    sheet.text([FLUTTERING.left, f64::from(HEIGHT) - 16.0], letters, key);
    sheet
}

/// Share of the saws that keep all limits, with its confidence interval.
fn verdict(passing: &Passing) -> String {
    let share = format!("{:.1} % pass", 100.0 * passing.probability);
    match passing.interval {
        None => share,
        Some([low, high]) => format!(
            "{share} ({:.1} to {:.1} % with {} % confidence)",
            100.0 * low,
            100.0 * high,
            percent(passing.confidence)
        ),
    }
}

/// Note on the saws that do not flutter in the sweep; empty if there are none.
fn beyond(report: &StudyReport) -> String {
    match report.all.flutter.beyond {
        0 => String::new(),
        count => format!(
            "{count} of {} do not flutter up to {:.0} rpm",
            report.all.saws, report.swept_to_rpm
        ),
    }
}

/// A share in percent, rounded to four decimals.
fn percent(share: f64) -> f64 {
    (1e6 * share).round() / 1e4
}

/// Limits of the criteria with given keys, with a word for each.
fn limits(report: &StudyReport, keys: &[(&str, &'static str)]) -> Vec<Limit> {
    let criteria = report.all.passing.iter().flat_map(|p| &p.criteria);
    let limit = |key: &str, rpm| {
        let (_, word) = keys.iter().find(|(name, _)| *name == key)?;
        Some(Limit { rpm, word })
    };
    criteria
        .filter_map(|criterion| limit(&criterion.key, criterion.asked_rpm))
        .collect()
}

/// The axis of speeds of a panel. It includes all bars, and limits that are no further from them than the bars are wide
/// together.
fn speed_axis(entry: &SpeedStatistics, limits: &[Limit], panel: Frame) -> Axis {
    let bars = entry.histogram.as_ref().map(|b| (b.from_rpm, b.to_rpm));
    let near =
        |rpm: &f64| bars.is_none_or(|(from, to)| (2.0 * from - to..=2.0 * to - from).contains(rpm));
    let asked = limits.iter().map(|limit| limit.rpm).filter(near);
    let (low, high) = asked.fold(
        bars.unwrap_or((f64::INFINITY, f64::NEG_INFINITY)),
        |(low, high), rpm| (low.min(rpm), high.max(rpm)),
    );
    let aside = ASIDE * (high - low);
    Axis::linear([low - aside, high + aside], panel.across())
}

/// Draws the histogram of a speed, and its quantiles and limits.
fn draw_panel(
    sheet: &mut Sheet,
    entry: &SpeedStatistics,
    (panel, colour): (Frame, Colour),
    limits: &[Limit],
) {
    let speed = &speed_axis(entry, limits, panel);
    let total = (entry.saws + entry.beyond).max(1) as f64;
    let counts = entry.histogram.iter().flat_map(|bars| &bars.counts);
    let most = counts.max().map_or(1.0, |most| *most as f64);
    let top = 108.0 * most / total;
    let share = Axis::linear([0.0, top], panel.upwards());
    draw_vertical(sheet, &share, &panel, "saws in a bar\u{2003}[%]");
    if let Some(bars) = &entry.histogram {
        let count = bars.counts.len() as f64;
        let width = (bars.to_rpm - bars.from_rpm) / count;
        for (k, saws) in bars.counts.iter().enumerate() {
            let from = bars.from_rpm + k as f64 * width;
            let (left, right) = (speed.at(from), speed.at(from + width));
            let bar = Frame {
                left,
                // A gap separates the bars if they are wide enough; very narrow bars are drawn as thin lines.
                right: (right - 1.0).max(left + 1.0),
                top: share.at(100.0 * *saws as f64 / total),
                bottom: panel.bottom,
            };
            sheet.fill(bar, colour);
        }
    }
    draw_horizontal(sheet, speed, panel.bottom, true);
    draw_marks(sheet, entry, panel, speed, limits);
}

/// Draws lines at quantiles and limits, with labels above the panel.
fn draw_marks(
    sheet: &mut Sheet,
    entry: &SpeedStatistics,
    panel: Frame,
    speed: &Axis,
    limits: &[Limit],
) {
    let limits = limits.iter().filter(|limit| speed.shows(limit.rpm));
    let limits = limits.map(|limit| {
        let label = format!("{} {:.0}", limit.word, limit.rpm);
        (limit.rpm, ALARM, label)
    });
    let quantiles = NAMED.iter().filter_map(|share| {
        let quantile = entry.quantiles.iter().find(|q| q.share == *share)?;
        let rpm = quantile.rpm?;
        Some((rpm, QUIET, format!("{} %: {rpm:.0}", percent(*share))))
    });
    let marks: Vec<(f64, Colour, String)> = limits.chain(quantiles).collect();
    let extent = |(rpm, _, label): &(f64, _, String)| Extent::of_label(speed.at(*rpm), label, 12.0);
    let places = push_apart(marks.iter().map(extent), panel.across());
    for ((rpm, colour, label), place) in marks.iter().zip(places) {
        let x = speed.at(*rpm);
        let stroke = Stroke {
            dash: (*colour != ALARM).then_some(FINE_DASH),
            ..Stroke::solid(*colour, 1.4 * HAIRLINE)
        };
        sheet.vertical(x, &panel, stroke);
        if let Some(place) = place {
            let leader = [[x, panel.top], [place, panel.top - 10.0]];
            sheet.line(leader, Stroke::solid(*colour, HAIRLINE));
            let letters = Lettering::regular(LABEL_SIZE, *colour, Anchor::Middle);
            sheet.text([place, panel.top - 15.0], letters, label);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tidy::{assert_tidy, texts};
    use super::*;
    use crate::analyses::study::{Found, Outcome, Saw, Study, StudyFile};
    use crate::scene::Scene;

    /// Synthetic saws whose flutter speed follows from the critical speed, with the limits of the sample
    /// study.
    fn report(critical: impl Fn(f64) -> Option<f64>) -> StudyReport {
        let text = include_str!("../../scenes/studies/paper-tolerances.json");
        let file = StudyFile::from_json(text).unwrap();
        let study = Study::new(Scene::paper(), file).unwrap();
        let saw = |index: usize| {
            let share = (index as f64 + 0.5) / study.count() as f64;
            let lowest = critical(share);
            let found = Found {
                lowest_critical_rpm: lowest,
                flutter_rpm: lowest.map(|rpm| 1.5 * rpm).filter(|rpm| *rpm < 2300.0),
                first_merge_rpm: None,
                kept: vec![true, true, share > 0.5],
                gap: Vec::new(),
                functions: 85,
                estimated_relative_error: 1e-3,
                krein_violations: 0,
                critical_rpm: Vec::new(),
                bands: Vec::new(),
            };
            Saw {
                index,
                values: study.values(index),
                outcome: Outcome::Analysed(found),
            }
        };
        let saws: Vec<Saw> = (0..study.count()).map(saw).collect();
        study.report(&saws).unwrap()
    }

    #[test]
    fn no_label_lies_on_another() {
        let spread = report(|share| Some(1480.0 + 80.0 * share * share));
        let narrow = report(|share| Some(1510.0 + 1e-3 * share));
        let alike = report(|_| Some(1510.0));
        let none = report(|_| None);
        for report in [spread, narrow, alike, none] {
            assert_tidy(&sheet(&report));
        }
    }

    #[test]
    fn quantiles_limits_and_saws_beyond_the_sweep_are_written() {
        let report = report(|share| Some(1480.0 + 80.0 * share));
        let sheet = sheet(&report);
        let written: Vec<&str> = texts(&sheet).into_iter().map(|(_, text)| text).collect();
        // 1.5 × 1533.3 is 2300; a third of the saws exceed it.
        for expected in [
            "50 %: 1520",
            "operating/margin 1512",
            "asked 2220",
            "333 of 1000 do not flutter up to 2500 rpm",
        ] {
            assert!(written.contains(&expected), "{expected}: {written:?}");
        }
        // The 95 % quantile of the flutter speed lies beyond the sweep.
        let share = |text: &&&str| text.starts_with("95 %");
        assert_eq!(written.iter().filter(share).count(), 1);
    }
}
