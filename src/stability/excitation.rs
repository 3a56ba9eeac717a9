//! Crossings of natural frequencies with excitation at multiples of the rotation frequency.
//!
//! On the line of order k, the frequency in space is kΩ. If a branch is on different sides of the line at two
//! speeds of the chart, the crossing is a root of ω(Ω) − kΩ, with ω from the modes at speeds between. At the
//! crossing L(ikΩ) is singular: without damping K₀x = Ω²[k² − 2ikG − (K_σ − N)]x, which for k = 0 gives the
//! critical speeds.

use rayon::prelude::*;

use super::root::{Look, bracketed};
use super::search_result::StabilityChart;
use crate::model::scene::ExcitationLine;
use crate::modes::{SpectralModel, SpectrumError, smallest};

/// A speed at which a mode has the frequency of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// Excitation line.
    pub line: ExcitationLine,
    /// Rotation speed Ω.
    pub speed_rad_per_s: f64,
    /// Last point of the branch before the crossing: index of the speed, and of the mode at this speed.
    pub point: (usize, usize),
}

/// Relative error of a crossing's speed.
const TOLERANCE: f64 = 1e-9;
/// A branch within this relative distance of a line coincides with the line: a free rigid tilt has twice the
/// rotation frequency at every speed.
const ON_THE_LINE: f64 = 1e-7;

/// Crossings of the lines with the branches of a chart, by line and speed.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub fn crossings(
    model: &SpectralModel,
    chart: &StabilityChart,
    lines: &[ExcitationLine],
) -> Result<Vec<Crossing>, SpectrumError> {
    let campbell = &chart.campbell;
    let at = |&(sample, mode): &(usize, usize)| {
        let sample = &campbell.samples[sample];
        let mode = &sample.modes[mode].mode;
        (sample.speed_rad_per_s, mode.lambda.im.abs(), mode.component)
    };
    let mut brackets = Vec::new();
    for line in lines {
        let off = |(speed, frequency): (f64, f64)| {
            let carried = f64::from(line.order) * speed;
            let off = frequency - carried;
            if off.abs() > ON_THE_LINE * (frequency + carried) {
                off
            } else {
                0.0
            }
        };
        for branch in &campbell.branches {
            // Points on the line itself lie between two others: a line may cross the branch at a drawn speed.
            let sides = branch.points.iter().map(|point| {
                let place = at(point);
                (point, place, off((place.0, place.1)))
            });
            let mut beside = sides.clone().filter(|(_, _, off)| *off != 0.0);
            let mut last = beside.next();
            for next in beside {
                if let Some((point, low, _)) = last.filter(|(_, _, off)| off * next.2 < 0.0) {
                    brackets.push((*line, *point, low, next.1));
                }
                last = Some(next);
            }
            // The last point, if it is on the line and the one before is not.
            let mut ends = sides.rev();
            if let (Some((_, high, 0.0)), Some((point, low, off))) = (ends.next(), ends.next())
                && off != 0.0
            {
                brackets.push((*line, *point, low, high));
            }
        }
    }
    let mut found: Vec<Crossing> = brackets
        .into_par_iter()
        .map(|(line, point, low, high)| {
            let ends = [[low.0, low.1], [high.0, high.1]];
            Ok(Crossing {
                line,
                speed_rad_per_s: root(model, line, low.2, ends)?,
                point,
            })
        })
        .collect::<Result<_, SpectrumError>>()?;
    found.sort_by(|x, y| {
        let speeds = x.speed_rad_per_s.total_cmp(&y.speed_rad_per_s);
        x.line.order.cmp(&y.line.order).then(speeds)
    });
    Ok(found)
}

/// Speed between two others at which a frequency of a component equals that of the line. `ends` are speeds
/// and frequencies of a branch.
fn root(
    model: &SpectralModel,
    line: ExcitationLine,
    component: usize,
    ends: [[f64; 2]; 2],
) -> Result<f64, SpectrumError> {
    let seen = |[speed, frequency]: [f64; 2]| Look {
        at: speed,
        value: frequency - f64::from(line.order) * speed,
        point: [speed, frequency],
    };
    let found = bracketed(ends.map(seen), TOLERANCE, |[from, to], share| {
        let between = |from: f64, to: f64| from + share * (to - from);
        let speed = between(from[0], to[0]);
        let expected = between(from[1], to[1]);
        let modes = model.modes(speed)?;
        let own = modes.iter().filter(|mode| mode.component == component);
        let frequencies = own.map(|mode| mode.lambda.im.abs());
        let nearest = smallest(frequencies, |frequency| (frequency - expected).abs());
        Ok::<_, SpectrumError>(seen([speed, nearest.unwrap_or(expected)]))
    });
    found.map(|look| look.at)
}
