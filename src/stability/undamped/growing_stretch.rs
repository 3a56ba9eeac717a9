//! An interval of speed over which an eigenvalue of an undamped blade grows.

use faer::c64;

use crate::model::scene::SpeedRange;
use crate::modes::{SpectrumError, smallest};
use crate::stability::band::{BESIDE_END, BandEnd, CurvePoint, Instability};
use crate::stability::growth_curve::{GrowthCurve, Numbers, between};
use crate::stability::instability_kind::InstabilityKind;
use crate::stability::sample::Plane;
use crate::stability::search_result::Found;

/// A slope that is unknown or unbounded.
pub const UNKNOWN: c64 = c64::new(f64::NAN, 0.0);

/// Begin or end of an interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum End {
    /// Coalescence of two waves, or of two real λ.
    Coalescence(CurvePoint),
    /// Coalescence of interpolated numbers, near which no iteration found one.
    Interpolated(CurvePoint),
    /// Critical speed: λ passes through zero.
    Critical(f64),
    /// Critical speed beside another one, between which the growth is nearly constant.
    Passed(f64),
    /// End of the range inside the interval.
    Range(f64),
    /// Estimated end of an eigenvalue that could not be followed to it.
    Unknown(f64),
}

impl End {
    /// Rotation speed Ω.
    pub fn speed(&self) -> f64 {
        match self {
            End::Coalescence(point) | End::Interpolated(point) => point.speed_rad_per_s,
            End::Critical(speed) | End::Passed(speed) | End::Range(speed) | End::Unknown(speed) => {
                *speed
            }
        }
    }

    /// Whether two numbers coalesce at the end.
    pub fn is_coalescence(&self) -> bool {
        matches!(self, End::Coalescence(_) | End::Interpolated(_))
    }

    /// The end in a list of bands.
    fn of_band(&self) -> BandEnd {
        match self {
            End::Coalescence(point) => BandEnd::Coalescence(point.number.sqrt()),
            End::Critical(_) | End::Passed(_) => BandEnd::Critical,
            End::Range(_) => BandEnd::Range,
            End::Interpolated(_) | End::Unknown(_) => BandEnd::Interpolated,
        }
    }

    /// λ² at the end, if it is known.
    fn point(&self) -> Option<CurvePoint> {
        match self {
            End::Coalescence(point) | End::Interpolated(point) => Some(*point),
            End::Critical(speed) => Some(CurvePoint::new(*speed, (c64::ZERO, UNKNOWN))),
            End::Passed(_) | End::Range(_) | End::Unknown(_) => None,
        }
    }
}

/// An interval with a growing eigenvalue.
#[derive(Debug, Clone)]
pub struct GrowingStretch {
    /// Divergence for real λ, flutter for others.
    pub kind: InstabilityKind,
    /// Begin and end.
    pub ends: [End; 2],
    /// λ² at some speeds between them, at least one, ascending.
    pub points: Vec<CurvePoint>,
}

impl GrowingStretch {
    /// The band of the interval, and its part within a range.
    ///
    /// # Errors
    /// The errors of `numbers`.
    pub fn found(&self, numbers: &impl Numbers, range: SpeedRange) -> Result<Found, SpectrumError> {
        Found::new(range, |limits| self.band(numbers, limits))
    }

    /// The band between two speeds.
    fn band(
        &self,
        numbers: &impl Numbers,
        limits: SpeedRange,
    ) -> Result<Instability, SpectrumError> {
        let [begin, end] = self.ends;
        let range = SpeedRange::new(begin.speed(), end.speed()).within(limits);
        let curve = GrowthCurve::new(numbers, &self.within(numbers, range)?)?;
        let mut peak = curve.peak([0, curve.points.len() - 1]);
        let [from, to] = range.ends();
        for (edge, other) in [(begin, to), (end, from)] {
            if edge.is_coalescence() && edge.speed() == peak.speed_rad_per_s {
                let speed = edge.speed() + BESIDE_END * (other - edge.speed());
                peak = continued(numbers, &curve.points, speed)?;
            }
        }
        let lambda = peak.number.sqrt();
        let is_open = |end: &End| matches!(end, End::Range(_));
        let of_band = |edge: End, speed: f64| {
            if edge.speed() == speed {
                edge.of_band()
            } else {
                BandEnd::Range
            }
        };
        Ok(Instability {
            kind: self.kind,
            from_rad_per_s: from,
            to_rad_per_s: to,
            ends: [of_band(begin, from), of_band(end, to)],
            closed: !self.ends.iter().any(is_open),
            peak_rad_per_s: peak.speed_rad_per_s,
            peak_growth_per_s: Plane::Squares.growth_per_s(peak.number),
            frequency_rad_per_s: lambda.im,
            curve: Vec::new(),
        })
    }

    /// Points within a range, and at its ends, if it cuts the interval.
    fn within(
        &self,
        numbers: &impl Numbers,
        range: SpeedRange,
    ) -> Result<Vec<CurvePoint>, SpectrumError> {
        let [begin, end] = self.ends;
        // At the end of a search the point there is the last of the interval, and may grow the most.
        let inside = SpeedRange::new(begin.speed(), end.speed());
        let inner = self
            .points
            .iter()
            .filter(|point| inside.contains(point.speed_rad_per_s));
        let mut known: Vec<CurvePoint> = begin.point().into_iter().collect();
        known.extend(inner.copied().chain(end.point()));
        known.dedup_by(|next, last| next.speed_rad_per_s <= last.speed_rad_per_s);
        if known.is_empty() {
            known.push(self.points[0]);
        }
        with_chords(&mut known);
        let ends = range.ends().into_iter().zip(self.ends);
        let cuts = ends.filter(|(speed, end)| *speed != end.speed());
        let at = cuts.map(|(speed, _)| continued(numbers, &known, speed));
        let cut: Vec<CurvePoint> = at.collect::<Result<_, _>>()?;
        known.retain(|point| range.contains(point.speed_rad_per_s));
        known.extend(cut);
        known.sort_by(|x, y| x.speed_rad_per_s.total_cmp(&y.speed_rad_per_s));
        Ok(known)
    }
}

/// Replaces unknown slopes at both ends of a list by those of the chords to the neighbours.
fn with_chords(points: &mut [CurvePoint]) {
    let last = points.len() - 1;
    for (end, neighbour) in [(0, 1), (last, last.saturating_sub(1))] {
        if points[end].slope.is_finite() {
            continue;
        }
        let other = points.get(neighbour).filter(|_| end != neighbour);
        points[end].slope = other.map_or(c64::ZERO, |other| {
            let step = other.speed_rad_per_s - points[end].speed_rad_per_s;
            (other.number - points[end].number) / step
        });
    }
}

/// The point at another speed, next to that expected from its neighbours.
fn continued(
    numbers: &impl Numbers,
    known: &[CurvePoint],
    speed_rad_per_s: f64,
) -> Result<CurvePoint, SpectrumError> {
    let place = known.partition_point(|point| point.speed_rad_per_s < speed_rad_per_s);
    if let Some(&[before, after]) = known.get(place.saturating_sub(1)..=place) {
        let width = after.speed_rad_per_s - before.speed_rad_per_s;
        let share = (speed_rad_per_s - before.speed_rad_per_s) / width;
        return between(numbers, [before, after], share);
    }
    let away = |point: &&CurvePoint| (point.speed_rad_per_s - speed_rad_per_s).abs();
    let nearest = *smallest(known, away).unwrap_or(&known[0]);
    let step = speed_rad_per_s - nearest.speed_rad_per_s;
    let found = numbers.nearest(speed_rad_per_s, nearest.number + nearest.slope * step)?;
    if found.is_none() {
        numbers.note_interpolated();
    }
    let sloped = found.unwrap_or((nearest.number, nearest.slope));
    Ok(CurvePoint::new(speed_rad_per_s, sloped))
}
