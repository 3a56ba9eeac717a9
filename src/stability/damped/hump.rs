//! Bands of a damped blade from the curves of its eigenvalues.

use faer::c64;

use super::super::band::{CurvePoint, Instability, InstabilityKind};
use super::super::interpolation::Cubic;
use super::super::root::{Look, bracketed};
use super::spectrum::Solver;
use crate::model::scene::SpeedRange;
use crate::model::tuning::Tuned;
use crate::modes::SpectrumError;

/// Relative accuracy in speed of onsets, peaks and minima of growth.
const SPEED_TOLERANCE: f64 = 1e-12;
/// Two humps of growth are separate bands if growth between them falls below this share of the lower hump. Each
/// coalescence of two modes gives a hump; growth by damping alone, between them, is slow and even.
const VALLEY: Tuned = Tuned::new("stability/damped/hump::VALLEY", 0.5);
/// Smallest width of a band, as a share of its speed. Narrower ones are below the resolution of a complex
/// pair that turns into two real eigenvalues.
const LEAST_BAND: f64 = 1e-9;
/// Difference of two slopes of one curve, as a share of the sum of their sizes.
const ALIKE: f64 = 0.25;

/// Interval of a curve with Re λ > 0.
struct Stretch {
    curve: Vec<CurvePoint>,
    /// Speeds of the extrema of growth, at which the eigenvalue was computed; other points were interpolated.
    extrema: Vec<f64>,
    /// Whether the range of speeds begins, and whether it ends, inside the interval.
    cut: [bool; 2],
}

/// Bands of a curve between the first and the last speed of a search with a relative tolerance.
pub fn bands(
    solver: &Solver<'_>,
    component: usize,
    curve: &[CurvePoint],
    range: SpeedRange,
    tolerance: f64,
) -> Result<Vec<Instability>, SpectrumError> {
    let grows = |point: &CurvePoint| point.lambda.re >= 0.0 && point.lambda.im <= solver.highest();
    let curve = computed(solver, component, curve, tolerance)?;
    let mut bands = Vec::new();
    let mut first = 0;
    while let Some(start) = (first..curve.len()).find(|&k| grows(&curve[k])) {
        let end = (start..curve.len())
            .find(|&k| !grows(&curve[k]))
            .unwrap_or(curve.len());
        first = end;
        let mut growth = curve[start..end].iter().map(|point| point.lambda.re);
        if growth.all(|growth| growth <= solver.noise()) {
            continue;
        }
        let mut grown = curve[start..end].to_vec();
        if let Some(outside) = start.checked_sub(1) {
            grown.insert(0, onset(solver, component, curve[outside], curve[start])?);
        }
        if let Some(outside) = curve.get(end) {
            grown.push(onset(solver, component, *outside, curve[end - 1])?);
        }
        // An onset may be at the neighbour inside itself.
        grown.dedup_by_key(|point| point.speed_rad_per_s);
        let ends = [grown[0], grown[grown.len() - 1]].map(|point| point.speed_rad_per_s);
        let (curve, extrema) = with_extrema(solver, component, grown)?;
        let stretch = Stretch {
            curve,
            extrema,
            cut: [
                ends[0] <= range.from_rad_per_s,
                ends[1] >= range.to_rad_per_s,
            ],
        };
        bands.extend(parted(stretch, solver.noise()));
    }
    Ok(bands)
}

/// The curve with computed eigenvalues in place of interpolated ones, where it may grow and next to it. An eigenvalue is that of
/// the curve if it differs from the interpolated one by no more than the `tolerance` of the search and has a similar slope:
/// next to a coalescence the slope of the other one is opposite.
fn computed(
    solver: &Solver<'_>,
    component: usize,
    curve: &[CurvePoint],
    tolerance: f64,
) -> Result<Vec<CurvePoint>, SpectrumError> {
    let growth = curve.iter().map(|point| point.lambda.re);
    let fastest = growth.fold(0.0, f64::max);
    let allowed = tolerance * fastest + solver.noise();
    let may_grow = |k: usize| {
        curve
            .get(k)
            .is_some_and(|point| point.lambda.re >= -allowed)
    };
    let of = |k: usize| {
        let point = curve[k];
        if fastest == 0.0 || !(may_grow(k) || may_grow(k + 1) || may_grow(k.wrapping_sub(1))) {
            return Ok(point);
        }
        let found = solver.next_to(point.speed_rad_per_s, component, point.lambda)?;
        let size = point.lambda.norm().max(1e-3 * solver.highest());
        let is_same = |(lambda, slope): &(c64, c64)| {
            let off = lambda - point.lambda;
            let steepness = slope.norm() + point.slope.norm();
            off.norm() <= tolerance * size
                && off.re.abs() <= allowed
                && (slope - point.slope).norm() <= ALIKE * steepness
        };
        Ok(found
            .filter(is_same)
            .map_or(point, |(lambda, slope)| CurvePoint {
                lambda,
                slope,
                ..point
            }))
    };
    (0..curve.len()).map(of).collect()
}

/// Speed of Re λ = 0 between a point outside an interval and its neighbour inside.
fn onset(
    solver: &Solver<'_>,
    component: usize,
    outside: CurvePoint,
    inside: CurvePoint,
) -> Result<CurvePoint, SpectrumError> {
    // If the mode still grows at the point outside, the curve leaves the accurate range of frequencies there.
    if outside.lambda.re >= 0.0 {
        return Ok(outside);
    }
    root(solver, component, [outside, inside], |p| p.lambda.re)
}

/// The curve with points added at every extremum of growth, and the speeds of these.
fn with_extrema(
    solver: &Solver<'_>,
    component: usize,
    curve: Vec<CurvePoint>,
) -> Result<(Vec<CurvePoint>, Vec<f64>), SpectrumError> {
    let mut full = Vec::with_capacity(curve.len());
    let mut extrema = Vec::new();
    for k in 0..curve.len() {
        full.push(curve[k]);
        let Some(&next) = curve.get(k + 1) else {
            continue;
        };
        let width = next.speed_rad_per_s - curve[k].speed_rad_per_s;
        let turns = (curve[k].slope.re < 0.0) != (next.slope.re < 0.0);
        if turns && width > SPEED_TOLERANCE * next.speed_rad_per_s {
            let found = root(solver, component, [curve[k], next], |p| p.slope.re)?;
            let ends = [curve[k], next].map(|p| p.speed_rad_per_s);
            if !ends.contains(&found.speed_rad_per_s) {
                extrema.push(found.speed_rad_per_s);
                full.push(found);
            }
        }
    }
    Ok((full, extrema))
}

/// Point between two points of a curve at which a number is zero.
fn root(
    solver: &Solver<'_>,
    component: usize,
    ends: [CurvePoint; 2],
    number: impl Fn(&CurvePoint) -> f64,
) -> Result<CurvePoint, SpectrumError> {
    let look = |point: CurvePoint| Look {
        at: point.speed_rad_per_s,
        value: number(&point),
        point,
    };
    let found = bracketed(ends.map(look), SPEED_TOLERANCE, |ends, share| {
        between_points(solver, component, ends, share).map(look)
    })?;
    Ok(found.point)
}

/// Point of a curve at a share of the way between two of its points.
fn between_points(
    solver: &Solver<'_>,
    component: usize,
    points: [CurvePoint; 2],
    share: f64,
) -> Result<CurvePoint, SpectrumError> {
    let [from, to] = points.map(|p| p.speed_rad_per_s);
    let speed = from + share * (to - from);
    let cubic = |part: fn(c64) -> f64| {
        Cubic {
            values: points.map(|p| part(p.lambda)),
            slopes: points.map(|p| part(p.slope) * (to - from)),
        }
        .at(share)
    };
    let expected = c64::new(cubic(|z| z.re), cubic(|z| z.im));
    let found = solver.nearest(speed, component, expected)?;
    Ok(CurvePoint {
        speed_rad_per_s: speed,
        lambda: found.map_or(expected, |(lambda, _)| lambda),
        slope: found.map_or(points[0].slope, |(_, slope)| slope),
    })
}

/// Divides an interval into one band for each hump.
fn parted(stretch: Stretch, noise: f64) -> Vec<Instability> {
    let last = stretch.curve.len() - 1;
    let mut bounds = vec![0, last];
    valleys(&stretch.curve, [0, last], &mut bounds);
    bounds.sort_unstable();
    let humps = bounds.windows(2).map(|ends| {
        let cut = [
            stretch.cut[0] && ends[0] == 0,
            stretch.cut[1] && ends[1] == last,
        ];
        band(&stretch.curve[ends[0]..=ends[1]], &stretch.extrema, cut)
    });
    humps
        .flatten()
        .filter(|band| {
            band.peak_growth_per_s > noise && band.range().width() > LEAST_BAND * band.to_rad_per_s
        })
        .collect()
}

/// Adds the indices of the lowest points between humps, deepest first.
fn valleys(curve: &[CurvePoint], [first, last]: [usize; 2], found: &mut Vec<usize>) {
    let growth = |k: usize| curve[k].lambda.re;
    // For each point, `before` is the largest growth up to the point and `behind` the largest growth from the
    // point on.
    let mut before = 0.0_f64;
    let mut deepest: Option<(f64, usize)> = None;
    let mut behind: Vec<f64> = (first..=last)
        .rev()
        .scan(0.0_f64, |top, k| {
            *top = top.max(growth(k));
            Some(*top)
        })
        .collect();
    behind.reverse();
    for k in first..=last {
        before = before.max(growth(k));
        let lower = before.min(behind[k - first]);
        let depth = growth(k).max(0.0) / lower.max(f64::MIN_POSITIVE);
        let inner = first < k && k < last;
        if inner && depth < VALLEY.get() && deepest.is_none_or(|(d, _)| depth < d) {
            deepest = Some((depth, k));
        }
    }
    let Some((_, valley)) = deepest else {
        return;
    };
    found.push(valley);
    valleys(curve, [first, valley], found);
    valleys(curve, [valley, last], found);
}

/// Band of one hump.
fn band(curve: &[CurvePoint], extrema: &[f64], cut: [bool; 2]) -> Option<Instability> {
    let (first, last) = (curve.first()?, curve.last()?);
    let growth = |p: &&CurvePoint| p.lambda.re;
    let is_computed = |p: &&CurvePoint| extrema.contains(&p.speed_rad_per_s);
    let peak = curve
        .iter()
        .filter(is_computed)
        .chain([first, last])
        .max_by(|x, y| growth(x).total_cmp(&growth(y)))?;
    let kind = if peak.lambda.im == 0.0 {
        InstabilityKind::Divergence
    } else {
        InstabilityKind::Flutter
    };
    Some(Instability {
        kind,
        from_rad_per_s: first.speed_rad_per_s,
        to_rad_per_s: last.speed_rad_per_s,
        closed: !cut[0] && !cut[1],
        peak_rad_per_s: peak.speed_rad_per_s,
        peak_growth_per_s: peak.lambda.re,
        frequency_rad_per_s: peak.lambda.im.abs(),
        curve: curve.to_vec(),
    })
}
