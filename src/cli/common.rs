//! What every command that looks at a scene has in common.

use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};

use crate::scene::{Accuracy, Scene};
use anyhow::Context;
use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};

use super::output::OutputFolder;

/// The saw to look at, and how finely.
#[derive(Args, Default)]
pub struct Input {
    /// Scene to look at; without it, the built-in guided spline saw
    scene: Option<PathBuf>,
    #[command(flatten)]
    finely: Finely,
}

/// How finely to look at a saw.
#[derive(Args, Default)]
pub struct Finely {
    /// Speed for accuracy; overrides the scene's
    #[arg(long, value_name = "NAME")]
    accuracy: Option<AccuracyName>,
    /// Relative error allowed of critical speeds and onsets, 1e-6 to 0.1, instead of a name
    #[arg(long, value_name = "SHARE", conflicts_with = "accuracy")]
    tolerance: Option<f64>,
}

/// Of commands that write files.
#[derive(Args, Default)]
pub struct Common {
    #[command(flatten)]
    input: Input,
    #[command(flatten)]
    output: Output,
}

/// Where results go.
#[derive(Args, Default)]
pub struct Output {
    /// Folder for the files [default: sawflutter-out]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print the report as JSON instead of the summary
    #[arg(long)]
    pub json: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum AccuracyName {
    Draft,
    Design,
    Reference,
}

/// A file by name.
pub type NamedFile = (&'static str, Vec<u8>);

impl Input {
    /// The scene asked for.
    pub fn scene(&self) -> anyhow::Result<Scene> {
        let scene = match &self.scene {
            Some(path) => read_scene(path)?,
            None => Scene::paper(),
        };
        self.finely.applied(scene)
    }
}

/// The scene of a file.
pub fn read_scene(path: &Path) -> anyhow::Result<Scene> {
    Scene::from_path(path).with_context(|| format!("{} was refused", path.display()))
}

impl Finely {
    /// The scene, looked at as finely as asked.
    pub fn applied(&self, mut scene: Scene) -> anyhow::Result<Scene> {
        if let Some(name) = self.accuracy {
            let accuracy = match name {
                AccuracyName::Draft => Accuracy::Draft,
                AccuracyName::Design => Accuracy::Design,
                AccuracyName::Reference => Accuracy::Reference,
            };
            scene = scene.edited(|file| (file.accuracy, file.tolerance) = (accuracy, None))?;
        }
        if let Some(tolerance) = self.tolerance {
            let edited = scene.edited(|file| file.tolerance = Some(tolerance));
            scene = edited.context("--tolerance was refused")?;
        }
        Ok(scene)
    }
}

impl Common {
    /// The scene asked for.
    pub fn scene(&self) -> anyhow::Result<Scene> {
        self.input.scene()
    }

    /// The folder asked for, seen to take files.
    pub fn folder(&self) -> anyhow::Result<OutputFolder> {
        self.output.folder()
    }

    /// Writes the files and prints the report, as [`Output::print`] does.
    pub fn print(
        &self,
        folder: &OutputFolder,
        files: &[NamedFile],
        stale: &[&str],
        json: &str,
        summary: impl FnOnce() -> String,
    ) -> anyhow::Result<()> {
        self.output.print(folder, files, stale, json, summary)
    }
}

impl Output {
    /// The folder asked for, seen to take files.
    pub fn folder(&self) -> anyhow::Result<OutputFolder> {
        let out = self.out.clone();
        OutputFolder::open(&out.unwrap_or_else(|| "sawflutter-out".into()))
    }

    /// Writes the files, removes `stale` ones of an earlier run, and prints the report, in
    /// words or as JSON.
    pub fn print(
        &self,
        folder: &OutputFolder,
        files: &[NamedFile],
        stale: &[&str],
        json: &str,
        summary: impl FnOnce() -> String,
    ) -> anyhow::Result<()> {
        folder.write_together(files, stale)?;
        let mut stdout = std::io::stdout().lock();
        if self.json {
            writeln!(stdout, "{json}")?;
        } else {
            write!(stdout, "{}", summary())?;
            let names: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
            let names = names.join(", ");
            writeln!(stdout, "\nWritten to {}: {names}", folder.path().display())?;
        }
        Ok(())
    }
}

/// A bar on the terminal's error stream, and nothing where that is not a terminal.
pub fn progress_bar(what: &str) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style =
        ProgressStyle::with_template(&format!("{{bar:40}} {{pos}}/{{len}} {what}, {{elapsed}}"));
    ProgressBar::new(1).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// Moves a bar.
pub fn show(bar: &ProgressBar, done: usize, of: usize) {
    bar.set_length(of as u64);
    bar.set_position(done as u64);
}
