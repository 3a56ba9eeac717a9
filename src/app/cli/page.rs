//! The option `--report`: the report as one page of HTML.

use std::io::Write;
use std::path::{Path, PathBuf};

use crate::analyses::commands::CommandReport;
use anyhow::Context;
use clap::Args;

use super::output::temporary_file;

/// The file of the page, if it is requested.
#[derive(Args, Default)]
pub struct Page {
    /// Also write one self-contained page of HTML to this file, to read, send and print as PDF: verdict, inputs, tables,
    /// figures, warnings, certificate
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
}

impl Page {
    /// Refuses a page that cannot be written before the computation instead of after it, and leaves nothing behind.
    pub fn tried(&self) -> anyhow::Result<()> {
        let Some(path) = &self.report else {
            return Ok(());
        };
        let existing = folder(path).ancestors().find(|folder| folder.exists());
        begun(path, existing.unwrap_or(Path::new("."))).map(drop)
    }

    /// Whether a page is requested.
    pub fn is_asked(&self) -> bool {
        self.report.is_some()
    }

    /// Writes the page, if it is requested, as a whole.
    pub fn write(&self, report: &impl CommandReport) -> anyhow::Result<()> {
        let Some(path) = &self.report else {
            return Ok(());
        };
        let page = report.page()?;
        let folder = folder(path);
        std::fs::create_dir_all(folder).with_context(|| cannot_write(path))?;
        let mut file = begun(path, folder)?;
        let refused = || format!("cannot write {}", path.display());
        file.write_all(page.as_bytes()).with_context(refused)?;
        file.as_file().sync_all().with_context(refused)?;
        file.persist(path)
            .map_err(|error| error.error)
            .with_context(refused)?;
        Ok(())
    }
}

/// The folder of a page.
fn folder(path: &Path) -> &Path {
    let parent = path.parent();
    let named = parent.filter(|folder| !folder.as_os_str().is_empty());
    named.unwrap_or(Path::new("."))
}

fn cannot_write(path: &Path) -> String {
    format!(
        "cannot write the page {}; name another file with --report",
        path.display()
    )
}

/// Creates a temporary file in a folder, which later gets the name of the page.
fn begun(path: &Path, folder: &Path) -> anyhow::Result<tempfile::NamedTempFile> {
    anyhow::ensure!(
        !path.is_dir(),
        "--report {} is a folder; name a file in it, like page.html",
        path.display()
    );
    temporary_file(".tmp", folder).with_context(|| cannot_write(path))
}
