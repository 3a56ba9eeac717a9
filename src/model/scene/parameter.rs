//! Access by path to a number of a scene: its value, and scenes in which it is changed.

use serde_json::{Number, Value};

use super::entries::value;
use super::{Kind, Quantity, RefusedValue, Scene, SceneError, SceneFile};

/// Path of a number of a scene, as in error messages: `guides[0].radius_m`.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Parameter {
    path: String,
    /// RFC 6901 pointer of the path: `/guides/0/radius_m`.
    pointer: String,
}

impl Parameter {
    /// The parameter with this path; a scene need not have it.
    pub fn new(path: &str) -> Self {
        let steps = path
            .split(['.', '['])
            .map(|step| step.trim_end_matches(']'));
        Parameter {
            path: path.to_owned(),
            pointer: steps.flat_map(|step| ["/", step]).collect(),
        }
    }

    /// JSON path of the number.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// The value in a scene.
    ///
    /// # Errors
    /// [`SceneError::Value`] if the scene has no number at this path.
    pub fn get(&self, scene: &SceneFile) -> Result<f64, SceneError> {
        let json = value(scene);
        let found = json.pointer(&self.pointer);
        found.and_then(Value::as_f64).ok_or_else(|| self.missing())
    }

    /// Refuses a count, such as a number of teeth: it does not vary.
    fn check_varies(&self) -> Result<(), RefusedValue> {
        match Quantity::kind_of(&self.path) {
            Kind::Count => {
                let allowed = "the path of a number that is no count, like guides[0].radius_m";
                let remedy = "compare scenes with other counts";
                let given = format!("{:?}", self.path);
                Err(RefusedValue::new("the parameter", given, allowed, remedy))
            }
            _ => Ok(()),
        }
    }

    fn missing(&self) -> SceneError {
        let allowed = "the path of a number that the scene has, like guides[0].radius_m";
        let remedy = "write this number into the scene, or correct its name";
        let given = format!("{:?}", self.path);
        RefusedValue::new("the parameter", given, allowed, remedy).into()
    }
}

impl SceneFile {
    /// The scene with other values of some numbers.
    ///
    /// # Errors
    /// [`SceneError`] if the scene has no number at a path or a count there, or a value is refused.
    pub fn with(&self, numbers: &[(&Parameter, f64)]) -> Result<Scene, SceneError> {
        let mut json = value(self);
        for (parameter, number) in numbers {
            parameter.check_varies()?;
            let place = json
                .pointer_mut(&parameter.pointer)
                .filter(|v| v.is_number());
            let number = Number::from_f64(*number).ok_or_else(|| {
                RefusedValue::new(
                    &parameter.path,
                    number.to_string(),
                    "finite",
                    "give a number",
                )
            })?;
            *place.ok_or_else(|| parameter.missing())? = Value::Number(number);
        }
        Scene::from_json(&json.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_read_and_replaced_by_its_path() {
        let paper = Scene::paper().file().clone();
        let radius = Parameter::new("guides[0].radius_m");
        let density = Parameter::new("blade.material.density_kg_per_m3");
        assert_eq!(radius.get(&paper).unwrap(), 0.2);
        let other = paper.with(&[(&radius, 0.25), (&density, 7900.0)]).unwrap();
        assert_eq!(other.file.guides[0].radius_m, 0.25);
        assert_eq!(other.blade.material.density_kg_per_m3, 7900.0);
        assert_eq!(other.file.cut, paper.cut);
    }

    #[test]
    fn numbers_that_no_scene_has_are_refused_by_name() {
        let paper = Scene::paper().file().clone();
        for path in ["guides[1].radius_m", "guides", "name", "", "blade..x", "]"] {
            let parameter = Parameter::new(path);
            let error = parameter.get(&paper).unwrap_err().to_string();
            assert!(error.contains(&format!("{path:?}")), "{error}");
            assert!(paper.with(&[(&parameter, 1.0)]).is_err(), "{path}");
        }
        let teeth = Parameter::new("blade.teeth");
        let error = paper.with(&[(&teeth, 42.0)]).unwrap_err().to_string();
        assert!(error.contains("no count"), "{error}");
        let thickness = Parameter::new("blade.thickness_m");
        for value in [-1.0, f64::NAN, f64::INFINITY] {
            let error = paper.with(&[(&thickness, value)]).unwrap_err().to_string();
            assert!(error.contains("blade.thickness_m"), "{error}");
        }
    }
}
