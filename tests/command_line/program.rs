//! Runs of the program under test, and the files it writes.

use std::path::{Path, PathBuf};
use std::process::Output;
use std::time::Duration;

use crate::common::says;
use assert_cmd::Command;
use sawflutter::model::scene::{Accuracy, SceneFile};
use serde::de::DeserializeOwned;
use tempfile::TempDir;

#[path = "../common/program.rs"]
mod tested;

pub use tested::program;

/// A limit longer than any run takes, also on a busy machine: a run that hangs is ended.
pub const PATIENCE: Duration = Duration::from_secs(300);

pub fn sawflutter() -> Command {
    let mut command = Command::new(program());
    command.timeout(PATIENCE);
    command
}

/// Runs the program with the folder's `out` as its output folder.
pub fn run(arguments: &[&str], folder: &TempDir) -> Output {
    let mut command = sawflutter();
    let command = command.args(arguments);
    command.arg("--out").arg(out(folder)).output().unwrap()
}

pub fn out(folder: &TempDir) -> PathBuf {
    folder.path().join("out")
}

/// The report in a file of the output folder. Programs in other languages read it too, so that it must not contain NaN.
#[track_caller]
pub fn written<T: DeserializeOwned>(folder: &TempDir, name: &str) -> T {
    let json = std::fs::read_to_string(out(folder).join(name)).unwrap();
    assert!(!json.contains("NaN"), "{json}");
    serde_json::from_str(&json).unwrap()
}

/// Runs the program with arguments that must be refused by a message that contains the words, with exit code 2.
#[track_caller]
pub fn assert_refused(arguments: &[&str], words: &str, folder: &TempDir) {
    let output = run(arguments, folder);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    assert!(says(message, words), "{arguments:?}: {message}");
}

/// Fails if a line does not fit a terminal. The line of the written files names a folder and may have any length.
#[track_caller]
pub fn assert_in_80_columns(summary: &str) {
    for line in summary.lines().filter(|line| !line.starts_with("Written")) {
        assert!(line.chars().count() <= 80, "{line}");
    }
}

/// Names in a folder, ascending; empty if the folder does not exist.
pub fn names_in(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let name = |entry: std::io::Result<std::fs::DirEntry>| entry.unwrap().file_name();
    let names = entries.map(|entry| name(entry).into_string().unwrap());
    let mut names: Vec<String> = names.collect();
    names.sort();
    names
}

pub fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

/// A scene that is computed in a fraction of a second: the blade without guides, at draft accuracy.
pub fn quick_scene() -> SceneFile {
    let mut file = crate::common::scene("free-blade").file().clone();
    file.accuracy = Accuracy::Draft;
    file
}

pub fn write_scene(folder: &TempDir, file: &SceneFile) -> PathBuf {
    let path = folder.path().join("scene.json");
    std::fs::write(&path, serde_json::to_string_pretty(file).unwrap()).unwrap();
    path
}
