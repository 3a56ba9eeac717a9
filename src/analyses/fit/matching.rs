//! Assignment of the measured frequencies of a row to computed modes.
//!
//! Away from rest every wave has a frequency of its own, and the k-th measured frequency is the k-th lowest computed one. At
//! rest the waves with nodal diameters of an axisymmetric blade are pairs of equal frequency: a tap shows a pair once, or
//! twice if slots or guides separate its frequencies.

use super::measurement::{Columns, Row};

/// Relative distance within which two frequencies at rest may appear as one: the resolution of a tap of a second at
/// 200 Hz.
const TWINS: f64 = 5e-3;

/// Frequency and nodal diameters of a computed mode; the diameters are those with the largest share.
#[derive(Debug, Clone, Copy)]
pub struct Tone {
    pub hz: f64,
    pub diameters: usize,
}

/// The index of the computed mode for each measured frequency of a row, in ascending order of the tones; `None` if the
/// basis has none.
pub fn matched(row: &Row, tones: &[Tone]) -> Vec<Option<usize>> {
    match row.columns {
        Columns::Diameters => (0..row.pairs.len())
            .map(|measured| of_lowest_pair(row, measured, tones))
            .collect(),
        Columns::Ranks if row.rpm == 0.0 => with_twins(row, tones),
        Columns::Ranks => row
            .pairs
            .iter()
            .map(|(place, _)| (*place < tones.len()).then_some(*place))
            .collect(),
    }
}

/// Of the lowest two modes with the nodal diameters of a measured frequency the nearer one, or, if both frequencies were
/// measured, the one of its rank; of the umbrella mode there is one.
fn of_lowest_pair(row: &Row, measured: usize, tones: &[Tone]) -> Option<usize> {
    let (diameters, hz) = row.pairs[measured];
    let count = if diameters == 0 { 1 } else { 2 };
    let mut pair = (0..tones.len())
        .filter(|index| tones[*index].diameters == diameters)
        .take(count);
    let twin = (0..row.pairs.len()).find(|k| *k != measured && row.pairs[*k].0 == diameters);
    if let Some(twin) = twin {
        let is_higher = (row.pairs[twin].1, twin) < (hz, measured);
        return pair.nth(usize::from(is_higher));
    }
    pair.min_by(|one, other| {
        let off = |index: &usize| (tones[*index].hz - hz).abs();
        off(one).total_cmp(&off(other))
    })
}

/// The ascending assignment of least squares in which a pair at rest counts for one measured frequency or for two; a blank
/// column stands for a pair or for a mode that was not measured.
fn with_twins(row: &Row, tones: &[Tone]) -> Vec<Option<usize>> {
    let mut measured = vec![None; row.depth()];
    for (place, hz) in &row.pairs {
        measured[*place] = Some(*hz);
    }
    let is_pair = |first: usize| {
        let next = tones.get(first + 1);
        next.is_some_and(|next| next.hz - tones[first].hz <= TWINS * next.hz)
    };
    // steps[k][first]: the best assignment of column k if the tones below `first` belong to the columns before it.
    let ends = tones.len() + measured.len() + 1;
    let mut steps: Vec<Vec<Step>> = vec![Vec::new(); measured.len()];
    for k in (0..measured.len()).rev() {
        let cost_from = |first: usize| steps.get(k + 1).map_or(0.0, |after| after[first].cost);
        let off = |index: usize| {
            let computed = tones.get(index).map_or(0.0, |tone| tone.hz);
            measured[k].map_or(0.0, |hz: f64| (computed - hz).powi(2))
        };
        // As many tones as columns may be missing at the end.
        let step = |first: usize| {
            let single = Step {
                tone: first,
                next: first + 1,
                cost: off(first) + cost_from(first + 1),
            };
            if !is_pair(first) {
                return single;
            }
            let tone = if off(first + 1) < off(first) {
                first + 1
            } else {
                first
            };
            let pair = Step {
                tone,
                next: first + 2,
                cost: off(tone) + cost_from(first + 2),
            };
            if pair.cost < single.cost {
                pair
            } else {
                single
            }
        };
        steps[k] = (0..ends + k - measured.len()).map(step).collect();
    }
    let mut first = 0;
    let mut used = Vec::with_capacity(row.pairs.len());
    for (step, hz) in steps.iter().zip(&measured) {
        let Step { tone, next, .. } = step[first];
        if hz.is_some() {
            used.push((tone < tones.len()).then_some(tone));
        }
        first = next;
    }
    used
}

/// A measured frequency and its tone.
#[derive(Debug, Clone, Copy)]
struct Step {
    tone: usize,
    /// The first tone that is left for the next column.
    next: usize,
    /// Sum of squares from here on.
    cost: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tones(list: &[(f64, usize)]) -> Vec<Tone> {
        list.iter()
            .map(|(hz, diameters)| Tone {
                hz: *hz,
                diameters: *diameters,
            })
            .collect()
    }

    /// A blade in a collar: the lowest pair has one nodal diameter and lies below the umbrella mode.
    #[test]
    fn a_pair_at_rest_is_measured_once_or_twice() {
        let computed = tones(&[(124.0, 1), (124.0, 1), (127.0, 0), (153.0, 2), (153.0, 2)]);
        let of = |rpm: f64, hz: &[f64]| {
            let columns: Vec<Option<f64>> = hz.iter().copied().map(Some).collect();
            let found = matched(&Row::new(rpm, &columns), &computed);
            found
                .into_iter()
                .map(Option::unwrap)
                .collect::<Vec<usize>>()
        };
        assert_eq!(of(0.0, &[124.3, 127.1, 152.6]), [0, 2, 3]);
        assert_eq!(
            of(0.0, &[123.8, 124.1, 127.1, 152.6, 153.1]),
            [0, 1, 2, 3, 4]
        );
        assert_eq!(of(0.0, &[124.0, 127.0, 152.8, 153.2]), [0, 2, 3, 4]);
        // In rotation both waves of a pair have their own frequencies.
        assert_eq!(of(300.0, &[119.0, 127.0, 129.0]), [0, 1, 2]);
    }

    #[test]
    fn columns_by_nodal_diameters_find_the_lowest_mode_of_each() {
        let computed = tones(&[(124.0, 1), (124.4, 1), (127.0, 0), (153.0, 2), (700.0, 0)]);
        let row = Row::by_diameters(0.0, &[(0, 127.1), (1, 124.3), (2, 152.0), (3, 260.0)]);
        assert_eq!(matched(&row, &computed), [Some(2), Some(1), Some(3), None]);
    }

    /// Both frequencies are nearer to the upper one of a pair that a guide separates.
    #[test]
    fn two_columns_of_the_same_nodal_diameters_are_both_of_a_pair() {
        let computed = tones(&[(118.0, 1), (124.0, 1), (127.0, 0), (153.0, 2)]);
        let row =
            |one: f64, other: f64| Row::by_diameters(0.0, &[(1, one), (0, 127.0), (1, other)]);
        for (row, expected) in [
            (row(122.0, 125.0), [0, 2, 1]),
            (row(125.0, 122.0), [1, 2, 0]),
            (row(124.0, 124.0), [0, 2, 1]),
        ] {
            assert_eq!(matched(&row, &computed), expected.map(Some));
        }
    }
}
