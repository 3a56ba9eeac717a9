//! Speeds on both sides of critical speeds, at which λ² passes through zero.

use crate::model::plate::Plate;
use crate::model::scene::SpeedRange;
use crate::model::tuning::Tuned;
use crate::modes::NamedCriticalSpeed;

/// Relative distance of the search from critical speeds: λ² passes through zero there and is accurate only to
/// 1e-15 of the stiffness.
pub const CRITICAL_GAP: Tuned = Tuned::new("stability/critical_sides::CRITICAL_GAP", 5e-6);
/// Critical speeds at a smaller relative distance are passed in one step of the search. The divergence
/// between them grows by less than 0.01 1/s; the inertia of the stiffness shows that it exists.
const CRITICAL_GROUP: f64 = 2e-5;
/// Two critical speeds within this relative distance are a double one, of a wave that can have any angular
/// position, as on a free blade.
const DOUBLE: f64 = 1e-9;
/// Relative distance of the search from a double critical speed. Both λ pass through zero in proportion to Ω
/// − Ω_c, not to its square root, and exceed rounding only at a larger distance.
const DOUBLE_GAP: f64 = 1e-4;

/// Whether two critical speeds are a double one.
pub fn is_double(one: f64, other: f64) -> bool {
    (other / one - 1.0).abs() < DOUBLE
}

/// Relative distance of the search from a critical speed.
fn critical_gap(critical: &[f64], index: usize) -> f64 {
    let is_same =
        |other: Option<&f64>| other.is_some_and(|other| is_double(critical[index], *other));
    let below = index.checked_sub(1).and_then(|below| critical.get(below));
    if is_same(below) || is_same(critical.get(index + 1)) {
        DOUBLE_GAP
    } else {
        CRITICAL_GAP.get()
    }
}

/// Adds both sides of each group of critical speeds in the range.
pub fn with_critical_speeds(
    plate: &Plate,
    critical: &[NamedCriticalSpeed],
    range: SpeedRange,
    mut speeds: Vec<f64>,
) -> Vec<f64> {
    let critical: Vec<f64> = critical.iter().map(|c| c.speed_rad_per_s).collect();
    if plate.is_axisymmetric() {
        // A wave of the free blade passes through zero without diverging. Next to this zero its Krein sign is
        // determined by rounding errors, so that no speed may be there.
        let clear = |s: &f64| {
            critical
                .iter()
                .all(|c| (s / c - 1.0).abs() > 0.1 * DOUBLE_GAP)
        };
        speeds.retain(clear);
        let beside = critical
            .iter()
            .flat_map(|c| [c * (1.0 - DOUBLE_GAP), c * (1.0 + DOUBLE_GAP)]);
        speeds.extend(beside.filter(|s| (range.from_rad_per_s..range.to_rad_per_s).contains(s)));
        speeds.sort_by(f64::total_cmp);
        speeds.dedup_by(|x, y| (*x / *y - 1.0).abs() < 1e-9);
        return speeds;
    }
    let mut sides: Vec<f64> = Vec::new();
    let mut previous: Option<f64> = None;
    for (index, &speed) in critical.iter().enumerate() {
        let gap = critical_gap(&critical, index);
        let (below, above) = (speed * (1.0 - gap), speed * (1.0 + gap));
        if below <= range.from_rad_per_s || above >= range.to_rad_per_s {
            continue;
        }
        match previous {
            Some(last) if speed <= last * (1.0 + CRITICAL_GROUP) => {
                sides.pop();
            }
            _ => sides.push(below),
        }
        sides.push(above);
        previous = Some(speed);
    }
    speeds.retain(|speed| {
        let mut gaps = (0..critical.len()).map(|k| critical_gap(&critical, k) + CRITICAL_GROUP);
        critical
            .iter()
            .all(|c| gaps.next().is_some_and(|gap| (speed / c - 1.0).abs() > gap))
    });
    speeds.extend(sides);
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    speeds
}
