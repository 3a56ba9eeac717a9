//! Modes with their names, their shapes in the basis of the plate and their backward errors.

use faer::{Col, c64};

use super::{DescribedMode, NamedMode, SpectralModel};
use crate::modes::mode::Mode;
use crate::modes::mode_name::ModeName;

impl SpectralModel {
    /// Modes of one speed with names.
    pub fn name(&self, speed_rad_per_s: f64, modes: Vec<Mode>) -> Vec<NamedMode> {
        let waves = self.naming_waves(&modes);
        let named = modes.into_iter().zip(waves).map(|(mode, waves)| NamedMode {
            name: ModeName::new(&self.plate, &mode, &waves, speed_rad_per_s),
            mode,
        });
        named.collect()
    }

    /// The waves that name modes, in the basis of the plate: all but those far from them in frequency.
    pub(crate) fn naming_waves(&self, modes: &[Mode]) -> Vec<Col<c64>> {
        let mut waves = vec![Col::zeros(0); modes.len()];
        for (index, component) in self.components.iter().enumerate() {
            let own = modes
                .iter()
                .enumerate()
                .filter(|(_, mode)| mode.component == index);
            let (places, own): (Vec<usize>, Vec<&Mode>) = own.unzip();
            for (place, vector) in places.into_iter().zip(component.naming_waves(&own)) {
                waves[place] = self.embed(component.first, &vector);
            }
        }
        waves
    }

    /// Modes of one speed with names, shapes and backward errors, in the order given.
    pub fn describe(&self, speed_rad_per_s: f64, modes: Vec<Mode>) -> Vec<DescribedMode> {
        let mut described: Vec<Option<DescribedMode>> = modes.iter().map(|_| None).collect();
        for (index, component) in self.components.iter().enumerate() {
            let places: Vec<usize> = (0..modes.len())
                .filter(|&k| modes[k].component == index)
                .collect();
            if places.is_empty() {
                continue;
            }
            let own: Vec<Mode> = places.iter().map(|&k| modes[k].clone()).collect();
            let lifted = component.lifted_modes(speed_rad_per_s, &own);
            for ((place, mode), lifted) in places.into_iter().zip(own).zip(lifted) {
                let backward_error =
                    component
                        .norms()
                        .backward_error(speed_rad_per_s, mode.lambda, &lifted);
                let shape = self.embed(component.first, &lifted.shape);
                let name = ModeName::new(&self.plate, &mode, &shape, speed_rad_per_s);
                described[place] = Some(DescribedMode {
                    mode,
                    shape,
                    name,
                    backward_error,
                });
            }
        }
        described.into_iter().flatten().collect()
    }

    /// A vector of a component, whose first unknown has the index `first`, in the basis of the plate.
    fn embed(&self, first: usize, q: &Col<c64>) -> Col<c64> {
        let range = first..first + q.nrows();
        Col::from_fn(self.plate.degrees_of_freedom(), |i| {
            if range.contains(&i) {
                q[i - first]
            } else {
                c64::new(0.0, 0.0)
            }
        })
    }
}
