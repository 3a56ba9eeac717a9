//! The output folder: the files of a run appear in it together and complete, or not at all.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;

/// How the names of files begin that are still being written.
const STAGED: &str = ".sawflutter-";

/// A folder that has been seen to take files.
pub struct OutputFolder {
    path: PathBuf,
    /// The folders that were made for it, the innermost first.
    made: Vec<PathBuf>,
}

impl OutputFolder {
    /// Creates the folder if need be, and tries it out: a folder that cannot be
    /// written fails before the computation, not after it.
    pub fn open(path: &Path) -> anyhow::Result<Self> {
        let refused = || {
            format!(
                "cannot write to the output folder {}; name another one with --out",
                path.display()
            )
        };
        let missing = path
            .ancestors()
            .take_while(|folder| !folder.as_os_str().is_empty() && !folder.exists());
        let folder = OutputFolder {
            path: path.to_owned(),
            made: missing.map(Path::to_owned).collect(),
        };
        std::fs::create_dir_all(path).with_context(refused)?;
        tempfile::NamedTempFile::new_in(path).with_context(refused)?;
        Ok(folder)
    }

    /// Writes the files of one run together, see [`Writing`].
    pub fn write_together(
        &self,
        files: &[(&'static str, Vec<u8>)],
        optional: &[&str],
    ) -> anyhow::Result<()> {
        self.staged(files)?.finish(optional)
    }

    /// Files of one run, on the disk but without their names.
    pub fn staged(&self, files: &[(&'static str, Vec<u8>)]) -> anyhow::Result<Writing<'_>> {
        let mut writing = self.begin();
        for (name, content) in files {
            writing.stage_bytes(name, content)?;
        }
        Ok(writing)
    }

    /// Begins to write the files of one run together: all are on the disk before the first gets
    /// its name.
    pub fn begin(&self) -> Writing<'_> {
        let turn = self.wait_for_turn();
        self.remove_leftovers();
        Writing {
            folder: self,
            _turn: turn,
            staged: Vec::new(),
        }
    }

    /// Runs that write to the same folder take turns; the system ends the turn of one that is
    /// killed. Where folders cannot be locked there are no turns.
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

    /// Removes what an earlier run has left under a name.
    fn remove(&self, name: &str) -> anyhow::Result<()> {
        let target = self.path.join(name);
        match std::fs::remove_file(&target) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                Err(error).with_context(|| format!("cannot remove the old {}", target.display()))
            }
            _ => Ok(()),
        }
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

/// A run that was refused or failed removes the empty folders that it has made.
impl Drop for OutputFolder {
    fn drop(&mut self) {
        for folder in &self.made {
            // The system refuses to remove a folder with files in it, which stays.
            if std::fs::remove_dir(folder).is_err() {
                break;
            }
        }
    }
}

/// Files of one run that have no names yet.
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

    /// An empty file of this run.
    pub fn create(&self, name: &str) -> anyhow::Result<tempfile::NamedTempFile> {
        tempfile::Builder::new()
            .prefix(STAGED)
            .permissions_like_any_new_file()
            .tempfile_in(&self.folder.path)
            .with_context(|| self.failed(name))
    }

    /// Puts a file that was created here on the disk.
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

    /// Puts a file with this content on the disk.
    pub fn stage_bytes(&mut self, name: &'static str, content: &[u8]) -> anyhow::Result<()> {
        let mut file = self.create(name)?;
        file.write_all(content).with_context(|| self.failed(name))?;
        self.stage(name, file)
    }

    fn failed(&self, name: &str) -> String {
        format!("cannot write {}", self.folder.path.join(name).display())
    }

    /// Names the files; what an earlier run has left under an `optional` name that this one does
    /// not write is removed: it would be taken for this one's. The last file is the one to look
    /// for: while it is there, every other belongs to it, whatever stopped a run and whoever else
    /// writes here.
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

/// Temporary files are private; what they become should not be.
pub trait LikeAnyNewFile {
    fn permissions_like_any_new_file(&mut self) -> &mut Self;
}

impl LikeAnyNewFile for tempfile::Builder<'_, '_> {
    fn permissions_like_any_new_file(&mut self) -> &mut Self {
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            self.permissions(std::fs::Permissions::from_mode(0o666));
        }
        self
    }
}
