//! Onset, end and peak of one band, to rounding.
//!
//! Where two modes of opposite Krein sign merge, (ω₁ − ω₂)² passes linearly through
//! zero and goes on as −4σ². Its root is well conditioned; the root of the growth
//! rate σ itself, which starts like a square root, is not.

use super::finder::Finder;
use super::station::{Sign, Station, Token};
use crate::spectrum::SpectrumError;

/// Relative accuracy in speed to which onsets are bracketed.
const SPEED_TOLERANCE: f64 = 1e-11;
/// The same before the pair itself is looked at.
const ROUGH_TOLERANCE: f64 = 1e-5;
/// How far beyond its bracket, relatively, an onset may turn out to be: the bracket comes
/// from few states.
const VICINITY: f64 = 1e-5;
/// Relative width below which a band is looked at as a crossing that failed.
const SHORT_BAND: f64 = 1e-3;
/// Relative differences of speed for the slope and the curvature of a discriminant: its
/// rounding is 1e-15 of ω², and the pair is exact to the square of the distance.
const NEWTON_DIFFERENCE: f64 = 1e-6;
const VERTEX_DIFFERENCE: f64 = 1e-5;
/// A last step of this relative length leaves its square, times how many widths of the
/// band the speed is: below the accuracy asked.
const NEWTON_TOLERANCE: f64 = 1e-8;
/// The same for the vertex of a crossing, whose onsets are refined by themselves.
const VERTEX_TOLERANCE: f64 = 3e-5;
const MAX_NEWTON: usize = 8;
/// Share of |ω| + Ω below which a growth rate is rounding.
const GROWTH_FLOOR: f64 = 1e-7;
const MAX_STEPS: usize = 120;

/// A band inside an interval of speeds.
pub struct Inside {
    /// Onset.
    pub from: f64,
    /// End.
    pub to: f64,
}

/// ((ω₁ − ω₂)/2)² of the pair at a place of the doubled list: −σ² once merged.
/// Of two real modes it is ((σ₁ − σ₂)/2)², and −ω² once they oscillate.
fn discriminant(station: &Station, place: usize, real: bool) -> Option<f64> {
    let tokens = station.doubled();
    let pair: [&Token; 2] = [tokens.get(place)?, tokens.get(place + 1)?];
    let signs = pair.map(|t| t.sign);
    match signs {
        [Sign::Merged, Sign::Merged] if real => Some(-pair[0].frequency.powi(2)),
        [Sign::Merged, Sign::Merged] => Some(-pair[0].growth.powi(2)),
        [Sign::Real, Sign::Real] => Some((0.5 * (pair[1].growth - pair[0].growth)).powi(2)),
        [Sign::Plus, Sign::Minus] | [Sign::Minus, Sign::Plus] => {
            Some((0.5 * (pair[1].frequency - pair[0].frequency)).powi(2))
        }
        _ => None,
    }
}

/// Speed at which the pair at `place` merges, between a station where it is apart and
/// one where it is merged. The first look goes by the few states of the finder; the last by
/// the pair itself. `None` where the two have not merged after all.
pub fn boundary(
    finder: &Finder<'_>,
    apart: &Station,
    merged: &Station,
    place: usize,
) -> Result<Option<f64>, SpectrumError> {
    let ends = (apart.speed_rad_per_s, merged.speed_rad_per_s);
    if !is_real(apart, place) {
        let near = |speed| finder.station(speed);
        let rough = false_position(&near, apart, merged, place, ROUGH_TOLERANCE)?;
        let pair = rough.doubled();
        let frequency = pair.get(place).map_or(0.0, |token| token.frequency);
        let speed = rough.speed_rad_per_s;
        if let Some(onset) = sharpened_onset(finder, speed, frequency, ends)? {
            return Ok(Some(onset));
        }
    }
    let exact = |speed| finder.exact_station(speed);
    let (apart, merged) = (exact(ends.0)?, exact(ends.1)?);
    let inside = discriminant(&merged, place, is_real(&apart, place));
    if inside.is_none_or(|d| d >= 0.0) {
        return Ok(None);
    }
    let onset = false_position(&exact, &apart, &merged, place, SPEED_TOLERANCE)?;
    Ok(Some(onset.speed_rad_per_s))
}

/// Newton's method on the discriminant of the pair, refined anew at each speed: from the
/// side `ends.0`, where it is positive, to `ends.1`, where it is negative. `None` where it
/// does not settle between them.
fn sharpened_onset(
    finder: &Finder<'_>,
    start: f64,
    frequency: f64,
    ends: (f64, f64),
) -> Result<Option<f64>, SpectrumError> {
    let (low, high) = (ends.0.min(ends.1), ends.0.max(ends.1));
    let (mut speed, mut frequency) = (start, frequency);
    for _ in 0..MAX_NEWTON {
        let Some(pair) = finder.pair(speed, frequency)? else {
            return Ok(None);
        };
        let h = NEWTON_DIFFERENCE * speed;
        let [before, here, after] = [-h, 0.0, h].map(|d| pair.discriminant(speed + d));
        let slope = (after - before) / (2.0 * h);
        let next = speed - here / slope;
        let margin = VICINITY * speed;
        let lost = !(low - margin..=high + margin).contains(&next);
        if lost || slope * (ends.1 - ends.0) >= 0.0 {
            return Ok(None);
        }
        if (next - speed).abs() <= NEWTON_TOLERANCE * speed {
            return Ok(Some(next));
        }
        frequency = pair.mean_frequency(next);
        speed = next;
    }
    Ok(None)
}

/// Whether the token at a place of the doubled list is a real λ.
pub fn is_real(station: &Station, place: usize) -> bool {
    station
        .doubled()
        .get(place)
        .is_some_and(|t| t.sign == Sign::Real)
}

/// How the word of a speed is had.
type Look<'a> = &'a dyn Fn(f64) -> Result<Station, SpectrumError>;

/// False position in its Illinois form on the discriminant: the last station inside.
fn false_position(
    look: Look<'_>,
    apart: &Station,
    merged: &Station,
    place: usize,
    tolerance: f64,
) -> Result<Station, SpectrumError> {
    let value = |station: &Station| discriminant(station, place, is_real(apart, place));
    let (mut out, mut inn) = (apart.speed_rad_per_s, merged.clone());
    let mut d_out = value(apart).unwrap_or(1.0);
    let mut d_inn = value(merged).unwrap_or(-1.0);
    for step in 0..MAX_STEPS {
        let width = inn.speed_rad_per_s - out;
        if width.abs() <= tolerance * inn.speed_rad_per_s.abs() || d_out == d_inn {
            break;
        }
        // A halving now and then bounds the steps whatever the function does.
        let share = if step % 8 == 7 {
            0.5
        } else {
            d_out / (d_out - d_inn)
        };
        let station = look(out + share.clamp(1e-4, 1.0 - 1e-4) * width)?;
        // Where neighbours in the word have moved, the place is not the pair's any
        // more; then the word alone says which side this is.
        let side = || {
            if station.word() == merged.word() {
                -1e-3 * d_out
            } else {
                -1e-3 * d_inn
            }
        };
        let d = value(&station).unwrap_or_else(side);
        if d > 0.0 {
            (out, d_out) = (station.speed_rad_per_s, d);
            d_inn *= 0.5;
        } else {
            (inn, d_inn) = (station, d);
            d_out *= 0.5;
        }
    }
    Ok(inn)
}

/// What a pair that has exchanged its order did in between.
enum Passage {
    /// It crossed.
    Crossing,
    /// It merged and parted.
    Band(Inside),
}

/// The band of a pair that stands in one order before and in the other after, or
/// `None` where it crosses without merging.
pub fn band_between(
    finder: &Finder<'_>,
    before: &Station,
    after: &Station,
    place: usize,
) -> Result<Option<Inside>, SpectrumError> {
    let near = |speed| finder.station(speed);
    let passage = match passage(finder, &near, [before, after], place)? {
        Some(passage) => Some(passage),
        None => {
            let exact = |speed| finder.exact_station(speed);
            let ends = [
                &exact(before.speed_rad_per_s)?,
                &exact(after.speed_rad_per_s)?,
            ];
            passage(finder, &exact, ends, place)?
        }
    };
    Ok(match passage {
        Some(Passage::Band(inside)) => Some(inside),
        Some(Passage::Crossing) | None => None,
    })
}

/// Bisection on the order, sped up by the zero of the signed gap, until the pair is seen
/// merged or is so near to its crossing that the pair itself must tell. `None` where it
/// does not.
fn passage(
    finder: &Finder<'_>,
    look: Look<'_>,
    [before, after]: [&Station; 2],
    place: usize,
) -> Result<Option<Passage>, SpectrumError> {
    let (mut low, mut high) = (before.clone(), after.clone());
    for step in 0..MAX_STEPS {
        let gap =
            |s: &Station| discriminant(s, place, false).map_or(0.0, |d| 2.0 * d.max(0.0).sqrt());
        let (g_low, g_high) = (gap(&low), gap(&high));
        let width = high.speed_rad_per_s - low.speed_rad_per_s;
        // Two modes whose gap closes at slope s cannot grow faster than s·width/4
        // inside this width: what is left is below what eigenvalues can show.
        let highest = high.tokens.last().map_or(0.0, |t| t.frequency);
        let floor = GROWTH_FLOOR * (high.speed_rad_per_s + highest);
        let narrow = width <= ROUGH_TOLERANCE * high.speed_rad_per_s;
        let share = if step % 3 == 2 {
            0.5
        } else {
            (g_low / (g_low + g_high)).clamp(0.02, 0.98)
        };
        let speed = low.speed_rad_per_s + share * width;
        if narrow || 0.25 * (g_low + g_high) < floor {
            let frequency = low.doubled().get(place).map_or(0.0, |t| t.frequency);
            let ends = (before.speed_rad_per_s, after.speed_rad_per_s);
            return sharpened_passage(finder, speed, frequency, ends, floor);
        }
        let middle = look(speed)?;
        if discriminant(&middle, place, false).is_some_and(|d| d < 0.0) {
            if width <= SHORT_BAND * speed {
                let frequency = middle.doubled().get(place).map_or(0.0, |t| t.frequency);
                let ends = (before.speed_rad_per_s, after.speed_rad_per_s);
                let sharp = sharpened_passage(finder, speed, frequency, ends, floor)?;
                if sharp.is_some() {
                    return Ok(sharp);
                }
            }
            let from = boundary(finder, &low, &middle, place)?;
            let to = boundary(finder, &high, &middle, place)?;
            let band = from.zip(to).map(|(from, to)| Inside { from, to });
            return Ok(band.map(Passage::Band));
        }
        if middle.word() == after.word() {
            high = middle;
        } else {
            low = middle;
        }
    }
    Ok(None)
}

/// The least discriminant of a pair that crosses or nearly does, by parabolas through the
/// pair refined anew at each vertex, and the two onsets where it is negative.
fn sharpened_passage(
    finder: &Finder<'_>,
    start: f64,
    frequency: f64,
    ends: (f64, f64),
    floor: f64,
) -> Result<Option<Passage>, SpectrumError> {
    let (mut speed, mut frequency) = (start, frequency);
    for _ in 0..MAX_NEWTON {
        let Some(pair) = finder.pair(speed, frequency)? else {
            return Ok(None);
        };
        let h = VERTEX_DIFFERENCE * speed;
        let [before, here, after] = [-h, 0.0, h].map(|d| pair.discriminant(speed + d));
        let bend = (before - 2.0 * here + after) / (h * h);
        let vertex = speed - (after - before) / (2.0 * h * bend);
        if bend <= 0.0 || !(ends.0..=ends.1).contains(&vertex) {
            return Ok(None);
        }
        frequency = pair.mean_frequency(vertex);
        if (vertex - speed).abs() > VERTEX_TOLERANCE * speed {
            speed = vertex;
            continue;
        }
        let lowest = pair.discriminant(vertex);
        if lowest >= -floor * floor {
            return Ok(Some(Passage::Crossing));
        }
        let half = (-2.0 * lowest / bend).sqrt();
        let onset =
            |edge: f64, outer: f64| sharpened_onset(finder, edge, frequency, (outer, vertex));
        let from = onset(vertex - half, ends.0)?;
        let to = onset(vertex + half, ends.1)?;
        let band = from.zip(to).map(|(from, to)| Inside { from, to });
        return Ok(band.map(Passage::Band));
    }
    Ok(None)
}

/// Speed and value of the largest f on [from, to], by a coarse look and then
/// successive parabolas: squared growth is nearly a parabola across a band. At an end where
/// f is known to be zero it is not looked at: there the modes cannot be told apart.
pub fn maximise(
    (from, to): (f64, f64),
    zero_at_ends: [bool; 2],
    mut f: impl FnMut(f64) -> Result<f64, SpectrumError>,
) -> Result<(f64, f64), SpectrumError> {
    const LOOKS: usize = 4;
    let mut points = Vec::new();
    for k in 0..=LOOKS {
        let speed = from + (to - from) * k as f64 / LOOKS as f64;
        let zero = (k == 0 && zero_at_ends[0]) || (k == LOOKS && zero_at_ends[1]);
        points.push((speed, if zero { 0.0 } else { f(speed)? }));
    }
    for _ in 0..12 {
        points.sort_by(|x, y| x.0.total_cmp(&y.0));
        let best = (0..points.len())
            .max_by(|&i, &k| points[i].1.total_cmp(&points[k].1))
            .unwrap_or(0);
        if best == 0 || best + 1 == points.len() {
            break;
        }
        let [left, middle, right] = [points[best - 1], points[best], points[best + 1]];
        let vertex = parabola_vertex(left, middle, right);
        let resolution = 1e-4 * (to - from);
        if !((left.0 + resolution)..(right.0 - resolution)).contains(&vertex)
            || (vertex - middle.0).abs() < resolution
        {
            break;
        }
        points.push((vertex, f(vertex)?));
    }
    Ok(points
        .into_iter()
        .fold((from, 0.0), |best, p| if p.1 > best.1 { p } else { best }))
}

fn parabola_vertex(left: (f64, f64), middle: (f64, f64), right: (f64, f64)) -> f64 {
    let (a, b) = (middle.0 - left.0, middle.0 - right.0);
    let (fa, fb) = (middle.1 - left.1, middle.1 - right.1);
    let denominator = a * fb - b * fa;
    if denominator == 0.0 {
        return middle.0;
    }
    middle.0 - 0.5 * (a * a * fb - b * b * fa) / denominator
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_vertex_of_a_parabola_is_exact() {
        let f = |x: f64| 3.0 - 2.0 * (x - 0.7).powi(2);
        let vertex = parabola_vertex((0.0, f(0.0)), (0.5, f(0.5)), (2.0, f(2.0)));
        assert!((vertex - 0.7).abs() < 1e-12);
    }

    #[test]
    fn the_maximum_of_a_skew_hump_is_found() {
        let (speed, value) = maximise((0.0, 2.0), [false; 2], |x| Ok(x * (-x * x).exp())).unwrap();
        assert!((speed - 0.5_f64.sqrt()).abs() < 1e-4, "{speed}");
        assert!(value > 0.42888);
    }

    /// Divergence that ends where two real λ meet is fastest there, not zero.
    #[test]
    fn the_maximum_may_be_at_an_end_that_is_not_zero() {
        let (speed, value) = maximise((1.0, 2.0), [true, false], |x| Ok(x - 1.0)).unwrap();
        assert_eq!((speed, value), (2.0, 1.0));
    }
}
