//! Branches of the Campbell diagram as the report has them.

use std::f64::consts::TAU;

use super::BranchEntry;
use crate::campbell::Branch;
use crate::scene::rpm;
use crate::spectrum::{DescribedMode, Direction, in_words};
use crate::stability::Analysis;

/// By frequency at their lowest speed.
pub fn branches(analysis: &Analysis) -> Vec<BranchEntry> {
    let mut entries: Vec<BranchEntry> = analysis
        .chart
        .campbell
        .branches
        .iter()
        .map(|branch| branch_entry(analysis, branch))
        .collect();
    let start = |e: &BranchEntry| (e.rpm[0], e.frequency_hz[0]);
    entries.sort_by(|x, y| {
        let (x, y) = (start(x), start(y));
        x.0.total_cmp(&y.0).then(x.1.total_cmp(&y.1))
    });
    entries
}

fn branch_entry(analysis: &Analysis, branch: &Branch) -> BranchEntry {
    let campbell = &analysis.chart.campbell;
    let modes: Vec<&DescribedMode> = branch.points.iter().map(|&p| campbell.mode(p)).collect();
    let ((nodal_diameters, nodal_circles), direction) = branch_name(&modes);
    let list = |value: fn(&DescribedMode) -> f64| modes.iter().map(|m| value(m)).collect();
    BranchEntry {
        name: in_words(nodal_diameters, nodal_circles, direction),
        nodal_diameters,
        nodal_circles,
        direction,
        rpm: branch
            .points
            .iter()
            .map(|&(s, _)| rpm(campbell.samples[s].speed_rad_per_s))
            .collect(),
        frequency_hz: list(|m| m.mode.frequency_rad_per_s() / TAU),
        body_frequency_hz: list(|m| m.name.body_frequency_rad_per_s / TAU),
        growth_per_s: list(|m| m.mode.growth_per_s()),
        krein_sign: modes.iter().map(|m| m.mode.krein_sign()).collect(),
        dominant_harmonics: modes
            .iter()
            .map(|m| {
                let diameters =
                    |place: usize| m.name.harmonics.get(place).map_or(0, |h| h.diameters);
                [diameters(0), diameters(1)]
            })
            .collect(),
    }
}

/// What most points of a branch are called; at rest waves stand, which names no direction.
fn branch_name(modes: &[&DescribedMode]) -> ((usize, usize), Direction) {
    let commonest = |names: Vec<(usize, usize, Direction)>| {
        let count = |name: &(usize, usize, Direction)| names.iter().filter(|n| *n == name).count();
        names.iter().copied().rev().max_by_key(count)
    };
    let named = |m: &&DescribedMode| {
        (
            m.name.diameters,
            m.name.circles,
            m.name.direction_on_blade(),
        )
    };
    let names = modes
        .iter()
        .skip(usize::from(modes.len() > 1))
        .map(named)
        .collect();
    let (diameters, circles, direction) = commonest(names).unwrap_or((0, 0, Direction::Standing));
    ((diameters, circles), direction)
}
