//! The file that the program was started with, to which the page saves on request.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use super::refusal::Refusal;
use super::reply::FileNote;
use crate::model::scene::{Scene, SceneError};

/// Reason for which a scene is not saved.
#[derive(Debug)]
pub enum Unsaved {
    /// Another program has changed the file, which now has this content.
    Changed(String),
    /// The scene is not valid, or the file cannot be written.
    Refused(Refusal),
}

impl From<Refusal> for Unsaved {
    fn from(refusal: Refusal) -> Self {
        Unsaved::Refused(refusal)
    }
}

impl From<SceneError> for Unsaved {
    fn from(error: SceneError) -> Self {
        Unsaved::Refused(error.into())
    }
}

/// A scene file and its content as it was last read or written here.
#[derive(Debug)]
pub struct OpenedFile {
    path: PathBuf,
    known: Mutex<Vec<u8>>,
}

impl OpenedFile {
    /// Opens the file at a path; returns `None` if it cannot be read.
    pub fn new(path: &Path) -> Option<Self> {
        // A symbolic link is followed, so that saving replaces its target and not the link.
        let path = path.canonicalize().ok()?;
        let known = Mutex::new(std::fs::read(&path).ok()?);
        Some(OpenedFile { path, known })
    }

    /// Returns the name of the file, and whether it has comments.
    pub fn note(&self) -> FileNote {
        let name = self.path.file_name().unwrap_or_default();
        let known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        FileNote {
            name: name.to_string_lossy().into_owned(),
            plain: serde_json::from_slice::<serde::de::IgnoredAny>(&known).is_ok(),
        }
    }

    /// Saves a scene. The file is replaced as a whole or does not change.
    ///
    /// # Errors
    /// [`Unsaved::Changed`] if another program has changed the file; the next call overwrites it, because the user knows of
    /// the change. [`Unsaved::Refused`] if the scene is not valid or the file cannot be written.
    pub fn save(&self, scene: &str) -> Result<(), Unsaved> {
        let scene = Scene::from_json(scene)?;
        let text = serde_json::to_string_pretty(scene.file()).map_err(|e| Refusal::of(&e))? + "\n";
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let refused = |reason: String| {
            Refusal::with_message(format!(
                "{} was not saved: {reason}; “Save a copy” saves the saw elsewhere",
                self.path.display()
            ))
        };
        match std::fs::read(&self.path) {
            Ok(present) if present != *known => {
                let text = String::from_utf8_lossy(&present).into_owned();
                *known = present;
                return Err(Unsaved::Changed(text));
            }
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                return Err(refused(error.to_string()).into());
            }
            _ => (),
        }
        self.replace(text.as_bytes()).map_err(refused)?;
        *known = text.into_bytes();
        Ok(())
    }

    fn replace(&self, content: &[u8]) -> Result<(), String> {
        let folder = self.path.parent().unwrap_or(Path::new("."));
        let is_read_only = |path: &Path| {
            let found = path.metadata();
            found.is_ok_and(|found| found.permissions().readonly())
        };
        // On Windows, the read-only attribute of a folder does not apply to its files.
        if cfg!(unix) && is_read_only(folder) {
            return Err(format!("the folder {} is read-only", folder.display()));
        }
        if is_read_only(&self.path) {
            return Err("the file is read-only".to_owned());
        }
        let words = |error: std::io::Error| error.to_string();
        let mut file = tempfile::Builder::new()
            .prefix(".sawflutter-")
            .tempfile_in(folder)
            .map_err(words)?;
        file.write_all(content).map_err(words)?;
        if let Ok(found) = self.path.metadata() {
            let kept = file.as_file().set_permissions(found.permissions());
            kept.map_err(words)?;
        }
        file.persist(&self.path)
            .map_err(|error| words(error.error))?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paper() -> String {
        serde_json::to_string(Scene::paper().file()).unwrap()
    }

    fn refused(saved: Result<(), Unsaved>) -> String {
        match saved {
            Err(Unsaved::Refused(refusal)) => refusal.message,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_file_is_replaced_as_a_whole_or_not_at_all() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("saw.json");
        std::fs::write(&path, format!("// A saw.\n{}", paper())).unwrap();
        let file = OpenedFile::new(&path).unwrap();
        assert_eq!(file.note().name, "saw.json");
        assert!(!file.note().plain);
        file.save(&paper()).unwrap();
        assert!(file.note().plain);
        let saved = std::fs::read_to_string(&path).unwrap();
        assert_eq!(
            Scene::from_json(&saved).unwrap().file(),
            Scene::paper().file()
        );

        let message = refused(file.save("{}"));
        assert!(message.contains("name"), "{message}");
        std::fs::write(&path, "by another program").unwrap();
        let Err(Unsaved::Changed(text)) = file.save(&paper()) else {
            panic!("the change was not noticed");
        };
        assert_eq!(text, "by another program");
        assert_eq!(std::fs::read(&path).unwrap(), b"by another program");
        // The user has been told of the change.
        file.save(&paper()).unwrap();
        assert_ne!(std::fs::read(&path).unwrap(), b"by another program");
        let count = std::fs::read_dir(folder.path()).unwrap().count();
        assert_eq!(count, 1);
    }

    #[cfg(unix)]
    #[test]
    fn a_folder_that_is_read_only_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("saw.json");
        std::fs::write(&path, paper()).unwrap();
        let file = OpenedFile::new(&path).unwrap();
        let mut permissions = folder.path().metadata().unwrap().permissions();
        permissions.set_readonly(true);
        std::fs::set_permissions(folder.path(), permissions).unwrap();
        let message = refused(file.save(&paper()));
        let told = format!(
            "{} was not saved: the folder",
            path.canonicalize().unwrap().display()
        );
        assert!(message.starts_with(&told), "{message}");
        assert!(message.contains("is read-only"), "{message}");
    }
}
