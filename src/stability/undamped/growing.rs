//! The growing numbers of an undamped blade, each from the speed at which it begins to grow to that at which it ends.

use faer::c64;
use rayon::prelude::*;

use super::checked_modes::CheckedModes;
use super::growing_stretch::{End, GrowingStretch, UNKNOWN};
use super::stretches::{Bound, Stretch, stretches};
use crate::modes::{DoubleEigenvalue, SpectrumError};
use crate::stability::band::CurvePoint;
use crate::stability::group::Sloped;
use crate::stability::growth_curve::Numbers;
use crate::stability::instability_kind::InstabilityKind;
use crate::stability::pieces::Piece;
use crate::stability::sample::{Plane, squared};

/// Intervals of growth in the pieces of a search, confirmed by eigenproblems, with their ends by Newton's method: of flutter for each
/// quadruple, of divergence for all real λ > 0 together. `critical` are the critical speeds, ascending.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub fn growing(
    checked: &CheckedModes<'_>,
    pieces: &[Piece],
    critical: &[f64],
) -> Result<Vec<GrowingStretch>, SpectrumError> {
    let confirmed: Vec<Option<GrowingStretch>> = stretches(pieces, critical)
        .par_iter()
        .map(|stretch| confirmed(checked, stretch))
        .collect::<Result<_, _>>()?;
    let all = confirmed.into_iter().flatten();
    let (flutter, divergence) = all.partition(|stretch| stretch.kind == InstabilityKind::Flutter);
    Ok([flutter, united(checked, divergence)?].concat())
}

/// Intervals that do not touch, each with the largest of the numbers at every speed.
fn united(
    checked: &CheckedModes<'_>,
    mut stretches: Vec<GrowingStretch>,
) -> Result<Vec<GrowingStretch>, SpectrumError> {
    stretches.sort_by(|x, y| x.ends[0].speed().total_cmp(&y.ends[0].speed()));
    let mut united: Vec<GrowingStretch> = Vec::new();
    for stretch in stretches {
        let [begin, end] = stretch.ends;
        match united.last_mut() {
            Some(last) if touch(checked, [last.ends[1], begin])? => {
                if end.speed() > last.ends[1].speed() {
                    last.ends[1] = end;
                }
                last.points.extend(stretch.points);
            }
            _ => united.push(stretch),
        }
    }
    for stretch in &mut united {
        stretch.points.sort_by(|x, y| {
            let by_speed = x.speed_rad_per_s.total_cmp(&y.speed_rad_per_s);
            by_speed.then(y.number.re.total_cmp(&x.number.re))
        });
        stretch.points.dedup_by_key(|point| point.speed_rad_per_s);
    }
    Ok(united)
}

/// Whether no speed between the end of one interval of divergence and the begin of the next is free of real λ > 0. Two λ² above zero
/// that cross, without a quadruple, may seem to coalesce there and to split again.
fn touch(checked: &CheckedModes<'_>, [end, begin]: [End; 2]) -> Result<bool, SpectrumError> {
    let [from, to] = [end, begin].map(|end| end.speed());
    if to < from {
        return Ok(true);
    }
    if !(end.is_coalescence() && begin.is_coalescence()) {
        return Ok(false);
    }
    let between = checked.guess_at(0.5 * (from + to))?;
    Ok(between.divergences().next().is_some())
}

/// An interval with both ends; `None` if no eigenproblem confirms it.
fn confirmed(
    checked: &CheckedModes<'_>,
    stretch: &Stretch<'_>,
) -> Result<Option<GrowingStretch>, SpectrumError> {
    let mut points = stretch.points.clone();
    if points.is_empty() {
        points.extend(inner(checked, stretch)?);
    }
    let (Some(&first), Some(&last)) = (points.first(), points.last()) else {
        return Ok(None);
    };
    let ends = [(stretch.begin, first), (stretch.end, last)]
        .map(|(bound, inside)| end(checked, stretch, bound, inside));
    // Ends in the wrong order are within the rounding of one speed.
    let is_inverted = ends[1].speed() < ends[0].speed();
    Ok((!is_inverted).then_some(GrowingStretch {
        kind: stretch.kind,
        ends,
        points,
    }))
}

/// A point of an interval between two speeds of the search.
fn inner(
    checked: &CheckedModes<'_>,
    stretch: &Stretch<'_>,
) -> Result<Option<CurvePoint>, SpectrumError> {
    let Some(speed_rad_per_s) = stretch.fastest_rad_per_s() else {
        // Between two critical speeds next to each other the growth is nearly constant. The inertia of the stiffness proves it, even if
        // rounding hides it.
        let middle = stretch.middle_rad_per_s();
        let fastest = checked.guess_at(middle)?.divergences().next();
        let (square, _) = fastest.unwrap_or((c64::ZERO, c64::ZERO));
        return Ok(Some(CurvePoint::new(middle, (square, c64::ZERO))));
    };
    let Some(expected) = stretch.square(speed_rad_per_s) else {
        return Ok(None);
    };
    let found = checked.nearest(speed_rad_per_s, expected)?;
    let found = found.filter(|found| is_expected(stretch.kind, found, expected));
    Ok(found.map(|found| CurvePoint::new(speed_rad_per_s, found)))
}

/// A number that differs from the expected one by more than this share of the growth is another one.
const SAME_NUMBER: f64 = 0.7;

fn is_expected(kind: InstabilityKind, (square, _): &Sloped, expected: c64) -> bool {
    let growth = |square: c64| Plane::Squares.growth_per_s(square);
    let off = (square.sqrt() - expected.sqrt()).norm();
    InstabilityKind::of_square(*square) == Some(kind)
        && off <= SAME_NUMBER * growth(*square).max(growth(expected))
}

/// An end whose distance from the expected end exceeds this share of the way to the nearest known speed belongs to another number.
const SAME_END: f64 = 0.1;
/// Allowed shift of an edge in the models of the search, relative to the speed.
const VICINITY: f64 = 3e-5;
/// Relative distance from a coalescence within which rounding may let a number seem to grow.
const ROUNDED: f64 = 1e-8;

/// Speeds about an end of an interval.
struct About {
    /// A speed at which the number grows.
    inside: f64,
    /// Speed of the end by interpolation.
    expected: f64,
    /// Nearest speed of the search outside the interval.
    outside: f64,
}

impl About {
    /// Whether a coalescence may be the end. The number grows at the inner speed, so that one beyond that speed, within a narrow interval
    /// or behind it, is the end of another number.
    fn may_end_at(&self, speed: f64) -> bool {
        let direction = (self.outside - self.inside).signum();
        let margin = VICINITY * self.expected;
        let way = (self.expected - self.inside).abs();
        let beyond = (speed - self.outside) * direction;
        let before = (self.inside - speed) * direction;
        (speed - self.expected).abs() <= SAME_END * way + margin
            && beyond <= margin
            && before <= ROUNDED * self.expected
    }
}

/// End of an interval whose number is known at an inner speed.
fn end(checked: &CheckedModes<'_>, stretch: &Stretch<'_>, bound: Bound, point: CurvePoint) -> End {
    let inside = point.speed_rad_per_s;
    let (expected, outside) = match bound {
        Bound::Coalescence {
            expected_rad_per_s,
            outside_rad_per_s,
        } => (expected_rad_per_s, outside_rad_per_s),
        Bound::Critical(speed) => return End::Critical(speed),
        Bound::Passed(speed) => return End::Passed(speed),
        Bound::Range(speed) => return End::Range(speed),
        Bound::Unfollowed(speed) => return End::Unknown(speed),
    };
    let square = stretch.square(expected).unwrap_or(point.number).re;
    // Where two real λ coalesce, the growth of the quadruple is their mean. In every other case the slope of the faster of both is unbounded.
    let is_mean = stretch.kind == InstabilityKind::Flutter && square > 0.0;
    let about = About {
        inside,
        expected,
        outside,
    };
    let is_same = |found: &DoubleEigenvalue| {
        // ((λ₁ − λ₂)/2)² is negative, −ω², only for a quadruple next to two real λ.
        let sign = if is_mean { 1.0 } else { -1.0 };
        let direction = (outside - inside).signum();
        let is_outwards = found.square_slope * direction * sign > 0.0;
        about.may_end_at(found.speed_rad_per_s) && is_outwards
    };
    let found = checked.double_eigenvalue(expected, c64::new(square, 0.0).sqrt());
    match found.filter(is_same) {
        Some(found) => {
            let (number, slope) = squared((found.lambda, found.mean_slope));
            let slope = if is_mean { slope } else { UNKNOWN };
            let number = (c64::from(number.re), slope);
            End::Coalescence(CurvePoint::new(found.speed_rad_per_s, number))
        }
        None => End::Interpolated(CurvePoint::new(expected, (c64::from(square), UNKNOWN))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::{Accuracy, Scene, SpeedRange, rad_per_s, rpm};
    use crate::modes::companion_eigenpairs;
    use crate::stability::{Analysis, Onsets};

    /// A ring with 46 critical speeds within 1000 rpm, in rad/s: its waves grow from 3809.4559 to 3809.4774, and another pair begins to
    /// grow at 3809.4817.
    #[test]
    fn a_coalescence_beyond_a_speed_of_growth_is_the_end_of_another_band() {
        let [inside, last, begin, end, next] = [
            3809.456322,
            3809.4774,
            3809.455887,
            3809.477443,
            3809.481727,
        ];
        let of_begin = About {
            inside,
            expected: begin,
            outside: 3809.42584,
        };
        let of_end = About {
            inside: last,
            expected: end,
            outside: 3809.79934,
        };
        assert!(of_begin.may_end_at(begin) && of_end.may_end_at(end));
        assert!(!of_begin.may_end_at(next) && !of_begin.may_end_at(end));
        assert!(!of_end.may_end_at(begin));
    }

    /// Two opposed pads leave the waves of even and odd n uncoupled: a growing real λ of one family crosses that of the other near
    /// 2106 and 3003 rpm. Reference: dense eigenvalues.
    #[test]
    #[cfg_attr(debug_assertions, ignore = "dense solves: run it in release")]
    fn divergence_goes_on_where_two_uncoupled_real_eigenvalues_cross() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/gallery");
        let scene = Scene::from_path(format!("{folder}/opposed-pads.json")).unwrap();
        let draft = scene.edited(|saw| saw.accuracy = Accuracy::Draft).unwrap();
        let swept = |to: f64| draft.swept(SpeedRange::between_rpm(0.0, to)).unwrap();
        let model = &Analysis::new(&swept(3100.0)).unwrap().model;
        let real = |speed: f64| {
            let dense = companion_eigenpairs(&model.components[0].full, rad_per_s(speed)).unwrap();
            let is_real = |lambda: &c64| lambda.im.abs() < 1e-6 && lambda.re > 1e-2;
            dense.iter().filter(|(lambda, _)| is_real(lambda)).count()
        };
        let speeds = [2000.5, 2048.0, 2049.0, 2106.4066, 2128.0, 2139.8, 3003.1866];
        assert_eq!(speeds.map(real), [0, 1, 2, 2, 1, 0, 2]);
        for to in [3050.0, 3100.0, 3200.0, 4100.0] {
            let found = Onsets::new(&swept(to)).unwrap();
            let bands = found.instabilities.iter();
            let divergence = bands.filter(|band| band.kind == InstabilityKind::Divergence);
            let ends: Vec<f64> = divergence.flat_map(|band| band.range().ends()).collect();
            for (end, expected) in ends
                .iter()
                .zip([2000.9647, 2139.4840, 2801.8643, 3016.9622])
            {
                assert!((rpm(*end) - expected).abs() < 1e-3, "{to}: {}", rpm(*end));
            }
        }
    }
}
