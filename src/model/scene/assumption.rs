//! Blocks of a scene of which only some numbers are given: typical numbers are assumed for the others.

use serde_json::{Map, Value};

use super::{Scene, SceneError, SceneFile, Setting, typical_block};

/// A block for which typical numbers may be assumed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AssumedBlock {
    /// The forces of a cut.
    Cut,
    /// The course of a run-up.
    RunUp,
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
        }
    }

    fn typical(self, scene: &SceneFile) -> Value {
        match self {
            AssumedBlock::Cut => typical_block::cut(scene),
            AssumedBlock::RunUp => typical_block::runup(scene),
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
        if json[self.key()].is_null() {
            let block = self.beside(scene.file(), given);
            let named =
                |(key, value): (&String, &Value)| (format!("{}.{key}", self.key()), value.clone());
            assumed = block.iter().map(named).collect();
            json[self.key()] = Value::Object(block);
        }
        let scene = super::setting::set(json, given)?;
        Ok(Assumption { scene, assumed })
    }

    /// The typical numbers of the block without those that are given.
    fn beside(self, scene: &SceneFile, given: &[Setting]) -> Map<String, Value> {
        let Value::Object(mut block) = self.typical(scene) else {
            return Map::new();
        };
        block.retain(|key, _| {
            let path = format!("{}.{key}", self.key());
            given.iter().all(|setting| setting.path() != path)
        });
        block
    }
}
