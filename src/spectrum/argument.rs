//! How far the argument of a function turns along a path: the argument principle counts roots by it.

use std::f64::consts::TAU;

/// Turn between two neighbouring places beyond which there must be one in between.
const LARGEST_TURN: f64 = 0.7;
const MOST_HALVINGS: usize = 24;

/// How far an angle, known but for whole turns, turns along a path from the first to the last of some
/// ascending places, with as many in between as it takes to tell. `None` where it cannot be told: the
/// path meets a root.
pub fn turn_along(places: &[f64], angle: impl Fn(f64) -> Option<f64>) -> Option<f64> {
    let mut before = (*places.first()?, angle(*places.first()?)?);
    let mut total = 0.0;
    for &place in &places[1..] {
        let here = (place, angle(place)?);
        total += turned(&angle, before, here, 0)?;
        before = here;
    }
    Some(total)
}

fn turned(
    angle: &impl Fn(f64) -> Option<f64>,
    (from, before): (f64, f64),
    (to, after): (f64, f64),
    halvings: usize,
) -> Option<f64> {
    let turn = after - before;
    let turn = turn - TAU * (turn / TAU).round();
    if turn.abs() < LARGEST_TURN {
        return Some(turn);
    }
    if halvings == MOST_HALVINGS {
        return None;
    }
    let middle = 0.5 * (from + to);
    let here = (middle, angle(middle)?);
    let first = turned(angle, (from, before), here, halvings + 1)?;
    Some(first + turned(angle, here, (to, after), halvings + 1)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// z³ around the unit circle, and a place where nothing can be told.
    #[test]
    fn whole_turns_are_counted() {
        let places = [0.0, 1.0, TAU];
        let cube = |t: f64| Some((3.0 * t).sin().atan2((3.0 * t).cos()));
        let turns = turn_along(&places, cube).unwrap() / TAU;
        assert!((turns - 3.0).abs() < 1e-12, "{turns}");
        let jump = |t: f64| Some(if t < 1.5 { 0.0 } else { 2.0 });
        assert_eq!(turn_along(&places, jump), None);
    }
}
