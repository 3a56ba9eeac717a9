//! Stable, divergence and flutter areas over one number and the speed, or over two numbers.

mod over_numbers;
mod over_speed;

use super::canvas::{Frame, Sheet};
use super::style::BETWEEN_FACTS;
use crate::analyses::map::MapReport;

const WIDTH: u32 = 1100;
const HEIGHT: u32 = 780;
const PANEL: Frame = Frame {
    left: 104.0,
    top: 96.0,
    right: 1064.0,
    bottom: 650.0,
};
/// Baselines of the two lines of the key.
const KEYS: [f64; 2] = [734.0, 758.0];

pub fn sheet(report: &MapReport) -> Sheet {
    match &report.y {
        Some(y) => over_numbers::sheet(report, y),
        None => over_speed::sheet(report),
    }
}

fn facts(report: &MapReport) -> String {
    let count = report.saws.len();
    let judged = report.rpm.map(|rpm| format!("areas at {rpm:.0} rpm"));
    let judged = judged.filter(|_| report.y.is_some());
    let lost = report.saws.iter().filter(|saw| saw.not_analysed.is_some());
    let lost = match lost.count() {
        0 => None,
        lost => Some(format!("{lost} not analysed")),
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
    facts
        .into_iter()
        .flatten()
        .collect::<Vec<_>>()
        .join(BETWEEN_FACTS)
}

#[cfg(test)]
mod tests;
