//! Options and functions that every command with a scene shares.

use std::io::Write;
use std::path::{Path, PathBuf};

use crate::analyses::commands::CommandReport;
use crate::model::scene::{
    Accuracy, Reading, RefusedValue, SCENE_TEXT, Scene, SceneError, Setting, number_in, quantity,
};
use crate::page::text::{
    FileError, Kind, printable, printable_line, read_path, read_stream, shown,
};
use anyhow::Context;
use clap::{Args, ValueEnum};
use serde::Serialize;

use super::colour::Paint;
use super::output::{NamedFile, OutputFolder, Writing};
use super::page::Page;
use super::pictures::drawn;

/// The scene of a command, and changes of it.
#[derive(Args, Default)]
pub struct Input {
    /// Scene to look at, - for standard input; without it, the built-in guided spline saw
    scene: Option<PathBuf>,
    #[command(flatten)]
    changes: Changes,
}

/// Changes of a scene by the command line.
#[derive(Args, Default)]
pub struct Changes {
    /// Set a key of the scene by its path: a number, in the unit of its key or with a unit, like
    /// blade.thickness_m=2.6mm, or a word, like guides[0].contact=one_sided; may be given more
    /// than once
    #[arg(long, value_name = "PATH=VALUE")]
    set: Vec<String>,
    /// Speed for accuracy; overrides the scene's
    #[arg(long, value_name = "NAME")]
    accuracy: Option<AccuracyName>,
    #[arg(
        long,
        value_name = "SHARE",
        conflicts_with = "accuracy",
        value_parser = share,
        help = tolerance_help()
    )]
    tolerance: Option<f64>,
}

/// Arguments of commands that write files.
#[derive(Args, Default)]
pub struct Common {
    #[command(flatten)]
    input: Input,
    #[command(flatten)]
    pub output: Output,
}

/// Destination of the results.
#[derive(Args, Default)]
pub struct Folder {
    /// Folder for the files [default: sawflutter-out]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Destination and form of the results.
#[derive(Args, Default)]
pub struct Output {
    #[command(flatten)]
    folder: Folder,
    /// Print the report as JSON instead of the summary
    #[arg(long)]
    pub json: bool,
    /// Print certificates, backward errors and the basis, too, and draw all figures
    #[arg(long)]
    pub details: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum AccuracyName {
    Draft,
    Design,
    Reference,
}

impl Input {
    /// Reads the scene and applies the changes.
    pub fn scene(&self) -> anyhow::Result<Scene> {
        let scene = match &self.scene {
            Some(path) => read_scene(path)?,
            None => Scene::paper(),
        };
        self.changes.applied(scene)
    }

    /// Path of the scene; `None` for the built-in saw and for standard input.
    #[cfg(feature = "explore")]
    pub fn file(&self) -> Option<&Path> {
        let path = self.scene.as_deref();
        path.filter(|path| !is_standard_input(path))
    }
}

fn tolerance_help() -> String {
    let allowed = const { quantity("tolerance") }.allowed;
    format!(
        "Relative error allowed of critical speeds and onsets, {} to {}, instead of a name",
        shown(allowed.from),
        shown(allowed.to)
    )
}

/// Reads a scene from a file, or from standard input where the path is `-`.
pub fn read_scene(path: &Path) -> anyhow::Result<Scene> {
    let text = read_text(path, SCENE_TEXT)?;
    let read = Scene::file_from_json(&text).and_then(|file| {
        Scene::of_typed(file.clone()).inspect_err(|error| {
            let refused = match error {
                SceneError::Value(refused) => Some(refused.key.as_str()),
                _ => None,
            };
            remark_unusual(&file.unusual_numbers_beside(refused));
        })
    });
    read.map_err(|error: SceneError| refused(path, error.into()))
}

/// Prints unusual numbers on the error stream: before the work, which may take long or be refused because of them.
fn remark_unusual(numbers: &[String]) {
    for number in numbers {
        eprintln!("unusual number: {}", printable_line(number));
    }
}

/// Reads the text of a file, or of standard input where the path is `-`.
pub fn read_text(path: &Path, kind: Kind) -> Result<String, FileError> {
    if is_standard_input(path) {
        read_stream(std::io::stdin().lock(), Path::new(STANDARD_INPUT), kind)
    } else {
        read_path(path, kind)
    }
}

const STANDARD_INPUT: &str = "standard input";

pub fn is_standard_input(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Adds the name of a file to the error of its content.
pub fn refused(path: &Path, error: anyhow::Error) -> anyhow::Error {
    let name = if is_standard_input(path) {
        STANDARD_INPUT.into()
    } else {
        path.display().to_string()
    };
    error.context(format!("{name} was refused"))
}

/// The error of an option with its name on the command line.
pub fn of_option(option: &str, refused: RefusedValue) -> anyhow::Error {
    let key = format!("--{option}");
    RefusedValue { key, ..refused }.into()
}

/// The scene with settings like `blade.thickness_m=2.6mm`; errors name the option.
pub fn with_settings<'a>(
    scene: &Scene,
    texts: impl Iterator<Item = &'a str>,
    option: &str,
) -> anyhow::Result<Scene> {
    let refused = || format!("{option} was refused");
    let settings = texts
        .map(str::parse)
        .collect::<Result<Vec<Setting>, _>>()
        .with_context(refused)?;
    scene.file().set(&settings).with_context(refused)
}

/// Parses the number of an option, with or without a unit, in this unit.
fn in_unit(unit: &str, text: &str) -> Result<f64, String> {
    number_in("it", unit, text).map_err(|refused| refused.to_string())
}

/// Parses a rotation speed, in rpm.
pub fn rpm(text: &str) -> Result<f64, String> {
    let read = Reading::of(SPEED).and_then(|reading| reading.named("it").number(text));
    read.map_err(|refused| refused.to_string())
}

/// The number of a scene whose usual range decides how the text of a speed is read.
const SPEED: &str = "operating_rpm";

/// Parses a frequency, in Hz.
pub fn hertz(text: &str) -> Result<f64, String> {
    in_unit("Hz", text)
}

/// Parses a time.
pub fn seconds(text: &str) -> Result<f64, String> {
    in_unit("s", text)
}

/// Parses a share, as a number or in percent.
pub fn share(text: &str) -> Result<f64, String> {
    in_unit("", text)
}

/// Parses the whole number of an option.
pub fn count<T: std::str::FromStr>(text: &str) -> Result<T, String> {
    let refused = |_| "it must be a whole number, 0 or more".to_owned();
    text.trim().parse().map_err(refused)
}

/// Writes a text to standard output, with control characters made visible, and coloured on a terminal.
pub fn say(text: &str) -> std::io::Result<()> {
    let text = Paint::of_stdout().text(&printable(text));
    write!(std::io::stdout().lock(), "{text}")
}

impl Changes {
    /// Whether any change is given.
    pub fn is_any(&self) -> bool {
        !self.set.is_empty() || self.accuracy.is_some() || self.tolerance.is_some()
    }

    /// Applies the changes to a scene.
    pub fn applied(&self, mut scene: Scene) -> anyhow::Result<Scene> {
        if !self.set.is_empty() {
            scene = with_settings(&scene, self.set.iter().map(String::as_str), "--set")?;
        }
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
        remark_unusual(&scene.file().unusual_numbers());
        Ok(scene)
    }
}

impl Common {
    /// Reads the scene and applies the changes.
    pub fn scene(&self) -> anyhow::Result<Scene> {
        self.input.scene()
    }

    /// Opens the output folder, see [`OutputFolder::open`].
    pub fn folder(&self) -> anyhow::Result<OutputFolder> {
        self.output.folder()
    }
}

impl Folder {
    /// Opens the output folder, see [`OutputFolder::open`].
    pub fn open(&self) -> anyhow::Result<OutputFolder> {
        let path = self.out.as_deref();
        OutputFolder::open(path.unwrap_or(Path::new("sawflutter-out")))
    }
}

impl Output {
    /// Whether a folder is named.
    pub fn has_folder(&self) -> bool {
        self.folder.out.is_some()
    }

    /// Prints a report.
    pub fn say<R: CommandReport + Serialize>(&self, report: &R) -> anyhow::Result<()> {
        if self.json {
            say(&format!("{}\n", serde_json::to_string_pretty(report)?))?;
        } else {
            say(&self.words(report))?;
        }
        Ok(())
    }

    /// Opens the output folder, see [`OutputFolder::open`].
    pub fn folder(&self) -> anyhow::Result<OutputFolder> {
        self.folder.open()
    }

    /// The text of a report, with its details if asked for.
    pub fn words(&self, report: &dyn CommandReport) -> String {
        report.text(self.details)
    }

    /// Writes the page of a report, its figures, the `others` and the report itself, and prints the report. An other file without a content
    /// is removed if an earlier run wrote it.
    pub fn report<R: CommandReport + Serialize>(
        &self,
        folder: &OutputFolder,
        page: &Page,
        report: &R,
        others: Vec<(&'static str, Option<Vec<u8>>)>,
    ) -> anyhow::Result<()> {
        let command = report.command();
        page.write(report)?;
        let json = serde_json::to_string_pretty(report)?;
        let mut files = drawn(report, self.details)?;
        let mut optional = command.figures.concat();
        for (name, content) in others {
            optional.push(name);
            files.extend(content.map(|content| (name, content)));
        }
        files.push((command.file, json.clone().into_bytes()));
        self.print(folder, &files, &optional, &json, || self.words(report))
    }

    /// Writes the files as [`Writing::finish`] describes, and prints the report, as a summary or as JSON.
    pub fn print(
        &self,
        folder: &OutputFolder,
        files: &[NamedFile],
        optional: &[&str],
        json: &str,
        summary: impl FnOnce() -> String,
    ) -> anyhow::Result<()> {
        let writing = folder.staged(files)?;
        self.print_written(folder, writing, optional, json, summary)
    }

    /// As [`Output::print`], for files that are staged on the disk already.
    pub fn print_written(
        &self,
        folder: &OutputFolder,
        writing: Writing<'_>,
        optional: &[&str],
        json: &str,
        summary: impl FnOnce() -> String,
    ) -> anyhow::Result<()> {
        let names = writing.names().join(", ");
        writing.finish(optional)?;
        if self.json {
            say(&format!("{json}\n"))?;
        } else {
            let path = folder.path().display();
            say(&format!("{}\nWritten to {path}: {names}\n", summary()))?;
        }
        Ok(())
    }
}

/// The text of an error and of its causes, except causes that the text already contains.
pub fn in_words(error: &anyhow::Error) -> String {
    let mut words = String::new();
    for cause in error.chain().map(ToString::to_string) {
        if words.is_empty() {
            words = cause;
        } else if !words.contains(&cause) {
            words += &format!(": {cause}");
        }
    }
    words
}
