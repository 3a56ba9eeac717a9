//! Maximum of a smooth function of the speed: the largest growth of a band.

use super::interpolation::Cubic;
use crate::modes::SpectrumError;

/// A value of the function with its slope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Speed, in rad/s.
    pub at: f64,
    /// Value f of the function there.
    pub value: f64,
    /// df/dΩ; not finite if unknown.
    pub slope: f64,
}

/// Samples are added until the cubics predict an increase of the maximum below this share of it: no drawn growth rate may exceed the
/// listed maximum visibly.
const TOLERANCE: f64 = 1e-10;
/// Largest number of added samples.
const MOST_SAMPLES: usize = 24;

/// The sample of the largest value. Samples are added to the given ones, which are at ascending speeds, where
/// the cubics between neighbours predict a larger value; this finds a narrow second hump if the slopes show
/// it; `f` gives one at a speed from those that are known. `None` without samples.
///
/// # Errors
/// The errors of `f`.
pub fn maximize(
    mut samples: Vec<Sample>,
    mut f: impl FnMut(&[Sample], f64) -> Result<Option<Sample>, SpectrumError>,
) -> Result<Option<Sample>, SpectrumError> {
    let greatest = |samples: &[Sample]| {
        let greatest = samples.iter().max_by(|x, y| x.value.total_cmp(&y.value));
        greatest.copied()
    };
    for _ in 0..MOST_SAMPLES {
        let Some(best) = greatest(&samples) else {
            break;
        };
        let predicted = samples
            .windows(2)
            .enumerate()
            .filter_map(|(place, ends)| Some((place, predicted_maximum(ends)?)))
            .max_by(|x, y| x.1[1].total_cmp(&y.1[1]));
        let Some((place, [speed, value])) = predicted else {
            break;
        };
        if value <= best.value * (1.0 + TOLERANCE) {
            break;
        }
        let Some(sample) = f(&samples, speed)? else {
            break;
        };
        samples.insert(place + 1, sample);
    }
    Ok(greatest(&samples))
}

/// Cubic between two samples; the secant replaces an unknown slope.
fn cubic(ends: &[Sample]) -> Cubic {
    let width = ends[1].at - ends[0].at;
    let secant = ends[1].value - ends[0].value;
    let slope = |sample: &Sample| {
        if sample.slope.is_finite() {
            sample.slope * width
        } else {
            secant
        }
    };
    Cubic {
        values: [ends[0].value, ends[1].value],
        slopes: [slope(&ends[0]), slope(&ends[1])],
    }
}

/// Position and value of the maximum of the cubic between two samples; `None` so close to an end that it is hardly
/// larger than the sample there.
fn predicted_maximum(ends: &[Sample]) -> Option<[f64; 2]> {
    let cubic = cubic(ends);
    let share = cubic.highest();
    let at = ends[0].at + share * (ends[1].at - ends[0].at);
    (1e-6..=1.0 - 1e-6)
        .contains(&share)
        .then(|| [at, cubic.at(share)])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn largest(ends: &[f64], f: impl Fn(f64) -> (f64, f64)) -> Sample {
        let sample = |at: f64| {
            let (value, slope) = f(at);
            Sample { at, value, slope }
        };
        let samples = ends.iter().map(|at| sample(*at)).collect();
        maximize(samples, |_, at| Ok(Some(sample(at))))
            .unwrap()
            .unwrap()
    }

    #[test]
    fn the_maximum_of_a_skew_hump_is_found() {
        let f = |x: f64| (x * (-x * x).exp(), (1.0 - 2.0 * x * x) * (-x * x).exp());
        let found = largest(&[0.0, 2.0], f);
        assert!((found.value - (-0.5_f64).exp() / 2.0_f64.sqrt()).abs() < 1e-5);
    }

    /// Divergence that ends at a coalescence of two real λ is fastest there, not zero.
    #[test]
    fn the_maximum_may_be_at_an_end() {
        let found = largest(&[1.0, 2.0], |x| (x - 1.0, 1.0));
        assert_eq!((found.at, found.value), (2.0, 1.0));
    }

    /// A hump of 0.3 at 0.5, and one of 1.0 at 1.7 that is a fifth as wide.
    #[test]
    fn a_narrow_second_hump_is_found() {
        let bell = |x: f64, at: f64, width: f64| {
            let u = (x - at) / width;
            ((-u * u).exp(), -2.0 * u / width * (-u * u).exp())
        };
        let f = |x: f64| {
            let (wide, narrow) = (bell(x, 0.5, 0.5), bell(x, 1.7, 0.1));
            (0.3 * wide.0 + narrow.0, 0.3 * wide.1 + narrow.1)
        };
        let found = largest(&[0.0, 0.4, 0.8, 1.2, 1.6, 2.0], f);
        assert!((found.value - f(1.7).0).abs() < 1e-3, "{found:?}");
    }
}
