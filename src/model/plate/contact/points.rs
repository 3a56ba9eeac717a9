//! Points of a pad, for blades whose functions are not those of [`Plate`](super::super::Plate).

use std::f64::consts::FRAC_PI_2;

use super::super::quadrature::{Rule, smooth};
use crate::model::scene::{Blade, GuideFile, GuideShape};

/// A point of a pad on the blade.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PadPoint {
    /// Distance from the axis.
    pub radius_m: f64,
    /// Angle from the centre line of the pad.
    pub angle_rad: f64,
    /// Share of the pad.
    pub share: f64,
}

/// Number of nodal diameters that the points resolve, and least and most numbers of points across the radius.
const DIAMETERS: f64 = 16.0;
const ACROSS: [f64; 2] = [6.0, 24.0];
/// Number of points along the radius for a pad as long as the ring is wide, and least and most numbers.
const OVER_RING: f64 = 12.0;
const ALONG: [f64; 2] = [3.0, 14.0];

/// Points and shares of a pad, clipped to the blade: Gauss rules in Cartesian coordinates along and across its centre line. The shares
/// of a pad that lies on the blade have the sum 1.
pub(crate) fn pad_points(blade: &Blade, pad: &GuideFile) -> Vec<PadPoint> {
    if pad.is_point() {
        return vec![PadPoint {
            radius_m: pad.radius_m,
            angle_rad: 0.0,
            share: 1.0,
        }];
    }
    let [half_along, half_across] = pad.half_lengths_m();
    let (inner, outer) = (blade.inner_radius_m, blade.outer_radius_m);
    let number = |count: f64, [least, most]: [f64; 2]| count.ceil().clamp(least, most) as usize;
    let across = number(
        DIAMETERS * half_across / pad.radius_m.max(inner) + 4.0,
        ACROSS,
    );
    let along = |length: f64| number(OVER_RING * length / (outer - inner) + 2.0, ALONG);
    let area = pad.area_m2();
    let mut points = Vec::new();
    for (y, reach, weight) in rows(pad.shape, [half_along, half_across], across) {
        let root = |radius: f64| (radius * radius - y * y).max(0.0).sqrt();
        let [near, far] = [root(inner), root(outer)];
        for side in [[-far, -near], [near, far]] {
            let from = side[0].max(pad.radius_m - reach);
            let to = side[1].min(pad.radius_m + reach);
            if to > from {
                points.extend(
                    smooth(from, to, along(to - from))
                        .iter()
                        .map(|(x, own)| PadPoint {
                            radius_m: x.hypot(y),
                            angle_rad: y.atan2(x),
                            share: own * weight / area,
                        }),
                );
            }
        }
    }
    points
}

/// Distances from the centre line, half the length of the pad along the radius there, and weights.
fn rows(shape: GuideShape, [along, across]: [f64; 2], count: usize) -> Vec<(f64, f64, f64)> {
    match shape {
        GuideShape::Rectangle => {
            let rule: Rule = smooth(-across, across, count);
            rule.iter().map(|(y, w)| (y, along, w)).collect()
        }
        // With y = b sin φ the chord a cos φ is smooth.
        GuideShape::Round => {
            let rule = smooth(-FRAC_PI_2, FRAC_PI_2, count);
            let row = |(phi, w): (f64, f64)| {
                (
                    across * phi.sin(),
                    along * phi.cos(),
                    w * across * phi.cos(),
                )
            };
            rule.iter().map(row).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::Scene;

    /// Area and moments of a rectangle and an ellipse, and the share of a pad beyond the rim by a known circular segment.
    #[test]
    fn points_have_the_area_and_the_moments_of_the_pad() {
        let blade = *Scene::paper().blade();
        let pad = |shape, radius_m| GuideFile {
            radius_m,
            radial_length_m: 0.05,
            tangential_length_m: 0.08,
            shape,
            stiffness_n_per_m: 1.0,
            ..GuideFile::default()
        };
        for (shape, square) in [
            (GuideShape::Rectangle, 0.08_f64.powi(2) / 12.0),
            (GuideShape::Round, 0.08_f64.powi(2) / 16.0),
        ] {
            let points = pad_points(&blade, &pad(shape, 0.25));
            let sum = |f: &dyn Fn(&PadPoint) -> f64| -> f64 {
                points.iter().map(|p| p.share * f(p)).sum()
            };
            assert!((sum(&|_| 1.0) - 1.0).abs() < 1e-6);
            let across = sum(&|p| (p.radius_m * p.angle_rad.sin()).powi(2));
            assert!((across / square - 1.0).abs() < 1e-4, "{across} {square}");
            let along = sum(&|p| p.radius_m * p.angle_rad.cos());
            assert!((along - 0.25).abs() < 1e-6);
        }
        // A rectangle whose centre is on the rim: b² asin(s/2b) + s/2 √(b² − s²/4) − s(b − l/2) of s l.
        let (b, s, l) = (blade.outer_radius_m, 0.08_f64, 0.05_f64);
        let h = 0.5 * s;
        let inside = b * b * (h / b).asin() + h * (b * b - h * h).sqrt() - s * (b - 0.5 * l);
        let points = pad_points(&blade, &pad(GuideShape::Rectangle, b));
        let share: f64 = points.iter().map(|p| p.share).sum();
        assert!((share - inside / (s * l)).abs() < 1e-6, "{share}");
    }
}
