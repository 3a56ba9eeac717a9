//! The curve of a branch, with a description of each point.

use super::waves::direction_at;
use crate::analyses::campbell::{BranchCurve, Direction};
use crate::page::figure::items::Line;
use crate::page::figure::palette::Hue;
use crate::page::text::shown_to;

/// A curve of a branch through the samples with given numbers; `values` are the ordinates of all its samples.
pub fn line_through(
    branch: &BranchCurve,
    values: &[f64],
    samples: &[Option<usize>],
    colour: Hue,
    said: bool,
) -> Line {
    let nowhere = [f64::NAN; 2];
    let points = samples
        .iter()
        .map(|sample| sample.map_or(nowhere, |i| [branch.rpm[i], values[i]]));
    let words = samples
        .iter()
        .map(|sample| sample.map_or_else(String::new, |i| say(branch, i)));
    Line {
        said: if said { words.collect() } else { Vec::new() },
        branch: Some(branch.branch),
        ..Line::new(points, colour, &branch.name)
    }
}

/// Description of a branch at one of its samples.
pub fn say(branch: &BranchCurve, i: usize) -> String {
    let hz = branch.frequency_hz.get(i).copied().unwrap_or(f64::NAN);
    let growth = branch.growth_per_s.get(i).copied().unwrap_or(f64::NAN);
    let sign = match branch.krein_sign.get(i) {
        Some(1..) => "+1",
        Some(..=-1) => "\u{2212}1, reflected",
        _ => "none",
    };
    let lines = [
        format!("{}, {}", branch.name, way(direction_at(branch, i))),
        format!("{:.1} rpm", branch.rpm[i]),
        format!("{hz:.3} Hz"),
        format!("growth {} 1/s", shown_to(3, growth)),
        format!("Krein sign {sign}"),
    ];
    lines.join("\n")
}

fn way(direction: Direction) -> &'static str {
    match direction {
        Direction::Forward => "forward",
        Direction::Backward | Direction::Reflected => "backward",
        Direction::Standing => "standing",
    }
}
