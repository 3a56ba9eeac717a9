//! Growth of one eigenvalue over an interval of speed, with its extrema.

use faer::c64;

use super::band::CurvePoint;
use super::group::Sloped;
use super::interpolation::Cubic;
use super::root::{Look, bracketed};
use super::sample::Plane;
use crate::modes::SpectrumError;

/// Relative accuracy in speed of onsets, peaks and minima of growth.
const SPEED_TOLERANCE: f64 = 1e-12;

/// Numbers of a saw at any speed.
pub trait Numbers {
    /// Whether the numbers are λ or λ².
    fn plane(&self) -> Plane;

    /// The number at a speed that is nearest to an expected one, with its slope; `None` if there is none.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    fn nearest(&self, speed_rad_per_s: f64, expected: c64)
    -> Result<Option<Sloped>, SpectrumError>;

    /// Counts a point of a band that is interpolated, because there is no number.
    fn note_interpolated(&self) {}
}

/// Points of a curve at ascending speeds, among them every extremum of growth.
pub struct GrowthCurve {
    plane: Plane,
    /// The points.
    pub points: Vec<CurvePoint>,
    /// Speeds of the extrema.
    extrema: Vec<f64>,
}

impl GrowthCurve {
    /// The curve through points at ascending speeds, with the points added at which growth is largest or
    /// smallest.
    ///
    /// # Errors
    /// The errors of `numbers`.
    pub fn new(numbers: &impl Numbers, known: &[CurvePoint]) -> Result<Self, SpectrumError> {
        let plane = numbers.plane();
        let mut curve = GrowthCurve {
            plane,
            points: known.iter().take(1).copied().collect(),
            extrema: Vec::new(),
        };
        let slope = |point: &CurvePoint| plane.growth_slope((point.number, point.slope));
        for pair in known.windows(2) {
            let ends = [pair[0], pair[1]];
            let [from, to] = ends.map(|point| point.speed_rad_per_s);
            let turns = (slope(&pair[0]) < 0.0) != (slope(&pair[1]) < 0.0);
            if turns && to - from > SPEED_TOLERANCE * to {
                let found = zero(numbers, ends, slope)?;
                // A known point may be the extremum.
                curve.extrema.push(found.speed_rad_per_s);
                if ![from, to].contains(&found.speed_rad_per_s) {
                    curve.points.push(found);
                }
            }
            curve.points.push(pair[1]);
        }
        Ok(curve)
    }

    /// The point of largest growth from one index to another: an end or an extremum.
    pub fn peak(&self, [first, last]: [usize; 2]) -> CurvePoint {
        let growth = |point: &CurvePoint| self.plane.growth_per_s(point.number);
        let is_extremum = |point: &&CurvePoint| self.extrema.contains(&point.speed_rad_per_s);
        let inner = self.points[first..=last].iter().filter(is_extremum);
        let (begin, end) = (&self.points[first], &self.points[last]);
        *inner.chain([end]).fold(begin, |best, point| {
            if growth(point) > growth(best) {
                point
            } else {
                best
            }
        })
    }
}

/// The point between two points of a curve at which a value of it is zero.
///
/// # Errors
/// The errors of `numbers`.
pub fn zero(
    numbers: &impl Numbers,
    ends: [CurvePoint; 2],
    value: impl Fn(&CurvePoint) -> f64,
) -> Result<CurvePoint, SpectrumError> {
    let look = |point: CurvePoint| Look {
        at: point.speed_rad_per_s,
        value: value(&point),
        point,
    };
    let found = bracketed(ends.map(look), SPEED_TOLERANCE, |ends, share| {
        between(numbers, ends, share).map(look)
    })?;
    Ok(found.point)
}

/// The point of a curve at a share of the way between two of its points.
///
/// # Errors
/// The errors of `numbers`.
pub fn between(
    numbers: &impl Numbers,
    points: [CurvePoint; 2],
    share: f64,
) -> Result<CurvePoint, SpectrumError> {
    let [from, to] = points.map(|point| point.speed_rad_per_s);
    let cubic = |part: fn(c64) -> f64| {
        Cubic {
            values: points.map(|point| part(point.number)),
            slopes: points.map(|point| part(point.slope) * (to - from)),
        }
        .at(share)
    };
    let expected = c64::new(cubic(|z| z.re), cubic(|z| z.im));
    let speed_rad_per_s = from + share * (to - from);
    let found = numbers.nearest(speed_rad_per_s, expected)?;
    if found.is_none() {
        numbers.note_interpolated();
    }
    let sloped = found.unwrap_or((expected, points[0].slope));
    Ok(CurvePoint::new(speed_rad_per_s, sloped))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// λ² of growth g = 1 − (Ω − 2)²/4, largest at 2 rad/s.
    struct Parabola;

    impl Parabola {
        fn at(speed: f64) -> CurvePoint {
            let growth = 1.0 - 0.25 * (speed - 2.0).powi(2);
            let slope = -growth * (speed - 2.0);
            CurvePoint::new(speed, (c64::from(growth * growth), c64::from(slope)))
        }
    }

    impl Numbers for Parabola {
        fn plane(&self) -> Plane {
            Plane::Squares
        }

        fn nearest(&self, speed: f64, _expected: c64) -> Result<Option<Sloped>, SpectrumError> {
            let point = Self::at(speed);
            Ok(Some((point.number, point.slope)))
        }
    }

    /// The largest growth is found between the points, and where a point of the search happens to be it, as with a saw whose search
    /// has a speed 1e-5 rpm beside the peak of a band.
    #[test]
    fn the_peak_may_be_a_known_point() {
        for speeds in [[1.0, 2.0, 3.0], [1.0, 2.0 + 1e-13, 3.0], [1.0, 2.2, 3.0]] {
            let known = speeds.map(Parabola::at);
            let curve = GrowthCurve::new(&Parabola, &known).unwrap();
            let peak = curve.peak([0, curve.points.len() - 1]);
            assert!((peak.speed_rad_per_s - 2.0).abs() < 1e-9, "{peak:?}");
            let growth = Plane::Squares.growth_per_s(peak.number);
            assert!((growth - 1.0).abs() < 1e-12, "{growth}");
        }
    }
}
