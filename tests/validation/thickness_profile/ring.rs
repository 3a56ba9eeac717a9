//! A ring of varying thickness by finite elements over the radius.

use nalgebra::{DMatrix, DVector, SMatrix, SVector};

/// Gauss points and weights on [−1, 1], four of them.
const GAUSS: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
    (-0.339_981_043_584_856_26, 0.652_145_154_862_546_2),
    (0.339_981_043_584_856_26, 0.652_145_154_862_546_2),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
];

/// A ring for the finite elements.
pub struct Ring {
    /// Nodes, including every radius where the thickness is not smooth.
    pub nodes: Vec<f64>,
    pub thickness: fn(f64) -> f64,
    /// Mass on a circle, all around, at the rim.
    pub rim_kg: f64,
    pub clamped: bool,
    pub held: bool,
    pub e: f64,
    pub nu: f64,
    pub rho: f64,
    /// Eigenstrain over the radius.
    pub free_strain: fn(f64) -> f64,
}

/// Integration points of an element: radius, weight and the place in the element.
fn points(from: f64, to: f64) -> impl Iterator<Item = (f64, f64, f64)> {
    let half = 0.5 * (to - from);
    GAUSS
        .into_iter()
        .map(move |(x, w)| (from + half * (1.0 + x), half * w, x))
}

impl Ring {
    /// Radial displacement at the ends and the middle of every element, by rotation at one rad/s or by the eigenstrain.
    fn displacement(&self, of_rotation: bool) -> DVector<f64> {
        let count = 2 * (self.nodes.len() - 1) + 1;
        let plane = self.e / (1.0 - self.nu * self.nu);
        let mut stiffness = DMatrix::zeros(count, count);
        let mut load = DVector::zeros(count);
        for (k, pair) in self.nodes.windows(2).enumerate() {
            for (r, w, x) in points(pair[0], pair[1]) {
                let (n, dn) = quadratic(x);
                let half = 0.5 * (pair[1] - pair[0]);
                let h = (self.thickness)(r);
                for i in 0..3 {
                    let (ri, ti) = (dn[i] / half, n[i] / r);
                    load[2 * k + i] += if of_rotation {
                        w * r * h * self.rho * r * n[i]
                    } else {
                        let free = (self.free_strain)(r) * self.e / (1.0 - self.nu);
                        w * r * h * free * (ri + ti)
                    };
                    for j in 0..3 {
                        let (rj, tj) = (dn[j] / half, n[j] / r);
                        let energy = ri * rj + ti * tj + self.nu * (ri * tj + ti * rj);
                        stiffness[(2 * k + i, 2 * k + j)] += w * r * h * plane * energy;
                    }
                }
            }
        }
        if of_rotation {
            let rim = self.nodes.last().expect("a ring");
            load[count - 1] += self.rim_kg * rim / std::f64::consts::TAU;
        }
        if self.held {
            stiffness.row_mut(0).fill(0.0);
            stiffness.column_mut(0).fill(0.0);
            stiffness[(0, 0)] = 1.0;
            load[0] = 0.0;
        }
        stiffness.cholesky().expect("definite").solve(&load)
    }

    /// σ_rr and σ_θθ at the points of every element, by rotation or by the eigenstrain.
    fn stress(&self, of_rotation: bool) -> Vec<[[f64; 2]; 4]> {
        let plane = self.e / (1.0 - self.nu * self.nu);
        let u = self.displacement(of_rotation);
        let of_element = |(k, pair): (usize, &[f64])| {
            let half = 0.5 * (pair[1] - pair[0]);
            let mut found = [[0.0; 2]; 4];
            for (place, (r, _, x)) in points(pair[0], pair[1]).enumerate() {
                let (n, dn) = quadratic(x);
                let free = if of_rotation {
                    0.0
                } else {
                    (self.free_strain)(r)
                };
                let sum = |f: [f64; 3]| (0..3).map(|i| f[i] * u[2 * k + i]).sum::<f64>();
                let (rr, tt) = (sum(dn) / half - free, sum(n) / r - free);
                found[place] = [plane * (rr + self.nu * tt), plane * (tt + self.nu * rr)];
            }
            found
        };
        self.nodes.windows(2).enumerate().map(of_element).collect()
    }

    /// Frequencies in the turning frame, in rad/s, ascending.
    pub fn frequencies(&self, n: usize, speed: f64, heated: bool) -> Vec<f64> {
        let size = 2 * self.nodes.len();
        let zero = || DMatrix::<f64>::zeros(size, size);
        let (mut k, mut m) = (zero(), zero());
        let rotation = self.stress(true);
        let heat = self.stress(false);
        let n2 = (n * n) as f64;
        for (index, pair) in self.nodes.windows(2).enumerate() {
            let l = pair[1] - pair[0];
            for (place, (r, w, x)) in points(pair[0], pair[1]).enumerate() {
                let (value, slope, curvature) = hermite(0.5 * (1.0 + x), l);
                let h = (self.thickness)(r);
                let d = self.e * h.powi(3) / (12.0 * (1.0 - self.nu * self.nu));
                let hoop = slope / r - value * (n2 / (r * r));
                let twist = (slope / r - value / (r * r)) * n as f64;
                let bending = curvature * curvature.transpose()
                    + hoop * hoop.transpose()
                    + (curvature * hoop.transpose() + hoop * curvature.transpose()) * self.nu
                    + twist * twist.transpose() * (2.0 * (1.0 - self.nu));
                let [mut rr, mut tt] = rotation[index][place].map(|s| s * speed * speed);
                if heated {
                    rr += heat[index][place][0];
                    tt += heat[index][place][1];
                }
                let tension = slope * slope.transpose() * rr
                    + value * value.transpose() * (tt * n2 / (r * r));
                let stiffness = bending * (w * r * d) + tension * (w * r * h);
                let mass = value * value.transpose() * (w * r * self.rho * h);
                for i in 0..4 {
                    for j in 0..4 {
                        k[(2 * index + i, 2 * index + j)] += stiffness[(i, j)];
                        m[(2 * index + i, 2 * index + j)] += mass[(i, j)];
                    }
                }
            }
        }
        m[(size - 2, size - 2)] += self.rim_kg / std::f64::consts::TAU;
        let first = if self.clamped { 2 } else { 0 };
        let keep = size - first;
        let (k, m) = (
            k.view((first, first), (keep, keep)).into_owned(),
            m.view((first, first), (keep, keep)).into_owned(),
        );
        let inverse: DMatrix<f64> = m
            .cholesky()
            .expect("definite")
            .l()
            .try_inverse()
            .expect("a triangle");
        let mut squares: Vec<f64> = (&inverse * k * inverse.transpose())
            .symmetric_eigenvalues()
            .iter()
            .copied()
            .collect();
        squares.sort_by(f64::total_cmp);
        squares.into_iter().map(|s| s.max(0.0).sqrt()).collect()
    }
}

/// The quadratics of an element at x in [−1, 1], and their slopes there.
fn quadratic(x: f64) -> ([f64; 3], [f64; 3]) {
    let n = [0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)];
    (n, [x - 0.5, -2.0 * x, x + 0.5])
}

/// Hermite's cubics on an element of length l at a share t of it: values, slopes, curvatures.
fn hermite(t: f64, l: f64) -> (SVector<f64, 4>, SVector<f64, 4>, SVector<f64, 4>) {
    let value = [
        1.0 - 3.0 * t * t + 2.0 * t.powi(3),
        l * (t - 2.0 * t * t + t.powi(3)),
        3.0 * t * t - 2.0 * t.powi(3),
        l * (t.powi(3) - t * t),
    ];
    let slope = [
        (6.0 * t * t - 6.0 * t) / l,
        1.0 - 4.0 * t + 3.0 * t * t,
        (6.0 * t - 6.0 * t * t) / l,
        3.0 * t * t - 2.0 * t,
    ];
    let curvature = [
        (12.0 * t - 6.0) / (l * l),
        (6.0 * t - 4.0) / l,
        (6.0 - 12.0 * t) / (l * l),
        (6.0 * t - 2.0) / l,
    ];
    let column = SMatrix::<f64, 4, 1>::from_column_slice;
    (column(&value), column(&slope), column(&curvature))
}
