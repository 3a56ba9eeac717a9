//! The answer whether a saw can run at its operating speed, and the accuracy of a Campbell diagram.

use std::fmt::{Result, Write};

use super::{each, is_damped, sentence, wrapped};
use crate::report::{
    InstabilityBand, InstabilityKind, OperatingPoint, Report, StabilityState, side_force_in_words,
};
use crate::stability::CRITICAL_MARGIN;
use crate::text::shown_to;

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
    /// The sweep does not include the operating speed.
    OutsideSweep,
}

impl Answer {
    /// Derives the answer from the verdict at the operating speed.
    pub fn new(operating: &OperatingPoint) -> Self {
        match operating.verdict {
            StabilityState::Divergence => Answer::Divergence,
            StabilityState::Flutter => Answer::Flutter,
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
            Answer::OutsideSweep => "outside sweep",
        }
    }

    fn in_words(self) -> &'static str {
        match self {
            Answer::Runs => "YES",
            Answer::PastRule => "STABLE, but above the usual limit",
            Answer::AtCritical => "STABLE, but AT A CRITICAL SPEED",
            Answer::Divergence => "NO, UNSTABLE: divergence",
            Answer::Flutter => "NO, UNSTABLE: flutter",
            Answer::OutsideSweep => "UNKNOWN: outside the sweep",
        }
    }
}

/// The answer whether a saw can run at its operating speed, and the speeds at which it can. The first line is
/// the answer; reasons follow. A line may contain line breaks, each followed by an indent.
pub fn answer(report: &Report) -> Vec<String> {
    let mut lines = match &report.operating {
        Some(operating) => at_operating_speed(report, operating),
        None => up_to(report),
    };
    lines.extend(flutter(report));
    lines
}

/// The answer for an operating speed, with its question.
pub fn headline(operating: &OperatingPoint) -> String {
    let answer = Answer::new(operating).in_words();
    format!("Can it run at {:.0} rpm? {answer}", operating.rpm)
}

fn at_operating_speed(report: &Report, operating: &OperatingPoint) -> Vec<String> {
    let answer = Answer::new(operating);
    let mut lines = vec![headline(operating)];
    let around = operating.inside_instability;
    let band = around.and_then(|index| report.instabilities.get(index));
    lines.extend(band.map(inside));
    if answer == Answer::OutsideSweep {
        lines.push("  widen `sweep` so that it includes operating_rpm".to_owned());
    }
    if let (Some(growth), Some(hz)) = (operating.growth_per_s, operating.frequency_hz) {
        lines.push(format!("  {}", fastest(report, growth, hz, band.is_some())));
    }
    if let Some([from, to]) = operating.safe_window_rpm {
        lines.push(format!(
            "  window without instability: {from:.1} to {to:.1} rpm{}",
            end_of_window(report, to)
        ));
    }
    lines.extend(at_critical_speed(report, operating));
    lines.extend(rule(operating));
    lines
}

/// Describes the band that makes the saw unstable at its operating speed.
fn inside(band: &InstabilityBand) -> String {
    let waves = band.name.as_ref();
    let waves = waves.map_or(String::new(), |name| format!(",\n    {name}"));
    format!(
        "  inside the band of {} from {:.1} to {:.1} rpm{waves}",
        band.kind, band.from_rpm, band.to_rpm
    )
}

/// Describes the motion with the largest growth rate, in 1/s, at the operating speed, which may be inside a band.
fn fastest(report: &Report, growth: f64, hz: f64, is_inside: bool) -> String {
    let threshold = report.flutter_threshold_per_s;
    if is_inside && growth <= 0.0 {
        return "the speed is an edge of this band, where the growth is zero".to_owned();
    }
    if growth > 0.0 {
        let compared = match growth >= threshold {
            true => "reaches",
            false => "is below",
        };
        return format!(
            "fastest growth {} 1/s at {hz:.2} Hz {compared} the threshold of {threshold} 1/s",
            shown_to(3, growth)
        );
    }
    match growth < 0.0 {
        true => format!(
            "every motion decays, the slowest by {} 1/s at {hz:.2} Hz",
            shown_to(3, -growth)
        ),
        false if is_damped(report) => {
            format!("no motion grows; the one at {hz:.2} Hz does not decay either")
        }
        false => "no motion grows (the scene has no damping that would make it decay)".to_owned(),
    }
}

/// Warns of the critical speed close to the operating speed, if there is one.
fn at_critical_speed(report: &Report, operating: &OperatingPoint) -> Option<String> {
    let rpm = operating.at_critical_rpm?;
    let critical = report.critical_speeds.iter().find(|c| c.rpm == rpm);
    let name = critical.map_or(String::new(), |c| format!(" ({})", c.name));
    let deflection = side_force_in_words(operating.rpm, operating.side_force_factor);
    let deflection = deflection.map_or(String::new(), |words| format!(": {words}"));
    let line = format!(
        "  within {:.0} % of the critical speed {rpm:.1} rpm{name}{deflection}",
        100.0 * CRITICAL_MARGIN
    );
    Some(wrapped(&line))
}

/// Compares the operating speed with the 85 % rule; `None` without a critical speed.
fn rule(operating: &OperatingPoint) -> Option<String> {
    let (ratio, lowest_rpm) = operating
        .of_lowest_critical
        .zip(operating.lowest_critical_rpm)?;
    let verdict = match operating.within_limit {
        Some(false) => "breaks",
        _ => "keeps",
    };
    Some(format!(
        "  {:.0} % of the lowest critical speed {verdict} the {:.0} % rule (at most {:.0} rpm)",
        100.0 * ratio,
        100.0 * operating.limit,
        operating.limit * lowest_rpm
    ))
}

/// The answer for a scene without operating speed: the speed up to which the saw is stable.
fn up_to(report: &Report) -> Vec<String> {
    let counted = report.instabilities.iter().flat_map(|b| &b.counted_rpm);
    let first = counted.map(|stretch| stretch[0]).reduce(f64::min);
    let from = report.campbell.from_rpm;
    let answer = match first {
        Some(first) if first > from => {
            format!("No instability from {from:.0} to {first:.1} rpm")
        }
        Some(first) => format!("Unstable from {first:.1} rpm on"),
        None => format!(
            "No instability from {from:.0} to {:.0} rpm, the end of the sweep",
            report.campbell.to_rpm
        ),
    };
    let lowest = report.critical_speeds.first().map(|critical| {
        format!(
            "  lowest critical speed {:.1} rpm ({})",
            critical.rpm, critical.name
        )
    });
    let lacking = "  (the scene has no operating_rpm to compare with it)".to_owned();
    let lines = [Some(answer), lowest, Some(lacking)];
    lines.into_iter().flatten().collect()
}

/// Flutter speed, and onset of the first flutter band of any growth.
fn flutter(report: &Report) -> Vec<String> {
    let threshold = report.flutter_threshold_per_s;
    let speed = match report.flutter_speed_rpm {
        Some(rpm) => {
            let is_its = |band: &&InstabilityBand| {
                band.kind == InstabilityKind::Flutter
                    && band.counted_rpm.iter().any(|counted| counted[0] == rpm)
            };
            let band = report.instabilities.iter().find(is_its);
            let error = band.and_then(|band| band.estimated_relative_error);
            let error = error.map_or(String::new(), |share| format!(" ± {:.1}", share * rpm));
            format!("Flutter speed: {rpm:.0} rpm{error} (growth of {threshold} 1/s or more)")
        }
        None => format!(
            "No flutter of {threshold} 1/s or more up to {:.0} rpm",
            report.campbell.to_rpm
        ),
    };
    let first = report
        .first_merge_rpm
        .map(|rpm| format!("First flutter band, including weak ones: {rpm:.0} rpm"));
    [Some(speed), first].into_iter().flatten().collect()
}

/// States why the window without instability ends at a speed; empty if a band begins there.
fn end_of_window(report: &Report, rpm: f64) -> &'static str {
    let counted = |band: &InstabilityBand| band.counted_rpm.iter().any(|[from, _]| *from == rpm);
    match report.instabilities.iter().any(counted) {
        _ if rpm >= report.campbell.to_rpm => ", where the sweep ends",
        true => "",
        false => ",\n    5 % short of a critical speed",
    }
}

/// States whether growth above the threshold is possible in unproven intervals of speed that matter for the
/// answer: below the flutter speed, or at the operating speed.
fn hidden(
    stretches_rpm: &[[f64; 2]],
    threshold_per_s: f64,
    flutter_rpm: Option<f64>,
    operating_rpm: Option<f64>,
) -> String {
    let matters = |[from, to]: &&[f64; 2]| {
        flutter_rpm.is_none_or(|flutter| *from < flutter)
            || operating_rpm.is_some_and(|rpm| (*from..=*to).contains(&rpm))
    };
    let mut stretches = stretches_rpm.iter().filter(matters);
    let growth = format!("growth of {threshold_per_s} 1/s or more");
    let Some([from, to]) = stretches.next() else {
        let place = match (flutter_rpm, operating_rpm) {
            (Some(_), Some(_)) => "below the flutter speed or at the operating speed",
            (Some(_), None) => "below the flutter speed",
            (None, _) => "in the sweep",
        };
        return format!("Unproven speeds have no {growth} {place} (estimated)");
    };
    let more = match stretches.count() {
        0 => String::new(),
        1 => " and in one more interval".to_owned(),
        count => format!(" and in {count} more intervals"),
    };
    format!("Unproven speeds may have a {growth} at {from:.1} to {to:.1} rpm{more} (estimated)")
}

/// Writes certificate, backward errors, estimated error of the critical speeds, and warnings.
pub fn trust(text: &mut String, report: &Report) -> Result {
    writeln!(text)?;
    let certificate = &report.certificate;
    sentence(text, &format!("Certificate: {}", certificate.statement))?;
    if certificate
        .unproven_growth_per_s
        .is_some_and(|growth| growth > 0.0)
    {
        let line = hidden(
            &certificate.unproven_counting_rpm,
            report.flutter_threshold_per_s,
            report.flutter_speed_rpm,
            report.operating.as_ref().map(|operating| operating.rpm),
        );
        sentence(text, &line)?;
    }
    let error = certificate.max_backward_error;
    let listed = certificate
        .max_listed_backward_error
        .map_or(String::new(), |error| {
            format!("; of an eigenvalue listed: {error:.0e}")
        });
    writeln!(
        text,
        "Largest backward error of a mode: {error:.0e}{listed}"
    )?;
    if let Some(error) = report.accuracy.estimated_relative_error {
        writeln!(
            text,
            "Estimated error of the critical speeds: {} % ({} functions)",
            shown_to(2, 100.0 * error),
            report.accuracy.degrees_of_freedom
        )?;
    }
    let accuracy = &report.accuracy;
    let complete = format!(
        "Waves of up to {} nodal diameters; no wave with more stands still up to {:.0} rpm",
        accuracy.max_diameters, accuracy.complete_to_rpm
    );
    sentence(text, &complete)?;
    each(text, "Warning", &report.warnings)
}

#[cfg(test)]
mod tests {
    use super::hidden;

    #[test]
    fn unproven_growth_is_stated_where_it_would_change_an_answer() {
        let says = |stretches: &[[f64; 2]], flutter, operating| {
            hidden(stretches, 0.25, flutter, operating)
                .replace("Unproven speeds have ", "")
                .replace("Unproven speeds may have ", "")
                .replace(" (estimated)", "")
        };
        let stretches = [[1530.0, 1531.0], [2560.0, 2561.0]];
        assert_eq!(
            says(&stretches[1..], Some(2256.0), Some(1250.0)),
            "no growth of 0.25 1/s or more below the flutter speed or at the operating speed"
        );
        assert_eq!(
            says(&stretches, Some(2256.0), None),
            "a growth of 0.25 1/s or more at 1530.0 to 1531.0 rpm"
        );
        assert_eq!(
            says(&stretches[1..], Some(2256.0), Some(2560.5)),
            "a growth of 0.25 1/s or more at 2560.0 to 2561.0 rpm"
        );
        assert_eq!(
            says(&stretches, None, None),
            "a growth of 0.25 1/s or more at 1530.0 to 1531.0 rpm and in one more interval"
        );
        assert_eq!(
            says(&[], None, None),
            "no growth of 0.25 1/s or more in the sweep"
        );
    }
}
