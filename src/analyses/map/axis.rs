//! The axes of a map.

use super::{MapAxis, Range};
use crate::analyses::study::{DistributionFile, ParameterFile, StudyError, check_varies};
use crate::model::scene::{Freed, Quantity, Scene, is_logarithmic};

impl MapAxis {
    /// `points` values of a range, whose ends are exact; `key` names the axis in errors.
    pub(super) fn new(
        scene: &Scene,
        key: &str,
        range: &Range,
        points: usize,
    ) -> Result<Self, StudyError> {
        let refused = |source| StudyError::Scene {
            key: key.to_owned(),
            source,
        };
        let Range { path, from, to } = range;
        let freed = Freed::new(scene.file(), path, *from, *to).map_err(refused)?;
        check_varies(key, path)?;
        let quantity = Quantity::of(path);
        let of_scene = freed.parameter.get(scene.file()).map_err(refused)?;
        Ok(MapAxis {
            name: quantity
                .map_or(path.as_str(), |quantity| quantity.name)
                .to_owned(),
            unit: quantity.map_or("", |quantity| quantity.unit).to_owned(),
            path: path.clone(),
            values: freed.values(points),
            of_scene,
        })
    }

    /// The axis with the value of the scene among its values, if it is between them.
    pub(super) fn with_scene(mut self) -> Self {
        let own = self.of_scene;
        let place = self.values.partition_point(|value| *value < own);
        if place > 0 && self.values.get(place).is_some_and(|next| *next != own) {
            self.values.insert(place, own);
        }
        self
    }

    /// The value at a place of the grid, counted in points from 0, between two points on the scale of the axis.
    pub(super) fn at(&self, place: f64) -> f64 {
        let last = self.values.len() - 1;
        let below = (place.max(0.0) as usize).min(last.saturating_sub(1));
        let (from, to) = (self.values[below], self.values[(below + 1).min(last)]);
        let share = place - below as f64;
        if is_logarithmic(self.values[0], self.values[last]) {
            from * (to / from).powf(share)
        } else {
            from + share * (to - from)
        }
    }

    pub(super) fn grid(&self) -> ParameterFile {
        ParameterFile {
            path: self.path.clone(),
            distribution: DistributionFile::Grid {
                values: self.values.clone(),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_value_of_the_scene_is_among_those_between_the_ends() {
        let with = |of_scene: f64| {
            let axis = MapAxis {
                path: String::new(),
                name: String::new(),
                unit: String::new(),
                values: vec![1.0, 2.0, 3.0],
                of_scene,
            };
            axis.with_scene().values
        };
        assert_eq!(with(2.5), [1.0, 2.0, 2.5, 3.0]);
        for beside in [0.5, 1.0, 2.0, 3.0, 3.5] {
            assert_eq!(with(beside), [1.0, 2.0, 3.0], "{beside}");
        }
    }
}
