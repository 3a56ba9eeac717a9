//! Elements over the radius for displacements u_r = u(r) cos mθ, u_θ = v(r) sin mθ.

use std::ops::Range;

use super::quadrature::panel_edges_m;
use crate::model::scene::Blade;

/// Degree of the shape functions.
pub const DEGREE: usize = 14;
/// Largest ratio of the radii of an element: 1/r is then resolved to 1e-13.
const GROWTH: f64 = 1.6;
/// Largest logarithm of the growth of r^±m, the wave of harmonic m, over an element.
const WAVE_GROWTH: f64 = 4.0;

/// The elements of one harmonic and their shape functions.
#[derive(Debug, Clone, PartialEq)]
pub struct Elements {
    /// Circumferential order m.
    order: f64,
    /// Radii at which elements begin or end, ascending.
    edges_m: Vec<f64>,
    reference: Reference,
}

/// Strains [ε_rr, ε_θθ, γ_rθ] for unit displacements u and v of each node of an element, and the shape
/// functions.
pub struct UnitStrains {
    /// Shape functions N_k(r).
    pub values: [f64; DEGREE + 1],
    /// Strains for a unit radial displacement u of each node.
    pub radial: [[f64; 3]; DEGREE + 1],
    /// Strains for a unit tangential displacement v of each node.
    pub along: [[f64; 3]; DEGREE + 1],
}

impl Elements {
    /// Elements of harmonic m, which end at `knots_m` and where the thickness is not smooth.
    pub fn new(blade: &Blade, order: usize, knots_m: &[f64]) -> Self {
        Elements {
            order: order as f64,
            edges_m: element_edges(blade, order, knots_m),
            reference: Reference::new(),
        }
    }

    /// Number of elements.
    pub fn count(&self) -> usize {
        self.edges_m.len() - 1
    }

    /// Number of nodes; neighbouring elements share one.
    pub fn nodes(&self) -> usize {
        DEGREE * self.count() + 1
    }

    /// Indices of the nodes of an element.
    pub fn nodes_of(&self, element: usize) -> Range<usize> {
        DEGREE * element..DEGREE * (element + 1) + 1
    }

    /// Number of displacement components: a field of order 0 is radial.
    pub fn components(&self) -> usize {
        if self.order == 0.0 { 1 } else { 2 }
    }

    /// Inner and outer radius of an element.
    pub fn ends_m(&self, element: usize) -> [f64; 2] {
        [self.edges_m[element], self.edges_m[element + 1]]
    }

    /// Index of the element that contains a radius; at an edge of two elements, that of the inner one.
    pub fn at(&self, radius_m: f64) -> usize {
        let next = self.edges_m.partition_point(|edge| *edge < radius_m);
        next.saturating_sub(1).min(self.count() - 1)
    }

    /// Index of the node at an edge of an element.
    pub fn node_at_edge(&self, radius_m: f64) -> usize {
        DEGREE * self.edges_m.partition_point(|edge| *edge < radius_m)
    }

    /// Circumferential order m.
    pub fn order(&self) -> f64 {
        self.order
    }

    /// Values of the shape functions of an element at a radius.
    pub fn values(&self, element: usize, radius_m: f64) -> [f64; DEGREE + 1] {
        self.reference.values(self.mapped(element, radius_m))
    }

    /// Coordinate x ∈ [−1, 1] of a radius in an element.
    fn mapped(&self, element: usize, radius_m: f64) -> f64 {
        let [from, to] = self.ends_m(element);
        2.0 * (radius_m - from) / (to - from) - 1.0
    }

    /// Slopes in 1/m at the nodes of an element of the polynomial with the given values there.
    pub fn slopes_at_nodes(&self, element: usize, values: [f64; DEGREE + 1]) -> [f64; DEGREE + 1] {
        let [from, to] = self.ends_m(element);
        std::array::from_fn(|node| {
            let slopes = self.reference.slopes[node].iter();
            slopes.zip(values).map(|(s, v)| s * v).sum::<f64>() / (0.5 * (to - from))
        })
    }

    /// Strains at a radius: ε_rr = u′, ε_θθ = (u + mv)/r, γ_rθ = v′ − (v + mu)/r.
    pub fn unit_strains(&self, element: usize, radius_m: f64) -> UnitStrains {
        let [from, to] = self.ends_m(element);
        let half = 0.5 * (to - from);
        let values = self.values(element, radius_m);
        let slopes = self.reference.slopes(&values);
        let (m, r) = (self.order, radius_m);
        UnitStrains {
            radial: std::array::from_fn(|k| [slopes[k] / half, values[k] / r, -m * values[k] / r]),
            along: std::array::from_fn(|k| {
                [0.0, m * values[k] / r, slopes[k] / half - values[k] / r]
            }),
            values,
        }
    }
}

/// Ends of the elements: edges, knots, and further radii that limit the growth over an element.
fn element_edges(blade: &Blade, order: usize, knots_m: &[f64]) -> Vec<f64> {
    let growth = GROWTH.ln().min(WAVE_GROWTH / order.max(1) as f64);
    let mut edges = vec![blade.inner_radius_m];
    for pair in panel_edges_m(blade, knots_m).windows(2) {
        let count = ((pair[1] / pair[0]).ln() / growth).ceil().max(1.0) as usize;
        let ratio = (pair[1] / pair[0]).powf(1.0 / count as f64);
        edges.extend((1..count).map(|k| pair[0] * ratio.powi(k as i32)));
        edges.push(pair[1]);
    }
    edges
}

/// Lagrange functions of the Chebyshev points on [−1, 1].
#[derive(Debug, Clone, PartialEq)]
struct Reference {
    nodes: Vec<f64>,
    /// Slopes of all functions at each node.
    slopes: Vec<[f64; DEGREE + 1]>,
}

impl Reference {
    fn new() -> Self {
        let angles = (0..=DEGREE).map(|k| std::f64::consts::PI * k as f64 / DEGREE as f64);
        let nodes: Vec<f64> = angles.map(|angle| -angle.cos()).collect();
        let of_node = |node: usize| {
            let mut slopes: [f64; DEGREE + 1] = std::array::from_fn(|k| {
                if k == node {
                    0.0
                } else {
                    Self::weight(k) / Self::weight(node) / (nodes[node] - nodes[k])
                }
            });
            slopes[node] = -slopes.iter().sum::<f64>();
            slopes
        };
        let slopes = (0..=DEGREE).map(of_node).collect();
        Reference { nodes, slopes }
    }

    /// Barycentric weight of a node, up to a common factor.
    fn weight(k: usize) -> f64 {
        let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        if k == 0 || k == DEGREE {
            0.5 * sign
        } else {
            sign
        }
    }

    /// Values of all functions at x, by the barycentric formula.
    fn values(&self, x: f64) -> [f64; DEGREE + 1] {
        if let Some(node) = self.nodes.iter().position(|own| *own == x) {
            return std::array::from_fn(|k| if k == node { 1.0 } else { 0.0 });
        }
        let shares: [f64; DEGREE + 1] =
            std::array::from_fn(|k| Self::weight(k) / (x - self.nodes[k]));
        let sum: f64 = shares.iter().sum();
        shares.map(|share| share / sum)
    }

    /// Slopes of all functions at the point where they have the given values, interpolated from their slopes at
    /// the nodes. The derivative of the barycentric formula would suffer from cancellation near a node.
    fn slopes(&self, values: &[f64; DEGREE + 1]) -> [f64; DEGREE + 1] {
        std::array::from_fn(|k| {
            (0..=DEGREE)
                .map(|node| values[node] * self.slopes[node][k])
                .sum()
        })
    }
}
