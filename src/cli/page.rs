//! `--report page.html`.

use std::io::Write;
use std::path::{Path, PathBuf};

use crate::document::{self, Documented};
use anyhow::Context;
use clap::Args;

/// A page of the report, where it is asked for.
#[derive(Args, Default)]
pub struct Page {
    /// Also write one self-contained page of HTML to this file, to read, send and print as PDF: verdict, inputs, tables,
    /// figures, warnings, certificate
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
}

impl Page {
    /// Sees that the page can be written, before the computation and not after it.
    pub fn tried(&self) -> anyhow::Result<()> {
        match &self.report {
            Some(path) => begun(path).map(drop),
            None => Ok(()),
        }
    }

    /// Whether one is asked for.
    pub fn is_asked(&self) -> bool {
        self.report.is_some()
    }

    /// Writes the page as a whole.
    pub fn write(&self, report: &impl Documented) -> anyhow::Result<()> {
        let Some(path) = &self.report else {
            return Ok(());
        };
        let page = document::page(report)?;
        let mut file = begun(path)?;
        let refused = || format!("cannot write {}", path.display());
        file.write_all(page.as_bytes()).with_context(refused)?;
        file.as_file().sync_all().with_context(refused)?;
        file.persist(path)
            .map_err(|error| error.error)
            .with_context(refused)?;
        Ok(())
    }
}

/// A file beside the page, which becomes the page.
fn begun(path: &Path) -> anyhow::Result<tempfile::NamedTempFile> {
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    let refused = || {
        format!(
            "cannot write the page {}; name a file in an existing folder with --report",
            path.display()
        )
    };
    anyhow::ensure!(
        !path.is_dir(),
        "--report {} is a folder; name a file in it, like page.html",
        path.display()
    );
    let mut builder = tempfile::Builder::new();
    super::output::LikeAnyNewFile::permissions_like_any_new_file(&mut builder);
    builder.tempfile_in(folder).with_context(refused)
}
