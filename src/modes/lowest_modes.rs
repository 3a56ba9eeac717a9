//! The lowest modes at one speed on the full model, for a few speeds of many slightly different saws, for
//! which preparing a range of speeds does not pay off.

use crate::model::plate::Plate;

use super::arnoldi::lowest_eigenpairs;
use super::companion::companion_eigenpairs;
use super::component::Component;
use super::error::SpectrumError;
use super::mode::{Mode, ModeKind, classify};
use super::model::SPLITTING;
use super::scale::frequency_scale;
use super::work::Cancellation;

/// A plate prepared for its lowest modes.
#[derive(Debug)]
pub struct LowestModes {
    /// Independent components of the plate, without reduced models.
    pub components: Vec<Component>,
    /// Number of nodal diameters of each unknown of the plate.
    diameters: Vec<usize>,
    scale_rad_per_s: f64,
}

/// Number of eigenpairs beyond the requested ones: they are found in the order of |λ|, whereas modes are
/// requested in the order of frequency, so that a growing mode of low frequency is found late.
const MORE: usize = 4;
/// Below this order all eigenvalues cost less than an iteration.
const SMALL: usize = 40;

impl LowestModes {
    /// Assembles the equation of motion of a plate.
    pub fn new(plate: &Plate) -> Self {
        let order = plate.degrees_of_freedom();
        let ends = (1..=plate.max_diameters())
            .map(|n| plate.offset(n))
            .chain([order]);
        let mut diameters = Vec::with_capacity(order);
        for (n, end) in ends.enumerate() {
            diameters.resize(end, n);
        }
        LowestModes {
            components: Component::of(plate),
            diameters,
            scale_rad_per_s: frequency_scale(plate),
        }
    }

    /// The `count` modes of lowest |Im λ| at a speed, ascending, without rigid motions and overdamped
    /// modes; fewer if the basis has fewer.
    ///
    /// # Errors
    /// [`SpectrumError`] when an eigenproblem fails.
    pub fn at(&self, speed_rad_per_s: f64, count: usize) -> Result<Vec<Mode>, SpectrumError> {
        Cancellation::current().check()?;
        let speed = speed_rad_per_s.max(SPLITTING * self.scale_rad_per_s);
        let mut modes = Vec::new();
        for (index, component) in self.components.iter().enumerate() {
            let system = &component.full;
            let mut pairs = Vec::new();
            if system.order() > SMALL {
                let shift = 0.5 * self.scale_rad_per_s;
                pairs = lowest_eigenpairs(system, speed, count + MORE, shift)?;
            }
            if pairs.len() < count {
                pairs = companion_eigenpairs(system, speed)?;
            }
            modes.extend(classify(system, speed, index, pairs));
        }
        let oscillates = |m: &Mode| m.lambda.im > 0.0 || m.lambda.re > 0.0;
        modes.retain(|m| m.kind != ModeKind::Rigid && oscillates(m));
        modes.sort_by(|x, y| x.frequency_rad_per_s().total_cmp(&y.frequency_rad_per_s()));
        modes.truncate(count);
        Ok(modes)
    }

    /// The number of nodal diameters with the largest share of the kinetic energy of a mode.
    pub fn diameters_of(&self, mode: &Mode) -> usize {
        let first = self.components[mode.component].first;
        let mut shares = vec![0.0; self.diameters.last().map_or(1, |most| most + 1)];
        for (n, coordinate) in self.diameters[first..].iter().zip(mode.coordinates.iter()) {
            shares[*n] += coordinate.norm_sqr();
        }
        let largest = (0..shares.len()).max_by(|n, m| shares[*n].total_cmp(&shares[*m]));
        largest.unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plate::Resolution;
    use crate::model::scene::{Scene, SpeedRange, rad_per_s};
    use crate::modes::{SpectralModel, Strategy};

    /// The saw is at rest, above critical speeds, in a band of divergence and in a flutter band.
    #[test]
    fn lowest_modes_are_the_lowest_of_all() {
        let resolution = Resolution {
            max_diameters: 8,
            radial_functions: 5,
        };
        let free = Scene::paper().edited(|saw| saw.guides.clear()).unwrap();
        for scene in [Scene::paper(), free] {
            let plate = Plate::new(&scene, resolution);
            let lowest = LowestModes::new(&plate);
            let range = SpeedRange::between_rpm(0.0, 2600.0);
            let model = SpectralModel::new(plate, range, Strategy::Dense).unwrap();
            for speed in [0.0, 800.0, 1540.0, 2260.0, 2500.0].map(rad_per_s) {
                let found = lowest.at(speed, 6).unwrap();
                assert_eq!(found.len(), 6);
                for (found, exact) in found.iter().zip(model.modes(speed).unwrap()) {
                    assert_eq!(found.kind, exact.kind);
                    let distance = (found.lambda - exact.lambda).norm();
                    assert!(distance < 1e-6, "{} {}", found.lambda, exact.lambda);
                }
            }
        }
    }
}
