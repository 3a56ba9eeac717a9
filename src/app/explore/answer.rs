//! Text beside a diagram: the answer of the summary, the numbers by which a change is judged, and tables.

use serde::Serialize;

use crate::analyses::campbell::{Answer, Report, ToleratedHeat, answer, outline};
use crate::page::outline::Table;
use crate::page::text::shown_to;

/// Text from the summary.
#[derive(Serialize)]
pub struct Told {
    /// Whether the saw can run at its operating speed; null without one.
    answer: Option<Answer>,
    /// This answer as text, and its reasons.
    lines: Vec<String>,
    facts: Vec<Fact>,
    tables: Vec<Table>,
}

/// A number by which a change is judged.
#[derive(Debug, Serialize)]
pub struct Fact {
    name: &'static str,
    words: String,
    unit: &'static str,
}

impl Told {
    /// Creates the text for a report.
    pub fn new(report: &Report) -> Self {
        let lines = answer(report);
        Told {
            answer: report.operating.as_ref().map(Answer::new),
            lines: lines.lines().into_iter().map(str::to_owned).collect(),
            facts: facts(report),
            tables: outline(report).tables().into_iter().cloned().collect(),
        }
    }
}

fn speed(name: &'static str, rpm: Option<f64>) -> Fact {
    Fact {
        name,
        words: rpm.map_or("none".to_owned(), |rpm| {
            if rpm < 100.0 {
                format!("{rpm:.1}")
            } else {
                format!("{rpm:.0}")
            }
        }),
        unit: if rpm.is_some() { "rpm" } else { "" },
    }
}

/// First critical speed of the sweep, and ratio of the operating speed to the first critical speed.
pub fn of_critical(first_rpm: Option<f64>, share: Option<f64>) -> [Fact; 2] {
    let percent = share.map(|share| format!("{:.1}", 100.0 * share));
    [
        speed("First critical", first_rpm),
        known("Of critical", percent, "%"),
    ]
}

/// Flutter speed, onset of the first flutter band, and largest growth rate.
pub fn of_bands(
    [flutter_rpm, first_merge_rpm]: [Option<f64>; 2],
    peak_growths_per_s: impl Iterator<Item = f64>,
) -> [Fact; 3] {
    [
        speed("Flutter speed", flutter_rpm),
        speed("First merging", first_merge_rpm),
        Fact {
            name: "Fastest growth",
            words: shown_to(3, peak_growths_per_s.fold(0.0, f64::max)),
            unit: "1/s",
        },
    ]
}

fn facts(report: &Report) -> Vec<Fact> {
    let peaks = report.instabilities.iter().map(|b| b.peak_growth_per_s);
    let of_lowest = report.operating.as_ref().and_then(|o| o.of_lowest_critical);
    let critical = report.critical_speeds.first().map(|critical| critical.rpm);
    let [first_critical, share] = of_critical(critical, of_lowest);
    let onsets = [report.flutter_speed_rpm, report.first_merge_rpm];
    let mut facts = vec![first_critical];
    facts.extend(of_bands(onsets, peaks));
    facts.push(share);
    let heat = report.membrane.as_ref().and_then(|m| m.heat.as_ref());
    facts.extend(heat.map(|heat| {
        let rise = tolerated_rise_k(heat).map(|rise_k| shown_to(3, rise_k));
        known("Tolerated rise", rise, "K")
    }));
    facts
}

fn known(name: &'static str, words: Option<String>, unit: &'static str) -> Fact {
    let unit = if words.is_some() { unit } else { "" };
    let words = words.unwrap_or_else(|| "–".to_owned());
    Fact { name, words, unit }
}

/// Temperature rise in K at which the first critical speed equals the operating speed or the blade buckles, whichever
/// is smaller; `None` if the operating speed exceeds a critical speed of the cold blade.
fn tolerated_rise_k(heat: &ToleratedHeat) -> Option<f64> {
    let limit = heat
        .operating_limit
        .as_ref()
        .or(heat.buckling.as_ref())
        .filter(|_| !heat.past_critical_when_cold);
    limit.map(|limit| limit.rise_k)
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;
    use crate::model::scene::{Accuracy, Scene};
    use crate::stability::Analysis;

    /// The page receives the lines that the program prints.
    #[test]
    fn the_answer_is_that_of_the_summary() {
        for (rpm, wanted) in [
            (Some(900.0), json!("runs")),
            (Some(1800.0), json!("past_rule")),
            (Some(1500.0), json!("at_critical")),
            (Some(2400.0), json!("flutter")),
            (Some(5000.0), json!("outside_sweep")),
            (None, Value::Null),
        ] {
            let scene = Scene::paper().edited(|file| {
                (file.accuracy, file.operating_rpm) = (Accuracy::Draft, rpm);
            });
            let report = Analysis::new(&scene.unwrap()).unwrap().report();
            let told = serde_json::to_value(Told::new(&report)).unwrap();
            let summary = report.summary();
            let printed: Vec<&str> = summary.split_whitespace().collect();
            let lines = told["lines"].as_array().unwrap();
            let words: Vec<&str> = lines
                .iter()
                .flat_map(|line| line.as_str().unwrap().split(' '))
                .collect();
            assert_eq!(told["answer"], wanted, "{rpm:?}: {lines:?}");
            assert!(
                printed.windows(words.len()).any(|window| window == words),
                "{lines:?}"
            );
        }
    }
}
