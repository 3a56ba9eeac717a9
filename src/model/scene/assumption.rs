//! Blocks of a scene of which only some numbers are given: typical numbers are assumed for the others.

use serde_json::Value;

use super::{ContactLaw, Scene, SceneError, SceneFile, Setting, typical_block};

/// A block for which typical numbers may be assumed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AssumedBlock {
    /// The forces of a cut.
    Cut,
    /// The course of a run-up.
    RunUp,
    /// The force of a cut that depends on the surface left by the preceding tooth, with its cut, the number of teeth and the damping of
    /// the material.
    Washboarding,
}

/// A scene with given numbers, and what was assumed beside them.
#[derive(Debug, Clone)]
pub struct Assumption {
    /// The scene with the given and the assumed numbers.
    pub scene: Scene,
    /// Path and value of each assumed number; empty if the scene has the block.
    pub assumed: Vec<(String, Value)>,
}

impl Assumption {
    /// What was assumed, such as "cut.depth_m = 0.1, cut.teeth_in_cut = 3".
    pub fn in_words(&self) -> String {
        let each = |(path, value): &(String, Value)| format!("{path} = {value}");
        self.assumed.iter().map(each).collect::<Vec<_>>().join(", ")
    }
}

impl AssumedBlock {
    /// Key of the block.
    pub fn key(self) -> &'static str {
        match self {
            AssumedBlock::Cut => "cut",
            AssumedBlock::RunUp => "runup",
            AssumedBlock::Washboarding => "cut.washboarding",
        }
    }

    /// Paths and typical contents of the block and of what it needs around it, the outermost first.
    fn typical(self, scene: &SceneFile) -> Vec<(&'static str, Value)> {
        match self {
            AssumedBlock::Cut => vec![("cut", typical_block::cut(scene))],
            AssumedBlock::RunUp => vec![("runup", typical_block::runup(scene))],
            AssumedBlock::Washboarding => vec![
                ("blade.teeth", typical_block::teeth(scene)),
                // Without damping a delayed force, however small, makes a mode grow.
                ("damping", typical_block::damping()),
                ("cut", typical_block::cut(scene)),
                ("cut.washboarding", typical_block::washboarding()),
            ],
        }
    }

    /// The scene with given numbers. If it lacks the block, typical numbers are assumed for those of the block that are
    /// not given.
    ///
    /// # Errors
    /// [`SceneError`] if a number is refused.
    pub fn completed(self, scene: &Scene, given: &[Setting]) -> Result<Assumption, SceneError> {
        let mut json = super::entries::value(scene.file());
        let mut assumed = Vec::new();
        for (path, typical) in self.typical(scene.file()) {
            let (parent, key) = path.split_once('.').unwrap_or(("", path));
            let place = match parent {
                "" => &mut json[key],
                parent => &mut json[parent][key],
            };
            if !place.is_null() {
                continue;
            }
            let is_given = |path: &str| given.iter().any(|setting| setting.path() == path);
            *place = match typical {
                Value::Object(mut block) => {
                    block.retain(|key, _| !is_given(&format!("{path}.{key}")));
                    let named =
                        |(key, value): (&String, &Value)| (format!("{path}.{key}"), value.clone());
                    assumed.extend(block.iter().map(named));
                    Value::Object(block)
                }
                number => {
                    assumed.push((path.to_owned(), number.clone()));
                    number
                }
            };
        }
        let scene = super::setting::set(json, given)?;
        Ok(Assumption { scene, assumed })
    }
}

impl Scene {
    /// The scene whose guides all have a gap. For guides that were linear, contact on one side is assumed.
    ///
    /// # Errors
    /// [`SceneError`] if the gap, or contact on one side at a guide, is refused.
    pub fn with_gap(&self, gap_m: f64) -> Result<Assumption, SceneError> {
        let guides = self.file().guides.iter().enumerate();
        let linear = guides.filter(|(_, guide)| guide.contact != ContactLaw::OneSided);
        let assumed = linear.map(|(k, _)| (format!("guides[{k}].contact"), "one_sided".into()));
        Ok(Assumption {
            assumed: assumed.collect(),
            scene: self.edited(|file| {
                for guide in &mut file.guides {
                    (guide.contact, guide.gap_m) = (ContactLaw::OneSided, Some(gap_m));
                }
            })?,
        })
    }
}
