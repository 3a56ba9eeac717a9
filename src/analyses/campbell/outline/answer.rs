//! The answer whether a saw can run at its operating speed.

use super::is_damped;
use crate::analyses::campbell::{
    InstabilityBand, InstabilityKind, OperatingPoint, Report, StabilityState, near_critical,
    side_force_in_words,
};
use crate::model::scene::{Accuracy, SlotPassing};
use crate::page::outline::{Outline, SPEED};
use crate::page::text::shown_to;
use crate::stability::CRITICAL_MARGIN;

/// Whether a saw can run at its operating speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "page", derive(serde::Serialize))]
#[cfg_attr(feature = "page", serde(rename_all = "snake_case"))]
pub enum Answer {
    /// The saw is stable and keeps the 85 % rule, or has no critical speed.
    Runs,
    /// The saw is stable but breaks the 85 % rule.
    PastRule,
    /// The saw is stable, but its speed is within 5 % of a critical speed.
    AtCritical,
    /// The saw diverges.
    Divergence,
    /// The saw flutters.
    Flutter,
    /// The estimated error of the edge of a band leaves open whether the saw is stable.
    TooClose,
    /// The search for bands failed.
    NotDetermined,
    /// Slots pass guides, which the model does not cover at this speed.
    NotCovered,
    /// The sweep does not include the operating speed.
    OutsideSweep,
}

impl Answer {
    /// Derives the answer from the verdict at the operating speed.
    pub fn new(operating: &OperatingPoint) -> Self {
        match operating.verdict {
            StabilityState::Divergence => Answer::Divergence,
            StabilityState::Flutter => Answer::Flutter,
            StabilityState::TooClose => Answer::TooClose,
            StabilityState::NotDetermined => Answer::NotDetermined,
            StabilityState::NotCovered => Answer::NotCovered,
            StabilityState::OutsideSweep => Answer::OutsideSweep,
            StabilityState::Stable if operating.at_critical_rpm.is_some() => Answer::AtCritical,
            StabilityState::Stable if operating.within_limit == Some(false) => Answer::PastRule,
            StabilityState::Stable => Answer::Runs,
        }
    }

    /// The answer in few words, for tables.
    pub fn in_few_words(self) -> &'static str {
        match self {
            Answer::Runs => "stable",
            Answer::PastRule => "past the limit",
            Answer::AtCritical => "at critical",
            Answer::Divergence => "divergence",
            Answer::Flutter => "flutter",
            Answer::TooClose => "too close",
            Answer::NotDetermined => "not determined",
            Answer::NotCovered => "not certain",
            Answer::OutsideSweep => "outside sweep",
        }
    }

    fn in_words(self) -> &'static str {
        match self {
            Answer::Runs => "YES",
            Answer::PastRule => "STABLE, but above the usual limit",
            Answer::AtCritical => "STABLE, but within 5 % of a critical speed",
            Answer::Divergence => "NO, UNSTABLE: divergence",
            Answer::Flutter => "NO, UNSTABLE: flutter",
            Answer::TooClose => "TOO CLOSE TO CALL",
            Answer::NotDetermined => "UNKNOWN: the search for bands failed",
            Answer::NotCovered => "NOT CERTAIN: slots pass guides",
            Answer::OutsideSweep => "UNKNOWN: outside the sweep",
        }
    }
}

/// The answer whether a saw can run at its operating speed, its reasons, and the speeds at which it can.
pub fn answer(report: &Report) -> Outline {
    let mut text = Outline::default();
    match &report.operating {
        Some(operating) => at_operating_speed(&mut text, report, operating),
        None => up_to(&mut text, report),
    }
    flutter(&mut text, report);
    text
}

/// The answer for an operating speed, with its question.
pub fn headline(operating: &OperatingPoint) -> String {
    let answer = Answer::new(operating).in_words();
    format!("Can it run at {:.0} rpm? {answer}", operating.rpm)
}

fn at_operating_speed(text: &mut Outline, report: &Report, operating: &OperatingPoint) {
    text.headline(headline(operating));
    if let Some(words) = undecided(report, operating) {
        text.reason(words);
    }
    let around = operating.inside_instability;
    let band = around.and_then(|index| report.instabilities.get(index));
    if let Some(band) = band {
        text.reason(inside(band));
    }
    match Answer::new(operating) {
        Answer::OutsideSweep => text.reason(WIDEN),
        Answer::NotDetermined => text.reason(failed(report)),
        Answer::NotCovered => text.reason(passing(report)),
        _ => (),
    }
    if let (Some(growth), Some(hz)) = (operating.growth_per_s, operating.frequency_hz) {
        text.reason(fastest(report, growth, hz, band.is_some()));
    }
    if let Some(words) = usable(report, operating) {
        text.reason(words);
    }
    if let Some(words) = at_critical_speed(report, operating) {
        text.reason(words);
    }
    if let Some(words) =
        side_force_in_words(operating.rpm, operating.side_force_factor, &report.scene)
    {
        text.reason(words);
    }
    if let Some(deviation) = &operating.deviation {
        text.reason(deviation.in_words());
    }
    if let Some(words) = rule(operating) {
        text.reason(words);
    }
}

const WIDEN: &str = "widen `sweep` so that it includes operating_rpm";

/// States which checks the search fails, and the remedy.
fn failed(report: &Report) -> String {
    let statement = &report.certificate.statement;
    format!("{statement}; a shorter sweep or another accuracy may avoid this")
}

/// The reason for which a saw whose slots pass guides is not called stable.
fn passing(report: &Report) -> &'static str {
    (report.scene.slot_passing()).map_or("slots pass guides", SlotPassing::in_words)
}

/// The reason that decides the answer at the operating speed.
#[cfg(feature = "page")]
pub fn deciding(report: &Report, operating: &OperatingPoint) -> Option<String> {
    match Answer::new(operating) {
        Answer::Divergence | Answer::Flutter => {
            let index = operating.inside_instability?;
            report.instabilities.get(index).map(inside)
        }
        Answer::TooClose => undecided(report, operating),
        Answer::OutsideSweep => Some(WIDEN.to_owned()),
        Answer::NotDetermined => Some(failed(report)),
        Answer::NotCovered => Some(passing(report).to_owned()),
        Answer::AtCritical => at_critical_speed(report, operating),
        Answer::PastRule | Answer::Runs => rule(operating).or_else(|| usable(report, operating)),
    }
}

/// The window without instability around the operating speed, if there is one.
pub fn usable(report: &Report, operating: &OperatingPoint) -> Option<String> {
    let [from, to] = operating.safe_window_rpm?;
    let end = end_of_window(report, to);
    let first = SPEED.fixed(usize::from(from > 0.0), from).in_words();
    Some(format!("usable speeds: {first} to {to:.1} rpm{end}"))
}

/// Describes the band that makes the saw unstable at its operating speed.
fn inside(band: &InstabilityBand) -> String {
    let waves = band
        .name
        .as_ref()
        .map_or(String::new(), |name| format!(", {name}"));
    format!(
        "inside the band of {} from {:.1} to {:.1} rpm{waves}",
        band.kind, band.from_rpm, band.to_rpm
    )
}

/// Names the edge of a band whose error leaves the answer open, and the remedy.
fn undecided(report: &Report, operating: &OperatingPoint) -> Option<String> {
    let edge = operating.undecided_edge_rpm?;
    let mut bands = report.instabilities.iter();
    let band = bands.find(|band| [band.from_rpm, band.to_rpm].contains(&edge))?;
    let error = band.estimated_relative_error.map(|error| error * edge);
    Some(too_close(edge, error, report.accuracy.name))
}

/// What an analysis of another kind says of an operating speed at which the saw is stable but hardly, or too close to an edge to
/// call.
pub fn caution(report: &Report) -> Option<String> {
    let operating = report.operating.as_ref()?;
    let said = match Answer::new(operating) {
        Answer::TooClose => {
            let reason = undecided(report, operating)?;
            format!("too close to call whether the saw is stable: {reason}")
        }
        Answer::AtCritical => at_critical_speed(report, operating)?,
        Answer::NotDetermined => {
            format!(
                "it is unknown whether the saw is stable: {}",
                failed(report)
            )
        }
        Answer::NotCovered => format!(
            "it is not certain whether the saw is stable: {}",
            passing(report)
        ),
        _ => return None,
    };
    Some(format!("at {:.0} rpm {said}", operating.rpm))
}

/// States that the estimated error of the edge of a band leaves open whether a saw is stable, and the remedy.
pub fn too_close(edge_rpm: f64, error_rpm: Option<f64>, accuracy: Accuracy) -> String {
    let error = error_rpm.map_or("an error that is unknown".to_owned(), |error| {
        format!("an estimated error of {error:.2} rpm")
    });
    format!(
        "the edge of a band, {edge_rpm:.2} rpm, has {error}; {}",
        sharper(accuracy)
    )
}

/// The remedy for a result that is not accurate enough.
pub fn sharper(accuracy: Accuracy) -> &'static str {
    match accuracy {
        Accuracy::Draft => "use --accuracy design",
        Accuracy::Design => "use --accuracy reference",
        Accuracy::Reference => "give a smaller --tolerance",
    }
}

/// Describes the motion with the largest growth rate, in 1/s, at the operating speed, which may be inside a band.
fn fastest(report: &Report, growth: f64, hz: f64, is_inside: bool) -> String {
    let threshold = report.flutter_threshold_per_s;
    if is_inside && growth <= 0.0 {
        return "the speed is an edge of this band, where the growth is zero".to_owned();
    }
    if growth > 0.0 {
        let compared = if growth >= threshold {
            "reaches"
        } else {
            "is below"
        };
        return format!(
            "fastest growth {} 1/s at {hz:.2} Hz {compared} the threshold of {threshold} 1/s",
            shown_to(3, growth)
        );
    }
    match growth < 0.0 {
        true => format!(
            "every vibration decays, the slowest by {} 1/s at {hz:.2} Hz",
            shown_to(3, -growth)
        ),
        false if is_damped(report) => {
            format!("no vibration grows; the one at {hz:.2} Hz does not decay either")
        }
        false => "no vibration grows (nor decays: the model has no damping)".to_owned(),
    }
}

/// Warns of the critical speed close to the operating speed, if there is one.
fn at_critical_speed(report: &Report, operating: &OperatingPoint) -> Option<String> {
    let rpm = operating.at_critical_rpm?;
    let critical = report.critical_speeds.iter().find(|c| c.rpm == rpm);
    let name = critical.map_or(String::new(), |c| format!(" ({})", c.name));
    Some(format!("{}{name}", near_critical(rpm)))
}

/// Compares the operating speed with the 85 % rule; `None` without a critical speed.
fn rule(operating: &OperatingPoint) -> Option<String> {
    let (ratio, lowest_rpm) = operating
        .of_lowest_critical
        .zip(operating.lowest_critical_rpm)?;
    Some(format!(
        "{:.0} rpm is {:.0} % of the first critical speed; the limit is {:.0} % ({:.0} rpm)",
        operating.rpm,
        100.0 * ratio,
        100.0 * operating.limit,
        operating.limit * lowest_rpm
    ))
}

/// Adds the answer for a scene without operating speed: the speed up to which the saw is stable.
fn up_to(text: &mut Outline, report: &Report) {
    let counted = report.instabilities.iter().flat_map(|b| &b.counted_rpm);
    let first = counted.map(|stretch| stretch[0]).reduce(f64::min);
    let from = report.campbell.from_rpm;
    let has_failed = report.certificate.has_failed();
    let lowest = report.critical_speeds.first().map(|critical| critical.rpm);
    let covered_to = report.scene.covered_to(lowest);
    let end = report.campbell.to_rpm;
    text.headline(match first {
        _ if !has_failed && covered_to < first.unwrap_or(end) => match covered_to {
            0.0 => "NOT CERTAIN: slots pass guides".to_owned(),
            _ => format!("No instability from {from:.0} to {covered_to:.1} rpm; NOT CERTAIN above: slots pass guides"),
        },
        _ if has_failed => "UNKNOWN: the search for bands failed".to_owned(),
        Some(first) if first > from => {
            format!("No instability from {from:.0} to {first:.1} rpm")
        }
        Some(first) => format!("Unstable above {first:.1} rpm"),
        None => format!(
            "No instability from {from:.0} to {:.0} rpm, the end of the sweep",
            report.campbell.to_rpm
        ),
    });
    if has_failed {
        text.reason(failed(report));
    }
    if covered_to < first.unwrap_or(end) {
        text.reason(passing(report));
    }
    if let Some(critical) = report.critical_speeds.first() {
        text.reason(format!(
            "first critical speed {:.1} rpm ({})",
            critical.rpm, critical.name
        ));
    }
    text.reason("(the scene has no operating_rpm to compare with it)");
}

/// Adds the flutter speed, and the onset of weak flutter below it.
fn flutter(text: &mut Outline, report: &Report) {
    if report.certificate.has_failed() {
        text.sentence("Flutter speed: not determined");
        return;
    }
    let threshold = report.flutter_threshold_per_s;
    text.sentence(match report.flutter_speed_rpm {
        Some(rpm) => {
            let is_its = |band: &&InstabilityBand| {
                band.kind == InstabilityKind::Flutter
                    && band.counted_rpm.iter().any(|counted| counted[0] == rpm)
            };
            let band = report.instabilities.iter().find(is_its);
            let error = band
                .and_then(|band| band.estimated_relative_error)
                .map_or(" (error unknown)".to_owned(), |share| {
                    format!(" ± {:.1}", share * rpm)
                });
            format!("Flutter speed: {rpm:.0} rpm{error} (growth of {threshold} 1/s or more)")
        }
        None => {
            let open = match report.scene.slot_passing() {
                Some(_) => " is listed, but slots that pass guides are not covered",
                None => "",
            };
            format!(
                "No flutter of {threshold} 1/s or more up to {:.0} rpm{open}",
                report.campbell.to_rpm
            )
        }
    });
    let weak = report
        .first_merge_rpm
        .filter(|first| Some(*first) != report.flutter_speed_rpm);
    if let Some(rpm) = weak {
        text.sentence(format!(
            "Weak flutter (below {threshold} 1/s) from {rpm:.0} rpm"
        ));
    }
}

/// States why the window without instability ends at a speed; empty if a band begins there.
fn end_of_window(report: &Report, rpm: f64) -> String {
    let counted = |band: &InstabilityBand| band.counted_rpm.iter().any(|[from, _]| *from == rpm);
    if rpm >= report.campbell.to_rpm {
        return ", where the sweep ends".to_owned();
    }
    if report.instabilities.iter().any(counted) {
        return String::new();
    }
    let share = 1.0 - CRITICAL_MARGIN;
    // A report may have been rounded.
    let margin = |critical: f64| (critical * share - rpm).abs() <= 1e-5 * rpm;
    let critical = report.critical_speeds.iter().find(|c| margin(c.rpm));
    critical.map_or(String::new(), |critical| {
        let percent = 100.0 * share;
        format!(
            " ({percent:.0} % of the critical speed {:.1} rpm)",
            critical.rpm
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analyses::campbell::sample::busy_report;

    /// The bands contradict the eigenvalues at a third of the speeds.
    #[test]
    fn a_failed_search_gives_no_verdict_and_no_flutter_speed() {
        let mut report = busy_report();
        let certificate = &mut report.certificate;
        (certificate.speeds_checked, certificate.krein_violations) = (60, 20);
        if let Some(operating) = &mut report.operating {
            operating.verdict = StabilityState::NotDetermined;
            operating.inside_instability = None;
        }
        for with_speed in [true, false] {
            if !with_speed {
                report.operating = None;
            }
            let text = answer(&report).in_columns(false);
            let mut lines = text.lines();
            let first = lines.next().unwrap();
            assert!(
                first.contains("UNKNOWN: the search for bands failed"),
                "{text}"
            );
            assert!(text.contains("Flutter speed: not determined"), "{text}");
            assert!(!text.contains('±'), "{text}");
        }
    }
}
