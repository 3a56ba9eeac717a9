//! Influence of the numbers of a scene on its speeds, in words, for the fields of the form.

use serde::Serialize;

use crate::analyses::campbell::{Report, Sensitivity};

/// Influence of a number.
#[derive(Debug, Serialize)]
pub struct Influence {
    /// JSON path of the number.
    path: String,
    /// Ratio to the largest influence.
    share: f64,
    /// Changes of the speeds; empty if there are none.
    words: String,
}

/// Returns the influences on the first critical speed and the flutter speed.
pub fn influences(entries: &[Sensitivity], report: &Report) -> Vec<Influence> {
    let critical = report.critical_speeds.first().map(|critical| critical.rpm);
    let flutter = report.flutter_rpm;
    let changes: Vec<[Option<f64>; 2]> = entries
        .iter()
        .map(|entry| {
            let of_critical = entry.of_first_critical();
            let of_flutter = entry.flutter_speed_percent;
            let rpm = |percent: Option<f64>, speed: Option<f64>| Some(0.01 * percent? * speed?);
            [rpm(of_critical, critical), rpm(of_flutter, flutter)]
        })
        .collect();
    let size = |change: &[Option<f64>; 2]| {
        let sizes = change.iter().flatten().map(|rpm| rpm.abs());
        sizes.fold(0.0, f64::max)
    };
    let largest = changes.iter().map(size).fold(f64::MIN_POSITIVE, f64::max);
    let influences = entries
        .iter()
        .zip(&changes)
        .map(|(entry, change)| Influence {
            path: entry.parameter.clone(),
            share: size(change) / largest,
            words: words(entry, change),
        });
    influences.collect()
}

fn words(entry: &Sensitivity, change: &[Option<f64>; 2]) -> String {
    let named = ["critical", "flutter"].into_iter().zip(change);
    let parts: Vec<String> = named
        .filter_map(|(name, rpm)| Some(format!("{name} {}", signed((*rpm)?))))
        .collect();
    if parts.is_empty() {
        String::new()
    } else {
        let step = entry.change.replace("1 degree", "1°");
        format!("+{step}: {} rpm", parts.join(", "))
    }
}

fn signed(rpm: f64) -> String {
    let size = if rpm.abs() < 9.95 {
        format!("{:.1}", rpm.abs())
    } else {
        format!("{:.0}", rpm.abs())
    };
    match (size.as_str(), rpm < 0.0) {
        ("0.0", _) => "±0".to_owned(),
        (_, true) => format!("−{size}"),
        (_, false) => format!("+{size}"),
    }
}
