//! Distributions of the first critical speed and of the flutter speed of many saws.

use super::{Passing, Reliability, SpeedStatistics, StudyReport};
use crate::page::figure::axis::proper_range;
use crate::page::figure::chart_data::{AxisData, ChartData, PanelData};
use crate::page::figure::items::{Bars, Item, Line, Role, Upright};
use crate::page::figure::palette::Hue;

/// Shares of saws whose quantiles have labels if the report contains them, in order of importance.
const NAMED: [f64; 5] = [0.5, 0.05, 0.95, 0.01, 0.99];
/// Space beside the outermost bars and limits, relative to their distance.
const ASIDE: f64 = 0.04;
/// Height of a panel, relative to one of usual height.
const SHARE: f64 = 0.5;

/// Histograms of both speeds, and the share of saws that can run, as numbers.
pub fn chart(report: &StudyReport) -> ChartData {
    let count = format!("{} × {}", report.all.saws, report.scene.name);
    let passing = report.all.passing.as_ref().map(verdict);
    let facts = [report.condition.clone(), count].into_iter().chain(passing);
    let all = &report.all;
    let critical = Speed {
        name: "First critical speed",
        statistics: &all.first_critical,
        bars: (Hue::Forward, 0.45),
        limits: limits(
            report,
            &[("margin", "operating/margin"), ("min_critical", "asked")],
        ),
        swept_to_rpm: report.swept_to_rpm,
    };
    let mut flutter = Speed {
        name: "Flutter speed",
        statistics: &all.flutter,
        bars: (Hue::FlutterStreak, 1.0),
        limits: limits(report, &[("min_flutter", "asked")]),
        swept_to_rpm: report.swept_to_rpm,
    }
    .panel();
    flutter.facts = beyond(report).into_iter().collect();
    let runs = report.reliability.as_ref().map(runs);
    let panels = [critical.panel(), flutter].into_iter().chain(runs);
    ChartData {
        key: key(),
        ..ChartData::new(&report.study.name, facts.collect(), panels.collect())
    }
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

/// Remark on the saws that do not flutter in the sweep; `None` if there are none.
fn beyond(report: &StudyReport) -> Option<String> {
    let count = report.all.flutter.beyond;
    let (saws, rpm) = (report.all.saws, report.swept_to_rpm);
    (count > 0).then(|| format!("{count} of {saws} do not flutter up to {rpm:.0} rpm"))
}

/// A share in percent, rounded to four decimals.
fn percent(share: f64) -> f64 {
    (1e6 * share).round() / 1e4
}

/// Limits of the criteria with given keys, with a word for each.
fn limits(report: &StudyReport, keys: &[(&str, &str)]) -> Vec<Upright> {
    let criteria = report.all.passing.iter().flat_map(|p| &p.criteria);
    let limits = criteria.filter_map(|criterion| {
        let (_, word) = keys.iter().find(|(key, _)| *key == criterion.key)?;
        let rpm = criterion.asked_rpm;
        Some(mark(rpm, Hue::Alarm, format!("{word} {rpm:.0}")))
    });
    limits.collect()
}

/// A vertical line at a speed, red and solid for a limit.
fn mark(rpm: f64, colour: Hue, label: String) -> Upright {
    Upright {
        x: rpm,
        role: Role::Guide,
        colour,
        dashed: colour != Hue::Alarm,
        name: format!("{label} rpm"),
        label,
    }
}

/// A speed of all saws.
struct Speed<'a> {
    name: &'static str,
    statistics: &'a SpeedStatistics,
    /// Colour of the bars, and its share.
    bars: (Hue, f64),
    limits: Vec<Upright>,
    swept_to_rpm: f64,
}

impl Speed<'_> {
    /// Histogram, quantiles and limits.
    fn panel(&self) -> PanelData {
        let found = self.statistics;
        let total = (found.saws + found.beyond).max(1) as f64;
        let percent = |saws: &usize| 100.0 * *saws as f64 / total;
        let counts = found.histogram.iter().flat_map(|bars| &bars.counts);
        let highest = counts.map(percent).fold(0.0, f64::max);
        let most = if highest > 0.0 { highest } else { 100.0 };
        let bars = found.histogram.as_ref().map(|bars| {
            let count = bars.counts.len();
            let width = (bars.to_rpm - bars.from_rpm) / count as f64;
            let (colour, tint) = self.bars;
            Item::Bars(Bars {
                edges: (0..=count)
                    .map(|k| bars.from_rpm + k as f64 * width)
                    .collect(),
                heights: bars.counts.iter().map(percent).collect(),
                colour,
                tint,
                name: "saws in a bar".to_owned(),
            })
        });
        let note = if found.histogram.is_none() {
            format!("no saw has one up to {:.0} rpm", self.swept_to_rpm)
        } else {
            String::new()
        };
        PanelData {
            title: self.name.to_owned(),
            note,
            share: SHARE,
            ..PanelData::new(
                AxisData::speed().within(self.ends()),
                AxisData::new("saws in a bar", "%").within([0.0, 1.08 * most]),
                bars.into_iter().chain(self.marks()).collect(),
            )
        }
    }

    /// Ends of the axis of speeds. It includes all bars, and limits that are no further from them than the bars are wide
    /// together.
    fn ends(&self) -> [f64; 2] {
        let Some(bars) = &self.statistics.histogram else {
            return [0.0, self.swept_to_rpm];
        };
        let (from, to) = (bars.from_rpm, bars.to_rpm);
        let near = |rpm: &f64| (2.0 * from - to..=2.0 * to - from).contains(rpm);
        let asked = self.limits.iter().map(|limit| limit.x).filter(near);
        let (low, high) = asked.fold((from, to), |(low, high), rpm| (low.min(rpm), high.max(rpm)));
        let aside = ASIDE * (high - low);
        proper_range([low - aside, high + aside])
    }

    /// Lines at limits and quantiles.
    fn marks(&self) -> impl Iterator<Item = Item> {
        let quantiles = NAMED.iter().filter_map(|share| {
            let all = &self.statistics.quantiles;
            let rpm = all.iter().find(|q| q.share == *share)?.rpm?;
            let label = format!("{} %: {rpm:.0}", percent(*share));
            Some(mark(rpm, Hue::Quiet, label))
        });
        let marks = self.limits.iter().cloned().chain(quantiles);
        marks.map(Item::Upright)
    }
}

/// The share of saws that can run, over the operating speed.
fn runs(reliability: &Reliability) -> PanelData {
    let points = reliability
        .curve
        .iter()
        .map(|point| [point.operating_rpm, 100.0 * point.share]);
    let ends = [reliability.curve.first(), reliability.curve.last()]
        .map(|point| point.map_or(0.0, |point| point.operating_rpm));
    let name = format!(
        "Saws that can run at up to {:.0} % of their first critical speed, without flutter",
        100.0 * reliability.margin
    );
    let curve = Line::new(points, Hue::Forward, &name);
    PanelData {
        title: name,
        share: SHARE,
        ..PanelData::new(
            AxisData::new("operating speed", "rpm").within(proper_range(ends)),
            AxisData::new("saws", "%").within([0.0, 100.0]),
            vec![Item::Line(curve)],
        )
    }
}

fn key() -> Vec<Item> {
    let sample = |colour, name: &str| {
        Item::Upright(Upright {
            name: name.to_owned(),
            ..mark(0.0, colour, String::new())
        })
    };
    vec![
        sample(Hue::Quiet, "share of the saws below, and the speed [rpm]"),
        sample(Hue::Alarm, "limit [rpm]"),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analyses::study::{Found, Outcome, Saw, Study, StudyFile};
    use crate::model::scene::Scene;
    use crate::page::figure::layout::sheet;
    use crate::page::figure::tidiness::texts;

    /// Synthetic saws whose flutter speed follows from the critical speed, with the limits of the sample
    /// study.
    fn report(critical: impl Fn(f64) -> Option<f64>) -> StudyReport {
        let text = include_str!("../../../scenes/studies/paper-tolerances.json");
        let file = StudyFile::from_json(text).unwrap();
        let study = Study::new(Scene::paper(), file).unwrap();
        let saw = |index: usize| {
            let share = (index as f64 + 0.5) / study.count() as f64;
            let lowest = critical(share);
            let found = Found {
                first_critical_rpm: lowest,
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
            let _drawn = sheet(&chart(&report));
        }
    }

    #[test]
    fn quantiles_limits_and_saws_beyond_the_sweep_are_written() {
        let report = report(|share| Some(1480.0 + 80.0 * share));
        let sheet = sheet(&chart(&report));
        let written = texts(&sheet);
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
