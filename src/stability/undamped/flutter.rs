//! Flutter of an undamped blade: a quadruple from the speed at which it begins to the speed at which it ends.

use faer::c64;
use rayon::prelude::*;

use super::checked_modes::CheckedModes;
use super::growing_stretch::{End, GrowingStretch, UNKNOWN};
use super::quadruples::{Bound, Stretch, stretches};
use crate::modes::{DoubleEigenvalue, SpectrumError};
use crate::stability::band::{CurvePoint, InstabilityKind};
use crate::stability::group::Sloped;
use crate::stability::growth_curve::Numbers;
use crate::stability::pieces::Piece;
use crate::stability::sample::{Plane, squared};

/// Intervals of quadruples in the pieces of a search.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub fn flutter(
    checked: &CheckedModes<'_>,
    pieces: &[Piece],
) -> Result<Vec<GrowingStretch>, SpectrumError> {
    let confirmed: Vec<Option<GrowingStretch>> = stretches(pieces)
        .par_iter()
        .map(|stretch| confirmed(checked, stretch))
        .collect::<Result<_, _>>()?;
    Ok(confirmed.into_iter().flatten().collect())
}

/// Ends of flutter that are coalescences of two real λ.
pub fn real_ends(flutter: &[GrowingStretch]) -> Vec<CurvePoint> {
    let ends = flutter.iter().flat_map(|stretch| stretch.ends);
    let real = ends.filter_map(|end| match end {
        End::Coalescence(point) if point.number.re > 0.0 => Some(point),
        _ => None,
    });
    real.collect()
}

/// The quadruple of an interval with both ends; `None` if no eigenproblem confirms it.
fn confirmed(
    checked: &CheckedModes<'_>,
    stretch: &Stretch<'_>,
) -> Result<Option<GrowingStretch>, SpectrumError> {
    let mut points = stretch.points.clone();
    if points.is_empty() {
        let speed_rad_per_s = stretch.fastest_rad_per_s();
        let Some(expected) = stretch.square(speed_rad_per_s) else {
            return Ok(None);
        };
        let found = checked.nearest(speed_rad_per_s, expected)?;
        let found = found.filter(|found| is_expected(found, expected));
        points.extend(found.map(|found| CurvePoint::new(speed_rad_per_s, found)));
    }
    let (Some(&first), Some(&last)) = (points.first(), points.last()) else {
        return Ok(None);
    };
    let ends = [(stretch.begin, first), (stretch.end, last)]
        .map(|(bound, inside)| end(checked, stretch, bound, inside));
    Ok(Some(GrowingStretch {
        kind: InstabilityKind::Flutter,
        ends,
        points,
    }))
}

/// A quadruple that differs from the expected one by more than this share of the growth is another quadruple.
const SAME_QUADRUPLE: f64 = 0.7;

fn is_expected((square, _): &Sloped, expected: c64) -> bool {
    let growth = |square: c64| Plane::Squares.growth_per_s(square);
    let off = (square.sqrt() - expected.sqrt()).norm();
    square.im > 0.0 && off <= SAME_QUADRUPLE * growth(*square).max(growth(expected))
}

/// An end whose distance from the expected end exceeds this share of the way to the nearest known speed belongs to another
/// quadruple.
const SAME_END: f64 = 0.1;
/// Allowed shift of an edge in the models of the search, relative to the speed.
pub const VICINITY: f64 = 3e-5;

/// End of an interval whose quadruple is known at an inner speed.
fn end(checked: &CheckedModes<'_>, stretch: &Stretch<'_>, bound: Bound, point: CurvePoint) -> End {
    let inside = point.speed_rad_per_s;
    let (expected, outside) = match bound {
        Bound::Coalescence {
            expected_rad_per_s,
            outside_rad_per_s,
        } => (expected_rad_per_s, outside_rad_per_s),
        Bound::Range(speed) => return End::Range(speed),
        Bound::Height(speed) => return End::Unknown(speed),
    };
    let square = stretch.square(expected).unwrap_or(point.number).re;
    let is_real = square > 0.0;
    let direction = (outside - inside).signum();
    let margin = VICINITY * expected;
    let is_same = |found: &DoubleEigenvalue| {
        let off = (found.speed_rad_per_s - expected).abs();
        let beyond = (found.speed_rad_per_s - outside) * direction;
        let before = (inside - found.speed_rad_per_s) * direction;
        // ((λ₁ − λ₂)/2)² is σ² next to a coalescence of waves and −ω² next to one of real λ.
        let sign = if is_real { 1.0 } else { -1.0 };
        let is_outwards = found.square_slope * direction * sign > 0.0;
        let way = (expected - inside).abs();
        off <= SAME_END * way + margin && before.max(beyond) <= margin && is_outwards
    };
    let found = checked.double_eigenvalue(expected, c64::new(square, 0.0).sqrt());
    End::Coalescence(match found.filter(is_same) {
        Some(found) => {
            // The growth of the quadruple is the mean of the real λ.
            let (number, slope) = squared((found.lambda, found.mean_slope));
            let slope = if is_real { slope } else { UNKNOWN };
            CurvePoint::new(found.speed_rad_per_s, (c64::from(number.re), slope))
        }
        None => CurvePoint::new(expected, (c64::from(square), UNKNOWN)),
    })
}
