//! Speeds at which the response is computed.

use crate::model::evenly_spaced;
use crate::model::scene::SpeedRange;

/// Number of evenly spaced speeds.
const SPEEDS: usize = 481;
/// Smallest and largest distance of added speeds from a resonance, relative to it.
const NEAR: (f64, f64) = (1e-5, 3e-2);
/// Number of added speeds on either side of a resonance.
const BESIDE: usize = 10;

/// Evenly spaced speeds, and the operating speed.
pub(super) fn even(range: SpeedRange, operating: Option<f64>) -> Vec<f64> {
    let mut speeds = evenly_spaced(range.ends(), SPEEDS);
    speeds.extend(operating);
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    speeds
}

/// The resonances and speeds near them, each nearer to its own resonance than to any other.
pub(super) fn near(range: SpeedRange, resonances: &[f64]) -> Vec<f64> {
    let ratio = (NEAR.1 / NEAR.0).powf(1.0 / (BESIDE - 1) as f64);
    let offsets: Vec<f64> = (0..BESIDE).map(|k| NEAR.0 * ratio.powi(k as i32)).collect();
    let mut speeds = Vec::new();
    for (place, speed) in resonances.iter().enumerate() {
        let below = place.checked_sub(1).map_or(range.from_rad_per_s, |below| {
            0.5 * (resonances[below] + speed)
        });
        let above = resonances
            .get(place + 1)
            .map_or(range.to_rad_per_s, |above| 0.5 * (speed + above));
        let beside = offsets
            .iter()
            .flat_map(|off| [speed * (1.0 - off), speed * (1.0 + off)]);
        speeds.extend(beside.filter(|near| (below..=above).contains(near)));
        speeds.push(*speed);
    }
    speeds
}
