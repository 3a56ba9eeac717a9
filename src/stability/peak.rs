//! The largest value of a smooth function of the speed: the fastest growth of a band.

use crate::spectrum::SpectrumError;

/// Speed and value of the largest f on [from, to], by a coarse look and then
/// successive parabolas: squared growth is nearly a parabola across a band. At an end where
/// f is known to be zero it is not looked at: there the modes cannot be told apart.
pub fn maximise(
    (from, to): (f64, f64),
    zero_at_ends: [bool; 2],
    mut f: impl FnMut(f64) -> Result<f64, SpectrumError>,
) -> Result<(f64, f64), SpectrumError> {
    const LOOKS: usize = 4;
    let mut points = Vec::new();
    for k in 0..=LOOKS {
        let speed = from + (to - from) * k as f64 / LOOKS as f64;
        let zero = (k == 0 && zero_at_ends[0]) || (k == LOOKS && zero_at_ends[1]);
        points.push((speed, if zero { 0.0 } else { f(speed)? }));
    }
    for _ in 0..12 {
        points.sort_by(|x, y| x.0.total_cmp(&y.0));
        let best = (0..points.len())
            .max_by(|&i, &k| points[i].1.total_cmp(&points[k].1))
            .unwrap_or(0);
        if best == 0 || best + 1 == points.len() {
            break;
        }
        let [left, middle, right] = [points[best - 1], points[best], points[best + 1]];
        let vertex = parabola_vertex(left, middle, right);
        let resolution = 1e-4 * (to - from);
        if !((left.0 + resolution)..(right.0 - resolution)).contains(&vertex)
            || (vertex - middle.0).abs() < resolution
        {
            break;
        }
        points.push((vertex, f(vertex)?));
    }
    Ok(points
        .into_iter()
        .fold((from, 0.0), |best, p| if p.1 > best.1 { p } else { best }))
}

fn parabola_vertex(left: (f64, f64), middle: (f64, f64), right: (f64, f64)) -> f64 {
    let (a, b) = (middle.0 - left.0, middle.0 - right.0);
    let (fa, fb) = (middle.1 - left.1, middle.1 - right.1);
    let denominator = a * fb - b * fa;
    if denominator == 0.0 {
        return middle.0;
    }
    middle.0 - 0.5 * (a * a * fb - b * b * fa) / denominator
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_vertex_of_a_parabola_is_exact() {
        let f = |x: f64| 3.0 - 2.0 * (x - 0.7).powi(2);
        let vertex = parabola_vertex((0.0, f(0.0)), (0.5, f(0.5)), (2.0, f(2.0)));
        assert!((vertex - 0.7).abs() < 1e-12);
    }

    #[test]
    fn the_maximum_of_a_skew_hump_is_found() {
        let (speed, value) = maximise((0.0, 2.0), [false; 2], |x| Ok(x * (-x * x).exp())).unwrap();
        assert!((speed - 0.5_f64.sqrt()).abs() < 1e-4, "{speed}");
        assert!(value > 0.42888);
    }

    /// Divergence that ends where two real λ meet is fastest there, not zero.
    #[test]
    fn the_maximum_may_be_at_an_end_that_is_not_zero() {
        let (speed, value) = maximise((1.0, 2.0), [true, false], |x| Ok(x - 1.0)).unwrap();
        assert_eq!((speed, value), (2.0, 1.0));
    }
}
