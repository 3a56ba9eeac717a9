//! Change of the argument of a function along a path, by which the argument principle counts roots.

use std::f64::consts::TAU;

/// Largest change of the angle between two neighbouring points, in rad; beyond it a point is added between them.
const LARGEST_TURN: f64 = 0.7;
/// Number of halvings of an interval after which the path passes through a root.
const MOST_HALVINGS: usize = 24;

/// Change of an angle, known up to whole turns, along a path from the first to the last of some ascending
/// points; points are added between them as needed. `None` if the change is undetermined, because the path
/// passes through a root.
pub fn turn_along(places: &[f64], angle: impl Fn(f64) -> Option<f64>) -> Option<f64> {
    let mut before = [*places.first()?, angle(*places.first()?)?];
    let mut total = 0.0;
    for &place in &places[1..] {
        let here = [place, angle(place)?];
        total += turned(&angle, before, here, 0)?;
        before = here;
    }
    Some(total)
}

/// Change of the angle between two points, from halves if it is too large to be certain.
fn turned(
    angle: &impl Fn(f64) -> Option<f64>,
    [from, before]: [f64; 2],
    [to, after]: [f64; 2],
    halvings: usize,
) -> Option<f64> {
    let change = after - before;
    let turn = change - TAU * (change / TAU).round();
    if turn.abs() < LARGEST_TURN {
        return Some(turn);
    }
    if halvings == MOST_HALVINGS {
        return None;
    }
    let middle = 0.5 * (from + to);
    let here = [middle, angle(middle)?];
    let first = turned(angle, [from, before], here, halvings + 1)?;
    Some(first + turned(angle, here, [to, after], halvings + 1)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// z³ turns three times around the unit circle; an angle that jumps by 2 rad is undetermined.
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
