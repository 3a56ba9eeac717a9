//! Guide pads: the coupling of harmonics by a rectangle fixed in space.
//!
//! The integral over a pad of any size, clipped to the blade, is exact to rounding.

use faer::Scale;

use crate::scene::{Blade, Guide};

use super::super::Plate;
use super::super::quadrature;
use super::patch::{Circle, coupling, sufficient_points};
use super::{Contact, ContactTerms};

/// K_g is the mean of φᵢφⱼ over the pad times its stiffness, C the mean times its damping.
impl Contact for Guide {
    fn add_to(&self, plate: &Plate, terms: &mut ContactTerms) {
        let circles = circles(plate, self, sufficient_points(plate));
        let mut coupling = coupling(plate, self.angle_rad, circles.into_iter());
        if self.damping_n_s_per_m > 0.0 {
            terms.add_damping(&(Scale(self.damping_n_s_per_m) * &coupling));
        }
        if self.stiffness_n_per_m > 0.0 {
            // The matrix is scaled in place, because a copy has hundreds of megabytes for a large basis.
            coupling *= Scale(self.stiffness_n_per_m);
            terms.add_symmetric_stiffness(coupling);
        }
    }
}

/// The arcs of the pad on the circles of a radial quadrature rule, of so many points on each smooth interval.
pub(super) fn circles(plate: &Plate, pad: &Guide, points: usize) -> Vec<Circle> {
    if pad.is_point() {
        return vec![Circle {
            radius_m: pad.radius_m,
            weight: 1.0,
            arcs: None,
        }];
    }
    let area = pad.radial_length_m * pad.tangential_length_m;
    let mut circles = Vec::new();
    for (low, high) in smooth_radii(&plate.blade, pad) {
        let rule = quadrature::root_ended(low, high, points);
        circles.extend(rule.iter().map(|(r, w)| Circle {
            radius_m: r,
            weight: w * r / area,
            arcs: Some(arcs(pad, r)),
        }));
    }
    circles
}

/// Sides of the pad in its own frame: x from the axis along the radius of its
/// centre, y across; (x_near, x_far, y_half).
fn sides(pad: &Guide) -> (f64, f64, f64) {
    let half = 0.5 * pad.radial_length_m;
    (
        pad.radius_m - half,
        pad.radius_m + half,
        0.5 * pad.tangential_length_m,
    )
}

/// Intervals of r, clipped to the blade, on which the arcs are smooth inside:
/// they are cut where a circle touches a side or passes a corner.
fn smooth_radii(blade: &Blade, pad: &Guide) -> Vec<(f64, f64)> {
    let (near, far, half) = sides(pad);
    let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
    let mut cuts = vec![
        near.abs(),
        far.abs(),
        half,
        near.hypot(half),
        far.hypot(half),
    ];
    cuts.extend(blade.edges_m());
    cuts.retain(|r| (a..=b).contains(r));
    cuts.sort_by(f64::total_cmp);
    cuts.windows(2)
        .map(|pair| (pair[0], pair[1]))
        .filter(|(low, high)| high - low > 1e-12 * b)
        .filter(|(low, high)| !arcs(pad, 0.5 * (low + high)).is_empty())
        .collect()
}

/// Arcs 0 ≤ |ψ| ≤ π of the circle of radius r inside the pad, upper half only.
fn arcs(pad: &Guide, r: f64) -> Vec<(f64, f64)> {
    use std::f64::consts::PI;
    let (near, far, half) = sides(pad);
    if near >= r || far <= -r {
        return Vec::new();
    }
    let from = (far / r).min(1.0).acos();
    let to = (near / r).max(-1.0).acos();
    let rise = (half / r).min(1.0).asin();
    [(0.0, rise), (PI - rise, PI)]
        .into_iter()
        .map(|(low, high)| (low.max(from), high.min(to)))
        .filter(|(low, high)| high > low)
        .collect()
}
