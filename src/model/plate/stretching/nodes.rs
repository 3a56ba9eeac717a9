//! The radii at which the strains of a deflection are evaluated.

use std::ops::Range;

use faer::Col;

use crate::model::plate::Plate;

use super::strain::{Slopes, Strain};

/// Chebyshev points of each interval between the knots of the thickness, as many as the degree of r² w′²
/// requires, and the radial functions there.
#[derive(Debug, Clone)]
pub struct Nodes {
    /// Number of nodes of an interval.
    count: usize,
    /// Ends of the intervals.
    edges_m: Vec<f64>,
    /// Radii of the nodes, interval by interval.
    radii_m: Vec<f64>,
    /// R′ and R/r of n ≠ 1 and of n = 1 at each node, one row of J values per node.
    functions: [Vec<[Vec<f64>; 2]>; 2],
    /// Norm √(ρh₀ π(1+δ_n0)) of each n.
    norms: Vec<f64>,
    /// Indices of the cosines and of the sines of each n.
    unknowns: Vec<[Range<usize>; 2]>,
    degrees_of_freedom: usize,
}

/// Share of the strain at a node in the strain at a point, where r² e is a polynomial.
pub struct NodeShare {
    pub node: usize,
    pub share: f64,
}

impl Nodes {
    /// The nodes of a plate.
    pub fn new(plate: &Plate) -> Self {
        let count = 2 * plate.basis.degree() + 1;
        let edges_m = plate.blade.edges_m();
        let radii_m: Vec<f64> = edges_m
            .windows(2)
            .flat_map(|ends| {
                let (middle, half) = (0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0]));
                chebyshev(count).map(move |x| middle + half * x)
            })
            .collect();
        let functions = [0, 1].map(|n| {
            let at = |r: &f64| {
                let f = plate.basis.evaluate(n, *r);
                [f.slope, f.value.iter().map(|value| value / r).collect()]
            };
            radii_m.iter().map(at).collect()
        });
        Nodes {
            count,
            edges_m,
            radii_m,
            functions,
            norms: (0..=plate.max_diameters())
                .map(|n| plate.angular_norm(n))
                .collect(),
            unknowns: (0..=plate.max_diameters())
                .map(|n| unknowns(plate, n))
                .collect(),
            degrees_of_freedom: plate.degrees_of_freedom(),
        }
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.radii_m.len()
    }

    /// Number of unknowns of the plate.
    pub fn degrees_of_freedom(&self) -> usize {
        self.degrees_of_freedom
    }

    /// Degree of the polynomial r² e through the strains at the nodes of an interval.
    pub fn degree(&self) -> usize {
        self.count - 1
    }

    /// Radii that divide each interval for elements of a degree: none if the degree is at least that of the
    /// strains; otherwise one part for every `half_waves` half-waves, narrower towards the ends, as
    /// half-waves of a polynomial are.
    pub fn divisions_m(&self, degree: usize, half_waves: usize) -> Vec<f64> {
        let parts = if self.degree() <= degree {
            1
        } else {
            self.degree().div_ceil(half_waves)
        };
        let within = self.edges_m.windows(2).flat_map(|ends| {
            let (middle, half) = (0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0]));
            let angle = std::f64::consts::PI / parts as f64;
            (1..parts).map(move |k| middle - half * (angle * k as f64).cos())
        });
        within.collect()
    }

    /// The nodes of the interval that contains a radius, for the strain there.
    pub fn interpolated(&self, radius_m: f64) -> Vec<NodeShare> {
        let next = self.edges_m.partition_point(|edge| *edge < radius_m);
        let interval = next.saturating_sub(1).min(self.edges_m.len() - 2);
        let (from, to) = (self.edges_m[interval], self.edges_m[interval + 1]);
        let x = (2.0 * radius_m - from - to) / (to - from);
        let first = interval * self.count;
        let values = lagrange(self.count, x);
        let nodes = values.into_iter().enumerate();
        nodes
            .map(|(k, value)| {
                let ratio = self.radii_m[first + k] / radius_m;
                NodeShare {
                    node: first + k,
                    share: value * ratio * ratio,
                }
            })
            .collect()
    }

    /// Slopes wₙ′ and i n wₙ/r of a deflection at the nodes.
    pub fn slopes(&self, deflection: &Col<f64>) -> Slopes {
        let mut slopes = Slopes::none(self.norms.len() - 1, self.len());
        for (n, norm) in self.norms.iter().enumerate() {
            let [cosines, sines] = &self.unknowns[n];
            let given = |index: usize| deflection[index] != 0.0;
            if !cosines.clone().chain(sines.clone()).any(given) {
                continue;
            }
            // The wave c cos nθ + s sin nθ is the sum of (c − is)/2 e^{inθ} and its complex conjugate.
            let half = if n == 0 { 1.0 / norm } else { 0.5 / norm };
            for (node, [slope, over_r]) in self.functions[usize::from(n == 1)].iter().enumerate() {
                let sum = |unknowns: &Range<usize>, values: &[f64]| {
                    let terms = unknowns.clone().zip(values);
                    half * terms.map(|(i, value)| deflection[i] * value).sum::<f64>()
                };
                let radial = [sum(cosines, slope), -sum(sines, slope)];
                // The derivative by θ multiplies (c − is) by i n, which gives n s + i n c.
                let n = n as f64;
                let hoop = [n * sum(sines, over_r), n * sum(cosines, over_r)];
                slopes.set(n as usize, node, radial, hoop);
            }
        }
        slopes
    }

    /// Work of forces on the slopes of every basis function, summed over the nodes: 2 Re(fᵣ* φ′ + f_θ* φ_θ/r)
    /// for n > 0, Re(fᵣ* φ′) for n = 0.
    pub fn work(&self, forces: &Slopes) -> Col<f64> {
        let mut work = Col::zeros(self.degrees_of_freedom());
        for (n, norm) in self.norms.iter().enumerate() {
            let [cosines, sines] = &self.unknowns[n];
            for (node, [slope, over_r]) in self.functions[usize::from(n == 1)].iter().enumerate() {
                let [radial, hoop] = forces
                    .at(n, node)
                    .map(|force| force.map(|part| part / norm));
                let n = n as f64;
                for (j, i) in cosines.clone().enumerate() {
                    work[i] += radial[0] * slope[j] + n * hoop[1] * over_r[j];
                }
                for (j, i) in sines.clone().enumerate() {
                    work[i] += n * hoop[0] * over_r[j] - radial[1] * slope[j];
                }
            }
        }
        work
    }

    /// Zero strains of all harmonics at the nodes.
    pub fn no_strain(&self) -> Strain {
        Strain::none(2 * (self.norms.len() - 1), self.len())
    }
}

/// Indices of the cosines and of the sines of n; n = 0 has no sines.
fn unknowns(plate: &Plate, n: usize) -> [Range<usize>; 2] {
    let (first, size) = (plate.offset(n), plate.radial_functions());
    let sines = if n == 0 { 0 } else { size };
    [first..first + size, first + size..first + size + sines]
}

/// Chebyshev points of [−1, 1], ascending.
fn chebyshev(count: usize) -> impl Iterator<Item = f64> {
    (0..count).map(move |k| -(std::f64::consts::PI * (k as f64 + 0.5) / count as f64).cos())
}

/// Values at x of the Lagrange functions of the Chebyshev points, by the barycentric formula.
fn lagrange(count: usize, x: f64) -> Vec<f64> {
    let share = |(k, node): (usize, f64)| {
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        let angle = std::f64::consts::PI * (k as f64 + 0.5) / count as f64;
        (sign * angle.sin(), x - node)
    };
    let shares: Vec<(f64, f64)> = chebyshev(count).enumerate().map(share).collect();
    if let Some(at) = shares.iter().position(|(_, distance)| *distance == 0.0) {
        return (0..count)
            .map(|k| if k == at { 1.0 } else { 0.0 })
            .collect();
    }
    let sum: f64 = shares
        .iter()
        .map(|(weight, distance)| weight / distance)
        .sum();
    shares
        .iter()
        .map(|(weight, distance)| weight / distance / sum)
        .collect()
}
