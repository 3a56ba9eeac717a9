//! Answer, tables and certificate of a Campbell diagram.

use super::Table;
use crate::report::{InstabilityKind, Report};
use crate::summary::answer;
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
            percent(critical.estimated_relative_error),
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
        vec![
            match band.kind {
                InstabilityKind::Divergence => "divergence".to_owned(),
                InstabilityKind::Flutter => "flutter".to_owned(),
            },
            format!("{:.1}", band.from_rpm),
            format!("{:.1}", band.to_rpm),
            shown_to(3, band.peak_growth_per_s),
            format!("{:.2}", band.frequency_hz),
            if band.counted_rpm.is_empty() {
                "no"
            } else {
                "yes"
            }
            .to_owned(),
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
    let ratio = |ratio: f64| format!("{} %", shown_to(3, 1e2 * ratio));
    let rows = report.modes_at_rest.iter().map(|mode| {
        let row = [format!("{:.2}", mode.frequency_hz), mode.name.clone()];
        row.into_iter()
            .chain(mode.damping_ratio.map(ratio))
            .collect()
    });
    let is_damped = report
        .modes_at_rest
        .iter()
        .any(|m| m.damping_ratio.is_some());
    let columns = ["frequency [Hz]", "mode", "damping ratio"];
    Table {
        title: "Modes at rest".to_owned(),
        columns: columns[..if is_damped { 3 } else { 2 }].to_vec(),
        rows: rows.collect(),
    }
}

fn percent(error: Option<f64>) -> String {
    error.map_or(String::new(), |error| {
        format!("{} %", shown_to(2, 1e2 * error))
    })
}

/// Sentences on the certificate, the backward errors, and the estimated error of the critical speeds.
pub fn certificate(report: &Report) -> Vec<String> {
    let certificate = &report.certificate;
    let mut lines = vec![certificate.statement.clone()];
    if let Some(share) = certificate.proven_share {
        let percent = shown_to(4, 1e2 * share);
        lines.push(format!(
            "{percent} % of the sweep is proven to have no instability that is not listed."
        ));
    }
    lines.push(format!(
        "Largest backward error of a mode: {:.0e}.",
        certificate.max_backward_error
    ));
    let accuracy = &report.accuracy;
    if let Some(error) = accuracy.estimated_relative_error {
        lines.push(format!(
            "Estimated error of the critical speeds: {} %, with {} functions.",
            shown_to(2, 1e2 * error),
            accuracy.degrees_of_freedom
        ));
    }
    lines
}
