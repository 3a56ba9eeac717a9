//! Speeds at which the response is computed.

use crate::model::scene::ExcitationLine;
use crate::modes::SpectrumError;
use crate::modes::branches::even_speeds;
use crate::stability::{Analysis, crossings};

/// Number of evenly spaced speeds.
const SPEEDS: usize = 481;
/// Smallest and largest distance of added speeds from a resonance, relative to it.
const NEAR: (f64, f64) = (1e-5, 3e-2);
/// Number of added speeds on either side of a resonance.
const BESIDE: usize = 10;
/// First speed of a diagram from rest, as a share of its last speed, so that no order is static.
const LEAST: f64 = 1e-6;

/// Speeds within the sweep at which a natural frequency equals the order times the speed.
pub(super) fn resonances(analysis: &Analysis, order: u32) -> Result<Vec<f64>, SpectrumError> {
    let (from, to) = analysis.range_rad_per_s;
    let mut speeds = match order {
        0 => analysis.critical_rad_per_s(),
        _ => {
            let line = ExcitationLine {
                order,
                tooth_passing: None,
            };
            let found = crossings(&analysis.model, &analysis.chart, &[line])?;
            found.iter().map(|found| found.speed_rad_per_s).collect()
        }
    };
    speeds.retain(|speed| (from..=to).contains(speed));
    speeds.sort_by(f64::total_cmp);
    // Two waves of a free blade, cos nθ and sin nθ, have the same critical speed, which is kept once.
    speeds.dedup_by(|a, b| (*a - *b).abs() <= 1e-9 * *b);
    Ok(speeds)
}

/// Evenly spaced speeds, others near the resonances, and the operating speed.
pub(super) fn speeds(
    range: (f64, f64),
    resonances: impl Iterator<Item = f64>,
    operating: Option<f64>,
) -> Vec<f64> {
    let from = range.0.max(LEAST * range.1);
    let ratio = (NEAR.1 / NEAR.0).powf(1.0 / (BESIDE - 1) as f64);
    let offsets = (0..BESIDE).map(move |k| NEAR.0 * ratio.powi(k as i32));
    let near = resonances.flat_map(|speed| {
        let beside = offsets.clone();
        let beside = beside.flat_map(move |off| [speed * (1.0 - off), speed * (1.0 + off)]);
        beside.chain([speed])
    });
    let mut speeds = even_speeds((from, range.1), SPEEDS);
    let added = near.chain(operating);
    speeds.extend(added.filter(|speed| (from..=range.1).contains(speed)));
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    speeds
}
