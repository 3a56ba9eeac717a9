//! The lines below the figure on its accuracy.

use super::plan::{CERTIFICATE_ABOVE_FOOT, FACTS_ABOVE_FOOT, HEIGHT, PLOT_LEFT, WIDTH};
use crate::analyses::campbell::Report;
use crate::analyses::campbell::slot_remarks::of_model;
use crate::page::figure::axis::{raised, two_digits};
use crate::page::figure::canvas::{Anchor, Lettering, Sheet};
use crate::page::figure::style::{ALARM, BETWEEN_FACTS, LABEL_SIZE, MARGIN, QUIET, shorten_label};

/// Writes the statement of the certificate, in red if a comparison fails, and a line on errors and size of the model.
pub fn draw(sheet: &mut Sheet, report: &Report) {
    let write = |sheet: &mut Sheet, above_foot: f64, text: &str, colour| {
        let text = shorten_label(text, f64::from(WIDTH) - MARGIN - PLOT_LEFT);
        let letters = Lettering::regular(LABEL_SIZE, colour, Anchor::Start);
        sheet.text([PLOT_LEFT, f64::from(HEIGHT) - above_foot], letters, &text);
    };
    let certificate = &report.certificate;
    let colour = if certificate.is_clean() { QUIET } else { ALARM };
    if certificate.speeds_checked > 0 {
        write(
            sheet,
            CERTIFICATE_ABOVE_FOOT,
            &certificate.statement,
            colour,
        );
    }
    let facts = facts(report).join(BETWEEN_FACTS);
    write(sheet, FACTS_ABOVE_FOOT, &facts, QUIET);
}

fn facts(report: &Report) -> Vec<String> {
    let (certificate, accuracy) = (&report.certificate, &report.accuracy);
    let mut facts = Vec::new();
    if let Some(bound) = power_of_ten_above(certificate.max_backward_error) {
        facts.push(format!("backward error below {bound}"));
    }
    let functions = format!("{} functions", accuracy.degrees_of_freedom);
    let error = accuracy.estimated_relative_error;
    facts.push(match error.filter(|_| !report.critical_speeds.is_empty()) {
        Some(error) => format!(
            "{functions}, critical speeds{} within {}",
            of_model(&report.scene),
            percent(error)
        ),
        None => functions,
    });
    facts
}

/// A positive number rounded up to one digit: "2·10⁻⁸"; `None` for other numbers.
fn power_of_ten_above(value: f64) -> Option<String> {
    if !(value.is_finite() && value > 0.0) {
        return None;
    }
    let power = value.log10().floor();
    let leading = (value / 10f64.powf(power) - 1e-9).ceil();
    let (digit, exponent) = if leading >= 10.0 {
        (1.0, power + 1.0)
    } else {
        (leading.max(1.0), power)
    };
    let raised = raised(&exponent.to_string());
    Some(if digit == 1.0 {
        format!("10{raised}")
    } else {
        format!("{digit}·10{raised}")
    })
}

/// A share in percent with two digits, at least 0.001 %.
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
