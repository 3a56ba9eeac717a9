//! Edges of elements on half a pitch of the slots, finest at the slot's end.

use std::f64::consts::PI;

use crate::model::scene::{Blade, Slots};

/// Size of the elements at the slot's end, relative to the smallest of depth, bridge to the bore and half a pitch. The moments there
/// grow as the inverse root of the distance, so that the error of frequencies is of first order in this size.
const AT_END: f64 = 2e-3;
/// Least size, relative to the width of the ring: the stiffness of an element is inverse to the third power of its size, and rounding of
/// the smallest ones changes frequencies by 1e-5.
const LEAST: f64 = 4e-4;
/// Growth of the size with the distance from the slot's end.
const GROWTH: f64 = 0.9;
/// Number of elements in the wave length on the rim of the most nodal diameters.
const IN_WAVE: f64 = 8.0;
/// Least number of elements over the width of the ring, whose mean stress is steep at the bore, and along half a pitch.
const OVER_RING: f64 = 16.0;
const ALONG_PITCH: f64 = 8.0;

/// Least number of nodal diameters up to which c_n is computed, and the largest one: up to the number of slots between them.
const DIAMETERS: (usize, usize) = (12, 24);
/// Half a pitch of a slotted ring: the angle runs from the middle between two slots to a slot.
pub struct Mesh {
    /// Edges of the elements over the radius, in m.
    pub radii_m: Vec<f64>,
    /// Edges over the angle, in rad, from 0 to half a pitch.
    pub angles_rad: Vec<f64>,
    /// Index of the radius of the slot's end.
    pub end: usize,
}

impl Mesh {
    /// The mesh of a blade with slots, and the number of nodal diameters for which it is fine enough.
    pub fn of(blade: &Blade, slots: &Slots) -> (Self, usize) {
        let (least, most) = DIAMETERS;
        let most = (slots.count as usize).clamp(least, most);
        let end_radius_m = blade.outer_radius_m - slots.depth_m;
        let mesh = Mesh::new(&blade.edges_m(), end_radius_m, slots.count, most);
        (mesh, most)
    }

    /// The mesh of a ring with `count` slots that end at a radius, for waves of up to `most` nodal diameters. The radii of `knots_m`,
    /// which begin with the inner edge and end with the rim, become edges of elements.
    fn new(knots_m: &[f64], end_radius_m: f64, count: u32, most: usize) -> Self {
        let (inner, outer) = (knots_m[0], knots_m[knots_m.len() - 1]);
        let half_pitch = PI / f64::from(count);
        let arc = half_pitch * end_radius_m;
        let smallest = (outer - end_radius_m).min(end_radius_m - inner).min(arc);
        let least = (AT_END * smallest).max(LEAST * (outer - inner));
        let wave = 2.0 * PI * outer / most as f64 / IN_WAVE;
        let over_radius = Sizes {
            least,
            most: wave.min((outer - inner) / OVER_RING),
        };
        let mut breaks: Vec<f64> = knots_m.to_vec();
        breaks.push(end_radius_m);
        breaks.sort_by(f64::total_cmp);
        breaks.dedup_by(|next, kept| *next - *kept < over_radius.least);
        let end = |radii: &[f64]| {
            let distance = |r: &f64| (r - end_radius_m).abs();
            (0..radii.len()).min_by(|x, y| distance(&radii[*x]).total_cmp(&distance(&radii[*y])))
        };
        let mut radii_m = vec![breaks[0]];
        for pair in breaks.windows(2) {
            radii_m.extend(
                over_radius
                    .between(pair[0] - end_radius_m, pair[1] - end_radius_m)
                    .map(|d| end_radius_m + d),
            );
        }
        let along = Sizes {
            least,
            most: (wave * end_radius_m / outer).min(arc / ALONG_PITCH),
        };
        let to_slot = along
            .between(-arc, 0.0)
            .map(|d| half_pitch + d / end_radius_m);
        Mesh {
            end: end(&radii_m).unwrap_or(0),
            radii_m,
            angles_rad: std::iter::once(0.0).chain(to_slot).collect(),
        }
    }
}

/// Sizes of elements, which grow with the distance from the slot's end.
struct Sizes {
    least: f64,
    most: f64,
}

impl Sizes {
    /// Number of elements from the slot's end to a distance, ∫ dx/size.
    fn count(&self, distance: f64) -> f64 {
        let graded = ((self.most - self.least) / GROWTH).max(0.0);
        let within = distance.min(graded);
        (1.0 + GROWTH * within / self.least).ln() / GROWTH + (distance - within) / self.most
    }

    /// The distance to which so many elements reach.
    fn distance(&self, count: f64) -> f64 {
        let graded = ((self.most - self.least) / GROWTH).max(0.0);
        let within = self.count(graded);
        if count <= within {
            self.least * (GROWTH * count).exp_m1() / GROWTH
        } else {
            graded + (count - within) * self.most
        }
    }

    /// Ends of the elements from one place to a larger one on the same side of the slot's end, at zero.
    fn between(&self, from: f64, to: f64) -> impl Iterator<Item = f64> {
        let side = if from + to > 0.0 { 1.0 } else { -1.0 };
        let counts = [from, to].map(|place| side * self.count(place.abs()));
        let number = ((counts[1] - counts[0]) - 1e-9).ceil().max(1.0);
        (1..=number as usize).map(move |k| {
            if k as f64 == number {
                return to;
            }
            let count = counts[0] + (counts[1] - counts[0]) * k as f64 / number;
            side * self.distance(count.abs())
        })
    }
}
