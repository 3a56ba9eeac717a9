//! Largest growth rate of a small system over a band.

use faer::c64;

use crate::model::system::GyroscopicSystem;
use crate::modes::{DescribedMode, SpectrumError, companion_eigenpairs};
use crate::stability::band::Instability;

/// Number of parts of a band in the search for its largest growth. On four saws the parabola through the largest value and its neighbours
/// gave the peaks of 80 bands of flutter to 2e-5.
const LOOKS: usize = 24;

/// Largest growth rate, in 1/s, of a small system over a band, of the two modes nearest to the growing one. Beyond the band another one
/// may begin, with other modes.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub fn fastest(
    system: &GyroscopicSystem,
    mode: &DescribedMode,
    band: &Instability,
) -> Result<f64, SpectrumError> {
    let range = band.range();
    let growth: Result<Vec<f64>, SpectrumError> = (0..=LOOKS)
        .map(|look| {
            let share = look as f64 / LOOKS as f64;
            let pairs = companion_eigenpairs(system, range.from_rad_per_s + share * range.width())?;
            let mut values: Vec<c64> = pairs.into_iter().map(|(value, _)| value).collect();
            let away = |value: &c64| (value - mode.mode.lambda).norm();
            values.sort_by(|x, y| away(x).total_cmp(&away(y)));
            let nearest = values.iter().take(2).map(|value| value.re);
            Ok(nearest.fold(f64::NEG_INFINITY, f64::max))
        })
        .collect();
    Ok(highest(&growth?))
}

/// The largest of evenly spaced values, by the parabola through it and its neighbours.
fn highest(values: &[f64]) -> f64 {
    let ends = [values.first(), values.last()].into_iter().flatten();
    let peaks = values.windows(3).filter_map(|near| {
        let [x, y, z] = near else { return None };
        let curvature = x - 2.0 * y + z;
        (y > x && y >= z).then(|| y - (z - x).powi(2) / (8.0 * curvature))
    });
    ends.copied().chain(peaks).fold(f64::NEG_INFINITY, f64::max)
}

#[cfg(test)]
mod tests {
    use super::highest;

    #[test]
    fn the_top_of_a_parabola_is_found_between_the_looks_and_that_of_a_line_at_its_end() {
        let parabola: Vec<f64> = (0..8).map(|k| 2.0 - (f64::from(k) - 3.3).powi(2)).collect();
        assert!((highest(&parabola) - 2.0).abs() < 1e-12);
        assert_eq!(highest(&[-3.0, -2.0, -1.0]), -1.0);
    }
}
