//! Onset and end of one band, to rounding: by pursuit of its pair of modes, and where that
//! fails by the words of speeds.

use super::finder::Finder;
use super::pursuit::{self, Inside, Passage};
use super::station::{Sign, Station, Token};
use crate::spectrum::SpectrumError;

/// Relative accuracy in speed to which onsets are bracketed.
const SPEED_TOLERANCE: f64 = 1e-11;
/// Relative distance within which few states show where a pair merges.
const NARROW: f64 = 1e-6;
/// Relative width below which a crossing is not halved any more.
const ROUGH_TOLERANCE: f64 = 1e-5;
/// Share of |ω| + Ω below which a growth rate is rounding.
const GROWTH_FLOOR: f64 = 1e-7;
const MAX_STEPS: usize = 120;
/// Pursuits of a pair, each over half the distance of the one before: one that loses its pair
/// among its neighbours may keep it when it begins nearer.
const PURSUITS: usize = 20;

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
/// one where it is merged: by pursuit of the pair, and where that is lost by the words of
/// speeds. `None` where the two have not merged after all.
pub fn boundary(
    finder: &Finder<'_>,
    apart: &Station,
    merged: &Station,
    place: usize,
) -> Result<Option<f64>, SpectrumError> {
    let ends = (apart.speed_rad_per_s, merged.speed_rad_per_s);
    if !is_real(apart, place) {
        let (mut apart, mut merged) = (apart.clone(), merged.clone());
        for _ in 0..PURSUITS {
            let onset = pursuit::onset_between(finder, &apart, &merged, place)?;
            if onset.is_some() {
                return Ok(onset);
            }
            let middle = 0.5 * (apart.speed_rad_per_s + merged.speed_rad_per_s);
            let middle = finder.station(middle)?;
            match middle.word() {
                word if word == merged.word() => merged = middle,
                word if word == apart.word() => apart = middle,
                _ => break,
            }
        }
    }
    let exact = |speed| finder.exact_station(speed);
    let [apart, merged] = match narrowed(finder, apart, merged, place)? {
        Some(narrow) => narrow,
        None => [exact(ends.0)?, exact(ends.1)?],
    };
    let inside = discriminant(&merged, place, is_real(&apart, place));
    if inside.is_none_or(|d| d >= 0.0) {
        return Ok(None);
    }
    false_position(&exact, &apart, &merged, place, SPEED_TOLERANCE).map(Some)
}

/// The two stations, moved to both sides of the merging that few states show. `None` where it
/// is not between them: then they are too near to another event.
fn narrowed(
    finder: &Finder<'_>,
    apart: &Station,
    merged: &Station,
    place: usize,
) -> Result<Option<[Station; 2]>, SpectrumError> {
    let near = |speed| finder.station(speed);
    let speed = false_position(&near, apart, merged, place, 0.1 * NARROW)?;
    let room = [apart, merged].map(|end| (speed - end.speed_rad_per_s).abs());
    if room.iter().any(|room| *room <= NARROW * speed) {
        return Ok(None);
    }
    let step = (merged.speed_rad_per_s - speed).signum() * NARROW * speed;
    let before = finder.exact_station(speed - step)?;
    let after = finder.exact_station(speed + step)?;
    let same = before.word() == apart.word() && after.word() == merged.word();
    Ok(same.then_some([before, after]))
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

/// False position in its Illinois form on the discriminant, to a relative width: the last speed
/// inside.
fn false_position(
    look: Look<'_>,
    apart: &Station,
    merged: &Station,
    place: usize,
    tolerance: f64,
) -> Result<f64, SpectrumError> {
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
    Ok(inn.speed_rad_per_s)
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

/// Bisection on the order, sped up by the zero of the signed gap, until the pair can be
/// pursued or is seen merged. `None` where neither happens.
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
        let last = narrow || 0.25 * (g_low + g_high) < floor;
        if last || step % 3 == 0 {
            let passage = pursuit::passage_between(finder, [&low, &high], place, floor)?;
            if last || passage.is_some() {
                return Ok(passage);
            }
        }
        let share = if step % 3 == 2 {
            0.5
        } else {
            (g_low / (g_low + g_high)).clamp(0.02, 0.98)
        };
        let middle = look(low.speed_rad_per_s + share * width)?;
        if discriminant(&middle, place, false).is_some_and(|d| d < 0.0) {
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
