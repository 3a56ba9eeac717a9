//! Stable, divergence and flutter areas over one number and the speed, or over two numbers.

mod over_numbers;
mod over_speed;

use crate::analyses::map::MapReport;
use crate::page::figure::chart_data::ChartData;

/// Height of the panel, relative to one of usual height.
const SHARE: f64 = 1.45;

/// The areas, as numbers.
pub fn chart(report: &MapReport) -> ChartData {
    let (mut panel, key) = match &report.y {
        Some(y) => (over_numbers::panel(report, y), over_numbers::key(report)),
        None => (over_speed::panel(report), over_speed::key(report)),
    };
    panel.share = SHARE;
    ChartData {
        key,
        ..ChartData::new(&report.scene.name, facts(report), vec![panel])
    }
}

fn facts(report: &MapReport) -> Vec<String> {
    let count = report.saws.len();
    let judged = report
        .rpm
        .map(|rpm| format!("areas at {rpm:.0} rpm"))
        .filter(|_| report.y.is_some());
    let blank = report.saws.iter().filter(|saw| saw.not_analysed.is_some());
    let lost = match blank.count() {
        0 => None,
        blank => Some(format!("{blank} not analysed")),
    };
    let threshold = format!(
        "flutter counts from {} 1/s on",
        report.flutter_threshold_per_s
    );
    let facts = [
        Some(report.condition.clone()),
        Some(format!("{count} saws")),
        judged,
        Some(threshold),
        lost,
    ];
    facts.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests;
