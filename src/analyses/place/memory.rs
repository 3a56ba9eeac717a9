//! The saws of a placement on the disk: a stopped run goes on with those that it has computed.
//!
//! A search is deterministic, so that it asks for the same saws again. The first line of the log contains the inputs of the
//! placement; each further line is a saw with the basis, the freed numbers and their shares. A last line without line end was
//! truncated when the run stopped, and is ignored.

use std::collections::HashMap;
use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::outcome::Known;
use crate::model::scene::SceneFile;

/// Names of the log and of the scene in the folder of the results.
const LOG: &str = "place-log.jsonl";
pub const PLACED: &str = "placed-scene.json";

/// Saws that are known to all searches of a placement, and their log.
pub struct Memory {
    known: Mutex<HashMap<String, Known>>,
    log: Mutex<Option<File>>,
    folder: Option<PathBuf>,
}

/// A line of the log.
#[derive(Serialize, Deserialize)]
struct Line {
    /// Which saw it is.
    saw: Value,
    found: Known,
}

impl Memory {
    /// A memory without a log.
    pub fn none() -> Self {
        Memory {
            known: Mutex::default(),
            log: Mutex::new(None),
            folder: None,
        }
    }

    /// The saws of the log in a folder, if it was begun with the same inputs; another log is begun anew.
    ///
    /// # Errors
    /// The error of the system that cannot read or write the log.
    pub fn of(folder: &Path, inputs: &Value) -> io::Result<Self> {
        std::fs::create_dir_all(folder)?;
        let path = folder.join(LOG);
        let text = match std::fs::read_to_string(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => String::new(),
            read => read?,
        };
        let first = inputs.to_string() + "\n";
        let (whole, _) = text.rsplit_once('\n').unwrap_or_default();
        let is_same = text.starts_with(&first);
        let lines = whole.lines().skip(1).filter(|_| is_same);
        let known: HashMap<String, Known> = lines
            .filter_map(|line| serde_json::from_str::<Line>(line).ok())
            .map(|line| (line.saw.to_string(), line.found))
            .collect();
        let mut log = OpenOptions::new().create(true).append(true).open(&path)?;
        if is_same {
            // What a stopped run left of its last line.
            log.set_len(whole.len() as u64 + 1)?;
        } else {
            log.set_len(0)?;
            log.write_all(first.as_bytes())?;
        }
        Ok(Memory {
            known: Mutex::new(known),
            log: Mutex::new(Some(log)),
            folder: Some(folder.to_owned()),
        })
    }

    /// The result of a saw, if it is known.
    pub fn recall(&self, saw: &Value) -> Option<Known> {
        let known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        known.get(&saw.to_string()).cloned()
    }

    /// Writes the scene of the best saw found so far. The report replaces it.
    pub fn show(&self, scene: &SceneFile) {
        if let Some(folder) = &self.folder
            && let Ok(json) = serde_json::to_vec_pretty(scene)
        {
            // Without this file the search goes on all the same.
            let _ = std::fs::write(folder.join(PLACED), json);
        }
    }

    /// Keeps a saw, also in the log. A log that can no longer be written loses later saws only.
    pub fn keep(&self, saw: Value, found: &Known) {
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        known.insert(saw.to_string(), found.clone());
        drop(known);
        let mut log = self.log.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(file) = log.as_mut() {
            let found = json!({ "saw": saw, "found": found });
            // One call, so that a stopped run leaves no line in pieces.
            if file.write_all(format!("{found}\n").as_bytes()).is_err() {
                *log = None;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_log_of_other_inputs_is_begun_anew_and_half_a_line_is_ignored() {
        let folder = tempfile::tempdir().unwrap();
        let inputs = json!({ "saw": "a" });
        let refused: Known = Err(Some("no such saw".to_owned()));
        let memory = Memory::of(folder.path(), &inputs).unwrap();
        assert!(memory.recall(&json!([0.5])).is_none());
        memory.keep(json!([0.5]), &refused);
        drop(memory);
        let path = folder.path().join(LOG);
        let whole = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, format!("{whole}{{\"saw\":[0.")).unwrap();
        let memory = Memory::of(folder.path(), &inputs).unwrap();
        assert_eq!(memory.recall(&json!([0.5])), Some(refused));
        drop(memory);
        assert_eq!(std::fs::read_to_string(&path).unwrap(), whole);
        let other = Memory::of(folder.path(), &json!({ "saw": "b" })).unwrap();
        assert!(other.recall(&json!([0.5])).is_none());
    }
}
