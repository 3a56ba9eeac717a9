//! Stress in the plane of a slotted, rotating ring.
//!
//! Plane stress by biquadratic elements on half a pitch. Between two slots the radial displacement u is even and that along the
//! circle v is odd: v = 0 in the middle and, within the slot's end, on the line of the slot, whose faces are free. Displacements are in
//! units of ρΩ²(1 − ν²)/E, so that σ/ρΩ² has the modulus 1 − ν².

use faer::Mat;

use super::chain::{Chain, Place};
use super::elements::{Around, InPlane, lagrange};
use super::mesh::Mesh;
use crate::model::scene::{Blade, Bore, InPlane as Edge};

/// Displacements of a slotted, rotating ring on half a pitch.
pub struct PlaneStress<'a> {
    pub mesh: &'a Mesh,
    around: Vec<Around<3>>,
    /// u and v by circle, at the edges of the elements and between them, and by angle.
    displacement_m3: Vec<[f64; 2]>,
    pub poisson_ratio: f64,
}

impl<'a> PlaneStress<'a> {
    /// The stress of a ring; not a number if the numbers differ too much in size.
    pub fn new(blade: &Blade, mesh: &'a Mesh) -> Self {
        let is_fixed = blade.bore == Bore::Clamped(Edge::Fixed);
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
        let nodes = (0..circles).flat_map(|circle| (0..=last).map(move |angle| (circle, angle)));
        let displacement_m3 = nodes
            .map(|(circle, angle)| [0, 1].map(|own| at(circle, angle, own)))
            .collect();
        PlaneStress {
            mesh,
            around,
            displacement_m3,
            poisson_ratio: blade.material.poisson_ratio,
        }
    }

    fn node(&self, circle: usize, angle: usize) -> [f64; 2] {
        self.displacement_m3[circle * (2 * self.around.len() + 1) + angle]
    }

    /// ū and v̄ = v_face/θ_face by circle.
    pub fn means(&self) -> Vec<[f64; 2]> {
        let half_pitch = self.mesh.angles_rad[self.around.len()];
        let mean = |circle: usize| {
            let elements = self.around.iter().enumerate();
            let sum = elements.map(|(j, around)| {
                let own = (0..3).map(|q| around.mean[q] * self.node(circle, 2 * j + q)[0]);
                own.sum::<f64>()
            });
            [
                sum.sum::<f64>(),
                self.node(circle, 2 * self.around.len())[1],
            ]
            .map(|x| x / half_pitch)
        };
        (0..2 * self.mesh.radii_m.len() - 1).map(mean).collect()
    }

    /// σ_rr, σ_θθ and σ_rθ over ρΩ², in m², at a radius and an angle of element (i, j).
    pub fn at_m2(&self, [i, j]: [usize; 2], radius_m: f64, angle_rad: f64) -> [f64; 3] {
        let (radii, angles) = (&self.mesh.radii_m, &self.mesh.angles_rad);
        let [f, df, _] = lagrange(radius_m - radii[i], radii[i + 1] - radii[i]);
        let [g, dg, _] = lagrange(angle_rad - angles[j], angles[j + 1] - angles[j]);
        let (mut along, mut hoop, mut shear) = (0.0, 0.0, 0.0);
        for p in 0..3 {
            for q in 0..3 {
                let [u, v] = self.node(2 * i + p, 2 * j + q);
                along += df[p] * g[q] * u;
                hoop += f[p] * (g[q] * u + dg[q] * v) / radius_m;
                shear += f[p] * dg[q] * u / radius_m + (df[p] - f[p] / radius_m) * g[q] * v;
            }
        }
        let nu = self.poisson_ratio;
        [
            along + nu * hoop,
            hoop + nu * along,
            0.5 * (1.0 - nu) * shear,
        ]
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
