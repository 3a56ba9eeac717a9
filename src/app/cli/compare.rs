//! `sawflutter compare`.

use std::path::{Path, PathBuf};

use crate::analyses::campbell::Report;
use crate::analyses::commands;
use crate::analyses::compare::{NamedSaw, Saw, compare};
use crate::model::scene::Scene;
use crate::page::text::{Kind, OtherEncodings};
use anyhow::anyhow;
use clap::Args;

use super::common::{Changes, Output, is_standard_input, read_text, refused, with_settings};
use super::page::Page;
use super::progress::watched;

pub const EXAMPLES: &str = "\
Examples:
  sawflutter compare a.json b.json c.json
  sawflutter compare my-saw.json --variant blade.thickness_m=2.6mm \\
    --variant \"blade.thickness_m=2.6mm,guides[0].radius_m=250mm\"
  sawflutter compare a-out/report.json b-out/report.json # computed before
  sawflutter compare a.json b.json --json | jq '.saws[].flutter_rpm'

Scenes without a sweep are charted over the same speeds. The first saw is the
one that the others are compared with.";

#[derive(Args)]
pub struct Arguments {
    /// Scenes, or reports of `analyze`; without any, the built-in guided spline saw
    #[arg(value_name = "FILE")]
    files: Vec<PathBuf>,
    /// A variant of the first scene, with other numbers: settings as of --set, separated by commas; may
    /// be given more than once
    #[arg(long, value_name = "PATH=VALUE")]
    variant: Vec<String>,
    #[command(flatten)]
    changes: Changes,
    #[command(flatten)]
    output: Output,
    #[command(flatten)]
    page: Page,
}

/// Largest size and encodings of a file; reports are long, because they contain the branches over the speed.
const REPORT: Kind = Kind {
    limit: 1 << 28,
    other_encodings: OtherEncodings::Refused,
};

/// Compares saws, writes the files and prints the table.
pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let saws = saws(arguments)?;
    arguments.page.tried()?;
    let folder = arguments.output.folder()?;
    let report = watched(|progress| compare(saws, &|done, of| progress.show("saws", done, of)))??;
    let output = &arguments.output;
    output.report(&folder, &arguments.page, &report, Vec::new())
}

/// Reads the saws and names them.
fn saws(arguments: &Arguments) -> anyhow::Result<Vec<NamedSaw>> {
    let mut saws = Vec::new();
    for path in &arguments.files {
        let name = unused(name(path), &saws);
        let saw = read(path, &arguments.changes)?;
        saws.push(NamedSaw { name, saw });
    }
    if saws.is_empty() {
        let scene = arguments.changes.applied(Scene::paper())?;
        saws.push(NamedSaw {
            name: "built-in".to_owned(),
            saw: Saw::Scene(Box::new(scene)),
        });
    }
    for variant in &arguments.variant {
        let Saw::Scene(first) = &saws[0].saw else {
            return Err(anyhow!(
                "--variant {variant} is given, but the first file is a report; give its scene instead"
            ));
        };
        let option = format!("--variant {variant}");
        let scene = with_settings(first, variant.split(','), &option)?;
        let name = unused(in_short(variant), &saws);
        let saw = Saw::Scene(Box::new(scene));
        saws.push(NamedSaw { name, saw });
    }
    anyhow::ensure!(
        saws.len() > 1,
        "there is one saw, but a comparison needs two; name another file, or a --variant like blade.thickness_m=2.6mm"
    );
    Ok(saws)
}

/// Reads a report, or a scene and applies the changes to it.
fn read(path: &Path, changes: &Changes) -> anyhow::Result<Saw> {
    let text = read_text(path, REPORT)?;
    // Reports have the key `campbell`, which scenes do not have.
    if text.contains("\"campbell\"") {
        let report: Report = commands::read(&text).map_err(|error| {
            refused(
                path,
                anyhow!(
                    "it is no report of `analyze` that this version reads ({error}); give its scene"
                ),
            )
        })?;
        anyhow::ensure!(
            !changes.is_any(),
            "{} is a report, which options cannot change; give its scene instead",
            path.display()
        );
        return Ok(Saw::Report(Box::new(report)));
    }
    let scene = Scene::from_json(&text).map_err(|error| refused(path, error.into()))?;
    Ok(Saw::Scene(Box::new(changes.applied(scene)?)))
}

/// Label of a variant: its settings with the last key of each path.
fn in_short(variant: &str) -> String {
    let settings = variant.split(',').map(|setting| {
        let (path, value) = setting.split_once('=').unwrap_or((setting, ""));
        let key = path.rsplit('.').next().unwrap_or(path);
        format!("{}={}", key.trim(), value.trim())
    });
    settings.collect::<Vec<_>>().join(", ")
}

/// Name of the saw of a file: the name of the file or, for a report, of its folder.
fn name(path: &Path) -> String {
    if is_standard_input(path) {
        return "standard-input".to_owned();
    }
    let stem = path.file_stem().unwrap_or_default();
    let folder = path.parent().and_then(Path::file_name);
    let name = match folder {
        Some(folder) if stem == "report" => folder,
        _ => stem,
    };
    name.to_string_lossy().into_owned()
}

/// The name, with a number if another saw has it already.
fn unused(name: String, saws: &[NamedSaw]) -> String {
    let numbered = (2..).map(|k| format!("{name}-{k}"));
    let mut names = std::iter::once(name.clone()).chain(numbered);
    let free = names.find(|name| !saws.iter().any(|taken| taken.name == *name));
    free.unwrap_or(name)
}
