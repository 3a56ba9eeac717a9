//! The answer whether a saw can run at its operating speed.

use super::is_damped;
use crate::analyses::campbell::{
    InstabilityBand, InstabilityKind, OperatingPoint, Report, side_force_in_words,
};
use crate::analyses::verdict::{CRITICAL, near_critical};
use crate::page::outline::{Outline, SPEED};
use crate::page::text::shown_to;
use crate::stability::CRITICAL_MARGIN;

/// The answer whether a saw can run at its operating speed, its reasons, and the speeds at which it can.
pub fn answer(report: &Report) -> Outline {
    let mut text = Outline::default();
    text.headline(report.verdict.headline());
    match &report.operating {
        Some(operating) => at_operating_speed(&mut text, report, operating),
        None => up_to(&mut text, report),
    }
    flutter(&mut text, report);
    text
}

fn at_operating_speed(text: &mut Outline, report: &Report, operating: &OperatingPoint) {
    let wave = wave_at_critical(report, operating);
    for limit in report.verdict.other_reasons() {
        // The wave is named with its critical speed.
        if wave.is_none() || limit.key != CRITICAL {
            text.reason(limit.in_words());
        }
    }
    if let Some(words) = wave {
        text.reason(words);
    }
    let around = operating.inside_instability;
    let band = around.and_then(|index| report.instabilities.get(index));
    if let Some(name) = band.and_then(|band| band.name.as_ref()) {
        text.reason(format!("waves of this band: {name}"));
    }
    for words in open(report) {
        text.reason(words);
    }
    // The modes are those of the axisymmetric blade, to which multipliers of the slotted one are preferred.
    let modes = operating.growth_per_s.zip(operating.frequency_hz);
    if let Some((growth, hz)) = modes.filter(|_| report.verdict.floquet.is_none()) {
        text.reason(fastest(report, growth, hz, band.is_some()));
    }
    if let Some(words) = usable(report, operating) {
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
}

/// What leaves the verdict open, and the remedy.
fn open(report: &Report) -> impl Iterator<Item = String> {
    let failed = report.certificate.has_failed().then(|| failed(report));
    let by_floquet = report.verdict.floquet.as_ref().map(|of| of.in_words());
    let passing = by_floquet.or_else(|| {
        let passing = report.scene.slot_passing()?;
        Some(passing.in_words().to_owned())
    });
    failed.into_iter().chain(passing)
}

/// States which checks the search fails, and the remedy.
fn failed(report: &Report) -> String {
    let statement = &report.certificate.statement;
    format!("{statement}; a shorter sweep or another accuracy may avoid this")
}

/// The window without instability around the operating speed, if there is one.
pub fn usable(report: &Report, operating: &OperatingPoint) -> Option<String> {
    let [from, to] = operating.safe_window_rpm?;
    let end = end_of_window(report, to);
    let first = SPEED.fixed(usize::from(from > 0.0), from).in_words();
    Some(format!(
        "window without instability: {first} to {to:.1} rpm{end}"
    ))
}

/// What an analysis of another kind says of an operating speed at which the saw is stable but hardly, or too close to an edge to
/// call.
pub fn caution(report: &Report) -> Option<String> {
    let cause = report.verdict.cause.as_deref()?;
    let is_open = ["too_close", "not_determined", "not_covered", CRITICAL].contains(&cause);
    let rpm = report.verdict.rpm.filter(|_| is_open)?;
    Some(format!("at {rpm:.0} rpm {}", report.verdict.reason))
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

/// Names the wave of the critical speed close to the operating speed, if there is one.
fn wave_at_critical(report: &Report, operating: &OperatingPoint) -> Option<String> {
    let rpm = operating.at_critical_rpm?;
    let critical = report.critical_speeds.iter().find(|c| c.rpm == rpm)?;
    Some(format!("{} ({})", near_critical(rpm), critical.name))
}

/// Adds what is known of a saw without operating speed: the speed up to which nothing grows.
fn up_to(text: &mut Outline, report: &Report) {
    let counted = report.instabilities.iter().flat_map(|b| &b.counted_rpm);
    let first = counted.map(|stretch| stretch[0]).reduce(f64::min);
    let from = report.campbell.from_rpm;
    if !report.certificate.has_failed() {
        text.reason(match first {
            Some(first) if first > from => {
                format!("no instability from {from:.0} to {first:.1} rpm")
            }
            Some(first) => format!("unstable above {first:.1} rpm"),
            None => format!(
                "no instability from {from:.0} to {:.0} rpm, the end of the sweep",
                report.campbell.to_rpm
            ),
        });
    }
    for words in open(report) {
        text.reason(words);
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
    text.sentence(match report.flutter_rpm {
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
        .filter(|first| Some(*first) != report.flutter_rpm);
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
    use crate::stability::StabilityState;

    /// The bands contradict the eigenvalues at a third of the speeds.
    #[test]
    fn a_failed_search_gives_no_verdict_and_no_flutter_speed() {
        let mut report = busy_report();
        let certificate = &mut report.certificate;
        (certificate.speeds_checked, certificate.krein_violations) = (60, 20);
        if let Some(operating) = &mut report.operating {
            operating.stability = StabilityState::NotDetermined;
            operating.inside_instability = None;
        }
        for with_speed in [true, false] {
            if !with_speed {
                report.operating = None;
            }
            let text = answer(&report).in_columns(false);
            let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
            let remedy = "a shorter sweep or another accuracy may avoid this";
            assert!(words.contains(remedy), "{text}");
            assert!(text.contains("Flutter speed: not determined"), "{text}");
            assert!(!text.contains('±'), "{text}");
        }
    }
}
