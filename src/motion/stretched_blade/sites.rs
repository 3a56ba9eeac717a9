//! Points of the blade at which deflections are evaluated, and the largest deflection over the blade.

use std::f64::consts::TAU;

use faer::{Col, Mat};

use super::StretchedBlade;
use super::slopes::ANGLES;
use crate::model::scene::Polar;

/// Places of the blade.
#[derive(Debug, Clone)]
pub struct Sites {
    /// Points (r, θ), each with the values of the shapes at it.
    points: Vec<(Polar, Col<f64>)>,
    /// Amplitudes of the waves of the shapes at each sampled radius: rows 2n and 2n + 1 are those of cos nθ and sin nθ.
    waves: Vec<Mat<f64>>,
    /// Values of these waves at evenly spaced angles, a row for each angle.
    around: Mat<f64>,
}

/// Ratio of the number of sampled radii of a plate to that of the points.
const EVERY: usize = 4;
/// Smallest number of angles for each wave between which the largest deflection is sought.
const ANGLES_A_WAVE: usize = 4;
/// Number of steps of Newton's method along a circle; each doubles the number of right digits.
const STEPS: usize = 6;

impl StretchedBlade {
    /// Points distributed over the blade.
    pub fn sites(&self) -> Sites {
        let plate = &self.plate;
        let angles = |radius_m| {
            (0..ANGLES).map(move |k| Polar::new(radius_m, TAU * k as f64 / ANGLES as f64))
        };
        let places = plate.sampled_radii_m().step_by(EVERY).flat_map(angles);
        let last = plate.max_diameters();
        let count = ANGLES.max(ANGLES_A_WAVE * (last + 1));
        let size = plate.radial_functions();
        let waves = |radius_m: f64| {
            // The radial functions of one nodal diameter differ from those of all others.
            let functions = [0, 1].map(|n| plate.basis.evaluate(n, radius_m).value);
            Mat::from_fn(2 * (last + 1), self.shapes.ncols(), |row, shape| {
                let (n, part) = (row / 2, row % 2);
                if (n, part) == (0, 1) {
                    return 0.0;
                }
                let first = plate.offset(n) + part * size;
                let terms = functions[usize::from(n == 1)].iter().enumerate();
                let sum: f64 = terms
                    .map(|(j, value)| self.shapes[(first + j, shape)] * value)
                    .sum();
                sum / plate.angular_norm(n)
            })
        };
        Sites {
            points: places.map(|place| (place, self.shapes_at(place))).collect(),
            waves: plate.sampled_radii_m().map(waves).collect(),
            around: Mat::from_fn(count, 2 * (last + 1), |row, column| {
                let (sin, cos) = ((column / 2) as f64 * TAU * row as f64 / count as f64).sin_cos();
                [cos, sin][column % 2]
            }),
        }
    }
}

impl Sites {
    /// Iterates over the points and the values of the shapes.
    pub(super) fn iter(&self) -> impl Iterator<Item = &(Polar, Col<f64>)> {
        self.points.iter()
    }

    /// Largest magnitude of the deflection over the blade: on circles by Newton's method, between them by a parabola.
    pub fn largest_m(&self, coordinates: &Col<f64>) -> f64 {
        let on = |circle: usize| largest_around(&self.around, &(&self.waves[circle] * coordinates));
        let last = self.waves.len() - 1;
        let coarse = (0..=last).step_by(EVERY).map(|circle| (circle, on(circle)));
        let Some((mut circle, mut largest_m)) = coarse.max_by(|x, y| x.1.total_cmp(&y.1)) else {
            return 0.0;
        };
        // The circles between are climbed from the largest one.
        loop {
            let [inner, outer] = [circle.saturating_sub(1), (circle + 1).min(last)];
            let beside_m = [on(inner), on(outer)];
            let better = usize::from(beside_m[1] > beside_m[0]);
            if beside_m[better] > largest_m {
                (circle, largest_m) = ([inner, outer][better], beside_m[better]);
                continue;
            }
            let curvature = 2.0 * largest_m - beside_m[0] - beside_m[1];
            if inner == circle || outer == circle || curvature <= 0.0 {
                return largest_m;
            }
            return largest_m + (beside_m[1] - beside_m[0]).powi(2) / (8.0 * curvature);
        }
    }
}

/// Largest magnitude of Σ aₙ cos nθ + bₙ sin nθ, from the waves a₀, 0, a₁, b₁, …
fn largest_around(around: &Mat<f64>, waves: &Col<f64>) -> f64 {
    let readings = around * waves;
    let sizes = readings.iter().map(|w| w.abs()).enumerate();
    let Some((place, coarse_m)) = sizes.max_by(|x, y| x.1.total_cmp(&y.1)) else {
        return 0.0;
    };
    let spacing = TAU / readings.nrows() as f64;
    let begun = place as f64 * spacing;
    let mut angle = begun;
    for _ in 0..STEPS {
        let [_, slope, curvature] = derivatives(waves, angle);
        let step = -slope / curvature;
        // The largest deflection is within a spacing; where the deflection is constant the step is not a number.
        let away = (angle + step - begun).abs();
        if away.is_nan() || away > spacing {
            break;
        }
        angle += step;
    }
    derivatives(waves, angle)[0].abs().max(coarse_m)
}

/// Σ aₙ cos nθ + bₙ sin nθ and its first two derivatives.
fn derivatives(waves: &Col<f64>, angle: f64) -> [f64; 3] {
    let mut found = [0.0; 3];
    for n in 0..waves.nrows() / 2 {
        let order = n as f64;
        let (sin, cos) = (order * angle).sin_cos();
        let (a, b) = (waves[2 * n], waves[2 * n + 1]);
        found[0] += a * cos + b * sin;
        found[1] += order * (b * cos - a * sin);
        found[2] -= order * order * (a * cos + b * sin);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plate::{Plate, Resolution};
    use crate::model::scene::Scene;

    /// The largest deflection of a blade under a force on its rim is that at the force, beside an evaluation every tenth of a degree.
    #[test]
    fn no_point_deflects_further_than_the_largest_deflection() {
        let resolution = Resolution {
            max_diameters: 12,
            radial_functions: 6,
        };
        let plate = Plate::new(&Scene::paper(), resolution);
        let rim_m = plate.blade.outer_radius_m;
        for (radius_m, angle_deg) in [(rim_m, 92.5), (rim_m, -41.3), (0.2, 10.7)] {
            let place = Polar::new(radius_m, f64::to_radians(angle_deg));
            let blade = StretchedBlade::up_to(&plate, 100.0, place, 20).unwrap();
            let blade = blade.pressed(0.1, place).unwrap();
            let found = blade.settled(0.0, &blade.flat()).unwrap();
            let largest_m = blade.sites().largest_m(&found.coordinates);
            let inner_m = plate.blade.inner_radius_m;
            let radii = (0..=60).map(|k| inner_m + (rim_m - inner_m) * f64::from(k) / 60.0);
            let dense = radii.flat_map(|radius| (0..720).map(move |k| (radius, f64::from(k))));
            let exact = dense
                .map(|(radius, k)| blade.deflection_m(&found, radius, TAU * k / 720.0).abs())
                .fold(0.0, f64::max);
            let at_force = blade.deflection_m(&found, place.radius_m, place.angle_rad);
            let exact = exact.max(at_force.abs());
            let over = largest_m / exact - 1.0;
            assert!(
                (-1e-9..1e-4).contains(&over),
                "{radius_m} {angle_deg}: {largest_m:e} {exact:e}"
            );
        }
    }
}
