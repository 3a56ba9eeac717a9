//! Runs of the program under test, and the files it writes.

use std::path::{Path, PathBuf};
use std::process::Output;
use std::time::Duration;

use assert_cmd::Command;
use sawflutter::scene::{Accuracy, SceneFile};
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

/// A scene that is computed in no time: the blade without guides, at draft accuracy.
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
