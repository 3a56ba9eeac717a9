//! Bands of a damped blade from the curves of its eigenvalues.

use faer::c64;

use super::spectrum::Component;
use crate::model::scene::SpeedRange;
use crate::model::tuning::Tuned;
use crate::modes::SpectrumError;
use crate::stability::band::{BandEnd, CurvePoint, Instability};
use crate::stability::growth_curve::{GrowthCurve, zero};
use crate::stability::instability_kind::InstabilityKind;

/// Two humps of growth are separate bands if growth between them falls below this share of the lower hump. Each
/// coalescence of two modes gives a hump; growth by damping alone, between them, is slow and even.
pub(super) const VALLEY: Tuned = Tuned::new("stability/damped/hump::VALLEY", 0.5);
/// Smallest width of a band, as a share of its speed. Narrower ones are below the resolution of a complex
/// pair that turns into two real eigenvalues.
const LEAST_BAND: f64 = 1e-9;
/// Difference of two slopes of one curve, as a share of the sum of their sizes.
const ALIKE: f64 = 0.25;

/// Bands of a curve between the first and the last speed of a search with a relative tolerance.
pub fn bands(
    component: &Component<'_>,
    curve: &[CurvePoint],
    range: SpeedRange,
    tolerance: f64,
) -> Result<Vec<Instability>, SpectrumError> {
    let solver = component.solver;
    let grows = |point: &CurvePoint| point.number.re >= 0.0 && point.number.im <= solver.highest();
    let curve = computed(component, curve, tolerance)?;
    let mut bands = Vec::new();
    let mut first = 0;
    while let Some(start) = (first..curve.len()).find(|&k| grows(&curve[k])) {
        let end = (start..curve.len())
            .find(|&k| !grows(&curve[k]))
            .unwrap_or(curve.len());
        first = end;
        let mut growth = curve[start..end].iter().map(|point| point.number.re);
        if growth.all(|growth| growth <= solver.noise()) {
            continue;
        }
        let mut grown = curve[start..end].to_vec();
        if let Some(outside) = start.checked_sub(1) {
            grown.insert(0, onset(component, curve[outside], curve[start])?);
        }
        if let Some(outside) = curve.get(end) {
            grown.push(onset(component, *outside, curve[end - 1])?);
        }
        // An onset may be at the neighbour inside itself.
        grown.dedup_by_key(|point| point.speed_rad_per_s);
        let ends = [grown[0], grown[grown.len() - 1]].map(|point| point.speed_rad_per_s);
        let cut = [
            ends[0] <= range.from_rad_per_s,
            ends[1] >= range.to_rad_per_s,
        ];
        let stretch = GrowthCurve::new(component, &grown)?;
        bands.extend(parted(&stretch, cut, solver.noise()));
    }
    Ok(bands)
}

/// The curve with computed eigenvalues in place of interpolated ones, where it may grow and next to it. An eigenvalue is that of
/// the curve if it differs from the interpolated one by no more than the `tolerance` of the search and has a similar slope:
/// next to a coalescence the slope of the other one is opposite.
fn computed(
    component: &Component<'_>,
    curve: &[CurvePoint],
    tolerance: f64,
) -> Result<Vec<CurvePoint>, SpectrumError> {
    let solver = component.solver;
    let growth = curve.iter().map(|point| point.number.re);
    let fastest = growth.fold(0.0, f64::max);
    let allowed = tolerance * fastest + solver.noise();
    let may_grow = |k: usize| {
        curve
            .get(k)
            .is_some_and(|point| point.number.re >= -allowed)
    };
    let of = |k: usize| {
        let point = curve[k];
        if fastest == 0.0 || !(may_grow(k) || may_grow(k + 1) || may_grow(k.wrapping_sub(1))) {
            return Ok(point);
        }
        let found = component.next_to(point.speed_rad_per_s, point.number)?;
        let size = point.number.norm().max(1e-3 * solver.highest());
        let is_same = |(lambda, slope): &(c64, c64)| {
            let off = lambda - point.number;
            let steepness = slope.norm() + point.slope.norm();
            off.norm() <= tolerance * size
                && off.re.abs() <= allowed
                && (slope - point.slope).norm() <= ALIKE * steepness
        };
        Ok(found
            .filter(is_same)
            .map_or(point, |(number, slope)| CurvePoint {
                number,
                slope,
                ..point
            }))
    };
    (0..curve.len()).map(of).collect()
}

/// Speed of Re λ = 0 between a point outside an interval and its neighbour inside.
fn onset(
    component: &Component<'_>,
    outside: CurvePoint,
    inside: CurvePoint,
) -> Result<CurvePoint, SpectrumError> {
    // If the mode still grows at the point outside, the curve leaves the accurate range of frequencies there.
    if outside.number.re >= 0.0 {
        return Ok(outside);
    }
    zero(component, [outside, inside], |point| point.number.re)
}

/// Divides an interval into one band for each hump. `cut` tells whether the range of speeds begins, and whether
/// it ends, inside the interval.
fn parted(stretch: &GrowthCurve, cut: [bool; 2], noise: f64) -> Vec<Instability> {
    let last = stretch.points.len() - 1;
    let mut bounds = vec![0, last];
    valleys(&stretch.points, [0, last], &mut bounds);
    bounds.sort_unstable();
    let humps = bounds.windows(2).map(|ends| {
        let is_cut = [cut[0] && ends[0] == 0, cut[1] && ends[1] == last];
        band(stretch, [ends[0], ends[1]], is_cut)
    });
    humps
        .filter(|band| {
            band.peak_growth_per_s > noise && band.range().width() > LEAST_BAND * band.to_rad_per_s
        })
        .collect()
}

/// Adds the indices of the lowest points between humps, deepest first.
fn valleys(curve: &[CurvePoint], [first, last]: [usize; 2], found: &mut Vec<usize>) {
    let growth = |k: usize| curve[k].number.re;
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
fn band(stretch: &GrowthCurve, [first, last]: [usize; 2], is_cut: [bool; 2]) -> Instability {
    let peak = stretch.peak([first, last]);
    let kind = if peak.number.im == 0.0 {
        InstabilityKind::Divergence
    } else {
        InstabilityKind::Flutter
    };
    Instability {
        kind,
        from_rad_per_s: stretch.points[first].speed_rad_per_s,
        to_rad_per_s: stretch.points[last].speed_rad_per_s,
        ends: is_cut.map(|is_cut| {
            if is_cut {
                BandEnd::Range
            } else {
                BandEnd::Growth
            }
        }),
        closed: !is_cut.contains(&true),
        peak_rad_per_s: peak.speed_rad_per_s,
        peak_growth_per_s: peak.number.re,
        frequency_rad_per_s: peak.number.im.abs(),
        curve: stretch.points[first..=last].to_vec(),
    }
}
