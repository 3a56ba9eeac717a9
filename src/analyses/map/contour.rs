//! Contours of a speed over a grid, by marching squares.

use super::{Contour, Contoured};

/// Number of contours aimed at.
const LEVELS: f64 = 8.0;

/// Contours at round speeds of values over a grid, one row for each value of y. Between the corners of a cell the values vary
/// linearly along its edges. A cell of which a corner has no value has no contours. `point` is the point at a column and
/// a row, counted from 0, with fractions between two of them.
pub fn contours(
    quantity: Contoured,
    rows: &[&[Option<f64>]],
    point: impl Fn([f64; 2]) -> [f64; 2],
) -> Vec<Contour> {
    let levels = levels(rows.iter().copied().flatten().flatten().copied());
    let all = levels.into_iter().flat_map(|rpm| {
        let lines = lines(rows, rpm, &point).into_iter();
        lines.map(move |points| Contour {
            quantity,
            rpm,
            points,
        })
    });
    all.collect()
}

/// Lines at a level of values over a grid, as for [`contours`].
pub fn lines(
    rows: &[&[Option<f64>]],
    level: f64,
    point: impl Fn([f64; 2]) -> [f64; 2],
) -> Vec<Vec<[f64; 2]>> {
    let joined = joined(segments(rows, level)).into_iter();
    joined
        .map(|places| places.into_iter().map(&point).collect())
        .collect()
}

/// Round speeds strictly between the smallest and the largest value.
fn levels(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    let raw = (high - low) / LEVELS;
    if !raw.is_finite() || raw <= 1e-9 * high.abs() {
        return Vec::new();
    }
    let ten = 10f64.powf(raw.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .map(|digit| digit * ten)
        .into_iter()
        .find(|step| *step >= raw)
        .unwrap_or(10.0 * ten);
    let first = (low / step).floor() as i64 + 1;
    (first..)
        .map(|k| k as f64 * step)
        .take_while(|level| *level < high)
        .collect()
}

type Segment = [[f64; 2]; 2];

fn segments(rows: &[&[Option<f64>]], level: f64) -> Vec<Segment> {
    let mut segments = Vec::new();
    for (row, pair) in rows.windows(2).enumerate() {
        for column in 0..pair[0].len().saturating_sub(1) {
            let corners = [
                pair[0][column],
                pair[0][column + 1],
                pair[1][column + 1],
                pair[1][column],
            ];
            if let [Some(a), Some(b), Some(c), Some(d)] = corners {
                cell(
                    [a, b, c, d],
                    [column as f64, row as f64],
                    level,
                    &mut segments,
                );
            }
        }
    }
    // A level through a corner also gives segments of length zero, at which a line would end.
    segments.retain(|[a, b]| a != b);
    segments
}

/// The segments in a cell whose corners, in turn around it from its origin, have these values.
fn cell(corners: [f64; 4], [x, y]: [f64; 2], level: f64, segments: &mut Vec<Segment>) {
    const AROUND: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let above = corners.map(|value| value > level);
    let mut crossings = Vec::new();
    for k in 0..4 {
        let next = (k + 1) % 4;
        if above[k] != above[next] {
            // The two cells at an edge compute the crossing from the same corner, so that both obtain the
            // same bits.
            let (from, to) = if k < 2 { (k, next) } else { (next, k) };
            let share = (level - corners[from]) / (corners[to] - corners[from]);
            let at =
                |axis: usize| AROUND[from][axis] + share * (AROUND[to][axis] - AROUND[from][axis]);
            crossings.push([x + at(0), y + at(1)]);
        }
    }
    match crossings[..] {
        [a, b] => segments.push([a, b]),
        // At a saddle, the mean of the corner values decides which crossings are joined.
        [a, b, c, d] => {
            let mean = 0.25 * corners.iter().sum::<f64>();
            if (mean > level) == above[0] {
                segments.extend([[a, b], [c, d]])
            } else {
                segments.extend([[d, a], [b, c]])
            }
        }
        _ => {}
    }
}

/// Joins segments that share their ends to lines.
fn joined(mut segments: Vec<Segment>) -> Vec<Vec<[f64; 2]>> {
    let mut lines = Vec::new();
    while let Some([from, to]) = segments.pop() {
        let mut line = std::collections::VecDeque::from([from, to]);
        while let Some(end) = next(&mut segments, line[line.len() - 1]) {
            line.push_back(end);
        }
        while let Some(end) = next(&mut segments, line[0]) {
            line.push_front(end);
        }
        lines.push(line.into());
    }
    lines
}

/// Takes a segment that begins or ends at a point from the list; returns its other end.
fn next(segments: &mut Vec<Segment>, at: [f64; 2]) -> Option<[f64; 2]> {
    let near = |point: &[f64; 2]| (point[0] - at[0]).hypot(point[1] - at[1]) < 1e-9;
    let place = segments.iter().position(|pair| pair.iter().any(near))?;
    let [a, b] = segments.swap_remove(place);
    Some(if near(&a) { b } else { a })
}
