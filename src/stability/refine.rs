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
/// Relative distance from a rough onset at which the last look begins.
const VICINITY: f64 = 1e-5;
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
/// one where it is merged. The first look goes by the modes at the two ends; the last by
/// the modes next to the onset, where their span is exact to rounding.
pub fn boundary(
    finder: &Finder<'_>,
    apart: &Station,
    merged: &Station,
    place: usize,
) -> Result<f64, SpectrumError> {
    let (out, inn) = (apart.speed_rad_per_s, merged.speed_rad_per_s);
    let narrow = finder.narrowed(out.min(inn), out.max(inn))?;
    let rough = false_position(&narrow, apart, merged, place)?;
    let outwards = if out < inn { -1.0 } else { 1.0 };
    let clamped = |speed: f64| speed.clamp(out.min(inn), out.max(inn));
    let before = finder.station(clamped(rough * (1.0 + outwards * VICINITY)))?;
    let after = finder.station(clamped(rough * (1.0 - outwards * VICINITY)))?;
    let brackets = |station: &Station, inside: bool| {
        discriminant(station, place, is_real(apart, place)).is_some_and(|d| (d < 0.0) == inside)
    };
    if !(brackets(&before, false) && brackets(&after, true)) {
        return false_position(finder, apart, merged, place);
    }
    let (low, high) = (before.speed_rad_per_s, after.speed_rad_per_s);
    let near = finder.narrowed(low.min(high), low.max(high))?;
    false_position(&near, &before, &after, place)
}

/// Whether the token at a place of the doubled list is a real λ.
pub fn is_real(station: &Station, place: usize) -> bool {
    station
        .doubled()
        .get(place)
        .is_some_and(|t| t.sign == Sign::Real)
}

/// False position in its Illinois form on the discriminant.
fn false_position(
    finder: &Finder<'_>,
    apart: &Station,
    merged: &Station,
    place: usize,
) -> Result<f64, SpectrumError> {
    let value = |station: &Station| discriminant(station, place, is_real(apart, place));
    let (mut out, mut inn) = (apart.speed_rad_per_s, merged.speed_rad_per_s);
    let mut d_out = value(apart).unwrap_or(1.0);
    let mut d_inn = value(merged).unwrap_or(-1.0);
    for step in 0..MAX_STEPS {
        if (inn - out).abs() <= SPEED_TOLERANCE * inn.abs() || d_out == d_inn {
            break;
        }
        // A halving now and then bounds the steps whatever the function does.
        let share = if step % 8 == 7 {
            0.5
        } else {
            d_out / (d_out - d_inn)
        };
        let speed = out + share.clamp(1e-4, 1.0 - 1e-4) * (inn - out);
        let station = finder.station(speed)?;
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
            (out, d_out) = (speed, d);
            d_inn *= 0.5;
        } else {
            (inn, d_inn) = (speed, d);
            d_out *= 0.5;
        }
    }
    Ok(inn)
}

/// The band of a pair that stands in one order before and in the other after, or
/// `None` where it crosses without merging: bisection on the order, sped up by the
/// zero of the signed gap.
pub fn band_between(
    finder: &Finder<'_>,
    before: &Station,
    after: &Station,
    place: usize,
) -> Result<Option<Inside>, SpectrumError> {
    let narrow = finder.narrowed(before.speed_rad_per_s, after.speed_rad_per_s)?;
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
        if 0.25 * (g_low + g_high) < floor || width <= SPEED_TOLERANCE * high.speed_rad_per_s {
            return Ok(None);
        }
        let share = if step % 3 == 2 {
            0.5
        } else {
            (g_low / (g_low + g_high)).clamp(0.02, 0.98)
        };
        let middle = narrow.station(low.speed_rad_per_s + share * width)?;
        if discriminant(&middle, place, false).is_some_and(|d| d < 0.0) {
            return Ok(Some(Inside {
                from: boundary(finder, &low, &middle, place)?,
                to: boundary(finder, &high, &middle, place)?,
            }));
        }
        if middle.word() == after.word() {
            high = middle;
        } else {
            low = middle;
        }
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
        let resolution = 1e-5 * (to - from);
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
