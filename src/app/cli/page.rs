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
    /// Refuses a page that cannot be written before the computation instead of after it.
    pub fn tried(&self) -> anyhow::Result<()> {
        match &self.report {
            Some(path) => begun(path).map(drop),
            None => Ok(()),
        }
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

/// Creates a temporary file in the folder of the page, which later gets the name of the page.
fn begun(path: &Path) -> anyhow::Result<tempfile::NamedTempFile> {
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
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
    temporary_file(".tmp", folder).with_context(refused)
}
