//! A folder that whole files appear in, or none.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;

/// How the names of files begin that are still being written.
const STAGED: &str = ".sawflutter-";

/// A folder that has been seen to take files.
pub struct OutputFolder {
    path: PathBuf,
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
        std::fs::create_dir_all(path).with_context(refused)?;
        tempfile::NamedTempFile::new_in(path).with_context(refused)?;
        Ok(OutputFolder {
            path: path.to_owned(),
        })
    }

    /// Writes the files of one run together: all are on the disk before the first gets its
    /// name, and what an earlier run has left under an `optional` name that this one does not
    /// write is removed: it would be taken for this one's. The last file is the one to look for: while it is
    /// there, every other belongs to it, whatever stopped a run and whoever else writes here.
    pub fn write_together(
        &self,
        files: &[(&str, Vec<u8>)],
        optional: &[&str],
    ) -> anyhow::Result<()> {
        let _turn = self.wait_for_turn();
        self.remove_leftovers();
        let staged = files
            .iter()
            .map(|(name, content)| self.staged(name, content))
            .collect::<anyhow::Result<Vec<_>>>()?;
        let last = files.last().map(|(name, _)| *name);
        let written = |name: &&&str| files.iter().any(|(own, _)| own == *name);
        let stale = optional.iter().filter(|name| !written(name));
        for name in last.iter().chain(stale) {
            self.remove(name)?;
        }
        for (file, (name, _)) in staged.into_iter().zip(files) {
            self.persist(file, name)?;
        }
        Ok(())
    }

    /// Runs that write to the same folder take turns; the system ends the turn of one that is
    /// killed. Where folders cannot be locked there are no turns.
    fn wait_for_turn(&self) -> Option<std::fs::File> {
        let folder = std::fs::File::open(&self.path).ok()?;
        folder.lock().ok().map(|()| folder)
    }

    /// What runs that were killed have left half written.
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

    /// A whole file under a passing name, on the disk.
    fn staged(&self, name: &str, content: &[u8]) -> anyhow::Result<tempfile::NamedTempFile> {
        let failed = || format!("cannot write {}", self.path.join(name).display());
        let mut file = tempfile::Builder::new()
            .prefix(STAGED)
            .permissions_like_any_new_file()
            .tempfile_in(&self.path)
            .with_context(failed)?;
        file.write_all(content).with_context(failed)?;
        file.as_file().sync_all().with_context(failed)?;
        Ok(file)
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

/// Temporary files are private; what they become should not be.
trait LikeAnyNewFile {
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
