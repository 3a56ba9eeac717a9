//! Gauss–Legendre rules on panels fitted to the integrand.

use std::num::NonZeroUsize;

use crate::model::scene::Blade;

/// Radii closer than this share of the outer radius are merged, because a panel between two radii that differ by
/// rounding would be empty.
const MERGED: f64 = 1e-12;

/// The edges of the blade and the radii between them at which the thickness or the load, with the given knots,
/// is not smooth, ascending.
pub fn panel_edges_m(blade: &Blade, knots_m: &[f64]) -> Vec<f64> {
    let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
    let mut edges = blade.edges_m();
    edges.extend(knots_m.iter().filter(|r| a < **r && **r < b));
    edges.sort_by(f64::total_cmp);
    edges.dedup_by(|next, kept| *next - *kept < MERGED * b);
    // If a knot just inside the rim is merged with the rim, the list contains the knot, which the rim
    // replaces.
    *edges.last_mut().expect("a ring has edges") = b;
    edges
}

/// Points and weights of a one-dimensional rule.
#[derive(Debug, Clone, Default)]
pub struct Rule {
    /// Abscissae of the rule.
    pub points: Vec<f64>,
    /// Weights of the rule.
    pub weights: Vec<f64>,
}

impl Rule {
    fn push(&mut self, point: f64, weight: f64) {
        self.points.push(point);
        self.weights.push(weight);
    }

    /// Iterates over the pairs (point, weight).
    pub fn iter(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.points
            .iter()
            .copied()
            .zip(self.weights.iter().copied())
    }
}

/// Points, ascending, and weights of the Gauss–Legendre rule on [−1, 1].
fn gauss(points: usize) -> Rule {
    let degree = NonZeroUsize::new(points).unwrap_or(NonZeroUsize::MIN);
    let mut pairs = gauss_quad::GaussLegendre::new(degree)
        .into_node_weight_pairs()
        .into_vec();
    pairs.sort_by(|x, y| x.0.total_cmp(&y.0));
    let (points, weights) = pairs.into_iter().unzip();
    Rule { points, weights }
}

/// Gauss–Legendre rule on [from, to], for a smooth integrand.
pub fn smooth(from: f64, to: f64, points: usize) -> Rule {
    let half = 0.5 * (to - from);
    let mut rule = Rule::default();
    for (x, w) in gauss(points).iter() {
        rule.push(from + half * (1.0 + x), half * w);
    }
    rule
}

/// Rule on [from, to], 0 < from, for a polynomial times r⁻³ … r⁻¹: each panel ends at twice its first radius
/// or before, so that the negative powers converge as 5.8⁻²ⁿ for every bore.
pub fn graded(from: f64, to: f64, points: usize) -> Rule {
    let panels = (to / from).log2().ceil().max(1.0) as usize;
    let growth = (to / from).powf(1.0 / panels as f64);
    let unit = gauss(points);
    let mut rule = Rule::default();
    for panel in 0..panels {
        let low = from * growth.powi(panel as i32);
        let half = 0.5 * (low * growth - low);
        for (x, w) in unit.iter() {
            rule.push(low + half * (1.0 + x), half * w);
        }
    }
    rule
}

/// Applies [`graded`] to each of the intervals between ascending edges.
pub fn piecewise(edges: &[f64], points: usize) -> Rule {
    let mut whole = Rule::default();
    for pair in edges.windows(2) {
        for (r, w) in graded(pair[0], pair[1], points).iter() {
            whole.push(r, w);
        }
    }
    whole
}

/// Rule on [from, to] for an integrand with square-root ends, such as the angle of the arc of a circle inside
/// a rectangle: x = sin(πt/2) makes it smooth.
pub fn root_ended(from: f64, to: f64, points: usize) -> Rule {
    let half = 0.5 * (to - from);
    let mut rule = Rule::default();
    for (t, w) in gauss(points).iter() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let (sin, cos) = (quarter * t).sin_cos();
        rule.push(from + half * (1.0 + sin), half * quarter * cos * w);
    }
    rule
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn negative_powers_are_exact_on_a_tiny_bore() {
        let rule = graded(1e-3, 1.0, 20);
        let sum: f64 = rule.iter().map(|(r, w)| w / r.powi(3)).sum();
        let exact = 0.5 * (1e6 - 1.0);
        assert!((sum / exact - 1.0).abs() < 1e-13, "{sum} against {exact}");
    }

    #[test]
    fn the_half_disk_has_area_half_pi() {
        let rule = root_ended(-1.0, 1.0, 20);
        let area: f64 = rule.iter().map(|(x, w)| w * (1.0 - x * x).sqrt()).sum();
        assert!((area / std::f64::consts::FRAC_PI_2 - 1.0).abs() < 1e-13);
    }
}
