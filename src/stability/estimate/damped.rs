//! Growth of a damped blade on small systems.

use faer::c64;

use crate::model::system::GyroscopicSystem;
use crate::modes::{DescribedMode, SpectrumError, companion_eigenpairs};
use crate::stability::band::Instability;

/// Number of subdivisions of twice the width of a damped band in the search for its largest growth. On random
/// saws the true error was up to 0.9 times the estimate; with half as many subdivisions, or with two modes
/// fewer, it was up to 1.7 times the estimate.
const DAMPED_LOOKS: usize = 48;

/// Largest growth rate, in 1/s, of a small system near a band of a damped blade, of the two modes nearest to the
/// growing one.
pub fn fastest(
    system: &GyroscopicSystem,
    mode: &DescribedMode,
    band: &Instability,
) -> Result<f64, SpectrumError> {
    let Instability {
        from_rad_per_s: from,
        to_rad_per_s: to,
        peak_rad_per_s: peak,
        ..
    } = *band;
    // If the largest growth is at an end of the band, the range cuts the band there, so that no speed beyond
    // this end is examined.
    let below = if peak > from { to - from } else { 0.0 };
    let above = if peak < to { to - from } else { 0.0 };
    let mut growth = f64::NEG_INFINITY;
    for look in 0..=DAMPED_LOOKS {
        let share = look as f64 / DAMPED_LOOKS as f64;
        let speed = peak - below + share * (below + above);
        let mut values: Vec<c64> = companion_eigenpairs(system, speed.max(0.0))?
            .into_iter()
            .map(|(value, _)| value)
            .collect();
        let away = |value: &c64| (value - mode.mode.lambda).norm();
        values.sort_by(|x, y| away(x).total_cmp(&away(y)));
        growth = values
            .iter()
            .take(2)
            .fold(growth, |top, value| top.max(value.re));
    }
    Ok(growth)
}
