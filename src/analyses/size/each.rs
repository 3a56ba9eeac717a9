//! Another number of the scene, for each value of which the ranges are found.

use super::SizeError;
use super::report::{SizeReport, SizedEach, SizedFor};
use crate::analyses::scene_number;
use crate::model::scene::{NamedValues, Parameter, Quantity, RefusedValue, Scene, SceneError};

/// Largest number of values.
const MOST: usize = 50;

/// A number of the scene, or that of several guides, with its values.
pub struct Each {
    parameters: Vec<Parameter>,
    /// The saws with these values, ascending.
    saws: Vec<(f64, Scene)>,
}

impl Each {
    /// The saws of a scene with the values of a number, at these paths.
    ///
    /// # Errors
    /// [`SceneError`] if the scene has no such number, or a value is refused.
    pub fn new(
        scene: &Scene,
        paths: &[String],
        (path, values): &NamedValues,
    ) -> Result<Self, SceneError> {
        if values.is_empty() || values.len() > MOST {
            let given = format!("{} values", values.len());
            let remedy = "write it like blade.thickness_m=2.0mm,2.2mm";
            let allowed = format!("1 to {MOST} values");
            return Err(RefusedValue::new(path, given, allowed, remedy).into());
        }
        if paths.is_empty() {
            let remedy = "add one to the scene";
            return Err(RefusedValue::missing("guides", "given, with a guide", remedy).into());
        }
        let parameters: Vec<Parameter> = paths.iter().map(|path| Parameter::new(path)).collect();
        for parameter in &parameters {
            parameter.get(scene.file())?;
        }
        let mut values = values.clone();
        values.sort_by(f64::total_cmp);
        values.dedup();
        let saws = values.into_iter().map(|value| {
            let numbers: Vec<_> = parameters.iter().map(|of| (of, value)).collect();
            Ok((value, scene.file().with(&numbers)?))
        });
        Ok(Each {
            saws: saws.collect::<Result<_, SceneError>>()?,
            parameters,
        })
    }

    /// Adds the ranges of each saw, found by `sized`, to the report of the scene.
    ///
    /// # Errors
    /// As `sized`.
    pub fn beside<E: From<SizeError>>(
        &self,
        own: &mut SizeReport,
        sized: impl Fn(&Scene) -> Result<SizeReport, E>,
    ) -> Result<(), E> {
        let path = self.parameters[0].path();
        let of_scene = self.parameters[0].get(&own.scene).ok();
        let row = |value: f64, found: &SizeReport| SizedFor {
            value,
            is_of_scene: of_scene == Some(value),
            from: found.from,
            to: found.to,
            windows: found.windows.clone(),
        };
        let mut rows: Vec<SizedFor> = of_scene.map(|value| row(value, own)).into_iter().collect();
        for (value, scene) in &self.saws {
            if of_scene != Some(*value) {
                let found = sized(scene)?;
                own.saws += found.saws;
                rows.push(row(*value, &found));
            }
        }
        rows.sort_by(|x, y| x.value.total_cmp(&y.value));
        own.each = Some(SizedEach {
            paths: self
                .parameters
                .iter()
                .map(|of| of.path().to_owned())
                .collect(),
            name: scene_number::name(path),
            unit: Quantity::of(path).map_or("", |of| of.unit).to_owned(),
            rows,
        });
        Ok(())
    }
}
