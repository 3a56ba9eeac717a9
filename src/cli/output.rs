//! A folder that whole files appear in, or none.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;

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

    /// Writes a file under another name and renames it once it is whole.
    pub fn write(&self, name: &str, content: &[u8]) -> anyhow::Result<()> {
        let target = self.path.join(name);
        let failed = || format!("cannot write {}", target.display());
        let mut file = tempfile::Builder::new()
            .permissions_like_any_new_file()
            .tempfile_in(&self.path)
            .with_context(failed)?;
        file.write_all(content).with_context(failed)?;
        file.as_file().sync_all().with_context(failed)?;
        file.persist(&target)
            .map_err(|error| error.error)
            .with_context(failed)?;
        Ok(())
    }

    /// Removes what an earlier run left under a name that this one does not write.
    pub fn remove(&self, name: &str) -> anyhow::Result<()> {
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
