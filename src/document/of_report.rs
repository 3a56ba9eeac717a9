//! Answer, tables and certificate of a Campbell diagram.

use super::Table;
use crate::report::Report;
use crate::summary::{answer, is_damped};
use crate::text::shown_to;

/// Lines of the answer, without the line breaks and indents of the summary.
pub fn answer_lines(report: &Report) -> Vec<String> {
    let lines = answer(report).into_iter();
    lines
        .map(|line| line.split_whitespace().collect::<Vec<_>>().join(" "))
        .collect()
}

pub fn tables(report: &Report) -> Vec<Table> {
    let all = [critical_speeds(report), bands(report), at_rest(report)];
    all.into_iter()
        .filter(|table| !table.rows.is_empty())
        .collect()
}

fn critical_speeds(report: &Report) -> Table {
    let rows = report.critical_speeds.iter().map(|critical| {
        vec![
            format!("{:.1}", critical.rpm),
            critical.name.clone(),
            critical
                .estimated_relative_error
                .map_or_else(String::new, |error| percent(2, error)),
        ]
    });
    Table {
        title: match report.critical_speeds_without_damping {
            true => "Critical speeds of the saw without its damping".to_owned(),
            false => "Critical speeds".to_owned(),
        },
        columns: vec!["speed [rpm]", "wave that stands still", "estimated error"],
        rows: rows.collect(),
    }
}

fn bands(report: &Report) -> Table {
    let rows = report.instabilities.iter().map(|band| {
        let counts = if band.counted_rpm.is_empty() {
            "no"
        } else {
            "yes"
        };
        vec![
            band.kind.to_string(),
            format!("{:.1}", band.from_rpm),
            format!("{:.1}", band.to_rpm),
            shown_to(3, band.peak_growth_per_s),
            format!("{:.2}", band.frequency_hz),
            counts.to_owned(),
            band.name.clone().unwrap_or_default(),
        ]
    });
    Table {
        title: "Bands of instability".to_owned(),
        columns: vec![
            "kind",
            "from [rpm]",
            "to [rpm]",
            "growth [1/s]",
            "frequency [Hz]",
            "counts",
            "waves",
        ],
        rows: rows.collect(),
    }
}

fn at_rest(report: &Report) -> Table {
    let rows = report.modes_at_rest.iter().map(|mode| {
        let row = [format!("{:.2}", mode.frequency_hz), mode.name.clone()];
        let ratio = mode.damping_ratio.map(|ratio| percent(3, ratio));
        row.into_iter().chain(ratio).collect()
    });
    let columns = ["frequency [Hz]", "mode", "damping ratio"];
    Table {
        title: "Modes at rest".to_owned(),
        columns: columns[..if is_damped(report) { 3 } else { 2 }].to_vec(),
        rows: rows.collect(),
    }
}

/// A share in percent with a number of significant digits.
fn percent(digits: usize, share: f64) -> String {
    format!("{} %", shown_to(digits, 1e2 * share))
}

/// Sentences on the certificate, the backward errors, and the estimated error of the critical speeds.
pub fn certificate(report: &Report) -> Vec<String> {
    let certificate = &report.certificate;
    let mut lines = vec![certificate.statement.clone()];
    if let Some(share) = certificate.proven_share {
        lines.push(format!(
            "{} of the sweep is proven to have no instability that is not listed.",
            percent(4, share)
        ));
    }
    lines.push(format!(
        "Largest backward error of a mode: {:.0e}.",
        certificate.max_backward_error
    ));
    let accuracy = &report.accuracy;
    if let Some(error) = accuracy.estimated_relative_error {
        lines.push(format!(
            "Estimated error of the critical speeds: {}, with {} functions.",
            percent(2, error),
            accuracy.degrees_of_freedom
        ));
    }
    lines
}
