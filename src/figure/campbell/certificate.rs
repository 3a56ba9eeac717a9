//! The line at the foot that says how far the figure can be trusted.

use super::super::axis::two_digits;
use super::super::canvas::{Anchor, Lettering, Sheet};
use super::super::is_damped;
use super::super::style::{
    ALARM, BETWEEN_FACTS, LABEL_SIZE, MARGIN, QUIET, Weight, shorten, text_width,
};
use super::{CERTIFICATE_ABOVE_FOOT, HEIGHT, PLOT_LEFT, WIDTH};
use crate::report::Report;

/// Writes the line.
pub fn draw(sheet: &mut Sheet, report: &Report) {
    let baseline = f64::from(HEIGHT) - CERTIFICATE_ABOVE_FOOT;
    let right = f64::from(WIDTH) - MARGIN;
    let mut x = PLOT_LEFT;
    let mut write = |text: &str, colour| {
        let text = shorten(text, LABEL_SIZE, Weight::Regular, right - x);
        let letters = Lettering::regular(LABEL_SIZE, colour, Anchor::Start);
        sheet.text([x, baseline], letters, &text);
        x += text_width(&text, LABEL_SIZE, Weight::Regular);
    };
    let facts = facts(report).join(BETWEEN_FACTS);
    match violation(report) {
        Some(alarm) => {
            write(&alarm, ALARM);
            write(&format!("{BETWEEN_FACTS}{facts}"), QUIET);
        }
        None => write(&facts, QUIET),
    }
}

fn violation(report: &Report) -> Option<String> {
    let certificate = &report.certificate;
    let disagreeing = certificate.disagreeing_rpm();
    let speeds = match disagreeing.len() {
        0 => return None,
        1 => "1 speed".to_owned(),
        many => format!("{many} speeds"),
    };
    let at = match disagreeing[..] {
        [] => String::new(),
        [only] => format!(", {only:.0} rpm"),
        [first, .., last] => format!(", {first:.0} to {last:.0} rpm"),
    };
    Some(
        match is_damped(report) || !certificate.mismatches.is_empty() {
            true => format!("growing modes and bands do not match at {speeds}{at}"),
            false => format!("Krein index does not match at {speeds}{at}"),
        },
    )
}

fn facts(report: &Report) -> Vec<String> {
    let (certificate, accuracy) = (&report.certificate, &report.accuracy);
    let mut facts = Vec::new();
    let checked = certificate.speeds_checked;
    if checked > 0 && certificate.disagreeing_rpm().is_empty() {
        facts.push(match is_damped(report) {
            true => format!("growing modes match the bands at {checked} of {checked} speeds"),
            false => format!("Krein index matches at {checked} of {checked} speeds"),
        });
    }
    if let Some(bound) = power_of_ten_above(certificate.max_backward_error) {
        facts.push(format!("backward error below {bound}"));
    }
    let functions = format!("{} functions", accuracy.degrees_of_freedom);
    let error = accuracy.estimated_relative_error;
    facts.push(match error.filter(|_| !report.critical_speeds.is_empty()) {
        Some(error) => format!("{functions}, critical speeds within {}", percent(error)),
        None => functions,
    });
    facts
}

/// "2·10⁻⁸": rounded up to one digit.
fn power_of_ten_above(value: f64) -> Option<String> {
    if !(value.is_finite() && value > 0.0) {
        return None;
    }
    let exponent = value.log10().floor();
    let digit = (value / 10f64.powf(exponent) - 1e-9).ceil();
    let (digit, exponent) = match digit >= 10.0 {
        true => (1.0, exponent + 1.0),
        false => (digit.max(1.0), exponent),
    };
    let raised: String = format!("{exponent}").chars().map(superscript).collect();
    Some(match digit == 1.0 {
        true => format!("10{raised}"),
        false => format!("{digit}·10{raised}"),
    })
}

fn superscript(letter: char) -> char {
    match letter {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '0' => '⁰',
        '4'..='9' => char::from_u32('⁴' as u32 + (letter as u32 - '4' as u32)).unwrap_or(letter),
        other => other,
    }
}

fn percent(share: f64) -> String {
    format!("{} %", two_digits((100.0 * share.abs()).max(0.001)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_rounded_up_to_one_digit() {
        let bound = |value| power_of_ten_above(value).unwrap();
        assert_eq!(bound(1.294e-8), "2·10⁻⁸");
        assert_eq!(bound(9.3e-9), "10⁻⁸");
        assert_eq!(bound(1e-12), "10⁻¹²");
        assert_eq!(power_of_ten_above(0.0), None);
        assert_eq!(power_of_ten_above(f64::NAN), None);
    }
}
