//! Plane stress of a blade whose thickness varies: finite elements over the radius, of high order.
//!
//! For the harmonic m the displacements are u_r = u(r) cos mθ and u_θ = v(r) sin mθ, with
//! ε_rr = u′, ε_θθ = (u + mv)/r, γ_rθ = v′ − (v + mu)/r. They minimise the energy of the blade
//! with the thickness h(r); each element is a polynomial of degree [`DEGREE`], and elements end
//! where the thickness or the load is not smooth, so that stresses are right to rounding, and jump
//! where those of the blade do.
//!
//! References: B. Szabó & I. Babuška, *Finite Element Analysis*, 1991, chapter 3, for elements of
//! high order; J.-P. Berrut & L. N. Trefethen, *Barycentric Lagrange interpolation*, SIAM Review 46
//! (2004), 501–517.

use crate::scene::Blade;

use super::quadrature;

/// Degree of the polynomials.
const DEGREE: usize = 14;
/// Largest ratio of the radii of an element: 1/r is then resolved to 1e-13.
const GROWTH: f64 = 1.6;
/// Largest logarithm by which the wave r^±m of harmonic m grows over an element.
const WAVE_GROWTH: f64 = 4.0;

/// What acts on the blade in its plane, with the harmonic's factor cos mθ (sin mθ along the rim).
pub struct InPlaneLoad<'a> {
    /// Force along the radius on a volume, in N/m³.
    pub body_n_per_m3: &'a dyn Fn(f64) -> f64,
    /// Eigenstrain of all directions of the plane.
    pub eigenstrain: &'a dyn Fn(f64) -> f64,
    /// Radii and forces of a circle, for each radian, outwards, in N.
    pub circle_n: &'a [(f64, f64)],
    /// σ_rr and σ_rθ at the rim.
    pub rim_pa: [f64; 2],
    /// σ_rr and σ_rθ at the bore.
    pub bore_pa: [f64; 2],
    /// Radii at which the load is not smooth.
    pub knots_m: &'a [f64],
    /// Whether the bore keeps its radius.
    pub bore_is_held: bool,
}

impl Default for InPlaneLoad<'_> {
    fn default() -> Self {
        InPlaneLoad {
            body_n_per_m3: &|_| 0.0,
            eigenstrain: &|_| 0.0,
            circle_n: &[],
            rim_pa: [0.0; 2],
            bore_pa: [0.0; 2],
            knots_m: &[],
            bore_is_held: false,
        }
    }
}

/// Displacements of one harmonic, and the strains and stresses that follow.
#[derive(Debug, Clone, PartialEq)]
pub struct InPlaneField {
    /// m.
    order: f64,
    /// Ends of the elements.
    edges_m: Vec<f64>,
    /// u, u′, v, v′ at the nodes of each element.
    nodes: Vec<[[f64; DEGREE + 1]; 4]>,
    reference: Reference,
    youngs_modulus_pa: f64,
    poisson_ratio: f64,
}

/// Factors of cos mθ, cos mθ and sin mθ.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct InPlaneStress {
    /// σ_rr.
    pub radial_pa: f64,
    /// σ_θθ.
    pub hoop_pa: f64,
    /// σ_rθ.
    pub shear_pa: f64,
}

impl InPlaneField {
    /// Solves harmonic m. Loads of m = 1 must balance; of m = 0 only the radial part is solved.
    pub fn new(blade: &Blade, order: usize, load: &InPlaneLoad<'_>) -> Self {
        let edges_m = element_edges(blade, order, load);
        let components = if order == 0 { 1 } else { 2 };
        let unknowns = components * (DEGREE * (edges_m.len() - 1) + 1);
        let mut field = InPlaneField {
            order: order as f64,
            edges_m,
            nodes: Vec::new(),
            reference: Reference::new(),
            youngs_modulus_pa: blade.material.youngs_modulus_pa,
            poisson_ratio: blade.material.poisson_ratio,
        };
        let mut system = Banded::new(unknowns, components * (DEGREE + 1));
        for element in 0..field.edges_m.len() - 1 {
            field.assemble(blade, load, element, &mut system);
        }
        let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
        let (at_bore, at_rim) = (blade.thickness_at_bore_m(), blade.thickness_at_m(b));
        for part in 0..components {
            system.right[part] -= a * at_bore * load.bore_pa[part];
            system.right[unknowns - components + part] += b * at_rim * load.rim_pa[part];
        }
        for &(radius, force) in load.circle_n {
            let node = field.edges_m.partition_point(|edge| *edge < radius);
            system.right[components * DEGREE * node] += force;
        }
        // A translation strains nothing: one node is held, without a force where loads balance.
        if order == 1 || load.bore_is_held {
            system.hold(0);
        }
        let solution = system.solved();
        field.nodes = field.of_elements(&solution, components);
        field
    }

    fn assemble(&self, blade: &Blade, load: &InPlaneLoad<'_>, element: usize, system: &mut Banded) {
        let (from, to) = (self.edges_m[element], self.edges_m[element + 1]);
        let half = 0.5 * (to - from);
        let components = if self.order == 0.0 { 1 } else { 2 };
        let first = components * DEGREE * element;
        let (e, nu) = (self.youngs_modulus_pa, self.poisson_ratio);
        for (r, w) in quadrature::graded(from, to, DEGREE + 4).iter() {
            let (value, slope) = self.reference.functions((r - from) / half - 1.0);
            let weight = w * r * blade.thickness_at_m(r);
            let free = (load.eigenstrain)(r);
            let body = (load.body_n_per_m3)(r);
            // Strains of unit displacements: [ε_rr, ε_θθ, γ_rθ].
            let strains: Vec<[f64; 3]> = (0..=DEGREE)
                .flat_map(|k| {
                    let (n, dn) = (value[k], slope[k] / half);
                    let radial = [dn, n / r, -self.order * n / r];
                    let along = [0.0, self.order * n / r, dn - n / r];
                    [radial, along].into_iter().take(components)
                })
                .collect();
            for (i, left) in strains.iter().enumerate() {
                let [rr, tt, rt] = self.stress_of(*left);
                let force = e / (1.0 - nu) * free * (left[0] + left[1]);
                let pushed = if i % components == 0 {
                    value[i / components]
                } else {
                    0.0
                };
                system.right[first + i] += weight * (force + body * pushed);
                for (k, right) in strains[..=i].iter().enumerate() {
                    let energy = rr * right[0] + tt * right[1] + rt * right[2];
                    system.add(first + i, first + k, weight * energy);
                }
            }
        }
    }

    /// Hooke's law of plane stress.
    fn stress_of(&self, [rr, tt, rt]: [f64; 3]) -> [f64; 3] {
        let (e, nu) = (self.youngs_modulus_pa, self.poisson_ratio);
        let plane = e / (1.0 - nu * nu);
        [
            plane * (rr + nu * tt),
            plane * (tt + nu * rr),
            0.5 * e / (1.0 + nu) * rt,
        ]
    }

    fn of_elements(&self, solution: &[f64], components: usize) -> Vec<[[f64; DEGREE + 1]; 4]> {
        (0..self.edges_m.len() - 1)
            .map(|element| {
                let half = 0.5 * (self.edges_m[element + 1] - self.edges_m[element]);
                let mut all = [[0.0; DEGREE + 1]; 4];
                for part in 0..components {
                    let value =
                        |node: usize| solution[components * (DEGREE * element + node) + part];
                    let values: [f64; DEGREE + 1] = std::array::from_fn(value);
                    let slope = |node: usize| {
                        let (_, slopes) = self.reference.at_node(node);
                        slopes.iter().zip(values).map(|(s, v)| s * v).sum::<f64>() / half
                    };
                    all[2 * part] = values;
                    all[2 * part + 1] = std::array::from_fn(slope);
                }
                all
            })
            .collect()
    }

    /// Stress at a radius, of which `eigenstrain` is not elastic; at a jump that of the inner side.
    pub fn at(&self, radius_m: f64, eigenstrain: f64) -> InPlaneStress {
        let last = self.nodes.len() - 1;
        let next = self.edges_m.partition_point(|edge| *edge < radius_m);
        let element = next.saturating_sub(1).min(last);
        let (from, to) = (self.edges_m[element], self.edges_m[element + 1]);
        let (values, _) = self
            .reference
            .functions(2.0 * (radius_m - from) / (to - from) - 1.0);
        let [u, du, v, dv] = self.nodes[element]
            .map(|nodes| nodes.iter().zip(&values).map(|(x, n)| x * n).sum::<f64>());
        let (m, r) = (self.order, radius_m);
        let [radial_pa, hoop_pa, shear_pa] = self.stress_of([
            du - eigenstrain,
            (u + m * v) / r - eigenstrain,
            dv - (v + m * u) / r,
        ]);
        InPlaneStress {
            radial_pa,
            hoop_pa,
            shear_pa,
        }
    }
}

/// Ends of the elements: edges and knots, and between them no more growth than allowed.
fn element_edges(blade: &Blade, order: usize, load: &InPlaneLoad<'_>) -> Vec<f64> {
    let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
    let mut knots = blade.edges_m();
    knots.extend(load.knots_m.iter().filter(|r| a < **r && **r < b));
    knots.sort_by(f64::total_cmp);
    knots.dedup_by(|next, kept| *next - *kept < MERGED * b);
    // The rim stays where it is.
    *knots.last_mut().expect("a ring has edges") = b;
    let growth = GROWTH.ln().min(WAVE_GROWTH / order.max(1) as f64);
    let mut edges = vec![a];
    for pair in knots.windows(2) {
        let count = ((pair[1] / pair[0]).ln() / growth).ceil().max(1.0) as usize;
        let ratio = (pair[1] / pair[0]).powf(1.0 / count as f64);
        edges.extend((1..count).map(|k| pair[0] * ratio.powi(k as i32)));
        edges.push(pair[1]);
    }
    edges
}

/// Share of the outer radius below which two knots are one.
const MERGED: f64 = 1e-12;

/// Lagrange functions on the Chebyshev points of [−1, 1].
#[derive(Debug, Clone, PartialEq)]
struct Reference {
    nodes: [f64; DEGREE + 1],
}

impl Reference {
    fn new() -> Self {
        let angle = |k: usize| std::f64::consts::PI * k as f64 / DEGREE as f64;
        Reference {
            nodes: std::array::from_fn(|k| -angle(k).cos()),
        }
    }

    /// Barycentric weight of a node, up to a factor that all have.
    fn weight(k: usize) -> f64 {
        let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        if k == 0 || k == DEGREE {
            0.5 * sign
        } else {
            sign
        }
    }

    /// Values and slopes of all functions at a point.
    fn functions(&self, x: f64) -> ([f64; DEGREE + 1], [f64; DEGREE + 1]) {
        if let Some(node) = self.nodes.iter().position(|own| *own == x) {
            return self.at_node(node);
        }
        let shares: [f64; DEGREE + 1] =
            std::array::from_fn(|k| Self::weight(k) / (x - self.nodes[k]));
        let sum: f64 = shares.iter().sum();
        let values = shares.map(|share| share / sum);
        // n_k = s_k/Σs, s_k′ = −s_k/(x − x_k).
        let falls: [f64; DEGREE + 1] = std::array::from_fn(|k| -1.0 / (x - self.nodes[k]));
        let mean: f64 = values.iter().zip(falls).map(|(n, fall)| n * fall).sum();
        let slopes = std::array::from_fn(|k| values[k] * (falls[k] - mean));
        (values, slopes)
    }

    fn at_node(&self, node: usize) -> ([f64; DEGREE + 1], [f64; DEGREE + 1]) {
        let mut values = [0.0; DEGREE + 1];
        values[node] = 1.0;
        let mut slopes: [f64; DEGREE + 1] = std::array::from_fn(|k| {
            if k == node {
                0.0
            } else {
                Self::weight(k) / Self::weight(node) / (self.nodes[node] - self.nodes[k])
            }
        });
        slopes[node] = -slopes.iter().sum::<f64>();
        (values, slopes)
    }
}

/// A symmetric positive definite band matrix and a right side. The libraries here have dense and
/// sparse factorizations: a harmonic of high order takes twenty elements, and the dense one a
/// hundred times the work.
struct Banded {
    /// Row i: columns i − width + 1 … i.
    rows: Vec<Vec<f64>>,
    right: Vec<f64>,
    width: usize,
}

impl Banded {
    fn new(order: usize, width: usize) -> Self {
        Banded {
            rows: vec![vec![0.0; width]; order],
            right: vec![0.0; order],
            width,
        }
    }

    /// Adds to an entry of the lower triangle.
    fn add(&mut self, row: usize, column: usize, value: f64) {
        self.rows[row][column + self.width - 1 - row] += value;
    }

    /// Makes an unknown zero.
    fn hold(&mut self, unknown: usize) {
        let end = self.rows.len().min(unknown + self.width);
        for row in unknown..end {
            self.rows[row][unknown + self.width - 1 - row] = 0.0;
        }
        self.rows[unknown].fill(0.0);
        self.rows[unknown][self.width - 1] = 1.0;
        self.right[unknown] = 0.0;
    }

    /// Cholesky's factorization within the band, and both substitutions.
    fn solved(mut self) -> Vec<f64> {
        let (order, width) = (self.rows.len(), self.width);
        let first = |row: usize| (row + 1).saturating_sub(width);
        for i in 0..order {
            for j in first(i)..=i {
                let start = first(i).max(first(j));
                let (low, high) = self.rows.split_at(i);
                let own = &high[0];
                let other = if j == i { own } else { &low[j] };
                let left = &own[start + width - 1 - i..j + width - 1 - i];
                let right = &other[start + width - 1 - j..width - 1];
                let sum: f64 = left.iter().zip(right).map(|(x, y)| x * y).sum();
                let rest = own[j + width - 1 - i] - sum;
                self.rows[i][j + width - 1 - i] = match i == j {
                    true => rest.sqrt(),
                    false => rest / other[width - 1],
                };
            }
        }
        let mut x = self.right;
        for i in 0..order {
            let known = (first(i)..i).map(|j| self.rows[i][j + width - 1 - i] * x[j]);
            x[i] = (x[i] - known.sum::<f64>()) / self.rows[i][width - 1];
        }
        for i in (0..order).rev() {
            x[i] /= self.rows[i][width - 1];
            for j in first(i)..i {
                x[j] -= self.rows[i][j + width - 1 - i] * x[i];
            }
        }
        x
    }
}

#[cfg(test)]
mod tests;
