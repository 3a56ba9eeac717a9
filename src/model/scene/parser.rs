//! Reads a [`SceneFile`] from bytes; errors name the key.

use std::path::Path;

use super::{GuideFile, RefusedValue, Scene, SceneError, SceneFile};
use crate::page::text::{KeyedError, Kind, OtherEncodings, from_keyed_json, read_path};

/// Largest size of a scene file; a larger file is not a scene.
#[doc(hidden)]
pub const MAX_SCENE_BYTES: u64 = 1 << 20;

/// Options for reading scene and study files.
pub(crate) const SCENE_TEXT: Kind = Kind {
    limit: MAX_SCENE_BYTES,
    other_encodings: OtherEncodings::Refused,
};

impl Scene {
    /// The paper's guided spline saw, as in `scenes/paper.json`.
    pub fn paper() -> Self {
        Self::from_json(include_str!("../../../scenes/paper.json"))
            .expect("the embedded scene is checked by the tests")
    }

    /// Reads and validates a scene file.
    ///
    /// # Errors
    /// [`SceneError`] with the JSON path of the offending key.
    pub fn from_path(path: impl AsRef<Path>) -> Result<Self, SceneError> {
        Self::from_json(&read_path(path.as_ref(), SCENE_TEXT)?)
    }

    /// Reads and validates a scene from its JSON text.
    ///
    /// # Errors
    /// [`SceneError`] with the JSON path of the offending key.
    pub fn from_json(text: &str) -> Result<Self, SceneError> {
        Self::of_typed(Self::file_from_json(text)?)
    }

    /// Validates a scene as a user typed it, in which two equal pads are a slip. A search may pass through such a scene.
    ///
    /// # Errors
    /// [`SceneError`].
    pub(crate) fn of_typed(file: SceneFile) -> Result<Self, SceneError> {
        let scene = Scene::try_from(file)?;
        no_copies(&scene.file().guides)?;
        Ok(scene)
    }

    /// Reads a scene file without validating its numbers.
    pub(crate) fn file_from_json(text: &str) -> Result<SceneFile, SceneError> {
        if text.trim().is_empty() {
            return Err(SceneError::Empty);
        }
        from_keyed_json(text, "the scene").map_err(syntax)
    }
}

/// Refuses a pad that equals an earlier one.
fn no_copies(guides: &[GuideFile]) -> Result<(), RefusedValue> {
    for (index, pad) in guides.iter().enumerate() {
        if let Some(same) = guides[..index].iter().position(|other| other == pad) {
            return Err(RefusedValue::new(
                format!("guides[{index}]"),
                "the same place and numbers",
                format!("another pad than guides[{same}]"),
                "give it its own place, or leave it out; a pad on both faces of the blade is one pad",
            ));
        }
    }
    Ok(())
}

fn syntax(error: KeyedError) -> SceneError {
    let KeyedError {
        key,
        message,
        allowed,
        remedy,
        ..
    } = error.pointing_to("`sawflutter schema` prints the keys and types of a scene");
    SceneError::Syntax {
        key,
        message,
        allowed,
        remedy,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The paper's scene with keys before its own; it has 42 teeth.
    fn with(first: &str, teeth: &str) -> Result<Scene, String> {
        let paper = include_str!("../../../scenes/paper.json");
        let text = paper.replacen('{', &format!("{{ {first}"), 1);
        assert!(text.contains("\"teeth\": 42"));
        let with_teeth = text.replace("\"teeth\": 42", &format!("\"teeth\": {teeth}"));
        Scene::from_json(&with_teeth).map_err(|error| error.to_string())
    }

    #[test]
    fn a_whole_number_may_have_a_decimal_point() {
        for teeth in ["42.0", "4.2e1", "\"42\"", "\"42.0\""] {
            assert_eq!(with("", teeth), Ok(Scene::paper()), "{teeth}");
        }
        let refused = with("", "42.5").unwrap_err();
        assert!(
            refused.starts_with("blade.teeth: must be a whole number, 0 or more (you gave 42.5)")
        );
        // The parser reads both as floating point numbers, however they are written.
        assert_eq!(with("", "-0"), with("", "0"));
        assert!(with("", "1e30").unwrap_err().starts_with("blade.teeth: "));
    }

    #[test]
    fn all_missing_keys_are_named_at_once() {
        let said = |text: &str| Scene::from_json(text).unwrap_err().to_string();
        let found = said(r#"{ "name": "a", "blade": {}, "guides": [{ "radius_m": 0.2 }] }"#);
        for key in [
            "blade.material",
            "guides[0].angle_deg",
            "guides[0].stiffness_n_per_m",
        ] {
            assert!(found.contains(key), "{found}");
        }
        assert!(!found.contains("guides[0].radius_m"), "{found}");
        assert!(said("{}").starts_with("name: it is missing (also missing: blade, mount)"));
    }

    #[test]
    fn a_schema_may_be_named_and_remarks_have_a_place() {
        let address = "https://example.org/scene.json";
        let scene = with(&format!("\"$schema\": \"{address}\","), "42").unwrap();
        assert_eq!(scene.file().schema.as_deref(), Some(address));
        assert_eq!(scene.file().inputs(), Scene::paper().file().inputs());
        let refused = with("\"_comment\": \"mine\",", "42").unwrap_err();
        assert!(refused.starts_with("_comment: there is no such key; write remarks"));
        assert!(refused.contains("list notes"), "{refused}");
    }
}
