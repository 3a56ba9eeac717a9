//! Placement of labels without overlap.

use super::style::label_width;

/// Length of a label along a line, and its preferred centre, in figure units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Preferred centre of the label.
    pub centre: f64,
    /// Length of the label, with the space at its ends.
    pub length: f64,
}

impl Extent {
    /// Extent of a horizontal label, with `space` in addition to its width.
    pub fn of_label(centre: f64, label: &str, space: f64) -> Self {
        let length = label_width(label) + space;
        Self { centre, length }
    }
}

/// Centres that are closest to the preferred ones in the least squares sense, such that labels neither overlap
/// nor leave the line between its two ends, the smaller first. If there is not enough room, labels at the end
/// of the list are dropped (`None`).
pub fn push_apart(
    labels: impl IntoIterator<Item = Extent>,
    [from, to]: [f64; 2],
) -> Vec<Option<f64>> {
    let extents: Vec<Extent> = labels.into_iter().collect();
    let mut room = to - from;
    let fits = |extent: &&Extent| {
        room -= extent.length;
        room >= 0.0
    };
    let kept = extents.iter().take_while(fits).count();
    let mut order: Vec<usize> = (0..kept).collect();
    order.sort_by(|&a, &b| extents[a].centre.total_cmp(&extents[b].centre));

    let mut blocks: Vec<Block> = Vec::new();
    for &label in &order {
        let Extent { centre, length } = extents[label];
        let mut block = Block {
            labels: vec![label],
            length,
            preferred_starts: centre - length / 2.0,
        };
        while let Some(before) =
            blocks.pop_if(|before| before.start(from, to) + before.length > block.start(from, to))
        {
            block = before.joined_by(block);
        }
        blocks.push(block);
    }

    let mut centres = vec![None; extents.len()];
    for block in blocks {
        let mut start = block.start(from, to);
        for label in block.labels {
            centres[label] = Some(start + extents[label].length / 2.0);
            start += extents[label].length;
        }
    }
    centres
}

/// Labels that touch each other.
struct Block {
    labels: Vec<usize>,
    length: f64,
    /// Sum over the labels of the start of the block that each prefers.
    preferred_starts: f64,
}

impl Block {
    /// Best start of the block on a line between two ends.
    fn start(&self, from: f64, to: f64) -> f64 {
        let mean = self.preferred_starts / self.labels.len() as f64;
        mean.min(to - self.length).max(from)
    }

    fn joined_by(mut self, next: Block) -> Block {
        self.preferred_starts += next.preferred_starts - self.length * next.labels.len() as f64;
        self.length += next.length;
        self.labels.extend(next.labels);
        self
    }
}

/// Values at neighbouring positions, with a common label.
#[derive(Debug, Clone, PartialEq)]
pub struct Cluster {
    /// Values of the label, ascending.
    pub values: Vec<f64>,
    /// Centre of the label on its line, in figure units.
    pub centre: f64,
    /// Text of the label.
    pub label: String,
}

/// Joins labels of ascending values until none overlap. `place` returns the position of a value, `width` the
/// width of a label; labels stay between `from` and `to`.
pub fn join_close(
    values: &[f64],
    place: impl Fn(f64) -> f64,
    width: impl Fn(&str) -> f64,
    [from, to]: [f64; 2],
) -> Vec<Cluster> {
    let cluster = |values: Vec<f64>| {
        let label = joined_label(&values);
        let mean = values.iter().map(|&v| place(v)).sum::<f64>() / values.len() as f64;
        let half = width(&label) / 2.0;
        let centre = mean.min(to - half).max(from + half);
        Cluster {
            values,
            centre,
            label,
        }
    };
    let mut clusters: Vec<Cluster> = Vec::new();
    for &value in values {
        let mut next = cluster(vec![value]);
        let start = |c: &Cluster| c.centre - width(&c.label) / 2.0;
        let end = |c: &Cluster| c.centre + width(&c.label) / 2.0;
        while let Some(mut before) = clusters.pop_if(|before| end(before) > start(&next)) {
            before.values.extend(next.values);
            next = cluster(before.values);
        }
        clusters.push(next);
    }
    clusters
}

/// Label of several values: "1531 · 1552", or, for more than three values, the first, the last and their
/// number.
fn joined_label(values: &[f64]) -> String {
    match values {
        [first, .., last] if values.len() > 3 => {
            format!("{first:.0} … {last:.0} ({})", values.len())
        }
        _ => {
            let each: Vec<_> = values.iter().map(|value| format!("{value:.0}")).collect();
            each.join(" · ")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Places labels of length 10.
    fn placed(centres: &[f64], line: [f64; 2]) -> Vec<Option<f64>> {
        let extents = centres.iter().map(|&centre| Extent {
            centre,
            length: 10.0,
        });
        push_apart(extents, line)
    }

    #[test]
    fn crowded_labels_spread_evenly_about_their_preferred_centres() {
        let centres = placed(&[52.0, 50.0, 90.0], [0.0, 100.0]);
        assert_eq!(centres, [Some(56.0), Some(46.0), Some(90.0)]);
    }

    #[test]
    fn labels_stay_within_the_line() {
        let centres = placed(&[0.0, -5.0, 3.0], [0.0, 100.0]);
        assert_eq!(centres, [Some(15.0), Some(5.0), Some(25.0)]);
    }

    #[test]
    fn the_last_labels_are_dropped_first() {
        let centres = placed(&[5.0, 5.0, 5.0], [0.0, 25.0]);
        assert_eq!(centres, [Some(5.0), Some(15.0), None]);
        assert_eq!(placed(&[5.0], [0.0, -1.0]), [None]);
    }

    #[test]
    fn close_values_share_a_label() {
        let width = |label: &str| 7.0 * label.chars().count() as f64;
        let values = [1531.0, 1552.0, 2091.0];
        let clusters = join_close(&values, |v| v / 3.0, width, [0.0, 1000.0]);
        let labels: Vec<_> = clusters.iter().map(|c| c.label.as_str()).collect();
        assert_eq!(labels, ["1531 · 1552", "2091"]);
    }
}
