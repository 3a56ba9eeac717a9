//! Placement of labels without overlap.

/// A label with its preferred centre on a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wish {
    /// Preferred centre.
    pub centre: f64,
    /// Length of the label, with the space at its ends.
    pub length: f64,
}

/// Centres that are closest to the preferred ones in the least squares sense, such that labels neither
/// overlap nor leave the range from `from` to `to`. Labels at the end of the list are dropped (`None`) if
/// there is not enough room.
pub fn push_apart(wishes: &[Wish], from: f64, to: f64) -> Vec<Option<f64>> {
    let mut room = to - from;
    let kept = wishes
        .iter()
        .take_while(|wish| {
            room -= wish.length;
            room >= 0.0
        })
        .count();
    let mut order: Vec<usize> = (0..kept).collect();
    order.sort_by(|&a, &b| wishes[a].centre.total_cmp(&wishes[b].centre));

    let mut blocks: Vec<Block> = Vec::new();
    for &label in &order {
        let Wish { centre, length } = wishes[label];
        let mut block = Block::new(label, centre - length / 2.0, length);
        block.hold(from, to);
        while let Some(before) = blocks.pop_if(|before| before.end() > block.start) {
            block = before.joined_by(block);
            block.hold(from, to);
        }
        blocks.push(block);
    }

    let mut centres = vec![None; wishes.len()];
    for block in blocks {
        let mut start = block.start;
        for label in block.labels {
            centres[label] = Some(start + wishes[label].length / 2.0);
            start += wishes[label].length;
        }
    }
    centres
}

/// Labels that touch each other.
struct Block {
    labels: Vec<usize>,
    start: f64,
    length: f64,
    /// Sum over the labels of the start of the block that each prefers.
    wished_starts: f64,
}

impl Block {
    fn new(label: usize, start: f64, length: f64) -> Self {
        let (labels, wished_starts) = (vec![label], start);
        Self {
            labels,
            start,
            length,
            wished_starts,
        }
    }

    fn end(&self) -> f64 {
        self.start + self.length
    }

    fn joined_by(mut self, next: Block) -> Block {
        self.wished_starts += next.wished_starts - self.length * next.labels.len() as f64;
        self.length += next.length;
        self.labels.extend(next.labels);
        self
    }

    fn hold(&mut self, from: f64, to: f64) {
        let mean = self.wished_starts / self.labels.len() as f64;
        self.start = mean.min(to - self.length).max(from);
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

    fn wishes(centres: &[f64]) -> Vec<Wish> {
        let wish = |&centre| Wish {
            centre,
            length: 10.0,
        };
        centres.iter().map(wish).collect()
    }

    #[test]
    fn crowded_labels_spread_evenly_about_their_wishes() {
        let centres = push_apart(&wishes(&[52.0, 50.0, 90.0]), 0.0, 100.0);
        assert_eq!(centres, [Some(56.0), Some(46.0), Some(90.0)]);
    }

    #[test]
    fn labels_stay_within_the_line() {
        let centres = push_apart(&wishes(&[0.0, -5.0, 3.0]), 0.0, 100.0);
        assert_eq!(centres, [Some(15.0), Some(5.0), Some(25.0)]);
    }

    #[test]
    fn the_last_labels_are_dropped_first() {
        let centres = push_apart(&wishes(&[5.0, 5.0, 5.0]), 0.0, 25.0);
        assert_eq!(centres, [Some(5.0), Some(15.0), None]);
        assert_eq!(push_apart(&wishes(&[5.0]), 0.0, -1.0), [None]);
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
