//! Guide pads: the coupling of harmonics by a rectangle or an ellipse fixed in space.
//!
//! The integral over a pad of any size, clipped to the blade, is exact to rounding.

use std::f64::consts::PI;

use faer::{Col, Mat, Scale};

use crate::model::scene::{Blade, Guide, GuideFile, GuideShape, PadLaw};

use super::super::Plate;
use super::super::quadrature;
use super::patch::{Circle, coupling, means, sufficient_points};
use super::{Contact, ContactTerms};

/// The terms are the mean of φᵢφⱼ over the pad, times the stiffness of the pad in K_g and times its damping in C. A pad on an arm
/// without mass is in series with it, because the pad moves as a rigid body: K_g = k (mean φᵢφⱼ − k/(ak + k_a) mean φᵢ mean φⱼ) with
/// the share a of the pad on the blade. A contact adds no unknown: the mass of an arm, the lag of a film and a controller
/// are not contained.
impl Contact for GuideFile {
    fn add_to(&self, plate: &Plate, terms: &mut ContactTerms) {
        let mut coupling = coupling_over(plate, self);
        if let Some(arm) = self.arm {
            let Rigid { share, mean, .. } = Rigid::new(plate, self);
            let stiffness = self.stiffness_n_per_m * share;
            let share = self.stiffness_n_per_m / (stiffness + arm.stiffness_n_per_m);
            coupling -= Scale(share) * &mean * mean.transpose();
        }
        add_coupling(
            coupling,
            self.stiffness_n_per_m,
            self.damping_n_s_per_m,
            terms,
        );
    }
}

/// The terms of a pad on a head with mass m act on the difference of the deflection of the blade and that h of the head: for the
/// head's unknown √m h the function is −1/√m. A film acts on the heave and the two tilts that the deflection has over the pad, in place
/// of the damper, a controller on the heave.
impl Contact for Guide {
    fn add_to(&self, plate: &Plate, terms: &mut ContactTerms) {
        let pad = &self.typed;
        let head = plate.head_of(self.index).zip(pad.arm);
        if head.is_none() && self.laws().next().is_none() {
            return pad.add_to(plate, terms);
        }
        let mut coupling = coupling_over(plate, pad);
        let Rigid {
            share,
            mut mean,
            tilts: [along, across],
        } = Rigid::new(plate, pad);
        if let Some((head, arm)) = head {
            // A deflection of the head takes its part from each deflection of the pad, and from their mean.
            let of_head = -1.0 / arm.mass_kg.sqrt();
            for i in 0..mean.nrows() {
                coupling[(i, head)] += of_head * mean[i];
                coupling[(head, i)] += of_head * mean[i];
            }
            coupling[(head, head)] += of_head * of_head * share;
            mean[head] = of_head * share;
            let damping = arm.viscous_n_s_per_m();
            if damping > 0.0 {
                let order = plate.degrees_of_freedom();
                let mut of_arm = Mat::zeros(order, order);
                of_arm[(head, head)] = damping / arm.mass_kg;
                terms.add_damping(&of_arm);
            }
        }
        let motions = [Scale(share.sqrt().recip()) * mean, along, across];
        for (motion, law) in self.laws() {
            let both = &motions[motion] * motions[motion].transpose();
            if law.damping_n_s_per_m != 0.0 {
                terms.add_damping(&(Scale(law.damping_n_s_per_m) * &both));
            }
            let stiffness = law.stiffness_at_rest_n_per_m();
            if stiffness != 0.0 {
                terms.add_symmetric_stiffness(Scale(stiffness) * &both);
            }
            let beside = law.stiffness_n_per_m - stiffness;
            if beside != 0.0 {
                terms.add_nonconservative_stiffness(&(Scale(beside) * both));
            }
        }
        for (unknown, state) in plate.states_of(self.index) {
            state
                .oscillator
                .add_to(&motions[state.motion], unknown, terms);
        }
        let undelayed = if self.film.is_some() {
            0.0
        } else {
            pad.damping_n_s_per_m
        };
        add_coupling(coupling, pad.stiffness_n_per_m, undelayed, terms);
    }
}

/// The rigid motions that the deflection of a blade has over the part of a pad on it: with the product of a motion and itself the force
/// at each point is that of this motion.
struct Rigid {
    /// Share of the pad that is on the blade.
    share: f64,
    /// Means of φᵢ over the pad, in 1/√kg; the heave is their product with 1/√share.
    mean: Col<f64>,
    /// Tilts along the radius through the centre of the pad and across it, in 1/√kg; zero for a point.
    tilts: [Col<f64>; 2],
}

impl Rigid {
    fn new(plate: &Plate, pad: &GuideFile) -> Self {
        let circles = circles(plate, pad, sufficient_points(plate));
        let [mean, along, across] = means(plate, pad.angle_rad(), circles.iter());
        // The means of 1, x, x² and y² over the pad, zero beside the blade.
        let mut moments = [0.0; 4];
        for circle in &circles {
            let r = circle.radius_m;
            let [one, x, _] = circle.moments(0);
            let [_, along, across] = circle.moments(1);
            let own = [one, x, r * along, r * across];
            moments
                .iter_mut()
                .zip(own)
                .for_each(|(sum, own)| *sum += own);
        }
        let [share, x, along_squares, across_squares] = moments;
        let centre = x / share;
        let unit = |square: f64| {
            // A pad of which a line is on the blade does not tilt along it.
            let is_flat = square <= ROUNDING * along_squares;
            Scale(if is_flat { 0.0 } else { square.sqrt().recip() })
        };
        let tilts = [
            unit(along_squares - x * centre) * (along - Scale(centre) * &mean),
            unit(across_squares) * across,
        ];
        Rigid { share, mean, tilts }
    }
}

/// A square of an extent below this share of that of a distance from the axis is rounding.
const ROUNDING: f64 = 1e-10;

/// Adds the terms of a spring and a damper with this mean of φᵢφⱼ.
fn add_coupling(
    mut coupling: Mat<f64>,
    stiffness_n_per_m: f64,
    damping_n_s_per_m: f64,
    terms: &mut ContactTerms,
) {
    if damping_n_s_per_m > 0.0 {
        terms.add_damping(&(Scale(damping_n_s_per_m) * &coupling));
    }
    if stiffness_n_per_m > 0.0 {
        // The matrix is scaled in place, because a copy would take hundreds of megabytes for a large
        // basis.
        coupling *= Scale(stiffness_n_per_m);
        terms.add_symmetric_stiffness(coupling);
    }
}

/// Force of the blade on a linear pad at rest, in N/√kg: its product with the unknowns is the force.
pub(crate) fn pad_force(plate: &Plate, guide: &Guide) -> Col<f64> {
    let pad = &guide.typed;
    let of_law = guide
        .controller
        .as_ref()
        .map(PadLaw::stiffness_at_rest_n_per_m);
    let stiffness = pad.stiffness_n_per_m + of_law.unwrap_or(0.0);
    let Rigid { share, mean, .. } = Rigid::new(plate, pad);
    let mut force = Scale(stiffness) * mean;
    let Some(arm) = pad.arm else {
        return force;
    };
    let stiffness = stiffness * share;
    match plate.head_of(guide.index) {
        Some(head) => force[head] -= stiffness / arm.mass_kg.sqrt(),
        None => force *= Scale(arm.stiffness_n_per_m / (stiffness + arm.stiffness_n_per_m)),
    }
    force
}

fn coupling_over(plate: &Plate, pad: &GuideFile) -> Mat<f64> {
    let circles = circles(plate, pad, sufficient_points(plate));
    coupling(plate, pad.angle_rad(), circles.into_iter())
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
