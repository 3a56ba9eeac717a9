//! Pads that lift off: they press on the blade beyond their gap and never pull.
//!
//! A pad of stiffness k, with a film of stiffness k_f within the gap g, is a linear pad of stiffness k_f with
//! the additional potential
//!
//! V = (k − k_f)/A ∫ Ψ(w − g) + Ψ(−w − g) dA, Ψ(x) = ½x² for x > 0 and 0 for x < 0,
//!
//! over its area A; a pad on one side has only one of the two terms. V is convex; ∂V/∂w rises from 0 to the
//! force of a spring. If the pad has an offset o, w − o replaces w, and the offset of the film adds the potential
//! −k_f/A ∫ o w dA. Within ±g/100 of the gap the second derivative of Ψ rises linearly, as Newton's method
//! requires. The integral is a sum over Gauss points of the pad, each of which is a point of contact.

use std::f64::consts::TAU;

use faer::{Col, Mat, MatRef, Scale};

use crate::model::scene::{Guide, GuideFile, GuideSide};

use super::super::{Plate, quadrature};
use super::guide::circles;
use super::{Contact, ContactTerms, LiftingPads};

impl LiftingPads {
    /// The pads among the guides that lift off; `None` if there are none.
    pub fn of(plate: &Plate, guides: &[Guide]) -> Option<Self> {
        let lifting = |guide: &Guide| Some((guide.typed.clone(), guide.lifting?));
        let pads: Vec<_> = guides.iter().filter_map(lifting).collect();
        if pads.is_empty() {
            return None;
        }
        let mut released = ContactTerms::default();
        for guide in guides {
            let film = guide.lifting.map(|lifting| lifting.film_stiffness_n_per_m);
            let typed = GuideFile {
                stiffness_n_per_m: film.unwrap_or(guide.typed.stiffness_n_per_m),
                ..guide.typed.clone()
            };
            Guide {
                typed,
                ..guide.clone()
            }
            .add_to(plate, &mut released);
        }
        Some(LiftingPads { pads, released })
    }
}

/// Potential V of the pads of a plate that lift off, for deflections on r shapes with coordinates p.
#[derive(Debug, Clone)]
pub struct GapPotential {
    points: Vec<Point>,
    /// The shapes at the points, r × P, in 1/√kg.
    shapes: Mat<f64>,
    /// Force of the films of pads with an offset on the flat blade, in N/√kg.
    film: Col<f64>,
    /// Number of pads.
    pads: usize,
}

/// A point of contact.
#[derive(Debug, Clone, Copy)]
struct Point {
    /// Index of the pad among the pads that lift off.
    pad: usize,
    radius_m: f64,
    /// Share of the point in k − k_f of its pad.
    stiffness_n_per_m: f64,
    /// Share of the point in k_f of its pad.
    film_n_per_m: f64,
    gap_m: f64,
    side: GuideSide,
    offset_m: f64,
}

/// Number of points of a pad over each smooth interval of the radius, and over the angle. Where a pad touches lightly, it touches with
/// an edge: with 8 points amplitudes of an oscillation are off by up to 6 %, with 16 by up to 1.6 %, with 24 by up to 0.7 %, and a
/// map takes a third longer with each step.
const POINTS: usize = 16;
/// Number of phases of an oscillation over which the potential is averaged.
const PHASES: usize = 16;
/// Share of the gap, on each side of its end, within which the second derivative of Ψ rises.
const ROUNDED: f64 = 0.01;

impl GapPotential {
    /// The potential on the shapes that are the columns of `basis`, N × r; `None` if no pad lifts off.
    pub fn new(plate: &Plate, basis: MatRef<'_, f64>) -> Option<Self> {
        Self::with_points(plate, basis, POINTS, POINTS)
    }

    fn with_points(
        plate: &Plate,
        basis: MatRef<'_, f64>,
        radial: usize,
        angular: usize,
    ) -> Option<Self> {
        let lifting = plate.lifting.as_ref()?;
        let mut points = Vec::new();
        let mut values = Vec::new();
        let mut film = Col::zeros(basis.ncols());
        for (pad, (guide, law)) in lifting.pads.iter().enumerate() {
            let stiffness = guide.stiffness_n_per_m - law.film_stiffness_n_per_m;
            for place in places(plate, guide, radial, angular) {
                let share = place.share;
                points.push(Point {
                    pad,
                    radius_m: place.radius_m,
                    stiffness_n_per_m: share * stiffness,
                    film_n_per_m: share * law.film_stiffness_n_per_m,
                    gap_m: law.gap_m,
                    side: law.side,
                    offset_m: law.offset_m,
                });
                let functions = plate.functions_at(place.radius_m, place.angle_rad);
                let shapes = basis.transpose() * Col::from_fn(functions.len(), |i| functions[i]);
                film += Scale(share * law.film_stiffness_n_per_m * law.offset_m) * &shapes;
                values.push(shapes);
            }
        }
        Some(GapPotential {
            shapes: Mat::from_fn(basis.ncols(), values.len(), |i, k| values[k][i]),
            pads: lifting.pads.len(),
            film,
            points,
        })
    }

    /// The potential of the same pads with their gaps multiplied by a factor.
    pub fn scaled(mut self, factor: f64) -> Self {
        for point in &mut self.points {
            point.gap_m *= factor;
        }
        self
    }

    /// The potential averaged over an oscillation about the deflections, with one amplitude at all points: each point is one with a share
    /// of the stiffness at each of several phases.
    pub fn over_oscillation(self, amplitude_m: f64) -> Self {
        let phases = || (0..PHASES).map(|k| TAU * (k as f64 + 0.5) / PHASES as f64);
        let share = 1.0 / PHASES as f64;
        let moved = |point: &Point| {
            let point = *point;
            phases().map(move |phase| Point {
                stiffness_n_per_m: share * point.stiffness_n_per_m,
                film_n_per_m: share * point.film_n_per_m,
                offset_m: point.offset_m - amplitude_m * phase.sin(),
                ..point
            })
        };
        let columns = self.shapes.ncols() * PHASES;
        GapPotential {
            points: self.points.iter().flat_map(moved).collect(),
            shapes: Mat::from_fn(self.shapes.nrows(), columns, |i, k| {
                self.shapes[(i, k / PHASES)]
            }),
            ..self
        }
    }

    /// Mean deflection of the blade over each pad that lifts off.
    pub fn mean_deflections_m(&self, coordinates: &Col<f64>) -> Vec<f64> {
        let w = self.shapes.transpose() * coordinates;
        let mut sums = vec![(0.0, 0.0); self.pads];
        for (k, point) in self.points.iter().enumerate() {
            let (sum, whole) = &mut sums[point.pad];
            // Contact and film together are as stiff as the pad at each point, also where the film alone is.
            let share = point.stiffness_n_per_m + point.film_n_per_m;
            *sum += share * w[k];
            *whole += share;
        }
        sums.into_iter().map(|(sum, whole)| sum / whole).collect()
    }

    /// Deflections at the points, in m, relative to the middle between the faces of the pad.
    fn deflections(&self, coordinates: &Col<f64>) -> Col<f64> {
        let w = self.shapes.transpose() * coordinates;
        Col::from_fn(w.nrows(), |k| w[k] - self.points[k].offset_m)
    }

    /// V, in J.
    pub fn energy_j(&self, coordinates: &Col<f64>) -> f64 {
        let w = self.deflections(coordinates);
        let points = self.points.iter().enumerate();
        let pressed: f64 = points.map(|(k, point)| point.energy_j(w[k])).sum();
        pressed - self.film.transpose() * coordinates
    }

    /// ∂V/∂p, in N/√kg.
    pub fn gradient(&self, coordinates: &Col<f64>) -> Col<f64> {
        let w = self.deflections(coordinates);
        &self.shapes * Col::from_fn(self.points.len(), |k| self.points[k].pressure_n(w[k]))
            - &self.film
    }

    /// ∂²V/∂p², in 1/s², symmetric.
    pub fn hessian(&self, coordinates: &Col<f64>) -> Mat<f64> {
        let w = self.deflections(coordinates);
        self.stiffness(|k| self.points[k].tangent_n_per_m(w[k]))
    }

    /// [`GapPotential::gradient`] at many coordinates, a column each.
    pub fn gradients(&self, coordinates: &Mat<f64>) -> Mat<f64> {
        let pressures = self.at_points(coordinates, Point::pressure_n);
        let mut gradients = &self.shapes * pressures;
        for mut column in gradients.col_iter_mut() {
            column -= &self.film;
        }
        gradients
    }

    /// Weighted sums of [`GapPotential::hessian`] over many coordinates: one for each column of `weights`, with the columns of the
    /// matrix below each other. The weights are summed at the points first, so that products of shapes are as few as the sums.
    pub fn hessian_sums(&self, coordinates: &Mat<f64>, weights: &Mat<f64>) -> Mat<f64> {
        let order = self.shapes.nrows();
        let sums = self.at_points(coordinates, Point::tangent_n_per_m) * weights;
        let mut found = Mat::zeros(order * order, weights.ncols());
        for (sum, mut column) in sums.col_iter().zip(found.col_iter_mut()) {
            let weighted = Mat::from_fn(order, sum.nrows(), |i, k| sum[k] * self.shapes[(i, k)]);
            let hessian = weighted * self.shapes.transpose();
            for j in 0..order {
                column
                    .as_mut()
                    .subrows_mut(j * order, order)
                    .copy_from(hessian.col(j));
            }
        }
        found
    }

    /// A quantity of each point, a row, at each of many coordinates, a column, from its deflection.
    fn at_points(&self, coordinates: &Mat<f64>, of: impl Fn(&Point, f64) -> f64) -> Mat<f64> {
        let mut w = self.shapes.transpose() * coordinates;
        for mut column in w.col_iter_mut() {
            for (k, point) in self.points.iter().enumerate() {
                column[k] = of(point, column[k] - point.offset_m);
            }
        }
        w
    }

    /// The mean of ∂V/∂p, in N/√kg, on the straight line from one deflection to another. The product of this mean
    /// and the change of p is exactly the change of V.
    pub fn mean_gradient(&self, from: &Col<f64>, change: &Col<f64>) -> Col<f64> {
        let (w, d) = (self.deflections(from), self.shapes.transpose() * change);
        let mean = |k: usize| {
            let point = self.points[k];
            point.mean(w[k], d[k], |_, at| point.pressure_n(at))
        };
        &self.shapes * Col::from_fn(self.points.len(), mean) - &self.film
    }

    /// The derivative of [`GapPotential::mean_gradient`] with respect to the change, in 1/s².
    pub fn mean_stiffness(&self, from: &Col<f64>, change: &Col<f64>) -> Mat<f64> {
        let (w, d) = (self.deflections(from), self.shapes.transpose() * change);
        self.stiffness(|k| {
            let point = self.points[k];
            point.mean(w[k], d[k], |share, at| share * point.tangent_n_per_m(at))
        })
    }

    /// Force that each pad that lifts off exerts on the blade by contact and film, in the order of the scene's guides.
    pub fn forces_n(&self, coordinates: &Col<f64>) -> Vec<f64> {
        let w = self.deflections(coordinates);
        let mut forces = vec![0.0; self.pads];
        for (k, point) in self.points.iter().enumerate() {
            forces[point.pad] -= point.pressure_n(w[k]) + point.film_n_per_m * w[k];
        }
        forces
    }

    /// Force of the blade on both faces of each pad that lifts off, on that at positive deflections and on the other. A tilted pad is
    /// pressed on both.
    pub fn face_forces_n(&self, coordinates: &Col<f64>) -> Vec<[f64; 2]> {
        let w = self.deflections(coordinates);
        let mut forces = vec![[0.0; 2]; self.pads];
        for (k, point) in self.points.iter().enumerate() {
            let pressure_n = point.pressure_n(w[k]);
            forces[point.pad][usize::from(pressure_n < 0.0)] += pressure_n.abs();
        }
        forces
    }

    /// Smallest distance between the blade and a face of each pad that lifts off; negative where a face is
    /// compressed.
    pub fn distances_left_m(&self, coordinates: &Col<f64>) -> Vec<f64> {
        let w = self.deflections(coordinates);
        let mut left = vec![f64::INFINITY; self.pads];
        for (k, point) in self.points.iter().enumerate() {
            for side in point.sides() {
                left[point.pad] = left[point.pad].min(point.gap_m - side * w[k]);
            }
        }
        left
    }

    /// Radius, in m, and magnitude of the force, in N, at each point in contact.
    pub fn contacts(&self, coordinates: &Col<f64>) -> Vec<(f64, f64)> {
        let w = self.deflections(coordinates);
        let points = self.points.iter().enumerate();
        points
            .map(|(k, point)| (point.radius_m, point.pressure_n(w[k]).abs()))
            .filter(|(_, force_n)| *force_n > 0.0)
            .collect()
    }

    /// Sum Σ sₖ φₖφₖᵀ over the points whose stiffness sₖ is positive.
    fn stiffness(&self, of: impl Fn(usize) -> f64) -> Mat<f64> {
        let order = self.shapes.nrows();
        let touching: Vec<(usize, f64)> = (0..self.points.len())
            .map(|k| (k, of(k)))
            .filter(|(_, stiffness)| *stiffness > 0.0)
            .collect();
        if touching.is_empty() {
            return Mat::zeros(order, order);
        }
        let scaled = Mat::from_fn(order, touching.len(), |i, j| {
            let (k, stiffness) = touching[j];
            stiffness.sqrt() * self.shapes[(i, k)]
        });
        &scaled * scaled.transpose()
    }
}

/// A Gauss point of a pad.
struct Place {
    radius_m: f64,
    angle_rad: f64,
    /// Share of the area of the whole pad.
    share: f64,
}

/// The Gauss points of a pad.
fn places(plate: &Plate, pad: &GuideFile, radial: usize, angular: usize) -> Vec<Place> {
    let mut places = Vec::new();
    for circle in circles(plate, pad, radial) {
        let mut push = |angle: f64, weight: f64| {
            places.push(Place {
                radius_m: circle.radius_m,
                angle_rad: pad.angle_rad() + angle,
                share: circle.weight * weight,
            });
        };
        let Some(arcs) = &circle.arcs else {
            push(0.0, 1.0);
            continue;
        };
        for &[low, high] in arcs {
            let whole = if low == 0.0 {
                vec![[-high, high]]
            } else {
                vec![[-high, -low], [low, high]]
            };
            for [from, to] in whole {
                for (angle, weight) in quadrature::smooth(from, to, angular).iter() {
                    push(angle, weight);
                }
            }
        }
    }
    places
}

impl Point {
    /// Sign of the deflection that closes the gap on each side that the pad has.
    fn sides(&self) -> impl Iterator<Item = f64> {
        let both = self.side == GuideSide::Both;
        let left = (both || self.side == GuideSide::Left).then_some(1.0);
        let right = (both || self.side == GuideSide::Right).then_some(-1.0);
        left.into_iter().chain(right)
    }

    /// Sum of a quantity over the sides that the pad has, from the sign of the deflection that closes the gap on a side.
    fn over_sides(&self, of: impl Fn(f64) -> f64) -> f64 {
        match self.side {
            GuideSide::Both => of(1.0) + of(-1.0),
            GuideSide::Left => of(1.0),
            GuideSide::Right => of(-1.0),
        }
    }

    /// Energy kΨ, summed over the sides of the pad.
    fn energy_j(&self, w: f64) -> f64 {
        let width = ROUNDED * self.gap_m;
        let of = |side: f64| match side * w - self.gap_m {
            x if x <= -width => 0.0,
            x if x < width => (x + width).powi(3) / (12.0 * width),
            x => 0.5 * x * x + width * width / 6.0,
        };
        self.stiffness_n_per_m * self.over_sides(of)
    }

    /// Derivative of the energy, kΨ′, which has the sign of w.
    fn pressure_n(&self, w: f64) -> f64 {
        let width = ROUNDED * self.gap_m;
        let of = |side: f64| match side * w - self.gap_m {
            x if x <= -width => 0.0,
            x if x < width => side * (x + width).powi(2) / (4.0 * width),
            x => side * x,
        };
        self.stiffness_n_per_m * self.over_sides(of)
    }

    /// Second derivative of the energy, kΨ″.
    fn tangent_n_per_m(&self, w: f64) -> f64 {
        let width = ROUNDED * self.gap_m;
        let of = |side: f64| match side * w - self.gap_m {
            x if x <= -width => 0.0,
            x if x < width => (x + width) / (2.0 * width),
            _ => 1.0,
        };
        self.stiffness_n_per_m * self.over_sides(of)
    }

    /// Integral ∫₀¹ f(s, w + s d) ds of a function that is zero within the gap and a polynomial of degree at most
    /// three between the kinks of Ψ″.
    fn mean(&self, w: f64, d: f64, of: impl Fn(f64, f64) -> f64) -> f64 {
        let width = ROUNDED * self.gap_m;
        if w.abs().max((w + d).abs()) <= self.gap_m - width {
            return 0.0;
        }
        let mut cuts = vec![0.0, 1.0];
        for side in self.sides() {
            let bends = [self.gap_m - width, self.gap_m + width];
            cuts.extend(bends.map(|bend| (side * bend - w) / d));
        }
        cuts.retain(|share| (0.0..=1.0).contains(share));
        cuts.sort_by(f64::total_cmp);
        let on = |pair: &[f64]| {
            let length = pair[1] - pair[0];
            let at = GAUSS.map(|x| pair[0] + x * length);
            0.5 * length * at.map(|share| of(share, w + share * d)).iter().sum::<f64>()
        };
        cuts.windows(2).map(on).sum()
    }
}

/// Points of the Gauss rule on [0, 1] that is exact for polynomials of degree three; each has the weight ½.
const GAUSS: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

#[cfg(test)]
#[path = "gap_tests.rs"]
mod tests;
