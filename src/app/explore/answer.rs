//! Text beside a diagram: the verdict, the numbers by which a change is judged, the ruler of speeds, and the summary.

use serde::Serialize;

use crate::analyses::campbell::{Report, ToleratedHeat, outline, usable};
use crate::analyses::verdict::{Answer, Verdict};
use crate::page::outline::{Fact, GROWTH, KELVIN, Outline, PERCENT, SPEED, Value};
use crate::page::text::shown_to;

/// Text from the report.
#[derive(Serialize)]
pub struct Told {
    verdict: ShownVerdict,
    facts: Vec<Fact>,
    ruler: Ruler,
    /// The summary.
    outline: Outline,
}

/// Whether the saw can run at its operating speed.
#[derive(Debug, Serialize)]
pub struct ShownVerdict {
    /// Null without an operating speed.
    answer: Option<Answer>,
    /// The answer in few words.
    word: String,
    /// The numbers that decide it.
    line: String,
}

/// Speeds in rpm from rest to the end of the sweep. Critical speeds and bands on it are those of the diagram.
#[derive(Serialize)]
struct Ruler {
    to_rpm: f64,
    /// Speeds without instability around the operating speed.
    window_rpm: Option<[f64; 2]>,
    window: Option<String>,
    /// The usual limit below the first critical speed.
    limit_rpm: Option<f64>,
    /// Ratio to the first critical speed in words.
    limit: Option<String>,
}

impl Told {
    /// Creates the text for a report.
    pub fn new(report: &Report) -> Self {
        Told {
            verdict: Told::verdict(&report.verdict),
            facts: facts(report),
            ruler: Ruler::new(report),
            outline: outline(report),
        }
    }
}

impl Told {
    /// The verdict in the place of the page for it.
    pub fn verdict(found: &Verdict) -> ShownVerdict {
        let word = match found.answer.zip(found.rpm) {
            Some((answer, rpm)) => format!("{} at {} rpm", answer.in_words(), shown_to(6, rpm)),
            None => "not judged".to_owned(),
        };
        ShownVerdict {
            answer: found.answer,
            word: word[..1].to_uppercase() + &word[1..],
            line: found.in_one_line(),
        }
    }
}

impl Ruler {
    fn new(report: &Report) -> Self {
        let operating = report.operating.as_ref();
        let margin = report.scene.limits.unwrap_or_default().margin();
        let critical = report.first_critical_rpm.map(|rpm| (margin, rpm));
        Ruler {
            to_rpm: report.campbell.to_rpm,
            window_rpm: operating.and_then(|at| at.safe_window_rpm),
            window: operating.and_then(|at| usable(report, at)),
            limit_rpm: critical.map(|(limit, rpm)| limit * rpm),
            limit: critical.map(|(limit, _)| PERCENT.fixed(0, limit).with_unit()),
        }
    }
}

/// First critical speed and ratio of the operating speed to it.
pub fn of_critical(first_rpm: Option<f64>, share: Option<f64>) -> [Fact; 2] {
    [
        speed("First critical speed", first_rpm),
        Fact::new("Of critical speed", PERCENT.fixed(1, share)),
    ]
}

fn speed(name: &str, rpm: Option<f64>) -> Fact {
    let decimals = usize::from(rpm.is_some_and(|rpm| rpm < 100.0));
    Fact::new(name, SPEED.fixed(decimals, rpm).or("none"))
}

/// Flutter speed, onset of the weak flutter below it, and largest growth rate.
pub fn of_bands(
    [flutter_rpm, first_merge_rpm]: [Option<f64>; 2],
    peak_growths_per_s: impl Iterator<Item = f64>,
) -> [Fact; 3] {
    let growth = GROWTH.digits(3, peak_growths_per_s.fold(0.0, f64::max));
    let weak_rpm = first_merge_rpm.filter(|first| Some(*first) != flutter_rpm);
    [
        speed("Flutter speed", flutter_rpm),
        speed("Weak flutter", weak_rpm),
        Fact::new("Largest growth rate", growth),
    ]
}

fn facts(report: &Report) -> Vec<Fact> {
    let peaks = report.instabilities.iter().map(|b| b.peak_growth_per_s);
    let operating = report.operating.as_ref();
    let [first_critical, share] = of_critical(
        report.first_critical_rpm,
        operating.and_then(|at| at.of_first_critical),
    );
    let onsets = [report.flutter_rpm, report.first_merge_rpm];
    let mut facts = vec![first_critical];
    facts.extend(of_bands(onsets, peaks));
    facts.push(share);
    let heat = report.membrane.as_ref().and_then(|m| m.heat.as_ref());
    let rise = |heat| -> Value { KELVIN.digits(3, tolerated_rise_k(heat)) };
    facts.extend(heat.map(|heat| Fact::new("Tolerated rise", rise(heat))));
    facts
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

    /// The page receives the answer and a line of its reasons that the program prints.
    #[test]
    fn the_verdict_is_that_of_the_summary() {
        for (rpm, wanted) in [
            (Some(900.0), json!("yes")),
            (Some(1800.0), json!("at_risk")),
            (Some(1500.0), json!("at_risk")),
            (Some(2400.0), json!("no")),
            (Some(5000.0), json!("at_risk")),
            (None, Value::Null),
        ] {
            let scene = Scene::paper().edited(|file| {
                (file.accuracy, file.operating_rpm) = (Accuracy::Draft, rpm);
            });
            let report = Analysis::new(&scene.unwrap()).unwrap().report();
            let told = serde_json::to_value(Told::new(&report)).unwrap();
            let summary = report.summary();
            let printed: Vec<&str> = summary.split_whitespace().collect();
            let verdict = &told["verdict"];
            let words: Vec<&str> = verdict["line"].as_str().unwrap().split(' ').collect();
            assert_eq!(verdict["answer"], wanted, "{rpm:?}: {verdict}");
            assert!(
                printed.windows(words.len()).any(|window| window == words),
                "{verdict}"
            );
        }
    }

    /// The first critical speed is named where the ratio to it is, also above the sweep.
    #[test]
    fn a_critical_speed_above_the_sweep_is_named() {
        let scene = Scene::paper().edited(|file| {
            (file.accuracy, file.operating_rpm) = (Accuracy::Draft, Some(500.0));
            file.sweep.as_mut().unwrap().to_rpm = 1000.0;
        });
        let report = Analysis::new(&scene.unwrap()).unwrap().report();
        assert!(report.critical_speeds.is_empty());
        let facts = facts(&report);
        let words = |name: &str| {
            let fact = facts.iter().find(|fact| fact.name == name);
            fact.unwrap().in_words()
        };
        assert_eq!(words("First critical speed"), "1531 rpm");
        assert_eq!(words("Of critical speed"), "32.7 %");
    }
}
