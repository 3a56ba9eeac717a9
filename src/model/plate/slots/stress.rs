//! Mean around of the stress of a slotted, rotating ring.
//!
//! Plane stress by biquadratic elements on half a pitch. Between two slots the radial displacement u is even and that along the
//! circle v is odd: v = 0 in the middle and, within the slot's end, on the line of the slot, whose faces are free. With means over
//! the angle, ε_θθ of the mean is (ū + v_face/θ_face)/r, since ∫ ∂v/∂θ dθ is the displacement of the face: the stress
//!
//! σ̂_rr = ū′ + ν(ū + v̄)/r, σ̂_θθ = (ū + v̄)/r + νū′, v̄ = v_face/θ_face,
//!
//! follows from two functions of the radius, quadratic on every element, with the displacements in units of ρΩ²(1 − ν²)/E.

use faer::Mat;

use super::super::quadrature::{Rule, smooth};
use super::chain::{Chain, Place};
use super::elements::{Around, InPlane, lagrange};
use super::mesh::Mesh;
use crate::model::scene::Blade;

/// Points of the rule on an element, for products of polynomials with this stress.
const POINTS: usize = 6;

/// Mean stress σ/ρΩ² of a slotted ring.
#[derive(Debug, Clone, PartialEq)]
pub struct MeanStress {
    /// Edges of the elements.
    radii_m: Vec<f64>,
    /// ū and v̄ at the edges and, between two of them, in the middle of each element.
    displacement_m3: Vec<[f64; 2]>,
    poisson_ratio: f64,
}

impl MeanStress {
    /// The stress of a ring whose inner edge is fixed in its plane or free; not a number if the numbers differ too much in size.
    pub fn new(blade: &Blade, mesh: &Mesh, is_fixed: bool) -> Self {
        let (radii, angles) = (&mesh.radii_m, &mesh.angles_rad);
        let around: Vec<Around<3>> = angles
            .windows(2)
            .map(|pair| Around::new(pair[1] - pair[0], lagrange))
            .collect();
        let last = 2 * around.len();
        let circles = 2 * radii.len() - 1;
        let unknowns = Unknowns::new(circles, last, 2 * mesh.end, is_fixed);
        let mut matrix = Chain::zeros(&unknowns.orders);
        let mut load = Mat::zeros(matrix.order(), 1);
        for (i, pair) in radii.windows(2).enumerate() {
            let element = InPlane::new(blade, [pair[0], pair[1]]);
            for (j, around) in around.iter().enumerate() {
                for one in functions() {
                    let Some(row) = unknowns.place(i, j, one) else {
                        continue;
                    };
                    let [p, q, own] = one;
                    if own == 0 {
                        load[(matrix.index(row), 0)] += element.load[p] * around.mean[q];
                    }
                    for other in functions() {
                        if let Some(column) = unknowns.place(i, j, other) {
                            matrix.add(row, column, element.stiffness(around, one, other));
                        }
                    }
                }
            }
        }
        let found = match matrix.factorized() {
            Some(factors) => factors.solved(&load),
            None => Mat::full(matrix.order(), 1, f64::NAN),
        };
        let at = |circle: usize, angle: usize, own: usize| {
            let place = unknowns.of_circle(circle, angle, own);
            place.map_or(0.0, |place| found[(matrix.index(place), 0)])
        };
        let half_pitch = angles[angles.len() - 1];
        let mean = |circle: usize| {
            let elements = around.iter().enumerate();
            let sum = elements.map(|(j, around)| {
                let own = (0..3).map(|q| around.mean[q] * at(circle, 2 * j + q, 0));
                own.sum::<f64>()
            });
            [sum.sum::<f64>(), at(circle, last, 1)].map(|x| x / half_pitch)
        };
        MeanStress {
            radii_m: radii.clone(),
            displacement_m3: (0..circles).map(mean).collect(),
            poisson_ratio: blade.material.poisson_ratio,
        }
    }

    /// Radial and hoop stress σ/ρΩ² at a radius, in m².
    pub fn at_m2(&self, radius_m: f64) -> [f64; 2] {
        let edges = &self.radii_m;
        let element = edges
            .partition_point(|edge| *edge <= radius_m)
            .clamp(1, edges.len() - 1)
            - 1;
        let (from, to) = (edges[element], edges[element + 1]);
        let [f, d, _] = lagrange(radius_m - from, to - from);
        let (mut slope, mut hoop) = (0.0, 0.0);
        for k in 0..3 {
            let [u, v] = self.displacement_m3[2 * element + k];
            slope += d[k] * u;
            hoop += f[k] * (u + v) / radius_m;
        }
        let nu = self.poisson_ratio;
        [slope + nu * hoop, hoop + nu * slope]
    }

    /// Rule over the radius for products with this stress, which is steep at the slot's end; the weights do not contain r.
    pub fn rule(&self) -> Rule {
        let mut whole = Rule::default();
        for pair in self.radii_m.windows(2) {
            let own = smooth(pair[0], pair[1], POINTS);
            whole.points.extend(own.points);
            whole.weights.extend(own.weights);
        }
        whole
    }
}

/// Functions of an element: over the radius, over the angle, and the displacement.
fn functions() -> impl Iterator<Item = [usize; 3]> {
    (0..18).map(|k| [k / 6, (k / 2) % 3, k % 2])
}

/// Numbers of the unknowns: a block has the circle in the middle of an element and that at its end.
struct Unknowns {
    /// Place of u and v by circle and angle.
    places: Vec<Vec<[Option<Place>; 2]>>,
    orders: Vec<usize>,
}

impl Unknowns {
    fn new(circles: usize, last: usize, end: usize, is_fixed: bool) -> Self {
        let mut orders = vec![0; circles / 2 + 1];
        let mut places = Vec::with_capacity(circles);
        for circle in 0..circles {
            let block = circle.div_ceil(2);
            let mut next = |is_free: bool| {
                is_free.then(|| {
                    orders[block] += 1;
                    (block, orders[block] - 1)
                })
            };
            let is_held = is_fixed && circle == 0;
            let is_joined = |angle: usize| angle == 0 || angle == last && circle <= end;
            let of_circle = (0..=last).map(|angle| {
                let radial = next(!is_held);
                [radial, next(!is_held && !is_joined(angle))]
            });
            places.push(of_circle.collect());
        }
        Unknowns { places, orders }
    }

    fn of_circle(&self, circle: usize, angle: usize, own: usize) -> Option<Place> {
        self.places[circle][angle][own]
    }

    fn place(&self, i: usize, j: usize, [p, q, own]: [usize; 3]) -> Option<Place> {
        self.of_circle(2 * i + p, 2 * j + q, own)
    }
}
