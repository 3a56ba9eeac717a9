//! Computed frequencies at the measured speeds, and their derivatives by the freed numbers.

use std::f64::consts::TAU;

use basin::DenseMatrix;

use crate::model::plate::{Plate, Resolution};
use crate::model::scene::{Freed, Scene, SceneError, SceneFile, rad_per_s, scene_at};
use crate::model::system::GyroscopicSystem;
use crate::modes::{
    Component, Differences, LowestModes, Mode, SpectrumError, derivative, matrix_slopes,
};

use super::matching::{Tone, matched};
use super::{Measurement, Row};

/// A saw with freed numbers, on one basis.
pub struct Model<'a> {
    pub scene: &'a SceneFile,
    pub freed: &'a [Freed],
    pub measurement: &'a Measurement,
    pub resolution: Resolution,
}

/// Step of the differences as a share of the bounds. The truncation error is of fourth order in this step, and the
/// rounding error of the matrices is 1e-16/1e-3.
const STEP: f64 = 1e-3;

impl Model<'_> {
    fn plate(&self, shares: &[f64]) -> Result<Plate, SceneError> {
        let scene = scene_at(self.scene, self.freed, shares)?;
        Ok(Plate::new(&scene, self.resolution))
    }

    /// Computed minus measured frequency of every pair, in Hz. NaN if the scene refuses this combination of
    /// values; the solver then shortens its step.
    pub fn residuals_hz(&self, shares: &[f64]) -> Result<Vec<f64>, SpectrumError> {
        Ok(self.residuals_of(self.solved(shares)?.as_ref()))
    }

    /// The residuals of a saw whose numbers need not lie between the bounds.
    pub fn residuals_of_saw_hz(&self, saw: &Scene) -> Result<Vec<f64>, SpectrumError> {
        let solved = Solved::new(&Plate::new(saw, self.resolution), self.measurement)?;
        Ok(self.residuals_of(Some(&solved)))
    }

    /// Computes the residuals as [`Model::residuals_hz`] does, and their derivatives by every share.
    pub fn residuals_and_slopes(
        &self,
        shares: &[f64],
    ) -> Result<(Vec<f64>, DenseMatrix<f64>), SpectrumError> {
        let solved = self.solved(shares)?;
        let slopes = self.slopes_of(shares, solved.as_ref());
        Ok((self.residuals_of(solved.as_ref()), slopes))
    }

    /// The modes at the measured speeds; `None` if the scene refuses this combination of values.
    pub fn solved(&self, shares: &[f64]) -> Result<Option<Solved>, SpectrumError> {
        let plate = self.plate(shares).ok();
        plate
            .map(|plate| Solved::new(&plate, self.measurement))
            .transpose()
    }

    /// The residuals of a saw in Hz. A mode that the basis lacks has the frequency zero.
    pub fn residuals_of(&self, solved: Option<&Solved>) -> Vec<f64> {
        let Some(solved) = solved else {
            return vec![f64::NAN; self.measurement.count()];
        };
        let pairs = solved.pairs(self.measurement);
        pairs
            .map(|(_, mode, measured_hz)| mode.map_or(0.0, frequency_hz) - measured_hz)
            .collect()
    }

    /// The derivatives of the residuals by every share. The derivative of an eigenvalue by the matrices is exact;
    /// [`matrix_slopes`] gives that of the matrices.
    pub fn slopes_of(&self, shares: &[f64], solved: Option<&Solved>) -> DenseMatrix<f64> {
        let (rows, columns) = (self.measurement.count(), self.freed.len());
        let changes: Result<Vec<_>, SceneError> = (0..columns)
            .map(|k| self.changed_components(shares, k))
            .collect();
        let (Some(solved), Ok(changes)) = (solved, changes) else {
            return DenseMatrix::from_row_slice(rows, columns, &vec![f64::NAN; rows * columns]);
        };
        let of = &solved.lowest.components;
        let slopes = solved.pairs(self.measurement).flat_map(|(speed, mode, _)| {
            changes.iter().map(move |components| {
                mode.map_or(0.0, |mode| slope_hz(of, components, speed, mode))
            })
        });
        DenseMatrix::from_row_slice(rows, columns, &slopes.collect::<Vec<f64>>())
    }

    /// Derivative by share k of the matrices of every component.
    fn changed_components(
        &self,
        shares: &[f64],
        k: usize,
    ) -> Result<Vec<GyroscopicSystem>, SceneError> {
        // Values beyond the bounds may be refused, so that the differences near a bound are one-sided.
        let differences = match shares[k] {
            share if share < 2.0 * STEP => Differences::Above,
            share if share > 1.0 - 2.0 * STEP => Differences::Below,
            _ => Differences::Central,
        };
        matrix_slopes(STEP, differences, |by| {
            let mut shares = shares.to_vec();
            shares[k] += by;
            self.plate(&shares)
        })
    }
}

/// A saw, and its lowest modes at the speeds of all rows.
pub struct Solved {
    lowest: LowestModes,
    rows: Vec<Assigned>,
}

impl Solved {
    fn new(plate: &Plate, measurement: &Measurement) -> Result<Self, SpectrumError> {
        let lowest = LowestModes::new(plate);
        let rows = measurement.rows.iter();
        Ok(Solved {
            rows: rows
                .map(|row| Assigned::new(&lowest, row))
                .collect::<Result<_, _>>()?,
            lowest,
        })
    }

    /// Speed in rad/s, mode, if the basis has it, and measured frequency in Hz of every pair.
    fn pairs<'a>(
        &'a self,
        measurement: &'a Measurement,
    ) -> impl Iterator<Item = (f64, Option<&'a Mode>, f64)> {
        let rows = measurement.rows.iter().zip(&self.rows);
        rows.flat_map(|(row, assigned)| {
            let pairs = row.pairs.iter().enumerate();
            pairs.map(|(column, (_, hz))| (rad_per_s(row.rpm), assigned.mode(column), *hz))
        })
    }
}

/// The lowest modes of a saw at the speed of a row, assigned to its measured frequencies.
pub struct Assigned {
    modes: Vec<Mode>,
    tones: Vec<Tone>,
    found: Vec<Option<usize>>,
}

impl Assigned {
    pub fn new(lowest: &LowestModes, row: &Row) -> Result<Self, SpectrumError> {
        let modes = lowest.at(rad_per_s(row.rpm), row.modes_needed())?;
        let tones: Vec<Tone> = modes
            .iter()
            .map(|mode| Tone {
                hz: frequency_hz(mode),
                diameters: lowest.diameters_of(mode),
            })
            .collect();
        let found = matched(row, &tones);
        Ok(Assigned {
            modes,
            tones,
            found,
        })
    }

    /// Place among the modes, from 0, of a measured frequency; `None` if the basis lacks it.
    pub fn place(&self, column: usize) -> Option<usize> {
        self.found[column]
    }

    /// Nodal diameters of the mode of a measured frequency.
    pub fn diameters(&self, column: usize) -> Option<usize> {
        Some(self.tones[self.place(column)?].diameters)
    }

    /// The mode of a measured frequency.
    pub fn mode(&self, column: usize) -> Option<&Mode> {
        Some(&self.modes[self.place(column)?])
    }
}

/// The `count` lowest frequencies of a saw at a speed in rpm, in Hz.
pub fn frequencies_hz(
    lowest: &LowestModes,
    rpm: f64,
    count: usize,
) -> Result<Vec<f64>, SpectrumError> {
    let modes = lowest.at(rad_per_s(rpm), count)?;
    Ok(modes.iter().map(frequency_hz).collect())
}

pub fn frequency_hz(mode: &Mode) -> f64 {
    mode.frequency_rad_per_s() / TAU
}

/// Derivative of |Im λ|/2π of a mode for a change of the matrices.
fn slope_hz(
    components: &[Component],
    changes: &[GyroscopicSystem],
    speed_rad_per_s: f64,
    mode: &Mode,
) -> f64 {
    let (system, change) = (&components[mode.component].full, &changes[mode.component]);
    let moved = derivative::with_change(
        system,
        speed_rad_per_s,
        mode.lambda,
        &mode.coordinates,
        change,
    );
    let slope = moved.im / TAU;
    // The slope is infinite where two modes coalesce, and is replaced by zero.
    if slope.is_finite() { slope } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_those_of_differences() {
        let scene = Scene::paper().file().clone();
        let measurement = Measurement::of_scene(scene.measured.as_ref().unwrap()).up_to(1250.0);
        let freed = [
            ("guides[0].radius_m", 0.15, 0.3),
            ("guides[0].stiffness_n_per_m", 1e6, 1e8),
            ("blade.material.density_kg_per_m3", 7000.0, 8500.0),
        ]
        .map(|(path, from, to)| Freed::new(&scene, path, from, to).unwrap());
        let model = Model {
            scene: &scene,
            freed: &freed,
            measurement: &measurement,
            resolution: Resolution {
                max_diameters: 6,
                radial_functions: 4,
            },
        };
        // One point inside, and one so near to a bound that differences are one-sided.
        for shares in [[0.3, 0.6, 0.5], [0.9995, 0.5, 0.0005]] {
            let (residuals, slopes) = model.residuals_and_slopes(&shares).unwrap();
            assert_eq!(residuals, model.residuals_hz(&shares).unwrap());
            for k in 0..3 {
                let moved = |by: f64| {
                    let mut shares = shares;
                    shares[k] += by;
                    model.residuals_hz(&shares).unwrap()
                };
                let (less, more) = (moved(-1e-4), moved(1e-4));
                let largest = (0..24).fold(0.0, |m: f64, i| m.max(slopes.get(i, k).abs()));
                for i in 0..24 {
                    let difference = (more[i] - less[i]) / 2e-4;
                    let off = (slopes.get(i, k) - difference).abs();
                    assert!(off < 1e-4 * largest, "{i} {k}: {difference}, off by {off}");
                }
            }
        }
    }
}
