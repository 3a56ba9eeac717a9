//! Guide pads: the coupling of harmonics by a rectangle or an ellipse fixed in space.
//!
//! The integral over a pad of any size, clipped to the blade, is exact to rounding.

use std::f64::consts::PI;

use faer::Scale;

use crate::model::scene::{Blade, GuideFile, GuideShape};

use super::super::Plate;
use super::super::quadrature;
use super::patch::{Circle, coupling, sufficient_points};
use super::{Contact, ContactTerms};

/// The terms are the mean of φᵢφⱼ over the pad, times the stiffness of the pad in K_g and times its damping in C.
impl Contact for GuideFile {
    fn add_to(&self, plate: &Plate, terms: &mut ContactTerms) {
        let circles = circles(plate, self, sufficient_points(plate));
        let mut coupling = coupling(plate, self.angle_rad(), circles.into_iter());
        if self.damping_n_s_per_m > 0.0 {
            terms.add_damping(&(Scale(self.damping_n_s_per_m) * &coupling));
        }
        if self.stiffness_n_per_m > 0.0 {
            // The matrix is scaled in place, because a copy would take hundreds of megabytes for a large
            // basis.
            coupling *= Scale(self.stiffness_n_per_m);
            terms.add_symmetric_stiffness(coupling);
        }
    }
}

/// Circles of a radial quadrature rule with `points` points on each smooth interval, with the arcs of the pad.
pub(super) fn circles(plate: &Plate, pad: &GuideFile, points: usize) -> Vec<Circle> {
    if pad.is_point() {
        return vec![Circle {
            radius_m: pad.radius_m,
            weight: 1.0,
            arcs: None,
        }];
    }
    let mut circles = Vec::new();
    for [low, high] in smooth_radii(&plate.blade, pad) {
        let rule = quadrature::root_ended(low, high, points);
        circles.extend(rule.iter().map(|(r, w)| Circle {
            radius_m: r,
            weight: w * r / pad.area_m2(),
            arcs: Some(arcs(pad, r)),
        }));
    }
    circles
}

/// Intervals of r, clipped to the blade, in whose interior the arcs are smooth. An interval ends where a circle
/// touches a side of the pad or passes through a corner, and at the edges of the blade.
fn smooth_radii(blade: &Blade, pad: &GuideFile) -> Vec<[f64; 2]> {
    let (a, b) = (blade.inner_radius_m, blade.outer_radius_m);
    let mut cuts = pad.touching_radii_m();
    cuts.extend(blade.edges_m());
    cuts.retain(|r| (a..=b).contains(r));
    cuts.sort_by(f64::total_cmp);
    cuts.windows(2)
        .map(|pair| [pair[0], pair[1]])
        .filter(|[low, high]| high - low > 1e-12 * b)
        .filter(|[low, high]| !arcs(pad, 0.5 * (low + high)).is_empty())
        .collect()
}

/// Arcs with 0 ≤ ψ ≤ π of the circle of radius r inside the pad, see [`Circle`].
fn arcs(pad: &GuideFile, r: f64) -> Vec<[f64; 2]> {
    match pad.shape {
        GuideShape::Rectangle => arcs_in_rectangle(pad, r),
        GuideShape::Round => arcs_in_ellipse(pad, r),
    }
}

fn arcs_in_rectangle(pad: &GuideFile, r: f64) -> Vec<[f64; 2]> {
    let [along, half] = pad.half_lengths_m();
    let (near, far) = (pad.radius_m - along, pad.radius_m + along);
    if near >= r || far <= -r {
        return Vec::new();
    }
    let from = (far / r).min(1.0).acos();
    let to = (near / r).max(-1.0).acos();
    let rise = (half / r).min(1.0).asin();
    [[0.0, rise], [PI - rise, PI]]
        .into_iter()
        .map(|[low, high]| [low.max(from), high.min(to)])
        .filter(|[low, high]| high > low)
        .collect()
}

/// Arcs in the ellipse with half-axes a and b about the radius c: with u = cos ψ, the point at ψ is inside where
/// (r u − c)²/a² + r² (1 − u²)/b² ≤ 1, a quadratic inequality for u.
fn arcs_in_ellipse(pad: &GuideFile, r: f64) -> Vec<[f64; 2]> {
    let [a, b] = pad.half_lengths_m();
    let c = pad.radius_m;
    let square = (r / a).powi(2) - (r / b).powi(2);
    let linear = -2.0 * r * c / (a * a);
    let constant = (c / a).powi(2) + (r / b).powi(2) - 1.0;
    let value = |u: f64| (square * u + linear) * u + constant;
    // These expressions for the two roots avoid cancellation, because `linear` is negative. For a circle
    // `square` is zero and the first root is infinite.
    let large = -0.5 * (linear - (linear * linear - 4.0 * square * constant).max(0.0).sqrt());
    let mut ends = vec![-1.0, large / square, constant / large, 1.0];
    ends.retain(|u| (-1.0..=1.0).contains(u));
    ends.sort_by(f64::total_cmp);
    ends.windows(2)
        .filter(|pair| pair[1] > pair[0] && value(0.5 * (pair[0] + pair[1])) < 0.0)
        .map(|pair| [pair[1].acos(), pair[0].acos()])
        .collect()
}
