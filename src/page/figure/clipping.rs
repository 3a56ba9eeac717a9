//! Clips lines at the edges of a panel, because plotters does not.

use super::canvas::Frame;

/// The parts of a line inside the frame; non-finite points divide the line.
pub fn clip(points: &[[f64; 2]], frame: &Frame) -> Vec<Vec<[f64; 2]>> {
    let mut parts: Vec<Vec<[f64; 2]>> = Vec::new();
    for segment in points.windows(2) {
        let Some([start, end]) = clip_segment(segment[0], segment[1], frame) else {
            continue;
        };
        match parts.last_mut() {
            Some(part) if part.last() == Some(&start) => part.push(end),
            _ => parts.push(vec![start, end]),
        }
    }
    parts
}

/// The part of a segment inside the frame, by the algorithm of Liang and Barsky; `None` if no part is inside
/// or a coordinate is not finite.
fn clip_segment(a: [f64; 2], b: [f64; 2], frame: &Frame) -> Option<[[f64; 2]; 2]> {
    if ![a, b].as_flattened().iter().all(|value| value.is_finite()) {
        return None;
    }
    let bounds = [[frame.left, frame.right], [frame.top, frame.bottom]];
    let (mut enters, mut leaves) = (0.0f64, 1.0f64);
    for axis in 0..2 {
        let way = b[axis] - a[axis];
        let [to_low, to_high] = bounds[axis].map(|bound| bound - a[axis]);
        if way == 0.0 {
            if to_low > 0.0 || to_high < 0.0 {
                return None;
            }
            continue;
        }
        let (first, second) = (to_low / way, to_high / way);
        enters = enters.max(first.min(second));
        leaves = leaves.min(first.max(second));
    }
    let along = |t: f64| [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
    // Ends that are not clipped remain bit for bit the same, so that `clip` recognizes neighbouring segments.
    let start = if enters == 0.0 { a } else { along(enters) };
    let end = if leaves == 1.0 { b } else { along(leaves) };
    (enters < leaves).then_some([start, end])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_that_leaves_and_returns_has_two_parts() {
        let frame = Frame::around([5.0, 5.0], 5.0);
        let tent = [
            [0.0, 5.0],
            [4.0, -3.0],
            [8.0, 5.0],
            [9.0, f64::NAN],
            [9.0, 20.0],
        ];
        let parts = clip(&tent, &frame);
        let expected = [vec![[0.0, 5.0], [2.5, 0.0]], vec![[5.5, 0.0], [8.0, 5.0]]];
        assert_eq!(parts, expected);
    }
}
