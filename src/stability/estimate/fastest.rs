//! Largest growth rate of a small system near the peak of a band.

use faer::c64;

use crate::model::system::GyroscopicSystem;
use crate::modes::{DescribedMode, SpectrumError, companion_eigenpairs};
use crate::stability::band::Instability;

/// Number of steps of a climb over the width of a band, and the largest number of steps.
const STEPS: usize = 48;

/// Largest growth rate, in 1/s, of a small system, uphill from the peak of a band, of the two modes nearest to the growing one: further away
/// other modes may grow faster.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
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
    let growth = |speed: f64| -> Result<f64, SpectrumError> {
        // If the largest growth is at an end of the band, the range cuts the band there, so that no speed beyond this end is examined.
        if (peak == from && speed < from) || (peak == to && speed > to) {
            return Ok(f64::NEG_INFINITY);
        }
        let pairs = companion_eigenpairs(system, speed.max(0.0))?;
        let mut values: Vec<c64> = pairs.into_iter().map(|(value, _)| value).collect();
        let away = |value: &c64| (value - mode.mode.lambda).norm();
        values.sort_by(|x, y| away(x).total_cmp(&away(y)));
        let nearest = values.iter().take(2).map(|value| value.re);
        Ok(nearest.fold(f64::NEG_INFINITY, f64::max))
    };
    highest(growth, peak, (to - from) / STEPS as f64)
}

/// The largest value of a function uphill from a place: the top of the parabola through the largest of even steps and its neighbours.
fn highest<E>(value: impl Fn(f64) -> Result<f64, E>, mut place: f64, step: f64) -> Result<f64, E> {
    let [mut below, mut top, mut above] =
        [value(place - step)?, value(place)?, value(place + step)?];
    for _ in 0..STEPS {
        if above > top {
            place += step;
            [below, top, above] = [top, above, value(place + step)?];
        } else if below > top {
            place -= step;
            [below, top, above] = [value(place - step)?, below, top];
        } else {
            break;
        }
    }
    let curvature = below - 2.0 * top + above;
    let is_smooth = curvature.is_finite() && curvature < 0.0;
    Ok(if is_smooth {
        top - (above - below).powi(2) / (8.0 * curvature)
    } else {
        top
    })
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::highest;

    #[test]
    fn the_top_of_a_parabola_is_found_between_the_steps_and_that_of_a_slope_at_its_end() {
        let parabola = |x: f64| Ok::<f64, Infallible>(2.0 - (x - 3.3).powi(2));
        for from in [0.0, 3.0, 7.0] {
            let Ok(top) = highest(parabola, from, 1.0);
            assert!((top - 2.0).abs() < 1e-12, "{top}");
        }
        let slope = |x: f64| Ok::<f64, Infallible>(if x > 0.0 { f64::NEG_INFINITY } else { x });
        let Ok(top) = highest(slope, 0.0, 1.0);
        assert_eq!(top, 0.0);
    }
}
