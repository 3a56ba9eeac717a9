//! Slopes of the blade.

use std::f64::consts::TAU;

use faer::{Col, Mat};

use super::StretchedBlade;

/// Number of angles at which slopes are evaluated: more than two for each wave of a usual basis.
pub(super) const ANGLES: usize = 72;

/// Slopes of the shapes at points distributed over the blade, a row for each point.
#[derive(Debug, Clone)]
pub struct Slopes {
    /// ∂w/∂r.
    radial: Mat<f64>,
    /// ∂w/r∂θ.
    hoop: Mat<f64>,
}

impl StretchedBlade {
    /// The slopes of the shapes. The potential of stretching is valid up to slopes of about 0.1.
    pub fn slopes(&self) -> Slopes {
        let plate = &self.plate;
        let waves = 1 + plate.max_diameters();
        let angle = |row: usize| TAU * row as f64 / ANGLES as f64;
        // Columns 2n and 2n + 1 are the cosine and the sine of n nodal diameters.
        let along_radius = Mat::from_fn(ANGLES, 2 * waves, |row, column| {
            let (sin, cos) = ((column / 2) as f64 * angle(row)).sin_cos();
            [cos, sin][column % 2]
        });
        let along_hoop = Mat::from_fn(ANGLES, 2 * waves, |row, column| {
            let n = (column / 2) as f64;
            let (sin, cos) = (n * angle(row)).sin_cos();
            [-n * sin, n * cos][column % 2]
        });
        let radii: Vec<f64> = plate.sampled_radii_m().collect();
        let (order, size) = (self.shapes.ncols(), plate.radial_functions());
        let mut slopes = Slopes {
            radial: Mat::zeros(radii.len() * ANGLES, order),
            hoop: Mat::zeros(radii.len() * ANGLES, order),
        };
        for (place, &radius_m) in radii.iter().enumerate() {
            // The radial functions of one nodal diameter differ from those of all others.
            let functions = [0, 1].map(|n| plate.basis.evaluate(n, radius_m));
            let factors = |column: usize, shape: usize, of: &[f64]| {
                let (n, part) = (column / 2, column % 2);
                if (n, part) == (0, 1) {
                    return 0.0;
                }
                let first = plate.offset(n) + part * size;
                let terms = of.iter().enumerate();
                let sum: f64 = terms
                    .map(|(j, value)| self.shapes[(first + j, shape)] * value)
                    .sum();
                sum / plate.angular_norm(n)
            };
            let of_waves = |column: usize| &functions[usize::from(column / 2 == 1)];
            let radial = Mat::from_fn(2 * waves, order, |column, shape| {
                factors(column, shape, &of_waves(column).slope)
            });
            let hoop = Mat::from_fn(2 * waves, order, |column, shape| {
                factors(column, shape, &of_waves(column).value) / radius_m
            });
            let first = place * ANGLES;
            let mut rows = slopes.radial.subrows_mut(first, ANGLES);
            rows.copy_from(&along_radius * radial);
            let mut rows = slopes.hoop.subrows_mut(first, ANGLES);
            rows.copy_from(&along_hoop * hoop);
        }
        slopes
    }
}

impl Slopes {
    /// Largest slope |∇w| of a deflection.
    pub fn largest(&self, coordinates: &Col<f64>) -> f64 {
        let (radial, hoop) = (&self.radial * coordinates, &self.hoop * coordinates);
        let pairs = radial.iter().zip(hoop.iter());
        pairs
            .map(|(radial, hoop)| radial.hypot(*hoop))
            .fold(0.0, f64::max)
    }
}
