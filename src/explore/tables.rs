//! Tables of the numbers of a diagram.

use serde::Serialize;

use crate::report::{InstabilityBand, InstabilityKind, Report};
use crate::summary::{is_damped, numbered};
use crate::text::shown_to;

/// A table of texts.
#[derive(Debug, Serialize)]
pub struct Table {
    caption: String,
    heads: Vec<&'static str>,
    rows: Vec<Vec<String>>,
}

/// Number of modes at rest that are listed.
const MODES: usize = 12;
/// Text in place of a missing number or name.
const NONE: &str = "–";

/// Returns the tables of critical speeds, bands and modes at rest.
pub fn tables(report: &Report) -> Vec<Table> {
    vec![critical_speeds(report), bands(report), at_rest(report)]
}

fn critical_speeds(report: &Report) -> Table {
    let undamped = match report.critical_speeds_without_damping {
        true => " of the saw without its damping",
        false => "",
    };
    let rows = report.critical_speeds.iter().map(|critical| {
        let branch = critical.branch.map_or(NONE.to_owned(), |b| b.to_string());
        vec![
            format!("{:.1}", critical.rpm),
            critical.name.clone(),
            branch,
        ]
    });
    Table {
        caption: format!("Critical speeds{undamped}"),
        heads: vec!["rpm", "wave", "branch"],
        rows: rows.collect(),
    }
}

fn bands(report: &Report) -> Table {
    let row = |band: &InstabilityBand| {
        let kind = match band.kind {
            InstabilityKind::Divergence => "divergence",
            InstabilityKind::Flutter => "flutter",
        };
        let is_open = !band.closed && band.to_rpm >= report.campbell.to_rpm;
        let beyond = if is_open { " …" } else { "" };
        let branches: Vec<String> = band.branches.iter().map(usize::to_string).collect();
        vec![
            kind.to_owned(),
            format!("{:.1}", band.from_rpm),
            format!("{:.1}{beyond}", band.to_rpm),
            shown_to(3, band.peak_growth_per_s),
            format!("{:.2}", band.frequency_hz),
            band.name.clone().unwrap_or(NONE.to_owned()),
            branches.join(", "),
        ]
    };
    Table {
        caption: "Bands of instability".to_owned(),
        heads: vec![
            "kind",
            "from rpm",
            "to rpm",
            "growth 1/s",
            "Hz",
            "waves",
            "branches",
        ],
        rows: report.instabilities.iter().map(row).collect(),
    }
}

fn at_rest(report: &Report) -> Table {
    let is_damped = is_damped(report);
    let rows = report.modes_at_rest.iter().take(MODES).map(|mode| {
        let damping = mode
            .damping_ratio
            .map_or(NONE.to_owned(), |zeta| shown_to(3, zeta));
        let mut row = vec![format!("{:.2}", mode.frequency_hz)];
        row.extend(is_damped.then_some(damping));
        row.push(numbered(mode.branch, &mode.name));
        row
    });
    let mut heads = vec!["Hz"];
    heads.extend(is_damped.then_some("ζ"));
    heads.push("mode");
    let overdamped = match report.overdamped_modes_at_rest {
        0 => String::new(),
        count => format!("; {count} others decay without oscillating"),
    };
    Table {
        caption: format!("Modes at rest{overdamped}"),
        heads,
        rows: rows.collect(),
    }
}
