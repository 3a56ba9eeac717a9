//! The output folder: the files of a run appear in it together and complete, or not at all.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;

/// Name and content of a file.
pub type NamedFile = (&'static str, Vec<u8>);

/// Prefix of the names of files that are not complete yet.
const STAGED: &str = ".sawflutter-";

/// An output folder in which files can be written.
pub struct OutputFolder {
    path: PathBuf,
}

impl OutputFolder {
    /// Tries to write in the folder, so that one that cannot be written is refused before the computation instead of
    /// after it. A folder that is missing is tried in a temporary folder beside it and is created when there are
    /// files for it, so that a run that is refused or interrupted leaves none.
    pub fn open(path: &Path) -> anyhow::Result<Self> {
        tried(path).with_context(|| {
            format!(
                "cannot write to the output folder {}; name another one with --out",
                path.display()
            )
        })?;
        Ok(OutputFolder {
            path: path.to_owned(),
        })
    }

    /// The folder, for what is kept in it during the run.
    pub fn created(&self) -> anyhow::Result<&Path> {
        let path = &self.path;
        std::fs::create_dir_all(path)
            .with_context(|| format!("cannot create the folder {}", path.display()))?;
        Ok(path)
    }

    /// Writes the files of one run together, see [`Writing::finish`].
    pub fn write_together(&self, files: &[NamedFile], optional: &[&str]) -> anyhow::Result<()> {
        self.staged(files)?.finish(optional)
    }

    /// Writes the files of one run to the disk under temporary names.
    pub fn staged(&self, files: &[NamedFile]) -> anyhow::Result<Writing<'_>> {
        let mut writing = self.begin()?;
        for (name, content) in files {
            writing.stage_bytes(name, content)?;
        }
        Ok(writing)
    }

    /// Begins to write the files of one run together: all are on the disk before the first one gets its name.
    pub fn begin(&self) -> anyhow::Result<Writing<'_>> {
        self.created()?;
        let turn = self.wait_for_turn();
        self.remove_leftovers();
        Ok(Writing {
            folder: self,
            _turn: turn,
            staged: Vec::new(),
        })
    }

    /// Locks the folder, so that runs that write to it take turns. The system ends the lock of a run that is killed.
    /// `None` where folders cannot be locked, and there are no turns.
    fn wait_for_turn(&self) -> Option<std::fs::File> {
        let folder = std::fs::File::open(&self.path).ok()?;
        folder.lock().ok().map(|()| folder)
    }

    /// Removes the temporary files of runs that were killed.
    fn remove_leftovers(&self) {
        let entries = std::fs::read_dir(&self.path)
            .into_iter()
            .flatten()
            .flatten();
        for entry in entries {
            if entry.file_name().to_string_lossy().starts_with(STAGED) {
                let _ = std::fs::remove_file(entry.path());
            }
        }
    }

    fn persist(&self, file: tempfile::NamedTempFile, name: &str) -> anyhow::Result<()> {
        let target = self.path.join(name);
        file.persist(&target)
            .map_err(|error| error.error)
            .with_context(|| format!("cannot write {}", target.display()))?;
        Ok(())
    }

    /// Removes the file of an earlier run with this name.
    fn remove(&self, name: &str) -> anyhow::Result<()> {
        let target = self.path.join(name);
        match std::fs::remove_file(&target) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                Err(error).with_context(|| format!("cannot remove the old {}", target.display()))
            }
            _ => Ok(()),
        }
    }

    /// Path of the folder.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

/// Files of one run that still have temporary names.
pub struct Writing<'a> {
    folder: &'a OutputFolder,
    _turn: Option<std::fs::File>,
    staged: Vec<(&'static str, tempfile::NamedTempFile)>,
}

impl Writing<'_> {
    /// Names of the files.
    pub fn names(&self) -> Vec<&'static str> {
        self.staged.iter().map(|(name, _)| *name).collect()
    }

    /// Creates an empty temporary file for the content of a name.
    pub fn create(&self, name: &str) -> anyhow::Result<tempfile::NamedTempFile> {
        temporary_file(STAGED, &self.folder.path).with_context(|| self.failed(name))
    }

    /// Waits until the content of a file of [`Writing::create`] is on the disk, and adds it to the run.
    pub fn stage(
        &mut self,
        name: &'static str,
        file: tempfile::NamedTempFile,
    ) -> anyhow::Result<()> {
        file.as_file()
            .sync_all()
            .with_context(|| self.failed(name))?;
        self.staged.push((name, file));
        Ok(())
    }

    /// Writes a content to the disk under a temporary name, and adds the file to the run.
    pub fn stage_bytes(&mut self, name: &'static str, content: &[u8]) -> anyhow::Result<()> {
        let mut file = self.create(name)?;
        file.write_all(content).with_context(|| self.failed(name))?;
        self.stage(name, file)
    }

    fn failed(&self, name: &str) -> String {
        format!("cannot write {}", self.folder.path.join(name).display())
    }

    /// Gives the files their names, and removes files of an earlier run that have an `optional` name and that this
    /// run does not write, because they belong to another saw. The last file is removed first and named last: while
    /// it exists, all others belong to it, even if a run was stopped.
    pub fn finish(self, optional: &[&str]) -> anyhow::Result<()> {
        let names = self.names();
        let stale = optional.iter().filter(|name| !names.contains(name));
        for name in names.last().into_iter().chain(stale) {
            self.folder.remove(name)?;
        }
        for (name, file) in self.staged {
            self.folder.persist(file, name)?;
        }
        Ok(())
    }
}

/// Creates a temporary file in a folder, or the folder with its missing parents inside a temporary one. Another run can
/// create the same folder at any moment, so that nothing with its own name is created only to be removed.
fn tried(path: &Path) -> std::io::Result<()> {
    // The present folder is the outermost of a relative path.
    let path = Path::new(".").join(path);
    let existing = path.ancestors().find(|folder| folder.exists());
    let existing = existing.unwrap_or(&path);
    let missing = path.strip_prefix(existing).unwrap_or(&path);
    if missing.as_os_str().is_empty() {
        tempfile::NamedTempFile::new_in(existing)?;
        return Ok(());
    }
    let beside = tempfile::Builder::new()
        .prefix(STAGED)
        .tempdir_in(existing)?;
    std::fs::create_dir_all(beside.path().join(missing))?;
    beside.close()
}

/// Creates a temporary file with the permissions of any new file, because its content becomes a result that others may
/// read.
pub fn temporary_file(prefix: &str, folder: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(prefix);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Several runs try the same missing folder at once: none finds it removed by another.
    #[test]
    fn runs_that_begin_together_do_not_hinder_each_other() {
        let place = tempfile::TempDir::new().unwrap();
        let path = place.path().join("results/of/today");
        let tries = || {
            for _ in 0..200 {
                OutputFolder::open(&path).unwrap();
            }
        };
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(tries);
            }
        });
        assert_eq!(std::fs::read_dir(place.path()).unwrap().count(), 0);
    }

    #[test]
    fn folders_that_cannot_be_made_are_refused() {
        let place = tempfile::TempDir::new().unwrap();
        let file = place.path().join("file");
        std::fs::write(&file, "").unwrap();
        for path in [file.join("out"), place.path().join("a".repeat(300)), file] {
            assert!(OutputFolder::open(&path).is_err(), "{}", path.display());
        }
        assert_eq!(std::fs::read_dir(place.path()).unwrap().count(), 1);
    }
}
